// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef MIXED_MESH_3_BENCHMARK_QUADRATIC_REFERENCE_H
#define MIXED_MESH_3_BENCHMARK_QUADRATIC_REFERENCE_H

#include "test_cases.h"

#include <CGAL/Mixed_mesh_3/Element_locator_3.h>
#include <CGAL/Mixed_mesh_3/internal/fem/quadrature.h>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

/// Tetrahedra of degree 2 with straight edges: nothing in common with what is measured but the strain of a
/// linear tetrahedron. Solved by conjugate gradients with an incomplete factorization.
class Quadratic_reference
{
  using Vec3 = mm3::Vec3;
  using Nodes = std::array<int, 10>; // four vertices, and the middles of the edges

  const Mesh& m_mesh;
  std::vector<Vec3> m_points, m_displacements;
  std::vector<bool> m_is_on_boundary;
  std::vector<Nodes> m_elements;

public:
  /// \pre all elements are tetrahedra
  Quadratic_reference(const Mesh& mesh, const Brain& brain, Boundary_displacement boundary,
                      const mm3::Elastic_material& material)
    : m_mesh(mesh), m_is_on_boundary(boundary_vertices(mesh))
  {
    for(const auto& p : mesh.points())
      m_points.push_back(mm3::to_vec3(p));
    add_middles();
    solve(brain, boundary, material);
  }

  std::size_t number_of_nodes() const { return m_points.size(); }

  std::vector<Vector> at(const std::vector<Vector>& points) const
  {
    using namespace mm3::internal;
    const mm3::Element_locator_3<Mesh> locator(m_mesh);
    std::vector<Vector> values;
    for(const Vector& p : points) {
      const mm3::Element_location_3 l = locator.nearest(p);
      Vec3 u{};
      for(int i = 0; i < 10; ++i)
        u = u + shape_function(i, l.weights) * m_displacements[std::size_t(m_elements[l.element][i])];
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
    using namespace mm3::internal;
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [it, is_new] = middles.emplace(std::make_pair((std::min)(a, b), (std::max)(a, b)),
                                                int(m_points.size()));
      if(is_new) {
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

  void solve(const Brain& brain, Boundary_displacement boundary, const mm3::Elastic_material& material)
  {
    using namespace mm3::internal;
    using Matrix = Eigen::SparseMatrix<double>;
    m_displacements.assign(m_points.size(), Vec3{});
    std::vector<int> unknown(m_points.size(), -1);
    int n = 0;
    for(std::size_t v = 0; v < m_points.size(); ++v) {
      const auto u = m_is_on_boundary[v] ? boundary(m_points[v], brain) : std::nullopt;
      if(u)
        m_displacements[v] = *u;
      else
        unknown[v] = n++;
    }
    // the pattern of the lower triangle, in blocks
    std::vector<std::vector<int>> neighbors(static_cast<std::size_t>(n));
    for(const Nodes& nodes : m_elements)
      for(int a : nodes)
        for(int b : nodes)
          if(const int i = unknown[std::size_t(a)], j = unknown[std::size_t(b)]; i >= 0 && j >= i)
            neighbors[std::size_t(i)].push_back(j);
    Matrix k(3 * n, 3 * n);
    std::vector<int> sizes;
    for(auto& list : neighbors) {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
      for(int c = 0; c < 3; ++c)
        sizes.push_back(int(3 * list.size()) - c);
    }
    k.reserve(sizes);
    for(int i = 0; i < n; ++i)
      for(int c = 0; c < 3; ++c)
        for(int j : neighbors[std::size_t(i)])
          for(int r = 0; r < 3; ++r)
            if(3 * j + r >= 3 * i + c)
              k.insert(3 * j + r, 3 * i + c) = 0;
    k.makeCompressed();

    Eigen::VectorXd f = Eigen::VectorXd::Zero(3 * n);
    const double lambda = material.lambda(), mu = material.mu();
    constexpr double near = 0.5854101966249685, far = 0.1381966011250105; // exact for degree 2
    for(const Nodes& nodes : m_elements) {
      std::array<Vec3, 8> corners{};
      for(int i = 1; i < 4; ++i)
        corners[i] = m_points[std::size_t(nodes[i])] - m_points[std::size_t(nodes[0])];
      const Strain_operator linear = strain_operator(mm3::TETRAHEDRON, corners, 0);
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
        const double volume = linear.volume / 4;
        for(int a = 0; a < 10; ++a)
          for(int b = 0; b < 10; ++b) {
            const int i = unknown[std::size_t(nodes[a])], j = unknown[std::size_t(nodes[b])];
            if(i < 0 || (j >= 0 && i < j))
              continue;
            const double shear = mu * dot(g[a], g[b]);
            for(int r = 0; r < 3; ++r)
              for(int c = 0; c < 3; ++c) {
                const double x = volume
                                 * (lambda * g[a][r] * g[b][c] + mu * g[a][c] * g[b][r]
                                    + (r == c ? shear : 0));
                if(j < 0)
                  f[3 * i + r] -= x * m_displacements[std::size_t(nodes[b])][c];
                else if(3 * i + r >= 3 * j + c)
                  k.coeffRef(3 * i + r, 3 * j + c) += x;
              }
          }
      }
    }
    Eigen::ConjugateGradient<Matrix, Eigen::Lower, Eigen::IncompleteCholesky<double>> solver;
    solver.setTolerance(1e-7);
    solver.compute(k);
    const Eigen::VectorXd x = solver.solve(f);
    if(solver.info() != Eigen::Success)
      throw std::runtime_error("the reference is not solved");
    for(std::size_t v = 0; v < m_points.size(); ++v)
      if(unknown[v] >= 0)
        m_displacements[v] = {x[3 * unknown[v]], x[3 * unknown[v] + 1], x[3 * unknown[v] + 2]};
  }
};

#endif // MIXED_MESH_3_BENCHMARK_QUADRATIC_REFERENCE_H
