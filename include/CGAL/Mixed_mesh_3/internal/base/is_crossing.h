// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_BASE_IS_CROSSING_H
#define CGAL_MIXED_MESH_3_INTERNAL_BASE_IS_CROSSING_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/enum.h>
#include <CGAL/intersections.h>

#include <array>
#include <cstddef>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Whether two triangles meet in more than the vertices and edges they share; equal ones do. Exact.
/// \param points `Predicates_kernel::Point_3` of a vertex, by the operator `[]`
template <class Index, class Points>
bool is_crossing(const std::array<Index, 3>& s, const std::array<Index, 3>& t, const Points& points)
{
  using Kernel = Predicates_kernel;
  const auto triangle = [&](const std::array<Index, 3>& v) {
    return Kernel::Triangle_3(points[v[0]], points[v[1]], points[v[2]]);
  };
  // The vertices are turned such that the shared ones come first.
  std::size_t shared = 0;
  const auto turned = [&shared](const std::array<Index, 3>& v, const std::array<Index, 3>& other) {
    std::array<Index, 3> result{};
    std::array<bool, 3> is_shared{};
    for(std::size_t i = 0; i < 3; ++i)
      is_shared[i] = v[i] == other[0] || v[i] == other[1] || v[i] == other[2];
    std::size_t n = 0;
    for(std::size_t i = 0; i < 3; ++i)
      if(is_shared[i])
        result[n++] = v[i];
    shared = n;
    for(std::size_t i = 0; i < 3; ++i)
      if(!is_shared[i])
        result[n++] = v[i];
    return result;
  };
  const std::array<Index, 3> a = turned(s, t), b = turned(t, s);
  // Few of the edges opposite to a shared vertex have a box that meets the box of the other triangle.
  const auto meets = [&](const std::array<Index, 3>& v, const std::array<Index, 3>& other) {
    const Kernel::Segment_3 opposite(points[v[1]], points[v[2]]);
    const Kernel::Triangle_3 whole = triangle(other);
    return CGAL::do_overlap(opposite.bbox(), whole.bbox()) && CGAL::do_intersect(opposite, whole);
  };
  switch(shared) {
  case 0: return CGAL::do_intersect(triangle(s), triangle(t));
  case 1: return meets(a, t) || meets(b, s);
  case 2: // folded flat
    return CGAL::coplanar(points[a[0]], points[a[1]], points[a[2]], points[b[2]])
           && CGAL::coplanar_orientation(points[a[0]], points[a[1]], points[a[2]], points[b[2]]) == POSITIVE;
  default: return true;
  }
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_BASE_IS_CROSSING_H
