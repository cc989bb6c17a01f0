// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The equilibrium of corotational elements, with the factor of the linear system.

#ifndef CGAL_LINEAR_ELASTICITY_3_INTERNAL_COROTATIONAL_SOLUTION_H
#define CGAL_LINEAR_ELASTICITY_3_INTERNAL_COROTATIONAL_SOLUTION_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <CGAL/Linear_elasticity_3/Linear_elasticity_result_3.h>
#include <CGAL/Linear_elasticity_3/internal/Corotational_elements.h>
#include <CGAL/Linear_elasticity_3/internal/Elastic_body.h>
#include <CGAL/Linear_elasticity_3/internal/control_constraints.h>
#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The start of the next solution.
struct Corotational_state
{
  Eigen::VectorXd displacements, force; // displacements of all vertices; body forces
  std::vector<double> residuals;        // before each step of Newton's method, failed ones included
  int number_of_iterations = 0;         // iterations of conjugate gradients
};

/*!
Newton's method. Each step is solved by conjugate gradients in the space of displacements that supports and
control points allow, with the factor of the linear stiffness as the preconditioner, as after a removal
(`Removal`). Steps are whole: with the forces that `Corotational_elements` expects in its
tangent, a line search for less energy would only hinder convergence. Whole steps are for large rotations of
slender bodies.

Large strains need another method: an element under pressure has negative curvature. If Newton's method
diverges, steps are made with the positive part of the tangent, as in the Gauss-Newton method, as far as the
potential falls; near the solution, with the whole tangent. Loads are applied at once if that converges, else
in parts.
*/
class Corotational_solution
{
  using Vector = Eigen::VectorXd;
  using Result = Linear_elasticity_result_3;
  using Status = Linear_elasticity_status;

  // Limits of steps and iterations. Two to six steps are usual, with five to fifteen iterations each; with 50
  // to 80 in a bar bent by 90 degrees.
  static constexpr int largest_number_of_steps = 15, largest_number_of_descents = 40,
                       largest_number_of_iterations = 1000;
  static constexpr double smallest_part = 1. / 64; // share of the loads: six halvings
  // Limit of the iterations of all steps together, times the number of vertices: with 20,000, the limit is
  // reached after a minute or two. Bars bent by 90 degrees take half of the limit.
  static constexpr double largest_work = 2e7;
  // The sufficient residual before all of the loads are applied, and the residual due to rounding; relative.
  static constexpr double rough = 0.03, rounding = 1e-9;

  Elastic_body& m_body;
  const Control_constraints& m_constraints;
  Corotational_elements& m_elements;
  Corotational_state& m_state;
  Control_solution m_step; // step of the preconditioner

public:
  /// \param body body that is factored, and for which `solve_loads()` has been called since
  Corotational_solution(Elastic_body& body, const Control_constraints& constraints,
                        Corotational_elements& elements, Corotational_state& state)
    : m_body(body), m_constraints(constraints), m_elements(elements), m_state(state)
  {
  }

  /// \param wanted displacements of the control points
  /// \param tolerance bound of the error in the energy norm, relative to that of the solution
  /// \param solution the solution; unchanged in case of failure
  Result solve(const Vector& wanted, double tolerance, Control_solution& solution)
  {
    m_state.residuals.clear();
    m_state.number_of_iterations = 0;
    const Vector first_points = m_constraints.at_points(m_state.displacements), first_force = m_state.force;
    const Vector first_supports = supported(m_state.displacements);
    double done = 0, part = 1;
    while(done < 1) {
      const double load = (std::min)(1., done + part);
      const auto partly = [&](const Vector& a, const Vector& b) -> Vector {
        return load == 1 ? b : (a + load * (b - a)).eval();
      };
      Vector u = m_state.displacements;
      const Vector force = partly(first_force, m_body.force()), points = partly(first_points, wanted);
      const Vector supports = partly(first_supports, supported(Vector()));
      const Result result = find_equilibrium(force, points, supports, load == 1 ? tolerance : rough, u);
      if(result.is_success()) {
        m_state.displacements = u;
        m_state.force = force;
        done = load;
        continue;
      }
      part /= 2;
      if(result.status != Status::NOT_CONVERGED || part < smallest_part || is_too_much())
        return result;
    }
    solution = {m_state.displacements, m_step.forces};
    if(m_constraints.is_compliant())
      solution.forces = spring_forces(wanted, m_state.displacements);
    return Result();
  }

private:
  bool is_too_much() const
  {
    return m_state.number_of_iterations * (double(m_body.force().size()) / 3) > largest_work;
  }

  static Result failed(Status status)
  {
    Result result;
    result.status = status;
    return result;
  }

  // Displacements in the directions that supports hold: those of u, or those that supports prescribe.
  Vector supported(const Vector& u) const
  {
    const auto& of_vertices = m_body.supports().of_vertices();
    Vector result = Vector::Zero(3 * Eigen::Index(of_vertices.size()));
    for(Vertex_index v = 0; v < of_vertices.size(); ++v)
      if(m_body.supports().is_kept(v)) {
        const Eigen::Index i = 3 * Eigen::Index(v);
        const Vec3 all = u.size() == 0 ? of_vertices[v].displacement : Vec3{u[i], u[i + 1], u[i + 2]};
        const Vec3 held = all - of_vertices[v].free_part(all);
        result.segment<3>(i) = Eigen::Vector3d(held.data());
      }
    return result;
  }

  // Forces of control points with compliance.
  Vector spring_forces(const Vector& points, const Vector& u) const
  {
    return (points - m_constraints.at_points(u)).cwiseQuotient(m_constraints.compliances());
  }

  // Forces that are not in equilibrium, without the forces of exact control points.
  Vector residual(const Vector& force, const Vector& points, const Vector& u) const
  {
    Vector r = force - m_elements.forces();
    if(m_constraints.is_compliant())
      m_constraints.add_forces(spring_forces(points, u), r);
    return m_body.supports().free_part(std::move(r));
  }

  Vector tangent_times(const Vector& p) const
  {
    Vector q = m_elements.product(p);
    if(m_constraints.is_compliant())
      m_constraints.add_forces(m_constraints.at_points(p).cwiseQuotient(m_constraints.compliances()), q);
    return m_body.supports().free_part(std::move(q));
  }

  // Finds the linear solution for forces, and displacements of control points, and stores the solution in
  // m_step.
  Result solve_linear(const Vector& force, const Vector& points)
  {
    Eigen::MatrixXd z;
    if(!m_body.solve(force, z))
      return failed(Status::SOLVER_FAILED);
    return m_constraints.solve(z.col(0), force, points, m_body.system().free_motions(), m_step);
  }

  // Finds the linear solution for a residual. The forces of the control points are subtracted from the
  // residual, so that rounding errors do not grow.
  bool precondition(Vector& r)
  {
    const Result result = solve_linear(r, Vector::Zero(m_step.forces.size()));
    // The error at control points is due to rounding, if the rest of the residual is due to rounding.
    if(!result.is_success() && result.status != Status::CONTRADICTORY_CONTROL_POINTS)
      return false;
    if(!m_constraints.is_compliant()) {
      m_constraints.add_forces(m_step.forces, r);
      r = m_body.supports().free_part(std::move(r));
    }
    return true;
  }

  // Adds conjugate gradients' solution of the tangent system for a residual to a displacement.
  // \pre r is preconditioned, m_step has the result
  // \param bound bound of r . z
  // \return whether there was no negative curvature
  bool add_newton_step(Vector r, double bound, Vector& step)
  {
    Vector p = m_step.displacements;
    double rz = r.dot(p);
    for(int i = 0; i < largest_number_of_iterations && rz > bound && !is_too_much(); ++i) {
      const Vector q = tangent_times(p);
      const double curvature = p.dot(q), alpha = rz / curvature;
      if(!(curvature > 0) || !std::isfinite(alpha)) {
        if(i == 0)
          step += p; // at least a direction in which the potential falls
        return false;
      }
      step += alpha * p;
      r -= alpha * q;
      ++m_state.number_of_iterations;
      if(!precondition(r))
        return true;
      const double next = r.dot(m_step.displacements);
      p = m_step.displacements + (next / rz) * p;
      rz = next;
    }
    return true;
  }

  // The square of the energy norm that residuals are compared with.
  double scale(const Vector& u, double tolerance) const
  {
    const double linear = u.dot(m_body.stiffness().product(u));
    return tolerance * tolerance * 2 * m_elements.energy() + rounding * rounding * linear;
  }

  Result find_equilibrium(const Vector& force, const Vector& points, const Vector& supports, double tolerance,
                          Vector& u)
  {
    constexpr double accuracy = 1e-3; // accuracy of the first step
    m_elements.move(u);
    if(const Result result = predict(force, points, supports, accuracy, u); !result.is_success())
      return result;
    const Vector start = u;
    if(converge(Method::NEWTON, force, points, tolerance, u))
      return Result();
    u = start;
    m_elements.move(u, true);
    return converge(Method::DESCENT, force, points, tolerance, u) ? Result() : failed(Status::NOT_CONVERGED);
  }

  enum class Method { NEWTON, DESCENT };

  // Iterates to the solution. \pre supports and control points are satisfied
  bool converge(Method method, const Vector& force, const Vector& points, double tolerance, Vector& u)
  {
    // The rest of a large step is stretch, not rotation, and would keep the next step from converging.
    constexpr double accuracy_of_large_steps = 1e-3, accuracy = 0.05, large = 0.2;
    double last = 0; // last residual
    for(int step = 0;
        step < (method == Method::NEWTON ? largest_number_of_steps : largest_number_of_descents); ++step) {
      Vector r = residual(force, points, u);
      if(is_too_much() || !precondition(r))
        return false;
      const double rz = r.dot(m_step.displacements), bound = scale(u, tolerance), norm = scale(u, 1);
      const double now = norm > 0 ? std::sqrt((std::max)(0., rz) / norm) : 0;
      m_state.residuals.push_back(now);
      if(!(rz > bound))
        return std::isfinite(rz);
      // From far away, the residual may grow first.
      const bool is_diverging = step > 0 && now > last && last < 1;
      if(method == Method::NEWTON && is_diverging)
        return false;
      last = now;
      const double wanted = method == Method::NEWTON && now > large ? accuracy_of_large_steps : accuracy;
      Vector d = Vector::Zero(u.size());
      const bool is_convex = add_newton_step(r, (std::max)(wanted * wanted * rz, bound / 4), d);
      if(method == Method::NEWTON) {
        if(!is_convex)
          return false;
        u += d;
        m_elements.move_by(d, u);
      } else {
        if(!descend(force, points, d, -r.dot(d), u))
          return false;
        m_elements.move(u, now > large);
      }
    }
    return false;
  }

  // Moves along a step, as far as the potential falls enough.
  bool descend(const Vector& force, const Vector& points, const Vector& d, double slope, Vector& u)
  {
    // Armijo's condition with its usual constant (Nocedal, Wright: Numerical Optimization, 2006), and up to
    // 13 halvings.
    constexpr double sufficient_decrease = 1e-4, shortest = 1e-4;
    const double before = potential(force, points, u);
    const double error = 1e-13 * (m_elements.energy() + std::abs(force.dot(u))); // rounding error
    const Vector from = u;
    for(double length = 1; length > shortest; length /= 2) {
      u = from + length * d;
      m_elements.move(u, true);
      if(potential(force, points, u) <= before + sufficient_decrease * length * slope + error)
        return true;
    }
    return false;
  }

  double potential(const Vector& force, const Vector& points, const Vector& u) const
  {
    double result = m_elements.energy() - force.dot(u);
    if(m_constraints.is_compliant())
      result += spring_forces(points, u).dot(points - m_constraints.at_points(u)) / 2;
    return result;
  }

  // Predicts displacements that satisfy supports and control points, by the tangent at the last
  // displacements.
  Result predict(const Vector& force, const Vector& points, const Vector& supports, double accuracy,
                 Vector& u)
  {
    Vector d = supports - supported(u);
    Vector r = residual(force, points, u);
    if(d.squaredNorm() > 0)
      r -= tangent_times(d);
    m_step.forces = Vector::Zero(points.size());
    const bool is_exact = !m_constraints.is_compliant();
    const Result result = solve_linear(r, is_exact ? (points - m_constraints.at_points(u + d)).eval()
                                                   : Vector::Zero(points.size()).eval());
    if(!result.is_success())
      return result;
    d += m_step.displacements;
    // The result is no better than the linear solution at the first time, when the tangent is the stiffness
    // itself.
    r = m_body.supports().free_part(residual(force, points, u) - tangent_times(d));
    if(!precondition(r))
      return failed(Status::SOLVER_FAILED);
    add_newton_step(r, accuracy * accuracy * d.dot(tangent_times(d)), d);
    u += d;
    m_elements.move_by(d, u);
    return Result();
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_INTERNAL_COROTATIONAL_SOLUTION_H
