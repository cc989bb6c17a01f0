// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Oracles of the models that nearly all users have, compiled into the library: programs that link the library
// do not compile these oracles.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_USUAL_MODELS_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_USUAL_MODELS_H

#include <CGAL/license/Mixed_mesh_3.h>

#ifdef CGAL_MIXED_MESH_3_COMPILED

#include <CGAL/Labeled_polyhedral_mixed_mesh_domain_3.h>
#include <CGAL/Mixed_mesh_3/Octree_cell_traits_3.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/Oracles.h>
#include <CGAL/Mixed_mesh_regions_3.h>
#include <CGAL/Polyhedral_mixed_mesh_region_3.h>
#include <CGAL/Polyhedral_mixed_mesh_domain_3.h>

/// \param declare `extern template` or `template`
#define CGAL_MIXED_MESH_3_USUAL_MODELS(declare)                                                              \
  declare class Surface_reference<Polyhedral_mixed_mesh_domain_3>;                                           \
  declare class Surface_reference<Labeled_polyhedral_mixed_mesh_domain_3>;                                   \
  declare class Surface_reference<Polyhedral_mixed_mesh_domain_3, Any_domain>;                               \
  declare class Surface_reference<Labeled_polyhedral_mixed_mesh_domain_3, Any_domain>;                       \
  declare class Domain_reference<Polyhedral_mixed_mesh_domain_3, Axis_aligned_octree_cell_traits_3>;         \
  declare class Domain_reference<Labeled_polyhedral_mixed_mesh_domain_3, Axis_aligned_octree_cell_traits_3>; \
  declare class Region_reference<Everywhere_mixed_mesh_region_3, Axis_aligned_octree_cell_traits_3>;         \
  declare class Region_reference<Polyhedral_mixed_mesh_region_3, Axis_aligned_octree_cell_traits_3>;         \
  declare class Region_reference<Polyhedral_mixed_mesh_regions_3, Axis_aligned_octree_cell_traits_3>;        \
  declare class Region_reference<Ball_mixed_mesh_region_3, Axis_aligned_octree_cell_traits_3>;               \
  declare class Cell_traits_reference<Axis_aligned_octree_cell_traits_3>;

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

CGAL_MIXED_MESH_3_USUAL_MODELS(extern template)

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_COMPILED

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_USUAL_MODELS_H
