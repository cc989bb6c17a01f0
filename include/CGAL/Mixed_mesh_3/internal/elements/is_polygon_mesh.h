// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_IS_POLYGON_MESH_H
#define CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_IS_POLYGON_MESH_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// A corner of a polygon: the vertices before and after, as the polygon winds.
struct Polygon_corner
{
  std::uint32_t before, after;
};

/// Whether corners at one vertex are one fan, open or closed, without an edge twice. Sorts the corners.
inline bool is_fan(Polygon_corner* first, Polygon_corner* last)
{
  const auto is_less = [](const Polygon_corner& c, const Polygon_corner& d) { return c.before < d.before; };
  std::sort(first, last, is_less);
  const auto repeats = [](const Polygon_corner& c, const Polygon_corner& d) { return c.before == d.before; };
  if(std::adjacent_find(first, last, repeats) != last)
    return false;
  // Corners that no other corner precedes begin fans: a closed fan has none, and an open fan has one.
  const auto next = [&](const Polygon_corner& c) {
    const Polygon_corner* n = std::lower_bound(first, last, Polygon_corner{c.after, 0}, is_less);
    return n != last && n->before == c.after ? n : nullptr;
  };
  std::size_t number_of_followed = 0;
  const std::size_t number = std::size_t(last - first);
  for(const Polygon_corner* c = first; c != last; ++c)
    number_of_followed += next(*c) != nullptr;
  if(number_of_followed + 1 < number)
    return false; // several open fans
  const Polygon_corner* start = first;
  if(number_of_followed < number) {
    std::vector<std::uint32_t> after;
    for(const Polygon_corner* c = first; c != last; ++c)
      after.push_back(c->after);
    std::sort(after.begin(), after.end());
    start = std::find_if(first, last, [&](const Polygon_corner& c) {
      return !std::binary_search(after.begin(), after.end(), c.before);
    });
    if(start == last)
      return false;
  }
  std::size_t steps = 1;
  for(const Polygon_corner* c = next(*start); c != nullptr && c != start && steps <= number; c = next(*c))
    ++steps;
  return steps == number;
}

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
  std::vector<Polygon_corner> corners(ends.back());
  std::vector<std::size_t> sorted;
  for(const auto& polygon : polygons) {
    const std::size_t n = polygon.size();
    for(std::size_t i = 0; i < n; ++i)
      corners[ends[polygon[i]]++] = {std::uint32_t(polygon[(i + n - 1) % n]),
                                     std::uint32_t(polygon[(i + 1) % n])};
    sorted.assign(polygon.begin(), polygon.end());
    std::sort(sorted.begin(), sorted.end());
    if(std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
      return false;
  }
  for(std::size_t v = 0, begin = 0; v < number_of_vertices; begin = ends[v++])
    if(begin != ends[v] && !is_fan(corners.data() + begin, corners.data() + ends[v]))
      return false;
  return true;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_IS_POLYGON_MESH_H
