// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "brain_shift/febio.h"

#include "brain_shift/constraints.h"
#include "core/messages.h"
#include "core/resources.h"

#include <CGAL/Mixed_mesh_3/IO/FEB_model.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>

namespace mm3 = CGAL::Mixed_meshes_3;

namespace {

constexpr std::size_t nowhere = std::size_t(-1);

// The number of each vertex of the former mesh in the remaining mesh.
std::vector<std::size_t> numbers_left(const Remaining_mesh& remaining, std::size_t number_before)
{
  std::vector<std::size_t> numbers(number_before, nowhere);
  for(std::size_t v = 0; v < remaining.vertices.size(); ++v)
    numbers[remaining.vertices[v]] = v;
  return numbers;
}

Motion_constraints constraints_left(const Remaining_mesh& remaining, const Motion_constraints& constraints)
{
  const auto numbers = numbers_left(remaining, constraints.held_directions.size());
  Motion_constraints left{{}, constraints.weights, constraints.means};
  for(mm3::Vertex_index v : remaining.vertices)
    left.held_directions.push_back(constraints.held_directions[v]);
  for(Motion_constraints::Weights& weights : left.weights)
    for(auto& [v, weight] : weights) {
      if(numbers[v] == nowhere)
        throw std::logic_error("a control point has a vertex that is removed");
      v = mm3::Vertex_index(numbers[v]);
    }
  return left;
}

// The acceleration of the tissue, reduced by the buoyancy of the fluid; check_febio() has ensured that there
// is mass.
Vector acceleration_in_fluid(double density, const Options& o)
{
  const double weight = o.fluid_density == 0 ? 1 : 1 - o.fluid_density * kg_per_mm3 / density;
  return weight * Vector(o.acceleration);
}

} // namespace

void write_febio(mm3::IO::Output_files& files, const Remaining_mesh& remaining,
                 std::vector<mm3::IO::Facet_set> facet_sets, const mm3::IO::Subdomain_names& subdomain_names,
                 const Options& o, const Outcome& outcome)
{
  mm3::IO::FEB_model model;
  for(const Subdomain_facts& s : outcome.subdomains) {
    model.materials[s.index] = s.material;
    model.accelerations[s.index] = acceleration_in_fluid(s.material.density, o);
  }
  Explicit_constraints constraints = solve_for_displacements(
    constraints_left(remaining, outcome.constraints));
  model.fixed_vertices = std::move(constraints.fixed_vertices);
  model.supports = std::move(constraints.supports);
  model.controls = std::move(constraints.controls);
  model.facet_sets = std::move(facet_sets);
  model.subdomain_names = subdomain_names;
  model.displacements_file = std::filesystem::path(o.febio).stem().string() + "_displacements.csv";
  model.comments.push_back(counted(outcome.constraints.means.size(), "control point", "control points")
                           + " of brain_shift; several vertices that have a mean displacement, or slide, are "
                             "linear constraints.");
  if(o.compliance > 0)
    model.comments.emplace_back(
      "Control points give way to forces in brain_shift: here are the displacements "
      "that came out.");
  const auto write = [&](std::ostream& stream) {
    return mm3::IO::write_FEB_model(stream, remaining.mesh, model);
  };
  require([&](std::string* error) { return files.write(o.febio, write, error); });
}
