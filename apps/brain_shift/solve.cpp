// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "brain_shift/solve.h"

#include "core/messages.h"

#include <stdexcept>

using Elasticity_status = CGAL::Linear_elasticity_status;

namespace {

[[noreturn]] void refuse(const CGAL::Linear_elasticity_result_3& result, const Controls& controls)
{
  switch(result.status) {
  case Elasticity_status::CONTROL_POINT_OUTSIDE:
    refuse_outside(controls, controls.points[result.control_point], result.distance);
  case Elasticity_status::CONTRADICTORY_CONTROL_POINTS:
    throw std::runtime_error(controls.options.file + ": " + controls.points[result.control_point].place()
                             + ": the displacement contradicts those of other control points, or "
                               "supports, in the same element: it is missed by "
                             + rounded(result.distance) + " mm; see --control-compliance, --fixed-below");
  case Elasticity_status::FREE_RIGID_MOTION:
    throw std::runtime_error(controls.mesh + ": " + result.description()
                             + ", and the control points do not hold it; see --fixed-below");
  case Elasticity_status::NOT_CONVERGED:
    throw std::runtime_error(controls.mesh + ": " + result.description()
                             + "; --control-radius, or --control-compliance, would spread it");
  default: throw std::runtime_error(controls.mesh + ": " + result.description());
  }
}

} // namespace

void check(const CGAL::Linear_elasticity_result_3& result, const Controls& controls)
{
  if(!result.is_success())
    refuse(result, controls);
}

void set_control_points(Elasticity& elasticity, const Controls& controls)
{
  std::vector<Vector> positions;
  std::vector<double> weights;
  for(const Control_point& point : controls.points) {
    positions.push_back(point.position);
    weights.push_back(point.weight);
  }
  check(elasticity.set_control_points(positions, controls.options.max_distance, controls.options.compliance,
                                      controls.options.radius, weights),
        controls);
}

bool is_solution(const Elasticity& elasticity, const CGAL::Linear_elasticity_result_3& result)
{
  return result.is_success()
         || (elasticity.is_corotational() && result.status == Elasticity_status::INVERTED_ELEMENT);
}

void solve(Elasticity& elasticity, const Controls& controls)
{
  const CGAL::Linear_elasticity_result_3 result = elasticity.solve(controls.displacements());
  if(!is_solution(elasticity, result))
    refuse(result, controls);
}
