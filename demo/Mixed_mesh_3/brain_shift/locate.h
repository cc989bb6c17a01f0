// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// In which elements points are.

#ifndef MIXED_MESH_3_DEMO_BRAIN_SHIFT_LOCATE_H
#define MIXED_MESH_3_DEMO_BRAIN_SHIFT_LOCATE_H

#include "brain_shift/options.h"
#include "brain_shift/outcome.h"
#include "common/types.h"

#include <string>
#include <vector>

/// Throws that a point is so far outside the mesh, in mm.
/// \param file that the point comes from
[[noreturn]] void refuse_outside(const Options& options, const std::string& file, const Control_point& point,
                                 double distance);

/// Where points are.
/// \param file that they come from
/// \param warnings gets a line if they are plainly in another unit
/// \throw std::runtime_error if one is too far outside
Locations locate(const Mesh& mesh, const Options& options, const std::string& file,
                 const std::vector<Control_point>& points, std::vector<std::string>& warnings);

#endif // MIXED_MESH_3_DEMO_BRAIN_SHIFT_LOCATE_H
