// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Selection of the voxels of an image that make a domain, from the command line.

#ifndef MIXED_MESH_3_APPS_CORE_VOXEL_SELECTION_H
#define MIXED_MESH_3_APPS_CORE_VOXEL_SELECTION_H

#include "core/Label_table.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

/// The endings of images, in one line.
extern const char* const image_endings;

/// Whether a file is an image, by its name.
bool is_image(const std::string& path);

/// Selected voxels of an image: voxels with values in ranges; without ranges, voxels that are not 0.
struct Voxel_selection
{
  std::vector<std::pair<double, double>> ranges; // first and last
  std::string text = "that are not 0";           // for messages: "voxels ..."

  bool operator()(float value) const;
};

/// The voxels with some labels.
Voxel_selection labels_selection(const std::vector<std::uint32_t>& labels);
/// Labels as in `1-189,200`; names of the table may stand instead of numbers.
/// \throw std::invalid_argument a line, if the text has another form, or for a name that is not in the table
Voxel_selection labels_selection(const std::string& text, const Label_table& table);
/// Labels with names as in `brain=1-189,tumor=200`.
/// \throw std::invalid_argument as above
std::vector<std::pair<std::string, Voxel_selection>> named_labels(const std::string& text,
                                                                  const Label_table& table);
Voxel_selection threshold_selection(double threshold);
/// All voxels of several selections of labels, which are whole numbers.
Voxel_selection united(const std::vector<Voxel_selection>& selections);

#endif // MIXED_MESH_3_APPS_CORE_VOXEL_SELECTION_H
