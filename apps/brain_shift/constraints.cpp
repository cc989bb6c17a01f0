// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "brain_shift/constraints.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

namespace mm3 = CGAL::Mixed_meshes_3;

namespace {

// A node and an axis.
using Component = std::pair<mm3::Vertex_index, int>;
using Terms = std::map<Component, double>;

// A component of a displacement that other components determine: the sum of `terms` and `value`.
struct Dependent_component
{
  Terms terms;
  double value;
  bool is_control;
};

class Elimination
{
  // Limits relative to the largest factor of an equation: of rounding errors, and of factors below which an
  // equation follows from others.
  static constexpr double rounding = 1e-12, dependence = 1e-10;

  const std::vector<std::vector<Vector>>& m_held_directions;
  std::map<Component, Dependent_component> m_dependent;
  std::map<Component, std::set<Component>> m_users; // determined components with a component in their terms

public:
  explicit Elimination(const std::vector<std::vector<Vector>>& held_directions)
    : m_held_directions(held_directions)
  {
  }

  const std::map<Component, Dependent_component>& dependent() const { return m_dependent; }

  bool is_fixed(mm3::Vertex_index v) const { return m_held_directions[v].size() == 3; }

  // Adds the equation that the sum of terms is the value.
  void add(const Terms& equation, double value, bool is_control)
  {
    double scale = 0;
    Terms free;
    for(const auto& [component, factor] : equation) {
      scale = (std::max)(scale, std::abs(factor));
      value -= add_dependent(component, factor, free);
    }
    const auto largest = std::max_element(free.begin(), free.end(), [](const auto& a, const auto& b) {
      return std::abs(a.second) < std::abs(b.second);
    });
    if(largest == free.end() || !(std::abs(largest->second) > dependence * scale))
      return;
    const auto [component, pivot] = *largest;
    Dependent_component dependent{{}, value / pivot, is_control};
    for(const auto& [other, factor] : free)
      if(other != component && std::abs(factor) > rounding * std::abs(pivot)) {
        dependent.terms.emplace(other, -factor / pivot);
        m_users[other].insert(component);
      }
    substitute(component, dependent);
    m_dependent.emplace(component, std::move(dependent));
  }

private:
  // Adds a component times a factor to a sum of undetermined components; returns the known part.
  double add_dependent(const Component& component, double factor, Terms& sum) const
  {
    if(is_fixed(component.first))
      return 0;
    const auto place = m_dependent.find(component);
    if(place == m_dependent.end()) {
      sum[component] += factor;
      return 0;
    }
    for(const auto& [other, f] : place->second.terms)
      sum[other] += factor * f;
    return factor * place->second.value;
  }

  // Replaces a component by the components that determine it.
  void substitute(const Component& component, const Dependent_component& by)
  {
    const auto users = m_users.find(component);
    if(users == m_users.end())
      return;
    const std::set<Component> all = std::move(users->second);
    m_users.erase(users);
    for(const Component& user : all) {
      Dependent_component& dependent = m_dependent.at(user);
      const double factor = dependent.terms.at(component);
      dependent.terms.erase(component);
      dependent.value += factor * by.value;
      for(const auto& [other, f] : by.terms) {
        double& sum = dependent.terms[other];
        const double larger = (std::max)(std::abs(sum), std::abs(factor * f));
        sum += factor * f;
        if(std::abs(sum) > rounding * larger) {
          m_users[other].insert(user);
        } else { // the terms cancel each other
          dependent.terms.erase(other);
          m_users[other].erase(user);
        }
      }
    }
  }
};

mm3::IO::FEB_constraint constraint_of(const Component& component, const Dependent_component& dependent)
{
  mm3::IO::FEB_constraint c{component.first, component.second, {}, dependent.value};
  for(const auto& [other, factor] : dependent.terms)
    c.terms.push_back({other.first, other.second, factor});
  return c;
}

// Adds a component of a node's value to an equation of displacements. The value of an edge is the
// displacement of its middle minus the mean of its ends.
void add_value(const Motion_constraints& constraints, mm3::Vertex_index node, int axis, double factor,
               Terms& equation)
{
  const std::size_t vertices = constraints.held_directions.size() - constraints.edges.size();
  equation[{node, axis}] += factor;
  if(node >= vertices)
    for(mm3::Vertex_index end : constraints.edges[node - vertices])
      equation[{end, axis}] -= factor / 2;
}

} // namespace

Explicit_constraints solve_for_displacements(const Motion_constraints& constraints)
{
  Elimination elimination(constraints.held_directions);
  Explicit_constraints result;
  for(mm3::Vertex_index v = 0; v < constraints.held_directions.size(); ++v)
    if(elimination.is_fixed(v)) {
      result.fixed_vertices.push_back(v);
    } else {
      for(const Vector& d : constraints.held_directions[v]) {
        Terms equation;
        for(int axis = 0; axis < 3; ++axis)
          add_value(constraints, v, axis, d[axis], equation);
        elimination.add(equation, 0, false);
      }
    }
  for(std::size_t i = 0; i < constraints.means.size(); ++i)
    for(int axis = 0; axis < 3; ++axis) {
      Terms mean;
      for(const auto& [v, weight] : constraints.weights[i])
        add_value(constraints, v, axis, weight, mean);
      elimination.add(mean, constraints.means[i][axis], true);
    }
  for(const auto& [component, dependent] : elimination.dependent())
    (dependent.is_control ? result.controls : result.supports).push_back(constraint_of(component, dependent));
  return result;
}
