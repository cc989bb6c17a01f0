// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Brain shift with a boundary that springs hold, as the skull and its fluid do: no displacement is known.

#ifndef MIXED_MESH_3_BENCHMARK_SPRINGS_H
#define MIXED_MESH_3_BENCHMARK_SPRINGS_H

#include "test_cases.h"

#include <CGAL/Linear_elasticity_3.h>
#include <CGAL/Linear_elasticity_3/internal/Elastic_stiffness.h>
#include <CGAL/Mixed_mesh_3/Symmetric_solver_traits.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/Middle_nodes.h>
#include <CGAL/Mixed_mesh_3/internal/fem/Elasticity_system.h>
#include <CGAL/Mixed_mesh_3/internal/fem/Element_nodes.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

/// Springs at a point of the boundary: the traction is `at_rest - stiffness * displacement`.
struct Spring
{
  double stiffness = 0; // kPa/mm
  Vector at_rest{};     // kPa
};

using Springs = std::function<Spring(const Vector&)>;

/// Springs pull the opening by 10 mm towards the tumor, most in its center; others hold the lower 30 % of the
/// brain, the more the lower; all else is free.
inline Springs springs(const Opening& o, const Brain& brain)
{
  constexpr double held_share = 0.3, largest_stiffness = 1, width_of_step = 20;
  const double held_below = brain.lowest + held_share * (brain.highest - brain.lowest);
  return [=](const Vector& p) {
    Spring spring;
    const double below = std::clamp((held_below - p[2]) / width_of_step, 0., 1.);
    spring.stiffness = largest_stiffness * below * below * (3 - 2 * below);
    if(is_in_patch(p, o)) {
      const double k = largest_stiffness
                       * (1 + std::cos(M_PI * Opening_coordinates(p, o).from_axis / o.radius)) / 2;
      spring.stiffness += k;
      spring.at_rest = (k * push) * o.axis;
    }
    return spring;
  };
}

/// The springs of a face: the matrix, times the identity of 3 x 3, and the forces, of the functions of its
/// vertices and then of its edges, from each vertex to the next one.
struct Springs_of_face
{
  Eigen::MatrixXd matrix, forces; // forces have three columns

  /// The same for the nodal functions of an element of order 2: a coefficient of an edge is the displacement
  /// of its middle minus the mean of its ends.
  Springs_of_face nodal() const
  {
    const Eigen::Index n = matrix.rows() / 2;
    Eigen::MatrixXd a = Eigen::MatrixXd::Identity(2 * n, 2 * n);
    for(Eigen::Index i = 0; i < n; ++i)
      a(n + i, i) = a(n + i, (i + 1) % n) = -0.5;
    return {a.transpose() * matrix * a, a.transpose() * forces};
  }
};

/// Integrates springs over a triangle or a quadrilateral with straight edges.
/// \param corners 3 or 4 points
inline Springs_of_face integrate_springs(const Springs& springs, const std::vector<Vector>& corners)
{
  // The rule of Gauss with eight points, in [0,1]: springs vary within coarse faces.
  static const std::array<std::array<double, 2>, 8> rule = [] {
    constexpr std::array<double, 4> x{0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                      0.9602898564975363},
      w{0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
    std::array<std::array<double, 2>, 8> points{};
    for(std::size_t i = 0; i < 4; ++i) {
      points[2 * i] = {(1 - x[i]) / 2, w[i] / 2};
      points[2 * i + 1] = {(1 + x[i]) / 2, w[i] / 2};
    }
    return points;
  }();
  const std::size_t n = corners.size();
  Springs_of_face result{Eigen::MatrixXd::Zero(Eigen::Index(2 * n), Eigen::Index(2 * n)),
                         Eigen::MatrixXd::Zero(Eigen::Index(2 * n), 3)};
  Eigen::VectorXd f(2 * n);
  for(const auto& [s, ws] : rule)
    for(const auto& [t, wt] : rule) {
      double area;
      if(n == 3) { // the square collapses to the triangle
        const std::array<double, 3> l{(1 - s) * (1 - t), s, (1 - s) * t};
        for(int i = 0; i < 3; ++i) {
          f[i] = l[std::size_t(i)];
          f[3 + i] = 4 * l[std::size_t(i)] * l[std::size_t((i + 1) % 3)];
        }
        area = (1 - s) * norm(cross(corners[1] - corners[0], corners[2] - corners[0]));
      } else {
        f << (1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t, // vertices
          4 * s * (1 - s) * (1 - t), 4 * t * (1 - t) * s, 4 * s * (1 - s) * t, 4 * t * (1 - t) * (1 - s);
        area = norm(cross((1 - t) * (corners[1] - corners[0]) + t * (corners[2] - corners[3]),
                          (1 - s) * (corners[3] - corners[0]) + s * (corners[2] - corners[1])));
      }
      Vector p{};
      for(std::size_t i = 0; i < n; ++i)
        p = p + f[Eigen::Index(i)] * corners[i];
      const Spring spring = springs(p);
      const double weight = ws * wt * area;
      result.matrix += (weight * spring.stiffness) * f * f.transpose();
      for(int k = 0; k < 3; ++k)
        result.forces.col(k) += (weight * spring.at_rest[std::size_t(k)]) * f;
    }
  return result;
}

/// Calls f(springs of a face, face) for the faces of the boundary.
template <class F>
void for_each_face_with_springs(const Springs& springs, const Mesh& mesh, const F& f)
{
  for(const mm3::Face& face : mm3::boundary_faces(mesh)) {
    std::vector<Vector> corners;
    for(mm3::Vertex_index v : face.vertices())
      corners.push_back(mm3::to_vec3(mesh.point(v)));
    const Springs_of_face of_face = integrate_springs(springs, corners);
    if(!of_face.matrix.isZero(0))
      f(of_face, face);
  }
}

/// A system of equations of all nodes, in the form of `Elasticity_system`, with springs.
class System_with_springs
{
  std::vector<int> m_starts, m_rows; // of the lower triangle
  std::vector<double> m_values;
  std::size_t m_number_of_vertices;
  std::map<std::array<mm3::Vertex_index, 2>, std::size_t> m_edges; // the nodes of edges
  Eigen::VectorXd m_force;

public:
  using Solver = mm3::Direct_solver_traits;

  /// \param edges ends of the edges that are nodes, after the vertices
  System_with_springs(const mm3::internal::Elasticity_system& system, const Mesh& mesh,
                      const Springs& springs, const std::vector<std::array<mm3::Vertex_index, 2>>& edges = {})
    : m_starts(system.starts()), m_rows(system.rows()), m_values(system.values()),
      m_number_of_vertices(mesh.number_of_vertices()),
      m_force(Eigen::VectorXd::Zero(system.number_of_unknowns()))
  {
    for(const auto& ends : edges)
      m_edges.emplace(ends, m_number_of_vertices + m_edges.size());
    for_each_face_with_springs(springs, mesh, [&](const Springs_of_face& of_face, const mm3::Face& face) {
      add(of_face, nodes_of(face));
    });
  }

  Solver::Matrix matrix() const { return Solver::Matrix(m_starts, m_rows, m_values); }
  const Eigen::VectorXd& force() const { return m_force; }

  /// The displacement, or the coefficient, of each node.
  std::vector<Vector> solve() const
  {
    const Solver::Matrix a = matrix();
    Solver solver;
    double denominator;
    Eigen::MatrixXd x;
    if(!solver.factor(a, denominator) || !solver.linear_solver(Eigen::MatrixXd(m_force), x))
      throw std::runtime_error("the system with springs is not solved");
    std::vector<Vector> u(std::size_t(m_force.size() / 3));
    for(std::size_t i = 0; i < u.size(); ++i)
      for(std::size_t k = 0; k < 3; ++k)
        u[i][k] = x(Eigen::Index(3 * i + k), 0);
    return u;
  }

private:
  static constexpr std::size_t none = std::size_t(-1);

  // The vertices of a face and its edges; `none` for an edge that is no node.
  std::vector<std::size_t> nodes_of(const mm3::Face& face) const
  {
    const auto& v = face.vertices();
    std::vector<std::size_t> nodes(v.begin(), v.end());
    for(int i = 0; i < v.size(); ++i) {
      const auto [a, b] = std::minmax({v[i], v[(i + 1) % v.size()]});
      const auto edge = m_edges.find({a, b});
      nodes.push_back(edge == m_edges.end() ? none : edge->second);
    }
    return nodes;
  }

  void add(const Springs_of_face& of_face, const std::vector<std::size_t>& nodes)
  {
    for(std::size_t a = 0; a < nodes.size(); ++a) {
      if(nodes[a] == none)
        continue;
      for(std::size_t k = 0; k < 3; ++k)
        m_force[Eigen::Index(3 * nodes[a] + k)] += of_face.forces(Eigen::Index(a), Eigen::Index(k));
      for(std::size_t b = 0; b < nodes.size(); ++b)
        if(nodes[b] != none && nodes[a] >= nodes[b])
          for(std::size_t k = 0; k < 3; ++k)
            value(3 * nodes[a] + k, 3 * nodes[b] + k) += of_face.matrix(Eigen::Index(a), Eigen::Index(b));
    }
  }

  double& value(std::size_t row, std::size_t column)
  {
    const auto first = m_rows.begin() + m_starts[column], last = m_rows.begin() + m_starts[column + 1];
    const auto it = std::lower_bound(first, last, int(row));
    if(it == last || *it != int(row))
      throw std::logic_error("the nodes of a face are not neighbors");
    return m_values[std::size_t(it - m_rows.begin())];
  }
};

/// The nodes of a model. Elements all of whose edges are nodes have the same nodes as its quadratic elements.
inline mm3::internal::Element_nodes nodes_of(const CGAL::Linear_elasticity_3<Mesh>& model)
{
  using namespace mm3::internal;
  const Mesh& mesh = model.mesh();
  const std::size_t n = mesh.number_of_vertices();
  if(model.quadratic_edges().empty())
    return Element_nodes(mesh.elements(), n);
  const Middle_nodes all = quadratic_connectivity(mesh.elements(), n);
  auto edges = model.quadratic_edges();
  std::sort(edges.begin(), edges.end());
  std::vector<bool> is_quadratic;
  for(mm3::Element_index e = 0; e < mesh.number_of_elements(); ++e) {
    bool has_all = true;
    for(int i = 0; i < mesh.element(e).reference().number_of_edges; ++i)
      has_all = has_all
                && std::binary_search(edges.begin(), edges.end(),
                                      all.ends[all.of_elements[all.offsets[e] + std::size_t(i)]]);
    is_quadratic.push_back(has_all);
  }
  Element_nodes nodes(mesh.elements(), n, is_quadratic);
  if(nodes.ends() != model.quadratic_edges())
    throw std::logic_error("the nodes are not those of the model");
  return nodes;
}

/// Solves with springs, by elements of Linear_elasticity_3.
/// \return the displacements of the vertices, and the coefficients of the edges
inline std::vector<Vector> solve_with_springs(const Mesh& mesh, const mm3::internal::Element_nodes& nodes,
                                              const mm3::Elastic_material& material, const Springs& springs)
{
  mm3::internal::Elastic_stiffness stiffness(mesh.elements(), mm3::internal::points_of(mesh), {material});
  stiffness.set_nodes(nodes);
  stiffness.assemble();
  return System_with_springs(stiffness.system(), mesh, springs, nodes.ends()).solve();
}

/// Solves with springs, by standard elements of order 1.
inline std::vector<Vector> standard_solution_with_springs(const Mesh& mesh,
                                                          const mm3::Elastic_material& material,
                                                          const Springs& springs)
{
  using namespace mm3::internal;
  const std::vector<Vector> points = points_of(mesh);
  Elasticity_system system(mesh.elements(), std::vector<bool>(points.size(), true));
  system.clear();
  for(mm3::Element_index e : system.active_elements())
    system.add(e, material, points, points, Dilatation::POINTWISE);
  return System_with_springs(system, mesh, springs).solve();
}

#endif // MIXED_MESH_3_BENCHMARK_SPRINGS_H
