// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points with given displacements, from a table of numbers with commas between them.

#ifndef MIXED_MESH_3_DEMO_BRAIN_SHIFT_READ_CONTROL_POINTS_H
#define MIXED_MESH_3_DEMO_BRAIN_SHIFT_READ_CONTROL_POINTS_H

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// A point that was measured twice.
struct Control_point
{
  std::array<double, 3> position, displacement; // mm
  std::size_t line;                             // in the file, from 1
};

namespace control_points {

/// What is between commas, without the blanks around it.
std::vector<std::string_view> columns(std::string_view line);

/// As a message can show it: short, and nothing that a terminal would take for more than a character.
std::string quoted(std::string_view text);

/// Reads a number, with a point whatever the locale; returns what is wrong with it, or nothing.
std::string read_number(std::string_view text, double& x);

} // namespace control_points

/*!
Reads control points: a header `x,y,z,dx,dy,dz`, then a point and its displacement in each line, in mm. Blank
lines, and those that start with #, are skipped.

\throw std::runtime_error a line naming the file, the line and the defect
*/
std::vector<Control_point> read_control_points(const std::string& path);

#endif // MIXED_MESH_3_DEMO_BRAIN_SHIFT_READ_CONTROL_POINTS_H
