// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_IMAGE_3_INTERNAL_MARCHING_TETRAHEDRA_H
#define CGAL_MIXED_MESH_IMAGE_3_INTERNAL_MARCHING_TETRAHEDRA_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
The surface where a function on a grid, linear in tetrahedra, has a value (Doi, Koide 1991). Each cube of the
grid is split into six tetrahedra around one diagonal, all cubes alike, so that the tetrahedra are conforming
(Kuhn). The surface in each tetrahedron is empty, a triangle, or two: closed, except at the border of the
grid, and a 2-manifold, whatever the values are.
*/
class Marching_tetrahedra
{
  using Size = std::array<std::size_t, 3>;

  // The least distance of vertices from the ends of an edge, so that no triangle vanishes: an error of one
  // hundredth of a voxel.
  static constexpr double least_share = 0.01;

  const Size m_size;
  const std::vector<float>& m_values;
  const float m_level;
  // Vertices on edges from a slice of the grid and from the next slice, by the edge's first end in the slice
  // and its direction: eight times as many as ends. A map of all edges took more time than everything else.
  std::array<std::vector<std::uint32_t>, 2> m_vertices;
  std::uint32_t m_number_of_vertices = 0;

  static constexpr std::uint32_t no_vertex = std::uint32_t(-1);

public:
  /// \param size,values size and values of the grid; the first index runs fastest
  /// \param level value above which points are inside
  Marching_tetrahedra(const Size& size, const std::vector<float>& values, float level)
    : m_size(size), m_values(values), m_level(level)
  {
  }

  /// \param add_point `void(std::array<double, 3>)`, in indices: called for vertices 0, 1, ...
  /// \param add_triangle `void(std::size_t, std::size_t, std::size_t)`, outward oriented
  template <class AddPoint, class AddTriangle>
  void operator()(const AddPoint& add_point, const AddTriangle& add_triangle)
  {
    for(std::vector<std::uint32_t>& slice : m_vertices)
      slice.assign(8 * m_size[0] * m_size[1], no_vertex);
    for(std::size_t k = 0; k + 1 < m_size[2]; ++k) {
      for(std::size_t j = 0; j + 1 < m_size[1]; ++j)
        for_each_crossed_cube_of_row(j, k, [&](const Size& cube, int inside) {
          march(cube, inside, add_point, add_triangle);
        });
      m_vertices[0].swap(m_vertices[1]);
      std::fill(m_vertices[1].begin(), m_vertices[1].end(), no_vertex);
    }
  }

private:
  std::size_t offset(const Size& p) const { return p[0] + m_size[0] * (p[1] + m_size[1] * p[2]); }

  // A corner of a cube: bit i says whether index i is larger by 1.
  static Size corner(Size p, int corner)
  {
    for(int i = 0; i < 3; ++i)
      p[i] += std::size_t(corner >> i & 1);
    return p;
  }

  /// Calls `f(cube, inside)` for each cube along the first index with corners inside and outside; bit c of
  /// `inside` tells whether corner c is inside.
  template <class F>
  void for_each_crossed_cube_of_row(std::size_t j, std::size_t k, const F& f) const
  {
    const float* const rows[4] = {&m_values[offset({0, j, k})], &m_values[offset({0, j + 1, k})],
                                  &m_values[offset({0, j, k + 1})], &m_values[offset({0, j + 1, k + 1})]};
    const auto column = [&](std::size_t i) { // corners of even numbers
      return int(rows[0][i] > m_level) | int(rows[1][i] > m_level) << 2 | int(rows[2][i] > m_level) << 4
             | int(rows[3][i] > m_level) << 6;
    };
    int first = column(0);
    for(std::size_t i = 0; i + 1 < m_size[0]; ++i) {
      const int second = column(i + 1), inside = first | second << 1;
      first = second;
      if(inside != 0 && inside != 255)
        f(Size{i, j, k}, inside);
    }
  }

  template <class AddPoint, class AddTriangle>
  void march(const Size& cube, int inside, const AddPoint& add_point, const AddTriangle& add_triangle)
  {
    // The tetrahedra lead from corner 0 to corner 7 along the axes in each order, which are positively
    // oriented if the order is an even permutation.
    constexpr int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    for(int o = 0; o < 6; ++o) {
      const int first = 1 << orders[o][0], second = first | 1 << orders[o][1];
      std::array<int, 4> tetrahedron{0, first, second, 7};
      if(o >= 3)
        std::swap(tetrahedron[1], tetrahedron[2]);
      // The corners inside come first.
      const auto is_in = [&](int c) { return (inside >> c & 1) != 0; };
      const int number = int(std::count_if(tetrahedron.begin(), tetrahedron.end(), is_in));
      if(number == 0 || number == 4)
        continue;
      sort(tetrahedron, is_in);
      const auto [a, b, c, d] = tetrahedron;
      const auto vertex = [&](int from, int to) { return vertex_on_edge(cube, from, to, add_point); };
      if(number == 1) {
        add_triangle(vertex(a, b), vertex(a, c), vertex(a, d));
      } else if(number == 3) {
        add_triangle(vertex(a, d), vertex(b, d), vertex(c, d));
      } else {
        const std::size_t ac = vertex(a, c), ad = vertex(a, d), bd = vertex(b, d), bc = vertex(b, c);
        add_triangle(ac, ad, bd);
        add_triangle(ac, bd, bc);
      }
    }
  }

  // Puts the corners inside first, by an even number of swaps.
  template <class IsIn>
  static void sort(std::array<int, 4>& t, const IsIn& is_in)
  {
    bool is_odd = false;
    for(int i = 0; i < 4; ++i)
      for(int j = 3; j > i; --j)
        if(is_in(t[j]) && !is_in(t[j - 1])) {
          std::swap(t[j], t[j - 1]);
          is_odd = !is_odd;
        }
    if(is_odd) // swaps two corners of the same kind
      std::swap(t[is_in(t[1]) ? 0 : 2], t[is_in(t[1]) ? 1 : 3]);
  }

  template <class AddPoint>
  std::size_t vertex_on_edge(const Size& cube, int from, int to, const AddPoint& add_point)
  {
    if(from > to)
      std::swap(from, to);
    const Size p = corner(cube, from), q = corner(cube, to);
    std::uint32_t& vertex = m_vertices[p[2] - cube[2]]
                                      [8 * (p[0] + m_size[0] * p[1]) + std::size_t(to - from)];
    if(vertex == no_vertex) {
      vertex = m_number_of_vertices++;
      const double u = m_values[offset(p)], v = m_values[offset(q)];
      const double t = (std::min)((std::max)((m_level - u) / (v - u), least_share), 1 - least_share);
      std::array<double, 3> point;
      for(int i = 0; i < 3; ++i)
        point[i] = double(p[i]) + t * double(q[i] - p[i]);
      add_point(point);
    }
    return vertex;
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_INTERNAL_MARCHING_TETRAHEDRA_H
