// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What Linear_elasticity_3 does, in which order: factor, place control points, remove elements, solve.
// Neither the kernel of the mesh nor the class of the solver is known here, so that it is compiled once;
// parts are on the heap, so that programs need not compile their headers.

#ifndef CGAL_LINEAR_ELASTICITY_3_INTERNAL_ELASTICITY_MODEL_H
#define CGAL_LINEAR_ELASTICITY_3_INTERNAL_ELASTICITY_MODEL_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <CGAL/Linear_elasticity_3/Linear_elasticity_result_3.h>
#include <CGAL/Linear_elasticity_3/internal/Control_options.h>
#include <CGAL/Linear_elasticity_3/internal/Elasticity_solver.h>
#include <CGAL/Mixed_mesh_3/Elastic_material.h>
#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/Element_location_3.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

class Control_points;
class Corotational_elements;
class Elastic_body;
struct Control_solution;
struct Corotational_state;

class Elasticity_model
{
  using Result = Linear_elasticity_result_3;
  using Status = Linear_elasticity_status;

  static constexpr int largest_number_of_rounds = 60; // of contacts; five to ten are usual
  // Relative to the largest force; that of a contact may be far smaller. 1e-9 is 10^7 roundings of 2^-53; the
  // iteration of corotational solutions ends at a tenth of 1e-6.
  static constexpr double contact_tolerance = 1e-9, corotational_contact_tolerance = 1e-6;

  std::unique_ptr<Elastic_body> m_body;
  std::unique_ptr<Control_points> m_controls;
  bool m_is_iterative = false; // as elements have been removed since the body was factored
  double m_iteration_tolerance = 1e-3;
  int m_number_of_iterations = 0; // of the last solution
  bool m_is_corotational = false;
  std::unique_ptr<Corotational_elements> m_corotational; // of the elements that are left, when needed
  std::unique_ptr<Corotational_state> m_state;
  // of the last solution
  Eigen::VectorXd m_control_forces, m_control_residuals;
  std::vector<Vec3> m_displacements, m_edge_coefficients;
  std::vector<double> m_contact_forces;       // of vertices
  mutable std::optional<double> m_energy = 0; // of the last displacements; computed when asked for

public:
  /// \param elements kept by reference: must outlive the object
  /// \param points of all vertices
  /// \param materials one for all elements, or one for each
  Elasticity_model(const Element_list& elements, std::vector<Vec3> points,
                   std::vector<Elastic_material> materials, std::unique_ptr<Elasticity_solver> solver);
  Elasticity_model(Elasticity_model&&) noexcept;
  Elasticity_model& operator=(Elasticity_model&&) noexcept;
  ~Elasticity_model();

  Elasticity_solver& solver();
  const std::vector<bool>& removed_elements() const;
  std::size_t number_of_control_points() const;
  bool is_factored() const;
  bool is_iterative() const { return m_is_iterative; }
  void set_iteration_tolerance(double tolerance) { m_iteration_tolerance = tolerance; }
  int number_of_iterations() const
  {
    return m_is_iterative || m_is_corotational ? m_number_of_iterations : 0;
  }
  bool is_corotational() const { return m_is_corotational; }
  void set_corotational(bool is_corotational);
  const std::vector<double>& residuals() const;

  /// Sets the elements whose displacements are quadratic; none if empty.
  void set_quadratic_elements(const std::vector<bool>& is_quadratic);
  /// Has those elements quadratic that have a vertex within a distance of some elements.
  void set_quadratic_within(double distance, const std::vector<bool>& of_elements);
  /// Both ends of each edge with a coefficient, the smaller one first.
  const std::vector<std::array<Vertex_index, 2>>& quadratic_edges() const;
  const std::vector<Vec3>& edge_coefficients() const { return m_edge_coefficients; }

  void prescribe(Vertex_index v, const Vec3& displacement);
  /// \param displacement displacement of a point of the boundary, if it is held
  void prescribe_boundary(const std::function<std::optional<Vec3>(const Vec3&)>& displacement);
  void slide(Vertex_index v, const Vec3& normal);
  void slide_along_boundary(const std::function<bool(Vertex_index)>& is_sliding);
  void touch(Vertex_index v, const Vec3& normal, double gap);
  void touch_along_boundary(const std::function<bool(Vertex_index)>& is_touching, double gap);

  Result factor();
  Result remove_elements(const std::vector<bool>& is_removed);

  /// \param forces one for all elements, or one for each
  void set_body_forces(std::vector<Vec3> forces);
  void set_gravity(const Vec3& acceleration);
  void set_support_displacement(Vertex_index v, const Vec3& displacement);
  Result set_control_points(std::vector<Vec3> points, const Control_options& options);

  /// \param displacements of the control points
  Result solve(const std::vector<Vec3>& displacements);

  const std::vector<Vec3>& displacements() const { return m_displacements; }
  /// The displacement at a point of an element.
  Vec3 displacement(const Element_location_3& location) const;
  std::vector<Vec3> control_forces() const;
  std::vector<Vec3> control_residuals() const;
  std::vector<Control_weights> control_weights() const;
  std::vector<Vec3> held_directions(Vertex_index v) const;
  const std::vector<double>& contact_forces() const { return m_contact_forces; }
  double energy() const;

  /// \pre solved, not iteratively, since control points and supports were set
  std::vector<Vec3> leave_one_out_errors() const;

private:
  // For contacts that have changed.
  Result factor_again();
  bool has_contacts() const;
  // Whether quadratic displacements can be had with everything else that was asked for.
  bool is_order_supported() const;
  // Whether it failed with other contacts than at first.
  bool may_start_anew(const Result& result) const;
  // From the contacts as they are.
  Result solve_contacts(const Eigen::VectorXd& wanted);
  static Result failed(Status status, Result result = Result());
  // \param reaction needed if there are contacts
  void add_means(double factor, std::vector<Vec3>& of_edges) const;
  void keep(const Control_solution& solution, const Eigen::VectorXd& wanted, const Eigen::VectorXd& reaction);
  // Contacts hold what is to be pulled off the wall; if it is to be pushed into it, they close again.
  bool open_contacts_of_controls();
  // With the contacts as they are. What goes wrong with the factor of the body before a removal may go well
  // with its own.
  Result solve_held(const Eigen::VectorXd& wanted, Control_solution& solution);
  Eigen::VectorXd internal_forces(const Eigen::VectorXd& displacements) const;
  // What supports bear.
  Eigen::VectorXd reaction_of(const Eigen::VectorXd& internal, const Control_solution& solution) const;
  Result solve_corotational(const Eigen::VectorXd& wanted, Control_solution& solution);
  // Where the last displacements invert an element, by the certificate.
  Result inverted_element() const;
  // Factors the stiffness as it is, and locates the control points anew.
  Result factor_system();
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#ifndef CGAL_LINEAR_ELASTICITY_3_COMPILED
#include <CGAL/Linear_elasticity_3/internal/Elasticity_model_impl.h>
#endif

#endif // CGAL_LINEAR_ELASTICITY_3_INTERNAL_ELASTICITY_MODEL_H
