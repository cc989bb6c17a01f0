// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertices of the boundary that are fixed, slide, or touch the skull.

#ifndef MIXED_MESH_3_APPS_BRAIN_SHIFT_SUPPORTS_H
#define MIXED_MESH_3_APPS_BRAIN_SHIFT_SUPPORTS_H

#include "brain_shift/outcome.h"
#include "brain_shift/patches.h"
#include "brain_shift/read_control_points.h"
#include "core/types.h"

#include <array>
#include <limits>
#include <vector>

/// Parts of the boundary that are held, besides patches.
struct Support_options
{
  std::array<double, 3> up{};                                    // direction of height
  double fixed_below = 0.3, slide_below = 0;                     // fractions of the height
  double slide_beyond = std::numeric_limits<double>::infinity(); // mm from control points
};

Supports find_supports(const Mesh& mesh, const Boundary_patches& patches, const Support_options& options,
                       const std::vector<Control_point>& points);

#endif // MIXED_MESH_3_APPS_BRAIN_SHIFT_SUPPORTS_H
