// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scaled Jacobian, dihedral angles, warp, statistics. Volumes and aspect-ratio coefficients are tested with
// the element traits.

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_3/quality.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <random>
#include <vector>

namespace test_elements_quality {

using namespace CGAL::Mixed_meshes_3;

using Mesh = CGAL::Mixed_mesh_3<Predicates_kernel>;
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

Points pyramid(double height) { return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, height}}; }

Points prism(double height)
{
  const double h = std::sqrt(3.) / 2;
  return {{0, 0, 0}, {1, 0, 0}, {0.5, h, 0}, {0, 0, height}, {1, 0, height}, {0.5, h, height}};
}

// Ideal elements, in which all edges are equal.
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
  // The angles by kind. Triangles of the pyramid meet as in the regular octahedron.
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
  // The tetrahedron is at the corner of a cube: the largest product of edges is at the other corners.
  const Points corner{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  BOOST_TEST(is_close(value(scaled_jacobian, TETRAHEDRON, corner), std::sqrt(0.5), 1e-15));
  BOOST_TEST(is_close(value(smallest_dihedral_angle, TETRAHEDRON, corner),
                      degrees(std::acos(std::sqrt(1. / 3))), 1e-12));
  BOOST_TEST(is_close(value(largest_dihedral_angle, TETRAHEDRON, corner), 90, 1e-12));

  // The sliver has two edges that nearly cross.
  const double h = 1e-3;
  const Points sliver{{-1, 0, 0}, {1, 0, 0}, {0, 1, h}, {0, -1, h}};
  BOOST_TEST(
    is_close(value(largest_dihedral_angle, TETRAHEDRON, sliver), 180 - 2 * degrees(std::atan(h)), 1e-9));
  BOOST_TEST(
    is_close(value(scaled_jacobian, TETRAHEDRON, sliver), std::sqrt(2.) * 4 * h / (2 * (2 + h * h)), 1e-12));

  // The flat pyramid of height 1/4 has lateral edges of length 3/4.
  BOOST_TEST(
    is_close(value(scaled_jacobian, PYRAMID, pyramid(0.25)), 2 * 0.25 / (std::sqrt(2.) * 0.75), 1e-15));
  // The pyramid of height 1 has lateral edges of sqrt(3/2).
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
    BOOST_TEST(
      is_close(value(scaled_jacobian, HEXAHEDRON, points), (1 - 3 * t) / (edge * edge * edge), 1e-14));
  }

  // A sheared box keeps plane faces; the angle of the shear is the smallest.
  Points points = cube();
  for(Vec3& p : points)
    p[0] += p[2];
  BOOST_TEST(is_close(value(scaled_jacobian, HEXAHEDRON, points), std::sqrt(0.5), 1e-15));
  BOOST_TEST(is_close(value(smallest_dihedral_angle, HEXAHEDRON, points), 45, 1e-12));
  BOOST_TEST(is_close(value(largest_dihedral_angle, HEXAHEDRON, points), 135, 1e-12));
  BOOST_TEST(is_close(value(quad_warp, HEXAHEDRON, points), 0, 1e-12));

  // The base of a pyramid is lifted at two opposite corners: both triangles lean by the same angle.
  points = {{0, 0, 0.1}, {1, 0, -0.1}, {1, 1, 0.1}, {0, 1, -0.1}, {0.5, 0.5, 1}};
  BOOST_TEST(is_close(value(quad_warp, PYRAMID, points), 2 * degrees(std::atan(0.2 * std::sqrt(2.))), 1e-12));
  // One corner of a cube is lifted: 36.9 degrees about the diagonal through the corner, 35.3 about the other
  // one.
  points = cube();
  points[6][2] += 0.5;
  BOOST_TEST(is_close(value(quad_warp, HEXAHEDRON, points), degrees(std::acos(0.8)), 1e-12));
  // A prism is twisted: its triangles stay plane.
  points = prism(1);
  const Vec3 center{0.5, std::sqrt(3.) / 6, 0};
  for(int i = 3; i < 6; ++i) {
    const Vec3 r = points[i] - center;
    points[i] = center
                + Vec3{std::cos(0.3) * r[0] - std::sin(0.3) * r[1],
                       std::sin(0.3) * r[0] + std::cos(0.3) * r[1], 1};
  }
  BOOST_TEST_GT(value(quad_warp, PRISM, points), 10.);
}

void test_degenerate_elements()
{
  for(Element_kind kind : element_kinds) {
    // Mirrored elements: Jacobians change sign, angles a become 360 - a.
    Points points = ideal(kind);
    for(Vec3& p : points)
      p[2] = -p[2];
    BOOST_TEST(value(scaled_jacobian, kind, points) < -0.9);
    BOOST_TEST(is_close(value(largest_dihedral_angle, kind, points),
                        360 - value(smallest_dihedral_angle, kind, ideal(kind)), 1e-12));
    // The element is flat.
    points = ideal(kind);
    for(Vec3& p : points)
      p[2] = 0;
    BOOST_TEST(is_close(value(scaled_jacobian, kind, points), 0, 1e-15));
    // The element is a point.
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

  // Values at edges belong to the bin above; no element is left out.
  const auto counts = histogram(mesh, aspect_ratio_coefficient, {1, 2, 3, 7});
  BOOST_TEST((counts == std::vector<std::size_t>{0, 1, 1, 0, 2}));
  add(mesh, HEXAHEDRON, Points(8)); // infinite
  BOOST_TEST(
    (histogram(mesh, aspect_ratio_coefficient, {1, 2, 3, 7}) == std::vector<std::size_t>{0, 1, 1, 0, 3}));
  BOOST_TEST((histogram(mesh, aspect_ratio_coefficient, {}) == std::vector<std::size_t>{5}));
}

int run(int, char*[])
{
  test_ideal_elements();
  test_distorted_elements();
  test_degenerate_elements();
  for(Element_kind kind : element_kinds)
    test_invariance(kind);
  test_statistics_and_histogram();
  return boost::report_errors();
}

} // namespace test_elements_quality
