// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Displacements between vertices from recovered gradients: exact reproduction, continuity, and the inverse.

#include "test_grids.h"

#include <CGAL/Mixed_mesh_3/Element_locator_3.h>
#include <CGAL/Mixed_mesh_3/Recovered_displacement_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/for_each_face.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

namespace test_elements_recovery {

using namespace CGAL::Mixed_meshes_3;
using internal::Gradient;

using Recovered = Recovered_displacement_3<Mesh>;

constexpr Gradient_recovery recoveries[] = {Gradient_recovery::AVERAGE, Gradient_recovery::LEAST_SQUARES};

Vec3 linear(const Vec3& x)
{
  return {0.3 * x[0] - 0.2 * x[1] + 0.1 * x[2] + 4, 0.1 * x[0] + 0.05 * x[2] - 2,
          0.2 * x[1] - 0.1 * x[2] + 1};
}

// `size` times a polynomial of degree 2.
Vec3 quadratic(const Vec3& x, double size)
{
  return size
         * Vec3{x[0] * x[0] - 2 * x[1] * x[2] + x[2], x[0] * x[1] + 3 * x[2] * x[2] - x[0],
                2 * x[1] * x[1] + x[0] * x[2] - x[1] * x[1] + 1};
}

Gradient quadratic_gradient(const Vec3& x, double size)
{
  return {size * Vec3{2 * x[0], x[1] - 1, x[2]}, size * Vec3{-2 * x[2], x[0], 2 * x[1]},
          size * Vec3{-2 * x[1] + 1, 6 * x[2], x[0]}};
}

double distance(const Gradient& a, const Gradient& b)
{
  return (std::max)({norm(a[0] - b[0]), norm(a[1] - b[1]), norm(a[2] - b[2])});
}

std::vector<Vec3> at_vertices(const Mesh& mesh, const std::function<Vec3(const Vec3&)>& u)
{
  std::vector<Vec3> values;
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
    values.push_back(u(position(mesh, v)));
  return values;
}

Element_location_3 location(const Mesh& mesh, Element_index e, const std::array<double, 8>& weights)
{
  Element_location_3 l;
  l.element = e;
  const Element_view element = mesh.element(e);
  for(int i = 0; i < element.size(); ++i)
    for(int k = 0; k < 3; ++k)
      l.coordinates[k] += weights[i] * element.reference().coordinates[i][k];
  internal::with_kind(element.kind(), [&](auto kind) {
    const auto n = Mixed_element_traits_3<kind.value>::shape_functions(l.coordinates[0], l.coordinates[1],
                                                                       l.coordinates[2]);
    std::copy(n.begin(), n.end(), l.weights.begin());
  });
  return l;
}

// A point of an element, inside.
Element_location_3 random_location(const Mesh& mesh, Element_index e, Noise& random)
{
  std::array<double, 8> weights{};
  double sum = 0;
  for(int i = 0; i < mesh.element(e).size(); ++i)
    sum += weights[i] = 0.01 + std::abs(random());
  for(double& w : weights)
    w /= sum;
  return location(mesh, e, weights);
}

Vec3 point(const Mesh& mesh, const Element_location_3& l)
{
  Vec3 x{};
  for(int i = 0; i < mesh.element(l.element).size(); ++i)
    x = x + l.weights[i] * position(mesh, mesh.element(l.element)[i]);
  return x;
}

// Calls `f(location)` for some points of each element that has not been removed.
template <class F>
void for_each_sample(const Recovered& u, const F& f)
{
  Noise random;
  for(Element_index e = 0; e < u.mesh().number_of_elements(); ++e)
    for(int i = 0; i < 4; ++i) {
      const Element_location_3 l = random_location(u.mesh(), e, random);
      if(!u.is_removed(e))
        f(l);
    }
}

double largest_error(const Recovered& u, const std::function<Vec3(const Vec3&)>& exact)
{
  double largest = 0;
  for_each_sample(u, [&](const Element_location_3& l) {
    largest = (std::max)(largest, norm(u(l) - exact(point(u.mesh(), l))));
  });
  return largest;
}

// The largest errors, away from the boundary; also of the shape functions.
struct Errors
{
  double recovered = 0, plain = 0;

  Errors(const Recovered& u, const std::function<Vec3(const Vec3&)>& exact)
  {
    for_each_sample(u, [&](const Element_location_3& l) {
      const Vec3 x = point(u.mesh(), l);
      if((std::min)({x[0], x[1], x[2], 1 - x[0], 1 - x[1], 1 - x[2]}) < 0.25)
        return;
      Vec3 v{};
      const Element_view element = u.mesh().element(l.element);
      for(int i = 0; i < element.size(); ++i)
        v = v + l.weights[i] * u.displacements()[element[i]];
      recovered = (std::max)(recovered, norm(u(l) - exact(x)));
      plain = (std::max)(plain, norm(v - exact(x)));
    });
  }
};

// An element with exact gradients has the polynomial, however distorted the element is.
template <Element_kind Kind>
void test_quadratic_on_element()
{
  constexpr int n = reference_elements[Kind].number_of_vertices;
  Noise random;
  for(int repeat = 0; repeat < 20; ++repeat) {
    Vec3 x[8], u[8];
    for(int i = 0; i < n; ++i) {
      for(int k = 0; k < 3; ++k)
        x[i][k] = reference_elements[Kind].coordinates[i][k] + 0.15 * random();
      u[i] = quadratic(x[i], 1);
    }
    internal::Bubbles b{};
    for(int j = 0; j < n; ++j)
      for(int i = 0; i < j; ++i) {
        const Vec3 edge = x[j] - x[i];
        b[internal::pair_index(i, j)] = 0.5
                                        * (internal::product_of_columns(quadratic_gradient(x[i], 1), edge)
                                           - internal::product_of_columns(quadratic_gradient(x[j], 1), edge));
      }
    const internal::Element_field<Kind> positions(x);
    const internal::Quadratic_field<Kind> field(u, b);
    for(int sample = 0; sample < 50; ++sample) {
      Vec3 r;
      for(double& c : r)
        c = 0.8 * random(); // also outside
      const Vec3 p = positions(r);
      BOOST_TEST_LT(norm(field(r) - quadratic(p, 1)), 1e-10);
      const auto [value, derivatives] = field.value_and_derivatives(r);
      BOOST_TEST_LT(norm(value - quadratic(p, 1)), 1e-10);
      const auto d = positions.derivatives(r);
      if(std::abs(determinant(d[0], d[1], d[2])) > 0.02)
        BOOST_TEST_LT(distance(internal::gradient_in_space(derivatives, d), quadratic_gradient(p, 1)), 1e-9);
    }
  }
}

void test_reproduction()
{
  for(Element_kind kind : element_kinds) {
    Mesh mesh = grid(4, kind, 0.15);
    for(Gradient_recovery recovery : recoveries) {
      const Recovered u(mesh, at_vertices(mesh, linear), {}, recovery);
      BOOST_TEST_LT(largest_error(u, linear), 1e-13);
      for_each_sample(u, [&](const Element_location_3& l) {
        BOOST_TEST_LT(distance(u.gradient(l), {Vec3{0.3, 0.1, 0}, {-0.2, 0, 0.2}, {0.1, 0.05, -0.1}}), 1e-11);
      });
      for(Vertex_index v : mesh.element(7)) { // at a vertex nothing is interpolated
        const auto exact = [](const Vec3& x) { return quadratic(x, 0.02); };
        const Recovered q(mesh, at_vertices(mesh, exact), {}, recovery);
        Element_location_3 l;
        l.element = 7;
        l.weights[std::find(mesh.element(7).begin(), mesh.element(7).end(), v) - mesh.element(7).begin()] = 1;
        BOOST_TEST_EQ(norm(q(l) - exact(position(mesh, v))), 0.);
      }
    }
    const auto exact = [](const Vec3& x) { return quadratic(x, 0.02); };
    const Recovered u(mesh, at_vertices(mesh, exact), {}, Gradient_recovery::LEAST_SQUARES);
    BOOST_TEST_EQ(u.number_of_linear_elements(), 0u);
    BOOST_TEST_LT(largest_error(u, exact), 1e-12);
    for_each_sample(u, [&](const Element_location_3& l) {
      BOOST_TEST_LT(distance(u.gradient(l), quadratic_gradient(point(mesh, l), 0.02)), 1e-10);
    });
  }
}

// The error falls with the third power of the size of elements; the error of the shape functions with the
// second.
void test_order()
{
  const auto exact = [](const Vec3& x) {
    return 0.05 * Vec3{std::sin(3 * x[0] + x[1]), std::cos(2 * x[1] - 3 * x[2]), std::exp(x[0] * x[2])};
  };
  for(Element_kind kind : element_kinds) {
    const Mesh coarse = grid(6, kind, 0.1), fine = grid(12, kind, 0.1);
    for(Gradient_recovery recovery : recoveries) {
      const Errors of_coarse(Recovered(coarse, at_vertices(coarse, exact), {}, recovery), exact);
      const Errors of_fine(Recovered(fine, at_vertices(fine, exact), {}, recovery), exact);
      BOOST_TEST_LT(of_coarse.recovered, 0.5 * of_coarse.plain);
      BOOST_TEST_LT(of_fine.plain, of_coarse.plain / 3);
      BOOST_TEST_LT(of_coarse.plain / 5, of_fine.plain);
      if(recovery == Gradient_recovery::LEAST_SQUARES)
        BOOST_TEST_LT(of_fine.recovered, of_coarse.recovered / 6);
    }
  }
}

// Checks the displacement on common faces, seen from both sides. Returns the number of faces.
int check_continuity(const Recovered& u)
{
  const Mesh& mesh = u.mesh();
  Noise random;
  int number = 0;
  internal::for_each_face(mesh.elements(), mesh.number_of_vertices(), [&](const auto& group) {
    if(group.size() != 2 || u.is_removed(group.element(0)) || u.is_removed(group.element(1)))
      return;
    ++number;
    for(int sample = 0; sample < 5; ++sample) {
      const Face_vertices face = group[0].vertices();
      const double a = std::abs(random()), b = (1 - a) * std::abs(random());
      const double s = a, t = std::abs(random());
      const double of_triangle[] = {a, b, 1 - a - b};
      const double of_quadrilateral[] = {(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t};
      Vec3 values[2];
      for(int side = 0; side < 2; ++side) {
        Element_location_3 l;
        l.element = group.element(side);
        const Element_view element = mesh.element(l.element);
        for(int i = 0; i < face.size(); ++i)
          l.weights[std::find(element.begin(), element.end(), face[i]) - element.begin()] = //
            face.size() == 3 ? of_triangle[i] : of_quadrilateral[i];
        values[side] = u(l);
      }
      BOOST_TEST_LT(norm(values[0] - values[1]), 1e-14);
    }
  });
  return number;
}

void test_continuity()
{
  Noise random;
  const auto noise = [&random](double size, std::size_t n) {
    std::vector<Vec3> u(n);
    for(Vec3& v : u)
      for(double& c : v)
        c = size * random();
    return u;
  };
  for(Gradient_recovery recovery : recoveries) {
    std::vector<Mesh> meshes{four_kinds<Mesh>(1, {0, 0, 0}, 0.1)};
    for(Element_kind kind : element_kinds)
      meshes.push_back(grid(3, kind, 0.1));
    for(Mesh& mesh : meshes) {
      const std::size_t n = mesh.number_of_vertices();
      BOOST_TEST_LE(3, check_continuity(Recovered(mesh, noise(0.02, n), {}, recovery)));
      std::vector<bool> removed(mesh.number_of_elements());
      for(Element_index e = 0; e < mesh.number_of_elements(); ++e) {
        removed[e] = mesh.number_of_elements() > 4 && random() > 0.7;
        mesh.set_subdomain_index(e, random() > 0 ? 1 : random() > 0 ? 2 : 5);
      }
      const Recovered u(mesh, noise(0.02, n), removed, recovery);
      BOOST_TEST_LE(3, check_continuity(u));
      // Some elements fall back to shape functions.
      const Recovered wild(mesh, noise(0.2, n), removed, recovery);
      check_continuity(wild);
      const std::vector<Vec3> values = at_vertices(mesh, linear);
      BOOST_TEST_LT(largest_error(Recovered(mesh, values, removed, recovery), linear), 1e-13);
    }
  }
}

// Two materials with a common plane: the gradient jumps there.
void test_subdomains()
{
  const auto exact = [](const Vec3& x) {
    const double d = x[0] - 0.5;
    return 0.02 * (Vec3{x[1] * x[1], x[1] * x[2], x[2]} + (d > 0 ? d : -2 * d) * Vec3{1, x[1], d + x[2]});
  };
  for(Element_kind kind : element_kinds) {
    Noise random;
    Mesh mesh = grid_of_cells<Mesh>(4, kind, [&](double x, double y, double z) {
      const double dx = x == 2 ? 0 : 0.1 * random();
      return Test_point((x + dx) / 4, (y + 0.1 * random()) / 4, z / 4);
    });
    const std::vector<Vec3> values = at_vertices(mesh, exact);
    const Recovered smeared(mesh, values, {}, Gradient_recovery::LEAST_SQUARES);
    for(Element_index e = 0; e < mesh.number_of_elements(); ++e) {
      double x = 0;
      for(Vertex_index v : mesh.element(e))
        x += position(mesh, v)[0] / mesh.element(e).size();
      mesh.set_subdomain_index(e, x < 0.5 ? 1 : 2);
    }
    const Recovered u(mesh, values, {}, Gradient_recovery::LEAST_SQUARES);
    BOOST_TEST_LT(largest_error(u, exact), 1e-12);
    BOOST_TEST_LT(1e-4, largest_error(smeared, exact));
    check_continuity(u);
  }
}

// Only the remaining elements count: the field is that of a mesh of these elements.
void test_cavity()
{
  for(Element_kind kind : element_kinds) {
    const Mesh mesh = grid(4, kind, 0.1);
    std::vector<bool> removed;
    Mesh rest;
    for(const auto& p : mesh.points())
      rest.add_vertex(p);
    std::vector<Element_index> index(mesh.number_of_elements());
    std::vector<bool> is_used(mesh.number_of_vertices(), false);
    for(Element_index e = 0; e < mesh.number_of_elements(); ++e) {
      bool is_inside = true;
      for(Vertex_index v : mesh.element(e))
        is_inside = is_inside && norm(position(mesh, v) - Vec3{0.5, 0.5, 1}) < 0.6;
      removed.push_back(is_inside);
      if(is_inside)
        continue;
      for(Vertex_index v : mesh.element(e))
        is_used[v] = true;
      index[e] = rest.add_element(mesh.element(e).kind(), mesh.element(e).begin());
    }
    BOOST_TEST(std::count(removed.begin(), removed.end(), true) >= 4);
    std::vector<Vec3> values = at_vertices(mesh, [](const Vec3& x) { return quadratic(x, 0.02); });
    for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
      if(!is_used[v])
        values[v].fill(std::numeric_limits<double>::quiet_NaN());
    for(Gradient_recovery recovery : recoveries) {
      const Recovered u(mesh, values, removed, recovery), v(rest, values, {}, recovery);
      for_each_sample(u, [&](Element_location_3 l) {
        const Vec3 expected = u(l);
        l.element = index[l.element];
        BOOST_TEST_EQ(norm(v(l) - expected), 0.);
      });
    }
    const Recovered u(mesh, values, removed);
    const Element_locator_3<Mesh> locator(u),
      plain(mesh, std::vector<Vec3>(mesh.number_of_vertices(), Vec3{}));
    const Vec3 middle{0.5, 0.5, 0.99};
    BOOST_TEST(plain.locate(middle) && !locator.locate(middle + quadratic(middle, 0.02)));
    BOOST_TEST(!removed[locator.nearest(middle).element]);
    BOOST_TEST(locator.nearest(middle).distance > 0.05);
  }
}

// The inverse leads back.
void test_inverse()
{
  const auto bend = [](const Vec3& x) {
    return 0.1 * Vec3{std::sin(3 * x[1]), std::cos(4 * x[2]) - 1, -std::exp(-2 * x[0] * x[0])};
  };
  for(double scale : {1e-3, 1., 1e3}) {
    std::vector<Mesh> meshes{four_kinds<Mesh>(scale, {3 * scale, 0, -scale}, 0.1)};
    for(Element_kind kind : element_kinds)
      meshes.push_back(grid_of_cells<Mesh>(3, kind, [scale](double x, double y, double z) {
        return Test_point(scale * (x + 0.2 * y) / 3, scale * y / 3, scale * (z - 0.1 * x * y) / 3);
      }));
    for(const Mesh& mesh : meshes)
      for(Gradient_recovery recovery : recoveries) {
        const Recovered u(mesh,
                          at_vertices(mesh, [&](const Vec3& x) { return scale * bend((1 / scale) * x); }), {},
                          recovery);
        const Element_locator_3<Mesh> locator(u);
        for_each_sample(u, [&](const Element_location_3& l) {
          const Vec3 x = point(mesh, l);
          const auto found = locator.locate(x + u(l));
          if(!BOOST_TEST(found.has_value()))
            return;
          BOOST_TEST_EQ(found->element, l.element);
          BOOST_TEST_LT(norm(point(mesh, *found) - x), 1e-9 * scale);
          BOOST_TEST_EQ(locator.nearest(x + u(l)).distance, 0.);
        });
      }
  }
}

// A bump of the size of an element: a quadratic field would fold the mesh, shape functions do not.
void test_orientation()
{
  std::size_t number = 0;
  for(Element_kind kind : element_kinds)
    for(double height : {0.1, 0.2, 0.3}) {
      const Mesh mesh = grid(4, kind, 0.05);
      std::vector<Vec3> values(mesh.number_of_vertices(), Vec3{});
      for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
        if(norm(position(mesh, v) - Vec3{0.5, 0.5, 0.5}) < 0.1)
          values[v] = {0, 0, height};
      const Recovered u(mesh, values, {}, Gradient_recovery::LEAST_SQUARES);
      check_continuity(u);
      number += u.number_of_linear_elements();
      // The remaining formula does not fold where the shape functions do not.
      const Element_locator_3<Mesh> locator(u), plain(mesh, values);
      std::size_t found = 0, all = 0;
      for_each_sample(u, [&](const Element_location_3& l) {
        Gradient g = u.gradient(l);
        for(int k = 0; k < 3; ++k)
          g[k][k] += 1;
        if(height < 0.25) {
          BOOST_TEST_LT(0, determinant(g[0], g[1], g[2]));
          const auto back = locator.locate(point(mesh, l) + u(l));
          ++all;
          found += back && norm(point(mesh, *back) - point(mesh, l)) < 1e-8;
        }
      });
      BOOST_TEST_EQ(found, all);
    }
  BOOST_TEST_LT(0u, number);
}

int run(int, char*[])
{
  test_quadratic_on_element<TETRAHEDRON>();
  test_quadratic_on_element<PYRAMID>();
  test_quadratic_on_element<PRISM>();
  test_quadratic_on_element<HEXAHEDRON>();
  test_reproduction();
  test_order();
  test_continuity();
  test_subdomains();
  test_cavity();
  test_inverse();
  test_orientation();
  return boost::report_errors();
}

} // namespace test_elements_recovery
