// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_SURFACE_BOUNDARY_SELF_INTERSECTIONS_H
#define CGAL_MIXED_MESH_3_INTERNAL_SURFACE_BOUNDARY_SELF_INTERSECTIONS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/surface/hausdorff_distance.h>

#include <cstddef>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Number of pairs of triangles that intersect other than in a common edge or vertex; a degenerate triangle
/// forms a pair with itself.
std::size_t number_of_self_intersections(Triangle_soup soup);

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#ifndef CGAL_MIXED_MESH_3_COMPILED
#include <CGAL/Mixed_mesh_3/internal/surface/boundary_self_intersections_impl.h>
#endif

#endif // CGAL_MIXED_MESH_3_INTERNAL_SURFACE_BOUNDARY_SELF_INTERSECTIONS_H
