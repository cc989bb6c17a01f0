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
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
The surface where a function on a grid, linear in tetrahedra, has a value (Doi, Koide 1991). Each cube of the
grid is split into six tetrahedra around one diagonal, all cubes alike, so that the tetrahedra are conforming
(Kuhn). In each, the surface is empty, a triangle, or two: closed, but at the border of the grid, and a
2-manifold, whatever the values are.
*/
class Marching_tetrahedra
{
  using Size = std::array<std::size_t, 3>;

  // Vertices are kept that far from the ends of an edge, so that no triangle vanishes: an error of one
  // hundredth of a voxel.
  static constexpr double least_share = 0.01;

  const Size m_size;
  const std::vector<float>& m_values;
  const float m_level;
  std::unordered_map<std::uint64_t, std::size_t> m_vertices; // by edge

public:
  /// \param size,values of the grid; the first index runs fastest
  /// \param level what is larger is inside
  Marching_tetrahedra(const Size& size, const std::vector<float>& values, float level)
    : m_size(size), m_values(values), m_level(level)
  {
  }

  /// \param add_point `void(std::array<double, 3>)`, in indices: called for vertices 0, 1, ...
  /// \param add_triangle `void(std::size_t, std::size_t, std::size_t)`, outward oriented
  template <class AddPoint, class AddTriangle>
  void operator()(const AddPoint& add_point, const AddTriangle& add_triangle)
  {
    Size p;
    for(p[2] = 0; p[2] + 1 < m_size[2]; ++p[2])
      for(p[1] = 0; p[1] + 1 < m_size[1]; ++p[1])
        for(p[0] = 0; p[0] + 1 < m_size[0]; ++p[0])
          march(p, add_point, add_triangle);
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

  bool is_inside(const Size& p) const { return m_values[offset(p)] > m_level; }

  template <class AddPoint, class AddTriangle>
  void march(const Size& cube, const AddPoint& add_point, const AddTriangle& add_triangle)
  {
    int inside = 0;
    for(int c = 0; c < 8; ++c)
      inside |= int(is_inside(corner(cube, c))) << c;
    if(inside == 0 || inside == 255)
      return;
    // From corner 0 to corner 7 along the axes in each order; positively oriented if that is an even one.
    constexpr int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    for(int o = 0; o < 6; ++o) {
      const int first = 1 << orders[o][0], second = first | 1 << orders[o][1];
      std::array<int, 4> tetrahedron{0, first, second, 7};
      if(o >= 3)
        std::swap(tetrahedron[1], tetrahedron[2]);
      // those inside come first
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

  // Puts those that are inside first, by an even number of swaps.
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
    if(is_odd) // two of a kind, at one of the ends
      std::swap(t[is_in(t[1]) ? 0 : 2], t[is_in(t[1]) ? 1 : 3]);
  }

  template <class AddPoint>
  std::size_t vertex_on_edge(const Size& cube, int from, int to, const AddPoint& add_point)
  {
    if(from > to)
      std::swap(from, to);
    const Size p = corner(cube, from), q = corner(cube, to);
    const auto [found, is_new] = m_vertices.try_emplace(8 * std::uint64_t(offset(p)) + unsigned(to - from),
                                                        m_vertices.size());
    if(is_new) {
      const double u = m_values[offset(p)], v = m_values[offset(q)];
      const double t = (std::min)((std::max)((m_level - u) / (v - u), least_share), 1 - least_share);
      std::array<double, 3> point;
      for(int i = 0; i < 3; ++i)
        point[i] = double(p[i]) + t * double(q[i] - p[i]);
      add_point(point);
    }
    return found->second;
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_INTERNAL_MARCHING_TETRAHEDRA_H
