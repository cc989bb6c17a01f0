// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reference solution for corotational elements: a total Lagrangian solution for hexahedra of a St.
// Venant-Kirchhoff material, whose bulk modulus acts on the mean of the trace of Green's strain. The
// reference has nothing in common with the package: shape functions, quadrature, strain, assembly and
// Newton's method are its own.

#ifndef MIXED_MESH_3_TEST_TOTAL_LAGRANGIAN_REFERENCE_H
#define MIXED_MESH_3_TEST_TOTAL_LAGRANGIAN_REFERENCE_H

#include <CGAL/Mixed_mesh_3/Elastic_material.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <boost/core/lightweight_test.hpp>

#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace total_lagrangian {

using Matrix_3x8 = Eigen::Matrix<double, 3, 8>;
using Matrix_24 = Eigen::Matrix<double, 24, 24>;
using Vector_24 = Eigen::Matrix<double, 24, 1>;

// Adds forces of an element, and their derivative. Nodes as in VTK: around the base, then around the top.
inline void element(const Matrix_3x8& x, const Matrix_3x8& u,
                    const CGAL::Mixed_meshes_3::Elastic_material& material, const Eigen::Vector3d& load,
                    Vector_24& force, Matrix_24& tangent)
{
  using Eigen::Matrix3d;
  static const int sign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                 {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  const double mu = material.mu(), bulk = material.bulk_modulus();
  std::array<Matrix_3x8, 8> gradients; // of the shape functions
  std::array<double, 8> weights{};
  std::array<Matrix3d, 8> f, strain;
  double volume = 0, trace = 0;
  force.setZero();
  tangent.setZero();
  for(int q = 0; q < 8; ++q) {
    Matrix_3x8 local;
    Eigen::Matrix<double, 8, 1> shape;
    for(int a = 0; a < 8; ++a) {
      double factor[3];
      for(int k = 0; k < 3; ++k)
        factor[k] = (1 + sign[a][k] * sign[q][k] / std::sqrt(3.)) / 2;
      shape[a] = factor[0] * factor[1] * factor[2];
      for(int k = 0; k < 3; ++k)
        local(k, a) = sign[a][k] / 2. * factor[(k + 1) % 3] * factor[(k + 2) % 3];
    }
    const Matrix3d jacobian = x * local.transpose();
    weights[q] = jacobian.determinant();
    gradients[q] = jacobian.inverse().transpose() * local;
    f[q] = Matrix3d::Identity() + u * gradients[q].transpose();
    strain[q] = (f[q].transpose() * f[q] - Matrix3d::Identity()) / 2;
    volume += weights[q];
    trace += weights[q] * strain[q].trace();
    for(int a = 0; a < 8; ++a)
      force.segment<3>(3 * a) -= weights[q] * shape[a] * load;
  }
  Vector_24 by_trace = Vector_24::Zero();
  for(int q = 0; q < 8; ++q) {
    const Matrix3d stress = 2 * mu * (strain[q] - strain[q].trace() / 3 * Matrix3d::Identity())
                            + bulk * trace / volume * Matrix3d::Identity();
    for(int a = 0; a < 8; ++a) {
      const Eigen::Vector3d ga = gradients[q].col(a);
      force.segment<3>(3 * a) += weights[q] * f[q] * stress * ga;
      by_trace.segment<3>(3 * a) += weights[q] * f[q] * ga;
      for(int b = 0; b < 8; ++b) {
        const Eigen::Vector3d gb = gradients[q].col(b);
        // The term is 2 mu times the deviator of the change of strain, sym(F^T du gb^T), times F ga.
        const Matrix3d block = mu
                                 * (f[q] * f[q].transpose() * ga.dot(gb)
                                    + f[q] * gb * (f[q] * ga).transpose())
                               - 2 * mu / 3 * f[q] * ga * (f[q] * gb).transpose()
                               + Matrix3d::Identity() * ga.dot(stress * gb);
        tangent.block<3, 3>(3 * a, 3 * b) += weights[q] * block;
      }
    }
  }
  tangent += bulk / volume * by_trace * by_trace.transpose();
}

} // namespace total_lagrangian

/// The displacements under a force by volume that is applied in steps.
template <class Mesh>
std::vector<CGAL::Mixed_meshes_3::Vec3>
total_lagrangian_solution(const Mesh& mesh, const CGAL::Mixed_meshes_3::Elastic_material& material,
                          const std::vector<bool>& is_fixed, const CGAL::Mixed_meshes_3::Vec3& load,
                          int number_of_load_steps = 10)
{
  using namespace total_lagrangian;
  std::vector<int> unknowns(mesh.number_of_vertices(), -1);
  int n = 0;
  for(std::size_t v = 0; v < unknowns.size(); ++v)
    if(!is_fixed[v])
      unknowns[v] = 3 * n++;
  std::vector<CGAL::Mixed_meshes_3::Vec3> u(unknowns.size(), CGAL::Mixed_meshes_3::Vec3{});
  for(int step = 1; step <= number_of_load_steps; ++step) {
    const Eigen::Vector3d part = double(step) / number_of_load_steps * Eigen::Vector3d(load.data());
    double change = 1;
    for(int newton = 0; newton < 30 && change > 1e-10; ++newton) {
      Eigen::VectorXd residual = Eigen::VectorXd::Zero(3 * n);
      std::vector<Eigen::Triplet<double>> entries;
      for(std::size_t e = 0; e < mesh.number_of_elements(); ++e) {
        const auto view = mesh.element(e);
        Matrix_3x8 x, d;
        for(int a = 0; a < 8; ++a) {
          x.col(a) = Eigen::Vector3d(CGAL::Mixed_meshes_3::to_vec3(mesh.point(view[a])).data());
          d.col(a) = Eigen::Vector3d(u[view[a]].data());
        }
        Vector_24 force;
        Matrix_24 tangent;
        element(x, d, material, part, force, tangent);
        for(int a = 0; a < 24; ++a) {
          const int i = unknowns[view[a / 3]];
          if(i < 0)
            continue;
          residual[i + a % 3] += force[a];
          for(int b = 0; b < 24; ++b)
            if(const int j = unknowns[view[b / 3]]; j >= 0)
              entries.emplace_back(i + a % 3, j + b % 3, tangent(a, b));
        }
      }
      Eigen::SparseMatrix<double> matrix(3 * n, 3 * n);
      matrix.setFromTriplets(entries.begin(), entries.end());
      const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
      BOOST_TEST(solver.info() == Eigen::Success);
      const Eigen::VectorXd correction = solver.solve(residual);
      change = correction.template lpNorm<Eigen::Infinity>();
      for(std::size_t v = 0; v < u.size(); ++v)
        if(unknowns[v] >= 0)
          for(int k = 0; k < 3; ++k)
            u[v][k] -= correction[unknowns[v] + k];
    }
    BOOST_TEST_LT(change, 1e-10);
  }
  return u;
}

#endif // MIXED_MESH_3_TEST_TOTAL_LAGRANGIAN_REFERENCE_H
