// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_LINEAR_ELASTICITY_3_INTERNAL_ADAPT_POINTS_IMPL_H
#define CGAL_LINEAR_ELASTICITY_3_INTERNAL_ADAPT_POINTS_IMPL_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <CGAL/Linear_elasticity_3/internal/Bounded_moves.h>
#include <CGAL/Linear_elasticity_3/internal/Load_cases.h>
#include <CGAL/Linear_elasticity_3/internal/adapt_points.h>
#include <CGAL/Linear_elasticity_3/internal/configurational_forces.h>
#include <CGAL/Linear_elasticity_3/internal/guard_loads.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

CGAL_LINEAR_ELASTICITY_3_INLINE std::vector<bool>
inner_vertices(const Element_list& elements, const std::vector<Element_attributes>& attributes,
               const std::vector<Elastic_material>& materials, std::size_t number_of_vertices)
{
  const auto material = [&](Element_index e) {
    const Elastic_material& m = material_of(materials, e);
    return std::make_tuple(m.young_modulus, m.poisson_ratio);
  };
  std::vector<bool> is_inner(number_of_vertices, false);
  constexpr std::size_t none = std::size_t(-1);
  std::vector<std::size_t> first(number_of_vertices, none), first_of_compartment(number_of_vertices, none);
  for(Element_index e = 0; e < elements.size(); ++e)
    for(Vertex_index v : elements[e]) {
      if(first[v] == none) {
        first[v] = e;
        is_inner[v] = true;
      }
      const Element_index f = Element_index(first[v]);
      if(attributes[e].subdomain_index != attributes[f].subdomain_index || material(e) != material(f))
        is_inner[v] = false;
      if(attributes[e].compartment == 0)
        continue;
      if(first_of_compartment[v] == none)
        first_of_compartment[v] = e;
      if(are_beside_sheet(attributes[e], attributes[first_of_compartment[v]]))
        is_inner[v] = false;
    }
  const std::vector<bool> is_on_boundary = boundary_flags(elements, number_of_vertices);
  for(std::size_t v = 0; v < number_of_vertices; ++v)
    is_inner[v] = is_inner[v] && !is_on_boundary[v];
  return is_inner;
}

/// The state of the adaptation: points, and the functional there: the mean over the load cases of the energy
/// divided by that at first, and a multiple of the same mean over the guard loads.
class Mesh_adaptation
{
  using Result = Mixed_mesh_adaptation_result_3;
  using Status = Mixed_mesh_adaptation_status;

  // The length of a step and of a move, relative to the size of the elements around: so no unit matters. From
  // the first step, nine failures in a row lead below the least one, eleven successes to the largest one. If
  // both ends of an edge make the largest move towards each other, 0.7 of the edge is left.
  static constexpr double first_step = 0.3, largest_step = 2, least_step = 1e-3, growth = 1.2,
                          shrinking = 0.5, largest_move = 0.15;
  // Below it a gain is one of rounding, relative to the functional: a million roundings of 2^-53.
  static constexpr double least_predicted_gain = 1e-10;
  // Energy of rounding, relative to that of a strain of the size of the displacements over the mesh: a strain
  // of 1e-10, squared.
  static constexpr double no_energy = 1e-20;

  const Element_list& m_elements;
  const std::vector<Elastic_material>& m_materials;
  std::vector<Vec3>& m_points;
  const std::vector<bool>& m_is_movable;
  const std::size_t m_number_of_cases; // the first ones; the others are guard loads
  const double m_guard_weight;
  const std::vector<Prescribed_displacements>& m_loads;
  Load_cases m_solutions;
  Bounded_moves m_moves;
  std::vector<Mesh_energy> m_energies; // of the loads
  std::vector<double> m_weights;       // of the energies in the functional
  double m_functional = 1;
  Result m_result;

public:
  Mesh_adaptation(const Element_list& elements, std::vector<Vec3>& points,
                  const std::vector<Elastic_material>& materials, const std::vector<bool>& is_movable,
                  const std::vector<Prescribed_displacements>& loads, std::size_t number_of_cases,
                  const Mixed_mesh_adaptation_criteria_3& criteria, const Make_elasticity_solver& make_solver)
    : m_elements(elements), m_materials(materials), m_points(points), m_is_movable(is_movable),
      m_number_of_cases(number_of_cases), m_guard_weight(criteria.guard_weight()), m_loads(loads),
      m_solutions(elements, points.size(), materials, m_loads, make_solver),
      m_moves(elements, points, criteria.quality_bound())
  {
  }

  Result operator()(const Mixed_mesh_adaptation_criteria_3& criteria, const std::function<bool()>& go_on)
  {
    m_result.number_of_inner_vertices = std::size_t(
      std::count(m_is_movable.begin(), m_is_movable.end(), true));
    m_result.status = start();
    if(m_result.status == Status::CONVERGED)
      m_result.status = descend(criteria, go_on);
    keep_energies(m_result.energies_after, m_result.guard_energies_after);
    m_result.functional = part(m_energies, 0, m_number_of_cases);
    m_result.worst_aspect_ratio_after = m_moves.worst_aspect_ratio(m_points);
    return m_result;
  }

private:
  void keep_energies(std::vector<double>& of_cases, std::vector<double>& of_guards) const
  {
    for(std::size_t i = 0; i < m_energies.size(); ++i)
      (i < m_number_of_cases ? of_cases : of_guards).push_back(m_energies[i].energy);
  }

  // The part of the functional that some of the loads have.
  double part(const std::vector<Mesh_energy>& energies, std::size_t begin, std::size_t end) const
  {
    double sum = 0;
    for(std::size_t i = begin; i < (std::min)(end, m_weights.size()); ++i)
      sum += m_weights[i] * energies[i].energy;
    return sum;
  }

  // Sets the weights of the loads from `begin` to `end` whose energy is more than rounding, so that their
  // part of the functional is `total` now, and returns the number of these loads.
  std::size_t weigh(std::size_t begin, std::size_t end, double total)
  {
    double stiffness = 0;
    for(const Elastic_material& m : m_materials)
      stiffness = (std::max)(stiffness, m.young_modulus);
    std::size_t number_of_loads = 0;
    for(std::size_t i = begin; i < end; ++i) {
      double largest = 0;
      for(const auto& [v, u] : m_loads[i])
        largest = (std::max)(largest, norm(u));
      const bool is_load = m_energies[i].energy > no_energy * stiffness * largest * largest * extent();
      m_weights.push_back(is_load ? total / m_energies[i].energy : 0);
      number_of_loads += is_load;
    }
    for(std::size_t i = begin; i < end; ++i)
      m_weights[i] /= double((std::max)(number_of_loads, std::size_t(1)));
    return number_of_loads;
  }

  // Solves on the mesh as it is.
  Status start()
  {
    for(Element_index e = 0; e < m_elements.size(); ++e)
      if(!m_moves.is_positive(e, m_points))
        return Status::INVALID_MESH;
    m_result.worst_aspect_ratio_before = m_moves.worst_aspect_ratio(m_points);
    if(m_result.number_of_inner_vertices == 0)
      return Status::NO_INNER_VERTEX;
    m_energies = m_solutions.solve(m_points);
    ++m_result.number_of_solves;
    if(m_energies.size() != m_loads.size())
      return Status::SOLVER_FAILED;
    keep_energies(m_result.energies_before, m_result.guard_energies_before);
    const std::size_t number_of_loads = weigh(0, m_number_of_cases, 1);
    weigh(m_number_of_cases, m_loads.size(), m_guard_weight);
    return number_of_loads == 0 ? Status::NO_LOAD : Status::CONVERGED;
  }

  // The longest side of the box of the points.
  double extent() const
  {
    double longest = 0;
    for(int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax_element(m_points.begin(), m_points.end(),
                                                   [k](const Vec3& p, const Vec3& q) { return p[k] < q[k]; });
      longest = (std::max)(longest, (*high)[k] - (*low)[k]);
    }
    return longest;
  }

  // Of each vertex, the shortest distance to another one of its elements.
  std::vector<double> sizes() const
  {
    std::vector<double> result(m_points.size(), std::numeric_limits<double>::infinity());
    for(Element_index e = 0; e < m_elements.size(); ++e)
      for(Vertex_index v : m_elements[e])
        for(Vertex_index w : m_elements[e])
          if(v < w) {
            const double distance = norm(m_points[v] - m_points[w]);
            result[v] = (std::min)(result[v], distance);
            result[w] = (std::min)(result[w], distance);
          }
    return result;
  }

  // Moves along configurational forces, and what they gain to first order.
  std::pair<std::vector<Vec3>, double> wanted_moves(double step) const
  {
    std::vector<Vec3> gradient(m_points.size(), Vec3{}), moves(m_points.size(), Vec3{});
    std::vector<double> of_stars(m_points.size(), 0);
    for(std::size_t i = 0; i < m_energies.size(); ++i)
      for(std::size_t v = 0; v < m_points.size(); ++v) {
        gradient[v] = gradient[v] + m_weights[i] * m_energies[i].by_positions[v];
        of_stars[v] += m_weights[i] * m_energies[i].of_stars[v];
      }
    // The mean energy of a star: where there is less, there is little to gain, and moves would be noise for
    // other loads. Without it, errors of smooth loads increased by up to 40 % in a deep tumor.
    const double mean = std::accumulate(of_stars.begin(), of_stars.end(), 0.) / double(of_stars.size());
    const std::vector<double> size = sizes();
    double gain = 0;
    for(std::size_t v = 0; v < m_points.size(); ++v)
      if(m_is_movable[v]) {
        const Vec3 move = (-step * size[v] * size[v] / (of_stars[v] + mean)) * gradient[v];
        const double length = norm(move), most = largest_move * size[v];
        moves[v] = length > most ? (most / length) * move : move;
        gain -= dot(gradient[v], moves[v]);
      }
    return {std::move(moves), gain};
  }

  Status descend(const Mixed_mesh_adaptation_criteria_3& criteria, const std::function<bool()>& go_on)
  {
    constexpr int largest_number_of_idle_steps = 3; // in a row: after two failures, a quarter of the step
    double step = first_step;
    double total_gain = 0;
    m_functional = part(m_energies, 0, m_loads.size());
    for(int idle = 0; idle < largest_number_of_idle_steps && step >= least_step;) {
      const auto [moves, predicted_gain] = wanted_moves(step);
      if(!(predicted_gain > least_predicted_gain * m_functional))
        break;
      if(m_result.number_of_solves == criteria.maximal_number_of_solves())
        return Status::SOLVES_EXHAUSTED;
      if(!go_on())
        return Status::STOPPED;
      const double gain = take_step(m_moves.moved(m_points, moves));
      step = gain > 0 ? (std::min)(growth * step, largest_step) : shrinking * step;
      total_gain += gain;
      idle = gain < criteria.least_gain() * total_gain ? idle + 1 : 0;
    }
    return Status::CONVERGED;
  }

  // Whether load cases have less energy than now, and no guard load more than at first. The weight of a guard
  // load that would have more is doubled: later steps lower its energy, too.
  bool is_guarded(const std::vector<Mesh_energy>& energies)
  {
    const double of_cases = part(m_energies, 0, m_number_of_cases);
    if(!(of_cases - part(energies, 0, m_number_of_cases) > least_predicted_gain * of_cases))
      return false;
    bool is_good = true;
    for(std::size_t i = m_number_of_cases; i < m_loads.size(); ++i)
      if(m_weights[i] > 0 && energies[i].energy > m_result.guard_energies_before[i - m_number_of_cases]) {
        m_functional += m_weights[i] * m_energies[i].energy;
        m_weights[i] *= 2;
        is_good = false;
      }
    return is_good;
  }

  // Takes the step if it lowers the functional and is guarded, and returns by how much it lowers it.
  double take_step(std::vector<Vec3> points)
  {
    if(points == m_points)
      return 0;
    std::vector<Mesh_energy> energies = m_solutions.solve(points);
    ++m_result.number_of_solves;
    if(energies.empty())
      return 0;
    const double value = part(energies, 0, m_loads.size()), gain = m_functional - value;
    if(!is_guarded(energies) || !(gain > 0))
      return 0;
    m_points = std::move(points);
    m_energies = std::move(energies);
    m_functional = value;
    ++m_result.number_of_steps;
    return gain;
  }
};

CGAL_LINEAR_ELASTICITY_3_INLINE Mixed_mesh_adaptation_result_3 adapt_points(
  const Element_list& elements, std::vector<Vec3>& points, const std::vector<Elastic_material>& materials,
  std::vector<bool> is_movable, const std::vector<Prescribed_displacements>& cases,
  const Mixed_mesh_adaptation_criteria_3& criteria,
  const std::function<std::unique_ptr<Elasticity_solver>()>& make_solver, const std::function<bool()>& go_on)
{
  if(elements.empty())
    return {};
  for(const Prescribed_displacements& displacements : cases)
    for(const auto& one : displacements)
      is_movable[one.first] = false;
  const std::vector<bool> is_on_boundary = boundary_flags(elements, points.size());
  const std::vector<bool> is_at_border = vertices_at_borders(elements, is_on_boundary, cases);
  for(std::size_t v = 0; v < points.size(); ++v)
    is_movable[v] = is_movable[v] && !is_at_border[v];
  std::vector<Prescribed_displacements> loads = cases;
  if(criteria.guard_weight() > 0) {
    const std::vector<Prescribed_displacements> guards = guard_loads(points, is_on_boundary, cases);
    loads.insert(loads.end(), guards.begin(), guards.end());
  }
  return Mesh_adaptation(elements, points, materials, is_movable, loads, cases.size(), criteria,
                         make_solver)(criteria, go_on);
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_INTERNAL_ADAPT_POINTS_IMPL_H
