// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Text of numbers and points in messages.

#ifndef MIXED_MESH_3_APPS_CORE_MESSAGES_H
#define MIXED_MESH_3_APPS_CORE_MESSAGES_H

#include <array>
#include <cstddef>
#include <string>

/// A text for the terminal: in one line, and without control characters, which may be in names of files.
std::string printable(const std::string& text);

/// A number with three digits.
std::string rounded(double x);

/// A share in percent, with one decimal.
std::string percent(double share);

/// A ratio in words before its reference: in percent, "99.8 % of", or, where that says less, "12.3 times".
std::string as_part_of(double ratio);

/// A time that was measured: in milliseconds, seconds, or minutes.
std::string duration(double seconds);

/// A volume with its unit: with lengths in mm, or in a unit that no file names.
std::string volume_with_unit(double volume, bool is_in_mm);

/// A number and what it counts.
std::string counted(std::size_t n, const char* one, const char* many);

/// A point, with more digits than a distance: it may be far from the origin.
std::string place(const std::array<double, 3>& p);

#endif // MIXED_MESH_3_APPS_CORE_MESSAGES_H
