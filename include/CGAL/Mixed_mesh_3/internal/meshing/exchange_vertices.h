// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Exchange of vertices far from the region, which an octree needs for its balance, for vertices in it.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_EXCHANGE_VERTICES_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_EXCHANGE_VERTICES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/meshing/coarsen_to_budget.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/fill_budget.h>

#include <cmath>
#include <cstddef>
#include <utility>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Whether an exchange may lower the error in the region: base level and balance of an octree with a small
/// budget take most of its vertices outside. On brains with 400 to 2,000 vertices, errors of a bump are lower
/// by 7 to 37 %. With 3,000, that of a smooth displacement is larger by a sixth, with 10,000 by two fifths.
inline bool may_exchange_vertices(const Meshing_state& s)
{
  constexpr std::size_t largest_budget = 2500;
  const Mixed_mesh_criteria_3& c = s.criteria;
  return c.exchange_vertices() && s.may_resolve_thin_parts() && !s.thin_start
         && !s.root.is_region_everywhere() && c.grading() > 0 && c.fit_to_surface()
         && c.boundary_mode() == Boundary_mode::VERTEX_ORDER
         && c.base_level() == Mixed_mesh_criteria_3::automatic && !s.root.domain().has_sheets()
         && !s.result.is_lattice_on_surface && !s.best.is_stopped && !s.tolerance_search.is_stopped()
         && s.best.is_good() && c.maximal_number_of_vertices() <= largest_budget;
}

/// Makes a mesh from an octree that has more vertices than the budget: edges are collapsed where that adds
/// least to the error in the region.
/// \param exchanged has no mesh; gets one if nothing is wrong with it, but for a distance that is only wished
/// \return whether it is near to the surface, too; otherwise the state is as before
inline bool exchange_vertices(Meshing_state& s, Best_mesh& exchanged)
{
  // Power of the budget: the vertices between cells of different size grow like it. 76 of 660, 160 of 2,000.
  // With half as many again, errors of smooth displacements are larger by a tenth, others the same.
  constexpr double exponent = 2. / 3;
  constexpr double times_bisections = 1.5; // of the share of an octree alone: the region has more room
  // Largest distance between boundary and surface, in tolerances. Most brains reach 0.7 to 1; a dumbbell with
  // a thin handle 4, as the handle is far from the region, where the octree alone would reach 0.6.
  constexpr double tolerated_distance = 1.1;
  const std::size_t n = s.criteria.maximal_number_of_vertices();
  Meshing_state::Snapshot before = s.snapshot();
  {
    const Stage_scope scope(s.visitor, Stage::OCTREE);
    s.number_exchanged = std::size_t(std::pow(double(n), exponent));
    fill_budget(s);
    s.number_exchanged = 0;
  }
  s.result.number_of_vertices_needed = 0; // it is coarsened
  describe_octree(s);
  Core_mesh result;
  if(s.result.status == Mixed_mesh_status::SUCCESS && !s.is_stopped) {
    Core_mesh fine = mesh_to_coarsen(s, true);
    fit_roughly(s, fine);
    const std::size_t bisections = std::size_t(times_bisections * s.share_of_bisections() * double(n));
    coarsen_and_optimize(s, fine, n - bisections, Coarsening_goal::REGION, result);
  }
  const Misfit of_result = s.misfit_of(result);
  const bool is_right = s.result.has_mesh() && result.number_of_vertices() > 0
                        && (s.result.is_kept || of_result.is_right());
  if(is_right)
    exchanged = {of_result, s.result, std::move(result)};
  const bool is_near = s.result.tolerance == 0
                       || s.result.optimization.largest_distance <= tolerated_distance * s.result.tolerance;
  if(is_right && (is_near || s.result.is_kept))
    return true;
  s.restore(std::move(before));
  return false;
}

/// Whether a mesh of exchanged vertices is nearer to the surface than another one that is not better
/// otherwise.
inline bool is_nearer(const Best_mesh& exchanged, const Meshing_state& s, const Misfit& misfit)
{
  return exchanged.mesh && !s.is_stopped && !(misfit < exchanged.misfit)
         && exchanged.result.optimization.largest_distance < s.result.optimization.largest_distance;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_EXCHANGE_VERTICES_H
