// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Weights of vertices, by their distance from the region.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_WEIGHTS_OF_VERTICES_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_WEIGHTS_OF_VERTICES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Working_mesh.h>

#include <cmath>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// For each vertex (1 + d / r)^-3.6, where d is its distance from the elements in the region, along edges:
/// times the cube of an edge h, it is (w h^5)^(3/5), where w = (1 + d / r)^-6 is the weight of an error in
/// the octree, so that the order of cells and that of vertices are one.
/// \param radius r; if it is 0, or no element is in the region, all have the weight 1
inline std::vector<double> weights_of_vertices(const Working_mesh& mesh, double radius)
{
  constexpr double infinity = std::numeric_limits<double>::infinity(), exponent = 3.6; // 6 * 3/5, see above
  std::vector<double> distances(mesh.points.size(), infinity);
  std::priority_queue<std::pair<double, Vertex_index>> queue; // of negative distances
  const auto reach = [&](Vertex_index v, double distance) {
    if(distance < distances[v]) {
      distances[v] = distance;
      queue.emplace(-distance, v);
    }
  };
  for(const Working_mesh::Element& element : mesh.elements)
    if(element.attributes.is_in_region)
      for(Vertex_index v : element)
        reach(v, 0);
  while(!queue.empty()) {
    const auto [distance, v] = queue.top();
    queue.pop();
    if(-distance == distances[v])
      for(Element_index e : mesh.incident[v])
        for(Vertex_index u : mesh.elements[e])
          reach(u, distances[v] + norm(mesh.points[u] - mesh.points[v]));
  }
  std::vector<double> weights(mesh.points.size(), 1);
  if(radius > 0)
    for(Vertex_index v = 0; v < weights.size(); ++v)
      if(distances[v] < infinity)
        weights[v] = std::pow(1 + distances[v] / radius, -exponent);
  return weights;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_WEIGHTS_OF_VERTICES_H
