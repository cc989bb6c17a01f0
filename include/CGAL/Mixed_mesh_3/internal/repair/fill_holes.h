// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Closing of holes of a surface, if the area to be invented is small.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_REPAIR_FILL_HOLES_H
#define CGAL_MIXED_MESH_3_INTERNAL_REPAIR_FILL_HOLES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>

#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// A hole of a surface, given by its border.
struct Surface_hole
{
  std::vector<std::size_t> border; ///< points of the border
  double length = 0;               ///< length of the border
  double area = 0;                 ///< area of the triangles that close the hole
  double width = 0; ///< diameter of a disk of that area: no larger ball passes through a flat hole

  const std::size_t& place() const { return border.front(); }
};

struct Hole_filling
{
  std::vector<Surface_hole> filled, left;  ///< filled holes and holes left open, the longest first
  std::size_t number_of_dropped_faces = 0; ///< number of faces of dropped sheets
  double share_of_dropped_area = 0;        ///< share of dropped faces in the area of all triangles
};

/*!
Closes the holes of a surface, with as little area as possible. Components connected by edges are examined one
by one: if the triangles that would close a component had more than a share of its area, its holes are left. A
component that is a small share of all, and nearly flat, is a sheet: a sheet bounds nothing and is dropped.

\param points,triangles the surface; it is oriented if possible, and non-manifold vertices are doubled
\param largest_share share of the area of a component that holes may have
\par Complexity
Complexity of `CGAL::Polygon_mesh_processing::triangulate_hole_polyline()`
*/
Hole_filling fill_holes(std::vector<Predicates_kernel::Point_3>& points,
                        std::vector<std::array<std::size_t, 3>>& triangles, double largest_share);

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#ifndef CGAL_MIXED_MESH_3_COMPILED
#include <CGAL/Mixed_mesh_3/internal/repair/fill_holes_impl.h>
#endif

#endif // CGAL_MIXED_MESH_3_INTERNAL_REPAIR_FILL_HOLES_H
