// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Location of points in elements.

#ifndef MIXED_MESH_3_APPS_BRAIN_SHIFT_LOCATE_H
#define MIXED_MESH_3_APPS_BRAIN_SHIFT_LOCATE_H

#include "brain_shift/outcome.h"
#include "core/types.h"

#include <string>
#include <vector>

/// The way in which points move the mesh.
struct Point_options
{
  std::string file, file_after; // the latter of fiducials only
  double max_distance = 5;      // mm outside the mesh
  double compliance = 0;        // mm/mN
  double radius = 0;            // mm

  // Whether a control point itself has exactly the requested displacement.
  bool is_exact() const { return compliance == 0 && radius == 0; }
};

/// Points with given displacements.
struct Controls
{
  std::string mesh; // file of the mesh, for messages
  Point_options options;
  std::vector<Control_point> points;

  std::vector<Vector> displacements() const;
};

/// Throws that a point is so far outside the mesh, in mm.
[[noreturn]] void refuse_outside(const Controls& controls, const Control_point& point, double distance);

/// Locates points.
/// \param warnings lines; a line is appended if the points are plainly in another unit
/// \throw std::runtime_error if a point is too far outside
Locations locate(const Mesh& mesh, const Controls& controls, std::vector<std::string>& warnings);

#endif // MIXED_MESH_3_APPS_BRAIN_SHIFT_LOCATE_H
