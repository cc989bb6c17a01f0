// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_REPAIR_SOLID_READING_IMPL_H
#define CGAL_MIXED_MESH_3_INTERNAL_REPAIR_SOLID_READING_IMPL_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Disjoint_sets.h>
#include <CGAL/Mixed_mesh_3/internal/base/compiled.h>
#include <CGAL/Mixed_mesh_3/internal/repair/Solid_reading.h>
#include <CGAL/Mixed_mesh_3/internal/repair/Space_partition.h>
#include <CGAL/Mixed_mesh_3/internal/repair/Triangle_arrangement.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// A facet whose back is solid and whose front is not, or conversely.
struct Solid_facet
{
  std::size_t facet;
  bool is_outwards; // orientation of the facet
};

/// Gives each sheet of the boundary its own vertices, where several sheets meet in an edge or a vertex: the
/// facets of a sheet have the same piece of solid between them at an edge.
class Solid_sheets
{
  using Triangle = std::array<std::size_t, 3>;

  std::vector<Triangle>& m_triangles; // triangles of points of the arrangement; then of vertices
  Disjoint_sets m_corners;            // those of a vertex are one set

public:
  Solid_sheets(std::vector<Triangle>& triangles) : m_triangles(triangles), m_corners(3 * triangles.size()) {}

  /// Links triangles that follow each other around an edge: their corners at the edge are the same.
  void link(std::size_t s, std::size_t t, std::size_t a, std::size_t b)
  {
    for(std::size_t v : {a, b})
      m_corners.unite(corner(s, v), corner(t, v));
  }

  /// Replaces points by vertices, and returns the point of each.
  std::vector<std::size_t> make_vertices()
  {
    const auto [vertex_of, number_of_vertices] = m_corners.numbered();
    std::vector<std::size_t> points(number_of_vertices);
    for(std::size_t c = 0; c < vertex_of.size(); ++c) {
      points[vertex_of[c]] = m_triangles[c / 3][c % 3];
      m_triangles[c / 3][c % 3] = vertex_of[c];
    }
    return points;
  }

private:
  std::size_t corner(std::size_t t, std::size_t v) const
  {
    return 3 * t
           + std::size_t(std::find(m_triangles[t].begin(), m_triangles[t].end(), v) - m_triangles[t].begin());
  }
};

/// Inserts a vertex in the middle of an edge for each sheet, where two sheets have both vertices of the edge
/// in common.
inline void separate_edges(std::vector<Solid_reading::Point>& points,
                           std::vector<std::array<std::size_t, 3>>& triangles,
                           std::vector<std::array<std::size_t, 4>> links) // two triangles, two vertices
{
  std::map<std::array<std::size_t, 2>, std::vector<std::array<std::size_t, 2>>> sheets; // sheets by edge
  for(const auto& [s, t, a, b] : links)
    sheets[{(std::min)(a, b), (std::max)(a, b)}].push_back({s, t});
  std::map<std::size_t, std::vector<std::size_t>> pieces; // pieces of triangles that were cut
  for(const auto& [edge, pairs] : sheets) {
    if(pairs.size() < 2)
      continue;
    for(const auto& pair : pairs) {
      const std::size_t middle = points.size();
      points.push_back(CGAL::midpoint(points[edge[0]], points[edge[1]]));
      for(std::size_t whole : pair) {
        auto& of_whole = pieces[whole];
        if(of_whole.empty())
          of_whole.push_back(whole);
        for(std::size_t i = 0, n = of_whole.size(); i < n; ++i) {
          auto& t = triangles[of_whole[i]];
          const auto a = std::find(t.begin(), t.end(), edge[0]), b = std::find(t.begin(), t.end(), edge[1]);
          if(a == t.end() || b == t.end())
            continue;
          auto rest = t;
          rest[std::size_t(a - t.begin())] = middle;
          *b = middle;
          of_whole.push_back(triangles.size());
          triangles.push_back(rest);
          break;
        }
      }
    }
  }
}

inline Solid_reading::Point rounded_point(const Triangle_arrangement::Point& p)
{
  CGAL::exact(p);
  return {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
}

CGAL_MIXED_MESH_3_INLINE Solid_reading read_solid(const std::vector<Solid_reading::Point>& input_points,
                                                  const std::vector<std::array<std::size_t, 3>>& input,
                                                  std::size_t most)
{
  Solid_reading reading;
  const Triangle_arrangement arrangement(input_points, input, most);
  reading.is_complete = arrangement.is_complete();
  if(!reading.is_complete)
    return reading;
  const Space_partition space(arrangement);
  reading.is_complete = space.is_complete();
  if(!reading.is_complete)
    return reading;
  reading.rule = space.rule();
  const auto& facets = arrangement.facets();
  std::vector<std::size_t> triangle_of(facets.size(), std::size_t(-1));
  std::vector<std::array<std::size_t, 3>>& triangles = reading.triangles;
  for(std::size_t f = 0; f < facets.size(); ++f) {
    const bool is_back_solid = space.is_solid(Space_partition::back(f));
    if(is_back_solid == space.is_solid(Space_partition::front(f)))
      continue;
    triangle_of[f] = triangles.size();
    triangles.push_back(facets[f].vertices);
    if(!is_back_solid)
      std::swap(triangles.back()[1], triangles.back()[2]);
  }
  Solid_sheets sheets(triangles);
  std::vector<std::array<std::size_t, 4>> links;
  space.for_each_edge([&](std::size_t a, std::size_t b, const std::vector<std::size_t>& around) {
    std::vector<std::size_t> kept; // solid begins and ends at kept facets in turn
    for(std::size_t f : around)
      if(triangle_of[f] != std::size_t(-1))
        kept.push_back(f);
    for(std::size_t i = 0; i < kept.size(); ++i)
      if(space.is_solid(space.side_after(kept[i], a, b))) {
        const std::size_t s = triangle_of[kept[i]], t = triangle_of[kept[(i + 1) % kept.size()]];
        sheets.link(s, t, a, b);
        links.push_back({s, t, a, b});
      }
  });
  const std::vector<std::array<std::size_t, 3>> places = triangles;
  for(std::size_t p : sheets.make_vertices())
    reading.points.push_back(rounded_point(arrangement.points()[p]));
  for(auto& [s, t, a, b] : links)
    for(std::size_t* v : {&a, &b})
      *v = triangles[s][std::size_t(std::find(places[s].begin(), places[s].end(), *v) - places[s].begin())];
  separate_edges(reading.points, triangles, std::move(links));
  reading.inverted_volume = space.inverted_volume();
  return reading;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_REPAIR_SOLID_READING_IMPL_H
