// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_IS_POLYGON_MESH_H
#define CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_IS_POLYGON_MESH_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Index.h>
#include <CGAL/Mixed_mesh_3/internal/elements/manifold_defects.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Whether polygons are the faces of an oriented 2-manifold, with or without a border: none has a vertex
/// twice, no two have an edge in the same direction, and those at a vertex are one fan. The answer is that of
/// CGAL's `is_polygon_soup_a_polygon_mesh()`, which keeps edges in a set: for a million triangles, it takes
/// ten times as long.
/// \param number_of_vertices fewer than 2^32
/// \par Complexity
/// Linear, if few polygons meet in a vertex
template <class Polygons>
bool is_polygon_mesh(const Polygons& polygons, std::size_t number_of_vertices)
{
  std::vector<std::size_t> ends(number_of_vertices + 1, 0); // of the corners of a vertex
  for(const auto& polygon : polygons) {
    if(polygon.size() < 3)
      return false;
    for(std::size_t v : polygon)
      ++ends[v + 1];
  }
  for(std::size_t v = 0; v < number_of_vertices; ++v)
    ends[v + 1] += ends[v];
  std::vector<std::array<Vertex_index, 2>> links(ends.back()); // the vertices before and after, by vertex
  std::vector<std::size_t> sorted;
  for(const auto& polygon : polygons) {
    const std::size_t n = polygon.size();
    for(std::size_t i = 0; i < n; ++i)
      links[ends[polygon[i]]++] = {Vertex_index(polygon[(i + n - 1) % n]),
                                   Vertex_index(polygon[(i + 1) % n])};
    sorted.assign(polygon.begin(), polygon.end());
    std::sort(sorted.begin(), sorted.end());
    if(std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
      return false;
  }
  for(std::size_t v = 0, begin = 0; v < number_of_vertices; begin = ends[v++]) {
    const auto first = links.begin() + std::ptrdiff_t(begin), last = links.begin() + std::ptrdiff_t(ends[v]);
    std::sort(first, last);
    const auto is_same_edge = [](const auto& a, const auto& b) { return a[0] == b[0]; };
    if(first != last && (std::adjacent_find(first, last, is_same_edge) != last || !is_one_fan({first, last})))
      return false;
  }
  return true;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_IS_POLYGON_MESH_H
