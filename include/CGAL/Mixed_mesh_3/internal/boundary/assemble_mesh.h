// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Conversion of lattice points to points: the last stage.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_BOUNDARY_ASSEMBLE_MESH_H
#define CGAL_MIXED_MESH_3_INTERNAL_BOUNDARY_ASSEMBLE_MESH_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_attributes.h>
#include <CGAL/Mixed_mesh_3/internal/boundary/Boundary_stage.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Located_octree.h>
#include <CGAL/Mixed_mesh_3/internal/transitions/Lattice_mesh.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Joins kept elements and pieces, and numbers the vertices in the order of their first use.
template <class Mesh>
void assemble_mesh(const Located_octree& octree, const Lattice_mesh& lattice, const Boundary_pieces& boundary,
                   Mesh& mesh)
{
  using Point_3 = typename Mesh::Point_3;
  std::vector<Vertex_index> numbers(lattice.vertices.size(), Vertex_index(-1));
  std::vector<Point_3> points;
  Element_list elements;
  std::vector<Element_attributes> attributes;
  points.reserve(boundary.number_of_vertices);
  elements.reserve(lattice.elements.size(), lattice.elements.connectivity().size());
  attributes.reserve(lattice.elements.size());

  const std::vector<Subdomain_index>& indices = octree.domain().subdomain_indices();
  const auto add = [&](const Element_view& element, Element_index origin, Subdomain_rank subdomain,
                       Compartment_index compartment) {
    Vertex_index v[8];
    for(int i = 0; i < element.size(); ++i) {
      Vertex_index& number = numbers[element[i]];
      if(number == Vertex_index(-1)) {
        number = Vertex_index(points.size());
        const auto p = octree.point(lattice.vertices[element[i]]);
        points.emplace_back(p.x(), p.y(), p.z());
      }
      v[i] = number;
    }
    elements.add(element.kind(), &v[0]);
    attributes.push_back({indices[subdomain], octree.is_in_region(lattice.cells[origin]), compartment});
  };
  std::size_t piece = 0;
  for(Element_index e = 0; e < lattice.elements.size(); ++e) {
    if(!boundary.is_replaced[e])
      add(lattice.elements[e], e, lattice.subdomain(lattice.elements[e][0]), 0);
    for(; piece < boundary.pieces.size() && boundary.origins[piece] == e; ++piece)
      add(boundary.pieces[piece], e, boundary.subdomains[piece],
          boundary.compartments.empty() ? 0 : boundary.compartments[piece]);
  }
  mesh.assign(std::move(points), std::move(elements), std::move(attributes));
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_BOUNDARY_ASSEMBLE_MESH_H
