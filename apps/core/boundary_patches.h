// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Patches of the boundary: the faces whose center is inside a shape, such as a sphere, or inside a closed
// surface; the same for the programs and for Python.

#ifndef MIXED_MESH_3_APPS_CORE_BOUNDARY_PATCHES_H
#define MIXED_MESH_3_APPS_CORE_BOUNDARY_PATCHES_H

#include "core/types.h"

#include <CGAL/Mixed_mesh_3/Face.h>

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

/// Tests whether a point is inside, on it, or outside by a distance at most. Centers of faces on a plane are
/// beside the plane by rounding.
using Patch_test = std::function<bool(const std::array<double, 3>&, double)>;

/// A sphere, a box or a half-space, as the user gives it.
struct Patch_shape
{
  std::string defect; // defect of its numbers; empty if there is none
  Patch_test contains;
};

/// The shape of the kind `sphere`, `box` or `plane`; nothing for other kinds.
std::optional<Patch_shape> patch_shape(const std::string& kind, const std::vector<double>& numbers);

/// The mean of the vertices.
std::array<double, 3> center_of(const Mesh& mesh, const CGAL::Mixed_meshes_3::Face& face);

/// The distance by which a center may be outside of a shape: that within which a vertex is on the surface.
double patch_tolerance(const Mesh& mesh);

/// The positions of the faces that are in a patch.
std::vector<std::size_t> faces_in_patch(const Mesh& mesh,
                                        const std::vector<CGAL::Mixed_meshes_3::Face>& faces,
                                        const Patch_test& contains);

/// A part of the message that a patch has no face: the bounding box of the mesh.
std::string place_of_mesh(const Mesh& mesh);

/// The message that a shape or a surface has no face of the boundary.
std::string sentence_on_empty_patch(const Mesh& mesh);

#endif // MIXED_MESH_3_APPS_CORE_BOUNDARY_PATCHES_H
