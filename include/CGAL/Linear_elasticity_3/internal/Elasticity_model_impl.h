// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_LINEAR_ELASTICITY_3_INTERNAL_ELASTICITY_MODEL_IMPL_H
#define CGAL_LINEAR_ELASTICITY_3_INTERNAL_ELASTICITY_MODEL_IMPL_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <CGAL/Linear_elasticity_3/Linear_elasticity_result_3.h>
#include <CGAL/Linear_elasticity_3/internal/Control_points.h>
#include <CGAL/Linear_elasticity_3/internal/Corotational_elements.h>
#include <CGAL/Linear_elasticity_3/internal/Elastic_body.h>
#include <CGAL/Linear_elasticity_3/internal/Elastic_stiffness.h>
#include <CGAL/Linear_elasticity_3/internal/Elasticity_model.h>
#include <CGAL/Linear_elasticity_3/internal/boundary_measures.h>
#include <CGAL/Linear_elasticity_3/internal/compiled.h>
#include <CGAL/Linear_elasticity_3/internal/contact.h>
#include <CGAL/Linear_elasticity_3/internal/control_constraints.h>
#include <CGAL/Linear_elasticity_3/internal/corotational_solution.h>
#include <CGAL/Linear_elasticity_3/internal/removal.h>
#include <CGAL/Mixed_mesh_3/Elastic_material.h>
#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/certificate.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <CGAL/assertions.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Three components each.
inline std::vector<Vec3> vectors_of(const Eigen::VectorXd& x)
{
  std::vector<Vec3> result(std::size_t(x.size() / 3));
  for(std::size_t i = 0; i < result.size(); ++i)
    for(int k = 0; k < 3; ++k)
      result[i][k] = x[Eigen::Index(3 * i) + k];
  return result;
}

CGAL_LINEAR_ELASTICITY_3_INLINE
Elasticity_model::Elasticity_model(const Element_list& elements, std::vector<Vec3> points,
                                   std::vector<Elastic_material> materials,
                                   std::unique_ptr<Elasticity_solver> solver)
  : m_body(
    std::make_unique<Elastic_body>(elements, std::move(points), std::move(materials), std::move(solver))),
    m_controls(std::make_unique<Control_points>()), m_state(std::make_unique<Corotational_state>())
{
}

CGAL_LINEAR_ELASTICITY_3_INLINE Elasticity_model::Elasticity_model(Elasticity_model&&) noexcept = default;
CGAL_LINEAR_ELASTICITY_3_INLINE Elasticity_model&
Elasticity_model::operator=(Elasticity_model&&) noexcept = default;
CGAL_LINEAR_ELASTICITY_3_INLINE Elasticity_model::~Elasticity_model() = default;

CGAL_LINEAR_ELASTICITY_3_INLINE Elasticity_solver& Elasticity_model::solver() { return m_body->solver(); }

CGAL_LINEAR_ELASTICITY_3_INLINE const std::vector<bool>& Elasticity_model::removed_elements() const
{
  return m_body->stiffness().removed_elements();
}

CGAL_LINEAR_ELASTICITY_3_INLINE std::size_t Elasticity_model::number_of_control_points() const
{
  return m_controls->positions().size();
}

CGAL_LINEAR_ELASTICITY_3_INLINE bool Elasticity_model::is_factored() const { return m_body->is_assembled(); }

CGAL_LINEAR_ELASTICITY_3_INLINE const std::vector<double>& Elasticity_model::residuals() const
{
  return m_state->residuals;
}

CGAL_LINEAR_ELASTICITY_3_INLINE void
Elasticity_model::set_quadratic_elements(const std::vector<bool>& is_quadratic)
{
  energy(); // of the last displacements, in the body as it was
  m_body->set_quadratic_elements(is_quadratic);
  m_edge_coefficients.clear(); // those of other edges
}

CGAL_LINEAR_ELASTICITY_3_INLINE void
Elasticity_model::set_quadratic_within(double distance, const std::vector<bool>& of_elements)
{
  const Elastic_stiffness& stiffness = m_body->stiffness();
  std::vector<bool> is_other = of_elements;
  is_other.flip();
  const Located_elements located(stiffness.elements(), stiffness.points(), is_other);
  std::vector<bool> is_near(stiffness.number_of_vertices(), false);
  if(std::find(of_elements.begin(), of_elements.end(), true) != of_elements.end())
    for(Vertex_index v = 0; v < is_near.size(); ++v)
      is_near[v] = located.nearest(stiffness.points()[v]).distance <= distance;
  std::vector<bool> is_quadratic = of_elements;
  for(Element_index e = 0; e < is_quadratic.size(); ++e)
    for(Vertex_index v : stiffness.elements()[e])
      is_quadratic[e] = is_quadratic[e] || is_near[v];
  set_quadratic_elements(is_quadratic);
}

CGAL_LINEAR_ELASTICITY_3_INLINE const std::vector<std::array<Vertex_index, 2>>&
Elasticity_model::quadratic_edges() const
{
  return m_body->stiffness().nodes().ends();
}

CGAL_LINEAR_ELASTICITY_3_INLINE void Elasticity_model::prescribe(Vertex_index v, const Vec3& displacement)
{
  m_body->supports().prescribe(v, displacement);
}

CGAL_LINEAR_ELASTICITY_3_INLINE void
Elasticity_model::prescribe_boundary(const std::function<std::optional<Vec3>(const Vec3&)>& displacement)
{
  const Elastic_stiffness& stiffness = m_body->stiffness();
  const std::vector<Vec3>& points = stiffness.points();
  const std::vector<Face> faces = boundary_faces(
    Elements_of_vertices(stiffness.elements(), stiffness.number_of_vertices()));
  std::vector<std::optional<Vec3>> at_vertices(points.size());
  for(Vertex_index v : vertices_of(faces))
    if(at_vertices[v] = displacement(points[v]); at_vertices[v])
      m_body->supports().prescribe(v, *at_vertices[v]);
  for(const Face& face : faces)
    for(int i = 0; i < face.vertices().size(); ++i) {
      const auto [v,
                  w] = std::minmax({face.vertices()[i], face.vertices()[(i + 1) % face.vertices().size()]});
      std::optional<Vec3> middle = displacement(0.5 * (points[v] + points[w]));
      if(at_vertices[v] && at_vertices[w]) {
        if(middle)
          middle = *middle - 0.5 * (*at_vertices[v] + *at_vertices[w]);
        m_body->supports().prescribe_edge({v, w}, middle);
      } else if(middle) {
        m_body->supports().prescribe_middle({v, w}, *middle);
      }
    }
}

CGAL_LINEAR_ELASTICITY_3_INLINE void Elasticity_model::slide(Vertex_index v, const Vec3& normal)
{
  m_body->supports().slide(v, normal);
}

CGAL_LINEAR_ELASTICITY_3_INLINE void Elasticity_model::touch(Vertex_index v, const Vec3& normal, double gap)
{
  m_body->supports().touch(v, normal, gap);
}

CGAL_LINEAR_ELASTICITY_3_INLINE void Elasticity_model::set_body_forces(std::vector<Vec3> forces)
{
  m_body->set_body_forces(std::move(forces));
}

CGAL_LINEAR_ELASTICITY_3_INLINE void Elasticity_model::set_gravity(const Vec3& acceleration)
{
  m_body->set_gravity(acceleration);
}

CGAL_LINEAR_ELASTICITY_3_INLINE void Elasticity_model::set_support_displacement(Vertex_index v,
                                                                                const Vec3& displacement)
{
  m_body->set_support_displacement(v, displacement);
}

CGAL_LINEAR_ELASTICITY_3_INLINE void Elasticity_model::set_corotational(bool is_corotational)
{
  m_is_corotational = is_corotational;
  *m_state = Corotational_state();
  m_number_of_iterations = 0;
}

CGAL_LINEAR_ELASTICITY_3_INLINE void
Elasticity_model::slide_along_boundary(const std::function<bool(Vertex_index)>& is_sliding)
{
  const Elastic_stiffness& stiffness = m_body->stiffness();
  const std::vector<Vec3> normals = boundary_vertex_normals(stiffness.elements(), stiffness.points());
  for(Vertex_index v = 0; v < normals.size(); ++v)
    if(norm(normals[v]) > 0 && is_sliding(v))
      m_body->supports().slide(v, normals[v]);
}

CGAL_LINEAR_ELASTICITY_3_INLINE void
Elasticity_model::touch_along_boundary(const std::function<bool(Vertex_index)>& is_touching, double gap)
{
  const Elastic_stiffness& stiffness = m_body->stiffness();
  const std::vector<Vec3> normals = boundary_vertex_normals(stiffness.elements(), stiffness.points());
  for(Vertex_index v = 0; v < normals.size(); ++v)
    if(norm(normals[v]) > 0 && is_touching(v))
      m_body->supports().touch(v, normals[v], gap);
}

CGAL_LINEAR_ELASTICITY_3_INLINE Linear_elasticity_result_3 Elasticity_model::factor()
{
  m_body->clear();
  m_corotational.reset();
  *m_state = Corotational_state();
  m_controls->forget_elements();
  if(m_body->stiffness().is_all_removed())
    return failed(Status::NO_ELEMENTS);
  if(!is_order_supported())
    return failed(Status::ORDER_NOT_SUPPORTED);
  Result result;
  result.element = m_body->stiffness().find_inverted_element();
  if(result.element != m_body->stiffness().elements().size())
    return failed(Status::INVERTED_ELEMENT, result);
  m_body->assemble();
  return factor_system();
}

CGAL_LINEAR_ELASTICITY_3_INLINE Linear_elasticity_result_3
Elasticity_model::remove_elements(const std::vector<bool>& is_removed)
{
  energy(); // of the last displacements, in the body as it was
  m_body->subtract(is_removed);
  m_corotational.reset();
  m_controls->forget_elements();
  if(m_body->stiffness().is_all_removed()) {
    m_body->clear();
    return failed(Status::NO_ELEMENTS);
  }
  const std::vector<std::size_t> before = m_body->supports().numbers_of_free_motions();
  m_body->find_parts();
  m_is_iterative = m_body->supports().numbers_of_free_motions() == before
                   && m_controls->options().compliance == 0 && m_controls->are_on(*m_body);
  return m_is_iterative ? Result() : factor_system();
}

CGAL_LINEAR_ELASTICITY_3_INLINE Linear_elasticity_result_3
Elasticity_model::set_control_points(std::vector<Vec3> points, const Control_options& options)
{
  m_controls->clear(options);
  m_control_forces = m_control_residuals = Eigen::VectorXd();
  if(m_is_iterative)
    if(const Result result = factor_system(); !result.is_success())
      return result;
  return m_controls->place(*m_body, std::move(points));
}

CGAL_LINEAR_ELASTICITY_3_INLINE Linear_elasticity_result_3
Elasticity_model::solve(const std::vector<Vec3>& displacements)
{
  Eigen::VectorXd wanted(3 * Eigen::Index(displacements.size()));
  for(std::size_t i = 0; i < displacements.size(); ++i)
    for(int k = 0; k < 3; ++k)
      wanted[Eigen::Index(3 * i) + k] = displacements[i][k];
  if(!is_order_supported()) // contacts or finite rotations may have been asked for since `factor()`
    return failed(Status::ORDER_NOT_SUPPORTED);
  // What is too inexact to tell which contacts pull.
  if(m_is_iterative && has_contacts())
    if(const Result result = factor_again(); !result.is_success())
      return result;
  const bool is_at_start = !m_body->supports().are_contacts_changed();
  Result result = solve_contacts(wanted);
  if(!is_at_start && may_start_anew(result)) {
    m_body->supports().reset_contacts();
    if(result = factor_again(); result.is_success())
      result = solve_contacts(wanted);
  }
  if(may_start_anew(result)) { // the next loads should not
    m_body->supports().reset_contacts();
    factor_again();
  }
  return result;
}

CGAL_LINEAR_ELASTICITY_3_INLINE Vec3 Elasticity_model::displacement(const Element_location_3& location) const
{
  const Element_nodes& nodes = m_body->stiffness().nodes();
  const std::size_t n = nodes.number_of_vertices();
  Vec3 u{};
  for(const auto& [node, weight] :
      node_weights(nodes.elements()[location.element], nodes[location.element], location))
    u = u + weight * (node < n ? m_displacements[node] : m_edge_coefficients[node - n]);
  return u;
}

CGAL_LINEAR_ELASTICITY_3_INLINE std::vector<Vec3> Elasticity_model::control_forces() const
{
  return vectors_of(m_control_forces);
}

CGAL_LINEAR_ELASTICITY_3_INLINE std::vector<Vec3> Elasticity_model::control_residuals() const
{
  return vectors_of(m_control_residuals);
}

CGAL_LINEAR_ELASTICITY_3_INLINE std::vector<Control_weights> Elasticity_model::control_weights() const
{
  if(!m_controls->has_constraints())
    return {};
  std::vector<Control_weights> all = m_controls->constraints().weights();
  for(Control_weights& weights : all)
    weights = add_to_ends(m_body->stiffness().nodes(), 0.5, std::move(weights));
  return all;
}

CGAL_LINEAR_ELASTICITY_3_INLINE std::vector<Vec3> Elasticity_model::held_directions(Vertex_index v) const
{
  const Support& support = m_body->supports().of_vertices()[v];
  return {support.directions.begin(), support.directions.begin() + support.size};
}

CGAL_LINEAR_ELASTICITY_3_INLINE std::vector<Vec3> Elasticity_model::leave_one_out_errors() const
{
  CGAL_precondition(!m_is_iterative && m_controls->has_constraints()
                    && m_control_forces.size() == 3 * Eigen::Index(number_of_control_points()));
  return vectors_of(m_controls->constraints().leave_one_out(m_control_forces));
}

CGAL_LINEAR_ELASTICITY_3_INLINE Linear_elasticity_result_3 Elasticity_model::factor_again()
{
  m_body->find_parts();
  return factor_system();
}

CGAL_LINEAR_ELASTICITY_3_INLINE bool Elasticity_model::has_contacts() const
{
  return !m_body->supports().contacts().empty();
}

CGAL_LINEAR_ELASTICITY_3_INLINE bool Elasticity_model::is_order_supported() const
{
  return !m_body->stiffness().nodes().has_edges()
         || !(has_contacts() || m_is_corotational || m_body->solver().wants_near_kernel());
}

CGAL_LINEAR_ELASTICITY_3_INLINE bool Elasticity_model::may_start_anew(const Result& result) const
{
  return !result.is_success() && result.status != Status::INVERTED_ELEMENT
         && m_body->supports().are_contacts_changed();
}

CGAL_LINEAR_ELASTICITY_3_INLINE Linear_elasticity_result_3
Elasticity_model::solve_contacts(const Eigen::VectorXd& wanted)
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
    if(!has_contacts()) {
      keep(solution, wanted, Eigen::VectorXd());
      return m_is_corotational ? inverted_element() : result;
    }
    const Eigen::VectorXd internal = internal_forces(solution.displacements),
                          reaction = reaction_of(internal, solution);
    if(!update_contacts(m_body->supports(), solution.displacements, reaction,
                        internal.lpNorm<Eigen::Infinity>(),
                        m_is_corotational ? corotational_contact_tolerance : contact_tolerance,
                        round < largest_number_of_rounds / 2)) {
      keep(solution, wanted, reaction);
      return m_is_corotational ? inverted_element() : result;
    }
    if(result = factor_again(); !result.is_success())
      return result;
  }
  return failed(Status::NOT_CONVERGED);
}

CGAL_LINEAR_ELASTICITY_3_INLINE Linear_elasticity_result_3 Elasticity_model::failed(Status status,
                                                                                    Result result)
{
  result.status = status;
  return result;
}

CGAL_LINEAR_ELASTICITY_3_INLINE void Elasticity_model::keep(const Control_solution& solution,
                                                            const Eigen::VectorXd& wanted,
                                                            const Eigen::VectorXd& reaction)
{
  m_control_forces = solution.forces;
  m_control_residuals = wanted - m_controls->constraints().at_points(solution.displacements);
  m_contact_forces.assign(m_body->stiffness().number_of_vertices(), 0);
  for(const auto& [v, contact] : m_body->supports().contacts())
    if(contact.is_closed && m_body->supports().is_kept(v))
      m_contact_forces[v] = (std::max)(0., contact_force(m_body->supports(), v, contact, reaction));
  m_displacements = vectors_of(solution.displacements);
  for(Vertex_index v = 0; v < m_displacements.size(); ++v)
    if(!m_body->supports().is_kept(v))
      m_displacements[v] = Vec3{};
  const auto first_edge = m_displacements.begin() + std::ptrdiff_t(m_body->stiffness().number_of_vertices());
  m_edge_coefficients.assign(first_edge, m_displacements.end());
  m_displacements.erase(first_edge, m_displacements.end());
  add_means(-1, m_edge_coefficients);
  m_energy.reset();
  if(m_is_corotational)
    m_energy = m_corotational->energy();
}

// Adds the mean displacement of both ends, times a factor, to the values of edges whose middle is prescribed.
CGAL_LINEAR_ELASTICITY_3_INLINE void Elasticity_model::add_means(double factor,
                                                                 std::vector<Vec3>& of_edges) const
{
  const Element_nodes& nodes = m_body->stiffness().nodes();
  for(std::size_t i = 0; i < of_edges.size(); ++i) {
    const Vertex_index node = Vertex_index(nodes.number_of_vertices() + i);
    if(!nodes.is_middle(node) || !m_body->supports().is_kept(node))
      continue;
    const auto& [v, w] = nodes.ends()[i];
    of_edges[i] = of_edges[i] + (factor / 2) * (m_displacements[v] + m_displacements[w]);
  }
}

// A product with the stiffness takes longer than a solution with its factor.
CGAL_LINEAR_ELASTICITY_3_INLINE double Elasticity_model::energy() const
{
  if(!m_energy) {
    std::vector<Vec3> of_edges = m_edge_coefficients;
    add_means(1, of_edges);
    Eigen::VectorXd u(3 * Eigen::Index(m_displacements.size() + of_edges.size()));
    Eigen::Index i = 0;
    for(const std::vector<Vec3>* values : {&std::as_const(m_displacements), &std::as_const(of_edges)})
      for(const Vec3& value : *values)
        for(int k = 0; k < 3; ++k)
          u[i++] = value[k];
    m_energy = u.dot(m_body->stiffness().product(u)) / 2;
  }
  return *m_energy;
}

CGAL_LINEAR_ELASTICITY_3_INLINE bool Elasticity_model::open_contacts_of_controls()
{
  bool is_changed = false;
  const auto& contacts = m_body->supports().contacts();
  for(const Control_weights& weights : m_controls->constraints().weights())
    for(const auto& weight : weights)
      if(const auto contact = contacts.find(weight.first);
         contact != contacts.end() && contact->second.is_closed) {
        m_body->supports().set_closed(weight.first, false);
        is_changed = true;
      }
  return is_changed;
}

CGAL_LINEAR_ELASTICITY_3_INLINE Linear_elasticity_result_3
Elasticity_model::solve_held(const Eigen::VectorXd& wanted, Control_solution& solution)
{
  if(!m_body->solve_loads())
    return failed(Status::SOLVER_FAILED);
  if(const Result result = m_controls->prepare(*m_body); !result.is_success())
    return result;
  Result result = m_is_corotational
                    ? solve_corotational(wanted, solution)
                    : m_controls->constraints().solve(m_body->loaded(), m_body->load(), wanted,
                                                      m_body->system().free_motions(), solution);
  if(m_is_iterative && !m_is_corotational && result.is_success()) {
    Removal removal(*m_body, m_controls->constraints());
    if(!removal.solve(wanted, m_iteration_tolerance, solution))
      result = failed(Status::SOLVER_FAILED);
    m_number_of_iterations = removal.number_of_iterations();
  }
  const bool may_do_better = result.status == Status::SOLVER_FAILED || result.status == Status::NOT_CONVERGED;
  if(!m_is_iterative || !may_do_better)
    return result;
  result = factor_system();
  return result.is_success() ? solve_held(wanted, solution) : result;
}

CGAL_LINEAR_ELASTICITY_3_INLINE Eigen::VectorXd
Elasticity_model::internal_forces(const Eigen::VectorXd& displacements) const
{
  return m_is_corotational ? m_corotational->forces() : m_body->stiffness().product(displacements);
}

CGAL_LINEAR_ELASTICITY_3_INLINE Eigen::VectorXd
Elasticity_model::reaction_of(const Eigen::VectorXd& internal, const Control_solution& solution) const
{
  Eigen::VectorXd loads = m_body->force();
  m_controls->constraints().add_forces(solution.forces, loads);
  return internal - loads;
}

CGAL_LINEAR_ELASTICITY_3_INLINE Linear_elasticity_result_3
Elasticity_model::solve_corotational(const Eigen::VectorXd& wanted, Control_solution& solution)
{
  if(!m_corotational)
    m_corotational = std::make_unique<Corotational_elements>(m_body->stiffness());
  const Eigen::Index n = 3 * Eigen::Index(m_body->stiffness().number_of_vertices());
  if(m_state->displacements.size() == 0)
    m_state->displacements = m_state->force = Eigen::VectorXd::Zero(n);
  Corotational_solution corotational(*m_body, m_controls->constraints(), *m_corotational, *m_state);
  const double tolerance = has_contacts()
                             ? (std::min)(m_iteration_tolerance, 0.1 * corotational_contact_tolerance)
                             : m_iteration_tolerance;
  const Result result = corotational.solve(wanted, tolerance, solution);
  m_number_of_iterations = m_state->number_of_iterations;
  if(!result.is_success())
    m_state->displacements.resize(0); // the next one starts at rest
  return result;
}

CGAL_LINEAR_ELASTICITY_3_INLINE Linear_elasticity_result_3 Elasticity_model::inverted_element() const
{
  const Elastic_stiffness& stiffness = m_body->stiffness();
  const auto moved = [&](Vertex_index v) { return stiffness.points()[v] + m_displacements[v]; };
  Result result;
  for(Element_index e = 0; e < stiffness.elements().size(); ++e)
    if(!stiffness.is_removed(e) && jacobian_sign(stiffness.elements()[e], moved) != Jacobian_sign::POSITIVE) {
      result.element = e;
      return failed(Status::INVERTED_ELEMENT, result);
    }
  return result;
}

CGAL_LINEAR_ELASTICITY_3_INLINE Linear_elasticity_result_3 Elasticity_model::factor_system()
{
  m_is_iterative = false;
  m_controls->forget_constraints();
  if(!m_body->factor())
    return failed(Status::SOLVER_FAILED);
  if(m_controls->positions().empty())
    return Result();
  const Control_options options = m_controls->options();
  return set_control_points(m_controls->positions(), options);
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_INTERNAL_ELASTICITY_MODEL_IMPL_H
