// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which voxels of an image make a domain, as the command line says it.

#ifndef MIXED_MESH_3_DEMO_COMMON_VOXEL_SELECTION_H
#define MIXED_MESH_3_DEMO_COMMON_VOXEL_SELECTION_H

#include <optional>
#include <string>
#include <utility>
#include <vector>

/// Whether a file is an image, by its name.
bool is_image(const std::string& path);

/// Which voxels of an image count: those with values in ranges; without, those that are not 0.
struct Voxel_selection
{
  std::vector<std::pair<double, double>> ranges; // first and last
  std::string text = "that are not 0";           // for messages: "voxels ..."

  bool operator()(float value) const;
};

/// Labels as in `1-189,200`; none if the text is not like that.
std::optional<Voxel_selection> labels_selection(const std::string& text);
/// As in `brain=1-189,tumor=200`, with their names; none if the text is not like that.
std::optional<std::vector<std::pair<std::string, Voxel_selection>>> named_labels(const std::string& text);
Voxel_selection threshold_selection(double threshold);
/// All voxels of several selections of labels, which are whole numbers.
Voxel_selection united(const std::vector<Voxel_selection>& selections);

#endif // MIXED_MESH_3_DEMO_COMMON_VOXEL_SELECTION_H
