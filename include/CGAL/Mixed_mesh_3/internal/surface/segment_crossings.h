// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Places where a segment crosses the triangles of an AABB tree.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_SURFACE_SEGMENT_CROSSINGS_H
#define CGAL_MIXED_MESH_3_INTERNAL_SURFACE_SEGMENT_CROSSINGS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <iterator>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The shares of the segment pq at which it crosses triangles; none for triangles parallel to it. Which
/// triangles it meets is exact, the shares are rounded.
/// \param triangle_of returns the triangle of a primitive of the tree
template <class Tree, class Triangle_of>
std::vector<double> segment_crossings(const Tree& tree, const Vec3& p, const Vec3& q,
                                      const Triangle_of& triangle_of)
{
  const auto point = [](const Vec3& v) { return Predicates_kernel::Point_3(v[0], v[1], v[2]); };
  std::vector<typename Tree::Primitive_id> primitives;
  tree.all_intersected_primitives(Predicates_kernel::Segment_3(point(p), point(q)),
                                  std::back_inserter(primitives));
  std::vector<double> shares;
  for(const auto& primitive : primitives) {
    const Predicates_kernel::Triangle_3 t = triangle_of(primitive);
    const Vec3 corner = to_vec3(t[0]), normal = cross(to_vec3(t[1]) - corner, to_vec3(t[2]) - corner);
    const double share = dot(corner - p, normal) / dot(q - p, normal);
    if(share >= 0 && share <= 1) // of parallel ones it is infinite, or no number
      shares.push_back(share);
  }
  return shares;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_SURFACE_SEGMENT_CROSSINGS_H
