// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Parts of the optimization: gradients of the costs compared with differences, flips on integers.

#include "test_fitting.h"
#include "test_strata.h"

#include <CGAL/Mixed_mesh_3/Aspect_ratio_quality_3.h>
#include <CGAL/Mixed_mesh_3/Scaled_jacobian_quality_3.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Working_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/moves/flips.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Vertex_star.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/surface_targets.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/validation.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace test_fitting_parts {

using namespace CGAL::Mixed_meshes_3;
using CGAL::Mixed_meshes_3::internal::Element_points;

constexpr double infinity = std::numeric_limits<double>::infinity();

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

// Elements with equal edges, except for the height of the pyramid.
Element_points ideal(Element_kind kind, double height_of_pyramid)
{
  return reference_points(kind, std::sqrt(3.), height_of_pyramid);
}

template <class Quality>
void test_gradients(const Quality& quality, double height_of_pyramid, double ideal_tetrahedron,
                    double ideal_prism,
                    const std::function<double(Element_kind, const Element_points&)>& bound)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  constexpr double h = 1e-6;
  std::size_t compared = 0, kinks = 0, inverted = 0;
  for(Element_kind kind : element_kinds) {
    const int n = reference_elements[kind].number_of_vertices;
    // The paper's constant is that of the regular tetrahedron up to rounding.
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
        is_positive = is_positive && determinant(p[k[1]] - p[k[0]], p[k[2]] - p[k[0]], p[k[3]] - p[k[0]]) > 0;
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
  test_gradients(Scaled_jacobian_quality_3(), std::sqrt(0.5), 1, 1,
                 [](Element_kind kind, const Element_points& p) {
                   const double j = internal::scaled_jacobian(kind, p);
                   return j > 0 ? 1 / j : 1;
                 });
  // The cost of the second quality is the reciprocal, not less.
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
  BOOST_TEST(Scaled_jacobian_quality_3(3).is_acceptable(3)
             && !Scaled_jacobian_quality_3(3).is_acceptable(3.1));
}

// ---- flips -------------------------------------------------------------------------------------

// Six times the volumes, on integers, so that volumes are exact.
std::int64_t six_volumes(const Mesh& mesh)
{
  std::int64_t sum = 0;
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e) {
    std::int64_t d[3][3];
    for(int i = 0; i < 3; ++i)
      for(int k = 0; k < 3; ++k)
        d[i][k] = std::int64_t(mesh.point(mesh.element(e)[i + 1])[k])
                  - std::int64_t(mesh.point(mesh.element(e)[0])[k]);
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
    mesh.add_vertex(
      {std::round(100 * std::cos(2 * CGAL_PI * i / n)), std::round(100 * std::sin(2 * CGAL_PI * i / n)), 0});
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

// Flips as inside of a larger mesh, so that nothing is removed. Returns the number of flips, and checks that
// the elements fill the same volume.
std::size_t flip(Mesh& mesh)
{
  const Mesh before = mesh;
  BOOST_TEST(find_defects(before).none());
  internal::Working_mesh working = working_mesh(mesh, boundary_faces(mesh));
  const Aspect_ratio_quality_3 quality;
  internal::Tetrahedron_flipper flipper(working, quality, infinity);
  const auto strata = std::exchange(working.strata, std::vector<internal::Stratum>(mesh.number_of_vertices(),
                                                                                   internal::free_stratum));
  std::set<Vertex_index> changed;
  const std::size_t flips = flipper.run(4, 1, [&](Vertex_index v) { changed.insert(v); });
  working.strata = strata;
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
  return flips;
}

void test_flips()
{
  // A long edge gets a 3-2 flip; a short one does not, where a 2-3 flip does the contrary.
  Mesh mesh = around_axis(3, 120);
  BOOST_TEST_EQ(flip(mesh), 1u);
  BOOST_TEST_EQ(mesh.number_of_elements(), 2u);
  BOOST_TEST_EQ(flip(mesh), 0u);
  mesh = around_axis(3, 30);
  BOOST_TEST_EQ(flip(mesh), 0u);
  mesh = bipyramid(3, 30);
  mesh.add_element(TETRAHEDRON, {2, 3, 4, 1});
  mesh.add_element(TETRAHEDRON, {4, 3, 2, 0}, {1, true});
  BOOST_TEST_EQ(flip(mesh), 1u);
  BOOST_TEST_EQ(mesh.number_of_elements(), 3u);
  BOOST_TEST(has_edge(mesh, 0, 1));
  for(int e = 0; e < 3; ++e) // the region takes what it met
    BOOST_TEST(mesh.is_in_region(std::size_t(e)));

  // No flip crosses the interface of two subdomains: the same two elements, one of them of another subdomain.
  mesh = bipyramid(3, 30);
  mesh.add_element(TETRAHEDRON, {2, 3, 4, 1});
  mesh.add_element(TETRAHEDRON, {4, 3, 2, 0}, {2, false});
  BOOST_TEST_EQ(flip(mesh), 0u);
  BOOST_TEST(mesh.subdomain_index(0) == 1 && mesh.subdomain_index(1) == 2);

  // The flips are 4-4, and rings of 5, 6, 7; larger rings stay.
  for(int n = 4; n <= 8; ++n) {
    mesh = around_axis(n, 250);
    const std::size_t flips = flip(mesh);
    BOOST_TEST_EQ(flips > 0, n <= 7);
    BOOST_TEST_EQ(has_edge(mesh, 0, 1), n > 7);
    BOOST_TEST_EQ(int(mesh.number_of_elements()), n <= 7 ? 2 * (n - 2) : n);
  }

  // No flip inverts new elements: vertex 2 is beyond the axis, and the ring is not convex there.
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

  // The points are random in a cube, in each cell of which the edges are arbitrary.
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

// Edges that were tried in vain are not tried again from the other tetrahedra around them: the flips are
// those of trying all edges of all tetrahedra.
void test_edges_in_vain()
{
  const Aspect_ratio_quality_3 quality;
  std::size_t all_flips = 0;
  for(unsigned seed = 0; seed < 8; ++seed) {
    Mesh mesh = grid(4, TETRAHEDRON);
    distort(mesh, 0.12, seed);
    if(!is_positive(mesh))
      continue;
    internal::Working_mesh working = working_mesh(mesh, boundary_faces(mesh)), reference = working;
    internal::Tetrahedron_flipper flipper(working, quality, infinity);
    const std::size_t flips = flipper.run(4, 1.1, [](Vertex_index) {});
    std::size_t reference_flips = 0;
    for(Element_index e = 0; e < reference.elements.size(); ++e) {
      internal::Flip_context<Aspect_ratio_quality_3> context{reference, quality, infinity};
      if(context.is_tetrahedron(e)
         && context.cost(reference.elements[e].vertices.data()) > internal::power(1.1, 4))
        reference_flips += internal::flip_edges(context, e) || internal::flip_faces(context, e)
                           || internal::remove_from_boundary(context, e);
    }
    all_flips += flips;
    BOOST_TEST_EQ(flips, reference_flips);
    BOOST_TEST(std::equal(working.elements.begin(), working.elements.end(), reference.elements.begin(),
                          reference.elements.end(), [](const auto& a, const auto& b) {
                            return a.is_removed == b.is_removed && a.vertices == b.vertices;
                          }));
  }
  BOOST_TEST_GT(all_flips, 100u);
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
    internal::Working_mesh working = working_mesh(mesh, boundary_faces(mesh));
    const Aspect_ratio_quality_3 quality;
    internal::Tetrahedron_flipper flipper(working, quality, infinity);
    const std::size_t flips = flipper.run(4, 1.4, [](Vertex_index) {});
    BOOST_TEST_EQ(flips, depth < 0.1 ? 1u : 0u);
    BOOST_TEST_EQ(flips, flipper.number_of_removals());
    working.store(mesh);
    BOOST_TEST(find_defects(mesh).none());
    BOOST_TEST_EQ(mesh.number_of_elements(), 3 - flips);
    BOOST_TEST_LE(std::abs(whole - volume(mesh) - double(flips) * depth / 3), 1e-14);
  }
}

// ---- the star of a vertex ----------------------------------------------------------------------

// Tetrahedra with a vertex in common, flat ones among them, anywhere: no element depends on the others.
internal::Working_mesh random_star(std::mt19937& random)
{
  std::uniform_real_distribution<double> uniform(-1, 1);
  const double size = std::pow(10, 3 * uniform(random)), away = std::pow(10, 3 * uniform(random));
  const Vec3 center = (size * away) * Vec3{uniform(random), uniform(random), uniform(random)};
  Mesh mesh;
  const auto add = [&](const Vec3& p) {
    const Vec3 q = center + size * p;
    return mesh.add_vertex(Test_point(q[0], q[1], q[2]));
  };
  const Vertex_index v = add({});
  for(int i = 0; i < 8; ++i) {
    const double flatness = i % 2 == 0 ? 1 : std::pow(10, -8 + 8 * uniform(random));
    std::array<Vertex_index, 4> t{v, {}, {}, {}};
    for(std::size_t k = 1; k < 4; ++k)
      t[k] = add({uniform(random), uniform(random), flatness * uniform(random)});
    std::rotate(t.begin(), t.begin() + i % 4, t.end());
    const auto position = [&](Vertex_index u) { return to_vec3(mesh.point(u)); };
    if(jacobian_sign(Element_view(TETRAHEDRON, t.data()), position) != Jacobian_sign::POSITIVE)
      std::swap(t[0], t[1]);
    mesh.add_element(TETRAHEDRON, t);
  }
  return {mesh, std::vector<internal::Stratum>(mesh.number_of_vertices(), internal::free_stratum)};
}

// Costs by coefficients are those by points, and prove nothing that is not so, by rationals.
void test_star()
{
  const Aspect_ratio_quality_3 quality;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::size_t proved = 0, finite = 0;
  for(int trial = 0; trial < 2000; ++trial) {
    internal::Working_mesh mesh = random_star(random);
    const Vertex_index v(0);
    const Vec3 start = mesh.points[v];
    const double edge = norm(mesh.points[Vertex_index(1)] - start);
    internal::Vertex_star star(mesh, quality, v);
    Vec3 by_coefficients{}, by_points{};
    const double energy = star.energy(4, by_coefficients);
    for(const internal::Working_mesh::Element& element : mesh.elements) {
      Vec3 g{};
      const double q = quality(TETRAHEDRON, mesh.relative_points(element), element.position(v), g);
      by_points = by_points + (4 * q * q * q) * g;
    }
    if(energy < 1e12)
      BOOST_TEST_LE(norm(by_coefficients - by_points), 1e-5 * norm(by_points));
    for(int place = 0; place < 8; ++place) {
      const double step = place == 0 ? 0 : edge * std::pow(10, -4 + 4.5 * uniform(random));
      mesh.points[v] = start + step * Vec3{uniform(random), uniform(random), uniform(random)};
      double sum = 0;
      bool are_positive = true;
      for(const internal::Working_mesh::Element& element : mesh.elements) {
        sum += std::pow(quality(TETRAHEDRON, mesh.relative_points(element)), 4);
        are_positive = are_positive && mesh.is_positive(element);
      }
      const double by_star = star.energy_at(mesh.points[v], 4, 0, infinity, infinity);
      if(by_star < infinity) {
        BOOST_TEST_EQ(star.is_positive(), are_positive);
        proved += are_positive;
      }
      if(by_star < 1e12) { // with larger ones, rounding counts
        BOOST_TEST_LE(std::abs(by_star - sum), 1e-6 * sum);
        ++finite;
      }
    }
  }
  BOOST_TEST_GT(proved, 2000u);
  BOOST_TEST_GT(finite, 200u);
}

// A cost that is as good as it may be to count as a proof, where the volume is what rounding leaves of 0.
void test_proof_by_cost()
{
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::size_t claimed = 0;
  for(int trial = 0; trial < 200000; ++trial) {
    const auto point = [&] { return Vec3{uniform(random), uniform(random), uniform(random)}; };
    const Vec3 u = point(), v = point(), w = point(), x = point();
    const Vec3 n = cross(v - u, w - u); // towards the plane of the others, nearly onto it
    const double height = dot(u - x, n) / dot(n, n);
    const Vec3 y = x + (height * (1 + std::pow(10, -9 + 8 * uniform(random)))) * n;
    internal::Moving_tetrahedron t(Element_index(0), u, v, w);
    const double yy = dot(y, y);
    t.squared_cost = t.at(y, yy);
    if(!t.proves_positive(y, yy))
      continue;
    ++claimed;
    BOOST_TEST(jacobian_sign(TETRAHEDRON, {y, u, v, w}) == Jacobian_sign::POSITIVE);
  }
  BOOST_TEST_GT(claimed, 10000u);
}

// An ideal element at a random place, its vertices moved at random: up to being inverted, and flat in one
// direction at times.
internal::Working_mesh random_element(Element_kind kind, std::mt19937& random)
{
  static constexpr double ideal[number_of_element_kinds][8][3] = {
    {{0, 0, 0}, {1, 0, 0}, {0.5, 0.87, 0}, {0.5, 0.29, 0.82}},
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0.8}},
    {{0, 0, 0}, {1, 0, 0}, {0.5, 0.87, 0}, {0, 0, 1}, {1, 0, 1}, {0.5, 0.87, 1}},
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
  std::uniform_real_distribution<double> uniform(-1, 1);
  const double size = std::pow(10, 3 * uniform(random)),
               shift = random() % 4 == 0 ? 0 : std::pow(10, -0.3 - 2 * std::abs(uniform(random)));
  const double flatness = random() % 2 == 0 ? 1 : std::pow(10, -8 + 8 * uniform(random));
  const Vec3 center = (100 * size) * Vec3{uniform(random), uniform(random), uniform(random)};
  const std::size_t flat = random() % 3;
  Mesh mesh;
  std::vector<Vertex_index> vertices;
  for(int i = 0; i < reference_elements[kind].number_of_vertices; ++i) {
    Vec3 p = Vec3(ideal[kind][i][0], ideal[kind][i][1], ideal[kind][i][2])
             + shift * Vec3{uniform(random), uniform(random), uniform(random)};
    p[flat] *= flatness;
    p = center + size * p;
    vertices.push_back(mesh.add_vertex(Test_point(p[0], p[1], p[2])));
  }
  mesh.add_element(kind, vertices);
  return {mesh, std::vector<internal::Stratum>(mesh.number_of_vertices(), internal::free_stratum)};
}

// Moves of each vertex of each kind: the star has the bits of the cost, and of the gradient, of the element
// evaluated whole, except for tetrahedra by coefficients; it proves positive what the certificate does.
template <class Quality>
void test_star_of_element(const Quality& quality, bool has_coefficients)
{
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for(Element_kind kind : element_kinds)
    for(int i = 0; i < reference_elements[kind].number_of_vertices; ++i) {
      std::size_t positive = 0, not_positive = 0, infinite = 0;
      for(int trial = 0; trial < 500; ++trial) {
        internal::Working_mesh mesh = random_element(kind, random);
        const internal::Working_mesh::Element& element = mesh.elements.front();
        const Vertex_index v = element.vertices[std::size_t(i)];
        const bool is_exact = !(has_coefficients && kind == TETRAHEDRON);
        const Vec3 start = mesh.points[v];
        const double diagonal = norm(mesh.points[element.vertices[2]] - mesh.points[element.vertices[0]]);
        internal::Vertex_star<Quality> star(mesh, quality, v);
        Vec3 gradient{}, expected_gradient{};
        const double energy = star.energy(4, gradient);
        const double whole = quality(kind, mesh.relative_points(element), i, expected_gradient);
        if(is_exact) {
          BOOST_TEST_EQ(energy, internal::power(whole, 4));
          if(whole < infinity)
            BOOST_TEST(gradient == Vec3{} + (4 * internal::power(whole, 4) / whole) * expected_gradient);
        }
        for(int move = 0; move < 8; ++move) { // of one star: nothing may be left of the move before
          const double step = move == 4 ? 0 : diagonal * std::pow(10, -4 + 4.2 * uniform(random));
          mesh.points[v] = start + step * Vec3{uniform(random), uniform(random), uniform(random)};
          const double by_star = star.energy_at(mesh.points[v], 4, 0, infinity, infinity);
          const double cost = quality(kind, mesh.relative_points(element));
          star.for_each_cost([&](Element_index, double c) {
            if(is_exact)
              BOOST_TEST_EQ(c, cost);
            else if(cost < 1e3) // with larger ones, rounding counts
              BOOST_TEST_LE(std::abs(c - cost), 1e-6 * cost);
          });
          infinite += !(by_star < infinity);
          if(by_star < infinity) {
            const bool is_positive = jacobian_sign(element, mesh.position()) == Jacobian_sign::POSITIVE;
            BOOST_TEST_EQ(star.is_positive(), is_positive);
            ++(is_positive ? positive : not_positive);
          }
        }
      }
      BOOST_TEST_GT(positive, 500u);
      BOOST_TEST_GT(infinite, 50u);
      if(kind == HEXAHEDRON) // positive at the corners, but not between them
        BOOST_TEST_GT(not_positive, 10u);
    }
}

int run(int, char*[])
{
  test_qualities();
  test_star();
  test_star_of_element(Aspect_ratio_quality_3(), true);
  test_star_of_element(Aspect_ratio_quality_3(7, 0), true);
  test_star_of_element(Scaled_jacobian_quality_3(), false); // as any quality of a user
  test_proof_by_cost();
  test_flips();
  test_edges_in_vain();
  test_removal();
  return boost::report_errors();
}

} // namespace test_fitting_parts
