// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points in elements, and elements at points: the isoparametric map and its inverse compared with the shape
// functions, the locator compared with all elements.

#include "test_meshes.h"

#include <CGAL/Mixed_mesh_3/Element_locator_3.h>
#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/internal/elements/Isoparametric_map_3.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <type_traits>
#include <utility>
#include <vector>

namespace test_elements_locator {

using namespace CGAL::Mixed_meshes_3;

using Kernel = Predicates_kernel;
using Mesh = CGAL::Mixed_mesh_3<Kernel>;

bool is_close(const Vec3& a, const Vec3& b, double tolerance) { return norm(a - b) <= tolerance; }

// Reference coordinates: vertices, midpoints of edges, points of faces, and of the interior.
std::vector<Vec3> sample_points(Element_kind kind)
{
  const Reference_element& reference = reference_elements[kind];
  std::vector<Vec3> samples;
  const auto vertex = [&](int i) {
    return Vec3{double(reference.coordinates[i][0]), double(reference.coordinates[i][1]),
                double(reference.coordinates[i][2])};
  };
  for(int i = 0; i < reference.number_of_vertices; ++i)
    samples.push_back(vertex(i));
  for(int i = 0; i < reference.number_of_edges; ++i)
    for(double t : {0.1, 0.5, 1 - 1e-7})
      samples.push_back((1 - t) * vertex(reference.edges[i][0]) + t * vertex(reference.edges[i][1]));
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto add_mixture = [&](const std::uint8_t* vertices, int n) {
    double sum = 0;
    Vec3 p{};
    for(int i = 0; i < n; ++i) {
      const double w = uniform(random);
      p = p + w * vertex(vertices ? vertices[i] : i);
      sum += w;
    }
    samples.push_back((1 / sum) * p);
  };
  for(int f = 0; f < reference.number_of_faces; ++f)
    for(int i = 0; i < 20; ++i)
      add_mixture(reference.faces[f].vertices, reference.faces[f].size);
  for(int i = 0; i < 100; ++i)
    add_mixture(nullptr, reference.number_of_vertices);
  return samples;
}

void test_locator()
{
  const std::vector<Vec3> none(12, Vec3{});
  std::vector<Vec3> moved;
  for(int i = 0; i < 12; ++i)
    moved.push_back({0.1 * std::sin(i), 0.1 * std::cos(2 * i), 0.05 * i});
  for(double scale : {1e-6, 1., 1e3})
    for(double perturbation : {0., 0.15})
      for(bool is_moved : {false, true}) {
        const Vec3 origin{7 * scale, -300 * scale, 50 * scale};
        const Mesh mesh = four_kinds<Mesh>(scale, origin, perturbation);
        std::vector<Vec3> u = is_moved ? moved : none;
        for(Vec3& v : u)
          v = scale * v;
        const Element_locator_3<Mesh> plain(mesh), displaced(mesh, u);
        const Element_locator_3<Mesh>& locator = is_moved ? displaced : plain;
        std::vector<Vec3> points;
        for(Element_index e = 0; e < 4; ++e)
          for(const Vec3& r : sample_points(mesh.element(e).kind())) {
            Element_location_3 l;
            l.element = e;
            internal::with_kind(mesh.element(e).kind(), [&](auto kind) {
              const auto n = Mixed_element_traits_3<kind.value>::shape_functions(r[0], r[1], r[2]);
              std::copy(n.begin(), n.end(), l.weights.begin());
            });
            const Vec3 p = position(mesh, u, l);
            points.push_back(p);
            const auto found = locator.locate(p);
            if(!BOOST_TEST(found.has_value()))
              continue;
            BOOST_TEST_LE(found->element, e);
            BOOST_TEST(is_close(position(mesh, u, *found), p, 1e-8 * scale));
            if(found->element == e)
              BOOST_TEST(is_close(found->coordinates, r, 1e-6));
            BOOST_TEST_EQ(locator.nearest(p).distance, 0.);
          }
        // Brute force: the first element into whose reference element the point is mapped.
        std::mt19937 random(17);
        std::uniform_real_distribution<double> uniform(-0.5, 2.5);
        for(int i = 0; i < 500; ++i)
          points.push_back(origin + scale * Vec3{uniform(random), uniform(random) / 2, uniform(random)});
        for(const Vec3& p : points) {
          Element_index first = 4;
          for(Element_index e = 0; e < 4 && first == 4; ++e) {
            Vec3 corners[8];
            for(int i = 0; i < mesh.element(e).size(); ++i)
              corners[i] = to_vec3(mesh.point(mesh.element(e)[i])) + u[mesh.element(e)[i]];
            internal::with_kind(mesh.element(e).kind(), [&](auto kind) {
              if(internal::Isoparametric_map_3<kind.value>(corners).inverse(p))
                first = e;
            });
          }
          const auto found = locator.locate(p);
          BOOST_TEST_EQ(found ? found->element : Element_index(4), first);
        }
        // The nearest point is compared with samples of the boundary.
        std::vector<Vec3> surface;
        for(const auto& f : boundary_faces(mesh)) {
          const Face_vertices& v = f.vertices();
          Vec3 c[4];
          for(int i = 0; i < v.size(); ++i)
            c[i] = to_vec3(mesh.point(v[i])) + u[v[i]];
          for(int i = 0; i <= 40; ++i)
            for(int j = 0; j <= 40; ++j) {
              const double a = i / 40., b = j / 40.;
              if(v.size() == 4)
                surface.push_back((1 - a) * ((1 - b) * c[0] + b * c[3]) + a * ((1 - b) * c[1] + b * c[2]));
              else if(i + j <= 40)
                surface.push_back((1 - a - b) * c[0] + a * c[1] + b * c[2]);
            }
        }
        for(std::size_t i = points.size() - 100; i < points.size(); ++i) {
          const Element_location_3 l = locator.nearest(points[i]);
          if(locator.locate(points[i]))
            continue;
          double least = std::numeric_limits<double>::infinity();
          for(const Vec3& q : surface)
            least = (std::min)(least, norm(q - points[i]));
          BOOST_TEST_LE(l.distance, least + 1e-9 * scale);
          BOOST_TEST_LE(least, l.distance + 0.03 * scale);
          BOOST_TEST(std::abs(norm(position(mesh, u, l) - points[i]) - l.distance) < 1e-12 * 1e3 * scale);
          double sum = 0, smallest = 0;
          for(double w : l.weights) {
            sum += w;
            smallest = (std::min)(smallest, w);
          }
          BOOST_TEST(std::abs(sum - 1) < 1e-12 && smallest > -1e-12);
          internal::with_kind(mesh.element(l.element).kind(), [&](auto kind) {
            const auto n = Mixed_element_traits_3<kind.value>::shape_functions(l.coordinates[0],
                                                                               l.coordinates[1],
                                                                               l.coordinates[2]);
            for(std::size_t k = 0; k < n.size(); ++k)
              BOOST_TEST(std::abs(n[k] - l.weights[k]) < 1e-9);
          });
        }
      }
  const Mesh empty;
  BOOST_TEST(!Element_locator_3<Mesh>(empty).locate(Vec3{0, 0, 0}));
}

// Elements of one kind, as distorted as possible with a positive Jacobian.
template <Element_kind Kind>
void test_inverse_map()
{
  const Reference_element& reference = reference_elements[Kind];
  std::mt19937 random(21);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const double amount = Kind == TETRAHEDRON ? 0.2 : Kind == PRISM ? 0.35 : 0.6;
  for(int repeat = 0; repeat < 300; ++repeat) {
    const bool mirror = repeat % 2 == 1;
    Vec3 corners[8];
    for(int i = 0; i < reference.number_of_vertices; ++i)
      for(int k = 0; k < 3; ++k)
        corners[i][k] = (mirror && k == 0 ? -1 : 1)
                        * (reference.coordinates[i][k] + amount * uniform(random));
    const internal::Element_field<Kind> field(corners);
    const internal::Isoparametric_map_3<Kind> map(corners);
    const std::vector<Vec3> samples = sample_points(Kind);
    bool is_valid = true;
    for(const Vec3& r : samples) {
      const auto n = Mixed_element_traits_3<Kind>::shape_functions(r[0], r[1], r[2]);
      Vec3 x{};
      for(int i = 0; i < reference.number_of_vertices; ++i)
        x = x + n[i] * corners[i];
      BOOST_TEST(is_close(field(r), x, 1e-14));
      BOOST_TEST(is_close(map(r), x, 1e-14));
      if(Kind == PYRAMID && r[2] > 0.999)
        continue;
      const auto g = Mixed_element_traits_3<Kind>::shape_gradients(r[0], r[1], r[2]);
      std::array<Vec3, 3> d{};
      for(int i = 0; i < reference.number_of_vertices; ++i)
        for(int k = 0; k < 3; ++k)
          d[k] = d[k] + g[i][k] * corners[i];
      for(int k = 0; k < 3; ++k)
        BOOST_TEST(is_close(field.derivatives(r)[k], d[k], 1e-11));
      is_valid = is_valid && determinant(d[0], d[1], d[2]) * (mirror ? -1 : 1) > 0.02;
    }
    if(!is_valid)
      continue;
    for(const Vec3& r : samples) {
      const auto found = map.inverse(map(r));
      BOOST_TEST(found && is_close(map(*found), map(r), 1e-12));
    }
  }
}
// A locator refers to the mesh, and to no other object that may move.
void test_moved()
{
  using Locator = Element_locator_3<Mesh>;
  static_assert(std::is_move_constructible_v<Locator>);
  const Mesh mesh = four_kinds<Mesh>(1, {0, 0, 0});
  const std::vector<Vec3> displacements(12, Vec3(0.25, 0, 0));
  std::vector<Locator> locators;
  {
    Locator first(mesh, displacements);
    locators.push_back(std::move(first));
  }
  for(int i = 0; i < 5; ++i)
    locators.emplace_back(mesh, displacements);
  for(const Locator& locator : locators) {
    const auto found = locator.locate(Vec3(0.75, 0.5, 0.5));
    BOOST_TEST(found && found->element == 0);
    BOOST_TEST(found && is_close(found->coordinates, {0, 0, 0}, 1e-12));
    BOOST_TEST_EQ(locator.nearest(Vec3(-1, 0.5, 0.5)).distance, 1.25);
  }
}

int run(int, char*[])
{
  test_inverse_map<TETRAHEDRON>();
  test_inverse_map<PYRAMID>();
  test_inverse_map<PRISM>();
  test_inverse_map<HEXAHEDRON>();
  test_locator();
  test_moved();
  return boost::report_errors();
}

} // namespace test_elements_locator
