// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Algorithm 1 of Lobos, Bucki, Hitschfeld, Payan: "Mixed-element mesh for an intra-operative modeling of the
// brain tumor extraction", section 5.4. Boundary vertices go to their targets step by step, an elastic medium
// moves the inner vertices; a step with elements of bad quality is repeated with these elements stiffened.
// Beyond the paper: a step that inverts an element is never accepted, but halved; if that does not suffice,
// the vertices that cause the inversion are held.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_RELAX_TO_SURFACE_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_RELAX_TO_SURFACE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/certificate.h>
#include <CGAL/Mixed_mesh_3/internal/fem/Elasticity_system.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/surface_targets.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/aspect_ratio.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_fit_criteria_3.h>
#include <CGAL/Mixed_mesh_fit_result_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The paper's measure of quality and its bound.
class Aspect_ratio_bound
{
  double m_acceptable;

public:
  explicit Aspect_ratio_bound(double acceptable) : m_acceptable(acceptable) {}
  double operator()(Element_kind kind, const std::array<Vec3, 8>& points) const
  {
    return aspect_ratio_coefficient(kind, points);
  }
  bool is_acceptable(double cost) const { return cost <= m_acceptable; }
};

/// The distance of each vertex, in elements, from the vertices of a set.
inline std::vector<int> layers_from(const std::vector<Vertex_index>& vertices, const Element_list& elements,
                                    std::size_t number_of_vertices)
{
  constexpr int none = Mixed_mesh_fit_criteria_3::all_layers;
  std::vector<int> layers(number_of_vertices, none);
  for(Vertex_index v : vertices)
    layers[v] = 0;
  std::vector<Element_index> pending(elements.size()), later;
  for(Element_index e = 0; e < elements.size(); ++e)
    pending[e] = e;
  for(int layer = 0; !pending.empty(); ++layer, pending.swap(later)) {
    later.clear();
    for(Element_index e : pending) {
      const Element_view element = elements[e];
      if(std::none_of(element.begin(), element.end(), [&](Vertex_index v) { return layers[v] == layer; })) {
        later.push_back(e);
        continue;
      }
      for(Vertex_index v : element)
        if(layers[v] == none)
          layers[v] = layer + 1;
    }
    if(later.size() == pending.size())
      break; // elements that are not connected with the set
  }
  return layers;
}

/*!
\tparam Solver a model of `SparseLinearAlgebraWithFactorTraits_d`
\tparam Quality a cost of elements: `double(Element_kind, std::array<Vec3, 8>)`, and `is_acceptable(cost)`
\tparam Go_on `bool()`, asked before each solve
*/
template <class Solver, class Quality, class Go_on>
class Surface_relaxation
{
  using Status = Mixed_mesh_fit_status;
  using Criteria = Mixed_mesh_fit_criteria_3;
  using Matrix = typename Matrix_of_solver<Solver>::type;

  enum class Outcome { ACCEPTED, INVERTED, FAILED, STOPPED };

  // A brain of 60,000 vertices takes 3.5 to 4.6 s, with all layers 5.0 to 5.2 s, for a mean aspect-ratio
  // coefficient of 1.534 instead of 1.538; with 8 layers it is 1.535, with 2 it is 1.542, in about as much
  // time as with 4. With 10,000 vertices, all layers take no longer.
  static constexpr std::size_t large_mesh = 3000; // vertices
  static constexpr int layers_of_large_mesh = 4;
  static constexpr int maximal_number_of_halvings = 4; // of one step: to 1/16 of the longest one

  const Element_list& m_elements;
  const Surface_targets& m_targets;
  const Criteria& m_criteria;
  const Quality& m_quality;
  Solver& m_solver;
  const Go_on& m_go_on;
  Elasticity_system m_system;
  typename Solver::Vector m_solution;                // last solution: the start of an iterative solver
  std::vector<Element_index> m_moving;               // elements with a vertex that may move
  std::vector<std::uint8_t> m_is_elastic;            // whether the system moves a vertex of each of these
  std::vector<double> m_sizes, m_stiffness, m_costs; // one value for each element
  std::vector<Vec3>& m_points;
  std::vector<Vec3> m_sources; // start of the vertex of each target
  std::vector<Vec3> m_candidate, m_displacements;
  std::vector<std::uint8_t> m_is_frozen; // one value for each target
  std::vector<Element_index> m_inverted; // elements inverted in the last candidate
  Mixed_mesh_fit_result_3 m_result;

public:
  /// Keeps all arguments by reference. \param points positions, which are changed
  Surface_relaxation(const Element_list& elements, const Surface_targets& targets, const Criteria& criteria,
                     const Quality& quality, Solver& solver, const Go_on& go_on, std::vector<Vec3>& points)
    : m_elements(elements), m_targets(targets), m_criteria(criteria), m_quality(quality), m_solver(solver),
      m_go_on(go_on), m_system(elements, free_vertices(elements, targets, criteria, points.size())),
      m_solution(std::size_t(m_system.number_of_unknowns())), m_sizes(elements.size(), 0),
      m_stiffness(elements.size(), 1), m_costs(elements.size(), 0), m_points(points), m_candidate(points),
      m_displacements(points.size(), Vec3{}), m_is_frozen(targets.vertices.size(), 0)
  {
    std::vector<std::uint8_t> is_free(points.size(), 0), is_moving(points.size(), 0);
    for(Vertex_index v : m_system.free_vertices())
      is_free[v] = is_moving[v] = 1;
    for(Vertex_index v : targets.vertices)
      is_moving[v] = 1;
    const auto has = [&](Element_index e, const std::vector<std::uint8_t>& mark) {
      return std::any_of(elements[e].begin(), elements[e].end(), [&](Vertex_index v) { return mark[v]; });
    };
    for(Element_index e = 0; e < elements.size(); ++e)
      if(has(e, is_moving)) {
        m_moving.push_back(e);
        m_is_elastic.push_back(has(e, is_free));
        m_sizes[e] = std::cbrt(volume(elements[e].kind(), element_points(e, points)));
        m_costs[e] = m_quality(elements[e].kind(), element_points(e, points));
      }
    for(Vertex_index v : targets.vertices)
      m_sources.push_back(points[v]);
    m_result.number_of_boundary_vertices = targets.vertices.size();
    m_result.number_of_folded_faces = targets.number_of_folded_faces;
  }

  /// Runs the relaxation. \pre no element is inverted; no element will be
  /// \param before result of earlier attempts, whose counts are continued
  Mixed_mesh_fit_result_3 operator()(const Mixed_mesh_fit_result_3& before)
  {
    m_result.number_of_solves = before.number_of_solves;
    m_result.number_of_halvings = before.number_of_halvings;
    const Outcome outcome = go_to_targets();
    if(outcome == Outcome::ACCEPTED)
      move_directly();
    const std::size_t arrived = number_arrived();
    m_result.number_of_arrived_vertices = arrived;
    for(Element_index e : m_moving)
      m_result.number_of_unacceptable_elements += !m_quality.is_acceptable(m_costs[e]);
    m_result.status = outcome == Outcome::STOPPED                     ? Status::STOPPED
                      : outcome == Outcome::FAILED                    ? Status::SOLVER_FAILED
                      : arrived != m_targets.vertices.size()          ? Status::NOT_ALL_ARRIVED
                      : m_result.number_of_unacceptable_elements != 0 ? Status::CAP_REACHED
                                                                      : Status::SUCCESS;
    return m_result;
  }

private:
  static std::vector<bool> free_vertices(const Element_list& elements, const Surface_targets& targets,
                                         const Criteria& criteria, std::size_t number_of_vertices)
  {
    const int limit = criteria.number_of_layers() != Criteria::automatic ? criteria.number_of_layers()
                      : number_of_vertices <= large_mesh                 ? Criteria::all_layers
                                                                         : layers_of_large_mesh;
    const std::vector<int> layers = layers_from(targets.vertices, elements, number_of_vertices);
    std::vector<bool> is_free(number_of_vertices);
    for(std::size_t v = 0; v < number_of_vertices; ++v)
      is_free[v] = layers[v] > 0 && layers[v] <= limit && layers[v] != Criteria::all_layers;
    return is_free;
  }

  static auto position_in(const std::vector<Vec3>& points)
  {
    return [&points](Vertex_index v) -> const Vec3& { return points[v]; };
  }

  Element_points element_points(Element_index e, const std::vector<Vec3>& points) const
  {
    return relative_points(m_elements[e], position_in(points));
  }

  // Whether an element is inverted, tested on the coordinates themselves, because differences would be
  // rounded.
  bool is_inverted(Element_index e, const std::vector<Vec3>& points) const
  {
    return jacobian_sign(m_elements[e], position_in(points)) != Jacobian_sign::POSITIVE;
  }

  bool has_arrived(std::size_t i) const { return m_points[m_targets.vertices[i]] == m_targets.positions[i]; }

  std::size_t number_arrived() const
  {
    std::size_t n = 0;
    for(std::size_t i = 0; i < m_targets.vertices.size(); ++i)
      n += has_arrived(i);
    return n;
  }

  // Moves vertices from where they are to their targets, except for held vertices.
  Outcome go_to_targets()
  {
    const double longest_step = 1. / m_criteria.number_of_steps(),
                 smallest_step = std::ldexp(longest_step, -maximal_number_of_halvings);
    double position = 0, step = longest_step;
    while(position < 1) {
      const double next = position + step < 1 - smallest_step / 2 ? position + step : 1;
      const Outcome outcome = try_step(next);
      if(outcome == Outcome::ACCEPTED) {
        position = next;
        step = (std::min)(longest_step, 2 * step);
      } else if(outcome != Outcome::INVERTED) {
        return outcome;
      } else if(step / 2 >= smallest_step) {
        step /= 2;
        ++m_result.number_of_halvings;
      } else if(!freeze()) {
        return Outcome::ACCEPTED; // all vertices that could move have moved
      }
    }
    return Outcome::ACCEPTED;
  }

  // Runs the loop of Algorithm 1 for one step, to the given fraction of the way.
  Outcome try_step(double fraction)
  {
    m_candidate = m_points;
    for(std::size_t i = 0; i < m_sources.size(); ++i) {
      const Vertex_index v = m_targets.vertices[i];
      if(!m_is_frozen[i])
        m_candidate[v] = fraction == 1 ? m_targets.positions[i]
                                       : m_sources[i] + fraction * (m_targets.positions[i] - m_sources[i]);
      m_displacements[v] = m_candidate[v] - m_points[v];
    }
    m_system.clear();
    for(Element_index e : m_system.active_elements())
      add_to_system(e, m_stiffness[e]);
    std::vector<double> costs = m_costs;
    for(bool is_changed = true; is_changed;) {
      if(!m_go_on())
        return Outcome::STOPPED;
      if(!move_inner_vertices())
        return Outcome::FAILED;
      is_changed = false;
      m_inverted.clear();
      for(std::size_t i = 0; i < m_moving.size(); ++i) {
        const Element_index e = m_moving[i];
        const bool inverted = is_inverted(e, m_candidate);
        if(inverted)
          m_inverted.push_back(e);
        costs[e] = m_quality(m_elements[e].kind(), element_points(e, m_candidate));
        // An element that was worse before needs no more stiffness.
        const bool is_bad = inverted || (!m_quality.is_acceptable(costs[e]) && costs[e] > m_costs[e]);
        if(is_bad && m_is_elastic[i]
           && m_stiffness[e] * m_criteria.stiffness_factor() <= m_criteria.maximal_stiffness()) {
          add_to_system(e, (m_criteria.stiffness_factor() - 1) * m_stiffness[e]);
          m_stiffness[e] *= m_criteria.stiffness_factor();
          is_changed = true;
        }
      }
    }
    if(!m_inverted.empty())
      return Outcome::INVERTED;
    m_points.swap(m_candidate);
    m_costs.swap(costs);
    return Outcome::ACCEPTED;
  }

  void add_to_system(Element_index e, double stiffness)
  {
    m_system.add(e, Elastic_material{stiffness / m_sizes[e], m_criteria.poisson_ratio(), 0}, m_points,
                 m_displacements);
  }

  // Adds the displacements that the elastic medium gives to the inner vertices.
  bool move_inner_vertices()
  {
    const int n = m_system.number_of_unknowns();
    if(n == 0)
      return true;
    ++m_result.number_of_solves;
    const auto matrix = make_matrix<Matrix>(m_system.starts(), m_system.rows(), m_system.values());
    typename Solver::Vector b{std::size_t(n)};
    for(int i = 0; i < n; ++i)
      b[i] = m_system.right_hand_side()[std::size_t(i)];
    typename Solver::NT denominator = 1;
    if(!m_solver.factor(matrix, denominator) || !m_solver.linear_solver(b, m_solution))
      return false;
    for(std::size_t i = 0; i < m_system.free_vertices().size(); ++i) {
      const Vertex_index v = m_system.free_vertices()[i];
      for(int k = 0; k < 3; ++k)
        m_candidate[v][k] = m_points[v][k] + m_solution[int(3 * i) + k] / denominator;
      if(!std::isfinite(norm(m_candidate[v])))
        return false;
    }
    return true;
  }

  // Moves held vertices the rest of the way one by one, where that inverts no element.
  void move_directly()
  {
    std::vector<std::size_t> late;
    for(std::size_t i = 0; i < m_targets.vertices.size(); ++i)
      if(!has_arrived(i))
        late.push_back(i);
    for(std::size_t before = late.size() + 1; !late.empty() && late.size() < before;) {
      before = late.size();
      late.erase(std::remove_if(late.begin(), late.end(), [&](std::size_t i) { return move_directly(i); }),
                 late.end());
    }
  }

  bool move_directly(std::size_t i)
  {
    const Vertex_index v = m_targets.vertices[i];
    const Vec3 before = std::exchange(m_points[v], m_targets.positions[i]);
    std::vector<Element_index> around;
    for(Element_index e : m_moving)
      if(std::find(m_elements[e].begin(), m_elements[e].end(), v) != m_elements[e].end())
        around.push_back(e);
    if(std::any_of(around.begin(), around.end(), [&](Element_index e) { return is_inverted(e, m_points); })) {
      m_points[v] = before;
      return false;
    }
    for(Element_index e : around)
      m_costs[e] = m_quality(m_elements[e].kind(), element_points(e, m_points));
    return true;
  }

  // Holds the boundary vertices of inverted elements from now on, or the vertices around them if these are
  // held already.
  bool freeze()
  {
    std::vector<std::uint8_t> mark(m_points.size(), 0);
    for(Element_index e : m_inverted)
      for(Vertex_index v : m_elements[e])
        mark[v] = 1;
    for(;;) {
      std::size_t frozen = 0;
      for(std::size_t i = 0; i < m_is_frozen.size(); ++i)
        if(!m_is_frozen[i] && mark[m_targets.vertices[i]] && !has_arrived(i)) {
          m_is_frozen[i] = 1;
          ++frozen;
        }
      m_result.number_of_frozen_vertices += frozen;
      if(frozen != 0)
        return true;
      const std::vector<std::uint8_t> inner = mark;
      for(Element_index e : m_moving)
        if(std::any_of(m_elements[e].begin(), m_elements[e].end(), [&](Vertex_index v) { return inner[v]; }))
          for(Vertex_index v : m_elements[e])
            mark[v] = 1;
      if(mark == inner)
        return false;
    }
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_RELAX_TO_SURFACE_H
