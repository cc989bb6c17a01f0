// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_SHELL_COUNTS_H
#define CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_SHELL_COUNTS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Face.h>
#include <CGAL/Mixed_mesh_3/Surface_description.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>

#include <cstddef>
#include <numeric>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// \param polygons ranges of vertex indices. \pre each edge belongs to two of them
/// \par Complexity
/// Linear, nearly
template <class Polygons>
Shell_counts shell_counts(const Polygons& polygons, std::size_t number_of_vertices)
{
  constexpr std::size_t unused = std::size_t(-1);
  std::vector<std::size_t> leader(number_of_vertices, unused);
  const auto find = [&](std::size_t v) {
    while(leader[v] != v)
      v = leader[v] = leader[leader[v]];
    return v;
  };
  Shell_counts counts;
  std::size_t number_of_halfedges = 0, number_of_faces = 0;
  for(const auto& polygon : polygons) {
    for(const std::size_t v : polygon)
      if(leader[v] == unused) {
        leader[v] = v;
        ++counts.number_of_shells; // until it is joined
        ++counts.euler_characteristic;
      }
    const std::size_t first = find(*polygon.begin());
    for(const std::size_t v : polygon)
      if(const std::size_t other = find(v); other != first) {
        leader[other] = first;
        --counts.number_of_shells;
      }
    number_of_halfedges += polygon.size();
    ++number_of_faces;
  }
  counts.euler_characteristic += std::ptrdiff_t(number_of_faces) - std::ptrdiff_t(number_of_halfedges / 2);
  return counts;
}

/// The shells of the boundary of a mesh. \pre it is a manifold, except where it is pinched
template <class Mesh>
Shell_counts shells_of_boundary(const Mesh& mesh)
{
  std::vector<Face_vertices> polygons;
  for(const Face& face : boundary_faces(mesh))
    polygons.push_back(face.vertices());
  return shell_counts(polygons, mesh.number_of_vertices());
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_SHELL_COUNTS_H
