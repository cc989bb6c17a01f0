// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces out of images have several vertices for each voxel: far more than a mesh can follow.

#ifndef CGAL_MIXED_MESH_IMAGE_3_SIMPLIFY_CLOSED_SURFACE_H
#define CGAL_MIXED_MESH_IMAGE_3_SIMPLIFY_CLOSED_SURFACE_H

#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <algorithm>
#include <cstddef>

namespace CGAL {
namespace Mixed_meshes_3 {

namespace internal {

struct Stop_at_number_of_edges
{
  std::size_t number;

  template <class FT, class Profile>
  bool operator()(const FT&, const Profile&, std::size_t, std::size_t edges) const
  {
    return edges <= number;
  }
};

} // namespace internal

/*!
\brief Simplifies a surface to a number of vertices, about, by the collapse of the edges that change its
volume and shape least (Lindstrom, Turk: Fast and memory efficient polygonal simplification, 1998).

The topology stays. On the way, the number of vertices is halved again and again; the result is the last of
these surfaces that does not cut itself: what does not at the start, does not in the end.

\param surface a closed triangulated surface that does not cut itself
\param number_of_vertices how many vertices are wanted
\cost \f$ O(n \log n) \f$
*/
template <class Point>
void simplify_closed_surface(Surface_mesh<Point>& surface, std::size_t number_of_vertices)
{
  const std::size_t wanted = (std::max)(number_of_vertices, std::size_t(4));
  std::size_t next = wanted;
  while(2 * next < surface.number_of_vertices())
    next *= 2;
  Surface_mesh<Point> simplified = surface;
  for(; next >= wanted && next < simplified.number_of_vertices(); next /= 2) {
    // a face that would turn over would lie on another one
    Surface_mesh_simplification::edge_collapse(
      simplified, internal::Stop_at_number_of_edges{3 * next},
      parameters::filter(Surface_mesh_simplification::Bounded_normal_change_filter<>()));
    simplified.collect_garbage();
    if(!Polygon_mesh_processing::does_self_intersect(simplified))
      surface = simplified;
  }
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_SIMPLIFY_CLOSED_SURFACE_H
