// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parts of the cost of a pyramid, prism or hexahedron that belong to its corners and to its faces. Each
// depends on a few vertices only: when one vertex moves, the other parts stay as they are.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_ASPECT_RATIO_PARTS_H
#define CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_ASPECT_RATIO_PARTS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Mixed_element_traits_3.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/aspect_ratio.h>
#include <CGAL/Mixed_mesh_3/internal/elements/element_measures.h>
#include <CGAL/Mixed_mesh_3/internal/elements/element_points.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The corner tetrahedra and the quadrilaterals that move with a vertex of an element, by their numbers.
struct Parts_around_vertex
{
  struct List
  {
    std::uint8_t parts[8], size;
  };
  List corners, quadrilaterals;
};

/*!
Finds the parts around vertex `v` of an element. All parts move with vertex 0, because positions are relative
to this vertex (`relative_points()`), so that the rounding of each depends on it.
*/
constexpr Parts_around_vertex find_parts_around_vertex(const Reference_element& reference, int v)
{
  Parts_around_vertex result{};
  const auto add = [&](Parts_around_vertex::List& list, int part, const std::uint8_t(&vertices)[4]) {
    bool moves = v == 0;
    for(const std::uint8_t u : vertices)
      moves = moves || u == v;
    if(moves)
      list.parts[list.size++] = std::uint8_t(part);
  };
  for(int c = 0; c < reference.number_of_corners; ++c)
    add(result.corners, c, reference.corners[c]);
  for(int f = 0; f < reference.number_of_faces; ++f)
    if(reference.faces[f].size == 4)
      add(result.quadrilaterals, f, reference.faces[f].vertices);
  return result;
}

struct Parts_table
{
  Parts_around_vertex around[number_of_element_kinds][8];
};

constexpr Parts_table make_parts_table()
{
  Parts_table table{};
  for(const Element_kind kind : element_kinds)
    for(int v = 0; v < reference_elements[kind].number_of_vertices; ++v)
      table.around[kind][v] = find_parts_around_vertex(reference_elements[kind], v);
  return table;
}

inline constexpr Parts_table parts_table = make_parts_table();

/*!
The values of the corners and of the quadrilaterals of an element. After a move of a vertex, only those around
the vertex are computed again. The worst values are searched among all, in the order of the element, so that
the cost is to the bit the cost of the element evaluated whole.

All values are computed before the search, because a search that computes and compares in turn has branches
that processors do not predict: it takes a quarter more time.
*/
class Aspect_ratio_parts
{
  // The cosine between the normals of the two triangles beside a diagonal of a quadrilateral, by its square
  // with the sign kept: the smallest cosine has the smallest square, so one root suffices.
  struct Warp
  {
    double square, product, squares; // product of the normals; product of their squared lengths
  };

  double m_squared_arcs[8]; // of the corner tetrahedra
  Warp m_warps[12];         // diagonals 0 and 1 of each face; undefined for triangles

public:
  /// Computes the parts around vertex `v`; with vertex 0 all parts.
  template <Element_kind kind>
  void update(const Element_points& p, int v)
  {
    const Reference_element& reference = reference_elements[kind];
    const auto& [corners, quadrilaterals] = parts_table.around[kind][v];
    for(int i = 0; i < corners.size; ++i) {
      const auto& k = reference.corners[corners.parts[i]];
      m_squared_arcs[corners.parts[i]] = squared_tetrahedron_arc(p[k[0]], p[k[1]], p[k[2]], p[k[3]]);
    }
    for(int i = 0; i < quadrilaterals.size; ++i)
      for(int diagonal = 0; diagonal < 2; ++diagonal) {
        const int f = quadrilaterals.parts[i];
        const auto [n, m] = triangle_normals(reference.faces[f], diagonal, p);
        const double nm = dot(n, m), nn_mm = dot(n, n) * dot(m, m);
        m_warps[2 * f + diagonal] = {nm * std::abs(nm) / nn_mm, nm, nn_mm};
      }
  }

  /// The largest squared ARC of a corner tetrahedron; infinity if a corner is not positive.
  template <Element_kind kind>
  double largest_squared_arc() const
  {
    double largest = 0;
    for(int c = 0; c < reference_elements[kind].number_of_corners; ++c)
      largest = m_squared_arcs[c] > largest ? m_squared_arcs[c] : largest;
    return largest;
  }

  /// The vertices of the first corner with that squared ARC.
  template <Element_kind kind>
  const std::uint8_t (&corner_with(double squared_arc) const)[4]
  {
    const Reference_element& reference = reference_elements[kind];
    const double* end = m_squared_arcs + reference.number_of_corners;
    const double* found = std::find(m_squared_arcs, end, squared_arc);
    return reference.corners[found < end ? found - m_squared_arcs : 0];
  }

  /// The first diagonal with the largest warp, 2 * face + (0 or 1); -1 if no face is warped.
  template <Element_kind kind>
  int most_warped() const
  {
    const auto& quadrilaterals = parts_table.around[kind][0].quadrilaterals;
    double least = 1;
    int result = -1;
    for(int i = 0; i < quadrilaterals.size; ++i)
      for(int j = 2 * quadrilaterals.parts[i], end = j + 2; j < end; ++j) {
        const bool is_less = m_warps[j].square < least;
        result = is_less ? j : result;
        least = is_less ? m_warps[j].square : least;
      }
    return result;
  }

  /// 1 - cos of the warp at a diagonal.
  double warp(int diagonal) const
  {
    return diagonal < 0 ? 0 : 1 - m_warps[diagonal].product / std::sqrt(m_warps[diagonal].squares);
  }

  /// The gradient of the warp at a diagonal by the position of vertex `v`.
  template <Element_kind kind>
  Vec3 warp_gradient(int diagonal, const Element_points& p, int v) const
  {
    if(diagonal < 0)
      return Vec3{};
    const Element_face& face = reference_elements[kind].faces[diagonal / 2];
    const auto [n, m] = triangle_normals(face, diagonal % 2, p);
    const double ln = norm(n), lm = norm(m), cosine = 1 - warp(diagonal);
    const Vec3 un = (1 / ln) * n, um = (1 / lm) * m;
    // The derivatives of the cosine by the two normals.
    const Vec3 gn = (1 / ln) * (um - cosine * un), gm = (1 / lm) * (un - cosine * um);
    const auto at = [&](int i) { return int(face.vertices[(i + diagonal % 2) % 4]); };
    const Vec3 &a = p[at(0)], &b = p[at(1)], &c = p[at(2)], &d = p[at(3)];
    // The normals are n = (b - a) x (c - a), m = (c - a) x (d - a).
    if(v == at(0))
      return cross(gn, b - c) + cross(gm, c - d);
    if(v == at(1))
      return cross(gn, c - a);
    if(v == at(2))
      return cross(gn, a - b) + cross(gm, d - a);
    if(v == at(3))
      return cross(gm, a - c);
    return Vec3{};
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_ASPECT_RATIO_PARTS_H
