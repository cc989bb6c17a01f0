// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Checkers of the results of the stages, independent of the way in which the results were made.

#ifndef CGAL_MIXED_MESH_3_VALIDATION_H
#define CGAL_MIXED_MESH_3_VALIDATION_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/Octree_cell_traits_3.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Octree.h>
#include <CGAL/Mixed_mesh_3/internal/octree/balance.h>
#include <CGAL/Mixed_mesh_3/internal/transitions/Lattice_mesh.h>
#include <CGAL/Mixed_mesh_3/mesh_defects.h>
#include <CGAL/Mixed_mesh_3/options.h>
#include <CGAL/Mixed_mesh_3/quality.h>

#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMesh3Validity
/// Whether no two leaves adjacent across faces (and edges, and vertices) differ by more than a level.
/// \par Complexity
/// Linear in the number of leaves, times the depth
inline bool is_balanced(const internal::Octree& octree, Adjacency adjacency)
{
  using internal::Octree;
  // A leaf finds a coarser neighbor by looking for a neighbor of its own size.
  const internal::Directions& directions = internal::neighbor_directions(adjacency);
  for(Octree::Node_index n = 0; n < octree.size(); ++n)
    if(octree.is_leaf(n))
      for(const auto& d : directions) {
        const Octree::Node_index m = octree.neighbor(n, d);
        if(m != Octree::no_node && octree.level(m) + 1 < octree.level(n))
          return false;
      }
  return true;
}

/// \ingroup PkgMixedMesh3Validity
/// Finds defects in the result of the transition stage; positions are those of the lattice. The elements end
/// where the octree ends: the boundary need not be a manifold, nor is every vertex used.
inline Mesh_defects find_defects(const internal::Lattice_mesh& lattice)
{
  std::vector<Predicates_kernel::Point_3> points;
  points.reserve(lattice.vertices.size());
  for(const Lattice_point& p : lattice.vertices)
    points.emplace_back(p[0], p[1], p[2]);
  Mixed_mesh_3<Predicates_kernel> mesh;
  mesh.assign(std::move(points), lattice.elements, std::vector<Element_attributes>(lattice.elements.size()));
  return find_defects(mesh);
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_VALIDATION_H
