// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points that were measured before and after the shift, and the errors of registrations and of the model at
// these points.

#ifndef MIXED_MESH_3_APPS_BRAIN_SHIFT_LANDMARKS_H
#define MIXED_MESH_3_APPS_BRAIN_SHIFT_LANDMARKS_H

#include "brain_shift/locate.h"
#include "brain_shift/outcome.h"
#include "core/types.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

/// The landmarks, which are also used as control points.
struct Landmark_options : Point_options
{
  std::size_t number_given = 0;    // the outermost ones; 0: the default number
  bool are_control_points = false; // whether there are no others
};

/// Reads the landmarks, and checks that there are enough for the requested number of given ones.
/// \throw std::runtime_error a line naming the file and the defect
Landmark_facts read_landmarks(const Landmark_options& options);

/// Finds the landmarks in the mesh, and the landmarks nearest to its boundary, which are the given ones.
/// \throw std::runtime_error if a landmark is too far outside
void place_landmarks(const Mesh& mesh, const std::string& mesh_file, const Landmark_options& options,
                     Outcome& outcome);

/// Measures the errors of registrations by the landmarks alone.
void compare_registrations(Landmark_facts& landmarks);

/// Adds warnings: on methods that landmarks do not determine, and on supports that hold landmarks measured to
/// move.
void warn_of_landmarks(const std::string& file, Outcome& outcome);

/// The errors of a method at its targets.
struct Error_summary
{
  double mean, median, largest; // mm
};

/// \param is_target whether each landmark is a target
/// \return nothing if there is a target that the method does not predict
std::optional<Error_summary> summary(const std::vector<std::optional<Vector>>& errors,
                                     const std::vector<bool>& is_target);

/// The landmarks that are not given.
std::vector<bool> targets(const Landmark_facts& landmarks);

#endif // MIXED_MESH_3_APPS_BRAIN_SHIFT_LANDMARKS_H
