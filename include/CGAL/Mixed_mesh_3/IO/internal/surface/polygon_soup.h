// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Polygons with indices of points, before they are a mesh: edges, connected parts, area, volume.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_POLYGON_SOUP_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_POLYGON_SOUP_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Disjoint_sets.h>
#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <iterator>
#include <locale>
#include <map>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

using Points = std::vector<Predicates_kernel::Point_3>;
using Polygons = std::vector<std::vector<std::size_t>>;
using Triangles = std::vector<std::array<std::size_t, 3>>;

inline std::string counted(std::size_t n, const char* one, const char* many)
{
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

struct Edge_counts
{
  std::size_t open = 0, nonmanifold = 0; // edges with one face, and with more than two
  bool is_oriented = true;               // no edge occurs twice in the same direction
};

// A polygon at an undirected edge, in one number: the smaller vertex, the larger one, and whether the polygon
// has them in this order. There are fewer than 2^31 points.
class Polygon_edge
{
  std::uint64_t m_code;

public:
  Polygon_edge(std::size_t a, std::size_t b)
    : m_code(std::uint64_t((std::min)(a, b)) << 32 | std::uint64_t((std::max)(a, b)) << 1 | (a < b))
  {
  }

  std::size_t low() const { return std::size_t(m_code >> 32); }
  std::size_t high() const { return std::size_t(m_code >> 1 & 0x7fffffff); }
  bool is_upwards() const { return (m_code & 1) != 0; }
  bool is_at_edge_of(const Polygon_edge& e) const { return m_code >> 1 == e.m_code >> 1; }
  bool operator<(const Polygon_edge& e) const { return m_code < e.m_code; }
};

// Calls `use(first, last)` for each edge, in ascending order, with the range of polygons at the edge.
template <class Use>
void for_each_edge(const Polygons& polygons, const Use& use)
{
  std::vector<Polygon_edge> edges;
  edges.reserve(3 * polygons.size());
  for(const auto& polygon : polygons)
    for(std::size_t i = 0; i < polygon.size(); ++i)
      edges.emplace_back(polygon[i], polygon[(i + 1) % polygon.size()]);
  std::sort(edges.begin(), edges.end());
  for(auto first = edges.cbegin(), last = first; first != edges.cend(); first = last) {
    while(last != edges.cend() && last->is_at_edge_of(*first))
      ++last;
    use(first, last);
  }
}

inline Edge_counts count_edges(const Polygons& polygons)
{
  Edge_counts counts;
  for_each_edge(polygons, [&counts](auto first, auto last) {
    counts.open += last - first == 1;
    counts.nonmanifold += last - first > 2;
    if(last - first == 2 && first[0].is_upwards() == first[1].is_upwards())
      counts.is_oriented = false;
  });
  return counts;
}

// "1.25e+200"
inline std::string number_text(double x)
{
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(7);
  out << x;
  return out.str();
}

// "(1, 2, 3)"
inline std::string place_text(const Predicates_kernel::Point_3& point)
{
  const Vec3 p = to_vec3(point);
  return "(" + number_text(p[0]) + ", " + number_text(p[1]) + ", " + number_text(p[2]) + ")";
}

// Triangulates polygons such that the area is small, if a polygon is not convex.
inline Triangles triangulated(const Points& points, const Polygons& polygons)
{
  Triangles triangles;
  for(const auto& polygon : polygons) {
    std::vector<CGAL::Triple<int, int, int>> found;
    if(polygon.size() > 3) {
      Points corners;
      for(std::size_t v : polygon)
        corners.push_back(points[v]);
      try {
        CGAL::Polygon_mesh_processing::triangulate_hole_polyline(corners, std::back_inserter(found));
      } catch(const std::exception&) { // an assertion of CGAL
        found.clear();
      }
    }
    for(const auto& t : found)
      triangles.push_back(
        {polygon[std::size_t(t.first)], polygon[std::size_t(t.second)], polygon[std::size_t(t.third)]});
    for(std::size_t i = 2; found.empty() && i < polygon.size(); ++i)
      triangles.push_back({polygon[0], polygon[i - 1], polygon[i]});
  }
  return triangles;
}

inline void set_triangles(Points triangle_points, const Triangles& triangles, Points& points,
                          Polygons& polygons)
{
  points = std::move(triangle_points);
  polygons.clear();
  for(const auto& t : triangles)
    polygons.emplace_back(t.begin(), t.end());
}

inline double area(const Points& points, const Triangles& triangles)
{
  double sum = 0;
  for(const auto& t : triangles) {
    const Vec3 a = to_vec3(points[t[0]]);
    sum += norm(cross(to_vec3(points[t[1]]) - a, to_vec3(points[t[2]]) - a)) / 2;
  }
  return sum;
}

inline double volume(const Points& points, const Triangles& triangles)
{
  double sum = 0;
  const Vec3 origin = to_vec3(points.front());
  for(const auto& t : triangles)
    sum += determinant(to_vec3(points[t[0]]) - origin, to_vec3(points[t[1]]) - origin,
                       to_vec3(points[t[2]]) - origin)
           / 6;
  return sum;
}

// Undirected edges of polygons, with the polygons at each edge.
using Edge_polygons = std::map<std::array<std::size_t, 2>, std::vector<std::size_t>>;

inline Edge_polygons edges_of(const Polygons& polygons)
{
  Edge_polygons edges;
  for(std::size_t f = 0; f < polygons.size(); ++f)
    for(std::size_t i = 0; i < polygons[f].size(); ++i) {
      const auto [a, b] = std::minmax(polygons[f][i], polygons[f][(i + 1) % polygons[f].size()]);
      edges[{a, b}].push_back(f);
    }
  return edges;
}

// Numbers the components of polygons connected by edges of at most `most` polygons; returns their number.
inline std::size_t find_parts(const Polygons& polygons, const Edge_polygons& edges, std::size_t most,
                              std::vector<std::size_t>& part)
{
  Mixed_meshes_3::internal::Disjoint_sets sets(polygons.size());
  for(const auto& [edge, around] : edges)
    for(std::size_t i = 1; i < around.size() && around.size() <= most; ++i)
      sets.unite(around[0], around[i]);
  std::size_t n;
  std::tie(part, n) = sets.numbered();
  return n;
}

inline std::vector<Polygons> parts_of(const Polygons& polygons)
{
  std::vector<std::size_t> part;
  const std::size_t all = std::size_t(-1);
  std::vector<Polygons> parts(find_parts(polygons, edges_of(polygons), all, part));
  for(std::size_t f = 0; f < polygons.size(); ++f)
    parts[part[f]].push_back(polygons[f]);
  return parts;
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_POLYGON_SOUP_H
