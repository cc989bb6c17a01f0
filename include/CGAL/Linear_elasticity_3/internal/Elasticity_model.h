// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What Linear_elasticity_3 does, in which order: factor, place control points, remove elements, solve.

#ifndef CGAL_LINEAR_ELASTICITY_3_INTERNAL_ELASTICITY_MODEL_H
#define CGAL_LINEAR_ELASTICITY_3_INTERNAL_ELASTICITY_MODEL_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <CGAL/Linear_elasticity_3/Linear_elasticity_result_3.h>
#include <CGAL/Linear_elasticity_3/internal/Control_points.h>
#include <CGAL/Linear_elasticity_3/internal/Corotational_elements.h>
#include <CGAL/Linear_elasticity_3/internal/Elastic_body.h>
#include <CGAL/Linear_elasticity_3/internal/boundary_measures.h>
#include <CGAL/Linear_elasticity_3/internal/contact.h>
#include <CGAL/Linear_elasticity_3/internal/control_constraints.h>
#include <CGAL/Linear_elasticity_3/internal/corotational_solution.h>
#include <CGAL/Linear_elasticity_3/internal/removal.h>
#include <CGAL/Mixed_mesh_3/Elastic_material.h>
#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/Element_locator_3.h>
#include <CGAL/Mixed_mesh_3/certificate.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <CGAL/assertions.h>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Of whatever has components `[0]`, `[1]`, `[2]`.
template <class Range>
std::vector<Vec3> vectors(const Range& range)
{
  std::vector<Vec3> result;
  for(const auto& x : range)
    result.push_back(components(x));
  return result;
}

template <class Mesh, class SolverTraits>
class Elasticity_model
{
  using Result = Linear_elasticity_result_3;
  using Status = Linear_elasticity_status;

  static constexpr int largest_number_of_rounds = 60; // of contacts; five to ten are usual
  // Relative to the largest force; that of a contact may be far smaller.
  static constexpr double contact_tolerance = 1e-9, corotational_contact_tolerance = 1e-6;

  const Mesh* m_mesh;
  Elastic_body<SolverTraits> m_body;
  Control_points<Mesh> m_controls;
  bool m_is_iterative = false; // as elements have been removed since the body was factored
  double m_iteration_tolerance = 1e-3;
  int m_number_of_iterations = 0; // of the last solution
  bool m_is_corotational = false;
  std::optional<Corotational_elements> m_corotational; // of the elements that are left, when needed
  Corotational_state m_state;
  // of the last solution
  Eigen::VectorXd m_control_forces, m_control_residuals;
  std::vector<Vec3> m_displacements;
  std::vector<double> m_contact_forces; // of vertices
  double m_energy = 0;

public:
  Elasticity_model(const Mesh& mesh, std::vector<Elastic_material> materials)
    : m_mesh(&mesh), m_body(mesh.elements(), points_of(mesh), std::move(materials))
  {
  }

  const Mesh& mesh() const { return *m_mesh; }
  Elastic_body<SolverTraits>& body() { return m_body; }
  const Elastic_body<SolverTraits>& body() const { return m_body; }
  std::size_t number_of_control_points() const { return m_controls.positions().size(); }
  bool is_iterative() const { return m_is_iterative; }
  void set_iteration_tolerance(double tolerance) { m_iteration_tolerance = tolerance; }
  int number_of_iterations() const
  {
    return m_is_iterative || m_is_corotational ? m_number_of_iterations : 0;
  }
  bool is_corotational() const { return m_is_corotational; }
  const std::vector<double>& residuals() const { return m_state.residuals; }

  void set_corotational(bool is_corotational)
  {
    m_is_corotational = is_corotational;
    m_state = Corotational_state();
    m_number_of_iterations = 0;
  }

  template <class Is_sliding>
  void slide_along_boundary(const Is_sliding& is_sliding)
  {
    const std::vector<Vec3> normals = boundary_vertex_normals(*m_mesh, m_body.stiffness().points());
    for(Vertex_index v = 0; v < normals.size(); ++v)
      if(norm(normals[v]) > 0 && is_sliding(v))
        m_body.supports().slide(v, normals[v]);
  }

  template <class Is_touching>
  void touch_along_boundary(const Is_touching& is_touching, double gap)
  {
    const std::vector<Vec3> normals = boundary_vertex_normals(*m_mesh, m_body.stiffness().points());
    for(Vertex_index v = 0; v < normals.size(); ++v)
      if(norm(normals[v]) > 0 && is_touching(v))
        m_body.supports().touch(v, normals[v], gap);
  }

  Result factor()
  {
    m_body.clear();
    m_corotational.reset();
    m_state = Corotational_state();
    m_controls.forget_elements();
    if(m_body.stiffness().is_all_removed())
      return failed(Status::NO_ELEMENTS);
    Result result;
    result.element = m_body.stiffness().find_inverted_element();
    if(result.element != m_mesh->number_of_elements())
      return failed(Status::INVERTED_ELEMENT, result);
    m_body.assemble();
    return factor_system();
  }

  Result remove_elements(const std::vector<bool>& is_removed)
  {
    m_body.subtract(is_removed);
    m_corotational.reset();
    m_controls.forget_elements();
    if(m_body.stiffness().is_all_removed()) {
      m_body.clear();
      return failed(Status::NO_ELEMENTS);
    }
    const std::vector<std::size_t> before = m_body.supports().numbers_of_free_motions();
    m_body.find_parts();
    m_is_iterative = m_body.supports().numbers_of_free_motions() == before
                     && m_controls.options().compliance == 0 && m_controls.are_on(m_body);
    return m_is_iterative ? Result() : factor_system();
  }

  Result set_control_points(std::vector<Vec3> points, const Control_options& options)
  {
    m_controls.clear(options);
    m_control_forces = m_control_residuals = Eigen::VectorXd();
    if(m_is_iterative)
      if(const Result result = factor_system(); !result.is_success())
        return result;
    return m_controls.place(*m_mesh, m_body, std::move(points));
  }

  /// \param displacements of the control points
  Result solve(const std::vector<Vec3>& displacements)
  {
    Eigen::VectorXd wanted(3 * Eigen::Index(displacements.size()));
    for(std::size_t i = 0; i < displacements.size(); ++i)
      for(int k = 0; k < 3; ++k)
        wanted[Eigen::Index(3 * i) + k] = displacements[i][k];
    // What is too inexact to tell which contacts pull.
    if(m_is_iterative && has_contacts())
      if(const Result result = factor_again(); !result.is_success())
        return result;
    const bool is_at_start = !m_body.supports().are_contacts_changed();
    Result result = solve_contacts(wanted);
    if(!is_at_start && may_start_anew(result)) {
      m_body.supports().reset_contacts();
      if(result = factor_again(); result.is_success())
        result = solve_contacts(wanted);
    }
    if(may_start_anew(result)) { // the next loads should not
      m_body.supports().reset_contacts();
      factor_again();
    }
    return result;
  }

  const std::vector<Vec3>& displacements() const { return m_displacements; }
  std::vector<Vec3> control_forces() const { return vectors_of(m_control_forces); }
  std::vector<Vec3> control_residuals() const { return vectors_of(m_control_residuals); }
  const std::vector<double>& contact_forces() const { return m_contact_forces; }
  double energy() const { return m_energy; }

  /// \pre solved, not iteratively, since control points and supports were set
  std::vector<Vec3> leave_one_out_errors() const
  {
    CGAL_precondition(!m_is_iterative && m_controls.has_constraints()
                      && m_control_forces.size() == 3 * Eigen::Index(number_of_control_points()));
    return vectors_of(m_controls.constraints().leave_one_out(m_control_forces));
  }

private:
  // For contacts that have changed.
  Result factor_again()
  {
    m_body.find_parts();
    return factor_system();
  }

  bool has_contacts() const { return !m_body.supports().contacts().empty(); }

  // Whether it failed with other contacts than at first.
  bool may_start_anew(const Result& result) const
  {
    return !result.is_success() && result.status != Status::INVERTED_ELEMENT
           && m_body.supports().are_contacts_changed();
  }

  // From the contacts as they are.
  Result solve_contacts(const Eigen::VectorXd& wanted)
  {
    bool may_open = true;
    for(int round = 0; round < largest_number_of_rounds; ++round) {
      Control_solution solution;
      Result result = solve_held(wanted, solution);
      if(result.status == Status::CONTRADICTORY_CONTROL_POINTS && may_open && open_contacts_of_controls()) {
        may_open = false;
        if(result = factor_again(); !result.is_success())
          return result;
        continue;
      }
      if(!result.is_success())
        return result;
      const Eigen::VectorXd internal = internal_forces(solution.displacements),
                            reaction = reaction_of(internal, solution);
      if(!update_contacts(m_body.supports(), solution.displacements, reaction,
                          internal.lpNorm<Eigen::Infinity>(),
                          m_is_corotational ? corotational_contact_tolerance : contact_tolerance,
                          round < largest_number_of_rounds / 2)) {
        keep(solution, wanted, reaction);
        m_energy = m_is_corotational ? m_corotational->energy() : solution.displacements.dot(internal) / 2;
        return m_is_corotational ? inverted_element() : result;
      }
      if(result = factor_again(); !result.is_success())
        return result;
    }
    return failed(Status::NOT_CONVERGED);
  }

  static std::vector<Vec3> points_of(const Mesh& mesh)
  {
    std::vector<Vec3> points;
    points.reserve(mesh.number_of_vertices());
    for(const auto& p : mesh.points())
      points.push_back(to_vec3(p));
    return points;
  }

  static Result failed(Status status, Result result = Result())
  {
    result.status = status;
    return result;
  }

  static std::vector<Vec3> vectors_of(const Eigen::VectorXd& x)
  {
    std::vector<Vec3> result(std::size_t(x.size() / 3));
    for(std::size_t i = 0; i < result.size(); ++i)
      for(int k = 0; k < 3; ++k)
        result[i][k] = x[Eigen::Index(3 * i) + k];
    return result;
  }

  void keep(const Control_solution& solution, const Eigen::VectorXd& wanted, const Eigen::VectorXd& reaction)
  {
    m_control_forces = solution.forces;
    m_control_residuals = wanted - m_controls.constraints().at_points(solution.displacements);
    m_contact_forces.assign(m_body.stiffness().number_of_vertices(), 0);
    for(const auto& [v, contact] : m_body.supports().contacts())
      if(contact.is_closed && m_body.supports().is_kept(v))
        m_contact_forces[v] = (std::max)(0., contact_force(m_body.supports(), v, contact, reaction));
    m_displacements.assign(m_body.stiffness().number_of_vertices(), Vec3{});
    for(Vertex_index v = 0; v < m_displacements.size(); ++v)
      if(m_body.supports().is_kept(v))
        for(int k = 0; k < 3; ++k)
          m_displacements[v][k] = solution.displacements[3 * Eigen::Index(v) + k];
  }

  // Contacts hold what is to be pulled off the wall; if it is to be pushed into it, they close again.
  bool open_contacts_of_controls()
  {
    bool is_changed = false;
    const auto& contacts = m_body.supports().contacts();
    for(const Control_weights& weights : m_controls.constraints().weights())
      for(const auto& weight : weights)
        if(const auto contact = contacts.find(weight.first);
           contact != contacts.end() && contact->second.is_closed) {
          m_body.supports().set_closed(weight.first, false);
          is_changed = true;
        }
    return is_changed;
  }

  // With the contacts as they are. What goes wrong with the factor of the body before a removal may go well
  // with its own.
  Result solve_held(const Eigen::VectorXd& wanted, Control_solution& solution)
  {
    if(!m_body.solve_loads())
      return failed(Status::SOLVER_FAILED);
    if(const Result result = m_controls.prepare(m_body); !result.is_success())
      return result;
    Result result = m_is_corotational
                      ? solve_corotational(wanted, solution)
                      : m_controls.constraints().solve(m_body.loaded(), m_body.load(), wanted,
                                                       m_body.system().free_motions(), solution);
    if(m_is_iterative && !m_is_corotational && result.is_success()
       && !solve_after_removal(m_body, m_controls.constraints(), wanted, m_iteration_tolerance, solution,
                               m_number_of_iterations))
      result = failed(Status::SOLVER_FAILED);
    const bool may_do_better = result.status == Status::SOLVER_FAILED
                               || result.status == Status::NOT_CONVERGED;
    if(!m_is_iterative || !may_do_better)
      return result;
    result = factor_system();
    return result.is_success() ? solve_held(wanted, solution) : result;
  }

  Eigen::VectorXd internal_forces(const Eigen::VectorXd& displacements) const
  {
    return m_is_corotational ? m_corotational->forces() : m_body.stiffness().product(displacements);
  }

  // What supports bear.
  Eigen::VectorXd reaction_of(const Eigen::VectorXd& internal, const Control_solution& solution) const
  {
    Eigen::VectorXd loads = m_body.force();
    m_controls.constraints().add_forces(solution.forces, loads);
    return internal - loads;
  }

  Result solve_corotational(const Eigen::VectorXd& wanted, Control_solution& solution)
  {
    if(!m_corotational)
      m_corotational.emplace(m_body.stiffness());
    const Eigen::Index n = 3 * Eigen::Index(m_body.stiffness().number_of_vertices());
    if(m_state.displacements.size() == 0)
      m_state.displacements = m_state.force = Eigen::VectorXd::Zero(n);
    Corotational_solution<SolverTraits> corotational(m_body, m_controls.constraints(), *m_corotational,
                                                     m_state);
    const double tolerance = has_contacts()
                               ? (std::min)(m_iteration_tolerance, 0.1 * corotational_contact_tolerance)
                               : m_iteration_tolerance;
    const Result result = corotational.solve(wanted, tolerance, solution);
    m_number_of_iterations = m_state.number_of_iterations;
    if(!result.is_success())
      m_state.displacements.resize(0); // the next one starts at rest
    return result;
  }

  // Where the last displacements invert an element, by the certificate.
  Result inverted_element() const
  {
    const auto moved = [this](Vertex_index v) { return to_vec3(m_mesh->point(v)) + m_displacements[v]; };
    Result result;
    for(Element_index e = 0; e < m_mesh->number_of_elements(); ++e)
      if(!m_body.stiffness().is_removed(e)
         && jacobian_sign(m_mesh->element(e), moved) != Jacobian_sign::POSITIVE) {
        result.element = e;
        return failed(Status::INVERTED_ELEMENT, result);
      }
    return result;
  }

  // Factors the stiffness as it is, and locates the control points anew.
  Result factor_system()
  {
    m_is_iterative = false;
    m_controls.forget_constraints();
    if(!m_body.factor())
      return failed(Status::SOLVER_FAILED);
    if(m_controls.positions().empty())
      return Result();
    const Control_options options = m_controls.options();
    return set_control_points(m_controls.positions(), options);
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_INTERNAL_ELASTICITY_MODEL_H
