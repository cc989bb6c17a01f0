// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The octree of a vertex budget (section 5.1 of the paper): refined in the region of interest only,
// the last level partially, so that the *final* mesh just fits.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_OCTREE_REFINE_IN_REGION_H
#define CGAL_MIXED_MESH_3_INTERNAL_OCTREE_REFINE_IN_REGION_H

#include <CGAL/Mixed_mesh_3/internal/octree/Octree.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

template <class Octree_, class Try>
class Budget_search
{
  using Node_index = Octree::Node_index;
  using Candidate = decltype(std::declval<const Try&>()(std::declval<const Octree_&>()));

  // A budget filled to 99.8 % is full enough while large steps are tried: with millions of vertices a
  // further trial costs more than it brings. Below 98 % single cells are tried.
  static constexpr double full_enough = 0.998, worth_single_cells = 0.98;
  static constexpr std::size_t single_cells_per_level = 12;
  static constexpr std::size_t far_above_budget = 1000000;

  const std::size_t m_budget;
  const Try& m_try;
  Octree_& m_octree;
  Candidate m_best;
  double m_vertices_per_cell = 8; // 7 deep inside, more at transitions; then the rate of the last trial

public:
  template <class Refine_base>
  Budget_search(Octree_& octree, std::size_t budget, int base_level, const Refine_base& refine_base,
                const Try& try_octree)
    : m_budget(budget), m_try(try_octree), m_octree(octree)
  {
    for(int level = 0; level < base_level; ++level) {
      // Cells inside have their smallest corners inside, and eight children each: a lower bound. Far
      // above the budget, the mesh is not made.
      if(8 * m_octree.number_of_cells_inside() > (std::max)(m_budget, far_above_budget)) {
        m_best.number_of_vertices = 8 * m_octree.number_of_cells_inside();
        return;
      }
      m_octree.refine(m_octree.leaves_to_refine(level, false));
    }
    refine_base(m_octree);
    m_best = m_try(m_octree);
    if(m_octree.leaves_to_refine(base_level, true).empty())
      return; // the region does not meet the domain
    int level = base_level;
    while(level < Octree::max_level && refine_level(level))
      ++level;
    for(level = (std::min)(level, Octree::max_level - 1); level >= base_level; --level)
      add_single_cells(level);
  }

  Candidate best() && { return std::move(m_best); }

private:
  std::size_t size() const { return m_best.number_of_vertices; }
  bool is_done() const { return m_best.is_stopped || size() >= m_budget; }

  // Tries an octree; takes it over if it fits (or the user stops).
  std::size_t attempt(Octree_& trial)
  {
    Candidate candidate = m_try(trial);
    const std::size_t n = candidate.number_of_vertices;
    if(!candidate.is_stopped && !candidate.is_manifold() && m_best.is_manifold())
      return m_budget + 1; // rare: another number of cells will do
    if(candidate.is_stopped || n <= m_budget) {
      m_octree = std::move(trial);
      m_best = std::move(candidate);
    }
    return n;
  }

  // Refines the leaves of a level that are in the region, the region's core first, as many as the
  // budget allows; returns whether it allows all, so that the next level may follow.
  bool refine_level(int level)
  {
    const Octree_ coarse = m_octree;
    std::vector<Node_index> leaves = coarse.leaves_to_refine(level, true);
    if(leaves.empty() || is_done())
      return false;
    // low leaves fit, high do not (or there are not that many)
    const std::size_t n_coarse = size();
    std::size_t low = 0, high = leaves.size() + 1, n_high = 0;
    bool is_sorted = false;
    for(int step = 0; high - low > 1 && !is_done(); ++step) {
      if(low > 0 && double(size()) > full_enough * double(m_budget))
        break;
      // by the rate of the last trial, by the secant, and by bisection where that is slow
      const double rate = n_high > 0 ? double(n_high - size()) / double(high - low) : m_vertices_per_cell;
      const double secant = (std::max)(1., double(m_budget - size()) / rate);
      const std::size_t k = step > 2 && step % 2 == 1 && n_high > 0 ? low + (high - low) / 2
                                                                    : low + std::size_t(secant);
      const std::size_t refined = (std::min)(k, high - 1);
      if(refined < leaves.size() && !is_sorted) { // while all are refined, the order is the same
        coarse.sort_by_depth(leaves);
        is_sorted = true;
      }
      Octree_ trial = coarse;
      trial.refine(std::vector<Node_index>(leaves.begin(), leaves.begin() + std::ptrdiff_t(refined)));
      const std::size_t n = attempt(trial);
      m_vertices_per_cell = (std::max)(1., double(n) - double(n_coarse)) / double(refined);
      if(n <= m_budget) {
        low = refined;
      } else {
        high = refined;
        n_high = n;
      }
    }
    return low == leaves.size() && !is_done();
  }

  // Where one more cell in order would exceed a small budget, others may fit: those left in the region,
  // then coarser ones around it, nearest first.
  void add_single_cells(int level)
  {
    std::vector<Node_index> leaves = m_octree.leaves_to_refine(level, false);
    m_octree.sort_by_depth(leaves);
    leaves.resize((std::min)(leaves.size(), single_cells_per_level));
    for(Node_index n : leaves) {
      if(is_done() || double(size()) > worth_single_cells * double(m_budget))
        return;
      if(!m_octree.octree().is_leaf(n))
        continue;
      Octree_ trial = m_octree;
      trial.refine(std::vector<Node_index>{n});
      attempt(trial);
    }
  }
};

/*!
Finds the finest octree whose mesh fits the budget.

A candidate is an octree with the mesh made of it. `Candidate::number_of_vertices` is what is bounded;
`Candidate::is_stopped` tells that the user wants to stop.

\param octree the located octree, not yet refined; becomes that of the result
\param base_level the level of all cells that meet the domain
\param refine_base `void(octree)`: refines cells, in the region or not, before the region is
\param try_octree `Candidate(octree)`: runs all stages that change the number of vertices
\return the best candidate; its number of vertices is above the budget only if the base level is
\cost O(log n) trials of at most a little more than n vertices; two for large n
*/
template <class Octree_, class Refine_base, class Try>
auto refine_in_region(Octree_& octree, std::size_t budget, int base_level, const Refine_base& refine_base,
                      const Try& try_octree)
{
  return Budget_search<Octree_, Try>(octree, budget, base_level, refine_base, try_octree).best();
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_OCTREE_REFINE_IN_REGION_H
