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

#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_3/Face.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/enum.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Whether two triangles meet in more than the vertices and edges they share.
inline bool is_crossing(const std::array<Vertex_index, 3>& s, const std::array<Vertex_index, 3>& t,
                        const std::vector<Predicates_kernel::Point_3>& points)
{
  using Kernel = Predicates_kernel;
  const auto triangle = [&](const std::array<Vertex_index, 3>& v) {
    return Kernel::Triangle_3(points[v[0]], points[v[1]], points[v[2]]);
  };
  // The vertices are turned such that the shared ones come first.
  const auto turned = [](std::array<Vertex_index, 3> a, const std::array<Vertex_index, 3>& b, int& shared) {
    const auto end = std::stable_partition(a.begin(), a.end(), [&](Vertex_index v) {
      return std::count(b.begin(), b.end(), v) > 0;
    });
    shared = int(end - a.begin());
    return a;
  };
  int shared = 0;
  const std::array<Vertex_index, 3> a = turned(s, t, shared), b = turned(t, s, shared);
  switch(shared) {
  case 0: return CGAL::do_intersect(triangle(s), triangle(t));
  case 1:
    return CGAL::do_intersect(Kernel::Segment_3(points[a[1]], points[a[2]]), triangle(t))
           || CGAL::do_intersect(Kernel::Segment_3(points[b[1]], points[b[2]]), triangle(s));
  case 2: // folded flat
    return CGAL::coplanar(points[a[0]], points[a[1]], points[a[2]], points[b[2]])
           && CGAL::coplanar_orientation(points[a[0]], points[a[1]], points[a[2]], points[b[2]]) == POSITIVE;
  default: return true;
  }
}

/// The vertices of faces that meet in more than the vertices and edges they share, ascending. The test is
/// exact.
/// \param faces triangles, and quadrilaterals, each as two triangles; faces without area, which no valid
///        element has, are skipped
/// \par Complexity
/// O(n log n) for n faces, if few meet
inline std::vector<Vertex_index> vertices_of_self_intersections(const std::vector<Vec3>& positions,
                                                                const std::vector<Face>& faces)
{
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;
  std::vector<Predicates_kernel::Point_3> points;
  points.reserve(positions.size());
  for(const Vec3& p : positions)
    points.emplace_back(p[0], p[1], p[2]);
  std::vector<std::array<Vertex_index, 3>> triangles;
  std::vector<Box> boxes;
  for(const Face& face : faces)
    for(int i = 2; i < face.vertices().size(); ++i) {
      triangles.push_back({face.vertices()[0], face.vertices()[i - 1], face.vertices()[i]});
      const auto& t = triangles.back();
      if(CGAL::collinear(points[t[0]], points[t[1]], points[t[2]])) {
        triangles.pop_back();
        continue;
      }
      boxes.emplace_back(points[t[0]].bbox() + points[t[1]].bbox() + points[t[2]].bbox(), boxes.size());
    }
  std::vector<Vertex_index> vertices;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& b, const Box& c) {
    const auto &s = triangles[b.info()], &t = triangles[c.info()];
    if(is_crossing(s, t, points)) {
      vertices.insert(vertices.end(), s.begin(), s.end());
      vertices.insert(vertices.end(), t.begin(), t.end());
    }
  });
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_SURFACE_SELF_INTERSECTIONS_H
