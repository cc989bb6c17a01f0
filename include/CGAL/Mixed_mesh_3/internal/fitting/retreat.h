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

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Makes vertices held: they stay where they are, and are no longer underway.
/// \param vertices ascending
template <class Quality>
void hold_vertices(Fitting_state<Quality>& s, const std::vector<Vertex_index>& vertices)
{
  for(Vertex_index v : vertices)
    s.moves.fix(v);
  s.underway.erase(std::remove_if(s.underway.begin(), s.underway.end(),
                                  [&](const auto& u) {
                                    return std::binary_search(vertices.begin(), vertices.end(), u.first);
                                  }),
                   s.underway.end());
}

/// Moves vertices back to saved places, all at once: one by one, those that have moved as well would be in
/// the way of each other. Vertices that have arrived since then are underway again.
/// \return whether no element is worse then than any may be at saved places; otherwise no vertex is moved
template <class Quality>
bool go_back(Fitting_state<Quality>& s, const std::vector<Vertex_index>& vertices)
{
  std::vector<Vec3> before;
  for(Vertex_index v : vertices)
    before.push_back(std::exchange(s.mesh.points[v], s.saved_points[v]));
  const auto is_acceptable = [&](Element_index e) {
    const Working_mesh::Element& element = s.mesh.elements[e];
    return s.mesh.is_positive(element)
           && s.quality(element.kind, s.mesh.relative_points(element)) <= s.largest_saved_cost;
  };
  const bool is_possible = std::all_of(vertices.begin(), vertices.end(), [&](Vertex_index v) {
    return std::all_of(s.mesh.incident[v].begin(), s.mesh.incident[v].end(), is_acceptable);
  });
  for(std::size_t i = 0; i < vertices.size(); ++i) {
    const Vertex_index v = vertices[i];
    if(!is_possible) {
      s.mesh.points[v] = before[i];
      continue;
    }
    s.moves.activate_around(v);
    if(s.is_arrived[v] && !s.saved_is_arrived[v]) {
      s.set_underway(v, before[i]);
      --s.result.number_of_arrived_vertices;
    }
  }
  if(is_possible)
    s.moves.forget_costs();
  return is_possible;
}

/// Adds the vertices of the elements around vertices, and those around these, and so on.
template <class Quality>
void add_rings(const Fitting_state<Quality>& s, int number, std::vector<Vertex_index>& vertices)
{
  std::vector<std::uint8_t> is_among(s.mesh.points.size(), 0);
  for(Vertex_index v : vertices)
    is_among[v] = 1;
  std::size_t first = 0;
  for(int ring = 0; ring < number; ++ring)
    for(const std::size_t last = vertices.size(); first < last; ++first)
      for(Element_index e : s.mesh.incident[vertices[first]])
        for(Vertex_index u : s.mesh.elements[e])
          if(!is_among[u]) {
            is_among[u] = 1;
            vertices.push_back(u);
          }
}

/// Moves vertices of faces that cut each other back to saved places, where no faces met, and more and more of
/// their neighbors with them, in the end all vertices. Those of faces that cut each other are held there.
/// \return the vertices of faces that still cut each other, ascending; none if elements are those for which
/// places were saved
template <class Quality>
std::vector<Vertex_index> go_back_until_simple(Fitting_state<Quality>& s)
{
  constexpr int attempts = 4; // with 1, 2, 4, and 8 rings of neighbors
  std::vector<Vertex_index> crossing = s.crossing_vertices();
  for(int attempt = 0; attempt <= attempts && !crossing.empty(); ++attempt) {
    const bool is_last = attempt == attempts;
    std::vector<Vertex_index> around = crossing;
    if(is_last) {
      around.resize(s.mesh.points.size());
      std::iota(around.begin(), around.end(), Vertex_index(0));
    } else {
      add_rings(s, 1 << attempt, around);
    }
    if(go_back(s, around)) {
      hold_vertices(s, crossing);
      crossing = s.crossing_vertices();
    }
  }
  return crossing;
}

/// Lets faces that cut each other go back, if none did at the start, and saves where all vertices are then.
template <class Quality>
void undo_crossing(Fitting_state<Quality>& s)
{
  if(s.is_careful && go_back_until_simple(s).empty())
    s.save_points();
}

/// Moves vertices of faces that cut each other back, because faces between vertices on the surface may meet
/// where the surface comes near to itself. The vertices go back toward places where no faces met, on the
/// surface if they were there already; where faces still meet then, all the way.
/// \return the vertices of faces that still cut each other, ascending
template <class Quality>
std::vector<Vertex_index> retreat_from_self_intersections(Fitting_state<Quality>& s)
{
  // Rounds that leave 3 % of the way, 0.75^12. With 1 and 4 sweeps, a slot of 2,000 vertices keeps 0.981 and
  // 0.976 of its sharp edges instead of 0.984; half or twice the acceptable cost make no difference.
  constexpr int rounds = 12, sweeps = 2;
  constexpr double acceptable = 1000, share = 0.25;
  std::vector<Vertex_index> crossing = s.crossing_vertices();
  for(int round = 0; round < rounds && !crossing.empty(); ++round) {
    for(Vertex_index v : crossing) {
      const bool stays = s.is_arrived[v] && s.saved_is_arrived[v];
      const Vec3 p = s.mesh.points[v], back = p + share * (s.saved_points[v] - p);
      if(!s.moves.try_move(v, stays ? s.project(back, p, s.mesh.strata[v]) : back, acceptable))
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
  if(!crossing.empty())
    crossing = go_back_until_simple(s);
  s.result.is_boundary_simple = crossing.empty();
  return crossing;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_RETREAT_H
