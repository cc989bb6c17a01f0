// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_LINEAR_ELASTICITY_3_LINEAR_ELASTICITY_RESULT_3_H
#define CGAL_LINEAR_ELASTICITY_3_LINEAR_ELASTICITY_RESULT_3_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <locale>
#include <sstream>
#include <string>

namespace CGAL {

/// \ingroup PkgLinearElasticity3Ref
/// The outcome of an operation of `Linear_elasticity_3`.
enum class Linear_elasticity_status {
  SUCCESS,               ///< done
  NO_ELEMENTS,           ///< there are no elements, or none are left
  INVERTED_ELEMENT,      ///< the Jacobian of `element` is not positive: at a point of the quadrature, in
                         ///< `factor()`;
                         ///< anywhere in the deformed element, in a corotational `solve()`
  FREE_RIGID_MOTION,     ///< `number_of_free_motions` are neither supported nor controlled, such as `motion`
  CONTROL_POINT_OUTSIDE, ///< `control_point` is `distance` outside the mesh
  CONTRADICTORY_CONTROL_POINTS, ///< the displacement of `control_point` cannot be had with the others
  SOLVER_FAILED, ///< the system is not positive definite: elements are connected by hinges only
  NOT_CONVERGED, ///< no equilibrium of finite rotations was found, or none of contacts: the loads are too
                 ///< large, or it is unstable
  ORDER_NOT_SUPPORTED ///< displacements of order 2 cannot be had with contacts, with finite rotations, or
                      ///< with an iterative solver that wants rigid motions
};

/// \ingroup PkgLinearElasticity3Ref
/// A rigid motion: the displacement at `p` is `translation + rotation x (p - center)`.
struct Rigid_motion_3
{
  std::array<double, 3> translation{}; ///< mm
  std::array<double, 3> rotation{};    ///< direction of the axis, with the angle in radians as length
  std::array<double, 3> center{};      ///< mm
};

/// \ingroup PkgLinearElasticity3Ref
/// The result of an operation of `Linear_elasticity_3`.
struct Linear_elasticity_result_3
{
  /// The outcome; the other members belong to some of the statuses.
  Linear_elasticity_status status = Linear_elasticity_status::SUCCESS;
  /// The number of the inverted element.
  std::size_t element = 0;
  std::size_t control_point = 0; ///< from 0
  double distance = 0;           ///< mm
  /// The number of rigid motions that are free.
  int number_of_free_motions = 0;
  Rigid_motion_3 motion; ///< one of the free motions

  /// Whether the operation was successful.
  bool is_success() const { return status == Linear_elasticity_status::SUCCESS; }

  /// The status in a line, in which control points are numbered from 1, elements from 0.
  std::string description() const
  {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.precision(4);
    switch(status) {
    case Linear_elasticity_status::SUCCESS: out << "success"; break;
    case Linear_elasticity_status::NO_ELEMENTS: out << "there is no element"; break;
    case Linear_elasticity_status::INVERTED_ELEMENT: out << "element " << element << " is inverted"; break;
    case Linear_elasticity_status::FREE_RIGID_MOTION: describe_motion(out); break;
    case Linear_elasticity_status::CONTROL_POINT_OUTSIDE:
      out << "control point " << control_point + 1 << " is " << distance << " mm outside the mesh";
      break;
    case Linear_elasticity_status::CONTRADICTORY_CONTROL_POINTS:
      out << "the displacement of control point " << control_point + 1 << " contradicts "
          << "other control points or supports in the same element: it misses it by " << distance << " mm";
      break;
    case Linear_elasticity_status::SOLVER_FAILED:
      out << "the system cannot be solved: parts hang together by a vertex or an edge only, or elements are "
             "flat up to rounding";
      break;
    case Linear_elasticity_status::NOT_CONVERGED:
      out << "no equilibrium was found: too much is asked for, or the body buckles";
      break;
    case Linear_elasticity_status::ORDER_NOT_SUPPORTED:
      out << "displacements of order 2 cannot be had with contacts, finite rotations or iterative solvers";
      break;
    }
    return out.str();
  }

private:
  using Vector = std::array<double, 3>;

  static double length(const Vector& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

  static void write(std::ostream& out, const Vector& v, double scale)
  {
    const auto rounded = [](double x) { return std::round(x * 1000) / 1000 + 0.; }; // no minus zero
    out << "(" << rounded(v[0] * scale) << ", " << rounded(v[1] * scale) << ", " << rounded(v[2] * scale)
        << ")";
  }

  void describe_motion(std::ostream& out) const
  {
    const Vector &t = motion.translation, &r = motion.rotation;
    out << "the supports leave " << number_of_free_motions
        << (number_of_free_motions == 1 ? " rigid motion free: " : " rigid motions free, among them ");
    const double turn = length(r);
    if(!(turn > 0)) {
      out << "translation along ";
      write(out, t, 1 / length(t));
      return;
    }
    // The axis is where the displacement is along the rotation: center + r x t / |r|^2.
    const double s = 1 / (turn * turn);
    const Vector axis{motion.center[0] + s * (r[1] * t[2] - r[2] * t[1]),
                      motion.center[1] + s * (r[2] * t[0] - r[0] * t[2]),
                      motion.center[2] + s * (r[0] * t[1] - r[1] * t[0])};
    out << "rotation about the axis through ";
    write(out, axis, 1);
    out << " along ";
    write(out, r, 1 / turn);
  }
};

} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_LINEAR_ELASTICITY_RESULT_3_H
