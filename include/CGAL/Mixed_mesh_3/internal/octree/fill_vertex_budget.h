// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The octree of a vertex budget (section 5.1 of the paper): as many splits of the sequence as the *final*
// mesh has room for.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_OCTREE_FILL_VERTEX_BUDGET_H
#define CGAL_MIXED_MESH_3_INTERNAL_OCTREE_FILL_VERTEX_BUDGET_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/octree/Refinement_sequence.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

template <class Try>
class Budget_search
{
  using Candidate = decltype(std::declval<const Try&>()(std::declval<const Located_octree&>()));

  // Shares of the budget: at 99.8 % large steps end, because with millions of vertices a further trial costs
  // more than it gains. Below 99 % single cells are tried.
  static constexpr double share_that_is_full = 0.998, share_for_single_cells = 0.99;
  // Number of vertices between a full budget and the whole one from which on the search aims at their middle:
  // trials of the whole budget miss it by a few vertices, on either side. It is the range of a budget of
  // 50,000.
  static constexpr double wide_range = 100;
  static constexpr std::size_t number_of_single_cells = 24;

  // Limit of the number of cells. Cells that meet the domain have one vertex or more each, unless the domain
  // is thinner than a cell: along a spike any number of cells may have no vertices. If the limit does not
  // fill the budget, more cells will not fill the budget either.
  static constexpr double most_cells_per_vertex = 8, most_cells_at_least = 1000;

  const std::size_t m_budget;
  const double m_goal; // number of vertices that trials aim at
  const Try& m_try;
  Refinement_sequence m_sequence;
  Located_octree m_octree;
  Candidate m_best;
  std::size_t m_steps = 0; // steps of the best candidate

public:
  Budget_search(const Located_octree& start, std::size_t budget, double radius, const Try& try_octree,
                std::vector<Refinement_sequence::Point> points)
    : m_budget(budget), m_goal(goal_for(double(budget))), m_try(try_octree),
      m_sequence(start, radius, std::move(points)), m_octree(start), m_best(m_try(start))
  {
    search();
    add_single_cells();
  }

  std::pair<Located_octree, Candidate> best() && { return {std::move(m_octree), std::move(m_best)}; }

private:
  static double goal_for(double budget)
  {
    const double range = (1 - share_that_is_full) * budget;
    return range < wide_range ? budget : budget - range / 2;
  }

  std::size_t size() const { return m_best.number_of_vertices; }
  bool is_done() const { return m_best.is_stopped || size() >= m_budget; }

  // Tries an octree and takes it over if its mesh fits.
  std::size_t attempt(Located_octree trial)
  {
    Candidate candidate = m_try(trial);
    const std::size_t n = candidate.number_of_vertices;
    if(candidate.is_stopped) {
      m_best.is_stopped = true;
      return m_budget + 1;
    }
    if(!candidate.is_manifold() && m_best.is_manifold())
      return m_budget + 1; // rare: another number of cells succeeds
    if(n <= m_budget) {
      m_octree = std::move(trial);
      m_best = std::move(candidate);
    }
    return n;
  }

  bool extend()
  {
    const double cells = double(m_sequence.number_of_cells(m_sequence.number_of_steps()));
    return cells < most_cells_per_vertex * double(m_budget) + most_cells_at_least && m_sequence.extend();
  }

  // The first step with that number of cells.
  std::size_t steps_for(double cells)
  {
    while(double(m_sequence.number_of_cells(m_sequence.number_of_steps())) < cells && extend()) {
    }
    return m_sequence.first_step_with(cells);
  }

  // Extends the sequence as far as needed, unless there is nothing to split, or there are too many cells.
  std::size_t available(std::size_t steps)
  {
    while(m_sequence.number_of_steps() < steps && extend()) {
    }
    return (std::min)(steps, m_sequence.number_of_steps());
  }

  // Searches the number of steps. The number of vertices grows with the number of cells, nearly at a fixed
  // rate. `low` steps fit; `high` steps do not fit, or are not known to fit.
  void search()
  {
    constexpr std::size_t unknown = std::size_t(-1);
    std::size_t high = unknown, n_high = 0;
    double rate = 1.25; // vertices per cell, deep inside and at the surface
    for(int step = 0; high - m_steps > 1 && !is_done(); ++step) {
      if(m_steps > 0 && double(size()) > share_that_is_full * double(m_budget))
        return;
      const std::size_t low = m_steps, n_low = size();
      const double cells = double(m_sequence.number_of_cells(low));
      if(high != unknown)
        rate = double(n_high - n_low) / (std::max)(1., double(m_sequence.number_of_cells(high)) - cells);
      // Halving ends a search that the rate leads astray. A wide range is met at once or nearly.
      const bool is_slow = step > (m_goal < double(m_budget) ? 4 : 2) && step % 2 == 1 && high != unknown;
      const std::size_t wanted = is_slow ? low + (high - low) / 2
                                         : steps_for(cells + (m_goal - double(n_low)) / rate);
      const std::size_t steps = available((std::min)((std::max)(wanted, low + 1), high - 1));
      if(steps <= low)
        return; // there is nothing left to split, or too many cells
      const std::size_t n = attempt(m_sequence.octree(steps));
      if(n <= m_budget) {
        m_steps = steps;
        rate = (std::max)(0.5,
                          (double(n) - double(n_low)) / (double(m_sequence.number_of_cells(steps)) - cells));
      } else {
        high = steps;
        n_high = n;
      }
    }
  }

  // Splits single cells: where the next cell in order would exceed a small budget, other cells may fit.
  void add_single_cells()
  {
    const std::size_t last = available(m_steps + number_of_single_cells);
    for(std::size_t i = m_steps; i < last; ++i) {
      if(is_done() || double(size()) > share_for_single_cells * double(m_budget))
        return;
      const Octree::Node_index n = m_sequence.cell(i);
      if(n >= m_sequence.number_of_nodes(m_steps) || !m_octree.octree().is_leaf(n))
        continue;
      Located_octree trial = m_octree;
      trial.refine(std::vector<Octree::Node_index>{n});
      attempt(std::move(trial));
    }
  }
};

/*!
Finds the finest octree of a sequence whose mesh fits the budget.

A candidate is an octree with the mesh made of the octree. `Candidate::number_of_vertices` is what is bounded;
`Candidate::is_stopped` tells that the user wants to stop: the result is then the best candidate before, and
has `is_stopped` set too.

\param octree the located octree to begin with; becomes the octree of the result
\param radius, points parameters of `Refinement_sequence`
\param try_octree `Candidate(octree)`: runs all stages that change the number of vertices
\return the best candidate; its number of vertices is above the budget only if that of the start is above, too
\par Complexity
O(log n) trials of at most a little more than n vertices; two for large n
*/
template <class Try>
auto fill_vertex_budget(Located_octree& octree, std::size_t budget, double radius, const Try& try_octree,
                        std::vector<Refinement_sequence::Point> points = {})
{
  auto best = Budget_search<Try>(octree, budget, radius, try_octree, std::move(points)).best();
  octree = std::move(best.first);
  return std::move(best.second);
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_OCTREE_FILL_VERTEX_BUDGET_H
