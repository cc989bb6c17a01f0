// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Losses of octree meshes: parts of the domain that have no octree vertex inside.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_BOUNDARY_LOST_CELLS_H
#define CGAL_MIXED_MESH_3_INTERNAL_BOUNDARY_LOST_CELLS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/boundary/Boundary_stage.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Located_octree.h>
#include <CGAL/Mixed_mesh_3/internal/transitions/Lattice_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Octree.h>
#include <CGAL/Mixed_mesh_3/internal/octree/balance.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The leaves that meet the domain while neither they nor their neighbors have elements: the domain is
/// thinner there than a cell.
/// \param is_meshed for each node, whether it is a leaf with elements
inline std::vector<Octree::Node_index> lost_cells(const Located_octree& located,
                                                  std::vector<std::uint8_t> is_meshed)
{
  const Octree& octree = located.octree();
  for(Octree::Node_index n = Octree::Node_index(octree.size()) - 1; n > 0; --n)
    if(is_meshed[n])
      is_meshed[octree.parent(n)] = 1;

  const Directions& directions = neighbor_directions(Adjacency::VERTEX);
  std::vector<Octree::Node_index> lost;
  for(Octree::Node_index n = 0; n < octree.size(); ++n)
    if(octree.is_leaf(n) && located.meets_domain(n) && !is_meshed[n]
       && std::none_of(directions.begin(), directions.end(), [&](const std::array<int, 3>& d) {
            const Octree::Node_index m = octree.neighbor(n, d);
            return m != Octree::no_node && is_meshed[m];
          }))
      lost.push_back(n);
  return lost;
}

/// The lost cells of a mesh on the lattice.
inline std::vector<Octree::Node_index> lost_cells(const Located_octree& octree, const Lattice_mesh& mesh,
                                                  const Boundary_pieces& boundary)
{
  std::vector<std::uint8_t> is_meshed(octree.octree().size(), 0);
  for(std::size_t e = 0; e < mesh.cells.size(); ++e)
    if(!boundary.is_replaced[e])
      is_meshed[mesh.cells[e]] = 1;
  for(Element_index e : boundary.origins)
    is_meshed[mesh.cells[e]] = 1;
  return lost_cells(octree, std::move(is_meshed));
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_BOUNDARY_LOST_CELLS_H
