// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Location of points in elements.

#ifndef MIXED_MESH_3_APPS_BRAIN_SHIFT_LOCATE_H
#define MIXED_MESH_3_APPS_BRAIN_SHIFT_LOCATE_H

#include "brain_shift/options.h"
#include "brain_shift/outcome.h"
#include "core/types.h"

#include <string>
#include <vector>

/// Throws that a point is so far outside the mesh, in mm.
/// \param file file that the point comes from
[[noreturn]] void refuse_outside(const Options& options, const std::string& file, const Control_point& point,
                                 double distance);

/// Locates points.
/// \param file file that the points come from
/// \param warnings lines; a line is appended if the points are plainly in another unit
/// \throw std::runtime_error if a point is too far outside
Locations locate(const Mesh& mesh, const Options& options, const std::string& file,
                 const std::vector<Control_point>& points, std::vector<std::string>& warnings);

#endif // MIXED_MESH_3_APPS_BRAIN_SHIFT_LOCATE_H
