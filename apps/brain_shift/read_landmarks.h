// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pairs of points before and after the shift, from files of the programs that measure them.

#ifndef MIXED_MESH_3_APPS_BRAIN_SHIFT_READ_LANDMARKS_H
#define MIXED_MESH_3_APPS_BRAIN_SHIFT_READ_LANDMARKS_H

#include "brain_shift/read_control_points.h"

#include <cstddef>
#include <string>
#include <vector>

/// Least number of landmarks: an affine map is determined by four points, and one more has to be predicted.
inline constexpr std::size_t least_number_of_landmarks = 5;

/*!
Reads landmarks, in mm. The format follows from the name of the file:
- `.tag`: tag points of MNI, of two volumes, the first one before; coordinates are right, anterior, superior;
- `.fcsv` or `.mrk.json`: fiducials of 3D Slicer, see `read_fiducials()`;
- others: a table as of `control_points::read_table()`, with the header `x,y,z,x_after,y_after,z_after`,
optionally with one more column, `name`, or with the header of control points, `x,y,z,dx,dy,dz`.

\param after file of the fiducials after; empty for the other formats
\throw std::runtime_error a line naming the file and the defect: there are at least
       `least_number_of_landmarks`, no two of them at the same place
*/
std::vector<Control_point> read_landmarks(const std::string& path, const std::string& after);

#endif // MIXED_MESH_3_APPS_BRAIN_SHIFT_READ_LANDMARKS_H
