// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The main pass: moves and flips alternate, edges are bisected, and places that are too far draw the
// boundary.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_IMPROVE_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_IMPROVE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/fitting/Fitting_state.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/bisect_boundary.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/retreat.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The state with most vertices on the surface, and then with the least distance, of those that were noted.
template <class Quality>
class Closest_state
{
  using Key = std::pair<std::size_t, double>; // number of vertices underway, largest distance

  Fitting_state<Quality>& m_state;
  std::optional<std::pair<Key, typename Fitting_state<Quality>::Snapshot>> m_closest;
  Key m_last;

public:
  explicit Closest_state(Fitting_state<Quality>& state) : m_state(state) {}

  /// Notes the state as it is. \pre distances have been measured
  void note()
  {
    m_last = {m_state.underway.size(), m_state.attraction.largest_distance()};
    if(!m_closest || m_last < m_closest->first)
      m_closest = {m_last, m_state.snapshot()};
  }

  /// Restores the closest state. \pre elements have not changed since the first one was noted
  void restore()
  {
    if(m_closest->first < m_last)
      m_state.restore(m_closest->second);
  }
};

/// Improves elements by moves and flips in turn, first all elements, then the worst ones.
/// \return whether the pass was not stopped
template <class Quality>
bool improve(Fitting_state<Quality>& s, const std::function<bool()>& go_on)
{
  using Criteria = Mixed_mesh_optimization_criteria_3;
  struct Phase
  {
    double power, least_cost_to_flip, weight; // weight of the attraction
  };
  constexpr Phase phases[2] = {{4, 1.2, 1}, {8, 1.4, 16}};
  // Of six meshes of 2,000 vertices, with half of the first phase the largest distance of a brain is larger
  // by 29 %, and the worst aspect-ratio coefficient of an elephant is 3.0 instead of 2.55; without a second
  // phase, that of a torus is 3.1 instead of 2.4, and its largest distance 1.9 times. Half or twice the
  // acceptable cost makes no difference on seven.
  constexpr double share_of_first_phase = 0.6;
  constexpr double acceptable = 10; // cost for vertices that arrive late

  const bool has_tolerance = s.criteria.tolerance() > 0 && !s.mode.is_without_attraction;
  const Criteria& criteria = s.criteria;
  const int rounds = (has_tolerance || s.features ? criteria : Criteria(criteria).tolerance(0))
                       .number_of_rounds();
  const int second_phase = int(share_of_first_phase * rounds + 0.5);
  // Many short rounds let boundary vertices follow the places that draw them.
  const bool has_many_rounds = rounds > 6;
  // The late bisections are of edges that are still far, a few in each round, as other places become the
  // farthest. If all are in one round, largest distances of 30 brains are larger by 4 %.
  const int first_bisection = s.mode.is_without_attraction ? second_phase : 0,
            first_late_bisection = s.mode.is_without_attraction ? second_phase : rounds / 4,
            last_late_bisection = s.mode.is_without_attraction || !has_many_rounds ? first_late_bisection
                                                                                   : 3 * rounds / 4;
  constexpr double power_of_late_bisections = 16; // the farthest edges, nearly; with 4, larger by 7 %
  const int rounds_to_flip = has_many_rounds ? 3 : 1;
  // Steps for better elements may lose what was near: the closest of the states since elements have last
  // changed is kept. With the last one instead, largest distances of 48 brains are larger by 4 %, one of them
  // by 57 %.
  const int last_change = (std::max)(last_late_bisection, (rounds - 1) / rounds_to_flip * rounds_to_flip);
  Closest_state<Quality> closest(s);
  typename Fitting_state<Quality>::Flipper flipper(s.mesh, s.quality, s.intermediate_bound());
  s.moves.set_bound((std::min)(s.acceptable_final_cost, s.intermediate_bound()));
  for(int round = 0; round < rounds; ++round) {
    if(!go_on())
      return false;
    const bool is_checked = round > 0 && round % rounds_to_flip == rounds_to_flip - 1; // first, after arrival
    if(is_checked && s.is_careful)
      undo_crossing(s);
    else if(is_checked && has_tolerance)
      s.save_points_if_simple();
    const int phase = round < second_phase ? 0 : 1;
    const auto [power, least_cost_to_flip, weight] = phases[phase];
    if(s.criteria.flips() && round % rounds_to_flip == 0)
      s.result.number_of_flips += s.flip(flipper, power, least_cost_to_flip);
    s.choose_new_targets();
    s.advance(acceptable);
    if(round == 0 || round == second_phase)
      s.moves.activate_all();
    if(has_tolerance) {
      s.attraction.measure();
      if(round > last_change)
        closest.note();
      s.moves.attract(s.attraction.attractions(weight));
    }
    s.moves.run(power, s.effort.good_enough[phase], has_many_rounds ? 3 : s.effort.sweeps[phase]);
    if(round == first_bisection)
      bisect_boundary(s);
    if(round >= first_late_bisection && round <= last_late_bisection) {
      const std::size_t rest = s.criteria.number_of_bisections() - s.result.number_of_bisections;
      bisect_far_edges(s, rest / std::size_t(last_late_bisection - round + 1), power_of_late_bisections);
    }
    ++s.result.number_of_rounds;
  }
  if(has_tolerance && rounds - 1 > last_change) {
    s.attraction.measure();
    closest.note();
    closest.restore();
  }
  return true;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_IMPROVE_H
