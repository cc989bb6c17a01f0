// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The solid that arbitrary triangles enclose: triangles may cut each other, overlap, and share edges of any
// number.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_REPAIR_SOLID_READING_H
#define CGAL_MIXED_MESH_3_INTERNAL_REPAIR_SOLID_READING_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_3/internal/repair/Solid_rule.h>

#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The boundary of a solid: a closed manifold, oriented outwards.
struct Solid_reading
{
  using Point = Predicates_kernel::Point_3;

  std::vector<Point> points;
  std::vector<std::array<std::size_t, 3>> triangles;
  Solid_rule rule = Solid_rule::WINDING;
  /// Whether there is a result: not if more than `most` pairs of triangles meet, or no ray tells what is
  /// solid.
  bool is_complete = true;
  double inverted_volume = 0; ///< volume of places that triangles wind around inwards
};

/*!
Returns the boundary of the solid that triangles enclose, by the first rule that can be applied.

The triangles are cut exactly where they meet; the result consists of the pieces that have solid on one side
only. Then computed points are rounded to double: triangles may be degenerate or cross each other by a
rounding error. Where the solid touches itself in points and edges, each sheet has its own vertices.

Source: Zhou, Grinspun, Zorin, Jacobson: Mesh arrangements for solid geometry (SIGGRAPH 2016).

\param points points with finite coordinates
\param triangles indices of points; triangles without area are skipped
\param most number of pairs of triangles that meet, or of pieces, above which nothing is done; this number
takes some ten seconds
\par Complexity
O((n + k) log(n + k)) for n triangles, k pairs of which meet
*/
Solid_reading read_solid(const std::vector<Solid_reading::Point>& points,
                         const std::vector<std::array<std::size_t, 3>>& triangles, std::size_t most = 300000);

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#ifndef CGAL_MIXED_MESH_3_COMPILED
#include <CGAL/Mixed_mesh_3/internal/repair/Solid_reading_impl.h>
#endif

#endif // CGAL_MIXED_MESH_3_INTERNAL_REPAIR_SOLID_READING_H
