// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_SURFACE_SURFACE_ORACLE_3_IMPL_H
#define CGAL_MIXED_MESH_3_INTERNAL_SURFACE_SURFACE_ORACLE_3_IMPL_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/compiled.h>
#include <CGAL/Mixed_mesh_3/internal/elements/shell_counts.h>
#include <CGAL/Mixed_mesh_3/internal/surface/Surface_oracle_3.h>
#include <CGAL/Mixed_mesh_3/internal/surface/Triangle_tree.h>
#include <CGAL/Mixed_mesh_3/internal/surface/segment_crossings.h>

#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The property map in which CGAL's detection of sharp edges marks them.
struct Is_sharp_map
{
  using key_type = CGAL::Surface_mesh<Surface_oracle_3::Point_3>::Edge_index;
  using value_type = bool;
  using reference = bool;
  using category = boost::read_write_property_map_tag;

  std::vector<std::uint8_t>* is_sharp;

  friend bool get(const Is_sharp_map& map, key_type e) { return (*map.is_sharp)[e] != 0; }
  friend void put(const Is_sharp_map& map, key_type e, bool is_sharp) { (*map.is_sharp)[e] = is_sharp; }
};

/// The tree that tells sides, and its mesh, which sharp edges are found in; each is made when it is needed.
struct Surface_oracle_3::Side_tree
{
  using Surface = CGAL::Surface_mesh<Point_3>;
  using Side_of_surface = CGAL::Side_of_triangle_mesh<Surface, Kernel>;
  using Tree = Side_of_surface::AABB_tree; // the traits have another name in each CGAL version

  std::once_flag has_mesh, has_tree;
  Surface surface; // the tree keeps its address
  Tree tree;
  std::optional<Side_of_surface> side_of_surface;

  const Surface& mesh(const Surface_oracle_3& oracle)
  {
    std::call_once(has_mesh, [&] {
      const std::size_t facets = oracle.m_facets.size();
      surface.reserve(std::uint32_t(oracle.m_points.size()), std::uint32_t(3 * facets / 2),
                      std::uint32_t(facets));
      for(const Point_3& p : oracle.m_points)
        surface.add_vertex(p);
      for(const auto& [a, b, c] : oracle.m_facets)
        surface.add_face(Surface::Vertex_index(a), Surface::Vertex_index(b), Surface::Vertex_index(c));
    });
    return surface;
  }

  // Most sides follow from that of a point nearby, and some surfaces need no tree for the others, which takes
  // as long as the closest points of all.
  void build(const Surface_oracle_3& oracle)
  {
    std::call_once(has_tree, [&] {
      const Surface& s = mesh(oracle);
      tree.insert(faces(s).first, faces(s).second, s, get(CGAL::vertex_point, s));
      tree.build();
      side_of_surface.emplace(tree);
    });
  }
};

CGAL_MIXED_MESH_3_INLINE void Surface_oracle_3::Delete_side_tree::operator()(Side_tree* tree) const
{
  delete tree;
}

CGAL_MIXED_MESH_3_INLINE void Surface_oracle_3::build(Triangle_soup soup)
{
  m_points = std::move(soup.points);
  m_facets.reserve(soup.triangles.size());
  m_boxes.reserve(soup.triangles.size());
  for(const auto& t : soup.triangles) {
    m_facets.push_back({std::uint32_t(t[0]), std::uint32_t(t[1]), std::uint32_t(t[2])});
    const Bbox_3 box = m_points[t[0]].bbox() + m_points[t[1]].bbox() + m_points[t[2]].bbox();
    m_boxes.emplace_back(box);
    m_bbox += box;
  }
  m_closest = std::make_shared<const Triangle_tree>(m_facets.size(), [this](std::size_t f) {
    const std::array<std::uint32_t, 3>& v = m_facets[f];
    return std::array<Vec3, 3>{to_vec3(m_points[v[0]]), to_vec3(m_points[v[1]]), to_vec3(m_points[v[2]])};
  });
  m_side_tree.reset(new Side_tree());
  count_shells(soup.triangles);
}

// Counts the shells, without specks. Around a cavity, points inside the shell, but near to it, are outside of
// the domain, for either orientation of the triangles.
CGAL_MIXED_MESH_3_INLINE void
Surface_oracle_3::count_shells(const std::vector<std::array<std::size_t, 3>>& triangles)
{
  constexpr double near = 1e-6; // in sides of a triangle, which may be 1e-10 of coordinates: 2^-53 / near
  const Shells_of_vertices shells = find_shells(triangles, m_points.size());
  m_shells = shells.counts;
  m_shells.number_of_cavities = 0;
  if(m_shells.number_of_shells < 2)
    return;
  const auto point = [&](std::size_t v) { return to_vec3(m_points[v]); };
  const std::vector<double> volumes = volumes_of_shells(shells, triangles, point);
  double largest_volume = 0;
  for(double volume : volumes)
    largest_volume = (std::max)(largest_volume, std::abs(volume));
  auto kept = triangles;
  kept.erase(std::remove_if(kept.begin(), kept.end(),
                            [&](const auto& t) {
                              return std::abs(volumes[shells.shell_of[t[0]]])
                                     < volume_share_of_speck * largest_volume;
                            }),
             kept.end());
  if(kept.size() != triangles.size())
    return count_shells(kept);
  std::vector<const std::array<std::size_t, 3>*> largest(volumes.size(), nullptr);
  std::vector<double> areas(volumes.size(), -1); // doubled
  const auto normal = [&](const std::array<std::size_t, 3>& t) {
    return cross(point(t[1]) - point(t[0]), point(t[2]) - point(t[0]));
  };
  for(const auto& t : triangles) {
    const std::size_t shell = shells.shell_of[t[0]];
    if(const double area = norm(normal(t)); area > areas[shell]) {
      areas[shell] = area;
      largest[shell] = &t;
    }
  }
  std::vector<double> signed_volumes(volumes.size(), 0);
  for(std::size_t s = 0; s < volumes.size(); ++s) {
    if(!(areas[s] > 0))
      continue;
    const auto& t = *largest[s];
    const Vec3 inwards = (volumes[s] < 0 ? 1 : -1) / areas[s] * normal(t);
    const Vec3 p = (1. / 3) * (point(t[0]) + point(t[1]) + point(t[2]))
                   + near * std::sqrt(areas[s]) * inwards;
    const bool is_cavity = bounded_side(Point_3(p[0], p[1], p[2])) == ON_UNBOUNDED_SIDE;
    *m_shells.number_of_cavities += is_cavity;
    signed_volumes[s] = is_cavity ? -std::abs(volumes[s]) : std::abs(volumes[s]);
  }
  set_volumes(m_shells, std::move(signed_volumes));
}

CGAL_MIXED_MESH_3_INLINE double Surface_oracle_3::area() const
{
  double sum = 0;
  for(std::size_t f = 0; f < number_of_facets(); ++f)
    sum += std::sqrt(facet(f).squared_area());
  return sum;
}

CGAL_MIXED_MESH_3_INLINE double Surface_oracle_3::volume() const
{
  double sum = 0;
  const Point_3 o = facet(0)[0];
  for(const auto& v : m_facets)
    sum += CGAL::volume(o, m_points[v[0]], m_points[v[1]], m_points[v[2]]);
  return std::abs(sum);
}

CGAL_MIXED_MESH_3_INLINE std::vector<double> Surface_oracle_3::crossings(const Vec3& p, const Vec3& q) const
{
  m_side_tree->build(*this);
  return segment_crossings(m_side_tree->tree, p, q, [this](auto f) { return facet(f); });
}

CGAL_MIXED_MESH_3_INLINE Surface_edges Surface_oracle_3::surface_edges(double angle) const
{
  const Side_tree::Surface& s = m_side_tree->mesh(*this);
  std::vector<std::uint8_t> is_sharp(s.number_of_edges(), 0);
  Polygon_mesh_processing::detect_sharp_edges(s, angle, Is_sharp_map{&is_sharp});
  Surface_edges all;
  Sharp_edges& result = all.edges;
  std::vector<std::size_t> numbers(s.number_of_vertices(), std::size_t(-1));
  const auto number = [&](Side_tree::Surface::Vertex_index v) {
    if(numbers[v] == std::size_t(-1)) {
      numbers[v] = result.points.size();
      result.points.push_back(to_vec3(s.point(v)));
    }
    return numbers[v];
  };
  for(const auto e : edges(s))
    if(is_sharp[e]) {
      const auto h = halfedge(e, s);
      const auto apex = [&](auto side) { return to_vec3(s.point(target(next(side, s), s))); };
      result.edges.push_back({number(source(h, s)), number(target(h, s))});
      all.apexes.push_back({apex(h), apex(s.opposite(h))});
    }
  const Bbox_3& b = m_bbox;
  result.diagonal = norm({b.x_span(), b.y_span(), b.z_span()});
  result.area = area();
  return all;
}

CGAL_MIXED_MESH_3_INLINE Axis_parallel_planes Surface_oracle_3::axis_parallel_planes() const
{
  Axis_parallel_planes planes;
  for(std::size_t f = 0; f < number_of_facets(); ++f) {
    const Triangle_3 t = facet(f);
    int k = 0;
    while(k < 3 && !(t[0][k] == t[1][k] && t[0][k] == t[2][k]))
      ++k;
    if(k == 3)
      return {};
    planes[std::size_t(k)][t[0][k]] += std::sqrt(t.squared_area());
  }
  return planes;
}

CGAL_MIXED_MESH_3_INLINE Bounded_side Surface_oracle_3::bounded_side(const Point_3& p) const
{
  m_side_tree->build(*this);
  return (*m_side_tree->side_of_surface)(p);
}

CGAL_MIXED_MESH_3_INLINE Surface_oracle_3::Point_3 Surface_oracle_3::closest_point(const Point_3& p,
                                                                                   const Point_3& hint) const
{
  const Vec3 q = m_closest->closest(to_vec3(p), {to_vec3(hint), 0}).point;
  return Point_3(q[0], q[1], q[2]);
}

CGAL_MIXED_MESH_3_INLINE Surface_oracle_3::Point_3 Surface_oracle_3::closest_point(const Point_3& p) const
{
  const Vec3 q = m_closest->closest(to_vec3(p)).point;
  return Point_3(q[0], q[1], q[2]);
}

CGAL_MIXED_MESH_3_INLINE std::vector<Surface_oracle_3::Point_3>
Surface_oracle_3::surface_samples(double spacing) const
{
  std::vector<Point_3> samples;
  std::vector<std::uint8_t> is_seen(m_points.size(), 0);
  for(const auto& facet : m_facets) {
    std::array<Point_3, 3> p;
    double longest = 0;
    int k = 0;
    for(std::uint32_t v : facet) {
      p[k++] = m_points[v];
      if(!is_seen[v])
        samples.push_back(m_points[v]);
      is_seen[v] = 1;
    }
    for(int i = 0; i < 3; ++i)
      longest = (std::max)(longest, std::sqrt(CGAL::squared_distance(p[i], p[(i + 1) % 3])));
    const int n = int((std::min)(std::ceil(longest / spacing), 1000.));
    for(int i = 0; i <= n; ++i)
      for(int j = 0; i + j <= n; ++j)
        if((i > 0) + (j > 0) + (i + j < n) > 1) // not at a vertex
          samples.push_back(p[0] + (double(i) / n) * (p[1] - p[0]) + (double(j) / n) * (p[2] - p[0]));
  }
  return samples;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_SURFACE_SURFACE_ORACLE_3_IMPL_H
