// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "brain_shift/registration.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>

#include <cmath>

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

namespace {

// Whether points extend in a number of dimensions: more than 1e-6 of their extent in the longest one, so that
// coordinates with a few digits decide, and not rounding.
bool extend(const Points& points, int dimensions)
{
  constexpr double least_ratio = 1e-6;
  if(points.cols() <= dimensions)
    return false;
  const Points centered = points.colwise() - points.rowwise().mean();
  const Vector3d squares = Eigen::SelfAdjointEigenSolver<Matrix3d>(centered * centered.transpose(),
                                                                   Eigen::EigenvaluesOnly)
                             .eigenvalues(); // in ascending order
  return squares[3 - dimensions] > least_ratio * least_ratio * squares[2];
}

bool determine(const Points& points, Registration registration)
{
  switch(registration) {
  case Registration::NONE: return true;
  case Registration::RIGID: return extend(points, 2);
  case Registration::AFFINE:
  case Registration::THIN_PLATE_SPLINE: return extend(points, 3);
  }
  return false;
}

Points without(const Points& points, Index left_out)
{
  Points others(3, points.cols() - 1);
  others << points.leftCols(left_out), points.rightCols(points.cols() - 1 - left_out);
  return others;
}

// Coordinates in which the given points have their center at the origin and are about as large as 1: in them,
// matrices of lengths and of ones are well conditioned.
class Scaled_coordinates
{
  Vector3d m_center;
  double m_scale;

public:
  explicit Scaled_coordinates(const Points& points)
    : m_center(points.rowwise().mean()),
      m_scale(std::sqrt(double(points.cols())) / (points.colwise() - m_center).norm())
  {
  }
  Points of(const Points& points) const { return m_scale * (points.colwise() - m_center); }
};

// The rows 1, x, y, z of an affine map; a column for each point.
MatrixXd affine_terms(const Points& points)
{
  MatrixXd terms(4, points.cols());
  terms << Eigen::RowVectorXd::Ones(points.cols()), points;
  return terms;
}

Points affinely_registered(const Points& before, const Points& after, const Points& points)
{
  const Scaled_coordinates scaled(before);
  const MatrixXd map =
    affine_terms(scaled.of(before)).transpose().colPivHouseholderQr().solve(after.transpose());
  return (affine_terms(scaled.of(points)).transpose() * map).transpose();
}

// The distances of points from nodes: a row for each point.
MatrixXd distances(const Points& points, const Points& nodes)
{
  MatrixXd result(points.cols(), nodes.cols());
  for(Index i = 0; i < points.cols(); ++i)
    result.row(i) = (nodes.colwise() - points.col(i)).colwise().norm();
  return result;
}

// The system of a thin-plate spline: for weights of the radial functions, which are orthogonal to affine
// maps, and for an affine map.
MatrixXd spline_matrix(const Points& nodes)
{
  const Index n = nodes.cols();
  MatrixXd a = MatrixXd::Zero(n + 4, n + 4);
  a.topLeftCorner(n, n) = distances(nodes, nodes);
  a.bottomLeftCorner(4, n) = affine_terms(nodes);
  a.topRightCorner(n, 4) = a.bottomLeftCorner(4, n).transpose();
  return a;
}

MatrixXd spline_values(const Points& after)
{
  MatrixXd values = MatrixXd::Zero(after.cols() + 4, 3);
  values.topRows(after.cols()) = after.transpose();
  return values;
}

Points registered_by_spline(const Points& before, const Points& after, const Points& points)
{
  const Scaled_coordinates scaled(before);
  const Points nodes = scaled.of(before), places = scaled.of(points);
  const MatrixXd coefficients = spline_matrix(nodes).partialPivLu().solve(spline_values(after));
  MatrixXd terms(points.cols(), nodes.cols() + 4);
  terms << distances(places, nodes), affine_terms(places).transpose();
  return (terms * coefficients).transpose();
}

// Errors of splines: with the inverse P of the system and the weights w of the spline through all points, the
// spline through the others misses point i by w_i / P_ii: no system is solved for a point (Rippa 1999).
Points spline_errors(const Points& before, const Points& after)
{
  const MatrixXd inverse = spline_matrix(Scaled_coordinates(before).of(before)).partialPivLu().inverse();
  const MatrixXd weights = inverse * spline_values(after);
  Points errors(3, before.cols());
  for(Index i = 0; i < before.cols(); ++i)
    errors.col(i) = weights.row(i).transpose() / inverse(i, i);
  return errors;
}

} // namespace

const char* name_of(Registration registration)
{
  switch(registration) {
  case Registration::NONE: return "no registration";
  case Registration::RIGID: return "rigid";
  case Registration::AFFINE: return "affine";
  case Registration::THIN_PLATE_SPLINE: return "thin-plate spline";
  }
  return "";
}

std::optional<Points> registered(Registration registration, const Points& before, const Points& after,
                                 const Points& points)
{
  if(!determine(before, registration))
    return std::nullopt;
  switch(registration) {
  case Registration::NONE: return points;
  case Registration::RIGID: {
    const Eigen::Matrix4d motion = Eigen::umeyama(before, after, false);
    return Points((motion.topLeftCorner<3, 3>() * points).colwise() + motion.topRightCorner<3, 1>());
  }
  case Registration::AFFINE: return affinely_registered(before, after, points);
  case Registration::THIN_PLATE_SPLINE: return registered_by_spline(before, after, points);
  }
  return std::nullopt;
}

std::vector<std::optional<Vector3d>> leave_one_out_errors(Registration registration, const Points& before,
                                                          const Points& after)
{
  std::vector<std::optional<Vector3d>> errors(std::size_t(before.cols()));
  const bool is_spline = registration == Registration::THIN_PLATE_SPLINE;
  const Points of_spline = is_spline && determine(before, registration) ? spline_errors(before, after)
                                                                        : Points();
  for(Index i = 0; i < before.cols(); ++i) {
    const Points others = without(before, i);
    if(is_spline) {
      if(determine(others, registration))
        errors[std::size_t(i)] = of_spline.col(i);
    } else if(const auto put = registered(registration, others, without(after, i), before.col(i))) {
      errors[std::size_t(i)] = after.col(i) - put->col(0);
    }
  }
  return errors;
}
