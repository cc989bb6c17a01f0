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
#include <CGAL/Mixed_mesh_3/internal/meshing/resolve_thin_parts.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/retry_far_places.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/simplify_to_budget.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/stage_scopes.h>
#include <CGAL/Mixed_mesh_3/quality_bound.h>

#include <optional>
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

/// Makes the mesh of a state from an octree that has the vertices of the budget: what follows the octree is
/// tried, until the budget is full.
inline void run_within_budget(Meshing_state& s, Core_mesh& mesh, Misfit& misfit)
{
  {
    const Stage_scope scope(s.visitor, Stage::OCTREE);
    if(!fill_lattice(s)) {
      if(s.result.tolerance > 0)
        s.tolerance_search.run();
      if(!s.tolerance_search.is_stopped()) {
        if(s.criteria.thin_parts() == Thin_parts::FIRST)
          resolve_thin_parts(s, true);
        fill_budget(s);
      }
    }
  }
  if(s.may_resolve_thin_parts() && resolve_topology(s, mesh, misfit))
    return;
  make_mesh(s, mesh);
  misfit = s.misfit_of(mesh);
  retry_far_places(s, mesh, misfit);
  if(s.may_resolve_thin_parts())
    improve_thin_parts(s, mesh, misfit);
}

/// Share of vertices off the surfaces of several subdomains up to which a mesh is taken at once: near curves
/// in which interfaces of labels meet, 3 % of those of a head of five labels are.
constexpr double tolerated_at_junctions = 0.05;

/// Makes the mesh. Where it begins with a fine one and something is wrong in the end, the octree of the
/// budget is tried as well, and the better mesh is taken.
/// \param root the octree with nothing but its root
inline Mixed_mesh_result_3 run_stages(const Located_octree& root, const Meshing_criteria& criteria,
                                      Any_visitor& visitor, Core_mesh& mesh)
{
  Mixed_mesh_result_3 result;
  Misfit misfit = Misfit::without_mesh();
  bool is_above = false; // whether the mesh has elements above the bound in force
  const auto run = [&](const auto& make) {
    Meshing_state s(root, criteria, visitor);
    s.result.vertex_budget = criteria.maximal_number_of_vertices();
    s.result.tolerance = chosen_tolerance(s);
    Core_mesh other;
    Misfit of_other = Misfit::without_mesh();
    make(s, other, of_other);
    const bool is_other_above = s.result.optimization.number_of_elements_above_bound > 0;
    note_misfit(s, of_other);
    note_elements_above_bound(s, other);
    // Few vertices off the surface are less to see than sharp edges that are cut off, or layers that are
    // lost, which need flat elements that octrees do not have.
    const Mixed_mesh_optimization_result_3& fit = s.result.optimization;
    const bool may_have_layers = s.has_several_subdomains();
    const double tolerated = may_have_layers                 ? tolerated_at_junctions
                             : fit.length_of_sharp_edges > 0 ? removable_share
                                                             : 0;
    const std::size_t few = std::size_t(tolerated * double(fit.number_of_boundary_vertices));
    const bool is_last = s.is_stopped
                         || (of_other.is_nearly_right(few) && (may_have_layers || !is_other_above)),
               is_better = of_other < misfit || (is_above && !is_other_above && !(misfit < of_other));
    if(mesh.is_empty() || (is_better && !s.is_stopped)) {
      result = s.result;
      misfit = of_other;
      is_above = is_other_above;
      mesh = std::move(other);
    }
    return is_last;
  };
  mesh.clear();
  const auto simplify_fine_mesh = [](Meshing_state& s, Core_mesh& m, Misfit& of_mesh) {
    make_simplified_mesh(s, m);
    of_mesh = s.misfit_of(m);
  };
  if(!begins_fine(root, criteria) || !run(simplify_fine_mesh))
    run(run_within_budget);
  return result;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_RUN_STAGES_H
