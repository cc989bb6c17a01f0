// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pass that merges boundary vertices that can not arrive with vertices beside them.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_MERGE_UNARRIVED_VERTICES_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_MERGE_UNARRIVED_VERTICES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/fitting/Fitting_state.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/mend.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/merge_boundary_vertices.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <set>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

// Pairs of a vertex and the vertex that it shall not be merged with, or of a vertex and itself if the vertex
// shall not move.
using Failed_merges = std::set<Working_mesh::Edge>;

/// Notes that a vertex of the boundary has no element any more.
template <class Quality>
void note_gone(Fitting_state<Quality>& s, Vertex_index v)
{
  s.moves.fix(v);
  --s.result.number_of_boundary_vertices;
  s.result.number_of_arrived_vertices -= s.is_arrived[v];
  ++s.result.number_of_merged_vertices;
}

/// Removes a vertex with its elements, if the boundary stays near enough.
/// \return the vertices that are gone
template <class Quality>
std::vector<Vertex_index> remove_with_elements(Fitting_state<Quality>& s,
                                               Boundary_vertex_merger<Quality>& merger, Vertex_index v)
{
  // Share of the mean edge of the boundary: half of the tolerance that meshes have by default. What is
  // removed is a spike, mostly, with edges of a tenth to a fifth of those around it.
  constexpr double share_of_edge = 0.2;
  const Stratum stratum = s.mesh.strata[v];
  if(stratum >= first_sharp_stratum)
    return {};
  std::vector<Vertex_index> gone = merger.remove(v, share_of_edge
                                                      * s.mean_edge_length(s.first_subdomain(stratum)));
  for(Vertex_index u : gone)
    note_gone(s, u);
  return gone;
}

/// Removes a vertex with its elements or, where that may not be, a vertex beside it that has one element,
/// which lies between three faces of the boundary, and would be flat where the surface is.
/// \return the vertices that are gone
template <class Quality>
std::vector<Vertex_index> remove_at(Fitting_state<Quality>& s, Boundary_vertex_merger<Quality>& merger,
                                    Vertex_index v)
{
  std::vector<Vertex_index> gone = remove_with_elements(s, merger, v);
  for(Vertex_index u : s.mesh.neighbors(v))
    if(gone.empty() && s.mesh.incident[u].size() == 1)
      gone = remove_with_elements(s, merger, u);
  return gone;
}

/// Merges each vertex that has not arrived with a vertex beside it, or removes it with its elements where it
/// can not be merged; those that are left become underway.
/// \return the merged pairs, and pairs of a removed vertex and `no_vertex`
template <class Quality>
std::vector<Working_mesh::Edge> merge_with_neighbors(Fitting_state<Quality>& s,
                                                     Boundary_vertex_merger<Quality>& merger,
                                                     const Failed_merges& failed)
{
  std::vector<Working_mesh::Edge> merged;
  s.underway.clear();
  for(Vertex_index v : s.vertices_not_arrived()) {
    if(s.is_held[v] || !s.mesh.is_on_boundary(v)) // it is gone with another one
      continue;
    const Vec3 place = s.project(s.mesh.points[v], s.mesh.strata[v]);
    const Vertex_index w = merger(v, place, [&](Vertex_index u) { return failed.count({v, u}) == 0; });
    if(w != no_vertex) {
      note_gone(s, v);
      s.moves.activate_around(w);
      merged.emplace_back(v, w);
      continue;
    }
    const std::vector<Vertex_index> gone = remove_at(s, merger, v);
    for(Vertex_index u : gone)
      merged.emplace_back(u, no_vertex);
    if(std::find(gone.begin(), gone.end(), v) == gone.end() && failed.count({v, v}) == 0)
      s.underway.emplace_back(v, place);
  }
  s.underway.erase(std::remove_if(s.underway.begin(), s.underway.end(), // gone with a later one
                                  [&](const auto& u) { return !s.mesh.is_on_boundary(u.first); }),
                   s.underway.end());
  if(!merged.empty())
    s.update_boundary();
  return merged;
}

/// Merges vertices in rounds. If elements are above the bound after a round, or faces cut each other, the
/// round is undone, and other merges are tried.
/// \return whether the pass was not stopped
template <class Quality>
bool merge_unarrived_vertices(Fitting_state<Quality>& s, const std::function<bool()>& go_on)
{
  constexpr int rounds = 24; // half or twice as many make no difference to seven meshes of 2,000 vertices
  // A merge that makes elements worse than that multiple of the bound would not be mended. Half or twice as
  // much makes no difference to five meshes of 2,000 vertices.
  constexpr double largest_multiple_to_merge = 100;
  const double bound = s.final_bound();
  Boundary_vertex_merger<Quality> merger(s.mesh, s.quality, largest_multiple_to_merge * bound);
  typename Fitting_state<Quality>::Flipper flipper(s.mesh, s.quality, bound);
  Failed_merges failed;
  s.moves.attract({});
  s.moves.set_bound(bound);
  const std::size_t bad_before = s.moves.vertices_above(bound).size();
  if(bad_before > 0 && !s.mode.keeps_bound)
    return true; // merges would not improve elements
  for(int round = 0; round < rounds && !s.vertices_not_arrived().empty(); ++round) {
    if(!go_on())
      return false;
    const auto simple = s.snapshot();
    Transaction transaction(s.mesh);
    const Mixed_mesh_optimization_result_3 result = s.result;
    const std::vector<Working_mesh::Edge> merged = merge_with_neighbors(s, merger, failed);
    if(merged.empty())
      break;
    for(int i = 0; i < mending_rounds_on_surface; ++i)
      improve_worst(s, flipper, i);
    const std::vector<Vertex_index> crossing = s.crossing_vertices();
    std::vector<Vertex_index> bad = s.moves.vertices_above(bound);
    if(bad.size() <= bad_before && crossing.empty()) {
      transaction.keep();
      continue;
    }
    bad.insert(bad.end(), crossing.begin(), crossing.end());
    std::sort(bad.begin(), bad.end());
    const std::size_t before = failed.size();
    for(Vertex_index v : crossing)
      if(!simple.is_arrived[v])
        failed.insert({v, v});
    for(const Working_mesh::Edge& edge : merged)
      if(std::binary_search(bad.begin(), bad.end(), edge.second))
        failed.insert(edge);
    if(failed.size() == before)
      failed.insert(merged.begin(), merged.end());
    transaction.roll_back();
    s.result = result;
    s.restore(simple);
    s.moves.forget_elements();
    s.update_boundary();
  }
  return true;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_MERGE_UNARRIVED_VERTICES_H
