// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Report on landmarks.

#ifndef MIXED_MESH_3_APPS_BRAIN_SHIFT_LANDMARK_REPORT_H
#define MIXED_MESH_3_APPS_BRAIN_SHIFT_LANDMARK_REPORT_H

#include "brain_shift/landmarks.h"
#include "brain_shift/outcome.h"
#include "core/report_json.h"

/// The errors of all methods, and of each landmark.
/// \param is_corotational whether leave-one-out errors of the model are estimates
Json describe_landmarks(const Landmark_options& options, bool is_corotational,
                        const Landmark_facts& landmarks);

/// Prints a table of the methods on the standard output.
void print_landmarks(const Landmark_options& options, bool is_corotational, const Landmark_facts& landmarks);

#endif // MIXED_MESH_3_APPS_BRAIN_SHIFT_LANDMARK_REPORT_H
