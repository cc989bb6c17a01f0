// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Groups of labels of an image that become subdomains, and layers that are added to them.

#ifndef MIXED_MESH_3_APPS_MIXED_MESH_3_LABEL_GROUPS_H
#define MIXED_MESH_3_APPS_MIXED_MESH_3_LABEL_GROUPS_H

#include "core/read_label_surface.h"
#include "core/voxel_selection.h"
#include "mixed_mesh_3/meshing_options.h"
#include "mixed_mesh_3/outcome.h"

#include <CGAL/Mixed_mesh_3/Element_attributes.h>

#include <optional>
#include <string>
#include <vector>

/// Labels that are one subdomain.
struct Label_group
{
  std::string name;
  Voxel_selection voxels;
  CGAL::Mixed_meshes_3::Subdomain_index index;
};

/// The groups that the options choose; a warning names labels of the image that are in none of FreeSurfer's.
/// \throw std::runtime_error if the image has no voxels of a group
std::vector<Label_group> label_groups(const Input_options& options, const Label_image& image,
                                      std::vector<std::string>& warnings);

/// All voxels of the groups.
Voxel_selection united(const std::vector<Label_group>& groups);

/// Adds the layers of the options to an image, and their new names to the groups. Returns none if there are
/// no layers.
/// \throw std::runtime_error if a new layer has no voxels
std::optional<Label_image> with_layers(const Input_options& options, const Label_image& image,
                                       std::vector<Label_group>& groups, Outcome& outcome);

#endif // MIXED_MESH_3_APPS_MIXED_MESH_3_LABEL_GROUPS_H
