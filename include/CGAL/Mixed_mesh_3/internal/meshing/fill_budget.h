// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The octree is refined until its mesh has the vertices of the budget.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_FILL_BUDGET_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_FILL_BUDGET_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/meshing/Meshing_state.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Refinement_sequence.h>
#include <CGAL/Mixed_mesh_3/internal/octree/fill_vertex_budget.h>
#include <CGAL/Mixed_mesh_3/internal/surface/Sharp_features.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Takes uniform cells between planes of the surface, which need nothing more.
/// \return whether there are any
inline bool fill_lattice(Meshing_state& s)
{
  Located_octree octree = s.root;
  if(!s.lattice.is_uniform || !refine_to_level(octree, s.lattice.level, s.budget()))
    return false;
  Candidate candidate = s.try_octree(octree);
  const std::size_t n = candidate.number_of_vertices;
  if(n == 0 || n > s.criteria.maximal_number_of_vertices() || !candidate.is_manifold())
    return false;
  s.take(std::move(octree), std::move(candidate));
  s.result.base_level = s.lattice.level;
  s.result.number_of_vertices_needed = n;
  return s.result.is_lattice_on_surface = true;
}

/// Points that are split for first where there is no region, at a distance of half the edges that the budget
/// allows, or less.
inline std::vector<Located_octree::Point_3> points_on_sharp_edges(const Meshing_state& s)
{
  std::vector<Located_octree::Point_3> points;
  if(!s.root.is_region_everywhere())
    return points;
  const Sharp_edges edges = s.root.domain().sharp_edges(s.criteria.sharp_angle());
  if(edges.edges.empty())
    return points;
  const double size = s.mean_edge();
  const Sharp_features features(edges, size);
  for(const Feature_polyline& p : features.polylines()) {
    const int n = int(std::ceil(2 * p.length() / size));
    for(int i = 0; i <= n; ++i) {
      const Vec3 q = p.at(p.length() * i / n);
      points.emplace_back(q[0], q[1], q[2]);
    }
  }
  return points;
}

/// Cells that are split for fidelity that nobody asked for may take vertices from the region, but not a
/// level of its surface, where displacements are prescribed: at 2,000 vertices, that can cost half of the
/// accuracy.
/// \return the start with that level, and as many of those cells as there is room for; if it is needed
inline std::optional<Located_octree>
octree_for_region_first(const Meshing_state& s, const Located_octree& base, const Located_octree& filled)
{
  constexpr double shares[] = {1, 0.5, 0.25, 0.125, 0};
  constexpr double usable_share_of_cells = 0.97; // in cells, whose vertices are not counted yet
  if(!is_tolerance_wished(s.criteria) || !s.tolerance_search.has_far_points() || s.root.is_region_everywhere()
     || s.root.domain().subdomain_indices().size() > 1)
    return std::nullopt;
  const std::size_t number_of_cells = filled.number_of_cells();
  Refinement_sequence sequence(base, s.graded_radius());
  while(sequence.number_of_cells(sequence.number_of_steps()) < number_of_cells && sequence.extend()) {
  }
  std::size_t low = 0, high = sequence.number_of_steps();
  const auto level_after = [&](std::size_t steps) {
    return sequence.octree(steps).level_of_surface_in_region();
  };
  const int level = level_after(high);
  if(level <= filled.level_of_surface_in_region())
    return std::nullopt;
  while(low < high) {
    const std::size_t middle = low + (high - low) / 2;
    if(level_after(middle) < level)
      low = middle + 1;
    else
      high = middle;
  }
  const Located_octree start = sequence.octree(low);
  Located_octree octree = start;
  for(const double share : shares) {
    Located_octree far = base;
    s.tolerance_search.split_far_cells(far, share);
    octree = start;
    octree.refine_like(far);
    if(double(octree.number_of_cells()) < usable_share_of_cells * double(number_of_cells))
      break;
  }
  return octree;
}

/// Refines an octree until the budget is full, from a base level, or from where narrow places are resolved.
/// \param octree with nothing but its root; the one of the candidate then
inline Candidate fill_from(Meshing_state& s, int level, Located_octree& octree)
{
  const auto first_to_split = points_on_sharp_edges(s);
  const auto fill = [&](Located_octree& o) {
    return fill_vertex_budget(
      o, s.octree_budget(), s.graded_radius(),
      [&s](const Located_octree& tried) { return s.try_octree(tried); }, first_to_split);
  };
  if(s.start) {
    octree = *s.start;
    return fill(octree);
  }
  Candidate candidate;
  if(!refine_to_level(octree, level, s.octree_budget())) {
    candidate.number_of_vertices = 8 * octree.number_of_cells_inside();
    return candidate;
  }
  const Located_octree base = octree;
  s.tolerance_search.split_far_cells(octree);
  candidate = fill(octree);
  std::optional<Located_octree> other = octree_for_region_first(s, base, octree);
  if(!other)
    return candidate;
  Candidate other_candidate = fill(*other);
  if(other_candidate.is_stopped || !other_candidate.is_manifold()
     || other_candidate.number_of_vertices > s.octree_budget())
    return candidate;
  octree = std::move(*other);
  return other_candidate;
}

/// Refines the octree until the budget is full. If no base level is given, it is coarser than the default if
/// the budget demands it, and finer, as far as the budget allows, if much of a thin domain would have no
/// elements.
inline void fill_budget(Meshing_state& s)
{
  const bool is_automatic = s.criteria.base_level() == Mixed_mesh_criteria_3::automatic && !s.start;
  const int coarsest = (std::max)(coarsest_automatic_base_level, s.lattice.level);
  int level = s.coarsest_level();
  for(int step = 0;; level += step) {
    Located_octree octree = s.root;
    Candidate candidate = fill_from(s, level, octree);
    const bool is_above = candidate.number_of_vertices
                          > s.criteria.maximal_number_of_vertices() + s.number_beyond_budget;
    if(is_above && step > 0)
      return; // the coarser one, which fits, stays
    if(candidate.is_stopped && candidate.number_of_vertices == 0) {
      s.best.is_stopped = true; // so does that one, if there is one
      return;
    }
    s.take(std::move(octree), std::move(candidate));
    // without vertices, the last level that had too many tells more
    if(s.best.number_of_vertices != 0 || s.result.number_of_vertices_needed == 0) {
      s.result.base_level = level;
      s.result.number_of_vertices_needed = s.best.number_of_vertices;
    }
    const bool is_too_coarse = s.best.number_of_vertices == 0
                               || double(s.lost.size())
                                    > tolerated_share_of_lost_cells * double(s.result.number_of_cells);
    if(s.best.is_stopped)
      return;
    if(is_automatic && is_above && level > coarsest)
      step = -1;
    else if(is_automatic && !is_above && step >= 0 && is_too_coarse && level < finest_automatic_base_level)
      step = 1;
    else
      return;
  }
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_FILL_BUDGET_H
