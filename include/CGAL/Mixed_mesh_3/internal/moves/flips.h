// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Replacement of tetrahedra by better ones between the same vertices: 2-3 flips, the removal of an edge with
// its ring of tetrahedra, and the removal of flat tetrahedra that lie on the boundary.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MOVES_FLIPS_H
#define CGAL_MIXED_MESH_3_INTERNAL_MOVES_FLIPS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/moves/flip_edge.h>
#include <CGAL/Mixed_mesh_3/internal/moves/flip_face.h>
#include <CGAL/Mixed_mesh_3/internal/moves/remove_from_boundary.h>

#include <algorithm>
#include <cstddef>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
Flips tetrahedra if the sum of the powers of their costs falls, and none gets a cost above the bound, or, if
one is above the bound already, above the worst one. The new tetrahedra fill the space of the old ones, and
are positive by exact orientation, so conformity and validity are kept; the boundary changes only where flat
tetrahedra with two faces on it are removed, and where an edge in a flat place is flipped, if there are sharp
edges.

\tparam Quality a model of `MixedMeshQuality_3`
*/
template <class Quality>
class Tetrahedron_flipper
{
  Flip_context<Quality> m_context;

public:
  /// \param bound largest cost that a tetrahedron may get
  Tetrahedron_flipper(Working_mesh& mesh, const Quality& quality, double bound)
    : m_context{mesh, quality, bound}
  {
  }

  /// Tries all tetrahedra of a cost above `worst`, including new ones. Calls `changed(v)` for the vertices of
  /// new and removed tetrahedra, and returns the number of flips.
  template <class Changed>
  std::size_t run(double exponent, double worst, const Changed& changed)
  {
    m_context.exponent = exponent;
    const double least = power(worst, exponent);
    const Working_mesh& mesh = m_context.mesh;
    m_context.edges_in_vain.assign(mesh.elements.size(), 0);
    m_context.costs.clear();
    m_context.add_costs();
    const auto change = [&](Vertex_index v) {
      m_context.forget_around(v);
      changed(v);
    };
    std::size_t flips = 0;
    for(Element_index e = 0; e < mesh.elements.size(); ++e)
      if(m_context.is_tetrahedron(e) && m_context.cost_of(e) > least) {
        const std::size_t first_new = mesh.elements.size();
        const auto vertices = mesh.elements[e].vertices;
        if(!flip_edges(m_context, e) && !flip_faces(m_context, e)) {
          if(!remove_from_boundary(m_context, e))
            continue;
          std::for_each_n(vertices.begin(), 4, change);
        }
        ++flips;
        m_context.add_costs();
        for(std::size_t n = first_new; n < mesh.elements.size(); ++n)
          for(Vertex_index v : mesh.elements[n])
            change(v);
      }
    m_context.edges_in_vain.clear();
    m_context.costs.clear();
    return flips;
  }

  /// The number of tetrahedra removed from the boundary or from their subdomain, and of edges removed from
  /// flat places of the boundary.
  std::size_t number_of_removals() const { return m_context.number_of_removals; }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MOVES_FLIPS_H
