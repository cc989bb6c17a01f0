// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The octree of a vertex budget (section 5.1 of the paper): refined in the region of interest only,
// the last level partially, so that the *final* mesh just fits.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_REFINE_IN_REGION_H
#define CGAL_MIXED_MESH_3_INTERNAL_REFINE_IN_REGION_H

#include <CGAL/Mixed_mesh_3/internal/Octree.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
Finds the finest octree whose mesh fits the budget.

A candidate is an octree with the mesh made of it. `Candidate::number_of_vertices` is what is bounded;
`Candidate::is_stopped` tells that the user wants to stop.

\param octree the located octree, not yet refined; becomes that of the result
\param base_level the level of all cells that meet the domain
\param try_octree `Candidate(octree)`: runs all stages that change the number of vertices
\return the best candidate; its number of vertices is above the budget only if the base level is
*/
template <class Octree_, class Try>
auto refine_in_region(Octree_& octree, std::size_t budget, int base_level, const Try& try_octree)
{
  using Candidate = decltype(try_octree(octree));
  for(int level = 0; level < base_level; ++level)
    octree.refine(octree.leaves_to_refine(level, false));
  Candidate best = try_octree(octree);

  // Refining a cell gives 7 new vertices deep inside, more at transitions.
  double vertices_per_cell = 8;
  for(int level = base_level; level < Octree::max_level && !best.is_stopped; ++level) {
    std::vector<Octree::Node_index> leaves = octree.leaves_to_refine(level, true);
    if(leaves.empty() || best.number_of_vertices >= budget)
      break;
    // low leaves fit the budget, high do not (or there are not that many)
    const std::size_t n_coarse = best.number_of_vertices;
    std::size_t low = 0, high = leaves.size() + 1, n_low = n_coarse, n_high = 0;
    bool is_sorted = false;
    Octree_ finest = octree;
    for(int step = 0; high - low > 1; ++step) {
      const double missing = double(budget - n_low);
      if(low > 0 && missing < 0.002 * double(budget))
        break; // full enough: for large budgets a further trial costs more than it brings
      // by the rate of the last trial, by the secant, and by bisection where that is slow
      const double rate = n_high > 0 ? double(n_high - n_low) / double(high - low) : vertices_per_cell;
      const std::size_t k = step > 2 && step % 2 == 1 && n_high > 0
                              ? low + (high - low) / 2
                              : low + std::size_t((std::max)(1., missing / rate));
      const std::size_t refined = (std::min)(k, high - 1);
      if(refined < leaves.size() && !is_sorted) {
        octree.sort_by_depth(leaves);
        is_sorted = true;
      }
      Octree_ trial = octree;
      trial.refine(std::vector<Octree::Node_index>(leaves.begin(),
                                                   leaves.begin() + std::ptrdiff_t(refined)));
      Candidate candidate = try_octree(trial);
      if(candidate.is_stopped)
        return candidate;
      const std::size_t n = candidate.number_of_vertices;
      vertices_per_cell = (std::max)(1., double(n) - double(n_coarse)) / double(refined);
      if(n <= budget) {
        low = refined;
        n_low = n;
        finest = std::move(trial);
        best = std::move(candidate);
      } else {
        high = refined;
        n_high = n;
      }
    }
    octree = std::move(finest);
    if(low < leaves.size())
      break;
  }
  return best;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_REFINE_IN_REGION_H
