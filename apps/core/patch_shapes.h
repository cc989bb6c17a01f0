// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shapes of patches in the command line, such as "sphere:0,0,0,5".

#ifndef MIXED_MESH_3_APPS_CORE_PATCH_SHAPES_H
#define MIXED_MESH_3_APPS_CORE_PATCH_SHAPES_H

#include "core/boundary_patches.h"

#include <optional>
#include <string>

/// The shape of a text that begins with `sphere:`, `box:` or `plane:`; nothing for others, such as files.
std::optional<Patch_shape> patch_shape(const std::string& text);

#endif // MIXED_MESH_3_APPS_CORE_PATCH_SHAPES_H
