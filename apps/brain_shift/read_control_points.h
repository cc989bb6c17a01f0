// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points with given displacements, from a table of numbers, or from two lists of fiducials.

#ifndef MIXED_MESH_3_APPS_BRAIN_SHIFT_READ_CONTROL_POINTS_H
#define MIXED_MESH_3_APPS_BRAIN_SHIFT_READ_CONTROL_POINTS_H

#include <array>
#include <cstddef>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

/// A point that was measured twice.
struct Control_point
{
  std::array<double, 3> position, displacement; // mm
  std::size_t number;                           // number of the line in the file, or of the point: from 1
  const char* unit = "line";                    // or "point"
  double weight = 1;
  std::string name = {}; // empty: the file has none

  std::string place() const { return unit + (' ' + std::to_string(number)); }
};

namespace control_points {

/// Throws a line that names a file and its defect.
[[noreturn]] void refuse(const std::string& path, const std::string& defect);

/// Throws if the file cannot be opened.
std::ifstream opened(const std::string& path);

/// The text without blanks before and after it.
std::string_view trimmed(std::string_view text);

/// The texts between separators, without the blanks around them. If separators are blanks, several blanks are
/// one separator.
std::vector<std::string_view> columns(std::string_view line, char separator = ',');

/// A text as a message can show it: short, and with nothing that a terminal would take for more than a
/// character.
std::string quoted(std::string_view text);

/// Reads a number, with a point in any locale; returns the defect, or nothing.
std::string read_number(std::string_view text, double& x);

/// Reads a coordinate in mm: nothing in a body is a kilometer away.
std::string read_coordinate(std::string_view text, double& x);

std::array<double, 3> difference(const std::array<double, 3>& p, const std::array<double, 3>& q);

/// Throws the defect of a line of a file.
using Refuse_line = std::function<void(const std::string&)>;

/// Reads a table: one of the headers, then lines with as many columns. Blank lines, and those that start with
/// #, are skipped. Columns are separated as in the header: by commas, semicolons, tabs or blanks.
/// \param headers headers with commas
/// \param add_row function that gets the cells of each line, its number from 1, and the function to call in
/// case of defects
/// \return the header of the table
/// \throw std::runtime_error a line naming the file, the line and the defect
std::string read_table(
  const std::string& path, const std::vector<std::string>& headers,
  const std::function<void(const std::vector<std::string_view>&, std::size_t, const Refuse_line&)>& add_row);

} // namespace control_points

/*!
Reads control points: a header `x,y,z,dx,dy,dz`, then a point and its displacement in each line, in mm. One
more column, `weight`, may have a positive number. Blank lines, and those that start with #, are skipped.
Columns are separated as in the header: by commas, semicolons, tabs or blanks.

\throw std::runtime_error a line naming the file, the line and the defect
*/
std::vector<Control_point> read_control_points(const std::string& path);

/// Whether a file is a list of fiducials of 3D Slicer, by its name: `.fcsv` or `.mrk.json`.
bool is_fiducials(const std::string& path);

/*!
Reads control points from two lists of fiducials, before and after, paired in their order. The result is
right, anterior, superior; lists in LPS are converted.

\throw std::runtime_error a line naming the file and the defect
*/
std::vector<Control_point> read_fiducials(const std::string& before, const std::string& after);

#endif // MIXED_MESH_3_APPS_BRAIN_SHIFT_READ_CONTROL_POINTS_H
