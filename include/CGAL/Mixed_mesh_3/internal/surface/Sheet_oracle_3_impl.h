// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_SURFACE_SHEET_ORACLE_3_IMPL_H
#define CGAL_MIXED_MESH_3_INTERNAL_SURFACE_SHEET_ORACLE_3_IMPL_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/compatibility.h>
#include <CGAL/Mixed_mesh_3/internal/base/compiled.h>
#include <CGAL/Mixed_mesh_3/internal/surface/Sheet_oracle_3.h>
#include <CGAL/Mixed_mesh_3/internal/surface/Triangle_tree.h>
#include <CGAL/Mixed_mesh_3/internal/surface/segment_crossings.h>

#include <CGAL/AABB_tree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

struct Sheet_oracle_3::Trees
{
  using Triangles = std::vector<Kernel::Triangle_3>;

  Triangles triangles;
  CGAL::AABB_tree<AABB_triangle_traits<Kernel, Triangles::const_iterator>> tree;
  std::optional<Triangle_tree> closest;
};

CGAL_MIXED_MESH_3_INLINE void Sheet_oracle_3::Delete_trees::operator()(Trees* trees) const { delete trees; }

CGAL_MIXED_MESH_3_INLINE void Sheet_oracle_3::build(const Triangle_soup& soup)
{
  const auto& [points, triangles] = soup;
  const auto unit = [](const Vec3& v) { return norm(v) > 0 ? (1 / norm(v)) * v : v; };
  const auto edge_of = [](const std::array<std::size_t, 3>& t, std::size_t i) {
    return std::minmax({t[(i + 1) % 3], t[(i + 2) % 3]});
  };
  using Edge = std::pair<std::size_t, std::size_t>;
  std::map<Edge, std::pair<Vec3, int>> edges; // sum of normals, number of triangles
  std::vector<Vec3> normals_of_vertices(points.size(), Vec3{});
  for(const auto& t : triangles) {
    Triangle& triangle = m_triangles.emplace_back();
    for(std::size_t i = 0; i < 3; ++i)
      triangle.points[i] = to_vec3(points[t[i]]);
    const auto& p = triangle.points;
    triangle.normal = unit(cross(p[1] - p[0], p[2] - p[0]));
    for(std::size_t i = 0; i < 3; ++i) {
      auto& [normal, number] = edges.try_emplace(edge_of(t, i), Vec3{}, 0).first->second;
      normal = normal + triangle.normal;
      ++number;
      const Vec3 a = unit(p[(i + 1) % 3] - p[i]), b = unit(p[(i + 2) % 3] - p[i]);
      Vec3& at_vertex = normals_of_vertices[t[i]];
      at_vertex = at_vertex + std::atan2(norm(cross(a, b)), dot(a, b)) * triangle.normal;
    }
  }
  std::vector<bool> is_at_rim(points.size(), false);
  for(const auto& [edge, found] : edges)
    if(found.second == 1)
      is_at_rim[edge.first] = is_at_rim[edge.second] = true;
  m_trees.reset(new Trees());
  std::vector<std::array<Vec3, 3>> corners;
  for(std::size_t f = 0; f < triangles.size(); ++f) {
    Triangle& triangle = m_triangles[f];
    for(std::size_t i = 0; i < 3; ++i) {
      const auto& [normal, number] = edges.at(edge_of(triangles[f], i));
      triangle.normals_at_edges[i] = unit(normal);
      triangle.is_edge_at_rim[i] = number == 1;
      triangle.normals_at_corners[i] = unit(normals_of_vertices[triangles[f][i]]);
      triangle.is_corner_at_rim[i] = is_at_rim[triangles[f][i]];
    }
    const auto& p = triangle.points;
    const auto point = [&](std::size_t i) { return Point_3(p[i][0], p[i][1], p[i][2]); };
    m_trees->triangles.emplace_back(point(0), point(1), point(2));
    corners.push_back(p);
    m_bbox += m_trees->triangles.back().bbox();
  }
  m_trees->tree.insert(m_trees->triangles.cbegin(), m_trees->triangles.cend());
  m_trees->tree.build();
  m_trees->closest.emplace(corners);
}

CGAL_MIXED_MESH_3_INLINE double Sheet_oracle_3::area() const
{
  double sum = 0;
  for(const Triangle& t : m_triangles)
    sum += norm(cross(t.points[1] - t.points[0], t.points[2] - t.points[0])) / 2;
  return sum;
}

CGAL_MIXED_MESH_3_INLINE bool Sheet_oracle_3::may_intersect(const Bbox_3& box) const
{
  return CGAL::do_overlap(box, m_bbox) && m_trees->tree.do_intersect(box);
}

CGAL_MIXED_MESH_3_INLINE bool Sheet_oracle_3::do_intersect(const Point_3& p, const Point_3& q) const
{
  return CGAL::do_overlap(p.bbox() + q.bbox(), m_bbox) && m_trees->tree.do_intersect(Kernel::Segment_3(p, q));
}

CGAL_MIXED_MESH_3_INLINE std::vector<double> Sheet_oracle_3::crossings(const Vec3& p, const Vec3& q) const
{
  return segment_crossings(m_trees->tree, p, q, [](auto t) { return *t; });
}

CGAL_MIXED_MESH_3_INLINE Sheet_oracle_3::Point_3 Sheet_oracle_3::closest_point(const Point_3& p) const
{
  const Vec3 q = m_trees->closest->closest(to_vec3(p)).point;
  return Point_3(q[0], q[1], q[2]);
}

CGAL_MIXED_MESH_3_INLINE Sheet_oracle_3::Point_3 Sheet_oracle_3::closest_point(const Point_3& p,
                                                                               const Point_3& hint) const
{
  const Vec3 q = m_trees->closest->closest(to_vec3(p), {to_vec3(hint), 0}).point;
  return Point_3(q[0], q[1], q[2]);
}

CGAL_MIXED_MESH_3_INLINE Sheet_location Sheet_oracle_3::locate(const Point_3& p) const
{
  const auto [q, triangle] = m_trees->closest->closest(to_vec3(p));
  const Triangle& t = m_triangles[triangle];
  // The corners between which the point is on the edge, or the corner at which it is: areas have
  // 10^7 roundings of 2^-53, as coordinates may be a million times as large as a triangle.
  constexpr double nearly_0 = 1e-9;
  const Vec3 area = cross(t.points[1] - t.points[0], t.points[2] - t.points[0]);
  std::array<bool, 3> is_far{}; // far from the edge opposite to a corner
  for(std::size_t i = 0; i < 3; ++i)
    is_far[i] = dot(cross(t.points[(i + 1) % 3] - q, t.points[(i + 2) % 3] - q), area)
                > nearly_0 * dot(area, area);
  Vec3 normal = t.normal;
  bool is_at_rim = false;
  for(std::size_t i = 0; i < 3; ++i) {
    if(!is_far[i] && is_far[(i + 1) % 3] && is_far[(i + 2) % 3]) {
      normal = t.normals_at_edges[i];
      is_at_rim = t.is_edge_at_rim[i];
    } else if(is_far[i] && !is_far[(i + 1) % 3] && !is_far[(i + 2) % 3]) {
      normal = t.normals_at_corners[i];
      is_at_rim = t.is_corner_at_rim[i];
    }
  }
  return {q, dot(to_vec3(p) - q, normal), is_at_rim};
}

CGAL_MIXED_MESH_3_INLINE std::vector<std::pair<Sheet_oracle_3::Point_3, double>>
Sheet_oracle_3::area_samples(std::size_t number) const
{
  const double all = area();
  std::vector<std::pair<Point_3, double>> samples;
  for(const Triangle& t : m_triangles) {
    const Vec3 a = t.points[1] - t.points[0], b = t.points[2] - t.points[0];
    const double mine = norm(cross(a, b)) / 2;
    const int n = (std::max)(1, int(std::ceil(std::sqrt(double(number) * mine / all))));
    const auto add = [&](double i, double j) {
      const Vec3 p = t.points[0] + ((i / n) * a + (j / n) * b);
      samples.emplace_back(Point_3(p[0], p[1], p[2]), mine / (n * n));
    };
    for(int i = 0; i < n; ++i)
      for(int j = 0; i + j < n; ++j) {
        add(i + 1. / 3, j + 1. / 3);
        if(i + j + 1 < n)
          add(i + 2. / 3, j + 2. / 3);
      }
  }
  return samples;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_SURFACE_SHEET_ORACLE_3_IMPL_H
