// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The optimization as a list of passes.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_OPTIMIZE_SURFACE_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_OPTIMIZE_SURFACE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Concurrency.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Fitting_state.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/arrive.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/fitting_postconditions.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/follow_sharp_edges.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/improve.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/mend.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/merge_unarrived_vertices.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/retreat.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/return_to_surface.h>
#include <CGAL/Mixed_mesh_3/internal/surface/self_intersections.h>
#include <CGAL/Mixed_mesh_3/mesh_defects.h>

#include <CGAL/assertions.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The outcome of a run of the optimization.
struct Fitting_outcome
{
  Core_mesh mesh;
  Mixed_mesh_optimization_result_3 result;
  std::vector<Vertex_index> crossing; ///< vertices of boundary faces that cut each other
  bool is_without_attraction;         ///< no attraction: by the mode, or as too much did not arrive
  bool has_crossed = false;           ///< not finished, as some faces cut each other after the arrival
  Sharp_strata sharp;                 ///< of the mesh
};

/// Runs the passes that finish a boundary that does not cut itself.
/// \return whether the passes were not stopped
template <class Quality>
bool finish(Fitting_state<Quality>& s, std::vector<Vertex_index>& crossing,
            const std::function<bool()>& go_on)
{
  if(mend(s))
    crossing = retreat_from_self_intersections(s);
  if(!crossing.empty())
    return true;
  return_to_surface(s);
  if(!s.criteria.flips() || s.domain.has_sheets())
    return true;
  if(!merge_unarrived_vertices(s, go_on))
    return false;
  if(!s.mode.keeps_sharp_edges)
    return true;
  // As a last resort, vertices leave their sharp edges.
  std::vector<Vertex_index> off = s.vertices_not_arrived();
  off.erase(std::remove_if(off.begin(), off.end(),
                           [&](Vertex_index v) { return s.mesh.strata[v] < first_sharp_stratum; }),
            off.end());
  for(Vertex_index v : off)
    s.leave_feature(v);
  if(off.empty())
    return true;
  return_to_surface(s);
  return merge_unarrived_vertices(s, go_on);
}

template <class Quality>
void set_status(Fitting_state<Quality>& s, bool is_stopped)
{
  using Status = Mixed_mesh_optimization_status;
  Mixed_mesh_optimization_result_3& r = s.result;
  const bool is_fitted = r.number_of_arrived_vertices == r.number_of_boundary_vertices
                         && r.is_boundary_simple;
  r.status = is_stopped                                    ? Status::STOPPED
             : !is_fitted                                  ? Status::NOT_ALL_ARRIVED
             : r.largest_distance > s.criteria.tolerance() ? Status::TOLERANCE_NOT_REACHED
                                                           : Status::SUCCESS;
}

/*!
Runs all passes once.

\param start mesh that the result is made of; the only one beside the working mesh while passes run
\param features sharp edges that paths of the boundary's edges are to follow; may be empty
\param sharp paths that follow them already; empty: they are to be chosen
\param is_held whether each boundary vertex stays where it is
*/
template <class Quality>
Fitting_outcome optimize_surface(const Core_mesh& start, const Any_surface& domain,
                                 const With_threads<Mixed_mesh_optimization_criteria_3>& criteria,
                                 const Quality& quality, const Fitting_mode& mode,
                                 const Sharp_features& features, const Sharp_strata& sharp,
                                 const std::vector<std::uint8_t>& is_held, const std::function<bool()>& go_on)
{
  // Share of the boundary vertices: if more have not arrived after the first pass, the vertices that draw
  // others would be in their way, and take most of the time. Of seven meshes of 2,000 vertices, a slot keeps
  // 0.975 of its sharp edges with half of it, instead of 0.984; with twice as much all are the same.
  constexpr double max_share_underway = 0.02;
  // Share of the boundary vertices: if faces of more of them cut each other after the first pass (four
  // surfaces of CGAL's demos, 10 % and more), a run within the bound is better, and takes a third of the
  // time.
  constexpr double max_share_crossing = 0.07;
  // Number of vertices of two triangles. If faces of more vertices cut each other after the first pass, all
  // of the boundary arrives in none of 25 runs (15 surfaces of CGAL's demos), with fewer in two of six.
  constexpr double max_crossing = 6;
  // Share of the boundary vertices: if more have not arrived because they are held, most never arrive. With
  // half and twice of it, 18 meshes are the same (constants.md).
  constexpr double max_share_held = 0.2;

  Fitting_state<Quality> s(start, domain, criteria, quality, mode);
  s.is_held = is_held;
  s.project.set_features(features);
  if(!features.empty()) {
    s.features = &features;
    if(sharp.empty())
      choose_feature_paths(s);
    else {
      s.mesh.set_sharp_strata(sharp);
      s.mode.keeps_sharp_edges = true;
    }
  }
  bool goes_on = arrive(s, go_on);
  if(goes_on) {
    const double crossing = double(s.save_points_if_simple()),
                 boundary = double(s.result.number_of_boundary_vertices);
    const bool is_hard = crossing > max_share_crossing * boundary
                         || (mode.is_without_attraction
                             && double(s.underway.size()) > max_share_held * boundary);
    if(s.has_bound() && !mode.keeps_bound && !mode.leaves_rest && sharp.empty()
       && (is_hard || (crossing > max_crossing && mode.needs_all))) {
      s.result.is_boundary_simple = false; // only small steps lead to a boundary that does not cut itself
      s.result.status = Mixed_mesh_optimization_status::NOT_ALL_ARRIVED;
      return {start, s.result, {}, is_hard, !is_hard, sharp};
    }
    s.mode.is_without_attraction = s.mode.is_without_attraction
                                   || double(s.underway.size()) > max_share_underway * boundary;
    goes_on = improve(s, go_on);
  }
  std::vector<Vertex_index> crossing = retreat_from_self_intersections(s);
  if(goes_on && crossing.empty() && !mode.leaves_rest)
    goes_on = finish(s, crossing, go_on);
  if(criteria.tolerance() > 0 && mode.number_of_vertices_estimated == 0) {
    s.attraction.forget_measurements(); // bounds of distances are not distances
    s.attraction.measure();
    s.result.largest_distance = s.attraction.largest_distance();
  }
  if(s.features)
    measure_features(s);
  set_status(s, !goes_on);
  CGAL_postcondition(are_counts_of_mesh(s.result, s.mesh, s.is_arrived));
  CGAL_expensive_postcondition(are_arrived_on_surfaces(s.mesh, s.is_arrived, s.project));
  Fitting_outcome outcome{s.mesh.changed(start),        s.result, std::move(crossing),
                          s.mode.is_without_attraction, false,    s.mesh.sharp_strata()};
  CGAL_expensive_postcondition(are_strata_of_faces(s.mesh, outcome.mesh, s.strata));
  CGAL_expensive_postcondition(has_no_new_defects(find_defects(start), outcome.mesh));
  CGAL_expensive_postcondition(!s.result.is_boundary_simple || !cuts_itself(outcome.mesh));
  return outcome;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_OPTIMIZE_SURFACE_H
