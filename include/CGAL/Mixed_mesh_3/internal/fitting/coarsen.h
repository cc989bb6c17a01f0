// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pass that removes vertices until a budget is met.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_COARSEN_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_COARSEN_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Aspect_ratio_quality_3.h>
#include <CGAL/Mixed_mesh_3/internal/base/Core_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Coarsener.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Surface_projection.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Strata.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Working_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/Any_surface.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
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
  constexpr double infinity = std::numeric_limits<double>::infinity(), exponent = 3.6;
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

/// What comes first while edges are collapsed.
enum class Coarsening_goal : std::uint8_t {
  SHAPE, ///< of elements: none becomes worse than the bound
  VOLUME ///< elements may become some times as bad, as in thin tubes they have to: to be optimized
};

/*!
Collapses edges of a mesh whose boundary is on the surface, until it has the given number of vertices; edges
of elements that are not tetrahedra stay. At first edges are collapsed where the boundary stays near to where
it was, then where it does not, as little as needed.

\param quality_bound no new element costs more, or some times as much: see `goal`
\param radius of the region, for `weights_of_vertices()`
\return whether it has so few vertices then
\par Complexity
Some 100 microseconds for each vertex that is removed
*/
inline bool coarsen(Core_mesh& mesh, const Any_surface& surface, std::size_t number_of_vertices,
                    double quality_bound, double radius, const std::function<bool()>& go_on,
                    Coarsening_goal goal = Coarsening_goal::SHAPE)
{
  constexpr double largest_bound = 10; // if there is none
  // With 8, tubes of 2,000 vertices lose 2.5 % more of their volume, with 40 half a percent. With 2.2 times
  // the bound, and 4,000, a knot of 2,000 vertices keeps 95.1 % of its volume instead of 91.0, and is within
  // the bound again after an optimization.
  constexpr double weight_of_surface[] = {400, 4000}, share_of_bound[] = {1, 2.2};
  constexpr double distances[] = {0.08, 0.15, 0.3, 0.5}; // in edges of the boundary as they will be
  Strata strata(surface);
  const Interface_faces faces = strata.sorted_faces(mesh);
  const Aspect_ratio_quality_3 quality;
  Working_mesh working(mesh, strata.of_vertices(mesh.number_of_vertices(), faces));
  std::vector<Face> boundary;
  double sum = 0;
  for(std::size_t f = 0; f < faces.faces.size(); ++f)
    if(strata.is_on_boundary(faces.strata[f])) {
      boundary.push_back(faces.faces[f]);
      const Face_vertices& v = faces.faces[f].vertices();
      for(int i = 0; i < v.size(); ++i)
        sum += norm(working.points[v[i]] - working.points[v[(i + 1) % v.size()]]);
    }
  const double share = double(number_of_vertices) / double(mesh.number_of_vertices()),
               edge = sum / double(3 * boundary.size()) / std::sqrt(share);
  const Surface_projection project(surface, strata);
  const std::vector<Vec3> targets = project.places(working);
  Coarsener<Aspect_ratio_quality_3> coarsener(working, quality, boundary, targets,
                                              weights_of_vertices(working, radius),
                                              weight_of_surface[int(goal)],
                                              std::size_t(share * double(boundary.size())));
  std::size_t n = mesh.number_of_vertices();
  for(const double distance : distances)
    if(n > number_of_vertices && go_on())
      n -= coarsener(share_of_bound[int(goal)] * (std::min)(quality_bound, largest_bound), distance * edge,
                     n - number_of_vertices, go_on);
  working.store(mesh);
  return n <= number_of_vertices;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_COARSEN_H
