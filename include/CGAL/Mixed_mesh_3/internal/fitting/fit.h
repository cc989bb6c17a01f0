// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Algorithm 1 as a whole: targets, relaxation, new targets for vertices that are held.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_FIT_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_FIT_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Strata.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Surface_projection.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/fitting_postconditions.h>
#include <CGAL/Mixed_mesh_3/internal/moves/is_valid_start.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/relax_to_surface.h>
#include <CGAL/Mixed_mesh_3/internal/base/Core_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/surface_targets.h>
#include <CGAL/Mixed_mesh_3/mesh_defects.h>
#include <CGAL/Mixed_mesh_fit_criteria_3.h>
#include <CGAL/Mixed_mesh_fit_result_3.h>

#include <CGAL/assertions.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Computes targets and runs Algorithm 1; vertices that are held in the end get new targets, nearest to where
/// they have come.
template <class Quality, class Solver, class Go_on>
Mixed_mesh_fit_result_3 fit(Core_mesh& mesh, const Any_surface& domain, const Quality& quality,
                            const Mixed_mesh_fit_criteria_3& criteria, Solver& solver, const Go_on& go_on)
{
  constexpr int maximal_number_of_attempts = 3;
  CGAL_expensive_postcondition_code(const Mesh_defects defects_of_start = find_defects(mesh));
  Mixed_mesh_fit_result_3 result;
  if(mesh.is_empty())
    return result;
  if(!is_valid_start(mesh)) {
    result.status = Mixed_mesh_fit_status::INVALID_MESH;
    return result;
  }
  std::vector<Vec3> points;
  points.reserve(mesh.number_of_vertices());
  for(const auto& p : mesh.points())
    points.push_back(to_vec3(p));
  Strata strata(domain);
  const Interface_faces boundary = strata.sorted_faces(mesh);
  const std::vector<Stratum> of_vertices = strata.of_vertices(points.size(), boundary);
  const Surface_projection project(domain, strata);
  for(int attempt = 0; attempt < maximal_number_of_attempts; ++attempt) {
    const Surface_targets targets = surface_targets(boundary.faces, points, project, of_vertices);
    Surface_relaxation relaxation(mesh.elements(), targets, criteria, quality, solver, go_on, points);
    result = relaxation(result);
    if(result.status != Mixed_mesh_fit_status::NOT_ALL_ARRIVED)
      break;
  }
  for(std::size_t v = 0; v < points.size(); ++v)
    if(to_vec3(mesh.points()[v]) != points[v])
      mesh.points()[v] = Core_mesh::Point_3(points[v][0], points[v][1], points[v][2]);
  CGAL_postcondition(are_counts_of_strata(result, of_vertices));
  CGAL_expensive_postcondition(!result.is_on_surface() || are_all_on_surfaces(points, of_vertices, project));
  CGAL_expensive_postcondition(has_no_new_defects(defects_of_start, mesh));
  return result;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_FIT_H
