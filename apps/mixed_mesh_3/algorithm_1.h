// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The paper's way onto the surface.

#ifndef MIXED_MESH_3_APPS_MIXED_MESH_3_ALGORITHM_1_H
#define MIXED_MESH_3_APPS_MIXED_MESH_3_ALGORITHM_1_H

#include "core/Stage_log.h"
#include "core/types.h"

#include <CGAL/Mixed_mesh_fit_criteria_3.h>
#include <CGAL/Mixed_mesh_fit_result_3.h>
#include <CGAL/Labeled_polyhedral_mixed_mesh_domain_3.h>

/// The solver of the linear systems of Algorithm 1.
enum class Solver { CG, LDLT };

/// The parameters of Algorithm 1.
struct Relaxation_options
{
  using Criteria = CGAL::Mixed_mesh_fit_criteria_3;

  int steps = Criteria().number_of_steps();
  int layers = Criteria::automatic;
  double poisson_ratio = Criteria().poisson_ratio();
  double stiffness_factor = Criteria().stiffness_factor();
  double maximal_stiffness = Criteria().maximal_stiffness();
  double acceptable_quality = Criteria().acceptable_aspect_ratio();
  Solver solver = Solver::CG;
};

/// Brings the boundary onto the surface by Algorithm 1. \pre the program was built with Eigen and the solver
CGAL::Mixed_mesh_fit_result_3 run_algorithm_1(Mesh& mesh,
                                              const CGAL::Labeled_polyhedral_mixed_mesh_domain_3& domain,
                                              const Relaxation_options& options, Stage_log& log);

#endif // MIXED_MESH_3_APPS_MIXED_MESH_3_ALGORITHM_1_H
