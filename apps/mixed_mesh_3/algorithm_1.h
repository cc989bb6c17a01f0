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
#include "mixed_mesh_3/options.h"

#include <CGAL/Mixed_mesh_fit_result_3.h>
#include <CGAL/Labeled_polyhedral_mixed_mesh_domain_3.h>

/// Brings the boundary onto the surface by Algorithm 1. \pre the program was built with Eigen and the solver
CGAL::Mixed_mesh_fit_result_3 run_algorithm_1(Mesh& mesh,
                                              const CGAL::Labeled_polyhedral_mixed_mesh_domain_3& domain,
                                              const Relaxation_options& options, Stage_log& log);

#endif // MIXED_MESH_3_APPS_MIXED_MESH_3_ALGORITHM_1_H
