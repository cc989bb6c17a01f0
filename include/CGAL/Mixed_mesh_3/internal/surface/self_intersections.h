// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Self-intersections of the boundary of a mesh.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_SURFACE_SELF_INTERSECTIONS_H
#define CGAL_MIXED_MESH_3_INTERNAL_SURFACE_SELF_INTERSECTIONS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/Face.h>
#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_3/internal/base/Shared_mark.h>
#include <CGAL/Mixed_mesh_3/internal/base/box_pairs.h>
#include <CGAL/Mixed_mesh_3/internal/base/is_crossing.h>
#include <CGAL/Mixed_mesh_3/internal/base/parallel_for.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/enum.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Boxes by slabs of about equal numbers of boxes, orthogonal to an axis; a box is in each slab it meets, so
/// that boxes that meet are in a common slab.
template <class Box>
std::vector<std::vector<Box>> boxes_by_slabs(const std::vector<Box>& boxes, int axis,
                                             std::size_t number_of_slabs)
{
  std::vector<double> middles;
  for(const Box& b : boxes)
    middles.push_back((b.min_coord(axis) + b.max_coord(axis)) / 2);
  std::sort(middles.begin(), middles.end());
  std::vector<double> borders;
  for(std::size_t i = 1; i < number_of_slabs; ++i)
    borders.push_back(middles[i * middles.size() / number_of_slabs]);
  std::vector<std::vector<Box>> slabs(number_of_slabs);
  for(const Box& b : boxes) {
    const auto slab = [&](double x) {
      return std::size_t(std::upper_bound(borders.begin(), borders.end(), x) - borders.begin());
    };
    for(std::size_t i = slab(b.min_coord(axis)); i <= slab(b.max_coord(axis)); ++i)
      slabs[i].push_back(b);
  }
  return slabs;
}

/// The vertices of triangles that meet in more than the vertices and edges they share, ascending. The test is
/// exact.
/// \param triangles triangles; those without area, which no valid element has, are skipped
/// \param threads number of threads
/// \par Complexity
/// O(n log n) for n triangles, if few meet
inline std::vector<Vertex_index>
vertices_of_self_intersections(const std::vector<Vec3>& positions,
                               const std::vector<std::array<Vertex_index, 3>>& triangles,
                               unsigned threads = 1)
{
  using Box = Numbered_box;
  constexpr std::size_t boxes_worth_a_slab = 1000, slabs_per_thread = 4;
  std::vector<Predicates_kernel::Point_3> points;
  points.reserve(positions.size());
  for(const Vec3& p : positions)
    points.emplace_back(p[0], p[1], p[2]);
  std::vector<std::uint8_t> has_area(triangles.size());
  parallel_for(triangles.size(), threads, [&](std::size_t i) {
    const auto& t = triangles[i];
    has_area[i] = !CGAL::collinear(points[t[0]], points[t[1]], points[t[2]]);
  });
  std::vector<Box> boxes;
  Bbox_3 bbox;
  for(std::size_t i = 0; i < triangles.size(); ++i)
    if(has_area[i]) {
      const auto& t = triangles[i];
      boxes.emplace_back(points[t[0]].bbox() + points[t[1]].bbox() + points[t[2]].bbox(), i);
      bbox += boxes.back().bbox();
    }

  // A pair that is in several slabs marks the same vertices again.
  std::vector<Shared_mark> is_marked(positions.size());
  const auto mark_if_crossing = [&](const Box& b, const Box& c) {
    const auto &s = triangles[b.info()], &t = triangles[c.info()];
    if(is_crossing(s, t, points))
      for(int i = 0; i < 3; ++i)
        is_marked[s[i]] = is_marked[t[i]] = true;
  };
  const std::size_t number_of_slabs = threads == 1 ? 1
                                                   : (std::min)(slabs_per_thread * threads,
                                                                boxes.size() / boxes_worth_a_slab);
  if(number_of_slabs < 2) {
    for_each_pair_of_boxes(boxes, mark_if_crossing);
  } else {
    int axis = 0;
    for(int k = 1; k < 3; ++k)
      if(bbox.max(k) - bbox.min(k) > bbox.max(axis) - bbox.min(axis))
        axis = k;
    auto slabs = boxes_by_slabs(boxes, axis, number_of_slabs);
    parallel_for(
      slabs.size(), threads, [&](std::size_t i) { for_each_pair_of_boxes(slabs[i], mark_if_crossing); }, 1);
  }
  std::vector<Vertex_index> vertices;
  for(Vertex_index v = 0; v < is_marked.size(); ++v)
    if(is_marked[v])
      vertices.push_back(v);
  return vertices;
}

/// The same for faces; quadrilaterals are two triangles each.
inline std::vector<Vertex_index> vertices_of_self_intersections(const std::vector<Vec3>& positions,
                                                                const std::vector<Face>& faces,
                                                                unsigned threads = 1)
{
  std::vector<std::array<Vertex_index, 3>> triangles;
  for(const Face& face : faces)
    for(int i = 2; i < face.vertices().size(); ++i)
      triangles.push_back({face.vertices()[0], face.vertices()[i - 1], face.vertices()[i]});
  return vertices_of_self_intersections(positions, triangles, threads);
}

/// Whether faces of the boundary of a mesh meet in more than the vertices and edges they share.
template <class Mesh>
bool cuts_itself(const Mesh& mesh)
{
  std::vector<Vec3> points;
  points.reserve(mesh.number_of_vertices());
  for(const auto& p : mesh.points())
    points.push_back(to_vec3(p));
  return !vertices_of_self_intersections(points, boundary_faces(mesh)).empty();
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_SURFACE_SELF_INTERSECTIONS_H
