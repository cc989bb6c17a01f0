// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The method as a list of stages: octree, transitions, boundary, assembly, optimization.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_RUN_STAGES_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_RUN_STAGES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/meshing/fill_budget.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/make_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/simplify_to_budget.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/stage_scopes.h>
#include <CGAL/Mixed_mesh_3/quality_bound.h>

#include <cstddef>
#include <utility>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The tolerance of the criteria, or by default one that the budget can serve. Smaller ones take too many
/// vertices from the region, larger ones leave furrows unresolved: with 0.42 of an edge, brains of 660 to
/// 10,000 vertices are nowhere farther than that from their surface, nearly.
inline double chosen_tolerance(const Meshing_state& s)
{
  if(!is_tolerance_wished(s.criteria))
    return s.criteria.tolerance();
  return share_of_edge_tolerated * s.mean_edge();
}

/// The result says how topology and volume differ from those of the domain. A mesh that is not fitted has a
/// larger volume; its status is left to the function that fits it.
inline void note_misfit(Meshing_state& s, const Misfit& misfit)
{
  s.result.shells_of_domain = misfit.shells_of_domain();
  s.result.shells = misfit.shells();
  if(s.result.is_kept || !s.result.has_mesh() || !s.criteria.fit_to_surface())
    return;
  if(misfit.is_topology_wrong())
    s.result.status = worse_status(s.result.status, Mixed_mesh_status::TOPOLOGY_DIFFERS);
  else if(misfit.is_some_volume_wrong())
    s.result.status = worse_status(s.result.status, Mixed_mesh_status::VOLUME_DIFFERS);
}

/// Elements are counted by the bound of the criteria, also if a larger one was in force.
inline void note_elements_above_bound(Meshing_state& s, const Core_mesh& mesh)
{
  const double bound = s.criteria.quality_bound();
  if(!s.result.has_mesh() || !s.criteria.fit_to_surface() || !(s.result.quality_bound > bound))
    return;
  s.result.optimization.quality_bound = bound;
  s.result.optimization.number_of_elements_above_bound = number_of_elements_above(mesh, bound);
}

/// Makes the mesh of an octree that has the vertices of the budget.
inline void make_mesh_within_budget(Meshing_state& s, Core_mesh& mesh)
{
  {
    const Stage_scope scope(s.visitor, Stage::OCTREE);
    if(!fill_lattice(s)) {
      if(s.result.tolerance > 0)
        s.tolerance_search.run();
      if(!s.tolerance_search.is_stopped())
        fill_budget(s);
    }
  }
  make_mesh(s, mesh);
}

/// Makes the mesh: with a region, or several subdomains, out of a fine one that is cut along the surfaces;
/// else out of a fine one on the lattice, which follows sharp edges best, and if something is wrong in the
/// end, out of one that is cut, which keeps walls and gaps; the better mesh is taken. If there is none then,
/// or one with elements that are too flat, or none of these is to be made, a mesh is made of an octree with
/// the vertices of the budget; but not if there are layers, of which the octree's cells would leave nothing.
/// \param root the octree with nothing but its root
inline Mixed_mesh_result_3 run_stages(const Located_octree& root, const Meshing_criteria& criteria,
                                      Any_visitor& visitor, Core_mesh& mesh)
{
  Mixed_mesh_result_3 result;
  Misfit misfit = Misfit::without_mesh();
  bool is_above = false; // whether the mesh has elements above the bound in force
  const bool has_layers = root.domain().subdomain_indices().size() > 1,
             is_always_cut = has_layers || !root.is_region_everywhere();
  mesh.clear();
  // Makes a mesh, and takes it if it is better than the one before.
  // \return whether it is right, or the run is stopped
  const auto run = [&](const auto& make) {
    Meshing_state s(root, criteria, visitor);
    s.result.vertex_budget = criteria.maximal_number_of_vertices();
    s.result.tolerance = chosen_tolerance(s);
    Core_mesh other;
    make(s, other);
    const Misfit of_other = s.misfit_of(other);
    const bool is_other_above = s.result.optimization.number_of_elements_above_bound > 0;
    note_misfit(s, of_other);
    note_elements_above_bound(s, other);
    const bool is_better = of_other < misfit || (is_above && !is_other_above && !(misfit < of_other));
    if(mesh.is_empty() || (is_better && !s.is_stopped)) {
      result = s.result;
      misfit = of_other;
      is_above = is_other_above;
      mesh = std::move(other);
    }
    return s.is_stopped
           || (of_other.is_nearly_right(s.number_off_tolerated()) && (has_layers || !is_other_above));
  };
  const auto simplify = [&](bool is_cut) {
    return run([is_cut](Meshing_state& s, Core_mesh& m) { make_simplified_mesh(s, is_cut, m); });
  };
  if(begins_fine(root, criteria)) {
    const bool is_right = (!is_always_cut && simplify(false)) || simplify(true);
    const bool is_flat = result.quality_bound > largest_multiple_of_bound * criteria.quality_bound();
    if(is_right || (!mesh.is_empty() && (has_layers || !is_flat))
       || (has_layers && result.status == Mixed_mesh_status::BUDGET_TOO_SMALL))
      return result;
  }
  run(make_mesh_within_budget);
  return result;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_RUN_STAGES_H
