// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces that several tests mesh.

#ifndef MIXED_MESH_3_TEST_SURFACES_H
#define MIXED_MESH_3_TEST_SURFACES_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
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
inline void add_sphere(Test_surface& s, const Test_point& centre, double radius, int n)
{
  std::vector<std::vector<Test_surface::Vertex_index>> rings(std::size_t(n) + 1);
  for(int i = 0; i <= n; ++i)
    for(int j = 0; j < (i == 0 || i == n ? 1 : n == 2 ? 4 : 2 * n); ++j) {
      const double a = CGAL_PI * i / n, b = CGAL_PI * j / (n == 2 ? 2 : n);
      const auto exact_if_axis = [&](double x) { return std::abs(x) < 1e-9 ? 0 : x; };
      rings[i].push_back(s.add_vertex(
        centre + radius * Test_kernel::Vector_3(exact_if_axis(std::sin(a) * std::cos(b)),
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

#endif // MIXED_MESH_3_TEST_SURFACES_H
