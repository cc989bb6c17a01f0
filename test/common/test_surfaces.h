// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces and domains for several tests.

#ifndef MIXED_MESH_3_TEST_SURFACES_H
#define MIXED_MESH_3_TEST_SURFACES_H

#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/enum.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

using Test_kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Test_point = Test_kernel::Point_3;
using Test_surface = CGAL::Surface_mesh<Test_point>;

inline void add_box(Test_surface& s, const Test_point& a, const Test_point& b)
{
  Test_surface::Vertex_index v[8];
  for(int i = 0; i < 8; ++i)
    v[i] = s.add_vertex({(i & 1 ? b : a).x(), (i & 2 ? b : a).y(), (i & 4 ? b : a).z()});
  static constexpr int quads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                      {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for(const auto& q : quads) {
    s.add_face(v[q[0]], v[q[1]], v[q[2]]);
    s.add_face(v[q[0]], v[q[2]], v[q[3]]);
  }
}

// Rings of 2n vertices between the poles; an octahedron for n = 2.
inline void add_sphere(Test_surface& s, const Test_point& center, double radius, int n)
{
  std::vector<std::vector<Test_surface::Vertex_index>> rings(std::size_t(n) + 1);
  for(int i = 0; i <= n; ++i)
    for(int j = 0; j < (i == 0 || i == n ? 1 : n == 2 ? 4 : 2 * n); ++j) {
      const double a = CGAL_PI * i / n, b = CGAL_PI * j / (n == 2 ? 2 : n);
      const auto exact_if_axis = [&](double x) { return std::abs(x) < 1e-9 ? 0 : x; };
      rings[i].push_back(s.add_vertex(center
                                      + radius
                                          * Test_kernel::Vector_3(exact_if_axis(std::sin(a) * std::cos(b)),
                                                                  exact_if_axis(std::sin(a) * std::sin(b)),
                                                                  exact_if_axis(std::cos(a)))));
    }
  for(int i = 0; i < n; ++i) {
    const auto &up = rings[i], &down = rings[i + 1];
    const std::size_t m = (std::max)(up.size(), down.size());
    for(std::size_t j = 0; j < m; ++j) {
      const std::size_t k = (j + 1) % m;
      if(down.size() > 1)
        s.add_face(up[j % up.size()], down[j], down[k]);
      if(up.size() > 1)
        s.add_face(up[j], down[k % down.size()], up[k]);
    }
  }
}

inline Test_surface box(const Test_point& a, const Test_point& b)
{
  Test_surface s;
  add_box(s, a, b);
  return s;
}

inline Test_surface sphere(const Test_point& center, double radius, int n)
{
  Test_surface s;
  add_sphere(s, center, radius, n);
  return s;
}

// A domain in the unit cube given by a function of points, positive inside; |f| bounds the distance to the
// surface from below.
class Analytic_domain
{
public:
  using Point_3 = Test_point;
  struct Surface_part
  {
  };

  explicit Analytic_domain(std::function<double(const Point_3&)> f) : m_function(std::move(f)) {}

  CGAL::Bbox_3 bbox() const { return {0, 0, 0, 1, 1, 1}; }
  Surface_part surface_part() const { return {}; }

  template <class Cell>
  CGAL::Bounded_side locate(const Cell& cell, const Surface_part&, Surface_part&) const
  {
    const CGAL::Bbox_3 b = cell.bbox();
    const double radius = std::hypot(b.x_span(), b.y_span(), b.z_span()) / 2;
    const double f = m_function(cell.center());
    return f > radius ? CGAL::ON_BOUNDED_SIDE : f < -radius ? CGAL::ON_UNBOUNDED_SIDE : CGAL::ON_BOUNDARY;
  }

  CGAL::Bounded_side bounded_side(const Point_3& p) const
  {
    const double f = m_function(p);
    return f > 0 ? CGAL::ON_BOUNDED_SIDE : f < 0 ? CGAL::ON_UNBOUNDED_SIDE : CGAL::ON_BOUNDARY;
  }
  CGAL::Bounded_side bounded_side(const Point_3& p, const Surface_part&) const { return bounded_side(p); }

  // A point with the right distance only: not for fitting.
  Point_3 closest_point(const Point_3& p) const
  {
    return p + Test_kernel::Vector_3(std::abs(m_function(p)), 0, 0);
  }
  Point_3 closest_point(const Point_3& p, const Surface_part&) const { return closest_point(p); }
  Point_3 closest_point(const Point_3& p, const Point_3&) const { return closest_point(p); }
  std::vector<Point_3> surface_samples(double) const { return {}; }

private:
  std::function<double(const Point_3&)> m_function;
};

inline std::function<double(const Test_point&)> ball(const Test_point& center, double radius)
{
  return [=](const Test_point& p) { return radius - std::sqrt(CGAL::squared_distance(p, center)); };
}

inline std::function<double(const Test_point&)> united(std::function<double(const Test_point&)> f,
                                                       std::function<double(const Test_point&)> g)
{
  return [=](const Test_point& p) { return (std::max)(f(p), g(p)); };
}

// A random label for each point, without any geometry: the hardest input of the boundary stage. Points within
// `margin` of the border of the unit cube are outside.
inline std::function<double(const Test_point&)> noise(unsigned seed, int share_inside, double margin)
{
  return [=](const Test_point& p) {
    const double x[3] = {p.x(), p.y(), p.z()};
    std::uint64_t hash = seed;
    for(double c : x) {
      if(c < margin || c > 1 - margin)
        return -1e-3;
      hash = (hash ^ std::uint64_t(std::llround(c * 1e7))) * 0x9E3779B97F4A7C15u;
      hash ^= hash >> 29;
    }
    return (hash >> 7) % 100 < std::uint64_t(share_inside) ? 1e-3 : -1e-3;
  };
}

#endif // MIXED_MESH_3_TEST_SURFACES_H
