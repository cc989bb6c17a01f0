// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pass after which no faces of the boundary cut each other.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_RETREAT_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_RETREAT_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/fitting/Fitting_state.h>

#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Moves vertices of faces that cut each other back, because faces between vertices on the surface may meet
/// where the surface comes near to itself. The vertices go back toward places where no faces met, on the
/// surface if they were there already, until no faces meet.
/// \return the vertices of faces that still cut each other, ascending
template <class Quality>
std::vector<Vertex_index> retreat_from_self_intersections(Fitting_state<Quality>& s)
{
  // Of seven meshes of 2,000 vertices, with half of the rounds a slot keeps 0.982 of its sharp edges instead
  // of 0.984, and its worst aspect-ratio coefficient is 2.8 instead of 2.55; with 1 and 4 sweeps it keeps
  // 0.981 and 0.976. Twice as many rounds, or half or twice the acceptable cost, make no difference.
  constexpr int rounds = 24, sweeps = 2;
  constexpr double acceptable = 1000;
  std::vector<Vertex_index> crossing = s.crossing_vertices();
  for(int round = 0; round < rounds && !crossing.empty(); ++round) {
    const double share = round < rounds / 2 ? 0.25 : 1;
    for(Vertex_index v : crossing) {
      const bool stays = s.is_arrived[v] && s.saved_is_arrived[v];
      const Vec3 p = s.mesh.points[v], back = p + share * (s.saved_points[v] - p);
      const Vec3 place = share == 1 ? s.saved_points[v] : stays ? s.project(back, p, s.mesh.strata[v]) : back;
      if(!s.moves.try_move(v, place, acceptable))
        continue;
      s.moves.fix(v);
      if(!stays) {
        s.result.number_of_arrived_vertices -= s.is_arrived[v];
        s.is_arrived[v] = 0;
      }
    }
    s.moves.run(8, s.effort.good_enough[1], sweeps);
    crossing = s.crossing_vertices();
  }
  s.result.is_boundary_simple = crossing.empty();
  return crossing;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_RETREAT_H
