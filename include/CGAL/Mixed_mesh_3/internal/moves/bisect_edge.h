// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The bisection of an edge between tetrahedra.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MOVES_BISECT_EDGE_H
#define CGAL_MIXED_MESH_3_INTERNAL_MOVES_BISECT_EDGE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/moves/Transaction.h>

#include <algorithm>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Splits the tetrahedra around an edge in two, by a new vertex at `p`, if the new tetrahedra are positive
/// and cost at most `worst`. The new vertex is the last one, with the given stratum, as have the halves of a
/// sharp edge.
/// \return whether the edge was bisected
template <class Quality>
bool bisect_edge(Working_mesh& mesh, const Quality& quality, Vertex_index a, Vertex_index b, const Vec3& p,
                 Stratum stratum, double worst)
{
  const std::vector<Element_index> old = mesh.elements_at_edge(a, b);
  if(!std::all_of(old.begin(), old.end(),
                  [&](Element_index e) { return mesh.elements[e].kind == TETRAHEDRON; }))
    return false;
  Transaction transaction(mesh);
  const Vertex_index middle = transaction.add_vertex(p, stratum, {a, b});
  for(Element_index e : old)
    transaction.remove(e);
  for(Element_index e : old)
    for(Vertex_index end : {a, b})
      transaction.add(mesh.elements[e].with_other_vertex(end, middle));
  if(mesh.is_sharp(a, b)) {
    transaction.set_sharp_edge(a, b, free_stratum);
    transaction.set_sharp_edge(a, middle, stratum);
    transaction.set_sharp_edge(b, middle, stratum);
  }
  return transaction.accept(quality, worst);
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MOVES_BISECT_EDGE_H
