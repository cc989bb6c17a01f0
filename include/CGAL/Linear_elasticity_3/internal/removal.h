// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The solution after elements have been removed, with the factor of the former system.

#ifndef CGAL_LINEAR_ELASTICITY_3_INTERNAL_REMOVAL_H
#define CGAL_LINEAR_ELASTICITY_3_INTERNAL_REMOVAL_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <CGAL/Linear_elasticity_3/internal/Elastic_body.h>
#include <CGAL/Linear_elasticity_3/internal/control_constraints.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <utility>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
Conjugate gradients in the space of displacements that are zero at the control points (N. I. M. Gould,
M. E. Hribar, J. Nocedal: "On the solution of equality constrained quadratic programming problems arising in
optimization", SIAM J. Sci. Comput. 23, 2001).

\param body body that was factored before the removal, and for which `solve_loads()` has been called since
\param constraints constraints without compliance
\param wanted displacements of the control points
\param tolerance bound of the error in the energy norm, relative to that of the solution
\param solution solution for the former stiffness, where the iterations start; the solution for the new
stiffness, if the iterations converge
\param number_of_iterations number of iterations done
\return whether the iterations converge. If not, the system should be factored
*/
inline bool solve_after_removal(Elastic_body& body, const Control_constraints& constraints,
                                const Eigen::VectorXd& wanted, double tolerance, Control_solution& solution,
                                int& number_of_iterations)
{
  // Limits beyond which the system is factored instead, which takes as long as some hundreds of iterations.
  // Ten to fifteen iterations are usual; if the residual rises so often in a row, it may consist of rounding
  // errors only.
  constexpr int largest_number_of_iterations = 100, largest_number_of_rises = 20;
  const Elastic_stiffness& stiffness = body.stiffness();
  const Elastic_supports& supports = body.supports();
  Eigen::VectorXd& u = solution.displacements;
  const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(wanted.size());
  solution.forces = nothing;
  Control_solution step;
  const auto precondition = [&](Eigen::VectorXd& r) {
    Eigen::MatrixXd z;
    if(!body.solve(r, z)
       || !constraints.solve(z.col(0), r, nothing, body.system().free_motions(), step).is_success())
      return false;
    constraints.add_forces(step.forces, r); // so that rounding errors do not grow
    r = supports.free_part(std::move(r));
    solution.forces += step.forces;
    return true;
  };
  Eigen::VectorXd r = supports.free_part(body.force() - stiffness.product(u));
  if(!precondition(r))
    return false;
  Eigen::VectorXd p = step.displacements;
  double rz = r.dot(p);
  const double bound = tolerance * tolerance * u.dot(stiffness.product(u));
  double least = rz;
  int rises = 0; // successive rises of the residual, which may be rounding errors
  for(number_of_iterations = 0; number_of_iterations < largest_number_of_iterations; ++number_of_iterations) {
    if(!(rz > bound))
      return constraints.is_satisfied(u, wanted);
    rises = rz < least ? 0 : rises + 1;
    least = (std::min)(least, rz);
    if(rises > largest_number_of_rises)
      return false;
    const Eigen::VectorXd q = supports.free_part(stiffness.product(p));
    const double alpha = rz / p.dot(q);
    u += alpha * p;
    r -= alpha * q;
    if(!std::isfinite(alpha) || !precondition(r))
      return false;
    const double next = r.dot(step.displacements);
    p = step.displacements + (next / rz) * p;
    rz = next;
  }
  return false;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_INTERNAL_REMOVAL_H
