// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_MESH_DOMAIN_IMPL_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_MESH_DOMAIN_IMPL_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/compiled.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/mesh_domain.h>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

CGAL_MIXED_MESH_3_INLINE Mixed_mesh_result_3 mesh_domain(const Labeled_polyhedral_mixed_mesh_domain_3& domain,
                                                         const Polyhedral_mixed_mesh_regions_3& regions,
                                                         const Mixed_mesh_criteria_3& criteria,
                                                         const Axis_aligned_octree_cell_traits_3& cell_traits,
                                                         Any_visitor& visitor, Core_mesh& mesh)
{
  return mesh_domain<Labeled_polyhedral_mixed_mesh_domain_3, Polyhedral_mixed_mesh_regions_3,
                     Axis_aligned_octree_cell_traits_3>(domain, regions, criteria, cell_traits, visitor,
                                                        mesh);
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_MESH_DOMAIN_IMPL_H
