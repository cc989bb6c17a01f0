// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scaled Jacobian, dihedral angles, warp, statistics; distance to a surface. Volumes and aspect-ratio
// coefficients are tested with the element traits.
//
//   test_quality [DATA_DIRECTORY]

#include "test_surfaces.h"

#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/quality.h>
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
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#ifndef MIXED_MESH_3_DATA_DIR
#define MIXED_MESH_3_DATA_DIR "data"
#endif

namespace {

using namespace CGAL::Mixed_meshes_3;
using CGAL::Mixed_meshes_3::Vec3;
using CGAL::Mixed_meshes_3::cross;
using CGAL::Mixed_meshes_3::dot;
using CGAL::Mixed_meshes_3::norm;

using Mesh = CGAL::Mixed_mesh_3<Test_kernel>;
using Points = std::vector<Vec3>;
using Measure = std::function<double(const Mesh&, std::size_t)>;

const std::vector<Measure> measures = {aspect_ratio_coefficient, scaled_jacobian, smallest_dihedral_angle,
                                       largest_dihedral_angle, quad_warp};

bool is_close(double a, double b, double tolerance) { return std::abs(a - b) <= tolerance; }

double degrees(double radians) { return radians * 180 / CGAL_PI; }

void add(Mesh& mesh, Element_kind kind, const Points& points)
{
  std::vector<Vertex_index> v;
  for(const Vec3& p : points)
    v.push_back(mesh.add_vertex({p[0], p[1], p[2]}));
  mesh.add_element(kind, v);
}

double value(const Measure& measure, Element_kind kind, const Points& points)
{
  Mesh mesh;
  add(mesh, kind, points);
  return measure(mesh, 0);
}

Points cube()
{
  return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
}

Points pyramid(double height)
{
  return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, height}};
}

Points prism(double height)
{
  const double h = std::sqrt(3.) / 2;
  return {{0, 0, 0}, {1, 0, 0}, {0.5, h, 0}, {0, 0, height}, {1, 0, height}, {0.5, h, height}};
}

// All edges are equal.
Points ideal(Element_kind kind)
{
  switch(kind) {
  case TETRAHEDRON: return {{1, 1, 1}, {1, -1, -1}, {-1, -1, 1}, {-1, 1, -1}};
  case PYRAMID: return pyramid(std::sqrt(0.5));
  case PRISM: return prism(1);
  default: return cube();
  }
}

void test_ideal_elements()
{
  // By kind. Triangles of the pyramid meet as in the regular octahedron.
  const double tetrahedron = degrees(std::acos(1. / 3)), base = degrees(std::acos(std::sqrt(1. / 3)));
  const double smallest[] = {tetrahedron, base, 60, 90}, largest[] = {tetrahedron, 2 * base, 90, 90};
  for(Element_kind kind : element_kinds) {
    const Points points = ideal(kind);
    BOOST_TEST_GT(value([](const Mesh& m, std::size_t e) { return volume(m, e); }, kind, points), 0.);
    BOOST_TEST(is_close(value(scaled_jacobian, kind, points), 1, 1e-14));
    BOOST_TEST(is_close(value(smallest_dihedral_angle, kind, points), smallest[kind], 1e-12));
    BOOST_TEST(is_close(value(largest_dihedral_angle, kind, points), largest[kind], 1e-12));
    BOOST_TEST(is_close(value(quad_warp, kind, points), 0, 1e-12));
  }
}

void test_distorted_elements()
{
  // A tetrahedron at the corner of a cube: the largest product of edges is at the other corners.
  const Points corner{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  BOOST_TEST(is_close(value(scaled_jacobian, TETRAHEDRON, corner), std::sqrt(0.5), 1e-15));
  BOOST_TEST(is_close(value(smallest_dihedral_angle, TETRAHEDRON, corner),
                      degrees(std::acos(std::sqrt(1. / 3))), 1e-12));
  BOOST_TEST(is_close(value(largest_dihedral_angle, TETRAHEDRON, corner), 90, 1e-12));

  // A sliver: two edges that nearly cross.
  const double h = 1e-3;
  const Points sliver{{-1, 0, 0}, {1, 0, 0}, {0, 1, h}, {0, -1, h}};
  BOOST_TEST(is_close(value(largest_dihedral_angle, TETRAHEDRON, sliver),
                      180 - 2 * degrees(std::atan(h)), 1e-9));
  BOOST_TEST(is_close(value(scaled_jacobian, TETRAHEDRON, sliver),
                      std::sqrt(2.) * 4 * h / (2 * (2 + h * h)), 1e-12));

  // A flat pyramid, of height 1/4: lateral edges are 3/4 long.
  BOOST_TEST(is_close(value(scaled_jacobian, PYRAMID, pyramid(0.25)),
                      2 * 0.25 / (std::sqrt(2.) * 0.75), 1e-15));
  // one of height 1: lateral edges of sqrt(3/2)
  BOOST_TEST(is_close(value(scaled_jacobian, PYRAMID, pyramid(1)), 2 - 2 / std::pow(1.5, 1.5), 1e-15));
  BOOST_TEST(is_close(value(smallest_dihedral_angle, PYRAMID, pyramid(0.5)), 45, 1e-12));
  for(double height : {0.1, 0.5, 0.9, 0.956, 1.1, 2., 10.})
    BOOST_TEST_LE(value(scaled_jacobian, PYRAMID, pyramid(height)), 1.);

  // The height of a prism and of a box does not matter.
  BOOST_TEST(is_close(value(scaled_jacobian, PRISM, prism(0.1)), 1, 1e-14));
  const Points right{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 2}, {1, 0, 2}, {0, 1, 2}};
  BOOST_TEST(is_close(value(scaled_jacobian, PRISM, right), std::sqrt(2. / 3), 1e-15));
  BOOST_TEST(is_close(value(smallest_dihedral_angle, PRISM, right), 45, 1e-12));

  // A corner of a cube moved along its diagonal: the determinant there is 1 - 3t.
  for(double t : {0.1, 0.25, 1. / 3, 0.5}) {
    Points points = cube();
    points[6] = {1 - t, 1 - t, 1 - t};
    const double edge = std::sqrt((1 - t) * (1 - t) + 2 * t * t);
    BOOST_TEST(is_close(value(scaled_jacobian, HEXAHEDRON, points),
                        (1 - 3 * t) / (edge * edge * edge), 1e-14));
  }

  // A sheared box keeps plane faces; the angle of the shear is the smallest.
  Points points = cube();
  for(Vec3& p : points)
    p[0] += p[2];
  BOOST_TEST(is_close(value(scaled_jacobian, HEXAHEDRON, points), std::sqrt(0.5), 1e-15));
  BOOST_TEST(is_close(value(smallest_dihedral_angle, HEXAHEDRON, points), 45, 1e-12));
  BOOST_TEST(is_close(value(largest_dihedral_angle, HEXAHEDRON, points), 135, 1e-12));
  BOOST_TEST(is_close(value(quad_warp, HEXAHEDRON, points), 0, 1e-12));

  // A pyramid's base lifted at two opposite corners: both triangles lean by the same angle.
  points = {{0, 0, 0.1}, {1, 0, -0.1}, {1, 1, 0.1}, {0, 1, -0.1}, {0.5, 0.5, 1}};
  BOOST_TEST(is_close(value(quad_warp, PYRAMID, points),
                      2 * degrees(std::atan(0.2 * std::sqrt(2.))), 1e-12));
  // One corner of a cube lifted: 36.9 degrees about the diagonal through it, 35.3 about the other one.
  points = cube();
  points[6][2] += 0.5;
  BOOST_TEST(is_close(value(quad_warp, HEXAHEDRON, points), degrees(std::acos(0.8)), 1e-12));
  // a prism twisted: its triangles stay plane
  points = prism(1);
  const Vec3 center{0.5, std::sqrt(3.) / 6, 0};
  for(int i = 3; i < 6; ++i) {
    const Vec3 r = points[i] - center;
    points[i] = center + Vec3{std::cos(0.3) * r[0] - std::sin(0.3) * r[1],
                              std::sin(0.3) * r[0] + std::cos(0.3) * r[1], 1};
  }
  BOOST_TEST_GT(value(quad_warp, PRISM, points), 10.);
}

void test_degenerate_elements()
{
  for(Element_kind kind : element_kinds) {
    // Inside out: mirrored. Jacobians change sign, angles a become 360 - a.
    Points points = ideal(kind);
    for(Vec3& p : points)
      p[2] = -p[2];
    BOOST_TEST(value(scaled_jacobian, kind, points) < -0.9);
    BOOST_TEST(is_close(value(largest_dihedral_angle, kind, points),
                        360 - value(smallest_dihedral_angle, kind, ideal(kind)), 1e-12));
    // flat
    points = ideal(kind);
    for(Vec3& p : points)
      p[2] = 0;
    BOOST_TEST(is_close(value(scaled_jacobian, kind, points), 0, 1e-15));
    // a point
    for(Vec3& p : points)
      p = {3, 2, 1};
    BOOST_TEST_EQ(value(scaled_jacobian, kind, points), 0.);
    BOOST_TEST_EQ(value(smallest_dihedral_angle, kind, points), 180.);
    BOOST_TEST_EQ(value(largest_dihedral_angle, kind, points), 180.);
    BOOST_TEST_EQ(value(quad_warp, kind, points), 0.);
  }
}

// Permutations of the vertices that map faces to faces and keep their orientation.
std::vector<std::vector<int>> symmetries(Element_kind kind)
{
  const Reference_element& reference = reference_elements[kind];
  const auto faces = [&](const std::vector<int>& permutation) {
    std::vector<std::vector<int>> result;
    for(int f = 0; f < reference.number_of_faces; ++f) {
      const Element_face& face = reference.faces[f];
      std::vector<int> v;
      for(int i = 0; i < face.size; ++i)
        v.push_back(permutation[face.vertices[i]]);
      std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
      result.push_back(v);
    }
    std::sort(result.begin(), result.end());
    return result;
  };
  std::vector<int> permutation(std::size_t(reference.number_of_vertices));
  std::iota(permutation.begin(), permutation.end(), 0);
  const auto expected = faces(permutation);
  std::vector<std::vector<int>> result;
  do {
    if(faces(permutation) == expected)
      result.push_back(permutation);
  } while(std::next_permutation(permutation.begin(), permutation.end()));
  return result;
}

void test_invariance(Element_kind kind)
{
  std::mt19937 random(17);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-0.1, 0.1);
  const auto group = symmetries(kind);
  const std::size_t orders[] = {12, 4, 6, 24};
  BOOST_TEST_EQ(group.size(), orders[kind]);
  for(int repeat = 0; repeat < 10; ++repeat) {
    Points points = ideal(kind);
    for(Vec3& p : points)
      for(double& x : p)
        x += uniform(random);
    Vec3 axis{normal(random), normal(random), normal(random)};
    axis = (1 / norm(axis)) * axis;
    const double angle = 6 * normal(random), c = std::cos(angle), s = std::sin(angle);
    const auto rotated = [&](const Vec3& p) { // Rodrigues
      return c * p + s * cross(axis, p) + (1 - c) * dot(axis, p) * axis;
    };
    for(const Measure& measure : measures) {
      const double expected = value(measure, kind, points);
      const auto check = [&](double tolerance, const auto& f) {
        Points moved = points;
        std::transform(moved.begin(), moved.end(), moved.begin(), f);
        BOOST_TEST(is_close(value(measure, kind, moved), expected, tolerance));
      };
      check(1e-10, rotated);
      for(double scale : {1e-6, 1e6})
        check(1e-10, [&](const Vec3& p) { return scale * p; });
      check(1e-3, [&](const Vec3& p) { return p + Vec3{1e8, -1e8, 1e8}; }); // vertices are rounded to 1.5e-8
      for(const std::vector<int>& permutation : group) {
        Points same;
        for(int i : permutation)
          same.push_back(points[std::size_t(i)]);
        BOOST_TEST(is_close(value(measure, kind, same), expected, 1e-10));
      }
    }
  }
}

void test_statistics_and_histogram()
{
  Mesh mesh;
  for(double height : {1., 2., 9.}) {
    Points points = cube();
    for(Vec3& p : points)
      p[2] *= height;
    add(mesh, HEXAHEDRON, points);
  }
  add(mesh, PYRAMID, pyramid(7));
  const Quality_table table = quality_statistics(mesh, aspect_ratio_coefficient, 1.3, 7);
  BOOST_TEST_EQ(table[TETRAHEDRON].count, 0u);
  BOOST_TEST_EQ(table[TETRAHEDRON].minimum, 0.);
  BOOST_TEST_EQ(table[HEXAHEDRON].count, 3u);
  BOOST_TEST_EQ(table[HEXAHEDRON].mean, 4.);
  BOOST_TEST_EQ(table[HEXAHEDRON].minimum, 1.);
  BOOST_TEST_EQ(table[HEXAHEDRON].maximum, 9.);
  BOOST_TEST_EQ(table[HEXAHEDRON].share, 1. / 3);
  BOOST_TEST_EQ(table.back().count, 4u);
  BOOST_TEST_EQ(table.back().mean, 19. / 4);
  BOOST_TEST_EQ(table.back().share, 0.5);
  BOOST_TEST_EQ(quality_statistics(mesh).back().share, 0.75);
  BOOST_TEST_EQ(quality_statistics(mesh, scaled_jacobian).back().share, 1.);
  const auto my_measure = [](const Mesh& m, std::size_t e) { return volume(m, e); };
  BOOST_TEST_EQ(quality_statistics(mesh, my_measure).back().maximum, 9.);
  BOOST_TEST_EQ(quality_statistics(Mesh(), my_measure).back().count, 0u);

  // Edges belong to the bin above them; nothing is left out.
  const auto counts = histogram(mesh, aspect_ratio_coefficient, {1, 2, 3, 7});
  BOOST_TEST((counts == std::vector<std::size_t>{0, 1, 1, 0, 2}));
  add(mesh, HEXAHEDRON, Points(8)); // infinite
  BOOST_TEST((histogram(mesh, aspect_ratio_coefficient, {1, 2, 3, 7})
              == std::vector<std::size_t>{0, 1, 1, 0, 3}));
  BOOST_TEST((histogram(mesh, aspect_ratio_coefficient, {}) == std::vector<std::size_t>{5}));
}

// A mesh whose boundary is the surface: tetrahedra around a point from which all of it is seen.
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
  mesh.set_boundary_faces(boundary_faces(mesh));
  BOOST_TEST_EQ(mesh.boundary_faces().size(), surface.number_of_faces());
  BOOST_TEST_GT(volume(mesh), 0.);
  return mesh;
}

// Each triangle into four, n times.
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
          found = middles.emplace(edge, r.add_vertex(CGAL::midpoint(s.point(edge.first),
                                                                    s.point(edge.second)))).first;
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
                                                           + double(j) / n * (t[2] - t[0]), to));
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

  // Concentric spheres. Of the outer one the vertices are farthest, of the octahedron within the centers
  // of its faces.
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

    // In any unit, anywhere; to the last bit for powers of 2.
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
  exact.set_boundary_faces(boundary_faces(exact));
  CGAL::Polyhedron_3<CGAL::Simple_cartesian<double>> polyhedron;
  CGAL::copy_face_graph(unit, polyhedron);
  BOOST_TEST_EQ(hausdorff_distance(exact, polyhedron).distance(), 0.);
  BOOST_TEST_EQ(number_of_vertices_off_surface(exact, polyhedron), 0u);
  BOOST_TEST_EQ(number_of_boundary_self_intersections(exact), 0u);
  // a map that puts the surface elsewhere
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

void test_self_intersections()
{
  const Test_surface surface = sphere({0, 0, 0}, 1, 8);
  Mesh mesh = solid(surface, {0, 0, 0});
  BOOST_TEST_EQ(number_of_boundary_self_intersections(mesh), 0u);
  mesh.points()[20] = mesh.point(20) - 2.5 * (mesh.point(20) - CGAL::ORIGIN); // out on the other side
  BOOST_TEST_GT(number_of_boundary_self_intersections(mesh), 0u);

  // Two tetrahedra that have nothing in common but space: as many pairs as brute force finds.
  const Points first{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}},
    second{{0.3, 0.3, 0.1}, {3, 0.4, 0.2}, {0.2, 3, 0.3}, {0.1, 0.2, 3}};
  for(double shift : {0., 0.4, 5.}) {
    mesh.clear();
    add(mesh, TETRAHEDRON, first);
    Points moved = second;
    for(Vec3& p : moved)
      p[0] += shift;
    add(mesh, TETRAHEDRON, moved);
    mesh.set_boundary_faces(boundary_faces(mesh));
    std::size_t expected = 0;
    const auto triangle = [&](std::size_t e, const Element_face& f) {
      const auto point = [&](int i) { return mesh.point(mesh.element(e)[f.vertices[i]]); };
      return Test_kernel::Triangle_3(point(0), point(1), point(2));
    };
    for(const Element_face* f = reference_elements[TETRAHEDRON].faces, *end = f + 4; f != end; ++f)
      for(const Element_face* g = end - 4; g != end; ++g)
        expected += CGAL::do_intersect(triangle(0, *f), triangle(1, *g));
    BOOST_TEST((expected == 0) == (shift == 5));
    BOOST_TEST_EQ(number_of_boundary_self_intersections(mesh), expected);
  }

  // Elements that share a face, and ones that share an edge only: the boundary touches itself.
  mesh.clear();
  for(const Vec3& p :
      Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {-1, 0, 0}, {-1, -1, 0.5}})
    mesh.add_vertex({p[0], p[1], p[2]});
  mesh.add_element(TETRAHEDRON, {0, 1, 2, 3});
  mesh.add_element(TETRAHEDRON, {1, 2, 3, 4});
  mesh.set_boundary_faces(boundary_faces(mesh));
  BOOST_TEST_EQ(number_of_boundary_self_intersections(mesh), 0u);
  mesh.add_element(TETRAHEDRON, {0, 3, 5, 6});
  mesh.set_boundary_faces(boundary_faces(mesh));
  BOOST_TEST_GT(number_of_boundary_self_intersections(mesh), 0u);
}

// The brain as it is before its boundary is fitted, against CGAL's distance.
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
  for(const auto& f : mesh.boundary_faces()) {
    std::vector<Test_surface::Vertex_index> v;
    for(Vertex_index u : internal::face_vertices(mesh.element(f.element), f.local_face))
      if(u != internal::no_vertex) {
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

} // namespace

int main(int argc, char** argv)
{
  test_ideal_elements();
  test_distorted_elements();
  test_degenerate_elements();
  for(Element_kind kind : element_kinds)
    test_invariance(kind);
  test_statistics_and_histogram();
  test_hausdorff_distance();
  test_vertices_off_surface();
  test_self_intersections();
  test_brain(argc > 1 ? argv[1] : MIXED_MESH_3_DATA_DIR);
  return boost::report_errors();
}
