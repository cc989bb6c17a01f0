// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The guarantee that no element has an aspect-ratio coefficient (ARC) above the bound: all possible elements
// before the boundary is fitted, each outcome, the proof for one element, and the consequences for dihedral
// angles.

#include "test_fitting.h"

#include <CGAL/make_mixed_mesh_3.h>
#include <CGAL/optimize_mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Aspect_ratio_quality_3.h>
#include <CGAL/Mixed_mesh_3/internal/boundary/split_by_order.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/optimize_bounded.h>
#include <CGAL/Mixed_mesh_3/internal/transitions/transition_templates.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/quality_bound.h>
#include <CGAL/Mixed_mesh_3/surface_distance.h>
#include <CGAL/Mixed_mesh_3/validation.h>

#include <CGAL/Exact_rational.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <iostream>
#include <limits>
#include <numeric>
#include <random>
#include <set>
#include <vector>

namespace test_fitting_quality_bound {

using namespace CGAL::Mixed_meshes_3;
using CGAL::Mixed_mesh_criteria_3;
using CGAL::make_mixed_mesh_3;
using CGAL::optimize_mixed_mesh_3;
using Criteria = CGAL::Mixed_mesh_optimization_criteria_3;
using Status = CGAL::Mixed_mesh_optimization_status;
using Points = internal::Element_points;

constexpr double bound = Criteria::default_quality_bound;

// The proof on the coordinates in the form of the certificates.
bool is_within(Element_kind kind, const Points& p, double q)
{
  std::array<std::array<double, 3>, 8> points{};
  std::copy(p.begin(), p.end(), points.begin());
  return is_aspect_ratio_at_most(kind, points, q);
}

// ---- the start ---------------------------------------------------------------------------------

// The largest cost and ARC of all elements added.
struct Worst
{
  double cost = 0;
  std::size_t number = 0, number_above = 0; // of elements, and of those proved not to be within the bound

  void add(Element_kind kind, const Points& p)
  {
    ++number;
    cost = (std::max)(cost, Aspect_ratio_quality_3()(kind, p));
    number_above += !is_within(kind, p, bound);
  }
};

Points points_of(const Points& p, std::initializer_list<Vertex_index> vertices)
{
  Points q{};
  std::size_t i = 0;
  for(Vertex_index v : vertices)
    q[i++] = p[v];
  return q;
}

// Adds all pieces that the boundary stage can make of an element: each set of vertices outside, in each
// order. Vertices inside, which have no order, do not come before.
void add_pieces(Element_kind kind, const Points& p, Worst& worst)
{
  constexpr Vertex_index vertices[8] = {0, 1, 2, 3, 4, 5, 6, 7};
  const Element_view element(kind, vertices);
  std::array<int, 8> rank{};
  rank.fill(8);
  const std::function<void(int)> add = [&](int first_free) {
    for(std::size_t v = 0; v < std::size_t(element.size()); ++v) {
      if(rank[v] != 8)
        continue;
      rank[v] = first_free; // of the vertices outside this is the last one
      const auto is_inside = [&](Vertex_index u) { return rank[u] == 8; };
      if(std::any_of(element.begin(), element.end(), is_inside)) {
        internal::split_element(
          element, [&](Vertex_index u) { return rank[u]; }, is_inside,
          [&](Element_kind piece, std::initializer_list<Vertex_index> u) {
            if(std::any_of(u.begin(), u.end(), is_inside))
              worst.add(piece, points_of(p, u));
          });
        add(first_free + 1);
      }
      rank[v] = 8;
    }
  };
  add(0);
}

// Adds tetrahedra of any vertex and diagonals, as `split_to_tetrahedra()` makes them of elements and of
// pieces.
void add_tetrahedra(Element_kind kind, const Points& p, Worst& worst)
{
  const Reference_element& reference = reference_elements[kind];
  for(int f = 0; f < reference.number_of_faces; ++f) {
    const Element_face& face = reference.faces[f];
    const auto v = [&](int i) { return Vertex_index(face.vertices[i % face.size]); };
    for(Vertex_index apex = 0; apex < Vertex_index(reference.number_of_vertices); ++apex)
      if(std::find(face.vertices, face.vertices + face.size, apex) == face.vertices + face.size)
        for(int i = 0; i < (face.size == 3 ? 1 : 4); ++i)
          worst.add(TETRAHEDRON, points_of(p, {v(i), v(i + 2), v(i + 1), apex}));
  }
}

// Squared distances, by which elements of templates that are congruent, vertex by vertex, are tested once.
std::vector<int> squared_distances(const internal::Template_element& element, const Points& p)
{
  std::vector<int> result{element.kind};
  for(std::size_t i = 0; i < element.size; ++i)
    for(std::size_t j = 0; j < i; ++j)
      result.push_back(int(std::pow(p[i][0] - p[j][0], 2) + std::pow(p[i][1] - p[j][1], 2)
                           + std::pow(p[i][2] - p[j][2], 2)));
  return result;
}

void test_start()
{
  const internal::Transition_templates& templates = internal::Transition_templates::get();
  std::set<std::vector<int>> known;
  Worst whole, pieces, tetrahedra;
  for(bool centered : {false, true})
    for(std::uint32_t mask = 0; mask < internal::Transition_templates::number_of_patterns; ++mask)
      for(const internal::Template_element& e : centered ? templates.centered(mask) : templates[mask]) {
        Points p{};
        for(std::size_t i = 0; i < e.size; ++i)
          p[i] = {double(e.vertices[i] % 3), double(e.vertices[i] / 3 % 3), double(e.vertices[i] / 9)};
        if(!known.insert(squared_distances(e, p)).second)
          continue;
        const Element_kind kind = Element_kind(e.kind);
        whole.add(kind, p);
        add_pieces(kind, p, pieces);
        add_tetrahedra(kind, p, tetrahedra);
      }
  std::cout << "start: " << whole.number << " elements of templates, at most " << whole.cost << "; "
            << pieces.number << " pieces, at most " << pieces.cost << "; tetrahedra at most "
            << tetrahedra.cost << std::endl;
  for(const Worst& worst : {whole, pieces, tetrahedra}) {
    BOOST_TEST_EQ(worst.number_above, 0u);
    BOOST_TEST_LE(worst.cost, bound * (1 - 1e-10));
    BOOST_TEST_GT(worst.cost, 3.19);
  }
}

// ---- the proof ---------------------------------------------------------------------------------

using Rational = CGAL::Exact_rational;
using Rational_vector = std::array<Rational, 3>;

Rational_vector mean(const Points& p, std::initializer_list<int> vertices)
{
  Rational_vector m{Rational(0), Rational(0), Rational(0)};
  for(int v : vertices)
    for(std::size_t k = 0; k < 3; ++k)
      m[k] += Rational(p[std::size_t(v)][k]) / Rational(int(vertices.size()));
  return m;
}

Rational squared_distance(const Rational_vector& a, const Rational_vector& b)
{
  Rational sum(0);
  for(std::size_t k = 0; k < 3; ++k)
    sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

// The square of twice the area, by Heron's formula.
Rational squared_parallelogram(const Rational_vector& a, const Rational_vector& b, const Rational_vector& c)
{
  const Rational x = squared_distance(a, b), y = squared_distance(b, c), z = squared_distance(c, a);
  return (4 * x * y - (x + y - z) * (x + y - z)) / 4;
}

Rational six_volumes(const Rational_vector& a, const Rational_vector& b, const Rational_vector& c,
                     const Rational_vector& d)
{
  Rational sum(0);
  const auto x = [](const Rational_vector& u, const Rational_vector& v, std::size_t k) {
    return Rational(v[k] - u[k]);
  };
  for(std::size_t k = 0; k < 3; ++k)
    sum += x(a, b, k)
           * (x(a, c, (k + 1) % 3) * x(a, d, (k + 2) % 3) - x(a, c, (k + 2) % 3) * x(a, d, (k + 1) % 3));
  return sum;
}

Rational squared_ratio(std::initializer_list<Rational> squares)
{
  return std::max(squares) / std::min(squares);
}

// The square of the ARC of elements that are not degenerate; 0 for an inverted element.
Rational squared_arc(Element_kind kind, const Points& p)
{
  const auto at = [&](int i) { return mean(p, {i}); };
  switch(kind) {
  case TETRAHEDRON: {
    const Rational d = six_volumes(at(0), at(1), at(2), at(3));
    if(d <= 0)
      return 0;
    Rational s(0);
    for(int i = 0; i < 4; ++i)
      for(int j = 0; j < i; ++j)
        s += squared_distance(at(i), at(j)) / 6;
    const Rational volume = d / 6, factor = Rational(847867) / Rational(100000);
    return s * s * s / (factor * factor * volume * volume);
  }
  case PYRAMID: { // the height over the mean plane, by that of a tetrahedron on a triangle in it
    const Rational_vector center = mean(p, {0, 1, 2, 3});
    Rational_vector b = center, c = center;
    for(std::size_t k = 0; k < 3; ++k) {
      b[k] += Rational(p[2][k]) - Rational(p[0][k]);
      c[k] += Rational(p[3][k]) - Rational(p[1][k]);
    }
    const Rational d = six_volumes(center, b, c, at(4));
    if(d <= 0)
      return 0;
    return squared_ratio({squared_distance(mean(p, {0, 1}), mean(p, {2, 3})),
                          squared_distance(mean(p, {1, 2}), mean(p, {3, 0})),
                          d * d / squared_parallelogram(center, b, c)});
  }
  case PRISM: {
    Rational worst(0);
    for(int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const Rational_vector a = mean(p, {i, i + 3}), b = mean(p, {j, j + 3}), c = mean(p, {k, k + 3});
      const Rational width = squared_distance(a, b);
      worst = (std::max)(worst,
                         squared_ratio({width, squared_distance(mean(p, {i, j}), mean(p, {i + 3, j + 3})),
                                        squared_parallelogram(a, b, c) / width}));
    }
    return worst;
  }
  case HEXAHEDRON:
    return squared_ratio({squared_distance(mean(p, {0, 3, 4, 7}), mean(p, {1, 2, 5, 6})),
                          squared_distance(mean(p, {0, 1, 4, 5}), mean(p, {2, 3, 6, 7})),
                          squared_distance(mean(p, {0, 1, 2, 3}), mean(p, {4, 5, 6, 7}))});
  }
  return 0;
}

Points reference_points(Element_kind kind)
{
  Points p{};
  for(std::size_t i = 0; i < 8; ++i)
    for(std::size_t k = 0; k < 3; ++k)
      p[i][k] = reference_elements[kind].coordinates[i][k];
  return p;
}

// Random elements, with bounds at their ARC, as near as doubles allow, and farther: the answer is that of
// rational numbers, and never contradicts the ARC in doubles.
void test_proof(Element_kind kind)
{
  std::mt19937 random(kind + 1);
  int inverted = 0, within = 0, above = 0;
  for(int run = 0; run < 400; ++run) {
    Points p = reference_points(kind);
    for(auto& x : p)
      for(double& c : x)
        c = (c + 1.2 * (random() / 4294967296. * 2 - 1) + (run % 7 == 0 ? 1000 : 0))
            * (run % 3 == 0 ? 1e-20 : 1);
    const Rational squared = squared_arc(kind, p);
    const double arc = internal::aspect_ratio_coefficient(kind, p);
    BOOST_TEST_EQ(squared == 0, arc == std::numeric_limits<double>::infinity());
    if(squared == 0) {
      ++inverted;
      BOOST_TEST(!is_within(kind, p, 1e6));
      continue;
    }
    for(double factor : {1 - 1e-9, 1 - 1e-13, 1 - 1e-15, 1., 1 + 1e-15, 1 + 1e-13, 1 + 1e-9})
      if(factor * arc >= 1) {
        const bool answer = is_within(kind, p, factor * arc);
        BOOST_TEST_EQ(answer, squared <= Rational(factor * arc) * Rational(factor * arc));
        if(std::abs(factor - 1) > 1e-10 && run % 7 != 0)
          BOOST_TEST_EQ(answer, factor > 1);
        ++(answer ? within : above);
      }
  }
  BOOST_TEST(within > 500 && above > 500);
  BOOST_TEST(inverted > 5 || kind == PRISM || kind == HEXAHEDRON);
}

// An ARC that is exactly the bound is within it, and not within the double before.
void test_exact_bounds()
{
  Points hexahedron = reference_points(HEXAHEDRON), pyramid = reference_points(PYRAMID),
         prism = reference_points(PRISM);
  for(auto& x : hexahedron)
    x[2] *= 3;
  pyramid[4][2] = 6;
  for(auto& x : prism)
    x[2] *= 1.5;
  const double below = std::nextafter(3., 0.);
  for(const auto& [kind, p] : {std::make_pair(HEXAHEDRON, hexahedron), std::make_pair(PYRAMID, pyramid)}) {
    BOOST_TEST(is_within(kind, p, 3));
    BOOST_TEST(!is_within(kind, p, below));
  }
  // The prism is on a right triangle with legs of 1: heights are 3, and the triangle's over the hypotenuse.
  const Rational squared = squared_arc(PRISM, prism);
  BOOST_TEST(squared == Rational(18));
  BOOST_TEST(is_within(PRISM, prism, 4.25) && !is_within(PRISM, prism, 4.24));

  for(Element_kind kind : element_kinds) {
    Points flat = reference_points(kind);
    for(auto& x : flat)
      x[2] = 0;
    BOOST_TEST(!is_within(kind, flat, 1e300));
    BOOST_TEST(!is_within(kind, Points{}, 1e300));
    for(double size : {1e-200, 1e-100, 1e100}) { // squares and cubes of these are no doubles
      Points p = reference_points(kind);
      for(auto& x : p)
        for(double& c : x)
          c *= size;
      BOOST_TEST(is_within(kind, p, 7) && is_within(kind, p, 1) == (kind == HEXAHEDRON));
    }
  }
}

// ---- dihedral angles ---------------------------------------------------------------------------

double dihedral_angle(const Points& p, bool largest)
{
  return largest ? internal::largest_dihedral_angle(TETRAHEDRON, p)
                 : internal::smallest_dihedral_angle(TETRAHEDRON, p);
}

// The tetrahedron with two planes of symmetry that has the angle, in degrees, and the least ARC of these.
Points symmetric_tetrahedron(double angle)
{
  const double half = angle / 360 * CGAL_PI, length = std::sqrt((3 - std::cos(2 * half)) / 2);
  return {{{0, 0, -length / 2},
           {0, 0, length / 2},
           {std::cos(half), -std::sin(half), 0},
           {std::cos(half), std::sin(half), 0}}};
}

void test_dihedral_angles()
{
  const auto arc = [](const Points& p) { return internal::aspect_ratio_coefficient(TETRAHEDRON, p); };
  // The bounds are attained.
  for(double q : {1.01, 1.5, 2.2, 3.2, 4., 10., 1000.}) {
    const auto angles = dihedral_angle_bounds(q);
    for(int largest : {0, 1}) {
      const Points p = symmetric_tetrahedron(angles[std::size_t(largest)]);
      BOOST_TEST_LE(std::abs(arc(p) - q), 1e-7 * q);
      BOOST_TEST_LE(std::abs(dihedral_angle(p, largest != 0) - angles[std::size_t(largest)]), 1e-6);
    }
  }
  BOOST_TEST_LE(std::abs(dihedral_angle_bounds(1)[0] - dihedral_angle_bounds(1)[1]), 1e-9);
  BOOST_TEST(std::abs(dihedral_angle_bounds(bound)[0] - 12.94) < 0.005
             && std::abs(dihedral_angle_bounds(bound)[1] - 154.44) < 0.005);

  // Random tetrahedra, of any shape, never exceed the bounds.
  std::mt19937 random(1);
  const auto uniform = [&] { return random() / 4294967296. * 2 - 1; };
  for(int run = 0; run < 20000; ++run) {
    Points p{};
    for(std::size_t i = 0; i < 4; ++i)
      for(std::size_t k = 0; k < 3; ++k)
        p[i][k] = uniform() * (k == std::size_t(run % 4) ? 0.1 : 1);
    if(!(arc(p) < 1e6))
      continue;
    const auto angles = dihedral_angle_bounds(arc(p));
    BOOST_TEST_GE(dihedral_angle(p, false), angles[0] - 1e-6);
    BOOST_TEST_LE(dihedral_angle(p, true), angles[1] + 1e-6);
  }

  // Random steps that make the angle more extreme, within the bound, never exceed the bounds either.
  for(int largest : {0, 1}) {
    double extreme = 90;
    for(int start = 0; start < 4; ++start) {
      Points p = symmetric_tetrahedron(70);
      double angle = dihedral_angle(p, largest != 0);
      for(int step = 0; step < 20000; ++step) {
        Points q = p;
        const double size = std::pow(10, -1 - 3. * step / 20000);
        for(std::size_t i = 0; i < 4; ++i)
          for(double& c : q[i])
            c += size * uniform();
        const double now = dihedral_angle(q, largest != 0);
        if(arc(q) <= bound && (largest != 0 ? now > angle : now < angle)) {
          p = q;
          angle = now;
        }
      }
      extreme = largest != 0 ? (std::max)(extreme, angle) : (std::min)(extreme, angle);
    }
    BOOST_TEST_LE(std::abs(extreme - dihedral_angle_bounds(bound)[std::size_t(largest)]), 0.1);
  }
}

// ---- results -----------------------------------------------------------------------------------

double largest_arc(const Mesh& mesh) { return quality_statistics(mesh)[number_of_element_kinds].maximum; }

double largest_cost(const Mesh& mesh)
{
  double largest = 0;
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
    largest = (std::max)(largest, Aspect_ratio_quality_3()(mesh.element(e).kind(),
                                                           internal::element_points(mesh, mesh.element(e))));
  return largest;
}

// A ball with spikes (or, with a factor below 1, dents), at every seventh vertex or so.
Test_surface spiky_ball(double factor, int distance, int n)
{
  Test_surface s = sphere({0, 0, 0}, 1, n);
  for(auto v : s.vertices())
    if(int(v) % distance == 0) {
      const Test_point p = s.point(v);
      s.point(v) = {factor * p.x(), factor * p.y(), factor * p.z()};
    }
  return s;
}

// Four plates of a twentieth of their side. One is not quite perpendicular to the axes: else boxes would do.
Test_surface thin_plates()
{
  Test_surface s;
  for(int i = 0; i < 4; ++i)
    add_box(s, {0, 0, 0.3 * i}, {1, 1, 0.3 * i + 0.05});
  Test_point& p = s.point(*s.vertices().begin());
  p = Test_point(p.x(), p.y(), p.z() - 0.01);
  return s;
}

// Surfaces for which meshes used to exceed the bound, and no mesh does now. Vertices that do not arrive are
// counted.
void test_hard_surfaces()
{
  const struct
  {
    const char* name;
    Test_surface surface;
    std::size_t vertices;
  } cases[] = {{"spikes", spiky_ball(2.5, 7, 16), 550}, {"thin plates", thin_plates(), 2000}};
  for(const auto& c : cases) {
    Mesh free, mesh;
    const auto criteria = Mixed_mesh_criteria_3(c.vertices).simplification(false);
    const auto without = make_mixed_mesh_3(c.surface, Mixed_mesh_criteria_3(criteria).quality_bound(0), free);
    BOOST_TEST_GT(largest_arc(free), 3.5);
    BOOST_TEST_GT(number_of_elements_above(free, bound), 10u);
    BOOST_TEST_EQ(without.optimization.number_of_elements_above_bound, 0u); // of infinity
    for(double q : {bound, 5.}) {
      const auto result = make_mixed_mesh_3(c.surface, Mixed_mesh_criteria_3(criteria).quality_bound(q),
                                            mesh);
      const auto& optimization = result.optimization;
      BOOST_TEST_EQ(number_of_elements_above(mesh, q), 0u);
      BOOST_TEST_EQ(optimization.number_of_elements_above_bound, 0u);
      BOOST_TEST_EQ(optimization.quality_bound, q);
      BOOST_TEST_LE(largest_cost(mesh), q);
      BOOST_TEST(find_defects(mesh).none() && optimization.is_boundary_simple);
      const std::size_t off = optimization.number_of_boundary_vertices
                              - optimization.number_of_arrived_vertices;
      BOOST_TEST(off != 0 ? result.status >= CGAL::Mixed_mesh_status::NOT_ALL_ARRIVED
                          : result.status != CGAL::Mixed_mesh_status::NOT_ALL_ARRIVED);
      BOOST_TEST(off != 0 || optimization.number_of_merged_vertices != 0 || q > bound); // it is hard
      BOOST_TEST(q > bound || (off != 0) == (c.vertices == 2000));
      BOOST_TEST_LT(off, optimization.number_of_boundary_vertices / 2);
      const auto angles = dihedral_angle_bounds(q);
      BOOST_TEST_GE(quality_statistics(mesh, smallest_dihedral_angle)[TETRAHEDRON].minimum, angles[0]);
      BOOST_TEST_LE(quality_statistics(mesh, largest_dihedral_angle)[TETRAHEDRON].maximum, angles[1]);
      std::cout << c.name << ": ARC at most " << largest_arc(free) << " without a bound; with " << q << ", "
                << off << " vertices off the surface" << std::endl;
    }
    // A finer mesh that is coarsened has more freedom; arrival has precedence over the bound then.
    const auto coarsened = make_mixed_mesh_3(c.surface, c.vertices, mesh).optimization;
    BOOST_TEST_EQ(coarsened.number_of_arrived_vertices, coarsened.number_of_boundary_vertices);
    BOOST_TEST_EQ(coarsened.quality_bound, bound);
    BOOST_TEST_EQ(number_of_elements_above(mesh, bound), coarsened.number_of_elements_above_bound);
    BOOST_TEST_LE(coarsened.number_of_elements_above_bound, 2u);
  }
}

// Spikes whose faces cut each other on the way if vertices are free, with and without a bound.
void test_crossing_faces()
{
  const struct
  {
    double factor, bound;
    int distance, n;
    std::size_t vertices;
  } cases[] = {{2.5, bound, 2, 24, 300}, {2.5, 0, 7, 24, 600}};
  for(const auto& c : cases) {
    const Test_surface surface = spiky_ball(c.factor, c.distance, c.n);
    const CGAL::Polyhedral_mixed_mesh_domain_3 domain(surface);
    Mesh start;
    make_mixed_mesh_3(domain, Mixed_mesh_criteria_3(c.vertices).fit_to_surface(false).sharp_angle(0), start);
    const Criteria criteria = Criteria().quality_bound(c.bound).sharp_angle(0);
    Mesh mesh = start;
    const auto result = optimize_mixed_mesh_3(mesh, domain, criteria);
    BOOST_TEST(result.is_boundary_simple);
    const bool all_arrived = result.number_of_arrived_vertices == result.number_of_boundary_vertices;
    BOOST_TEST(result.status == (all_arrived ? Status::SUCCESS : Status::NOT_ALL_ARRIVED));
    BOOST_TEST_EQ(number_of_boundary_self_intersections(mesh), 0u);
    BOOST_TEST(find_defects(mesh).none());
    BOOST_TEST_GT(result.number_of_arrived_vertices, result.number_of_boundary_vertices / 2);
    if(c.bound > 0)
      BOOST_TEST_EQ(number_of_elements_above(mesh, c.bound), 0u);
  }
}

struct Stopping_visitor : Default_visitor
{
  std::size_t stop_at = std::size_t(-1), number_of_questions = 0;
  bool go_on() { return number_of_questions++ != stop_at; }
};

// The run is stopped anywhere, on the way that may exceed the bound or on the way within the bound.
void test_stopped()
{
  const Test_surface surface = spiky_ball(2.5, 7, 16);
  const CGAL::Polyhedral_mixed_mesh_domain_3 domain(surface);
  Mesh start;
  make_mixed_mesh_3(domain, Mixed_mesh_criteria_3(300).fit_to_surface(false), start);
  Mesh mesh = start;
  Stopping_visitor patient;
  BOOST_TEST(
    optimize_mixed_mesh_3(mesh, domain, Criteria(), CGAL::parameters::visitor(std::ref(patient))).status
    != Status::STOPPED);
  std::size_t unchanged = 0;
  for(std::size_t i = 0; i < patient.number_of_questions; i += 3) {
    Stopping_visitor impatient;
    impatient.stop_at = i;
    mesh = start;
    const auto result = optimize_mixed_mesh_3(mesh, domain, Criteria(),
                                              CGAL::parameters::visitor(std::ref(impatient)));
    BOOST_TEST(result.status == Status::STOPPED);
    BOOST_TEST_EQ(impatient.number_of_questions, i + 1);
    BOOST_TEST_EQ(number_of_elements_above(mesh, bound), 0u);
    BOOST_TEST(is_positive(mesh));
    unchanged += is_same(mesh, start);
    BOOST_TEST(!is_same(mesh, start)
               || (result.number_of_arrived_vertices == 0 && result.number_of_flips == 0));
  }
  BOOST_TEST(unchanged > 1 && unchanged < patient.number_of_questions / 3);
}

// Vertices that can not arrive are merged, unless elements have to stay.
void test_merging()
{
  const Test_surface surface = spiky_ball(2.5, 7, 16);
  const CGAL::Polyhedral_mixed_mesh_domain_3 domain(surface);
  Mesh start;
  make_mixed_mesh_3(domain, Mixed_mesh_criteria_3(600).fit_to_surface(false), start);
  Mesh merged = start, kept = start;
  const auto with = optimize_mixed_mesh_3(merged, domain, Criteria());
  const auto without = optimize_mixed_mesh_3(kept, domain, Criteria().flips(false));
  BOOST_TEST_GT(with.number_of_merged_vertices, 0u);
  BOOST_TEST_EQ(merged.number_of_vertices(), start.number_of_vertices() - with.number_of_merged_vertices);
  BOOST_TEST_LT(with.number_of_boundary_vertices - with.number_of_arrived_vertices,
                without.number_of_boundary_vertices - without.number_of_arrived_vertices);
  BOOST_TEST(find_defects(merged).none());
  BOOST_TEST_EQ(number_of_boundary_self_intersections(merged), 0u);
  BOOST_TEST_EQ(number_of_elements_above(merged, bound), 0u);
  BOOST_TEST_EQ(without.number_of_merged_vertices, 0u);
  BOOST_TEST(kept.elements().connectivity() == start.elements().connectivity());
}

// The start is from elsewhere, with elements above the bound: none gets worse than the worst of them.
void test_bad_start()
{
  const Test_surface cube = box({0, 0, 0}, {1, 1, 1});
  const CGAL::Polyhedral_mixed_mesh_domain_3 domain(cube);
  for(Element_kind kind : element_kinds)
    for(double q : {1., 1.5, bound}) {
      Mesh start = grid(3, kind);
      distort(start, 0.3, 1);
      const double worst = largest_cost(start);
      BOOST_TEST_GT(worst, bound);
      Mesh mesh = start;
      const auto result = optimize_mixed_mesh_3(mesh, domain, Criteria().quality_bound(q));
      BOOST_TEST(result.status == Status::SUCCESS);
      BOOST_TEST_LT(largest_cost(mesh), worst);
      BOOST_TEST_GE(result.number_of_elements_above_bound, number_of_elements_above(mesh, q));
      // The guarantee holds for another surface, too.
      mesh = start;
      optimize_mixed_mesh_3(mesh, thin_plates(), Criteria().quality_bound(q));
      BOOST_TEST_LE(largest_cost(mesh), worst);
    }
}

int run(int, char*[])
{
  test_start();
  for(Element_kind kind : element_kinds)
    test_proof(kind);
  test_exact_bounds();
  test_dihedral_angles();
  test_hard_surfaces();
  test_crossing_faces();
  test_stopped();
  test_merging();
  test_bad_start();
  return boost::report_errors();
}

} // namespace test_fitting_quality_bound
