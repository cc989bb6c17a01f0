// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Holes of a surface are closed, if little is to be invented for that.

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

/// A hole of a surface, by its border.
struct Surface_hole
{
  std::vector<std::size_t> border; ///< its points
  double length = 0;               ///< of the border
  double area = 0;                 ///< of the triangles that close it
  double width = 0; ///< diameter of a disk of that area: no larger ball gets through a flat hole

  const std::size_t& place() const { return border.front(); }
};

struct Hole_filling
{
  std::vector<Surface_hole> filled, left;  ///< the longest first
  std::size_t number_of_dropped_faces = 0; ///< of sheets
  double share_of_dropped_area = 0;        ///< of that of all triangles
};

/*!
Closes the holes of a surface, with as little area as possible. Parts that hang together by edges are looked
at one by one: if the triangles that would close a part had more than a share of its area, its holes are
left. A part that is but a small share of all, and nearly flat, is a sheet: it bounds nothing and is
dropped.

\param points,triangles the surface; it is oriented if it can be, and vertices where it is no manifold are
       doubled
\param largest_share of the area of a part that holes may have
\par Complexity
As that of `CGAL::Polygon_mesh_processing::triangulate_hole_polyline()`
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
