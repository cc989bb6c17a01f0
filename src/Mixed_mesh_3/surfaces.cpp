// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The library Mixed_mesh_3_compiled: surfaces and sheets, and the oracles of the models that most users have.

#include <CGAL/Mixed_mesh_3/internal/meshing/usual_models.h>
#include <CGAL/Mixed_mesh_3/internal/surface/Sheet_oracle_3_impl.h>
#include <CGAL/Mixed_mesh_3/internal/surface/Surface_oracle_3_impl.h>
#include <CGAL/Mixed_mesh_3/internal/surface/boundary_self_intersections_impl.h>

#ifndef CGAL_MIXED_MESH_3_COMPILED
#error "build this file with CGAL_MIXED_MESH_3_COMPILED defined"
#endif

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

CGAL_MIXED_MESH_3_USUAL_MODELS(template)

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL
