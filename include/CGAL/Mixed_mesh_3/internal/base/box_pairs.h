// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_BASE_BOX_PAIRS_H
#define CGAL_MIXED_MESH_3_INTERNAL_BASE_BOX_PAIRS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/box_intersection_d.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// A box around a triangle, with the number of the triangle.
using Numbered_box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;

/// Number of boxes below which pairs are found by sorting along one axis. For the small boxes of the
/// triangles of a surface (100,000), 10, the default, takes three times as long; 4,000 a tenth longer.
inline constexpr std::ptrdiff_t cutoff_of_boxes = 1000;

/// Calls `f(a, b)` for each pair of boxes that meet, in any order. The order of the boxes is changed.
/// \par Complexity
/// O(n log n) for n boxes, if few meet
template <class F>
void for_each_pair_of_boxes(std::vector<Numbered_box>& boxes, const F& f)
{
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), f, cutoff_of_boxes);
}

/// The same for pairs with one box of each of two sets.
template <class F>
void for_each_pair_of_boxes(std::vector<Numbered_box>& boxes, std::vector<Numbered_box>& others, const F& f)
{
  CGAL::box_intersection_d(boxes.begin(), boxes.end(), others.begin(), others.end(), f, cutoff_of_boxes);
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_BASE_BOX_PAIRS_H
