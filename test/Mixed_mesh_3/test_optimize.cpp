// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// optimize_mixed_mesh_3() and its parts: gradients against differences, flips on integers, distorted meshes
// that must stay valid, each way to end, and the brain with all that is promised for it.
//
//   test_optimize [DATA_DIRECTORY]

#include "test_meshes.h"
#include "test_surfaces.h"

#include <CGAL/make_mixed_mesh_3.h>
#include <CGAL/optimize_mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Aspect_ratio_quality_3.h>
#include <CGAL/Mixed_mesh_3/Scaled_jacobian_quality_3.h>
#include <CGAL/Mixed_mesh_3/certificate.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/surface_distance.h>
#include <CGAL/Mixed_mesh_3/validation.h>

#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iostream>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#ifndef MIXED_MESH_3_DATA_DIR
#define MIXED_MESH_3_DATA_DIR "data"
#endif

namespace {

using namespace CGAL::Mixed_meshes_3;
using CGAL::Everywhere_mixed_mesh_region_3;
using CGAL::Mixed_mesh_criteria_3;
using CGAL::Mixed_mesh_optimization_result_3;
using CGAL::Polyhedral_mixed_mesh_domain_3;
using CGAL::Polyhedral_mixed_mesh_region_3;
using CGAL::make_mixed_mesh_3;
using CGAL::optimize_mixed_mesh_3;
using CGAL::Mixed_meshes_3::internal::Element_points;
using CGAL::Mixed_meshes_3::Vec3;
using Criteria = CGAL::Mixed_mesh_optimization_criteria_3;
using Status = CGAL::Mixed_mesh_optimization_status;

using Mesh = CGAL::Mixed_mesh_3<Test_kernel>;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double no_sliding = 1e100; // a cost that is never reached

// ---- quality models ----------------------------------------------------------------------------

Element_points reference_points(Element_kind kind, double r3, double height)
{
  Element_points p{};
  const Reference_element& r = reference_elements[kind];
  for(int i = 0; i < r.number_of_vertices; ++i) {
    const auto& c = r.coordinates[i];
    if(kind == TETRAHEDRON || kind == PRISM) // the barycentric triangle becomes equilateral
      p[i] = {c[0] + 0.5 * c[1], r3 / 2 * c[1], 0.5 * c[2]};
    else
      p[i] = {0.5 * c[0], 0.5 * c[1], 0.5 * c[2]};
  }
  if(kind == TETRAHEDRON)
    p[3] = {0.5, r3 / 6, std::sqrt(2. / 3)};
  if(kind == PYRAMID)
    p[4] = {0, 0, height};
  return p;
}

// All edges equal but for the height of the pyramid.
Element_points ideal(Element_kind kind, double height_of_pyramid)
{
  return reference_points(kind, std::sqrt(3.), height_of_pyramid);
}

template <class Quality>
void test_gradients(const Quality& quality, double height_of_pyramid, double ideal_tetrahedron, double ideal_prism,
                    const std::function<double(Element_kind, const Element_points&)>& bound)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  constexpr double h = 1e-6;
  std::size_t compared = 0, kinks = 0, inverted = 0;
  for(Element_kind kind : element_kinds) {
    const int n = reference_elements[kind].number_of_vertices;
    // the paper's constant is that of the regular tetrahedron but for a rounding
    const double best = kind == PRISM ? ideal_prism : kind == TETRAHEDRON ? ideal_tetrahedron : 1;
    BOOST_TEST_LE(std::abs(quality(kind, ideal(kind, height_of_pyramid)) - best), 1e-6);
    for(int repeat = 0; repeat < 400; ++repeat) {
      Element_points p = ideal(kind, height_of_pyramid);
      const double amplitude = 0.1 * (1 + repeat % 5), scale = std::ldexp(1, repeat % 7 - 3);
      for(int i = 0; i < n; ++i)
        for(double& x : p[i])
          x = scale * (x + amplitude * uniform(random));
      const double q = quality(kind, p);
      BOOST_TEST_GE(q, best - 1e-6);
      BOOST_TEST_GE(q * (1 + 1e-9), bound(kind, p));
      bool is_positive = true;
      for(int c = 0; c < reference_elements[kind].number_of_corners; ++c) {
        const auto& k = reference_elements[kind].corners[c];
        is_positive = is_positive
                      && determinant(internal::operator-(p[k[1]], p[k[0]]),
                                               internal::operator-(p[k[2]], p[k[0]]),
                                               internal::operator-(p[k[3]], p[k[0]])) > 0;
      }
      BOOST_TEST_EQ(q < infinity, is_positive);
      inverted += !is_positive;
      for(int v = 0; v < n; ++v) {
        Vec3 gradient{7, 7, 7};
        BOOST_TEST(quality(kind, p, v, gradient) == q);
        for(int k = 0; k < 3 && q < 50; ++k) {
          Element_points left = p, right = p;
          left[v][k] -= h * scale;
          right[v][k] += h * scale;
          const double dl = (q - quality(kind, left)) / h, dr = (quality(kind, right) - q) / h;
          if(std::abs(dr - dl) > 1e-4 * (q * q * q + std::abs(dl))) { // one measure gives way to another
            ++kinks;
            continue;
          }
          ++compared;
          BOOST_TEST_LE(std::abs(0.5 * (dl + dr) - scale * gradient[k]), 1e-6 * q * (10 + std::abs(dl)));
        }
      }
    }
  }
  BOOST_TEST_GT(compared, 10000u);
  BOOST_TEST_LT(kinks * 100, compared);
  BOOST_TEST_GT(inverted, 50u);
}

void test_qualities()
{
  const double tetrahedron = std::sqrt(72.) / 8.47867, prism = 2 / std::sqrt(3.);
  test_gradients(Aspect_ratio_quality_3(), 1, tetrahedron, prism, internal::aspect_ratio_coefficient);
  test_gradients(Aspect_ratio_quality_3(7, 0), 1, tetrahedron, prism, internal::aspect_ratio_coefficient);
  test_gradients(Scaled_jacobian_quality_3(), std::sqrt(0.5), 1, 1, [](Element_kind kind, const Element_points& p) {
    const double j = internal::scaled_jacobian(kind, p);
    return j > 0 ? 1 / j : 1;
  });
  // the cost of the second is the reciprocal, not less
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(-0.2, 0.2);
  for(Element_kind kind : element_kinds)
    for(int repeat = 0; repeat < 100; ++repeat) {
      Element_points p = ideal(kind, 0.4 + 0.01 * repeat);
      for(int i = 0; repeat > 0 && i < reference_elements[kind].number_of_vertices; ++i)
        for(double& x : p[i])
          x += uniform(random);
      const double j = internal::scaled_jacobian(kind, p);
      if(j > 0.01)
        BOOST_TEST_LE(std::abs(Scaled_jacobian_quality_3()(kind, p) * j - 1), 1e-12);
    }
  BOOST_TEST(Aspect_ratio_quality_3(3).is_acceptable(3) && !Aspect_ratio_quality_3(3).is_acceptable(3.1));
  BOOST_TEST(Scaled_jacobian_quality_3(3).is_acceptable(3) && !Scaled_jacobian_quality_3(3).is_acceptable(3.1));
}

// ---- helpers -----------------------------------------------------------------------------------

template <class Quality>
double worst_cost(const Mesh& mesh, const Quality& quality)
{
  double worst = 0;
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
    worst = (std::max)(worst, quality(mesh.element(e).kind(), internal::element_points(mesh, mesh.element(e))));
  return worst;
}

bool is_positive(const Mesh& mesh)
{
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
    if(jacobian_sign(mesh, e) != Jacobian_sign::POSITIVE)
      return false;
  return true;
}

bool is_same(const Mesh& a, const Mesh& b)
{
  return a.points() == b.points() && a.elements().kinds() == b.elements().kinds()
         && a.elements().connectivity() == b.elements().connectivity();
}

using Polygon = std::vector<Vertex_index>;

// From the smallest vertex on, with their orientation.
std::set<Polygon> boundary_of(const Mesh& mesh)
{
  std::set<Polygon> result;
  for(const auto& f : boundary_faces(mesh)) {
    const auto element = mesh.element(f.element);
    const Element_face& face = element.reference().faces[f.local_face];
    Polygon v;
    for(int i = 0; i < face.size; ++i)
      v.push_back(element[face.vertices[i]]);
    std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
    result.insert(v);
  }
  return result;
}

std::vector<bool> is_on_boundary(const Mesh& mesh)
{
  std::vector<bool> result(mesh.number_of_vertices());
  for(const Polygon& p : boundary_of(mesh))
    for(Vertex_index v : p)
      result[v] = true;
  return result;
}

// The elements that are no tetrahedra.
std::vector<Polygon> other_elements(const Mesh& mesh)
{
  std::vector<Polygon> result;
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
    if(mesh.element(e).kind() != TETRAHEDRON)
      result.emplace_back(mesh.element(e).begin(), mesh.element(e).end());
  return result;
}

// What holds for any valid start.
void check(const Mesh& before, const Mesh& after, const Mixed_mesh_optimization_result_3& result,
           const Test_surface& surface)
{
  BOOST_TEST(is_positive(before) && is_positive(after));
  BOOST_TEST_EQ(after.number_of_vertices(), before.number_of_vertices());
  BOOST_TEST(boundary_of(after) == boundary_of(before));
  BOOST_TEST(other_elements(after) == other_elements(before));
  BOOST_TEST(result.number_of_flips > 0 || after.elements().connectivity() == before.elements().connectivity());
  const Mesh_defects a = find_defects(before), b = find_defects(after);
  BOOST_TEST(b.none() || !a.none());
  if(!after.boundary_faces().empty())
    BOOST_TEST_EQ(after.boundary_faces().size(), boundary_of(after).size());
  Mesh with_boundary = after;
  with_boundary.set_boundary_faces(boundary_faces(after));
  BOOST_TEST_LE(number_of_vertices_off_surface(with_boundary, surface),
                result.number_of_boundary_vertices - result.number_of_arrived_vertices);
  const std::vector<bool> is_boundary = is_on_boundary(before);
  BOOST_TEST_EQ(result.number_of_boundary_vertices,
                std::size_t(std::count(is_boundary.begin(), is_boundary.end(), true)));
}

// n^3 cells in [0,1]^3, of elements of one kind.
Mesh grid(int n, Element_kind kind)
{
  return grid_of_cells<Mesh>(n, kind,
                             [&](double x, double y, double z) { return Test_point(x / n, y / n, z / n); });
}

// Moves inner vertices as far as all elements stay valid.
void distort(Mesh& mesh, double amplitude, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-amplitude, amplitude);
  const std::vector<bool> is_fixed = is_on_boundary(mesh);
  for(int round = 0; round < 3; ++round)
    for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
      if(!is_fixed[v]) {
        const Test_point old = mesh.point(v);
        const double x = uniform(random), y = uniform(random), z = uniform(random); // in this order
        mesh.points()[v] = old + Test_kernel::Vector_3(x, y, z);
        if(!is_positive(mesh))
          mesh.points()[v] = old;
      }
}

Test_surface unit_cube() { return box({0, 0, 0}, {1, 1, 1}); }

Test_surface ball_surface(double radius = 1) { return sphere({0.1, 0.2, 0.3}, radius, 12); }

// As the octree leaves it: its boundary outside the surface.
Mesh unfitted(const Test_surface& surface, std::size_t n)
{
  Mesh mesh;
  make_mixed_mesh_3(Polyhedral_mixed_mesh_domain_3(surface), Everywhere_mixed_mesh_region_3(),
                    Mixed_mesh_criteria_3(n).fit_to_surface(false), mesh);
  BOOST_TEST(!mesh.is_empty());
  return mesh;
}

// ---- flips -------------------------------------------------------------------------------------

// On integers, so that volumes are exact.
std::int64_t six_volumes(const Mesh& mesh)
{
  std::int64_t sum = 0;
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e) {
    std::int64_t d[3][3];
    for(int i = 0; i < 3; ++i)
      for(int k = 0; k < 3; ++k)
        d[i][k] = std::int64_t(mesh.point(mesh.element(e)[i + 1])[k]) - std::int64_t(mesh.point(mesh.element(e)[0])[k]);
    const std::int64_t v = d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1])
                           - d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0])
                           + d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
    BOOST_TEST_GT(v, 0);
    sum += v;
  }
  return sum;
}

// Vertices 0 and 1 on the axis, at -height and height, and n around it.
Mesh bipyramid(int n, int height)
{
  Mesh mesh;
  mesh.add_vertex({0, 0, double(-height)});
  mesh.add_vertex({0, 0, double(height)});
  for(int i = 0; i < n; ++i)
    mesh.add_vertex({std::round(100 * std::cos(2 * CGAL_PI * i / n)), std::round(100 * std::sin(2 * CGAL_PI * i / n)), 0});
  return mesh;
}

Mesh around_axis(int n, int height)
{
  Mesh mesh = bipyramid(n, height);
  for(int i = 0; i < n; ++i)
    mesh.add_element(TETRAHEDRON, {0, 1, Vertex_index(2 + i), Vertex_index(2 + (i + 1) % n)});
  return mesh;
}

bool has_edge(const Mesh& mesh, Vertex_index a, Vertex_index b)
{
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e) {
    const auto element = mesh.element(e);
    if(std::count(element.begin(), element.end(), a) && std::count(element.begin(), element.end(), b))
      return true;
  }
  return false;
}

// As if inside of a larger mesh, so that nothing is removed. Returns the number of flips, and checks that the
// elements fill the same volume.
std::size_t flip(Mesh& mesh)
{
  const Mesh before = mesh;
  BOOST_TEST(find_defects(before).none());
  internal::Working_mesh working(mesh, internal::boundary_polygons(mesh));
  const Aspect_ratio_quality_3 quality;
  internal::Tetrahedron_flipper flipper(working, quality);
  const auto is_on_boundary = std::exchange(working.is_on_boundary, std::vector<std::uint8_t>(mesh.number_of_vertices(), 0));
  std::set<Vertex_index> changed;
  const std::size_t flips = flipper.run(4, 1, [&](Vertex_index v) { changed.insert(v); });
  working.is_on_boundary = is_on_boundary;
  working.store(mesh);
  BOOST_TEST(find_defects(mesh).none());
  BOOST_TEST_EQ(six_volumes(mesh), six_volumes(before));
  BOOST_TEST(boundary_of(mesh) == boundary_of(before));
  BOOST_TEST(mesh.points() == before.points());
  BOOST_TEST_EQ(flips == 0, is_same(mesh, before));
  BOOST_TEST_EQ(flips == 0, changed.empty());
  const auto sum = [&](const Mesh& m) {
    double s = 0;
    for(std::size_t e = 0; e < m.number_of_elements(); ++e)
      s += std::pow(quality(TETRAHEDRON, internal::element_points(m, m.element(e))), 4);
    return s;
  };
  BOOST_TEST(flips == 0 || sum(mesh) < sum(before));
  BOOST_TEST(flips == 0 || mesh.boundary_faces().size() == boundary_of(mesh).size());
  return flips;
}

void test_flips()
{
  // 3-2, of a long edge; not of a short one, where 2-3 does the contrary
  Mesh mesh = around_axis(3, 120);
  BOOST_TEST_EQ(flip(mesh), 1u);
  BOOST_TEST_EQ(mesh.number_of_elements(), 2u);
  BOOST_TEST_EQ(flip(mesh), 0u);
  mesh = around_axis(3, 30);
  BOOST_TEST_EQ(flip(mesh), 0u);
  mesh = bipyramid(3, 30);
  mesh.add_element(TETRAHEDRON, {2, 3, 4, 1});
  mesh.add_element(TETRAHEDRON, {4, 3, 2, 0}, true);
  BOOST_TEST_EQ(flip(mesh), 1u);
  BOOST_TEST_EQ(mesh.number_of_elements(), 3u);
  BOOST_TEST(has_edge(mesh, 0, 1));
  for(int e = 0; e < 3; ++e) // the region takes what it met
    BOOST_TEST(mesh.is_in_region(std::size_t(e)));

  // 4-4, and rings of 5, 6, 7; larger ones stay
  for(int n = 4; n <= 8; ++n) {
    mesh = around_axis(n, 250);
    const std::size_t flips = flip(mesh);
    BOOST_TEST_EQ(flips > 0, n <= 7);
    BOOST_TEST_EQ(has_edge(mesh, 0, 1), n > 7);
    BOOST_TEST_EQ(int(mesh.number_of_elements()), n <= 7 ? 2 * (n - 2) : n);
  }

  // Not where the new elements would be inverted: vertex 2 is beyond the axis, and the ring not convex there.
  mesh = around_axis(4, 250);
  for(const Test_point& outside : {Test_point(-150, 0, 0), Test_point(-90, 0, 0)}) {
    Mesh bent = bipyramid(4, 250);
    bent.points()[2] = {10, 0, 0};
    bent.points()[4] = outside;
    bent.points()[3] = {-60, 100, 0};
    bent.points()[5] = {-60, -100, 0};
    for(Vertex_index i = 0; i < 4; ++i)
      bent.add_element(TETRAHEDRON, {0, 1, 2 + i, 2 + (i + 1) % 4});
    flip(bent);
  }

  // Random points in a cube, in each cell of which the edges are as they happen to be.
  for(unsigned seed = 1; seed <= 5; ++seed) {
    mesh = grid(4, TETRAHEDRON);
    for(Test_point& p : mesh.points())
      p = {std::round(4000 * p.x()), std::round(4000 * p.y()), std::round(4000 * p.z())};
    distort(mesh, 500, seed);
    for(Test_point& p : mesh.points()) // to integers
      p = {std::round(p.x()), std::round(p.y()), std::round(p.z())};
    if(is_positive(mesh))
      BOOST_TEST_GT(flip(mesh), 5u);
  }
}

// A flat tetrahedron on two pyramids, on whose common edge cd it lies: nothing can be flipped there.
void test_removal()
{
  for(double depth : {0.5, 0.05}) {
    Mesh mesh;
    for(const Test_point& p : {Test_point(-1, 0.5, 0), Test_point(1, 0.5, 0), Test_point(0, 0, -depth),
                               Test_point(0, 1, -depth), Test_point(0, 0, -1), Test_point(0, 1, -1)})
      mesh.add_vertex(p);
    mesh.add_element(TETRAHEDRON, {0, 1, 2, 3});
    mesh.add_element(PYRAMID, {2, 3, 5, 4, 0});
    mesh.add_element(PYRAMID, {2, 4, 5, 3, 1});
    BOOST_TEST(find_defects(mesh).none());
    const double whole = volume(mesh);
    internal::Working_mesh working(mesh, internal::boundary_polygons(mesh));
    const Aspect_ratio_quality_3 quality;
    internal::Tetrahedron_flipper flipper(working, quality);
    const std::size_t flips = flipper.run(4, 1.4, [](Vertex_index) {});
    BOOST_TEST_EQ(flips, depth < 0.1 ? 1u : 0u);
    BOOST_TEST_EQ(flips, flipper.number_of_removals());
    working.store(mesh);
    BOOST_TEST(find_defects(mesh).none());
    BOOST_TEST_EQ(mesh.number_of_elements(), 3 - flips);
    BOOST_TEST_LE(std::abs(whole - volume(mesh) - double(flips) * depth / 3), 1e-14);
  }
}

// ---- distorted meshes --------------------------------------------------------------------------

template <class Quality>
void test_distorted(const Quality& quality)
{
  const Test_surface surface = unit_cube();
  const Polyhedral_mixed_mesh_domain_3 domain(surface);
  for(Element_kind kind : element_kinds)
    for(unsigned seed : {1u, 2u, 3u}) {
      Mesh start = grid(3, kind);
      distort(start, 0.3, seed);
      const double worst = worst_cost(start, quality);
      BOOST_TEST_GT(worst, 3);
      for(bool flips : {false, true})
        for(double sliding : {no_sliding, 2.}) {
          Mesh mesh = start;
          const auto result =
            optimize_mixed_mesh_3(mesh, domain, quality, Criteria().flips(flips).sliding_threshold(sliding));
          BOOST_TEST(result.status == Status::SUCCESS);
          BOOST_TEST_EQ(result.number_of_rounds, 4u);
          BOOST_TEST(result.number_of_flips == 0 || (flips && kind == TETRAHEDRON));
          check(start, mesh, result, surface);
          const double now = worst_cost(mesh, quality);
          BOOST_TEST_LT(now, 0.8 * worst);
          if(sliding == no_sliding) { // the cube it was
            BOOST_TEST_LE(std::abs(volume(mesh) - 1), 1e-12);
            const std::vector<bool> is_boundary = is_on_boundary(mesh);
            for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
              BOOST_TEST(!is_boundary[v] || mesh.point(v) == start.point(v));
          } else {
            BOOST_TEST_LE(volume(mesh), 1 + 1e-12);
            BOOST_TEST_GE(volume(mesh), 0.9);
          }
        }
    }
}

// ---- each way to end ---------------------------------------------------------------------------

struct Stopping_visitor : Default_visitor
{
  std::size_t stop_at = std::size_t(-1), number_of_questions = 0;
  bool go_on() { return number_of_questions++ != stop_at; } // says no once
};

void test_statuses()
{
  const Test_surface surface = ball_surface();
  const Polyhedral_mixed_mesh_domain_3 domain(surface);
  Mesh empty;
  BOOST_TEST(optimize_mixed_mesh_3(empty, surface).status == Status::EMPTY);
  empty.add_vertex({0, 0, 0});
  BOOST_TEST(optimize_mixed_mesh_3(empty, surface).status == Status::EMPTY);

  // no valid start
  for(Element_kind kind : element_kinds) {
    Mesh mesh = grid(2, kind);
    const Vertex_index center = 13;
    for(const Test_point& bad : {Test_point(1.1, 0.5, 0.5), Test_point(1, 0.5, 0.5),
                                 Test_point(std::numeric_limits<double>::quiet_NaN(), 0, 0)}) {
      mesh.points()[center] = bad;
      Mesh after = mesh;
      after.points()[center] = mesh.points()[center] = bad;
      const auto result = optimize_mixed_mesh_3(after, surface);
      BOOST_TEST(result.status == Status::INVALID_MESH);
      BOOST_TEST(after.elements().connectivity() == mesh.elements().connectivity());
      for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
        BOOST_TEST(v == center || after.point(v) == mesh.point(v));
    }
  }
  Mesh nameless = grid(1, HEXAHEDRON);
  nameless.add_element(TETRAHEDRON, {0, 1, 2, 99});
  BOOST_TEST(optimize_mixed_mesh_3(nameless, surface).status == Status::INVALID_MESH);

  // success, and what it means
  const Mesh start = unfitted(surface, 300);
  BOOST_TEST_GT(number_of_vertices_off_surface(start, surface), 50u);
  Mesh mesh = start;
  Stopping_visitor patient;
  auto result = optimize_mixed_mesh_3(mesh, domain, Criteria(), CGAL::parameters::visitor(std::ref(patient)));
  BOOST_TEST(result.status == Status::SUCCESS);
  BOOST_TEST_EQ(result.number_of_arrived_vertices, result.number_of_boundary_vertices);
  BOOST_TEST_EQ(result.largest_distance, 0.);
  check(start, mesh, result, surface);
  Mesh same = start;
  optimize_mixed_mesh_3(same, surface);
  BOOST_TEST(is_same(same, mesh));

  // stopped anywhere: valid; a no is a no
  BOOST_TEST_GT(patient.number_of_questions, 4u);
  for(std::size_t i = 0; i < patient.number_of_questions; ++i) {
    Stopping_visitor impatient;
    impatient.stop_at = i;
    Mesh stopped = start;
    result = optimize_mixed_mesh_3(stopped, domain, Criteria(), CGAL::parameters::visitor(std::ref(impatient)));
    BOOST_TEST(result.status == Status::STOPPED);
    BOOST_TEST_EQ(impatient.number_of_questions, i + 1);
    BOOST_TEST_EQ(is_same(stopped, start), i == 0);
    check(start, stopped, result, surface);
  }

  // A plate so thin that its elements would be flatter than what is accepted.
  Test_surface plate;
  add_box(plate, {-0.1, -0.1, 0.49999}, {1.1, 1.1, 0.50001});
  const Mesh cube = grid(2, HEXAHEDRON);
  mesh = cube;
  result = optimize_mixed_mesh_3(mesh, plate);
  BOOST_TEST(result.status == Status::NOT_ALL_ARRIVED);
  BOOST_TEST_LT(result.number_of_arrived_vertices, result.number_of_boundary_vertices);
  BOOST_TEST_EQ(result.number_of_boundary_vertices, 26u);
  check(cube, mesh, result, plate);

  // a tolerance
  for(double tolerance : {1., 0.02}) {
    mesh = start;
    result = optimize_mixed_mesh_3(mesh, domain, Criteria().tolerance(tolerance));
    check(start, mesh, result, surface);
    BOOST_TEST(result.status == (tolerance == 1 ? Status::SUCCESS : Status::TOLERANCE_NOT_REACHED));
    BOOST_TEST_EQ(result.largest_distance > tolerance, tolerance < 1);
    BOOST_TEST_EQ(result.number_of_rounds, 12u);
    // at samples: not above the true distance, and not much below that of the surface
    const auto distance = hausdorff_distance(mesh, surface);
    const auto &from_mesh = distance.from_mesh, &from_surface = distance.from_surface;
    BOOST_TEST_LE(result.largest_distance,
                  (std::max)(from_mesh.distance + from_mesh.error, from_surface.distance + from_surface.error) + 1e-9);
    BOOST_TEST_GE(result.largest_distance + 2 * tolerance, from_surface.distance);
  }
}

void test_criteria()
{
  BOOST_TEST_EQ(Criteria().number_of_rounds(), 4);
  BOOST_TEST_EQ(Criteria().tolerance(1).number_of_rounds(), 12);
  const Test_surface surface = ball_surface();
  const Mesh start = unfitted(surface, 300);
  const Polyhedral_mixed_mesh_domain_3 domain(surface);
  for(int rounds : {1, 2, 7}) {
    Mesh mesh = start;
    const auto result = optimize_mixed_mesh_3(mesh, domain, Criteria().number_of_rounds(rounds));
    BOOST_TEST_EQ(result.number_of_rounds, std::size_t(rounds));
    check(start, mesh, result, surface);
  }
  // Carried elsewhere: to a sphere twice as large, and with the other measure.
  const Test_surface larger = ball_surface(1.5);
  for(int model : {0, 1}) {
    Mesh mesh = start;
    const Polyhedral_mixed_mesh_domain_3 larger_domain(larger);
    const auto result = model == 0 ? optimize_mixed_mesh_3(mesh, larger_domain, Criteria())
                                   : optimize_mixed_mesh_3(mesh, larger_domain, Scaled_jacobian_quality_3(), Criteria());
    BOOST_TEST(result.status == Status::SUCCESS);
    check(start, mesh, result, larger);
    BOOST_TEST_GE(volume(mesh), 0.8 * 4.19 * 3.375);
    const auto rows = quality_statistics(mesh, scaled_jacobian);
    BOOST_TEST_GE(rows[number_of_element_kinds].minimum, 0.2);
  }
}

// ---- the brain ---------------------------------------------------------------------------------

void test_brain(const Test_surface& brain, const Test_surface& region_surface)
{
  const Polyhedral_mixed_mesh_domain_3 domain(brain);
  const Polyhedral_mixed_mesh_region_3 region(region_surface);
  Mesh before, mesh;
  make_mixed_mesh_3(domain, region, Mixed_mesh_criteria_3(660).fit_to_surface(false), before);
  const auto made = make_mixed_mesh_3(domain, region, Mixed_mesh_criteria_3(660), mesh);
  BOOST_TEST(made.status == CGAL::Mixed_mesh_status::SUCCESS);
  check(before, mesh, made.optimization, brain);

  // off the surface before, on it after
  BOOST_TEST_GT(number_of_vertices_off_surface(before, brain), 150u);
  BOOST_TEST_EQ(number_of_vertices_off_surface(mesh, brain), 0u);
  BOOST_TEST_EQ(number_of_boundary_self_intersections(mesh), 0u);
  BOOST_TEST(find_defects(mesh).none());

  // The closest points alone would invert elements.
  Mesh projected = before;
  const std::vector<bool> is_boundary = is_on_boundary(before);
  for(Vertex_index v = 0; v < before.number_of_vertices(); ++v)
    if(is_boundary[v])
      projected.points()[v] = domain.closest_point(before.point(v));
  BOOST_TEST(!is_positive(projected));
  BOOST_TEST_EQ(number_of_vertices_off_surface(projected, brain), 0u);

  const auto rows = quality_statistics(mesh);
  BOOST_TEST_LE(rows[number_of_element_kinds].mean, 1.42);
  BOOST_TEST_LE(rows[number_of_element_kinds].maximum, 2.1);
  BOOST_TEST_EQ(rows[number_of_element_kinds].share, 1.);
  const double warp = quality_statistics(mesh, quad_warp)[number_of_element_kinds].maximum;
  BOOST_TEST_LE(warp, 10);
  std::cout << "brain, 660: ARC " << rows[number_of_element_kinds].mean << ", at most "
            << rows[number_of_element_kinds].maximum << "; warp " << warp << std::endl;

  // What sliding costs, against vertices that stay where they arrive.
  Mesh again = before, stiff = before;
  BOOST_TEST(optimize_mixed_mesh_3(again, brain).status == Status::SUCCESS);
  BOOST_TEST(is_same(again, mesh)); // by itself as in the driver; and repeatable
  const auto result = optimize_mixed_mesh_3(stiff, domain, Criteria().sliding_threshold(no_sliding));
  check(before, stiff, result, brain);
  std::cout << "volume " << volume(mesh) << ", without sliding " << volume(stiff) << std::endl;
  BOOST_TEST_GE(volume(mesh), 0.99 * volume(stiff));
  BOOST_TEST_GE(quality_statistics(stiff)[number_of_element_kinds].maximum,
                rows[number_of_element_kinds].maximum);

  // A tolerance brings both surfaces nearer: the same elements, and elements chosen for it.
  Mesh near = before, nearer;
  const auto drawn = optimize_mixed_mesh_3(near, domain, Criteria().tolerance(4));
  check(before, near, drawn, brain);
  const Axis_aligned_octree_cell_traits_3 traits(domain.bbox());
  const auto refined = make_mixed_mesh_3(domain, region, Mixed_mesh_criteria_3(660).tolerance(4), traits, nearer);
  BOOST_TEST(refined.has_mesh());
  BOOST_TEST(find_defects(nearer).none());
  BOOST_TEST_EQ(number_of_vertices_off_surface(nearer, brain), 0u);
  BOOST_TEST_GT(refined.number_of_vertices_for_tolerance, 0u);
  BOOST_TEST_LE(nearer.number_of_vertices(), 660u);
  const double far_off = hausdorff_distance(mesh, brain, 1e-3).distance(),
               near_off = hausdorff_distance(near, brain, 1e-3).distance(),
               nearer_off = hausdorff_distance(nearer, brain, 1e-3).distance();
  std::cout << "distances " << far_off << ", drawn " << near_off << ", refined " << nearer_off << std::endl;
  BOOST_TEST_LT(near_off, far_off);
  BOOST_TEST_LT(nearer_off, near_off);
  BOOST_TEST_LE(refined.optimization.largest_distance, 1.01 * nearer_off);
}

} // namespace

int main(int argc, char** argv)
{
  const std::string data = argc > 1 ? argv[1] : MIXED_MESH_3_DATA_DIR;
  Test_surface brain, region;
  if(!CGAL::IO::read_polygon_mesh(data + "/brain.off", brain)
     || !CGAL::IO::read_polygon_mesh(data + "/region.off", region)) {
    std::cerr << "cannot read brain.off and region.off in " << data << std::endl;
    return 1;
  }
  test_qualities();
  test_flips();
  test_removal();
  test_distorted(Aspect_ratio_quality_3());
  test_distorted(Scaled_jacobian_quality_3());
  test_statuses();
  test_criteria();
  test_brain(brain, region);
  return boost::report_errors();
}
