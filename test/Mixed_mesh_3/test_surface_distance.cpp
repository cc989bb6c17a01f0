// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Distances between the boundary of a mesh and a surface, and self-intersections, compared with brute force.
//
//   test_surface_distance [DATA_DIRECTORY]

#include "test_surfaces.h"

#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/certify_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/surface/self_intersections.h>
#include <CGAL/Mixed_mesh_3/surface_distance.h>
#include <CGAL/make_mixed_mesh_3.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#ifndef MIXED_MESH_3_DATA_DIR
#define MIXED_MESH_3_DATA_DIR "data"
#endif

namespace test_surface_distance {

using namespace CGAL::Mixed_meshes_3;

using Mesh = CGAL::Mixed_mesh_3<Test_kernel>;
using Points = std::vector<Vec3>;

Points cube()
{
  return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
}

bool is_close(double a, double b, double tolerance) { return std::abs(a - b) <= tolerance; }

void add(Mesh& mesh, Element_kind kind, const Points& points)
{
  std::vector<Vertex_index> v;
  for(const Vec3& p : points)
    v.push_back(mesh.add_vertex({p[0], p[1], p[2]}));
  mesh.add_element(kind, v);
}

// A mesh whose boundary is the surface: tetrahedra around a point from which the whole surface is visible.
Mesh solid(const Test_surface& surface, const Test_point& center)
{
  Mesh mesh;
  for(auto v : vertices(surface))
    mesh.add_vertex(surface.point(v));
  const Vertex_index c = mesh.add_vertex(center);
  for(auto f : faces(surface)) {
    std::vector<Vertex_index> v{c};
    for(auto u : vertices_around_face(halfedge(f, surface), surface))
      v.push_back(Vertex_index(u));
    mesh.add_element(TETRAHEDRON, v);
  }
  BOOST_TEST_EQ(boundary_faces(mesh).size(), surface.number_of_faces());
  BOOST_TEST_GT(volume(mesh), 0.);
  return mesh;
}

// The surface with each triangle split into four, n times.
Test_surface refined(Test_surface s, int n)
{
  for(; n > 0; --n) {
    Test_surface r;
    for(auto v : vertices(s))
      r.add_vertex(s.point(v));
    using Vertex = Test_surface::Vertex_index;
    std::map<std::pair<Vertex, Vertex>, Vertex> middles;
    for(auto f : faces(s)) {
      std::vector<Vertex> v, m;
      for(auto u : vertices_around_face(halfedge(f, s), s))
        v.push_back(u);
      for(std::size_t i = 0; i < 3; ++i) {
        const auto edge = std::minmax(v[i], v[(i + 1) % 3]);
        auto found = middles.find(edge);
        if(found == middles.end())
          found = middles
                    .emplace(edge, r.add_vertex(CGAL::midpoint(s.point(edge.first), s.point(edge.second))))
                    .first;
        m.push_back(found->second);
      }
      for(std::size_t i = 0; i < 3; ++i)
        r.add_face(v[i], m[i], m[(i + 2) % 3]);
      r.add_face(m[0], m[1], m[2]);
    }
    s = r;
  }
  return s;
}

double brute_force_distance(const Test_point& p, const Test_surface& surface)
{
  double d = std::numeric_limits<double>::infinity();
  for(auto f : faces(surface)) {
    std::vector<Test_point> t;
    for(auto u : vertices_around_face(halfedge(f, surface), surface))
      t.push_back(surface.point(u));
    d = (std::min)(d, CGAL::squared_distance(p, Test_kernel::Triangle_3(t[0], t[1], t[2])));
  }
  return std::sqrt(d);
}

// Lower and upper bound from n (n + 1) / 2 points on each triangle.
std::pair<double, double> sampled_distance(const Test_surface& from, const Test_surface& to, int n)
{
  double largest = 0, longest = 0;
  for(auto f : faces(from)) {
    std::vector<Test_point> t;
    for(auto u : vertices_around_face(halfedge(f, from), from))
      t.push_back(from.point(u));
    for(int i = 0; i < 3; ++i)
      longest = (std::max)(longest, std::sqrt(CGAL::squared_distance(t[i], t[(i + 1) % 3])));
    for(int i = 0; i <= n; ++i)
      for(int j = 0; i + j <= n; ++j)
        largest = (std::max)(largest, brute_force_distance(t[0] + double(i) / n * (t[1] - t[0])
                                                             + double(j) / n * (t[2] - t[0]),
                                                           to));
  }
  return {largest, largest + longest / n};
}

void check_one_sided(const One_sided_distance& d, const Test_surface& from, const Test_surface& to, int n)
{
  const auto [lower, upper] = sampled_distance(from, to, n);
  BOOST_TEST_LE(lower, d.distance + d.error + 1e-12);
  BOOST_TEST_LE(d.distance, upper + 1e-12);
  BOOST_TEST(is_close(std::sqrt(CGAL::squared_distance(d.from, d.to)), d.distance, 1e-12));
  BOOST_TEST_LE(brute_force_distance(d.from, from), 1e-12);
  BOOST_TEST(is_close(brute_force_distance(d.from, to), d.distance, 1e-12));
}

Hausdorff_distance check_hausdorff(const Test_surface& boundary, const Test_surface& surface, int n)
{
  const Hausdorff_distance d = hausdorff_distance(solid(boundary, {0.5, 0.5, 0.5}), surface);
  check_one_sided(d.from_mesh, boundary, surface, n);
  check_one_sided(d.from_surface, surface, boundary, n);
  BOOST_TEST_EQ(d.distance(), (std::max)(d.from_mesh.distance, d.from_surface.distance));
  return d;
}

void test_hausdorff_distance()
{
  const Test_surface unit = box({0, 0, 0}, {1, 1, 1});
  Hausdorff_distance d = check_hausdorff(unit, box({-0.5, -0.5, -0.5}, {1.5, 1.5, 1.5}), 8);
  BOOST_TEST(is_close(d.from_mesh.distance, 0.5, 1e-15));
  BOOST_TEST(is_close(d.from_surface.distance, 0.5 * std::sqrt(3.), 1e-15));
  for(double x : {d.from_surface.from.x(), d.from_surface.from.y(), d.from_surface.from.z()})
    BOOST_TEST(x == -0.5 || x == 1.5);
  d = check_hausdorff(unit, box({0.25, 0, 0}, {1.25, 1, 1}), 8);
  BOOST_TEST(is_close(d.from_mesh.distance, 0.25, 1e-15));
  BOOST_TEST(is_close(d.from_surface.distance, 0.25, 1e-15));

  // Surfaces that coincide, where CGAL 5.5 fails.
  for(int n : {0, 1, 4}) {
    const Test_surface fine = refined(unit, n);
    for(const auto& [a, b] : {std::make_pair(unit, fine), std::make_pair(fine, unit)}) {
      d = hausdorff_distance(solid(a, {0.5, 0.5, 0.5}), b);
      BOOST_TEST_EQ(d.distance(), 0.);
      BOOST_TEST_LE(d.from_mesh.error, 1.01e-4 * std::sqrt(3.));
      BOOST_TEST_LE(d.from_surface.error, 1.01e-4 * std::sqrt(3.));
    }
  }

  // The spheres are concentric. The vertices of the outer one are farthest, and the centers of the faces of
  // the octahedron within.
  const Test_point center(0.5, 0.5, 0.5);
  d = check_hausdorff(sphere(center, 1, 8), sphere(center, 2, 8), 4);
  BOOST_TEST(is_close(d.from_surface.distance, 1, 1e-14));
  d = check_hausdorff(sphere(center, 1, 2), sphere(center, 1, 12), 6);
  BOOST_TEST(is_close(d.from_mesh.distance, 1 - std::sqrt(1. / 3), 0.02));

  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-0.1, 0.1);
  for(int repeat = 0; repeat < 5; ++repeat) {
    Test_surface a = sphere(center, 1, 5), b = sphere(center, 1.1, 6);
    for(Test_surface* s : {&a, &b})
      for(auto v : vertices(*s))
        s->point(v) = s->point(v) + Test_kernel::Vector_3(uniform(random), uniform(random), uniform(random));
    d = check_hausdorff(a, b, 8);
    BOOST_TEST_LE(d.from_mesh.error, 1.01e-4 * 2.4 * std::sqrt(3.));

    // The distance is right in any unit, anywhere; to the last bit for powers of 2.
    for(double scale : {std::ldexp(1., -40), std::ldexp(1., 40)}) {
      Test_surface c = a, e = b;
      for(Test_surface* s : {&c, &e})
        for(auto v : vertices(*s))
          s->point(v) = CGAL::ORIGIN + scale * (s->point(v) - CGAL::ORIGIN);
      const Test_kernel::Vector_3 middle = scale * (center - CGAL::ORIGIN);
      BOOST_TEST_EQ(hausdorff_distance(solid(c, CGAL::ORIGIN + middle), e).distance(), scale * d.distance());
    }
    Test_surface c = a, e = b;
    const Test_kernel::Vector_3 far(1e6, -1e6, 1e6);
    for(Test_surface* s : {&c, &e})
      for(auto v : vertices(*s))
        s->point(v) = s->point(v) + far;
    BOOST_TEST(is_close(hausdorff_distance(solid(c, center + far), e).distance(), d.distance(), 5e-4));
  }

  // A triangle without area in the surface.
  Test_surface tetrahedron;
  const auto a = tetrahedron.add_vertex({0, 0, 0}), b = tetrahedron.add_vertex({2, 0, 0}),
             c = tetrahedron.add_vertex({0, 2, 0}), e = tetrahedron.add_vertex({0, 0, 2}),
             m = tetrahedron.add_vertex({1, 0, 0});
  tetrahedron.add_face(a, m, e), tetrahedron.add_face(m, b, e), tetrahedron.add_face(b, m, a);
  tetrahedron.add_face(a, c, b), tetrahedron.add_face(b, c, e), tetrahedron.add_face(a, e, c);
  BOOST_TEST(CGAL::is_closed(tetrahedron));
  d = hausdorff_distance(solid(unit, center), tetrahedron);
  BOOST_TEST(is_close(d.from_mesh.distance, std::sqrt(1. / 3), 1e-12)); // the corner (1, 1, 1)
  BOOST_TEST(is_close(d.from_surface.distance, 1, 1e-12));              // the vertices at 2

  // Other kernels, other surfaces.
  using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
  CGAL::Mixed_mesh_3<Exact> exact;
  for(const Vec3& p : cube())
    exact.add_vertex({p[0], p[1], p[2]});
  exact.add_element(HEXAHEDRON, {0, 1, 2, 3, 4, 5, 6, 7});
  CGAL::Polyhedron_3<CGAL::Simple_cartesian<double>> polyhedron;
  CGAL::copy_face_graph(unit, polyhedron);
  BOOST_TEST_EQ(hausdorff_distance(exact, polyhedron).distance(), 0.);
  BOOST_TEST_EQ(number_of_vertices_off_surface(exact, polyhedron), 0u);
  BOOST_TEST_EQ(number_of_boundary_self_intersections(exact), 0u);
  // The map puts the surface elsewhere.
  Test_surface moved = unit;
  auto map = moved.add_property_map<Test_surface::Vertex_index, Test_point>("elsewhere").first;
  for(auto v : vertices(moved))
    map[v] = moved.point(v) + Test_kernel::Vector_3(0, 0, 3);
  const auto np = CGAL::parameters::vertex_point_map(map);
  BOOST_TEST_EQ(hausdorff_distance(exact, moved, 1e-4, np).distance(), 3.);
  BOOST_TEST_EQ(number_of_vertices_off_surface(exact, moved, 1e-9, np), 8u);
}

void test_vertices_off_surface()
{
  const Test_surface surface = sphere({0, 0, 0}, 1, 10);
  Mesh mesh = solid(surface, {0, 0, 0}); // the vertex at the center is not on the boundary
  BOOST_TEST_EQ(number_of_vertices_off_surface(mesh, surface), 0u);
  const double diagonal = 2 * std::sqrt(3.);
  const auto lift = [&](Vertex_index v, double by) {
    mesh.points()[v] = mesh.point(v) + by * (mesh.point(v) - CGAL::ORIGIN);
  };
  lift(0, 1e-11 * diagonal);
  BOOST_TEST_EQ(number_of_vertices_off_surface(mesh, surface), 0u);
  for(Vertex_index v : {3, 50, 100})
    lift(v, 1e-8 * diagonal);
  BOOST_TEST_EQ(number_of_vertices_off_surface(mesh, surface), 3u);
  BOOST_TEST_EQ(number_of_vertices_off_surface(mesh, surface, 1e-7), 0u);
  BOOST_TEST_EQ(number_of_vertices_off_surface(mesh, surface, 1e-12), 4u);
}

// Slabs of several threads find the vertices that one thread finds without slabs.
void test_slabs()
{
  using internal::vertices_of_self_intersections;
  const Mesh mesh = solid(sphere({0, 0, 0}, 1, 50), {0, 0, 0});
  const std::vector<Face> faces = boundary_faces(mesh);
  BOOST_TEST_GT(faces.size(), 3000u);
  std::vector<Vec3> points;
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
    points.push_back(to_vec3(mesh.point(v)));
  for(unsigned threads : {1, 2, 5})
    BOOST_TEST(vertices_of_self_intersections(points, faces, threads).empty());
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-0.03, 0.03); // up to half of an edge
  for(Vec3& p : points)
    for(double& x : p)
      x += uniform(random);
  const std::vector<Vertex_index> crossing = vertices_of_self_intersections(points, faces);
  BOOST_TEST(crossing.size() > 10 && crossing.size() < points.size());
  BOOST_TEST(std::is_sorted(crossing.begin(), crossing.end()));
  for(unsigned threads : {2, 3, 5})
    BOOST_TEST(vertices_of_self_intersections(points, faces, threads) == crossing);
  // A face that cuts all slabs.
  const auto far = std::size_t(faces.front().vertices()[0]);
  points[far] = Vec3{3, 3, 3} - 4 * points[far];
  const std::vector<Vertex_index> more = vertices_of_self_intersections(points, faces);
  BOOST_TEST(more != crossing);
  for(unsigned threads : {2, 3, 5})
    BOOST_TEST(vertices_of_self_intersections(points, faces, threads) == more);
}

// A search that tests only pairs of triangles that have moved finds what one of all pairs finds.
void test_repeated_search()
{
  const Mesh mesh = solid(sphere({0, 0, 0}, 1, 50), {0, 0, 0});
  auto triangles = internal::triangles_of_faces(boundary_faces(mesh));
  std::vector<Vec3> points;
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
    points.push_back(to_vec3(mesh.point(v)));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-0.06, 0.06); // up to an edge
  std::size_t most = 0;
  internal::Self_intersections one, several;
  for(int round = 0; round < 40; ++round) {
    // Some vertices move, or return, which makes triangles cut others, or no longer; once all do, once one.
    const std::size_t step = round == 20 ? 1 : round == 30 ? points.size() : 1 + random() % 500;
    for(std::size_t v = random() % step; v < points.size(); v += step) {
      points[v] = to_vec3(mesh.point(Vertex_index(v)));
      if(round % 3 != 0)
        for(double& x : points[v])
          x += uniform(random);
    }
    if(round == 35) // other triangles
      triangles.resize(triangles.size() / 2);
    const std::vector<Vertex_index> all = internal::vertices_of_self_intersections(points, triangles);
    BOOST_TEST(one.vertices(points, triangles, 1) == all);
    BOOST_TEST(several.vertices(points, triangles, 3) == all);
    most = (std::max)(most, all.size());
  }
  BOOST_TEST_GT(most, 10u);
}

void test_self_intersections()
{
  const Test_surface surface = sphere({0, 0, 0}, 1, 8);
  Mesh mesh = solid(surface, {0, 0, 0});
  BOOST_TEST_EQ(number_of_boundary_self_intersections(mesh), 0u);
  mesh.points()[20] = mesh.point(20) - 2.5 * (mesh.point(20) - CGAL::ORIGIN); // out on the other side
  BOOST_TEST_GT(number_of_boundary_self_intersections(mesh), 0u);

  // Two tetrahedra that overlap, but are not connected: as many pairs as brute force finds.
  const Points first{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}},
    second{{0.3, 0.3, 0.1}, {3, 0.4, 0.2}, {0.2, 3, 0.3}, {0.1, 0.2, 3}};
  for(double shift : {0., 0.4, 5.}) {
    mesh.clear();
    add(mesh, TETRAHEDRON, first);
    Points moved = second;
    for(Vec3& p : moved)
      p[0] += shift;
    add(mesh, TETRAHEDRON, moved);
    std::size_t expected = 0;
    const auto triangle = [&](std::size_t e, const Element_face& f) {
      const auto point = [&](int i) { return mesh.point(mesh.element(e)[f.vertices[i]]); };
      return Test_kernel::Triangle_3(point(0), point(1), point(2));
    };
    for(const Element_face *f = reference_elements[TETRAHEDRON].faces, *end = f + 4; f != end; ++f)
      for(const Element_face* g = end - 4; g != end; ++g)
        expected += CGAL::do_intersect(triangle(0, *f), triangle(1, *g));
    BOOST_TEST((expected == 0) == (shift == 5));
    BOOST_TEST_EQ(number_of_boundary_self_intersections(mesh), expected);
    // The mesh has no other defects.
    const Mesh_certificate certificate = certify_mesh(mesh);
    BOOST_TEST(certificate.defects.none());
    BOOST_TEST_EQ(certificate.number_of_self_intersections, expected);
    BOOST_TEST_EQ(certificate.is_valid(), expected == 0);
    for(const Mesh_certificate::Check& check : certificate.checks())
      BOOST_TEST_EQ(check.holds,
                    expected == 0 || std::string(check.name) != "boundary does not cut itself (exact)");
  }
  BOOST_TEST(certify_mesh(mesh).is_valid());
  std::swap(mesh.points()[0], mesh.points()[1]); // an element is inverted
  BOOST_TEST(!certify_mesh(mesh).is_valid());
  BOOST_TEST(certify_mesh(Mesh()).is_valid());

  // Elements share a face, or an edge only: the boundary touches itself.
  mesh.clear();
  for(const Vec3& p :
      Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {-1, 0, 0}, {-1, -1, 0.5}})
    mesh.add_vertex({p[0], p[1], p[2]});
  mesh.add_element(TETRAHEDRON, {0, 1, 2, 3});
  mesh.add_element(TETRAHEDRON, {1, 2, 3, 4});
  BOOST_TEST_EQ(number_of_boundary_self_intersections(mesh), 0u);
  mesh.add_element(TETRAHEDRON, {0, 3, 5, 6});
  BOOST_TEST_GT(number_of_boundary_self_intersections(mesh), 0u);
}

// The brain before its boundary is fitted, compared with CGAL's distance.
void test_brain(const std::string& data)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  Test_surface brain, region, boundary;
  BOOST_TEST(CGAL::IO::read_polygon_mesh(data + "/brain.off", brain));
  BOOST_TEST(CGAL::IO::read_polygon_mesh(data + "/region.off", region));
  Mesh mesh;
  BOOST_TEST(CGAL::make_mixed_mesh_3(CGAL::Polyhedral_mixed_mesh_domain_3(brain),
                                     CGAL::Polyhedral_mixed_mesh_region_3(region),
                                     CGAL::Mixed_mesh_criteria_3(660).fit_to_surface(false), mesh)
               .has_mesh());
  const Hausdorff_distance d = hausdorff_distance(mesh, brain);
  BOOST_TEST_EQ(number_of_boundary_self_intersections(mesh), 0u);
  BOOST_TEST_GT(number_of_vertices_off_surface(mesh, brain), 100u);

  std::map<Vertex_index, Test_surface::Vertex_index> vertices;
  for(const auto& f : boundary_faces(mesh)) {
    std::vector<Test_surface::Vertex_index> v;
    for(Vertex_index u : f.vertices()) {
      if(vertices.count(u) == 0)
        vertices[u] = boundary.add_vertex(mesh.point(u));
      v.push_back(vertices[u]);
    }
    boundary.add_face(v);
  }
  BOOST_TEST(CGAL::is_triangle_mesh(boundary) && CGAL::is_closed(boundary)); // no quadrilateral by default
  const auto peer = [](const Test_surface& a, const Test_surface& b) {
    return PMP::bounded_error_Hausdorff_distance<CGAL::Sequential_tag>(a, b, 0.01);
  };
  BOOST_TEST(is_close(d.from_mesh.distance, peer(boundary, brain), 0.04));
  BOOST_TEST(is_close(d.from_surface.distance, peer(brain, boundary), 0.04));
}

int run(int argc, char* argv[])
{
  test_hausdorff_distance();
  test_vertices_off_surface();
  test_self_intersections();
  test_slabs();
  test_repeated_search();
  test_brain(argc > 1 ? argv[1] : MIXED_MESH_3_DATA_DIR);
  return boost::report_errors();
}

} // namespace test_surface_distance
