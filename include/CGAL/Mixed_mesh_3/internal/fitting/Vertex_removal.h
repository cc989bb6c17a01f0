// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_VERTEX_REMOVAL_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_VERTEX_REMOVAL_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Core_mesh.h>

#include <cstddef>
#include <functional>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Function that removes a number of vertices from a mesh, those of the boundary that are off the surface
/// first, and returns whether it has removed so many.
using Vertex_removal = std::function<bool(Core_mesh&, std::size_t)>;

/// Share of the boundary vertices off the surface that is small enough for them to be removed: the mesh is
/// worth mending, as any other one has fewer vertices in the region.
constexpr double removable_share = 0.01;

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_VERTEX_REMOVAL_H
