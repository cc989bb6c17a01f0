// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Flips of faces between tetrahedra: three tetrahedra around a new edge replace two beside a face.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MOVES_FLIP_FACE_H
#define CGAL_MIXED_MESH_3_INTERNAL_MOVES_FLIP_FACE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/moves/Flip_context.h>

#include <array>
#include <cstddef>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Flips the face (a, b, c) of a tetrahedron (a, b, c, d), seen counter-clockwise from outside, if another
/// tetrahedron is behind the face, and if the new edge is not there yet, as where a boundary cuts itself.
template <class Quality>
bool flip_face(const Flip_context<Quality>& context, Element_index e, Vertex_index a, Vertex_index b,
               Vertex_index c, Vertex_index d)
{
  for(Element_index other : context.mesh.incident[a]) {
    const Working_mesh::Element& o = context.mesh.elements[other];
    if(other == e || o.kind != TETRAHEDRON || !o.has(b) || !o.has(c))
      continue;
    const Vertex_index apex = o.vertices[std::size_t(6 - o.position(a) - o.position(b) - o.position(c))];
    const std::array<Element_index, 2> old{e, other};
    const std::array<Tetrahedron, 3> tetrahedra{{{a, b, d, apex}, {b, c, d, apex}, {c, a, d, apex}}};
    const auto limits = context.limits(old);
    double sum = 0;
    for(const Tetrahedron& t : tetrahedra)
      if(sum < limits.sum)
        sum += context.cost(t, limits.each);
    if(!(sum < limits.sum) || context.mesh.has_element_with(d, apex))
      return false;
    Transaction transaction(context.mesh);
    return context.replace(transaction, old, tetrahedra);
  }
  return false;
}

/// Flips the first face of a tetrahedron that can be flipped.
template <class Quality>
bool flip_faces(const Flip_context<Quality>& context, Element_index e)
{
  const auto v = context.mesh.elements[e].vertices;
  for(int i = 0; i < 4; ++i) {
    const auto& f = reference_elements[TETRAHEDRON].faces[i].vertices;
    if(flip_face(context, e, v[f[0]], v[f[1]], v[f[2]], v[std::size_t(6 - f[0] - f[1] - f[2])]))
      return true;
  }
  return false;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MOVES_FLIP_FACE_H
