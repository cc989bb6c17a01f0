// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Measures and checks of a mesh.

#ifndef MIXED_MESH_3_APPS_MIXED_MESH_3_EXAMINE_H
#define MIXED_MESH_3_APPS_MIXED_MESH_3_EXAMINE_H

#include "core/Stage_log.h"
#include "core/comparison.h"
#include "core/read_surface.h"
#include "mixed_mesh_3/meshing_options.h"
#include "mixed_mesh_3/outcome.h"

/// The aspect-ratio coefficients of a mesh.
Aspect_ratios aspect_ratios_of(const Mesh& mesh);

/// Checks and measures the mesh that is to be written; a tolerance that is missed, or a topology or volume
/// other than the surface's, becomes the status.
/// \param tree tree of the surface; if null, it is built
/// \throw Invalid_mesh if a check fails
/// \throw std::runtime_error if the volume is impossible
void examine(const Mesh& mesh, const Surface& surface, Surface_tree tree, const Meshing_options& options,
             Stage_log& log, Outcome& outcome);

#endif // MIXED_MESH_3_APPS_MIXED_MESH_3_EXAMINE_H
