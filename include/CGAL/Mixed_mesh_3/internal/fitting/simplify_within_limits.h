// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Simplification as a stage alone: the limits are never given up.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_SIMPLIFY_WITHIN_LIMITS_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_SIMPLIFY_WITHIN_LIMITS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Core_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Followed_features.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/bound_for_doubles.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/find_followed_features.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/simplify.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/Any_surface.h>
#include <CGAL/Mixed_mesh_3/internal/surface/self_intersections.h>
#include <CGAL/Mixed_mesh_simplification_criteria_3.h>
#include <CGAL/Mixed_mesh_simplification_result_3.h>

#include <cstddef>
#include <functional>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Simplifies a mesh of its own accord: the sharp edges that the mesh follows are found, nothing but the form
/// of curved sharp edges is given up for the number of vertices.
/// \pre the mesh is a valid start, and not empty
template <class Quality>
Mixed_mesh_simplification_result_3
simplify_within_limits(Core_mesh& mesh, const Any_surface& surface, const Quality& quality,
                       const Mixed_mesh_simplification_criteria_3& criteria,
                       const std::function<bool()>& go_on)
{
  using Status = Mixed_mesh_simplification_status;
  Followed_features followed = find_followed_features(mesh, surface, criteria.sharp_angle());
  const std::size_t number = mesh.number_of_vertices();
  bool is_stopped = false;
  double bound = bound_for_doubles(criteria.quality_bound());
  const bool is_reached = simplify(mesh, followed, surface, quality, criteria.number_of_vertices(),
                                   criteria.region_radius(), criteria.distance(), bound,
                                   {true, false, criteria.distance(), bound, false}, [&] {
                                     is_stopped = is_stopped || !go_on();
                                     return !is_stopped;
                                   });
  Mixed_mesh_simplification_result_3 result;
  result.number_of_vertices = mesh.number_of_vertices();
  result.number_of_collapses = number - mesh.number_of_vertices();
  for(const auto& [edge, stratum] : followed.strata.edges)
    result.length_of_sharp_edges_followed += norm(to_vec3(mesh.point(edge.second))
                                                  - to_vec3(mesh.point(edge.first)));
  result.is_boundary_simple = !cuts_itself(mesh);
  result.status = is_reached || (criteria.number_of_vertices() == 0 && !is_stopped) ? Status::SUCCESS
                  : is_stopped                                                      ? Status::STOPPED
                               : Status::NUMBER_NOT_REACHED;
  return result;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_SIMPLIFY_WITHIN_LIMITS_H
