// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Postconditions of the stages from the octree's mesh to the result, for assertions.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_MESHING_POSTCONDITIONS_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_MESHING_POSTCONDITIONS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Core_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/boundary/Boundary_stage.h>
#include <CGAL/Mixed_mesh_3/internal/boundary/assemble_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Located_octree.h>
#include <CGAL/Mixed_mesh_3/internal/surface/self_intersections.h>
#include <CGAL/Mixed_mesh_3/internal/transitions/Lattice_mesh.h>
#include <CGAL/Mixed_mesh_3/mesh_defects.h>
#include <CGAL/Mixed_mesh_3/validation.h>
#include <CGAL/Mixed_mesh_criteria_3.h>
#include <CGAL/Mixed_mesh_result_3.h>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Whether the transition stage left a conforming mesh of positive elements.
inline bool is_valid_lattice_mesh(const Lattice_mesh& lattice)
{
  const Mesh_defects defects = find_defects(lattice);
  return defects.conforming() && defects.positive();
}

/// Whether the boundary stage left a conforming mesh of positive elements with as many vertices as it says,
/// whose boundary is a manifold unless defects are noted.
inline bool is_valid_boundary(const Located_octree& octree, const Lattice_mesh& lattice,
                              const Boundary_pieces& boundary)
{
  Core_mesh mesh;
  assemble_mesh(octree, lattice, boundary, mesh);
  const Mesh_defects defects = find_defects(mesh);
  return mesh.number_of_vertices() == boundary.number_of_vertices && defects.conforming()
         && defects.positive() && defects.unused_vertices == 0
         && (defects.closed_manifold_boundary() || !boundary.defects.empty());
}

/// Whether a mesh that is cut along surfaces is empty, or has no defect.
inline bool is_valid_cut(const Core_mesh& mesh) { return find_defects(mesh).none(); }

/// Whether two descriptions of shells have the same topology, as far as both are known.
inline bool is_same_topology(const Mixed_mesh_result_3& result)
{
  return !result.shells || !result.shells_of_domain
         || (result.shells->number_of_shells == result.shells_of_domain->number_of_shells
             && result.shells->euler_characteristic == result.shells_of_domain->euler_characteristic);
}

/// Whether the numbers of the result are those of the mesh: there is a mesh if the status says so, within the
/// budget; a mesh on the surface has the topology of the domain unless the status says otherwise.
inline bool are_numbers_of_mesh(const Mixed_mesh_result_3& result, const Mixed_mesh_criteria_3& criteria,
                                const Core_mesh& mesh)
{
  const Mixed_mesh_optimization_result_3& fit = result.optimization;
  return result.has_mesh() != mesh.is_empty() && mesh.number_of_vertices() <= result.vertex_budget
         && result.vertex_budget <= criteria.maximal_number_of_vertices()
         && fit.number_of_arrived_vertices <= fit.number_of_boundary_vertices
         && fit.number_of_boundary_vertices <= mesh.number_of_vertices()
         && (!criteria.fit_to_surface() || result.status >= Mixed_mesh_status::TOPOLOGY_DIFFERS
             || is_same_topology(result));
}

/// Whether the mesh has no defect but those that the status names, and its boundary does not cut itself if
/// the result says so.
inline bool is_valid_result(const Mixed_mesh_result_3& result, const Core_mesh& mesh)
{
  const Mesh_defects defects = find_defects(mesh);
  const bool is_pinched = result.status == Mixed_mesh_status::BOUNDARY_NOT_MANIFOLD;
  return defects.conforming() && defects.positive() && defects.unused_vertices == 0
         && (is_pinched || defects.none())
         && (is_pinched || !result.optimization.is_boundary_simple || !cuts_itself(mesh));
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_MESHING_POSTCONDITIONS_H
