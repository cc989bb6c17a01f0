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
#include <CGAL/Linear_elasticity_3/internal/Elastic_stiffness.h>
#include <CGAL/Linear_elasticity_3/internal/control_constraints.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
Conjugate gradients for the present stiffness K' with the factor of the former one, K, as the preconditioner,
in the space of displacements that are zero at the control points (N. I. M. Gould, M. E. Hribar, J. Nocedal:
"On the solution of equality constrained quadratic programming problems arising in optimization", SIAM J. Sci.
Comput. 23, 2001).

K - K' is zero except at the nodes of removed elements, and of patches that lost elements; the residual of
the solution for K is zero elsewhere, too. So are residuals of all iterations: with K z = r, K' z is
r - (K - K') z. The iterations therefore take displacements of these nodes only, by
`Elastic_body::solve_selected()`, which may round to single precision. In the end, the forces that were found
take one solution for all nodes in double precision, and its residual shows whether another cycle is
necessary.
*/
class Removal
{
  using Vector = Eigen::VectorXd;

  // Limits beyond which the system is factored instead, which takes as long as some hundreds of iterations.
  // Usual are ten to fifteen iterations; if the residual rises as often in a row, it may consist of rounding
  // errors only.
  static constexpr int largest_number_of_iterations = 100, largest_number_of_rises = 20;
  // The reduction of the error by a cycle, squared: beyond 1e-4, rounding to single precision, which is 6e-8
  // of each number, may dominate.
  static constexpr double reduction = 1e-8;
  // The part of the tolerance, squared, that a cycle aims at, so that rounding rarely causes another one:
  // 0.9 squared.
  static constexpr double margin = 0.81;

  Elastic_body& m_body;
  const Control_constraints& m_constraints;
  Stiffness_change m_change;
  Control_constraints::Rows m_rows;
  int m_number_of_iterations = 0;

public:
  /// \param body body that was factored before the removal, and for which `solve_loads()` has been called
  /// since
  /// \param constraints constraints without compliance
  Removal(Elastic_body& body, const Control_constraints& constraints)
    : m_body(body), m_constraints(constraints), m_change(body.stiffness().change()),
      m_rows(constraints.rows_of(m_change.nodes))
  {
    m_body.select(m_change.nodes);
  }

  int number_of_iterations() const { return m_number_of_iterations; }

  /// \param wanted displacements of the control points
  /// \param tolerance bound of the error in the energy norm, relative to that of the solution
  /// \param solution solution for the former stiffness, where the iterations start; the solution for the
  /// present stiffness, if the iterations converge
  /// \return whether the iterations converge. If not, the system should be factored
  bool solve(const Vector& wanted, double tolerance, Control_solution& solution)
  {
    const Elastic_stiffness& stiffness = m_body.stiffness();
    Vector& u = solution.displacements;
    double bound = -1, before = std::numeric_limits<double>::infinity();
    while(true) {
      const Vector internal = stiffness.product(u);
      if(bound < 0)
        bound = tolerance * tolerance * u.dot(internal);
      Vector residual = m_body.force() - internal;
      m_constraints.add_forces(solution.forces, residual);
      Vector r = free_part(rows_of(residual)), z;
      if(!precondition(r, z))
        return false;
      const double error = r.dot(z);
      if(!(error > bound))
        return m_constraints.is_satisfied(u, wanted);
      if(!(error < before / 4)) // the former cycle was of little use
        return false;
      before = error;
      Vector forces = Vector::Zero(r.size());
      if(!iterate(r, z, (std::max)(margin * bound, reduction * error), forces)
         || !add(forces, wanted, solution))
        return false;
    }
  }

private:
  // Conjugate gradients, from a residual and its preconditioned one; adds up the forces that have the effect
  // of the removal on the former body.
  bool iterate(Vector r, Vector z, double bound, Vector& forces)
  {
    Vector p = z, former = r; // a direction, and the product of K and this direction
    double rz = r.dot(z), least = rz;
    int rises = 0; // successive rises of the residual, which may be rounding errors
    while(rz > bound) {
      if(m_number_of_iterations++ == largest_number_of_iterations)
        return false;
      const Vector q = former - free_part(m_change.matrix.selfadjointView<Eigen::Lower>() * p);
      const double alpha = rz / p.dot(q);
      forces += alpha * former;
      r -= alpha * q;
      if(!std::isfinite(alpha) || !precondition(r, z))
        return false;
      const double next = r.dot(z);
      rises = next < least ? 0 : rises + 1;
      least = (std::min)(least, next);
      if(rises > largest_number_of_rises)
        return false;
      p = z + (next / rz) * p;
      former = r + (next / rz) * former;
      rz = next;
    }
    return true;
  }

  bool precondition(const Vector& r, Vector& z)
  {
    if(!m_body.solve_selected(r, z))
      return false;
    m_constraints.hold(m_rows, r, z);
    return true;
  }

  // Adds the effect that forces on the nodes of the change have on the former body.
  bool add(const Vector& forces, const Vector& wanted, Control_solution& solution)
  {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(solution.displacements.size(), 1), u;
    for(std::size_t i = 0; i < m_change.nodes.size(); ++i)
      all.middleRows<3>(3 * Eigen::Index(m_change.nodes[i])) = forces.segment<3>(3 * Eigen::Index(i));
    Control_solution step;
    if(!m_body.solve(all, u)
       || !m_constraints
             .solve(u.col(0), all.col(0), Vector::Zero(wanted.size()), m_body.system().free_motions(), step)
             .is_success())
      return false;
    solution.displacements += step.displacements;
    solution.forces += step.forces;
    return true;
  }

  Vector rows_of(const Vector& x) const
  {
    Vector y(3 * Eigen::Index(m_change.nodes.size()));
    for(std::size_t i = 0; i < m_change.nodes.size(); ++i)
      y.segment<3>(3 * Eigen::Index(i)) = x.segment<3>(3 * Eigen::Index(m_change.nodes[i]));
    return y;
  }

  Vector free_part(Vector f) const
  {
    for(std::size_t i = 0; i < m_change.nodes.size(); ++i) {
      const Eigen::Index j = 3 * Eigen::Index(i);
      const Vec3 x = m_body.supports().free_part(m_change.nodes[i], {f[j], f[j + 1], f[j + 2]});
      for(int k = 0; k < 3; ++k)
        f[j + k] = x[k];
    }
    return f;
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_INTERNAL_REMOVAL_H
