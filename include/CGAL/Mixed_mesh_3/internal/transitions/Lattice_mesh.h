// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Elements between lattice points, as the stages after the octree pass them on.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_TRANSITIONS_LATTICE_MESH_H
#define CGAL_MIXED_MESH_3_INTERNAL_TRANSITIONS_LATTICE_MESH_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/internal/base/labeled_domain.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Octree.h>

#include <CGAL/enum.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Elements over lattice points. Vertices carry their side of the domain's surface.
struct Lattice_mesh
{
  static constexpr std::int8_t unknown_side = 2;

  std::vector<Lattice_point> vertices;
  std::vector<std::int8_t> sides;         ///< `Bounded_side` of each vertex, or unknown
  std::vector<Subdomain_rank> subdomains; ///< rank of the subdomain of each vertex inside
  std::vector<Octree::Node_index> leaves; ///< a leaf that touches each vertex
  std::vector<std::uint8_t> is_on_rim;    ///< whether not all leaves around the vertex have elements
  Element_list elements;
  std::vector<Octree::Node_index> cells; ///< leaf that each element comes from
  /// Number of vertices of the octree: transition templates inserted the vertices from here on.
  std::size_t first_inserted_vertex = 0;

  Vertex_index add_vertex(const Lattice_point& p, std::int8_t side, Octree::Node_index leaf, bool rim = false)
  {
    vertices.push_back(p);
    sides.push_back(side);
    subdomains.push_back(0);
    leaves.push_back(leaf);
    is_on_rim.push_back(rim);
    return Vertex_index(vertices.size() - 1);
  }

  void remove_last_vertex()
  {
    vertices.pop_back();
    sides.pop_back();
    subdomains.pop_back();
    leaves.pop_back();
    is_on_rim.pop_back();
  }

  bool is_inside(Vertex_index v) const { return sides[v] == ON_BOUNDED_SIDE; }
  Subdomain_rank subdomain(Vertex_index v) const { return is_inside(v) ? subdomains[v] : outside_rank; }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_TRANSITIONS_LATTICE_MESH_H
