// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A mesh that is too far from the surface somewhere is made once more, with smaller cells there.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_RETRY_FAR_PLACES_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_RETRY_FAR_PLACES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/meshing/fill_budget.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/make_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/stage_scopes.h>

#include <utility>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Whether the mesh made last is so far from the surface that another one is worth its time.
inline bool is_worth_a_retry(const Meshing_state& s, const Misfit& misfit)
{
  // Multiple of a tolerance that is only wished: a mesh of ten of a brain, with 2,000 to 20,000 vertices.
  constexpr double tolerated_multiple = 1.5;
  const double tolerated = is_tolerance_wished(s.criteria) ? tolerated_multiple : 1;
  return s.criteria.fit_to_surface() && s.result.has_mesh() && !s.result.is_kept && !s.is_stopped
         && s.tolerance_search.has_samples() && !s.result.is_lattice_on_surface && !s.thin_start
         && misfit.is_topology_right()
         && s.result.optimization.largest_distance > tolerated * s.result.tolerance;
}

/// Makes the mesh once more, or a few times, with smaller cells where the last one is too far from the
/// surface: what the fit makes of a furrow between cells is not known before. The nearest mesh is taken.
inline void retry_far_places(Meshing_state& s, Core_mesh& mesh, Misfit& misfit)
{
  constexpr int most_retries = 2;
  if(!is_worth_a_retry(s, misfit))
    return;
  Meshing_state::Snapshot best = s.snapshot();
  Core_mesh last = mesh;
  Misfit of_last = misfit;
  for(int retry = 0; retry < most_retries && is_worth_a_retry(s, of_last); ++retry) {
    if(!s.tolerance_search.note_far_places(last, s.octree))
      break;
    {
      const Stage_scope scope(s.visitor, Stage::OCTREE);
      fill_budget(s);
    }
    if(!s.best.is_good() || s.best.number_of_vertices > s.criteria.maximal_number_of_vertices())
      break;
    make_mesh(s, last);
    of_last = s.misfit_of(last);
    if(s.is_stopped || !s.result.has_mesh() || misfit < of_last
       || !(s.result.optimization.largest_distance < best.result.optimization.largest_distance))
      continue;
    best = s.snapshot();
    mesh = last;
    misfit = of_last;
  }
  s.restore(std::move(best));
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_RETRY_FAR_PLACES_H
