// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The first pass: the boundary vertices arrive on the surface, as far as validity and quality allow.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_ARRIVE_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_ARRIVE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/fitting/Fitting_state.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/follow_sharp_edges.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/retreat.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/split_flat_elements.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/surface_targets.h>

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Sets targets on the surface for boundary vertices that are not held.
template <class Quality>
void set_targets(Fitting_state<Quality>& s)
{
  const Surface_targets targets = surface_targets(s.boundary.faces, s.mesh.points, s.project, s.mesh.strata,
                                                  s.feature_places);
  s.result.number_of_boundary_vertices = targets.vertices.size();
  for(std::size_t i = 0; i < targets.vertices.size(); ++i) {
    const Vertex_index v = targets.vertices[i];
    if(s.is_held[v])
      continue;
    // A vertex that is on the surface stays, even if its faces are folded.
    const Vec3& p = s.mesh.points[v];
    const Vec3 q = s.project(p, targets.positions[i], s.mesh.strata[v]);
    const bool is_there = norm(q - p) <= 1e-14 * (norm(p) + norm(targets.positions[i] - p));
    if(!(is_there && s.note_arrival(v)))
      s.underway.emplace_back(v, is_there ? p : targets.positions[i]);
  }
}

/// Moves each boundary vertex to its target, all the way or a part of the way, as far as validity and quality
/// allow; then the inner vertices are optimized, and the next round follows.
/// \return whether the pass was not stopped
template <class Quality>
bool arrive(Fitting_state<Quality>& s, const std::function<bool()>& go_on)
{
  // Largest costs while the boundary arrives. The cost grows in each round, so that a vertex that does not
  // arrive with good elements arrives with worse ones: from 4, 15 rounds lead to 100. With a smaller limit
  // fewer vertices arrive, with a larger one elements are worse.
  constexpr double initial_acceptable_cost = 4, acceptable_growth = 1.25, largest_acceptable_cost = 100;
  constexpr int rounds = 40, rounds_for_features = 25, rounds_until_new_target = 8, rounds_until_check = 2;
  // Vertices that do not reach a sharp edge for some rounds may reach it with other tetrahedra: of twelve
  // polyhedra with angles of 30 to 60 degrees, flips keep some tenth more of the length of the sharp edges.
  // Flips in earlier rounds keep less.
  constexpr int rounds_until_flips = 8, rounds_to_flip = 4;
  constexpr double power_of_flips = 4, least_cost_to_flip = 1.2;
  // Where the rest is left, rounds without an arrival until elements are flipped, once, and until the end. Of
  // seven meshes of 2,000 vertices, with 1 and 6 rounds a part keeps 0.992 and 0.994 of its sharp edges
  // instead of 0.998, a slot 0.978 and 0.988 instead of 0.984, and with 6 the largest distance of a torus is
  // 1.9 times. With a cost of 1 and 4, the part keeps 0.996, the slot 0.965 and 0.959.
  constexpr int rounds_until_in_vain = 3;
  constexpr double least_cost_to_flip_in_vain = 2;

  set_targets(s);
  if(!s.mode.keeps_sharp_edges)
    split_flat_elements(s);
  // Small steps are checked: vertices whose faces would cut others go back, and are held. So are those from a
  // mesh that is on the surface already: layers of seven cortices were fitted two to four times without that.
  // There is no check without a bound: where elements may get that bad, too many vertices would be held.
  s.is_careful = (s.mode.is_without_attraction || s.mode.keeps_bound) && s.has_bound()
                 && s.crossing_vertices().empty();
  if(s.is_careful)
    s.save_points();
  const double largest_acceptable = s.mode.leaves_rest ? s.final_bound() : largest_acceptable_cost;
  double acceptable = (std::min)(initial_acceptable_cost, largest_acceptable);
  int rounds_without_arrival = 0;
  bool has_flipped = false;
  for(int round = 0; round < rounds && !s.underway.empty(); ++round) {
    if(!go_on())
      return false;
    const std::size_t before = s.underway.size();
    s.advance(acceptable);
    rounds_without_arrival = s.underway.size() < before ? 0 : rounds_without_arrival + 1;
    if(s.mode.leaves_rest && rounds_without_arrival == rounds_until_in_vain) {
      if(has_flipped)
        break;
      has_flipped = true;
      rounds_without_arrival = 0;
      undo_crossing(s); // so that elements are valid at saved places after flips, too
      typename Fitting_state<Quality>::Flipper flipper(s.mesh, s.quality, s.intermediate_bound());
      s.result.number_of_flips += s.flip(flipper, power_of_flips, least_cost_to_flip_in_vain);
    }
    s.moves.run(4, s.effort.good_enough_to_arrive, s.effort.sweeps_to_arrive);
    if(round % rounds_until_check == rounds_until_check - 1 || s.underway.empty())
      undo_crossing(s);
    if(s.features && s.criteria.flips() && !s.mode.leaves_rest && round >= rounds_until_flips
       && round % rounds_to_flip == rounds_to_flip - 1 && !s.underway.empty()) {
      typename Fitting_state<Quality>::Flipper flipper(s.mesh, s.quality, s.intermediate_bound());
      s.result.number_of_flips += s.flip(flipper, power_of_flips, least_cost_to_flip);
    }
    acceptable = (std::min)(acceptable_growth * acceptable, largest_acceptable);
    if(round % rounds_until_new_target == rounds_until_new_target - 1)
      s.choose_new_targets();
    if(s.features && !s.mode.leaves_rest && !s.mode.keeps_sharp_edges && round >= rounds_for_features
       && (round - rounds_for_features) % 3 == 0)
      give_up_features(s, round > rounds_for_features);
  }
  undo_crossing(s);
  return true;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_ARRIVE_H
