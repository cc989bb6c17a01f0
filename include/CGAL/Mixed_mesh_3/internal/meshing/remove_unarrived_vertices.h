// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Optimization of a mesh, and removal of boundary vertices that do not reach the surface.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_REMOVE_UNARRIVED_VERTICES_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_REMOVE_UNARRIVED_VERTICES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Aspect_ratio_quality_3.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Vertex_removal.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/coarsen.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/optimize_bounded.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/Meshing_state.h>

#include <cstddef>
#include <utility>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Brings the boundary onto the surface, with the vertices that the budget has left.
/// \param remove how vertices are removed that have not arrived, if they are few; empty: they stay
/// \param followed sharp features that the mesh follows already
inline void optimize_boundary(Meshing_state& s, Core_mesh& mesh, const Vertex_removal& remove,
                              Followed_features* followed = nullptr)
{
  s.visitor.before_fitting(mesh);
  s.result.quality_bound = s.quality_bound;
  const std::size_t before = mesh.number_of_vertices(),
                    rest = s.criteria.maximal_number_of_vertices() - before;
  const auto criteria = Mixed_mesh_optimization_criteria_3()
                          .tolerance(s.result.tolerance)
                          .quality_bound(s.quality_bound)
                          .sharp_angle(s.criteria.sharp_angle())
                          .number_of_bisections(s.share_of_bisections() > 0 ? rest : 0);
  s.result.optimization = optimize_bounded(
    mesh, s.root.domain(), {criteria, s.criteria.number_of_threads}, Aspect_ratio_quality_3(),
    [&s] { return s.go_on(); }, {}, remove, followed);
  if(remove)
    s.result.number_of_collapsed_vertices += before + s.result.optimization.number_of_bisections
                                             - s.result.optimization.number_of_merged_vertices
                                             - mesh.number_of_vertices();
  const bool is_only_wished = is_tolerance_wished(s.criteria)
                              && s.result.optimization.status
                                   == Mixed_mesh_optimization_status::TOLERANCE_NOT_REACHED;
  if(!is_only_wished)
    s.result.status = worse_status(s.result.status, status_of(s.result.optimization.status));
  s.result.is_kept = s.result.status == Mixed_mesh_status::STOPPED && s.best.is_manifold()
                     && s.criteria.keep_mesh_if_stopped();
  if(!s.result.has_mesh())
    mesh.clear();
}

/// Removes vertices that only tetrahedra have.
/// \return whether it has so few then
inline bool coarsen_to(Meshing_state& s, Core_mesh& mesh, std::size_t number_of_vertices,
                       Coarsening_goal goal = Coarsening_goal::SHAPE)
{
  return coarsen(
           mesh, s.root.domain(), number_of_vertices, s.quality_bound, s.radius_of_weights(),
           [&s] { return s.go_on(); }, goal)
         && !s.is_stopped;
}

/// How vertices are removed while the boundary is brought onto the surface.
inline Vertex_removal vertex_removal(Meshing_state& s)
{
  return [&s](Core_mesh& mesh, std::size_t number) {
    return coarsen_to(s, mesh, mesh.number_of_vertices() - number);
  };
}

/// Removes the boundary vertices off the surface, if they are few, and optimizes the mesh again.
/// \param status before the optimization
inline void remove_unarrived_vertices(Meshing_state& s, Core_mesh& mesh, Mixed_mesh_status status)
{
  const std::size_t off = s.number_not_arrived();
  if(off == 0 || s.is_stopped || !s.result.has_mesh())
    return;
  Core_mesh other = mesh;
  const Mixed_mesh_result_3 result = s.result;
  s.result.status = status;
  s.result.number_of_collapsed_vertices += off;
  if(coarsen_to(s, other, mesh.number_of_vertices() - off))
    optimize_boundary(s, other, {});
  if(!s.is_stopped && other.number_of_vertices() > 0 && s.number_not_arrived() < off)
    mesh = std::move(other);
  else
    s.result = result;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_REMOVE_UNARRIVED_VERTICES_H
