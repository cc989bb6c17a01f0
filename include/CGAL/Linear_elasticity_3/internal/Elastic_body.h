// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// An elastic body with supports and loads, before any control points: its stiffness, its factored system, and
// the solution for the loads.

#ifndef CGAL_LINEAR_ELASTICITY_3_INTERNAL_ELASTIC_BODY_H
#define CGAL_LINEAR_ELASTICITY_3_INTERNAL_ELASTIC_BODY_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <CGAL/Linear_elasticity_3/internal/Elastic_stiffness.h>
#include <CGAL/Linear_elasticity_3/internal/Elastic_supports.h>
#include <CGAL/Linear_elasticity_3/internal/Elasticity_solver.h>
#include <CGAL/Linear_elasticity_3/internal/Projected_system.h>
#include <CGAL/Mixed_mesh_3/Elastic_material.h>
#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/fem/Element_nodes.h>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

class Elastic_body
{
  Elastic_stiffness m_stiffness;
  Elastic_supports m_supports;
  Projected_system m_system;
  std::vector<Vec3> m_body_forces{Vec3{}}; // one for all elements, or one for each
  Vec3 m_gravity{};
  bool m_is_loaded = false; // whether the vectors below are up to date
  Eigen::VectorXd m_force, m_load, m_loaded;

public:
  /// \param elements elements, kept by reference: they must outlive the object
  Elastic_body(const Element_list& elements, std::vector<Vec3> points,
               std::vector<Elastic_material> materials, std::unique_ptr<Elasticity_solver> solver)
    : m_stiffness(elements, std::move(points), std::move(materials)),
      m_supports(m_stiffness.number_of_vertices()), m_system(std::move(solver))
  {
  }

  const Elastic_stiffness& stiffness() const { return m_stiffness; }
  const Elastic_supports& supports() const { return m_supports; }
  /// The supports, to be changed before `assemble()`.
  Elastic_supports& supports() { return m_supports; }
  const Projected_system& system() const { return m_system; }
  Elasticity_solver& solver() { return m_system.solver(); }

  /// \param forces one force for all elements, or one for each
  void set_body_forces(std::vector<Vec3> forces)
  {
    m_body_forces = std::move(forces);
    m_is_loaded = false;
  }

  void set_gravity(const Vec3& acceleration)
  {
    m_gravity = acceleration;
    m_is_loaded = false;
  }

  void set_support_displacement(Vertex_index v, const Vec3& displacement)
  {
    m_supports.set_displacement(v, displacement);
    m_is_loaded = false;
  }

  /// Sets the elements whose displacements are quadratic; none if empty. The body is no longer assembled.
  void set_quadratic_elements(const std::vector<bool>& is_quadratic)
  {
    clear();
    const Element_list& elements = m_stiffness.elements();
    const std::size_t n = m_stiffness.number_of_vertices();
    m_stiffness.set_nodes(is_quadratic.empty() ? Element_nodes(elements, n)
                                               : Element_nodes(elements, n, is_quadratic));
  }

  bool is_assembled() const { return m_stiffness.is_assembled(); }

  void clear()
  {
    m_stiffness.clear();
    m_system.clear();
  }

  void assemble()
  {
    m_stiffness.set_middles(m_supports.given_middles(m_stiffness.nodes()));
    m_stiffness.assemble();
    m_supports.support_edges(m_stiffness);
    m_supports.find_parts(m_stiffness);
  }

  /// Removes elements from the stiffness; the factorization stays. \pre assembled
  void subtract(const std::vector<bool>& is_removed) { m_stiffness.subtract(is_removed); }

  /// Finds the connected parts. To be called when elements have been removed.
  void find_parts()
  {
    m_supports.find_parts(m_stiffness);
    m_is_loaded = false;
  }

  /// Factors the system. \return whether this is possible; else the body is no longer assembled
  bool factor()
  {
    m_is_loaded = false;
    m_stiffness.forget_factored();
    if(m_system.factor(m_stiffness, m_supports))
      return true;
    m_stiffness.clear();
    return false;
  }

  /// Solves for several columns of forces on all nodes.
  bool solve(const Eigen::MatrixXd& forces, Eigen::MatrixXd& displacements)
  {
    return m_system.solve(m_supports, forces, displacements);
  }

  /// Selects nodes for `solve_selected()`. \pre factored
  void select(const std::vector<Vertex_index>& nodes)
  {
    m_system.select(nodes, m_stiffness.number_of_nodes());
  }

  /// Solves for forces in free directions on the selected nodes, and returns the displacements of these,
  /// perhaps in single precision.
  bool solve_selected(const Eigen::VectorXd& forces, Eigen::VectorXd& displacements)
  {
    return m_system.solve_selected(forces, displacements);
  }

  /// Solves for body forces and supports, unless nothing has changed.
  bool solve_loads()
  {
    if(m_is_loaded)
      return true;
    const Eigen::Index n = 3 * Eigen::Index(m_stiffness.number_of_nodes());
    Eigen::VectorXd force = Eigen::VectorXd::Zero(n), supported = Eigen::VectorXd::Zero(n);
    bool is_supported = false, has_force = false;
    for(Vertex_index v = 0; v < m_stiffness.number_of_nodes(); ++v)
      if(m_supports.is_kept(v))
        for(int k = 0; k < 3; ++k) {
          const double u = m_supports.of_vertices()[v].displacement[k];
          supported[3 * Eigen::Index(v) + k] = u;
          is_supported = is_supported || u != 0;
        }
    const auto is_zero = [](const Vec3& f) { return f == Vec3{}; };
    if(m_gravity != Vec3{} || !std::all_of(m_body_forces.begin(), m_body_forces.end(), is_zero)) {
      has_force = true;
      m_stiffness.add_body_forces(m_body_forces, m_gravity, force);
    }
    m_force = force;
    if(is_supported)
      force -= m_stiffness.product(supported);
    m_load = force;
    if(has_force || is_supported) {
      Eigen::MatrixXd solution;
      if(!solve(force, solution))
        return false;
      m_loaded = solution.col(0) + supported;
    } else {
      m_loaded = Eigen::VectorXd::Zero(n);
    }
    m_is_loaded = true;
    return true;
  }

  /// \name Results of `solve_loads()`
  /// @{
  /// Body forces.
  const Eigen::VectorXd& force() const { return m_force; }
  /// The right-hand side: the body forces and the effect of displacements of supports.
  const Eigen::VectorXd& load() const { return m_load; }
  /// The displacements.
  const Eigen::VectorXd& loaded() const { return m_loaded; }
  /// @}
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_INTERNAL_ELASTIC_BODY_H
