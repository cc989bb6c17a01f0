// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Patches of the boundary: the faces whose center is inside a shape, such as "sphere:0,0,0,5", or inside a
// closed surface.

#ifndef MIXED_MESH_3_APPS_CORE_PATCH_SHAPES_H
#define MIXED_MESH_3_APPS_CORE_PATCH_SHAPES_H

#include "core/types.h"

#include <CGAL/Mixed_mesh_3/Face.h>

#include <array>
#include <functional>
#include <optional>
#include <string>

/// A sphere, a box or a half-space, as the user gives it.
struct Patch_shape
{
  std::string defect; // defect of the text; empty if there is none
  /// Tests whether a point is inside, on it, or outside by a distance at most. Centers of faces on a plane
  /// are beside the plane by rounding.
  std::function<bool(const std::array<double, 3>&, double)> contains;
};

/// The shape of a text that begins with `sphere:`, `box:` or `plane:`; nothing for others, such as files.
std::optional<Patch_shape> patch_shape(const std::string& text);

/// The mean of the vertices.
std::array<double, 3> center_of(const Mesh& mesh, const CGAL::Mixed_meshes_3::Face& face);

/// The distance by which a center may be outside of a shape: that within which a vertex is on the surface.
double patch_tolerance(const Mesh& mesh);

/// A part of the message that a patch has no face: the bounding box of the mesh.
std::string place_of_mesh(const Mesh& mesh);

#endif // MIXED_MESH_3_APPS_CORE_PATCH_SHAPES_H
