// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_REPAIR_FILL_HOLES_IMPL_H
#define CGAL_MIXED_MESH_3_INTERNAL_REPAIR_FILL_HOLES_IMPL_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Disjoint_sets.h>
#include <CGAL/Mixed_mesh_3/internal/base/compiled.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/repair/fill_holes.h>

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The components of a surface that are connected by edges.
class Surface_parts
{
  using Point = Predicates_kernel::Point_3;
  using Triangle = std::array<std::size_t, 3>;

  std::vector<Point>& m_points;
  std::map<std::array<std::size_t, 2>, std::size_t> m_directed_edges; // edges with their triangles
  std::vector<std::size_t> m_part;                                    // first triangle of the component

public:
  /// Constructs the components. \pre the surface is oriented consistently, and a manifold
  Surface_parts(std::vector<Point>& points, std::vector<Triangle>& triangles) : m_points(points)
  {
    for(std::size_t t = 0; t < triangles.size(); ++t)
      for(std::size_t i = 0; i < 3; ++i)
        m_directed_edges[{triangles[t][i], triangles[t][(i + 1) % 3]}] = t;
    Disjoint_sets sets(triangles.size());
    for(const auto& [edge, t] : m_directed_edges) {
      const auto opposite = m_directed_edges.find({edge[1], edge[0]});
      if(opposite != m_directed_edges.end())
        sets.unite(t, opposite->second);
    }
    m_part = sets.least_of_all();
  }

  std::size_t part(std::size_t t) const { return m_part[t]; }

  double area(const Triangle& t) const
  {
    const Vec3 a = to_vec3(m_points[t[0]]);
    return norm(cross(to_vec3(m_points[t[1]]) - a, to_vec3(m_points[t[2]]) - a)) / 2;
  }

  /// The holes of each component.
  std::map<std::size_t, std::vector<Surface_hole>> holes() const
  {
    std::map<std::size_t, std::pair<std::size_t, std::size_t>> next; // along the hole; and the triangle
    for(const auto& [edge, t] : m_directed_edges)
      if(m_directed_edges.count({edge[1], edge[0]}) == 0)
        next[edge[1]] = {edge[0], t};
    std::map<std::size_t, std::vector<Surface_hole>> result;
    while(!next.empty()) {
      Surface_hole hole;
      const std::size_t t = next.begin()->second.second;
      for(auto at = next.begin(); at != next.end();) {
        hole.border.push_back(at->first);
        const std::size_t to = at->second.first;
        hole.length += norm(to_vec3(m_points[to]) - to_vec3(m_points[at->first]));
        next.erase(at);
        at = next.find(to);
      }
      if(hole.border.size() > 2) // not a slit, of an edge that was cut
        result[m_part[t]].push_back(std::move(hole));
    }
    return result;
  }

  /// Triangles that close a hole.
  std::vector<Triangle> patch(Surface_hole& hole) const
  {
    std::vector<Point> border;
    for(std::size_t v : hole.border)
      border.push_back(m_points[v]);
    std::vector<CGAL::Triple<int, int, int>> found;
    try {
      CGAL::Polygon_mesh_processing::triangulate_hole_polyline(border, std::back_inserter(found));
    } catch(const std::exception&) { // CGAL's assertions throw
      found.clear();
    }
    std::vector<Triangle> patch;
    for(const auto& t : found) {
      patch.push_back({hole.border[std::size_t(t.first)], hole.border[std::size_t(t.second)],
                       hole.border[std::size_t(t.third)]});
      hole.area += area(patch.back());
    }
    // The hole is a crack, whose points are on a line.
    for(std::size_t i = 2; found.empty() && i < hole.border.size(); ++i) {
      patch.push_back({hole.border[0], hole.border[i - 1], hole.border[i]});
      hole.area += area(patch.back());
    }
    hole.width = 2 * std::sqrt(hole.area / CGAL_PI);
    return patch;
  }
};

CGAL_MIXED_MESH_3_INLINE Hole_filling fill_holes(std::vector<Predicates_kernel::Point_3>& points,
                                                 std::vector<std::array<std::size_t, 3>>& triangles,
                                                 double largest_share)
{
  constexpr double sheet_area = 0.25; // of all; the patch of a flat sheet has about its area
  Hole_filling result;
  CGAL::Polygon_mesh_processing::orient_polygon_soup(points, triangles);
  const Surface_parts parts(points, triangles);
  std::map<std::size_t, double> areas; // areas of components
  double area_of_all = 0;
  for(std::size_t t = 0; t < triangles.size(); ++t) {
    areas[parts.part(t)] += parts.area(triangles[t]);
    area_of_all += parts.area(triangles[t]);
  }
  std::vector<std::array<std::size_t, 3>> added;
  std::vector<std::size_t> sheets;
  for(auto& [part, holes] : parts.holes()) {
    std::vector<std::array<std::size_t, 3>> patches;
    double area = 0;
    bool can_be_closed = true;
    for(Surface_hole& hole : holes) {
      const auto patch = parts.patch(hole);
      can_be_closed = can_be_closed && !patch.empty();
      patches.insert(patches.end(), patch.begin(), patch.end());
      area += hole.area;
    }
    if(can_be_closed && area <= largest_share * (areas[part] + area)) {
      added.insert(added.end(), patches.begin(), patches.end());
      result.filled.insert(result.filled.end(), holes.begin(), holes.end());
    } else if(areas[part] <= sheet_area * area_of_all && (!can_be_closed || area > 0.8 * areas[part])) {
      sheets.push_back(part);
      result.share_of_dropped_area += areas[part] / area_of_all;
    } else {
      result.left.insert(result.left.end(), holes.begin(), holes.end());
    }
  }
  std::vector<std::array<std::size_t, 3>> kept;
  for(std::size_t t = 0; t < triangles.size(); ++t)
    if(!std::binary_search(sheets.begin(), sheets.end(), parts.part(t)))
      kept.push_back(triangles[t]);
  result.number_of_dropped_faces = triangles.size() - kept.size();
  triangles = std::move(kept);
  triangles.insert(triangles.end(), added.begin(), added.end());
  for(auto* holes : {&result.filled, &result.left})
    std::stable_sort(holes->begin(), holes->end(),
                     [](const Surface_hole& g, const Surface_hole& h) { return g.length > h.length; });
  return result;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_REPAIR_FILL_HOLES_IMPL_H
