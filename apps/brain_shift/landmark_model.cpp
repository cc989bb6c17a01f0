// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "brain_shift/landmark_model.h"

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace {

using Errors = std::vector<std::optional<Vector>>;

// Errors at the targets. Given landmarks move the mesh; the other landmarks move with their elements.
Errors errors_of_targets(Elasticity& elasticity, const Controls& all, Outcome& outcome)
{
  const Landmark_facts& landmarks = *outcome.landmarks;
  Controls given{all.mesh, all.options, {}};
  for(std::size_t i = 0; i < landmarks.points.size(); ++i)
    if(landmarks.is_given[i])
      given.points.push_back(landmarks.points[i]);
  set_control_points(elasticity, given);
  const CGAL::Linear_elasticity_result_3 result = elasticity.solve(given.displacements());
  Errors errors(landmarks.points.size());
  if(!is_solution(elasticity, result)) {
    outcome.warnings.push_back(
      all.options.file + ": by the outermost landmarks, the model has no solution: " + result.description());
    return errors;
  }
  for(std::size_t i = 0; i < errors.size(); ++i)
    if(!landmarks.is_given[i])
      errors[i] = Vector(landmarks.points[i].displacement) - elasticity.displacement(landmarks.locations[i]);
  return errors;
}

} // namespace

void measure_by_outermost(Elasticity& elasticity, const Controls& landmarks, Outcome& outcome)
{
  const Errors errors = errors_of_targets(elasticity, landmarks, outcome);
  outcome.landmarks->errors.push_back({Landmark_facts::model, {}, errors});
}

void measure_left_out(const Elasticity& elasticity, Outcome& outcome)
{
  Errors& errors = outcome.landmarks->errors.back().left_out;
  for(const Vector& error : elasticity.leave_one_out_errors()) // infinite if the others do not hold the mesh
    errors.push_back(std::isfinite(error[0]) ? std::optional<Vector>(error) : std::nullopt);
}

void measure_shift(const Elasticity& elasticity, Outcome& outcome)
{
  Landmark_facts& landmarks = *outcome.landmarks;
  landmarks.of_shift.emplace();
  for(std::size_t i = 0; i < landmarks.points.size(); ++i)
    landmarks.of_shift->push_back(Vector(landmarks.points[i].displacement)
                                  - elasticity.displacement(landmarks.locations[i]));
}
