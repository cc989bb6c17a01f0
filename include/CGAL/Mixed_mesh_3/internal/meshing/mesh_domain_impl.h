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
#include <CGAL/Mixed_mesh_3/internal/meshing/fewest_vertices.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/mesh_domain.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/meshing_postconditions.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Located_octree.h>

#include <CGAL/assertions.h>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

CGAL_MIXED_MESH_3_INLINE Mixed_mesh_result_3 mesh_domain(const Oracles& oracles,
                                                         const Meshing_criteria& criteria,
                                                         Any_visitor& visitor, Core_mesh& mesh)
{
  CGAL_precondition(!criteria.fewest_vertices() || (criteria.tolerance() > 0 && criteria.fit_to_surface()));
  const Located_octree root(oracles);
  const Mixed_mesh_result_3 result = criteria.fewest_vertices()
                                       ? run_with_fewest_vertices(root, criteria, visitor, mesh)
                                       : run_stages(root, criteria, visitor, mesh);
  CGAL_postcondition(are_numbers_of_mesh(result, criteria, mesh));
  CGAL_expensive_postcondition(is_valid_result(result, mesh));
  return result;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_MESH_DOMAIN_IMPL_H
