// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pass after which no element is above the quality bound.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_MEND_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_MEND_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/fitting/Fitting_state.h>

#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Runs a round of steps with a power at which the worst elements count, within the bound in the end.
template <class Quality>
void improve_worst(Fitting_state<Quality>& s, typename Fitting_state<Quality>::Flipper& flipper, int round)
{
  // Of seven meshes of 2,000 vertices, flips in all rounds change two, which are no worse; with 6 rounds
  // until flips, the worst aspect-ratio coefficient of a part is 3.1 instead of 2.4. A power of 8 or 32 makes
  // it 2.5. With half of the goal, coefficients are larger by 1 % on average, the worst ones 2.25 instead of
  // 2.55, but 3.0 in the part; with twice as much, the worst ones are 2.7 to 10.
  constexpr int rounds_until_flips = 3;
  constexpr double power = 16, goal = 0.8; // share of the bound
  const double bound = s.final_bound();
  if(s.criteria.flips() && round % rounds_until_flips == 0)
    s.result.number_of_flips += s.flip(flipper, power, goal * bound);
  s.moves.reset_steps();
  s.moves.run(power, goal * bound, s.sweeps_after_boundary);
  s.choose_new_targets();
  s.advance(bound);
}

/// Lets a boundary vertex leave the surface; the vertex comes back if it can.
template <class Quality>
void leave_surface(Fitting_state<Quality>& s, Vertex_index v)
{
  if(s.is_arrived[v]) {
    s.is_arrived[v] = 0;
    --s.result.number_of_arrived_vertices;
    s.underway.emplace_back(v, s.mesh.points[v]);
  }
  s.moves.free_from_surface(v);
}

// Rounds of improving the worst elements: with all boundary vertices on the surface, then, if there are sharp
// edges, without features, then with vertices that leave the surface. Of seven meshes of 2,000 vertices, with
// 3 rounds on the surface, a part and a slot keep less of their sharp edges, by 0.002 and 0.008; with 12, the
// slot keeps 0.004 more, and its worst aspect-ratio coefficient is 2.8 instead of 2.55. With half or twice as
// many rounds leaving the surface, all are the same.
constexpr int mending_rounds_on_surface = 6, mending_rounds_of_features = 6,
              mending_rounds_leaving_surface = 18;

/// Improves elements above the bound at the cost of the elements around them; where that does not suffice,
/// boundary vertices leave the surface, and come back where it has sufficed.
/// \return whether a vertex was moved
template <class Quality>
bool mend(Fitting_state<Quality>& s)
{
  // Largest share of all vertices: a mesh with a larger share of vertices of bad elements is not worth
  // mending. With half and twice of either, 18 meshes are the same (constants.md).
  constexpr double largest_share_to_improve = 0.1, largest_share_with_features = 0.3;
  const double bound = s.final_bound();
  std::vector<Vertex_index> bad = s.moves.vertices_above(bound);
  const double largest_share = s.features ? largest_share_with_features : largest_share_to_improve;
  if(s.mode.keeps_bound || bad.empty() || double(bad.size()) > largest_share * double(s.mesh.points.size()))
    return false;
  typename Fitting_state<Quality>::Flipper flipper(s.mesh, s.quality, bound);
  s.moves.attract({});
  s.moves.set_bound(bound);
  const int rounds_on_surface = mending_rounds_on_surface + (s.features ? mending_rounds_of_features : 0);
  for(int round = 0; round < rounds_on_surface + mending_rounds_leaving_surface && !bad.empty(); ++round) {
    for(Vertex_index v : bad) {
      if(round >= mending_rounds_on_surface && s.mesh.strata[v] >= first_sharp_stratum)
        s.leave_feature(v);
      else if(round >= rounds_on_surface && s.mesh.is_on_boundary(v))
        leave_surface(s, v);
      s.moves.activate_around(v);
    }
    improve_worst(s, flipper, round);
    bad = s.moves.vertices_above(bound);
  }
  return true;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_MEND_H
