// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Resolution of walls and gaps that are thinner than the cells beside them.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_RESOLVE_THIN_PARTS_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_RESOLVE_THIN_PARTS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/meshing/coarsen_to_budget.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/fill_budget.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/make_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/thin_cells.h>

#include <array>
#include <cstddef>
#include <optional>
#include <utility>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Finds an octree that resolves walls and gaps, the start for filling the budget. If the topology is wrong,
/// the number of cells for a wall or a gap grows until the topology is right; if only the volume is wrong,
/// the number is as large as the budget has room for.
inline void resolve_thin_parts(Meshing_state& s, bool is_for_volume)
{
  // Safety factors on the cells per wall thickness: some walls need fewer than theory asks for. For the
  // volume, the largest goes first: tubes of two cells lose an eighth of it.
  constexpr std::array<double, 4> strictnesses{0.7, 1, 1.4, 2}, strictnesses_for_volume{2, 1.4, 1, 0.7};
  Located_octree start = s.root;
  s.thin_start.reset();
  s.right_start.reset();
  if(!refine_to_level(start, s.coarsest_level(), s.budget()))
    return;
  s.tolerance_search.split_far_cells(start);
  s.are_gaps_wider = true;
  Misfit best = Misfit::without_mesh();
  for(const double strictness : is_for_volume ? strictnesses_for_volume : strictnesses) {
    Located_octree octree = start;
    std::optional<Misfit> misfit;
    const auto count_vertices = [&](const Located_octree& o) {
      const Candidate c = s.try_octree(o);
      const std::size_t n = c.number_of_vertices;
      if(!c.is_stopped && 0 < n && n <= s.budget()) {
        misfit = s.misfit_on_lattice(o, c, lost_cells(o, c.mesh, c.boundary).size());
        if(!misfit->is_topology_wrong())
          s.right_start = o;
      }
      return n;
    };
    const Thin_cell_splits splits = split_thin_cells(octree, strictness, s.budget(), count_vertices);
    s.result.number_of_vertices_for_thin_parts = splits.number_of_vertices;
    if(!misfit)
      continue; // not even one level fits, or there are no vertices
    if(*misfit < best || !s.thin_start) {
      best = *misfit;
      s.thin_start = std::move(octree);
    }
    if(is_for_volume ? splits.is_complete : !splits.is_complete || misfit->is_none())
      return;
  }
}

/// Stops the run before the mesh is made: the mesh on the lattice may be kept.
inline bool stop_at(Meshing_state& s, Meshing_state::Snapshot snapshot)
{
  s.restore(std::move(snapshot));
  s.best.is_stopped = true;
  return false;
}

/// Spends the budget on thin parts first if the topology is wrong on the lattice, because fitting does not
/// change the topology; if the budget does not suffice, a finer mesh is coarsened to the budget.
/// \return whether the mesh is made
inline bool resolve_topology(Meshing_state& s, Core_mesh& mesh, Misfit& misfit)
{
  if(s.result.is_lattice_on_surface || s.best.is_stopped || s.tolerance_search.is_stopped())
    return false;
  const Misfit before = s.misfit_on_lattice();
  if(before.is_topology_right())
    return false;
  Meshing_state::Snapshot best = s.snapshot();
  {
    const Stage_scope scope(s.visitor, Stage::OCTREE);
    resolve_thin_parts(s, false);
    if(s.thin_start)
      fill_budget(s);
    if(s.right_start && !s.best.is_stopped && s.misfit_on_lattice().is_topology_wrong()) {
      s.thin_start = s.right_start;
      s.keeps_topology = true;
      fill_budget(s);
      s.keeps_topology = false;
    }
  }
  if(s.is_stopped)
    return stop_at(s, std::move(best));
  const Misfit within_budget = s.misfit_on_lattice();
  const std::size_t needed = s.result.number_of_vertices_for_thin_parts;
  if(within_budget < before)
    best = s.snapshot();
  if(!within_budget.is_topology_right()) {
    improve_by_finer_octree(s, mesh, misfit);
    if(s.is_stopped)
      return stop_at(s, std::move(best));
    if(misfit.is_topology_right())
      return true;
  }
  s.restore(std::move(best));
  s.result.number_of_vertices_for_thin_parts = needed;
  make_mesh(s, mesh);
  misfit = s.misfit_of(mesh);
  if(within_budget.is_topology_right())
    improve_by_finer_octree(s, mesh, misfit);
  return true;
}

/// Makes the mesh once more, if a part, or too much of its volume, is lost; then from a finer mesh.
inline void improve_thin_parts(Meshing_state& s, Core_mesh& mesh, Misfit& misfit)
{
  const bool can_be_better = s.result.status == Mixed_mesh_status::EMPTY
                             || (s.result.has_mesh() && !s.result.is_kept);
  if(!can_be_better)
    return;
  if(!misfit.is_none()) {
    const Mixed_mesh_result_3 result = s.result;
    Core_mesh other;
    {
      const Stage_scope scope(s.visitor, Stage::OCTREE);
      resolve_thin_parts(s, misfit.has_volume_only());
      if(s.thin_start)
        fill_budget(s);
    }
    if(s.thin_start)
      make_mesh(s, other);
    const Misfit other_misfit = s.misfit_of(other);
    if(s.is_stopped || !(other_misfit < misfit)) {
      const std::size_t needed = s.result.number_of_vertices_for_thin_parts;
      s.result = result;
      s.result.number_of_vertices_for_thin_parts = needed;
    } else {
      mesh = std::move(other);
      misfit = other_misfit;
    }
  }
  improve_by_finer_octree(s, mesh, misfit);
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_RESOLVE_THIN_PARTS_H
