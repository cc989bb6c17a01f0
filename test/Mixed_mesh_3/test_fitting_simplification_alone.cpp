// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Simplification as a stage alone, simplify_mixed_mesh_3(): topology, validity, sharp edges, the distance and
// the quality bound hold for meshes of the mesher and for meshes of others.

#include "test_fitting.h"
#include "test_surfaces.h"
#include "test_topology.h"

#include <CGAL/Labeled_polyhedral_mixed_mesh_domain_3.h>
#include <CGAL/Mixed_mesh_3/interfaces.h>
#include <CGAL/Mixed_mesh_3/internal/elements/shell_counts.h>
#include <CGAL/Mixed_mesh_3/internal/surface/self_intersections.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/validation.h>
#include <CGAL/make_mixed_mesh_3.h>
#include <CGAL/simplify_mixed_mesh_3.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace test_fitting_simplification_alone {

using namespace CGAL::Mixed_meshes_3;
using brute_force::topology;
using Criteria = CGAL::Mixed_mesh_simplification_criteria_3;
using Result = CGAL::Mixed_mesh_simplification_result_3;
using Status = CGAL::Mixed_mesh_simplification_status;

Test_surface torus(double radius, double tube, int n, int m)
{
  Test_surface s;
  std::vector<Test_surface::Vertex_index> v;
  for(int i = 0; i < n; ++i)
    for(int j = 0; j < m; ++j) {
      const double a = 2 * CGAL_PI * i / n, b = 2 * CGAL_PI * j / m, r = radius + tube * std::cos(b);
      v.push_back(s.add_vertex(Test_point(r * std::cos(a), r * std::sin(a), tube * std::sin(b))));
    }
  for(int i = 0; i < n; ++i)
    for(int j = 0; j < m; ++j) {
      const auto at = [&](int k, int l) { return v[std::size_t((i + k) % n * m + (j + l) % m)]; };
      s.add_face(at(0, 0), at(1, 0), at(1, 1));
      s.add_face(at(0, 0), at(1, 1), at(0, 1));
    }
  return s;
}

// A prism over a regular polygon, whose upper and lower rim are sharp.
Test_surface cylinder(double radius, double height, int n)
{
  Test_surface s;
  std::vector<Test_surface::Vertex_index> v[2];
  for(int i = 0; i < n; ++i)
    for(int k = 0; k < 2; ++k)
      v[k].push_back(s.add_vertex(Test_point(radius * std::cos(2 * CGAL_PI * i / n),
                                             radius * std::sin(2 * CGAL_PI * i / n), k * height)));
  const auto low = s.add_vertex(Test_point(0, 0, 0)), high = s.add_vertex(Test_point(0, 0, height));
  for(std::size_t i = 0; i < std::size_t(n); ++i) {
    const std::size_t j = (i + 1) % std::size_t(n);
    s.add_face(v[0][i], v[0][j], v[1][j]);
    s.add_face(v[0][i], v[1][j], v[1][i]);
    s.add_face(low, v[0][j], v[0][i]);
    s.add_face(high, v[1][i], v[1][j]);
  }
  return s;
}

// A mesh as the first stages make it.
Mesh fine_mesh(const Test_surface& surface, std::size_t number_of_vertices)
{
  Mesh mesh;
  BOOST_TEST(CGAL::make_mixed_mesh_3(
               surface,
               CGAL::Mixed_mesh_criteria_3(number_of_vertices).simplification(false).only_tetrahedra(true),
               mesh)
               .has_mesh());
  return mesh;
}

// The largest distance of a boundary vertex of the start from the boundary: by brute force.
double distance_of_places(const Mesh& start, const Mesh& mesh)
{
  using Kernel = Test_kernel;
  std::vector<Kernel::Triangle_3> triangles;
  for(const auto& t : internal::triangles_of_faces(boundary_faces(mesh)))
    triangles.emplace_back(mesh.point(t[0]), mesh.point(t[1]), mesh.point(t[2]));
  const std::vector<bool> is_outer = is_on_boundary(start);
  double largest = 0;
  for(Vertex_index v = 0; v < start.number_of_vertices(); ++v)
    if(is_outer[v]) {
      double least = std::numeric_limits<double>::infinity();
      for(const auto& t : triangles)
        least = (std::min)(least, CGAL::squared_distance(start.point(v), t));
      largest = (std::max)(largest, least);
    }
  return std::sqrt(largest);
}

double worst_cost(const Mesh& mesh) { return quality_statistics(mesh).back().maximum; }

// Properties that all results have.
void test_result(const Mesh& start, const Mesh& mesh, const Result& result, double bound)
{
  BOOST_TEST_EQ(result.number_of_vertices, mesh.number_of_vertices());
  BOOST_TEST_EQ(result.number_of_collapses, start.number_of_vertices() - mesh.number_of_vertices());
  BOOST_TEST(find_defects(mesh).none());
  BOOST_TEST(result.is_boundary_simple);
  BOOST_TEST(!internal::cuts_itself(mesh));
  const auto before = internal::shells_of_boundary(start), after = internal::shells_of_boundary(mesh);
  BOOST_TEST_EQ(before.euler_characteristic, after.euler_characteristic);
  BOOST_TEST_EQ(before.number_of_shells, after.number_of_shells);
  BOOST_TEST(before.number_of_cavities == after.number_of_cavities);
  BOOST_TEST_LE(worst_cost(mesh), (std::max)(bound, worst_cost(start)));
  std::vector<Test_point> points(start.points()), rest(mesh.points());
  std::sort(points.begin(), points.end());
  std::sort(rest.begin(), rest.end());
  BOOST_TEST(std::includes(points.begin(), points.end(), rest.begin(), rest.end()));
}

// The number is reached exactly; a number that is too small is not, and nothing is given up for it.
void test_number()
{
  for(const Test_surface& surface : {sphere(Test_point(0, 0, 0), 1, 12), torus(1, 0.4, 30, 14)}) {
    const Mesh start = fine_mesh(surface, 2000);
    for(std::size_t n : {1200, 600, 300}) {
      Mesh mesh = start, again = start;
      const Result result = CGAL::simplify_mixed_mesh_3(mesh, surface, n);
      BOOST_TEST(result.status == Status::SUCCESS);
      BOOST_TEST_EQ(mesh.number_of_vertices(), n);
      test_result(start, mesh, result, 3.2);
      CGAL::simplify_mixed_mesh_3(again, surface, n);
      BOOST_TEST(is_same(mesh, again));
    }
    Mesh mesh = start;
    const double distance = 0.02;
    const Result result = CGAL::simplify_mixed_mesh_3(mesh, surface, Criteria(10).distance(distance));
    BOOST_TEST(result.status == Status::NUMBER_NOT_REACHED);
    BOOST_TEST_GT(mesh.number_of_vertices(), 10u);
    BOOST_TEST_LE(distance_of_places(start, mesh), distance);
    test_result(start, mesh, result, 3.2);
  }
}

// No place is farther than the distance, a larger distance needs no more vertices, nearly, as each collapse
// is the best one at its time, and the number alone exceeds the distance.
void test_distance()
{
  const Test_surface surfaces[] = {sphere(Test_point(0, 0, 0), 1, 12), torus(1, 0.4, 30, 14),
                                   cylinder(1, 1, 40)};
  for(const Test_surface& surface : surfaces) {
    const Mesh start = fine_mesh(surface, 3000);
    std::size_t last = start.number_of_vertices();
    for(double distance : {0., 0.01, 0.02, 0.04, 0.08}) {
      Mesh mesh = start;
      const Result result = CGAL::simplify_mixed_mesh_3(mesh, surface, Criteria(0).distance(distance));
      BOOST_TEST(result.status == Status::SUCCESS);
      const double measured = distance_of_places(start, mesh);
      BOOST_TEST_LE(measured, distance + 1e-12);
      BOOST_TEST_LE(double(mesh.number_of_vertices()), 1.25 * double(last));
      last = mesh.number_of_vertices();
      test_result(start, mesh, result, 3.2);
      std::cout << "distance " << distance << ": " << start.number_of_vertices() << " to " << last
                << " vertices, measured " << measured << std::endl;
      if(distance == 0.01) {
        Mesh other = start;
        CGAL::simplify_mixed_mesh_3(other, surface, mesh.number_of_vertices() / 2);
        BOOST_TEST_GT(distance_of_places(start, other), distance);
      }
    }
  }
}

double deviation_of_volume(const Mesh& mesh) { return std::abs(volume(mesh) - 1); }

std::size_t number_of_corners(const Mesh& mesh)
{
  const auto is_end = [](double x) { return x == 0 || x == 1; };
  return std::size_t(std::count_if(mesh.points().begin(), mesh.points().end(), [&](const auto& p) {
    return is_end(p.x()) && is_end(p.y()) && is_end(p.z());
  }));
}

// The fewest vertices of a cube leave its corners and sharp edges; those without sharp edges do not.
void test_sharp_edges()
{
  const Test_surface cube = box(Test_point(0, 0, 0), Test_point(1, 1, 1));
  Mesh start = grid(8, TETRAHEDRON);
  distort(start, 0.01, 1);
  Mesh mesh = start;
  const Result result = CGAL::simplify_mixed_mesh_3(mesh, cube, 0);
  BOOST_TEST(result.status == Status::SUCCESS);
  BOOST_TEST_LE(deviation_of_volume(mesh), 1e-12);
  BOOST_TEST_EQ(number_of_corners(mesh), 8u);
  BOOST_TEST_LE(std::abs(result.length_of_sharp_edges_followed - 12), 1e-12);
  BOOST_TEST(topology(mesh) == topology(start));
  test_result(start, mesh, result, 3.2);

  Mesh round = start;
  const Result without = CGAL::simplify_mixed_mesh_3(round, cube, Criteria(0).sharp_angle(0));
  BOOST_TEST_EQ(without.length_of_sharp_edges_followed, 0);
  BOOST_TEST_GT(deviation_of_volume(round), 0.01);
  BOOST_TEST_LT(number_of_corners(round), 8u);
  std::cout << "cube: " << start.number_of_vertices() << " to " << mesh.number_of_vertices()
            << " vertices, without sharp edges " << round.number_of_vertices() << std::endl;

  // The rims of a cylinder stay closed.
  const Test_surface can = cylinder(1, 1, 40);
  const Mesh fine = fine_mesh(can, 3000);
  Mesh coarse = fine;
  const Result rims = CGAL::simplify_mixed_mesh_3(coarse, can, Criteria(0).distance(0.05));
  BOOST_TEST_GT(rims.length_of_sharp_edges_followed, 0.95 * 4 * CGAL_PI);
  test_result(fine, coarse, rims, 3.2);
}

std::array<std::size_t, 4> number_of_kinds(const Mesh& mesh)
{
  std::array<std::size_t, 4> numbers{};
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
    ++numbers[mesh.element(e).kind()];
  return numbers;
}

// Hexahedra, prisms and pyramids stay, also at the boundary.
void test_mixed_elements()
{
  const Test_surface brick = box(Test_point(0, 0, 0), Test_point(1, 1, 1));
  for(const Test_surface& surface : {sphere(Test_point(0, 0, 0), 1, 12), torus(1, 0.4, 30, 14)}) {
    Mesh start;
    BOOST_TEST(
      CGAL::make_mixed_mesh_3(surface, CGAL::Mixed_mesh_criteria_3(1500).simplification(false), start)
        .has_mesh());
    Mesh mesh = start;
    const Result result = CGAL::simplify_mixed_mesh_3(mesh, surface, Criteria(0).distance(0.05));
    BOOST_TEST(result.status == Status::SUCCESS);
    const auto before = number_of_kinds(start), after = number_of_kinds(mesh);
    BOOST_TEST_GT(before[HEXAHEDRON], 0u);
    for(Element_kind kind : {PYRAMID, PRISM, HEXAHEDRON})
      BOOST_TEST_EQ(before[kind], after[kind]);
    BOOST_TEST_GT(result.number_of_collapses, 100u);
    std::cout << "mixed: " << start.number_of_vertices() << " to " << mesh.number_of_vertices() << " vertices"
              << std::endl;
    test_result(start, mesh, result, 3.2);
  }
  // The boundary of hexahedra has quadrilaterals.
  Mesh cells = grid(3, HEXAHEDRON);
  const Mesh before = cells;
  const Result result = CGAL::simplify_mixed_mesh_3(cells, brick, 0);
  BOOST_TEST(result.status == Status::SUCCESS);
  BOOST_TEST_EQ(result.number_of_collapses, 0u);
  BOOST_TEST(is_same(cells, before));
}

// The mesh with attributes by the x-coordinate of the center of each element.
Mesh with_attributes(const Mesh& all, const std::function<void(double, Element_attributes&)>& set)
{
  Mesh mesh;
  mesh.points() = all.points();
  for(Element_index e = 0; e < all.number_of_elements(); ++e) {
    Element_attributes attributes;
    double x = 0;
    for(Vertex_index v : all.element(e))
      x += all.point(v).x() / all.element(e).size();
    set(x, attributes);
    mesh.add_element(all.element(e).kind(),
                     std::vector<Vertex_index>(all.element(e).begin(), all.element(e).end()), attributes);
  }
  return mesh;
}

// Interfaces of subdomains stay where they are, whether the surface has labels or not.
void test_subdomains()
{
  const Mesh start = with_attributes(grid(8, TETRAHEDRON), [](double x, Element_attributes& attributes) {
    attributes.subdomain_index = x < 0.5 ? 1 : 2;
  });
  const Test_surface cube = box(Test_point(0, 0, 0), Test_point(1, 1, 1)),
                     half = box(Test_point(0, 0, 0), Test_point(0.5, 1, 1));
  CGAL::Labeled_polyhedral_mixed_mesh_domain_3 labeled;
  labeled.add(half, 1);
  labeled.add(cube, 2);
  const auto test = [&](const Mesh& mesh, const Result& result) {
    test_result(start, mesh, result, 3.2);
    BOOST_TEST_LT(mesh.number_of_vertices(), start.number_of_vertices());
    for(Subdomain_index i : {1, 2})
      BOOST_TEST(topology(mesh, i) == topology(start, i));
    std::map<Subdomain_index, double> volumes;
    for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
      volumes[mesh.attributes(e).subdomain_index] += volume(mesh, e);
    BOOST_TEST_LE(std::abs(volumes[1] - 0.5), 1e-12);
    BOOST_TEST_LE(std::abs(volumes[2] - 0.5), 1e-12);
  };
  Mesh with_labels = start, without_labels = start;
  test(with_labels, CGAL::simplify_mixed_mesh_3(with_labels, labeled, 250));
  BOOST_TEST_EQ(with_labels.number_of_vertices(), 250u);
  test(without_labels, CGAL::simplify_mixed_mesh_3(without_labels, cube, 0));
  // No vertex between the subdomains leaves, as no surface tells where others might be.
  const auto between = [](const Mesh& mesh) {
    return std::count_if(mesh.points().begin(), mesh.points().end(),
                         [](const auto& p) { return p.x() == 0.5; });
  };
  BOOST_TEST_EQ(between(without_labels), between(start));
  BOOST_TEST_LT(between(with_labels), between(start));
}

// Vertices of the region stay.
void test_region()
{
  const Mesh start = with_attributes(grid(8, TETRAHEDRON), [](double x, Element_attributes& attributes) {
    attributes.is_in_region = x < 0.2;
  });
  const Test_surface cube = box(Test_point(0, 0, 0), Test_point(1, 1, 1));
  const auto inside = [](const Mesh& mesh) {
    return std::count_if(mesh.points().begin(), mesh.points().end(),
                         [](const auto& p) { return p.x() <= 0.125; });
  };
  Mesh graded = start, even = start;
  CGAL::simplify_mixed_mesh_3(graded, cube, Criteria(0).region_radius(0.3));
  CGAL::simplify_mixed_mesh_3(even, cube, 0);
  BOOST_TEST_EQ(inside(graded), inside(start));
  BOOST_TEST_LT(inside(even), inside(start));
}

struct Stopper : Default_visitor
{
  bool go_on() { return false; }
};

void test_statuses()
{
  const Test_surface cube = box(Test_point(0, 0, 0), Test_point(1, 1, 1));
  Mesh empty;
  BOOST_TEST(CGAL::simplify_mixed_mesh_3(empty, cube, 10).status == Status::EMPTY);
  Mesh inverted = grid(3, TETRAHEDRON);
  const auto inside = std::find_if(inverted.points().begin(), inverted.points().end(), [](const auto& p) {
    return p.x() > 0 && p.x() < 1 && p.y() > 0 && p.y() < 1 && p.z() > 0 && p.z() < 1;
  });
  *inside = Test_point(5, 5, 5);
  const Mesh before = inverted;
  const Result result = CGAL::simplify_mixed_mesh_3(inverted, cube, 10);
  BOOST_TEST(result.status == Status::INVALID_MESH);
  BOOST_TEST_EQ(result.number_of_vertices, before.number_of_vertices());
  BOOST_TEST(is_same(inverted, before));
  Stopper stopper;
  Mesh stopped = grid(3, TETRAHEDRON);
  BOOST_TEST(
    CGAL::simplify_mixed_mesh_3(stopped, cube, 10, CGAL::parameters::visitor(std::ref(stopper))).status
    == Status::STOPPED);
  BOOST_TEST(is_same(stopped, grid(3, TETRAHEDRON)));
  for(Status s :
      {Status::SUCCESS, Status::NUMBER_NOT_REACHED, Status::STOPPED, Status::INVALID_MESH, Status::EMPTY})
    BOOST_TEST_NE(std::string(description(s)), "");
}

int run(int, char*[])
{
  test_number();
  test_distance();
  test_sharp_edges();
  test_mixed_elements();
  test_subdomains();
  test_region();
  test_statuses();
  return boost::report_errors();
}

} // namespace test_fitting_simplification_alone
