// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_BASE_LATTICE_POINT_H
#define CGAL_MIXED_MESH_3_INTERNAL_BASE_LATTICE_POINT_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <array>
#include <cstdint>

namespace CGAL {
namespace Mixed_meshes_3 {

/// A position on the integer lattice of an octree: vertices and cell centers are lattice points.
using Lattice_point = std::array<std::uint32_t, 3>;

namespace internal {

/// The deepest level of an octree: a cell there has side 2, so that its center still is a lattice point.
inline constexpr int deepest_octree_level = 20;
/// The side of the root of an octree on the lattice.
inline constexpr std::uint32_t lattice_root_side = std::uint32_t(1) << (deepest_octree_level + 1);

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_BASE_LATTICE_POINT_H
