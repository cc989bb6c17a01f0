// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_OPTIONS_H
#define CGAL_MIXED_MESH_3_OPTIONS_H

#include <CGAL/license/Mixed_mesh_3.h>

namespace CGAL {
namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMesh3Octree
/// The adjacency across which leaves may differ by one level only.
enum class Adjacency {
  FACE = 1,  ///< a face
  EDGE = 2,  ///< a face or an edge
  VERTEX = 3 ///< a face, an edge or a vertex
};

/// \ingroup PkgMixedMesh3Octree
/// The way in which cells with hanging vertices are decomposed.
enum class Transition_templates_choice {
  FEWEST_VERTICES, ///< 118 of 144 templates need no vertex at the cell's center
  CENTERED         ///< every such cell is a cone from its center
};

/// \ingroup PkgMixedMesh3Octree
/// The shape of the root cell of axis-aligned octrees.
enum class Root_cell {
  CUBE, ///< a cube around the bounding box: all cells are cubes, of aspect-ratio coefficient 1
  BOX   ///< the bounding box itself, as in the paper: cells have its proportions
};

/// \ingroup PkgMixedMesh3Octree
/// The way in which elements at the surface are split.
enum class Boundary_mode {
  VERTEX_ORDER, ///< one order of all vertices: inserts no vertex, keeps pyramids
  PAPER         ///< section 5.2 of the paper: only tetrahedra, diagonals propagate
};

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_OPTIONS_H
