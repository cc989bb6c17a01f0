// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Balance of interfaces between subdomains: they start on both sides of their surfaces, as near as possible.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_BOUNDARY_BALANCE_INTERFACES_H
#define CGAL_MIXED_MESH_3_INTERNAL_BOUNDARY_BALANCE_INTERFACES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/labeled_domain.h>
#include <CGAL/Mixed_mesh_3/internal/base/parallel_for.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Located_octree.h>
#include <CGAL/Mixed_mesh_3/internal/transitions/Lattice_mesh.h>

#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
Vertices of a subdomain that are next to its surface go over to the subdomain behind the surface: so they
become vertices of the interface, and have a shorter way to the surface than the vertices behind, whose way
would squeeze the elements of small parts (as vertices near to an isosurface are warped: Labelle, Shewchuk:
Isosurface stuffing, 2007). A vertex goes over only if there are two subdomains and not the outside around it,
and if a vertex beside it stays: thin parts are not lost.

\par Complexity
Linear in the number of elements; a closest-point query for each vertex beside another subdomain
*/
inline void balance_interfaces(const Located_octree& located, Lattice_mesh& mesh, unsigned threads)
{
  // Share of the shortest edge. At half of the edge, vertices would have as far to go as the vertices behind
  // them, but narrow parts would lose more of their volume.
  constexpr double near = 0.3;
  const std::vector<Subdomain_index>& indices = located.domain().subdomain_indices();
  if(indices.size() < 2)
    return;
  struct Vertex
  {
    Subdomain_rank behind = 0; // 0: none yet; no subdomain is behind all
    bool is_candidate = true;  // no other subdomain is beside the vertex
    double shortest = std::numeric_limits<double>::infinity();
  };
  std::vector<Vertex> vertices(mesh.vertices.size());
  const auto squared_length = [&](Vertex_index u, Vertex_index v) {
    return CGAL::squared_distance(located.point(mesh.vertices[u]), located.point(mesh.vertices[v]));
  };
  for(Element_index e = 0; e < mesh.elements.size(); ++e)
    for(Vertex_index v : mesh.elements[e])
      for(Vertex_index u : mesh.elements[e]) {
        const Subdomain_rank mine = mesh.subdomain(v), other = mesh.subdomain(u);
        if(other == mine)
          continue;
        Vertex& vertex = vertices[v];
        vertex.is_candidate = vertex.is_candidate && other > mine && other != outside_rank
                              && (vertex.behind == 0 || vertex.behind == other);
        vertex.behind = other;
      }
  std::vector<Vertex_index> candidates;
  for(Vertex_index v = 0; v < vertices.size(); ++v)
    if(vertices[v].is_candidate && vertices[v].behind != 0)
      candidates.push_back(v);
    else
      vertices[v].is_candidate = false;
  for(Element_index e = 0; e < mesh.elements.size(); ++e)
    for(Vertex_index v : mesh.elements[e])
      if(vertices[v].is_candidate)
        for(Vertex_index u : mesh.elements[e])
          if(u != v)
            vertices[v].shortest = (std::min)(vertices[v].shortest, squared_length(u, v));
  parallel_for(candidates.size(), threads, [&](std::size_t i) {
    Vertex& vertex = vertices[candidates[i]];
    const auto p = located.point(mesh.vertices[candidates[i]]);
    const auto q = located.domain().closest_point(p, indices[mesh.subdomain(candidates[i])],
                                                  indices[vertex.behind]);
    vertex.is_candidate = CGAL::squared_distance(p, q) < near * near * vertex.shortest;
  });
  std::vector<std::uint8_t> is_beside_one_that_stays(vertices.size(), 0);
  for(Element_index e = 0; e < mesh.elements.size(); ++e) {
    const Element_view element = mesh.elements[e];
    for(Vertex_index v : element)
      if(vertices[v].is_candidate && !is_beside_one_that_stays[v])
        is_beside_one_that_stays[v] = std::any_of(element.begin(), element.end(), [&](Vertex_index u) {
          return !vertices[u].is_candidate && mesh.subdomain(u) == mesh.subdomain(v);
        });
  }
  for(Vertex_index v : candidates)
    if(vertices[v].is_candidate && is_beside_one_that_stays[v])
      mesh.subdomains[v] = vertices[v].behind;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_BOUNDARY_BALANCE_INTERFACES_H
