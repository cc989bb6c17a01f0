// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Removal of a vertex of the boundary with all of its elements.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MOVES_REMOVE_VERTEX_H
#define CGAL_MIXED_MESH_3_INTERNAL_MOVES_REMOVE_VERTEX_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/moves/Transaction.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Working_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/moves/remove_from_boundary.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <map>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Whether triangles are connected by common edges.
inline bool are_connected(const std::vector<std::array<Vertex_index, 3>>& triangles)
{
  const auto have_common_edge = [](const auto& a, const auto& b) {
    return std::count_if(a.begin(), a.end(),
                         [&](Vertex_index v) { return std::find(b.begin(), b.end(), v) != b.end(); })
           == 2;
  };
  std::vector<std::array<Vertex_index, 3>> reached, rest = triangles;
  for(std::size_t i = 0; i < (std::max)(reached.size(), std::size_t(1)) && !rest.empty(); ++i) {
    if(reached.empty()) {
      reached.push_back(rest.back());
      rest.pop_back();
    }
    const auto first = std::partition(rest.begin(), rest.end(), [&, t = reached[i]](const auto& other) {
      return !have_common_edge(t, other);
    });
    reached.insert(reached.end(), first, rest.end());
    rest.erase(first, rest.end());
  }
  return rest.empty();
}

/// Whether another element has a triangle of an element.
inline bool is_face_of_other(const Working_mesh& mesh, Element_index e,
                             const std::array<Vertex_index, 3>& face)
{
  const auto around = mesh.incident[face[0]];
  return std::any_of(around.begin(), around.end(), [&](Element_index other) {
    return other != e && mesh.elements[other].has(face[1]) && mesh.elements[other].has(face[2]);
  });
}

/// What goes with a vertex of the boundary that is removed with all of its elements, and what comes.
struct Vertex_removal
{
  std::vector<Vertex_index> vertices;             ///< that have no element then, the vertex among them
  std::vector<std::array<Vertex_index, 3>> faces; ///< on the boundary then
};

/*!
Finds out what is removed with a vertex of the boundary, if the topology of the mesh and of its boundary stays
the same, and sharp edges are kept.

The elements of the vertex are a ball, and what they have in common with other elements is a part of the
sphere around it, which becomes boundary instead of the rest of that sphere. So that the topology is kept,
this part is a disk, and what is inside the disk is not on the boundary yet. No inner vertex shall come to the
boundary: the disk has none inside, and its triangles are a tree.

\return no faces if the vertex may not be removed
\pre there are no sheets
*/
inline Vertex_removal find_removal(const Working_mesh& mesh, Vertex_index v)
{
  Vertex_removal removal;
  const auto around = mesh.incident[v];
  std::vector<Vertex_index> at_faces;
  std::map<Working_mesh::Edge, std::size_t> edges; // number of faces at each edge of the disk
  for(Element_index e : around) {
    const Working_mesh::Element& element = mesh.elements[e];
    if(element.kind != TETRAHEDRON
       || element.attributes.subdomain_index != mesh.elements[around.front()].attributes.subdomain_index)
      return {};
    std::array<Vertex_index, 3> face;
    std::copy_if(element.begin(), element.end(), face.begin(), [v](Vertex_index u) { return u != v; });
    if(!is_shared(mesh, e, {face[0], face[1], face[2]})) {
      if(is_face_of_other(mesh, e, face))
        return {}; // an interface would come to the boundary
      continue;
    }
    removal.faces.push_back(face);
    at_faces.insert(at_faces.end(), face.begin(), face.end());
    for(std::size_t i = 0; i < 3; ++i)
      ++edges[std::minmax(face[i], face[(i + 1) % 3])];
  }
  std::sort(at_faces.begin(), at_faces.end());
  at_faces.erase(std::unique(at_faces.begin(), at_faces.end()), at_faces.end());
  const auto is_inside = [](const auto& edge) { return edge.second > 1; };
  const auto number_inside = std::size_t(std::count_if(edges.begin(), edges.end(), is_inside));
  const bool is_disk = at_faces.size() == removal.faces.size() + 2
                       && number_inside + 1 == removal.faces.size() && are_connected(removal.faces);
  if(!is_disk || std::any_of(edges.begin(), edges.end(), [&](const auto& edge) {
       return is_inside(edge) && is_edge_of_boundary(mesh, edge.first.first, edge.first.second);
     }))
    return {};
  std::vector<Vertex_index> neighbors = mesh.neighbors(v);
  std::set_difference(neighbors.begin(), neighbors.end(), at_faces.begin(), at_faces.end(),
                      std::back_inserter(removal.vertices));
  removal.vertices.push_back(v);
  const auto has_to_stay = [&](Vertex_index u) { // on a sharp edge, or where the boundary is no manifold
    const auto at_u = mesh.incident[u];
    return mesh.strata[u] >= first_sharp_stratum
           || std::any_of(at_u.begin(), at_u.end(),
                          [&](Element_index e) { return !mesh.elements[e].has(v); });
  };
  if(std::any_of(removal.vertices.begin(), removal.vertices.end(), has_to_stay))
    return {};
  return removal;
}

/// Removes a vertex with all of its elements. No element is changed, so that none gets worse.
/// \param removal `find_removal(mesh, v)`, with faces
inline void remove_vertex(Working_mesh& mesh, Vertex_index v, const Vertex_removal& removal)
{
  CGAL_precondition(!removal.faces.empty());
  Transaction transaction(mesh);
  const std::vector<Element_index> around(mesh.incident[v].begin(), mesh.incident[v].end());
  for(Element_index e : around)
    transaction.remove(e);
  for(Vertex_index u : removal.vertices)
    transaction.merge(u);
  transaction.keep();
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MOVES_REMOVE_VERTEX_H
