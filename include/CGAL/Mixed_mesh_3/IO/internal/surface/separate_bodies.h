// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bodies that touch along edges.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_SEPARATE_BODIES_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_SEPARATE_BODIES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/internal/surface/polygon_soup.h>

#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

// Gives bodies that have edges in common their own vertices there: each body consists of faces connected by
// edges of two faces. Nothing is changed if a body would not be closed then.
inline void separate_bodies(Points& points, Polygons& polygons)
{
  const Edge_polygons edges = edges_of(polygons);
  std::vector<std::size_t> body;
  find_parts(polygons, edges, 2, body);
  std::set<std::size_t> shared; // vertices of edges with more than two faces
  for(const auto& [edge, around] : edges) {
    if(around.size() <= 2)
      continue;
    shared.insert(edge.begin(), edge.end());
    std::map<std::size_t, int> faces;
    for(std::size_t f : around)
      ++faces[body[f]];
    for(const auto& [of, n] : faces)
      if(n != 2)
        return; // it would not be closed
  }
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> copies; // copies of a vertex for a body
  std::set<std::size_t> taken;
  for(std::size_t f = 0; f < polygons.size(); ++f)
    for(std::size_t& v : polygons[f])
      if(shared.count(v) != 0) {
        const auto [copy, is_new] = copies.emplace(std::make_pair(v, body[f]), v);
        if(is_new && !taken.insert(v).second) {
          copy->second = points.size();
          points.push_back(Points::value_type(points[v]));
        }
        v = copy->second;
      }
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_SEPARATE_BODIES_H
