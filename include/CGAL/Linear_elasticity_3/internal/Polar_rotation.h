// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rotation in a gradient of deformation, and its change when the gradient changes.

#ifndef CGAL_LINEAR_ELASTICITY_3_INTERNAL_POLAR_ROTATION_H
#define CGAL_LINEAR_ELASTICITY_3_INTERNAL_POLAR_ROTATION_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
The polar decomposition F = R U, R a rotation and U symmetric. If F changes by R A, then R turns by the vector

    w = (tr(U) 1 - U)^-1 axis(A - A^T)

in the frame that R turns: axis(M) x v = M v for skew matrices M.
*/
struct Polar_rotation
{
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity() / 2; // (tr(U) 1 - U)^-1

  Polar_rotation() = default;

  /// Decomposes by Newton's iteration (N. J. Higham: "Computing the polar decomposition - with applications",
  /// SIAM J. Sci. Stat. Comput. 7, 1986), and inverted or nearly flat gradients by singular values.
  explicit Polar_rotation(const Eigen::Matrix3d& f)
  {
    // A gradient is flat if it shortens one direction to less than 0.3 %: 0.003 / 2^(3/2) is 1e-3. The change
    // is squared; after a change c, c^2 / 2 is left, 5e-16, a few roundings.
    constexpr double flat = 1e-3, converged = 1e-15;
    constexpr int largest_number_of_iterations = 20; // five to seven are usual
    const double size = f.norm();
    if(!(f.determinant() > flat * size * size * size)) {
      decompose_flat(f);
      return;
    }
    rotation = f;
    for(int i = 0; i < largest_number_of_iterations; ++i) {
      const Eigen::Matrix3d next = (rotation + rotation.inverse().transpose()) / 2;
      const double change = (next - rotation).squaredNorm();
      rotation = next;
      if(change < converged)
        break; // the error is the square of the change
    }
    const Eigen::Matrix3d u = rotation.transpose() * f;
    turn = (u.trace() * Eigen::Matrix3d::Identity() - (u + u.transpose()) / 2).inverse();
  }

private:
  // Decomposes by singular values. The axis of the smallest stretch is turned inside out, if one is.
  void decompose_flat(const Eigen::Matrix3d& f)
  {
    constexpr double smallest_sum = 0.01; // two stretches without a sum leave the rotation undetermined
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(f, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Matrix3d u = svd.matrixU();
    Eigen::Vector3d stretch = svd.singularValues(), sums;
    const Eigen::Matrix3d& v = svd.matrixV();
    if(u.determinant() * v.determinant() < 0) {
      u.col(2) *= -1;
      stretch[2] *= -1;
    }
    rotation = u * v.transpose();
    for(int k = 0; k < 3; ++k)
      sums[k] = 1 / (std::max)(smallest_sum, stretch.sum() - stretch[k]);
    turn = v * sums.asDiagonal() * v.transpose();
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_INTERNAL_POLAR_ROTATION_H
