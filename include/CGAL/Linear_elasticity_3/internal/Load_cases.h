// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The solutions of load cases on a mesh whose vertices move, and their energies.

#ifndef CGAL_LINEAR_ELASTICITY_3_INTERNAL_LOAD_CASES_H
#define CGAL_LINEAR_ELASTICITY_3_INTERNAL_LOAD_CASES_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <CGAL/Linear_elasticity_3/Mixed_mesh_adaptation_criteria_3.h>
#include <CGAL/Linear_elasticity_3/internal/Elasticity_solver.h>
#include <CGAL/Linear_elasticity_3/internal/configurational_forces.h>
#include <CGAL/Mixed_mesh_3/Elastic_material.h>
#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/fem/Elasticity_system.h>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

using Make_elasticity_solver = std::function<std::unique_ptr<Elasticity_solver>()>;

class Load_cases
{
  // Cases that prescribe the same vertices: they share a matrix.
  struct Group
  {
    std::vector<std::size_t> cases;
    Elasticity_system system;
    std::unique_ptr<Elasticity_solver> solver;
  };

  const Element_list& m_elements;
  const std::vector<Elastic_material>& m_materials;
  std::vector<Group> m_groups;
  std::vector<std::vector<Vec3>> m_displacements; // of each case, a first guess

public:
  /// \param elements kept by reference, as materials are: both must outlive the object
  /// \param materials one for all elements, or one for each
  Load_cases(const Element_list& elements, std::size_t number_of_vertices,
             const std::vector<Elastic_material>& materials,
             const std::vector<Prescribed_displacements>& cases, const Make_elasticity_solver& make_solver)
    : m_elements(elements), m_materials(materials)
  {
    std::vector<bool> is_used(number_of_vertices, false); // others would be rows of zeros
    for(Element_index e = 0; e < elements.size(); ++e)
      for(Vertex_index v : elements[e])
        is_used[v] = true;
    std::vector<std::vector<bool>> free_vertices; // of the groups
    for(std::size_t i = 0; i < cases.size(); ++i) {
      std::vector<bool> is_free = is_used;
      std::vector<Vec3>& u = m_displacements.emplace_back(number_of_vertices, Vec3{});
      for(const auto& [v, displacement] : cases[i]) {
        is_free[v] = false;
        u[v] = displacement;
      }
      const auto same = std::find(free_vertices.begin(), free_vertices.end(), is_free);
      if(same != free_vertices.end()) {
        m_groups[std::size_t(same - free_vertices.begin())].cases.push_back(i);
      } else {
        m_groups.push_back({{i}, Elasticity_system(elements, is_free), make_solver()});
        free_vertices.push_back(std::move(is_free));
      }
    }
  }

  /// The energy of the solution of each case; empty if a system cannot be factored.
  std::vector<Mesh_energy> solve(const std::vector<Vec3>& points)
  {
    std::vector<Mesh_energy> energies(m_displacements.size());
    for(Group& group : m_groups)
      if(!solve(group, points, energies))
        return {};
    return energies;
  }

private:
  // As the energy is quadratic, one step of Newton's method from any displacements is the solution.
  bool solve(Group& group, const std::vector<Vec3>& points, std::vector<Mesh_energy>& energies)
  {
    const auto evaluate = [&] {
      std::vector<const std::vector<Vec3>*> displacements;
      for(std::size_t i : group.cases)
        displacements.push_back(&m_displacements[i]);
      return mesh_energies(m_elements, points, m_materials, displacements);
    };
    const std::vector<Vertex_index>& free = group.system.free_vertices();
    if(!free.empty()) {
      Eigen::MatrixXd forces(3 * Eigen::Index(free.size()), Eigen::Index(group.cases.size())), steps;
      const std::vector<Mesh_energy> guesses = evaluate();
      for(std::size_t c = 0; c < group.cases.size(); ++c)
        for(std::size_t i = 0; i < free.size(); ++i)
          for(int k = 0; k < 3; ++k)
            forces(3 * Eigen::Index(i) + k, Eigen::Index(c)) = guesses[c].by_displacements[free[i]][k];
      if(!factor(group, points) || !group.solver->solve(forces, steps) || !steps.allFinite())
        return false;
      for(std::size_t c = 0; c < group.cases.size(); ++c) {
        std::vector<Vec3>& u = m_displacements[group.cases[c]];
        for(std::size_t i = 0; i < free.size(); ++i)
          for(int k = 0; k < 3; ++k)
            u[free[i]][k] -= steps(3 * Eigen::Index(i) + k, Eigen::Index(c));
      }
    }
    std::vector<Mesh_energy> of_group = evaluate();
    for(std::size_t c = 0; c < group.cases.size(); ++c)
      energies[group.cases[c]] = std::move(of_group[c]);
    return true;
  }

  bool factor(Group& group, const std::vector<Vec3>& points)
  {
    group.system.clear();
    const std::vector<Vec3>& any = m_displacements.front(); // for the right-hand side, which is not used
    for(Element_index e : group.system.active_elements())
      group.system.add(e, material_of(m_materials, e), points, any);
    group.solver->set_matrix(group.system.starts(), group.system.rows(), group.system.values());
    return group.solver->factor();
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_INTERNAL_LOAD_CASES_H
