// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "brain_shift/febio.h"

#include "brain_shift/constraints.h"
#include "core/messages.h"
#include "core/resources.h"

#include <CGAL/Mixed_mesh_3/IO/FEB_model.h>
#include <CGAL/Mixed_mesh_3/internal/elements/Middle_nodes.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <ostream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace mm3 = CGAL::Mixed_meshes_3;

namespace {

constexpr std::size_t nowhere = std::size_t(-1);

using Ends = std::array<mm3::Vertex_index, 2>;

// The constraints of the remaining nodes. Edges have the order in which elements of order 2 are written.
Motion_constraints constraints_left(const Remaining_mesh& remaining, const Motion_constraints& constraints)
{
  const std::size_t vertices_before = constraints.held_directions.size() - constraints.edges.size();
  std::vector<mm3::Vertex_index> nodes(remaining.vertices.begin(),
                                       remaining.vertices.end()); // former numbers
  Motion_constraints left{{}, constraints.weights, constraints.means, {}};
  if(!constraints.edges.empty()) {
    std::map<Ends, mm3::Vertex_index> numbers_before;
    for(const Ends& ends : constraints.edges)
      numbers_before.emplace(ends, mm3::Vertex_index(vertices_before + numbers_before.size()));
    left.edges = mm3::internal::quadratic_connectivity(remaining.mesh.elements(),
                                                       remaining.mesh.number_of_vertices())
                   .ends;
    for(const auto& [v, w] : left.edges) {
      const auto [a, b] = std::minmax({nodes[v], nodes[w]});
      nodes.push_back(numbers_before.at({a, b}));
    }
  }
  std::vector<std::size_t> numbers(constraints.held_directions.size(), nowhere);
  for(std::size_t i = 0; i < nodes.size(); ++i) {
    numbers[nodes[i]] = i;
    left.held_directions.push_back(constraints.held_directions[nodes[i]]);
  }
  for(Motion_constraints::Weights& weights : left.weights)
    for(auto& [node, weight] : weights) {
      if(numbers[node] == nowhere)
        throw std::logic_error("a control point has a node that is removed");
      node = mm3::Vertex_index(numbers[node]);
    }
  return left;
}

// The acceleration of the tissue, reduced by the buoyancy of the fluid; check_febio() has ensured that there
// is mass.
Vector acceleration_in_fluid(double density, const Model_options& o)
{
  const double weight = o.fluid_density == 0 ? 1 : 1 - o.fluid_density * kg_per_mm3 / density;
  return weight * Vector(o.acceleration);
}

} // namespace

void write_febio(mm3::IO::Output_files& files, const std::string& path, const Remaining_mesh& remaining,
                 std::vector<mm3::IO::Facet_set> facet_sets, const mm3::IO::Subdomain_names& subdomain_names,
                 const Model_options& o, const Outcome& outcome)
{
  mm3::IO::FEB_model model;
  for(const Subdomain_facts& s : outcome.subdomains) {
    model.materials[s.index] = s.material;
    model.accelerations[s.index] = acceleration_in_fluid(s.material.density, o);
  }
  Explicit_constraints constraints = solve_for_displacements(
    constraints_left(remaining, outcome.constraints));
  model.order = outcome.constraints.edges.empty() ? 1 : 2;
  model.fixed_vertices = std::move(constraints.fixed_vertices);
  model.supports = std::move(constraints.supports);
  model.controls = std::move(constraints.controls);
  model.facet_sets = std::move(facet_sets);
  model.subdomain_names = subdomain_names;
  model.displacements_file = std::filesystem::path(path).stem().string() + "_displacements.csv";
  model.comments.push_back(counted(outcome.constraints.means.size(), "control point", "control points")
                           + " of brain_shift; several nodes that have a mean displacement, or slide, are "
                             "linear constraints.");
  if(o.points.compliance > 0)
    model.comments.emplace_back(
      "Control points give way to forces in brain_shift: here are the displacements "
      "that came out.");
  const auto write = [&](std::ostream& stream) {
    return mm3::IO::write_FEB_model(stream, remaining.mesh, model);
  };
  require([&](std::string* error) { return files.write(path, write, error); });
}
