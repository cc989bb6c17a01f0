// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mixed_mesh_3/algorithm_1.h"

#if MIXED_MESH_3_HAS_EIGEN

#include <CGAL/fit_mixed_mesh_to_surface.h>

#include <functional>

namespace mm3 = CGAL::Mixed_meshes_3;

CGAL::Mixed_mesh_fit_result_3 run_algorithm_1(Mesh& mesh,
                                              const CGAL::Labeled_polyhedral_mixed_mesh_domain_3& domain,
                                              const Relaxation_options& o, Stage_log& log)
{
  const auto criteria = CGAL::Mixed_mesh_fit_criteria_3()
                          .number_of_steps(o.steps)
                          .poisson_ratio(o.poisson_ratio)
                          .stiffness_factor(o.stiffness_factor)
                          .maximal_stiffness(o.maximal_stiffness)
                          .acceptable_aspect_ratio(o.acceptable_quality)
                          .number_of_layers(o.layers);
  const auto np = CGAL::parameters::visitor(std::ref(log));
  const auto fit_with = [&](auto solver) {
    return CGAL::fit_mixed_mesh_to_surface(mesh, domain, criteria, np.sparse_linear_solver(std::ref(solver)));
  };
  switch(o.solver) {
  case Solver::CG: break; // the library's default solver and parameters
  case Solver::LDLT: return fit_with(mm3::Simplicial_solver_traits());
  }
  return CGAL::fit_mixed_mesh_to_surface(mesh, domain, criteria, np);
}

#else

#include <stdexcept>

CGAL::Mixed_mesh_fit_result_3 run_algorithm_1(Mesh&, const CGAL::Labeled_polyhedral_mixed_mesh_domain_3&,
                                              const Relaxation_options&, Stage_log&)
{
  throw std::logic_error("checked with the options");
}

#endif
