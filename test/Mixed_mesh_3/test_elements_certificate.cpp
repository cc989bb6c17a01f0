// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The certificate compared with samples of the Jacobian by the shape functions, which share no code with it.

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/certificate.h>
#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_3/validation.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>

namespace test_elements_certificate {

using namespace CGAL::Mixed_meshes_3;
using Points = std::array<std::array<double, 3>, 8>;

template <Element_kind Kind>
double jacobian(const Points& p, double r, double s, double t)
{
  const auto gradients = Mixed_element_traits_3<Kind>::shape_gradients(r, s, t);
  double m[3][3] = {};
  for(std::size_t i = 0; i < gradients.size(); ++i)
    for(int a = 0; a < 3; ++a)
      for(int b = 0; b < 3; ++b)
        m[a][b] += gradients[i][std::size_t(a)] * p[i][std::size_t(b)];
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
         + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

// The smallest Jacobian on a grid of the reference element; for the pyramid without its apex.
template <Element_kind Kind>
double smallest_jacobian(const Points& p, int n)
{
  double smallest = std::numeric_limits<double>::infinity();
  for(int i = 0; i <= n; ++i)
    for(int j = 0; j <= n; ++j)
      for(int k = 0; k <= n; ++k) {
        double r = double(i) / n, s = double(j) / n, t = double(k) / n;
        if(Kind == PRISM) {
          if(i + j > n)
            continue;
          t = 2 * t - 1;
        } else if(Kind == HEXAHEDRON) {
          r = 2 * r - 1, s = 2 * s - 1, t = 2 * t - 1;
        } else if(Kind == PYRAMID) {
          t *= 0.99;
          r = (2 * r - 1) * (1 - t), s = (2 * s - 1) * (1 - t);
        }
        smallest = (std::min)(smallest, jacobian<Kind>(p, r, s, t));
      }
  return smallest;
}

Points reference_points(Element_kind kind)
{
  Points p{};
  for(std::size_t i = 0; i < 8; ++i)
    for(std::size_t k = 0; k < 3; ++k)
      p[i][k] = reference_elements[kind].coordinates[i][k];
  return p;
}

bool has_positive_corners(Element_kind kind, const Points& p)
{
  const Reference_element& reference = reference_elements[kind];
  for(int c = 0; c < reference.number_of_corners; ++c) {
    Points corner{};
    for(std::size_t i = 0; i < 4; ++i)
      corner[i] = p[reference.corners[c][i]];
    if(jacobian_sign(TETRAHEDRON, corner) != Jacobian_sign::POSITIVE)
      return false;
  }
  return true;
}

// Random elements, from slightly to badly distorted: the certificate never contradicts a sample.
template <Element_kind Kind>
void test_random(int runs)
{
  std::mt19937 random(Kind + 1);
  int counts[3] = {}, hidden = 0;
  for(int run = 0; run < runs; ++run) {
    Points p = reference_points(Kind);
    const double size = 0.3 + 0.9 * run / runs;
    for(auto& x : p)
      for(double& c : x)
        c += size * (random() / 4294967296. * 2 - 1);
    const Jacobian_sign sign = jacobian_sign(Kind, p);
    ++counts[int(sign)];
    const double smallest = smallest_jacobian<Kind>(p, 12);
    if(sign == Jacobian_sign::POSITIVE)
      BOOST_TEST_GT(smallest, 0.);
    if(smallest < -1e-9)
      BOOST_TEST(sign == Jacobian_sign::NOT_POSITIVE);
    // The answer "not positive" is right: the Jacobian between the grid points can only be just below zero.
    if(sign == Jacobian_sign::NOT_POSITIVE)
      BOOST_TEST_LT(smallest, 0.1);
    hidden += sign == Jacobian_sign::NOT_POSITIVE && has_positive_corners(Kind, p);
    // The mirrored element is negative.
    for(auto& x : p)
      x[0] = -x[0];
    if(sign == Jacobian_sign::POSITIVE)
      BOOST_TEST(jacobian_sign(Kind, p) == Jacobian_sign::NOT_POSITIVE);
  }
  BOOST_TEST_GT(counts[0], runs / 20);
  BOOST_TEST_GT(counts[1], runs / 20);
  BOOST_TEST_EQ(counts[2], 0);
  // Corners are not sufficient: hexahedra and prisms may be positive there and negative elsewhere.
  if(Kind == HEXAHEDRON || Kind == PRISM)
    BOOST_TEST_GT(hidden, 0);
}

// A hexahedron with eight positive corners, but clearly negative in between.
void test_known_hexahedron()
{
  Points p{};
  std::mt19937 random(5);
  bool found = false;
  for(int run = 0; run < 200000 && !found; ++run) {
    p = reference_points(HEXAHEDRON);
    for(auto& x : p)
      for(double& c : x)
        c += (random() / 4294967296. * 2 - 1);
    found = has_positive_corners(HEXAHEDRON, p) && smallest_jacobian<HEXAHEDRON>(p, 4) < -0.01;
  }
  BOOST_TEST(found);
  BOOST_TEST(has_positive_corners(HEXAHEDRON, p));
  BOOST_TEST(jacobian_sign(HEXAHEDRON, p) == Jacobian_sign::NOT_POSITIVE);

  // The top is turned by half a turn: the Jacobian is positive except at half height, where it is zero.
  p = reference_points(HEXAHEDRON);
  for(std::size_t i = 4; i < 8; ++i)
    p[i][0] = -p[i][0], p[i][1] = -p[i][1];
  BOOST_TEST(has_positive_corners(HEXAHEDRON, p));
  BOOST_TEST(jacobian_sign(HEXAHEDRON, p) == Jacobian_sign::NOT_POSITIVE);
}

// Elements for which doubles and intervals can not decide: exactly flat, and slightly positive.
void test_exact()
{
  for(Element_kind kind : element_kinds) {
    Points flat = reference_points(kind);
    for(auto& x : flat)
      x[2] = 0;
    BOOST_TEST(jacobian_sign(kind, flat) == Jacobian_sign::NOT_POSITIVE);
    for(double height : {1e-300, 1e-30, 1e-12, 1., 1e12}) {
      Points p = reference_points(kind);
      for(auto& x : p)
        x[2] *= height;
      BOOST_TEST(jacobian_sign(kind, p) == Jacobian_sign::POSITIVE);
    }
    // The remaining digits of coordinates decide far from the origin.
    Points p = reference_points(kind);
    for(auto& x : p)
      for(double& c : x)
        c = 1e15 + 8 * c;
    BOOST_TEST(jacobian_sign(kind, p) == Jacobian_sign::POSITIVE);
  }
  // The tetrahedron has a volume of one unit in the last place.
  Points p{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1. / 3, 1. / 3, std::ldexp(1., -1060)}}};
  BOOST_TEST(jacobian_sign(TETRAHEDRON, p) == Jacobian_sign::POSITIVE);
  p[3][2] = -p[3][2];
  BOOST_TEST(jacobian_sign(TETRAHEDRON, p) == Jacobian_sign::NOT_POSITIVE);
  // A hexahedron collapsed along one edge is not positive; lifted by a digit, it is.
  Points h = reference_points(HEXAHEDRON);
  h[1] = h[0];
  BOOST_TEST(jacobian_sign(HEXAHEDRON, h) == Jacobian_sign::NOT_POSITIVE);
  h[1][0] += std::ldexp(1., -50);
  BOOST_TEST(jacobian_sign(HEXAHEDRON, h) == Jacobian_sign::POSITIVE);
}

// An element whose top is the bottom turned and twice as large. After half a turn the Jacobian is positive
// except at a third of the height, where it is zero: halving the element never meets these points.
Points twisted(Element_kind kind, double turns)
{
  Points p = reference_points(kind);
  const std::size_t n = kind == HEXAHEDRON ? 4 : 3;
  const double angle = 2 * CGAL_PI * turns;
  const double c = turns == 0.5 ? -1 : std::cos(angle), s = turns == 0.5 ? 0 : std::sin(angle); // exact
  for(std::size_t i = 0; i < n; ++i) {
    p[n + i][0] = 2 * (c * p[i][0] - s * p[i][1]);
    p[n + i][1] = 2 * (s * p[i][0] + c * p[i][1]);
  }
  return p;
}

void test_undecided()
{
  for(Element_kind kind : {PRISM, HEXAHEDRON}) {
    BOOST_TEST(jacobian_sign(kind, twisted(kind, 0.3)) == Jacobian_sign::POSITIVE);
    BOOST_TEST(jacobian_sign(kind, twisted(kind, 0.45)) == Jacobian_sign::POSITIVE);
    BOOST_TEST(jacobian_sign(kind, twisted(kind, 0.5)) == Jacobian_sign::UNDECIDED);
    // The element is slightly positive.
    BOOST_TEST(jacobian_sign(kind, twisted(kind, 0.5 - 1e-8)) == Jacobian_sign::UNDECIDED);
    BOOST_TEST(has_positive_corners(kind, twisted(kind, 0.5)));
    // The mirrored element is negative.
    Points p = twisted(kind, 0.5);
    for(auto& x : p)
      x[0] = -x[0];
    BOOST_TEST(jacobian_sign(kind, p) == Jacobian_sign::NOT_POSITIVE);
  }
  // The Jacobian is small along an edge of a prism only: smaller turns are decided sooner.
  BOOST_TEST(jacobian_sign(PRISM, twisted(PRISM, 0.4999)) == Jacobian_sign::POSITIVE);

  // Undecided elements of a mesh are a defect of their own kind.
  using Mesh = CGAL::Mixed_mesh_3<Predicates_kernel>;
  Mesh mesh;
  for(const auto& x : twisted(HEXAHEDRON, 0.5))
    mesh.add_vertex({x[0], x[1], x[2]});
  mesh.add_element(HEXAHEDRON, {0, 1, 2, 3, 4, 5, 6, 7});
  BOOST_TEST(jacobian_sign(mesh, 0) == Jacobian_sign::UNDECIDED);
  const Mesh_defects defects = find_defects(mesh);
  BOOST_TEST_EQ(defects.undecided_elements, 1u);
  BOOST_TEST_EQ(defects.nonpositive_elements, 0u);
  BOOST_TEST_EQ(defects.nonpositive_corners, 0u);
  BOOST_TEST(!defects.positive() && !defects.none());
}

// A tetrahedron has a constant Jacobian, whose sign is that of an exact predicate: also if the tetrahedron is
// flat up to rounding, or far too large.
void test_flat_tetrahedra()
{
  using Kernel = Predicates_kernel;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  std::size_t number_of_sides[3] = {0, 0, 0};
  for(double scale : {1., 1e-100, 1e80, 1e307})
    for(int run = 0; run < 500; ++run) {
      std::array<std::array<double, 3>, 8> p{};
      for(int i = 0; i < 3; ++i)
        for(double& x : p[std::size_t(i)])
          x = scale * coordinate(random);
      for(std::size_t k = 0; k < 3; ++k) // in the plane of the others, rounded
        p[3][k] = 0.3 * p[0][k] + 0.5 * p[1][k] + 0.2 * p[2][k];
      std::array<Kernel::Point_3, 4> q;
      for(std::size_t i = 0; i < 4; ++i)
        q[i] = Kernel::Point_3(p[i][0], p[i][1], p[i][2]);
      const CGAL::Orientation side = CGAL::orientation(q[0], q[1], q[2], q[3]);
      ++number_of_sides[side + 1];
      BOOST_TEST(jacobian_sign(TETRAHEDRON, p)
                 == (side == CGAL::POSITIVE ? Jacobian_sign::POSITIVE : Jacobian_sign::NOT_POSITIVE));
    }
  BOOST_TEST(number_of_sides[0] > 100 && number_of_sides[2] > 100);
}

int run(int, char*[])
{
  test_random<TETRAHEDRON>(2000);
  test_random<PYRAMID>(1500);
  test_random<PRISM>(1500);
  test_random<HEXAHEDRON>(1500);
  test_known_hexahedron();
  test_exact();
  test_undecided();
  test_flat_tetrahedra();
  return boost::report_errors();
}

} // namespace test_elements_certificate
