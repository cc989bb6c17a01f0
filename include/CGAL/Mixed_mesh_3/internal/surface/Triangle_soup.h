// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangles with indices of points.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_SURFACE_TRIANGLE_SOUP_H
#define CGAL_MIXED_MESH_3_INTERNAL_SURFACE_TRIANGLE_SOUP_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <CGAL/assertions.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

struct Triangle_soup
{
  std::vector<Predicates_kernel::Point_3> points;
  std::vector<std::array<std::size_t, 3>> triangles;
};

inline Predicates_kernel::Point_3 rounded_point(const Vec3& p) { return {p[0], p[1], p[2]}; }

/// The triangles of a user's surface, with points in doubles: predicates are exact on doubles, and the copy
/// does not depend on the lifetime of the surface.
template <class FaceListGraph, class NamedParameters>
Triangle_soup surface_triangles(const FaceListGraph& surface, const NamedParameters& np)
{
  CGAL_precondition(CGAL::is_triangle_mesh(surface));
  auto vpm = parameters::choose_parameter(parameters::get_parameter(np, internal_np::vertex_point),
                                          get_const_property_map(CGAL::vertex_point, surface));
  const auto vertex_index = CGAL::get_initialized_vertex_index_map(surface, np);
  Triangle_soup soup;
  std::vector<std::size_t> index; // in the soup, by the index in the graph, which may have gaps
  index.reserve(num_vertices(surface));
  soup.points.reserve(num_vertices(surface));
  soup.triangles.reserve(num_faces(surface));
  for(auto v : vertices(surface)) {
    const std::size_t i = std::size_t(get(vertex_index, v));
    if(i >= index.size())
      index.resize(i + 1);
    index[i] = soup.points.size();
    soup.points.push_back(rounded_point(to_vec3(get(vpm, v))));
  }
  for(auto f : faces(surface)) {
    std::array<std::size_t, 3> t;
    int i = 0;
    for(auto v : vertices_around_face(halfedge(f, surface), surface))
      t[i++] = index[std::size_t(get(vertex_index, v))];
    soup.triangles.push_back(t);
  }
  return soup;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_SURFACE_TRIANGLE_SOUP_H
