// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef MIXED_MESH_3_BENCHMARK_QUADRATIC_REFERENCE_H
#define MIXED_MESH_3_BENCHMARK_QUADRATIC_REFERENCE_H

#include "Springs.h"
#include "test_cases.h"

#include <CGAL/Mixed_mesh_3/Element_locator_3.h>
#include <CGAL/Mixed_mesh_3/Symmetric_solver_traits.h>
#include <CGAL/Mixed_mesh_3/internal/fem/Elasticity_system.h>
#include <CGAL/Mixed_mesh_3/internal/fem/quadrature.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

/// Tetrahedra of degree 2 with straight edges: only the strain of a linear tetrahedron is common with the
/// measured code. The system is solved by conjugate gradients; the preconditioner is the sum of symmetric
/// Gauss-Seidel steps, and the solution with linear tetrahedra.
class Quadratic_reference
{
  using Vec3 = mm3::Vec3;
  using Nodes = std::array<int, 10>; // four vertices, and the middles of the edges
  using Matrix = Eigen::SparseMatrix<double>;
  using Vector_x = Eigen::VectorXd; // of the unknowns
  using Solver = mm3::Direct_solver_traits;

  const Mesh& m_mesh;
  mm3::Elastic_material m_material;
  std::vector<Vec3> m_points;
  std::vector<bool> m_is_on_boundary;
  std::vector<Nodes> m_elements;
  std::vector<std::array<int, 2>> m_ends;       // of the edges that have the nodes after the vertices
  std::map<std::pair<int, int>, int> m_middles; // nodes of edges, by their ends, the smaller one first
  std::vector<int> m_unknown;                   // of a node; -1 if it is prescribed
  int m_number_of_unknowns = 0;
  Matrix m_matrix; // the lower triangle
  std::vector<std::vector<int>>
    m_rows;                          // of it, sorted: the unknowns not less than each that it is coupled with
  Solver::Matrix m_linear_matrix{0}; // of the linear tetrahedra: its unknowns are the first ones
  mutable Solver m_linear_solver;

public:
  using Displacements = std::vector<Vec3>; // of the nodes

  /// \pre all elements are tetrahedra
  Quadratic_reference(const Mesh& mesh, const mm3::Elastic_material& material)
    : m_mesh(mesh), m_material(material), m_is_on_boundary(boundary_vertices(mesh))
  {
    for(const auto& p : mesh.points())
      m_points.push_back(mm3::to_vec3(p));
    add_middles();
  }

  std::size_t number_of_nodes() const { return m_points.size(); }

  /// Solves for several loads with one matrix. \pre all of them prescribe the same nodes
  std::vector<Displacements> solve(const std::vector<Boundary_displacement>& loads)
  {
    number_unknowns(loads.front());
    make_pattern();
    std::vector<Displacements> solutions;
    for(const Boundary_displacement& load : loads)
      solutions.push_back(prescribed(load));
    std::vector<Vector_x> right_hand_sides(loads.size(), Vector_x::Zero(3 * m_number_of_unknowns));
    for(const Nodes& nodes : m_elements)
      add(nodes, stiffness(nodes), solutions, right_hand_sides);
    factor_linear_part();
    for(std::size_t l = 0; l < loads.size(); ++l)
      set_unknowns(solve(right_hand_sides[l]), solutions[l]);
    return solutions;
  }

  /// Solves for springs, which hold all: no node is prescribed.
  Displacements solve(const Springs& springs)
  {
    number_unknowns([](const Vector&) { return std::nullopt; });
    make_pattern();
    std::vector<Displacements> solution(1, Displacements(m_points.size(), Vec3{}));
    std::vector<Vector_x> right_hand_side(1, Vector_x::Zero(3 * m_number_of_unknowns));
    for(const Nodes& nodes : m_elements)
      add(nodes, stiffness(nodes), solution, right_hand_side);
    for_each_face_with_springs(springs, m_mesh, [&](const Springs_of_face& of_face, const mm3::Face& face) {
      add(of_face.nodal(), face, right_hand_side.front());
    });
    factor_linear_part(springs);
    set_unknowns(solve(right_hand_side.front()), solution.front());
    return solution.front();
  }

  std::vector<Vector> at(const std::vector<Vector>& points, const Displacements& displacements) const
  {
    const mm3::Element_locator_3<Mesh> locator(m_mesh);
    std::vector<Vector> values;
    for(const Vector& p : points) {
      const mm3::Element_location_3 l = locator.nearest(p);
      Vec3 u{};
      for(int i = 0; i < 10; ++i)
        u = u + shape_function(i, l.weights) * displacements[std::size_t(m_elements[l.element][i])];
      values.push_back(u);
    }
    return values;
  }

private:
  static const std::uint8_t* edge(int i) { return mm3::reference_elements[mm3::TETRAHEDRON].edges[i]; }

  template <class Weights>
  static double shape_function(int i, const Weights& w)
  {
    return i < 4 ? w[i] * (2 * w[i] - 1) : 4 * w[edge(i - 4)[0]] * w[edge(i - 4)[1]];
  }

  void add_middles()
  {
    const auto middle = [&](int a, int b) {
      const auto [it, is_new] = m_middles.emplace(std::make_pair((std::min)(a, b), (std::max)(a, b)),
                                                  int(m_points.size()));
      if(is_new) {
        m_ends.push_back({a, b});
        m_points.push_back(0.5 * (m_points[std::size_t(a)] + m_points[std::size_t(b)]));
        m_is_on_boundary.push_back(false);
      }
      return it->second;
    };
    for(std::size_t e = 0; e < m_mesh.number_of_elements(); ++e) {
      const auto element = m_mesh.element(e);
      if(element.kind() != mm3::TETRAHEDRON)
        throw std::runtime_error("the reference needs a mesh of tetrahedra");
      Nodes nodes;
      std::copy(element.begin(), element.end(), nodes.begin());
      for(int i = 0; i < 6; ++i)
        nodes[4 + i] = middle(nodes[edge(i)[0]], nodes[edge(i)[1]]);
      m_elements.push_back(nodes);
    }
    for(const auto& face : mm3::boundary_faces(m_mesh)) {
      const auto& v = face.vertices();
      for(int i = 0; i < 3; ++i)
        m_is_on_boundary[std::size_t(middle(int(v[i]), int(v[(i + 1) % 3])))] = true;
    }
  }

  void number_unknowns(const Boundary_displacement& load)
  {
    m_unknown.assign(m_points.size(), -1);
    m_number_of_unknowns = 0;
    for(std::size_t v = 0; v < m_points.size(); ++v)
      if(!m_is_on_boundary[v] || !load(m_points[v]))
        m_unknown[v] = m_number_of_unknowns++;
  }

  Displacements prescribed(const Boundary_displacement& load) const
  {
    Displacements displacements(m_points.size(), Vec3{});
    for(std::size_t v = 0; v < m_points.size(); ++v)
      if(m_unknown[v] < 0)
        displacements[v] = *load(m_points[v]);
    return displacements;
  }

  // Zeros where the lower triangle of the matrix will have values: blocks of 3 x 3.
  void make_pattern()
  {
    m_rows.assign(std::size_t(m_number_of_unknowns), {});
    for(const Nodes& nodes : m_elements)
      for(int a : nodes)
        for(int b : nodes)
          if(const int i = m_unknown[std::size_t(a)], j = m_unknown[std::size_t(b)]; j >= 0 && i >= j)
            m_rows[std::size_t(j)].push_back(i);
    std::size_t number_of_blocks = 0;
    for(auto& rows : m_rows) {
      std::sort(rows.begin(), rows.end());
      rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
      number_of_blocks += rows.size();
    }
    const Eigen::Index n = 3 * m_number_of_unknowns;
    m_matrix.resize(n, n);
    const Eigen::Index number_of_values = Eigen::Index(9 * number_of_blocks) - n; // diagonal blocks have 6
    m_matrix.resizeNonZeros(number_of_values);
    std::fill_n(m_matrix.valuePtr(), number_of_values, 0.);
    int* starts = m_matrix.outerIndexPtr();
    int* row = m_matrix.innerIndexPtr();
    for(int j = 0; j < m_number_of_unknowns; ++j)
      for(int c = 0; c < 3; ++c) {
        for(int i : m_rows[std::size_t(j)])
          for(int r = i == j ? c : 0; r < 3; ++r)
            *row++ = 3 * i + r;
        starts[3 * j + c + 1] = int(row - m_matrix.innerIndexPtr());
      }
  }

  using Block = std::array<std::array<double, 3>, 3>;
  using Stiffness = std::array<std::array<Block, 10>, 10>;

  Stiffness stiffness(const Nodes& nodes) const
  {
    const double lambda = m_material.lambda(), mu = m_material.mu();
    constexpr double near = 0.5854101966249685, far = 0.1381966011250105; // exact for degree 2
    std::array<Vec3, 8> corners{};
    for(int i = 1; i < 4; ++i)
      corners[i] = m_points[std::size_t(nodes[i])] - m_points[std::size_t(nodes[0])];
    const mm3::internal::Strain_operator linear = mm3::internal::strain_operator(mm3::TETRAHEDRON, corners,
                                                                                 0);
    const double volume = linear.volume / 4;
    Stiffness k{};
    for(int q = 0; q < 4; ++q) {
      std::array<double, 4> w;
      for(int i = 0; i < 4; ++i)
        w[i] = i == q ? near : far;
      std::array<Vec3, 10> g;
      for(int i = 0; i < 4; ++i)
        g[i] = (4 * w[i] - 1) * linear.gradients[i];
      for(int i = 0; i < 6; ++i) {
        const int a = edge(i)[0], b = edge(i)[1];
        g[4 + i] = (4 * w[a]) * linear.gradients[b] + (4 * w[b]) * linear.gradients[a];
      }
      for(int a = 0; a < 10; ++a)
        for(int b = 0; b < 10; ++b) {
          const double shear = mu * dot(g[a], g[b]);
          for(int r = 0; r < 3; ++r)
            for(int c = 0; c < 3; ++c)
              k[a][b][r][c] += volume
                               * (lambda * g[a][r] * g[b][c] + mu * g[a][c] * g[b][r] + (r == c ? shear : 0));
        }
    }
    return k;
  }

  // Adds to the matrix; prescribed displacements go to the right-hand sides.
  void add(const Nodes& nodes, const Stiffness& k, const std::vector<Displacements>& prescribed,
           std::vector<Vector_x>& right_hand_sides)
  {
    for(int a = 0; a < 10; ++a)
      for(int b = 0; b < 10; ++b) {
        const int i = m_unknown[std::size_t(nodes[a])], j = m_unknown[std::size_t(nodes[b])];
        if(i >= 0 && j >= 0 && i >= j)
          add(i, j, k[a][b]);
        else if(i >= 0 && j < 0)
          for(std::size_t l = 0; l < prescribed.size(); ++l)
            for(int r = 0; r < 3; ++r)
              for(int c = 0; c < 3; ++c)
                right_hand_sides[l][3 * i + r] -= k[a][b][r][c] * prescribed[l][std::size_t(nodes[b])][c];
      }
  }

  // Adds the springs of a face. \pre all nodes are unknown
  void add(const Springs_of_face& of_face, const mm3::Face& face, Vector_x& right_hand_side)
  {
    const auto& v = face.vertices();
    std::array<int, 6> nodes;
    for(int i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax({int(v[i]), int(v[(i + 1) % 3])});
      nodes[std::size_t(i)] = m_unknown[v[i]];
      nodes[std::size_t(3 + i)] = m_unknown[std::size_t(m_middles.at({a, b}))];
    }
    for(int a = 0; a < 6; ++a) {
      const int i = nodes[std::size_t(a)];
      right_hand_side.segment<3>(3 * i) += of_face.forces.row(a).transpose();
      for(int b = 0; b < 6; ++b)
        if(const int j = nodes[std::size_t(b)]; i >= j) {
          const double k = of_face.matrix(a, b);
          add(i, j, Block{{{k, 0, 0}, {0, k, 0}, {0, 0, k}}});
        }
    }
  }

  // \pre i >= j
  void add(int i, int j, const Block& block)
  {
    const std::vector<int>& rows = m_rows[std::size_t(j)];
    const auto before = std::lower_bound(rows.begin(), rows.end(), i) - rows.begin();
    for(int c = 0; c < 3; ++c) {
      // The first block of a column lacks the entries above the diagonal.
      double* const values = m_matrix.valuePtr() + m_matrix.outerIndexPtr()[3 * j + c] + 3 * before - c;
      for(int r = i == j ? c : 0; r < 3; ++r)
        values[r] += block[r][c];
    }
  }

  void set_unknowns(const Vector_x& x, Displacements& displacements) const
  {
    for(std::size_t v = 0; v < m_points.size(); ++v)
      if(const int i = 3 * m_unknown[v]; i >= 0)
        displacements[v] = {x[i], x[i + 1], x[i + 2]};
  }

  void factor_linear_part(const std::optional<Springs>& springs = std::nullopt)
  {
    std::vector<bool> is_free;
    for(std::size_t v = 0; v < m_mesh.number_of_vertices(); ++v)
      is_free.push_back(m_unknown[v] >= 0);
    mm3::internal::Elasticity_system system(m_mesh.elements(), is_free);
    system.clear();
    const Displacements zero(m_mesh.number_of_vertices(), Vec3{});
    for(auto e : system.active_elements())
      system.add(e, m_material, m_points, zero);
    m_linear_matrix = springs ? System_with_springs(system, m_mesh, *springs).matrix()
                              : Solver::Matrix(system.starts(), system.rows(), system.values());
    double denominator;
    if(!m_linear_solver.factor(m_linear_matrix, denominator))
      throw std::runtime_error("the preconditioner of the reference is not positive definite");
  }

  // Calls f(node in the middle of an edge, end of the edge), as numbers of unknowns.
  template <class F>
  void for_each_half_edge(const F& f) const
  {
    for(std::size_t m = 0; m < m_ends.size(); ++m)
      for(int end : m_ends[m])
        if(const int i = m_unknown[m_mesh.number_of_vertices() + m], j = m_unknown[std::size_t(end)];
           i >= 0 && j >= 0)
          f(i, j);
  }

  Vector_x preconditioned(const Vector_x& r) const
  {
    Vector_x z = m_matrix.triangularView<Eigen::Lower>().solve(r);
    z.array() *= m_matrix.diagonal().array();
    z = m_matrix.transpose().triangularView<Eigen::Upper>().solve(z);

    const Eigen::Index n = m_linear_matrix.eigen_object().rows();
    Eigen::MatrixXd restricted = r.head(n), linear;
    for_each_half_edge([&](int i, int j) { restricted.col(0).segment<3>(3 * j) += r.segment<3>(3 * i) / 2; });
    m_linear_solver.linear_solver(restricted, linear);
    z.head(n) += linear.col(0);
    for_each_half_edge([&](int i, int j) { z.segment<3>(3 * i) += linear.col(0).segment<3>(3 * j) / 2; });
    return z;
  }

  Vector_x solve(const Vector_x& right_hand_side) const
  {
    constexpr double tolerance = 1e-6; // of the residual in the norm of the preconditioner
    constexpr int most_iterations = 1000;
    Vector_x x = Vector_x::Zero(right_hand_side.size()), r = right_hand_side, z = preconditioned(r), p = z;
    double rz = r.dot(z);
    const double enough = tolerance * tolerance * rz;
    for(int i = 0; rz > enough; ++i) {
      if(i == most_iterations)
        throw std::runtime_error("the reference is not solved");
      const Vector_x kp = m_matrix.selfadjointView<Eigen::Lower>() * p;
      const double step = rz / p.dot(kp);
      x += step * p;
      r -= step * kp;
      z = preconditioned(r);
      const double last = std::exchange(rz, r.dot(z));
      p = z + (rz / last) * p;
    }
    return x;
  }
};

#endif // MIXED_MESH_3_BENCHMARK_QUADRATIC_REFERENCE_H
