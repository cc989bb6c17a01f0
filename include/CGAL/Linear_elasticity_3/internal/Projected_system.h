// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The system of linear equations of an elastic body, without its control points: projected on the directions
// that supports leave free, held by springs where rigid motions are free, and factored.

#ifndef CGAL_LINEAR_ELASTICITY_3_INTERNAL_PROJECTED_SYSTEM_H
#define CGAL_LINEAR_ELASTICITY_3_INTERNAL_PROJECTED_SYSTEM_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <CGAL/Linear_elasticity_3/internal/Elastic_stiffness.h>
#include <CGAL/Linear_elasticity_3/internal/Elastic_supports.h>
#include <CGAL/Linear_elasticity_3/internal/Elasticity_solver.h>
#include <CGAL/Linear_elasticity_3/internal/rigid_modes.h>
#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/Face.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/fem/Elasticity_system.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

class Projected_system
{
  std::unique_ptr<Elasticity_solver> m_solver;
  std::vector<Vertex_index> m_unknowns; // nodes of the factored system
  std::vector<Eigen::Index> m_selected; // start of each unknown node among those of the selected nodes
  std::vector<Free_motion> m_motions;   // free motions of the parts at the factorization

public:
  explicit Projected_system(std::unique_ptr<Elasticity_solver> solver) : m_solver(std::move(solver)) {}

  Elasticity_solver& solver() { return *m_solver; }

  /// The rigid motions that supports left free when the system was factored.
  const std::vector<Free_motion>& free_motions() const { return m_motions; }

  /// Forgets the matrix, and with it the unknowns.
  void clear() { m_solver->clear_matrix(); }

  /// Factors K on the free directions, P K P, with positive entries on the other directions. As springs hold
  /// exactly as many unknowns as there are free motions, springs bear no forces if the loads are in
  /// equilibrium.
  /// \return whether the system is not singular
  bool factor(const Elastic_stiffness& stiffness, const Elastic_supports& supports)
  {
    const Elasticity_system& all = stiffness.system();
    const double largest = *std::max_element(all.values().begin(), all.values().end());
    const std::vector<double> springs = find_springs(stiffness, supports);
    if(!m_solver->has_matrix()) { // else the numbers stay, for the symbolic factorization
      m_unknowns.clear();
      for(Vertex_index v = 0; v < stiffness.number_of_nodes(); ++v)
        if(supports.may_be_free(v))
          m_unknowns.push_back(v);
    }
    if(m_unknowns.empty())
      return true; // CGAL's matrices are not empty
    set_matrix(stiffness, supports, springs, largest);
    if(m_solver->wants_near_kernel())
      m_solver->set_near_kernel(rigid_motions(stiffness.points(), supports));
    if(m_solver->factor() && !is_nearly_singular(largest))
      return true;
    clear();
    return false;
  }

  /// Solves for right-hand sides of all nodes; the solutions are in the free directions.
  bool solve(const Elastic_supports& supports, const Eigen::MatrixXd& forces, Eigen::MatrixXd& solutions)
  {
    const Eigen::Index n = 3 * Eigen::Index(m_unknowns.size());
    Eigen::MatrixXd b(n, forces.cols()), x;
    for(Eigen::Index c = 0; c < forces.cols(); ++c)
      for(std::size_t i = 0; i < m_unknowns.size(); ++i) {
        const Vertex_index v = m_unknowns[i];
        const Vec3 f = supports.free_part(v, {forces(3 * v, c), forces(3 * v + 1, c), forces(3 * v + 2, c)});
        for(int k = 0; k < 3; ++k)
          b(Eigen::Index(3 * i) + k, c) = f[k];
      }
    if(n > 0 && !m_solver->solve(b, x))
      return false;
    solutions = Eigen::MatrixXd::Zero(forces.rows(), forces.cols());
    for(Eigen::Index c = 0; c < forces.cols(); ++c)
      for(std::size_t i = 0; i < m_unknowns.size(); ++i)
        for(int k = 0; k < 3; ++k)
          solutions(Eigen::Index(3 * m_unknowns[i]) + k, c) = x(Eigen::Index(3 * i) + k, c);
    return solutions.allFinite();
  }

  /// Selects nodes for `solve_selected()`. \pre the system is factored
  void select(const std::vector<Vertex_index>& nodes, std::size_t number_of_nodes)
  {
    std::vector<int> number(number_of_nodes, -1), unknowns;
    for(std::size_t i = 0; i < m_unknowns.size(); ++i)
      number[m_unknowns[i]] = int(i);
    m_selected.clear();
    for(std::size_t i = 0; i < nodes.size(); ++i)
      if(const int n = number[nodes[i]]; n >= 0) {
        m_selected.push_back(Eigen::Index(3 * i));
        for(int k = 0; k < 3; ++k)
          unknowns.push_back(3 * n + k);
      }
    if(!unknowns.empty())
      m_solver->select(unknowns);
  }

  /// Solves for forces in free directions on the selected nodes, and returns the displacements of these,
  /// perhaps in single precision.
  bool solve_selected(const Eigen::VectorXd& forces, Eigen::VectorXd& displacements)
  {
    displacements = Eigen::VectorXd::Zero(forces.size());
    Eigen::VectorXd b(3 * Eigen::Index(m_selected.size())), x;
    for(std::size_t i = 0; i < m_selected.size(); ++i)
      b.segment<3>(3 * Eigen::Index(i)) = forces.segment<3>(m_selected[i]);
    if(b.size() == 0)
      return true;
    if(!m_solver->solve_selected(b, x))
      return false;
    for(std::size_t i = 0; i < m_selected.size(); ++i)
      displacements.segment<3>(m_selected[i]) = x.segment<3>(3 * Eigen::Index(i));
    return true;
  }

private:
  // The six rigid motions of the unknowns, which are vertices, in the directions that are free: columns of
  // about the same size.
  Eigen::MatrixXd rigid_motions(const std::vector<Vec3>& points, const Elastic_supports& supports) const
  {
    const double n = double(m_unknowns.size());
    Vec3 center{};
    for(Vertex_index v : m_unknowns)
      center = center + (1 / n) * points[v];
    double size = 0;
    for(Vertex_index v : m_unknowns)
      size = (std::max)(size, norm(points[v] - center));
    Eigen::MatrixXd motions(3 * Eigen::Index(m_unknowns.size()), 6);
    for(std::size_t i = 0; i < m_unknowns.size(); ++i)
      for(int m = 0; m < 6; ++m) {
        Rigid_mode mode{Vec3{}, Vec3{}, center};
        (m < 3 ? mode.translation : mode.rotation)[m % 3] = m < 3 || size == 0 ? 1 : 1 / size;
        const Vec3 u = supports.free_part(m_unknowns[i], mode(points[m_unknowns[i]]));
        for(int k = 0; k < 3; ++k)
          motions(3 * Eigen::Index(i) + k, m) = u[k];
      }
    return motions;
  }

  // The entries that are added to the diagonal; also finds the motions that these hold.
  std::vector<double> find_springs(const Elastic_stiffness& stiffness, const Elastic_supports& supports)
  {
    const Elasticity_system& all = stiffness.system();
    std::vector<double> springs(3 * stiffness.number_of_nodes(), 0);
    m_motions.clear();
    for(const Elastic_part& part : supports.parts()) {
      for(std::size_t unknown : springs_for(part, stiffness.points(), supports))
        springs[unknown] = all.values()[all.starts()[unknown]];
      for(const Rigid_mode& mode : part.modes)
        m_motions.push_back({mode, part.vertices});
    }
    return springs;
  }

  // Unknowns of a part, as many as motions are free, such that holding these unknowns holds the part: rows of
  // the matrix of modes, by elimination with pivots.
  static std::vector<std::size_t> springs_for(const Elastic_part& part, const std::vector<Vec3>& points,
                                              const Elastic_supports& supports)
  {
    using Row = std::array<double, 6>;
    std::vector<std::size_t> chosen;
    if(part.modes.empty())
      return chosen;
    std::vector<std::pair<std::size_t, Row>> table;
    for(Vertex_index v : part.vertices)
      for(int k = 0; k < 3; ++k)
        if(supports.is_free(v)) {
          Row row{};
          for(std::size_t m = 0; m < part.modes.size(); ++m)
            row[m] = supports.free_part(v, part.modes[m](points[v]))[k];
          table.emplace_back(3 * v + k, row);
        }
    const auto dot = [](const Row& a, const Row& b) {
      double sum = 0;
      for(int i = 0; i < 6; ++i)
        sum += a[i] * b[i];
      return sum;
    };
    for(std::size_t m = 0; m < part.modes.size(); ++m) {
      const auto pivot = *std::max_element(table.begin(), table.end(), [&](const auto& a, const auto& b) {
        return dot(a.second, a.second) < dot(b.second, b.second);
      });
      chosen.push_back(pivot.first);
      const double square = dot(pivot.second, pivot.second);
      for(auto& [unknown, row] : table) {
        const double c = dot(row, pivot.second) / square;
        for(int i = 0; i < 6; ++i)
          row[i] -= c * pivot.second[i];
      }
    }
    return chosen;
  }

  // Sets the matrix. Temporary parts are freed before the matrix is factored, which takes the most memory.
  void set_matrix(const Elastic_stiffness& stiffness, const Elastic_supports& supports,
                  const std::vector<double>& springs, double largest)
  {
    std::vector<int> starts{0}, rows;
    std::vector<double> values;
    reduce(stiffness.system(), stiffness.number_of_nodes(), springs, starts, rows, values);
    project(supports, starts, rows, values, largest);
    m_solver->set_matrix(starts, rows, values);
  }

  // Reduces the matrix to the rows and columns of the unknowns, with springs: the lower triangle in
  // compressed columns.
  void reduce(const Elasticity_system& all, std::size_t number_of_nodes, const std::vector<double>& springs,
              std::vector<int>& starts, std::vector<int>& rows, std::vector<double>& values) const
  {
    std::vector<Vertex_index> number(number_of_nodes, no_vertex);
    for(std::size_t i = 0; i < m_unknowns.size(); ++i)
      number[m_unknowns[i]] = Vertex_index(i);
    for(Vertex_index v : m_unknowns) {
      const std::size_t first = values.size();
      for(int k = 0; k < 3; ++k) {
        for(int i = all.starts()[3 * v + k]; i < all.starts()[3 * v + k + 1]; ++i)
          if(const Vertex_index w = number[std::size_t(all.rows()[i]) / 3]; w != no_vertex) {
            rows.push_back(int(3 * w) + all.rows()[i] % 3);
            values.push_back(all.values()[i]);
          }
        starts.push_back(int(rows.size()));
      }
      values[first] += springs[3 * v];
      values[std::size_t(starts[starts.size() - 3])] += springs[3 * v + 1];
      values[std::size_t(starts[starts.size() - 2])] += springs[3 * v + 2];
    }
  }

  // Replaces each block (v, w) by P_v (v, w) P_w, for nodes that slide or have no element any more, and
  // adds `scale` where nothing is left of a block.
  void project(const Elastic_supports& supports, const std::vector<int>& starts, const std::vector<int>& rows,
               std::vector<double>& values, double scale) const
  {
    const auto projector = [&](Vertex_index v) {
      Matrix_3x3 p{};
      for(int k = 0; k < 3; ++k) {
        Vec3 unit{};
        unit[k] = 1;
        p[k] = supports.free_part(v, unit);
      }
      return p;
    };
    for(std::size_t j = 0; j < m_unknowns.size(); ++j) {
      const Vertex_index v = m_unknowns[j];
      const int* column = &starts[3 * j];
      // The columns are three, two and one entry on the diagonal, then three rows for each neighbor.
      const int neighbors = (column[1] - column[0] - 3) / 3;
      for(int i = -1; i < neighbors; ++i) {
        const Vertex_index w = i < 0 ? v : m_unknowns[std::size_t(rows[column[0] + 3 + 3 * i]) / 3];
        if(supports.is_unsupported(v) && supports.is_unsupported(w))
          continue;
        const auto entry = [&](int row, int k) -> double& {
          return i < 0 ? values[column[k] + row - k] : values[column[k] + 3 - k + 3 * i + row];
        };
        Matrix_3x3 block;
        for(int row = 0; row < 3; ++row)
          for(int k = 0; k < 3; ++k)
            block[row][k] = i < 0 && row < k ? entry(k, row) : entry(row, k);
        const Matrix_3x3 pv = projector(v), pw = projector(w);
        for(int k = 0; k < 3; ++k)
          for(int row = i < 0 ? k : 0; row < 3; ++row) {
            double sum = i < 0 ? scale * ((row == k) - pv[row][k]) : 0;
            for(int a = 0; a < 3; ++a)
              for(int b = 0; b < 3; ++b)
                sum += pw[row][a] * block[a][b] * pv[b][k];
            entry(row, k) = sum;
          }
      }
    }
  }

  // Whether the matrix is singular except for rounding, as hinges make it, so that it may have been factored.
  // Forces without a pattern move hinges without bound.
  bool is_nearly_singular(double scale)
  {
    constexpr double largest_condition = 1e13; // some hundred roundings from 1 / epsilon
    Eigen::MatrixXd b(3 * Eigen::Index(m_unknowns.size()), 1), x;
    for(Eigen::Index i = 0; i < b.rows(); ++i)
      b(i, 0) = std::fmod(0.618033988749895 * double(i), 1) - 0.5;
    return !m_solver->solve(b, x) || !(scale * x.norm() < largest_condition * b.norm());
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_INTERNAL_PROJECTED_SYSTEM_H
