// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Registrations by pairs of points alone, which a model has to surpass.

#ifndef MIXED_MESH_3_APPS_BRAIN_SHIFT_REGISTRATION_H
#define MIXED_MESH_3_APPS_BRAIN_SHIFT_REGISTRATION_H

#include <Eigen/Core>

#include <array>
#include <optional>
#include <vector>

/// The kinds of registrations. Rigid and affine registrations are least squares. A thin-plate spline goes
/// through the points: an affine map plus a sum of radial functions |x - p|, which has the least bending
/// energy in three dimensions (Bookstein 1989).
enum class Registration { NONE, RIGID, AFFINE, THIN_PLATE_SPLINE };

inline constexpr std::array<Registration, 4> registrations{Registration::NONE, Registration::RIGID,
                                                           Registration::AFFINE,
                                                           Registration::THIN_PLATE_SPLINE};

const char* name_of(Registration registration);

/// A point in each column, in mm.
using Points = Eigen::Matrix3Xd;

/// The places to which a registration moves points.
/// \param before, after pairs of points that determine the registration
/// \param points points to be moved
/// \return nothing if the pairs do not determine the registration: the pairs of a rigid registration must not
/// lie on a line, and the pairs of an affine registration, or of a thin-plate spline, not in a plane
std::optional<Points> registered(Registration registration, const Points& before, const Points& after,
                                 const Points& points);

/// The error at each pair: the point after minus the place to which the registration by the other pairs moves
/// the point before; nothing if the other pairs do not determine the registration.
/// \par Complexity
/// Quadratic in the number of pairs; cubic for thin-plate splines
std::vector<std::optional<Eigen::Vector3d>> leave_one_out_errors(Registration registration,
                                                                 const Points& before, const Points& after);

#endif // MIXED_MESH_3_APPS_BRAIN_SHIFT_REGISTRATION_H
