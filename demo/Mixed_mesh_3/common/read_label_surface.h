// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Closed surfaces out of segmentations; needs nifti_clib.

#ifndef MIXED_MESH_3_DEMO_COMMON_READ_LABEL_SURFACE_H
#define MIXED_MESH_3_DEMO_COMMON_READ_LABEL_SURFACE_H

#include "common/read_surface.h"
#include "common/voxel_selection.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

/// How the surface is made.
struct Label_surface_options
{
  std::optional<double> smoothing; // deviation in mm; default: the largest spacing of voxels
  std::size_t vertices = 0;        // about how many the surface gets
};

/// \throw std::runtime_error a line naming the file and the defect
Surface read_label_surface(const std::string& path, const Voxel_selection& selection,
                           const Label_surface_options& options, Surface_facts& facts,
                           std::vector<std::string>& warnings);

#endif // MIXED_MESH_3_DEMO_COMMON_READ_LABEL_SURFACE_H
