// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The vertices that thin subdomains take, estimated before there is a mesh.

#ifndef MIXED_MESH_3_APPS_MIXED_MESH_3_LAYERS_H
#define MIXED_MESH_3_APPS_MIXED_MESH_3_LAYERS_H

#include "core/read_label_surface.h"
#include "core/voxel_selection.h"
#include "mixed_mesh_3/meshing_options.h"
#include "mixed_mesh_3/subdomains.h"

#include <string>
#include <vector>

/// A subdomain as a layer, or what is between subdomains.
struct Layer
{
  std::string name;
  double thickness; // on average
  double vertices;  // that it takes
};

/// The layers that the visible parts of surfaces form.
std::vector<Layer> layers_of(const std::vector<Subdomain>& subdomains);

/// The layers that labels of an image form, and the gaps between them: where these are thin, and not on
/// average. No surface is needed for that.
/// \param names one for each selection
std::vector<Layer> layers_of(const Label_image& image, const std::vector<Voxel_selection>& labels,
                             const std::vector<std::string>& names);

/// Checks that the budget can hold layers. Too few vertices are told, and refused where parts would be lost,
/// but for `--best-effort`.
void check_layers(const std::vector<Layer>& layers, const Meshing_options& options,
                  std::vector<std::string>& warnings);

#endif // MIXED_MESH_3_APPS_MIXED_MESH_3_LAYERS_H
