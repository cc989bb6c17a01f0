// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The boundary stage: keeps the elements that have a vertex inside the domain, and prepares those that also
// have a vertex outside to follow the surface.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_BOUNDARY_SPLIT_BY_ORDER_H
#define CGAL_MIXED_MESH_3_INTERNAL_BOUNDARY_SPLIT_BY_ORDER_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Core_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/transitions/Lattice_mesh.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
Splits an element that has a vertex outside, by one order of all vertices.

A quadrilateral with an outside vertex is split by the diagonal through its first vertex; the element
is the cone of its first vertex over the faces that do not contain it. So both sides of every face
agree, no prism can end as Schoenhardt's polyhedron, and no vertex is inserted. A quadrilateral
without outside vertices stays, as the base of a pyramid.

\param rank the order; smaller is first, vertices outside before those inside
\param is_inside `bool(Vertex_index)`
\param add called with the kind and vertices of each piece, all of positive volume if the element is
           strictly convex
*/
template <class Rank, class Is_inside, class Add>
void split_element(const Element_view& element, const Rank& rank, const Is_inside& is_inside, const Add& add)
{
  const auto is_before = [&](Vertex_index a, Vertex_index b) { return rank(a) < rank(b); };
  const Vertex_index apex = *std::min_element(element.begin(), element.end(), is_before);
  const Reference_element& reference = element.reference();
  for(int f = 0; f < reference.number_of_faces; ++f) {
    const Element_face& face = reference.faces[f];
    std::array<Vertex_index, 4> v{};
    bool has_apex = false, is_all_inside = true;
    for(int i = 0; i < face.size; ++i) {
      v[i] = element[face.vertices[i]];
      has_apex = has_apex || v[i] == apex;
      is_all_inside = is_all_inside && is_inside(v[i]);
    }
    if(has_apex)
      continue;
    // Faces are oriented outwards; pieces see their base from inside.
    if(face.size == 3) {
      add(TETRAHEDRON, {v[0], v[2], v[1], apex});
    } else if(is_all_inside) {
      add(PYRAMID, {v[0], v[3], v[2], v[1], apex});
    } else {
      std::rotate(v.begin(), std::min_element(v.begin(), v.end(), is_before), v.end());
      add(TETRAHEDRON, {v[0], v[2], v[1], apex});
      add(TETRAHEDRON, {v[0], v[3], v[2], apex});
    }
  }
}

/// The mesh with its elements split into tetrahedra, but for hexahedra that stay, and for elements between
/// these. Both sides of a face agree.
/// \param stays `bool(Element_index)`, whether a hexahedron does
template <class Stays>
Core_mesh split_but_hexahedra(const Core_mesh& mesh, const Stays& stays)
{
  std::vector<std::uint8_t> is_kept(mesh.number_of_vertices(), 0);
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
    if(mesh.element(e).kind() == HEXAHEDRON && stays(e))
      for(Vertex_index v : mesh.element(e))
        is_kept[v] = 1;
  const auto is_kept_vertex = [&](Vertex_index v) { return is_kept[v] != 0; };
  const auto rank = [&](Vertex_index v) { return std::make_pair(is_kept_vertex(v), v); };
  Core_mesh result;
  result.points() = mesh.points();
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e) {
    const Element_view element = mesh.element(e);
    const auto add = [&](Element_kind kind, const std::array<Vertex_index, 5>& v) {
      result.add_element(kind, v.data(), mesh.attributes(e));
    };
    if(std::all_of(element.begin(), element.end(), is_kept_vertex))
      result.add_element(element.kind(), element.begin(), mesh.attributes(e));
    else
      split_element(element, rank, is_kept_vertex, add);
  }
  return result;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_BOUNDARY_SPLIT_BY_ORDER_H
