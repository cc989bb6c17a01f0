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
#include <utility>
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

/*!
Finds the triangles that meet in more than the vertices and edges they share, of a mesh that changes between
searches. The test is exact. Pairs of triangles that are where they were at the last search are not tested
again, unless the triangles are not the same ones.
*/
class Self_intersections
{
  using Box = Numbered_box;
  using Triangle = std::array<Vertex_index, 3>;
  using Pair = std::array<std::size_t, 2>;

  std::vector<Predicates_kernel::Point_3> m_points;
  std::vector<Triangle> m_triangles;
  std::vector<std::uint8_t> m_has_area; // those without area, which no valid element has, are skipped
  std::vector<std::uint8_t> m_is_new;   // triangles that are not where they were
  std::vector<Pair> m_pairs;            // triangles that meet, ascending; smaller number first

public:
  /// The vertices of triangles that meet, ascending.
  /// \param threads number of threads
  /// \par Complexity
  /// O(n log n) for n triangles, if few meet
  std::vector<Vertex_index> vertices(const std::vector<Vec3>& positions, std::vector<Triangle> triangles,
                                     unsigned threads)
  {
    set_triangles(positions, std::move(triangles), threads);
    m_pairs.erase(std::remove_if(m_pairs.begin(), m_pairs.end(),
                                 [this](const Pair& p) { return m_is_new[p[0]] || m_is_new[p[1]]; }),
                  m_pairs.end());
    add_new_pairs(threads);
    std::vector<std::uint8_t> is_marked(positions.size(), 0);
    for(const Pair& pair : m_pairs)
      for(std::size_t t : pair)
        for(Vertex_index v : m_triangles[t])
          is_marked[v] = 1;
    std::vector<Vertex_index> vertices;
    for(Vertex_index v = 0; v < is_marked.size(); ++v)
      if(is_marked[v])
        vertices.push_back(v);
    return vertices;
  }

private:
  void set_triangles(const std::vector<Vec3>& positions, std::vector<Triangle> triangles, unsigned threads)
  {
    const bool are_same = triangles == m_triangles;
    if(!are_same) {
      m_triangles = std::move(triangles);
      m_pairs.clear();
    }
    const std::size_t number_before = m_points.size();
    m_points.resize(positions.size());
    std::vector<std::uint8_t> has_moved(positions.size());
    for(std::size_t v = 0; v < positions.size(); ++v) {
      const Vec3& p = positions[v];
      const Predicates_kernel::Point_3 point(p[0], p[1], p[2]);
      has_moved[v] = v >= number_before || m_points[v] != point;
      m_points[v] = point;
    }
    m_is_new.resize(m_triangles.size());
    m_has_area.resize(m_triangles.size());
    parallel_for(m_triangles.size(), threads, [&](std::size_t i) {
      const Triangle& t = m_triangles[i];
      m_is_new[i] = !are_same || has_moved[t[0]] || has_moved[t[1]] || has_moved[t[2]];
      if(m_is_new[i])
        m_has_area[i] = !CGAL::collinear(m_points[t[0]], m_points[t[1]], m_points[t[2]]);
    });
  }

  void add_new_pairs(unsigned threads)
  {
    // At the end, a thread waits for a slab at most, a quarter of its share.
    constexpr std::size_t boxes_worth_a_slab = 1000, slabs_per_thread = 4;
    std::vector<Box> boxes;
    boxes.reserve(m_triangles.size());
    Bbox_3 bbox;
    for(std::size_t i = 0; i < m_triangles.size(); ++i)
      if(m_has_area[i]) {
        const Triangle& t = m_triangles[i];
        boxes.emplace_back(m_points[t[0]].bbox() + m_points[t[1]].bbox() + m_points[t[2]].bbox(), i);
        bbox += boxes.back().bbox();
      }
    const std::size_t number_of_slabs = threads == 1 ? 1
                                                     : (std::min)(slabs_per_thread * threads,
                                                                  boxes.size() / boxes_worth_a_slab);
    if(number_of_slabs < 2) {
      find_new_pairs(boxes, m_pairs);
    } else {
      int axis = 0;
      for(int k = 1; k < 3; ++k)
        if(bbox.max(k) - bbox.min(k) > bbox.max(axis) - bbox.min(axis))
          axis = k;
      auto slabs = boxes_by_slabs(boxes, axis, number_of_slabs);
      std::vector<std::vector<Pair>> pairs(slabs.size());
      parallel_for(
        slabs.size(), threads, [&](std::size_t i) { find_new_pairs(slabs[i], pairs[i]); }, 1);
      for(const std::vector<Pair>& of_slab : pairs)
        m_pairs.insert(m_pairs.end(), of_slab.begin(), of_slab.end());
    }
    std::sort(m_pairs.begin(), m_pairs.end());
    m_pairs.erase(std::unique(m_pairs.begin(), m_pairs.end()), m_pairs.end()); // some are in several slabs
  }

  // Adds the pairs of boxes whose triangles meet, one of which is new.
  void find_new_pairs(std::vector<Box>& boxes, std::vector<Pair>& pairs) const
  {
    const auto add_if_crossing = [&](const Box& b, const Box& c) {
      if(is_crossing(m_triangles[b.info()], m_triangles[c.info()], m_points))
        pairs.push_back({(std::min)(b.info(), c.info()), (std::max)(b.info(), c.info())});
    };
    const auto first_old = std::partition(boxes.begin(), boxes.end(),
                                          [this](const Box& b) { return m_is_new[b.info()] != 0; });
    std::vector<Box> old(first_old, boxes.end());
    boxes.erase(first_old, boxes.end());
    for_each_pair_of_boxes(boxes, add_if_crossing);
    for_each_pair_of_boxes(boxes, old, add_if_crossing);
  }
};

/// The vertices of triangles that meet in more than the vertices and edges they share, ascending.
inline std::vector<Vertex_index>
vertices_of_self_intersections(const std::vector<Vec3>& positions,
                               const std::vector<std::array<Vertex_index, 3>>& triangles,
                               unsigned threads = 1)
{
  return Self_intersections().vertices(positions, triangles, threads);
}

/// The triangles of faces; quadrilaterals are two each.
inline std::vector<std::array<Vertex_index, 3>> triangles_of_faces(const std::vector<Face>& faces)
{
  std::vector<std::array<Vertex_index, 3>> triangles;
  triangles.reserve(faces.size());
  for(const Face& face : faces)
    for(int i = 2; i < face.vertices().size(); ++i)
      triangles.push_back({face.vertices()[0], face.vertices()[i - 1], face.vertices()[i]});
  return triangles;
}

/// The same for faces; quadrilaterals are two triangles each.
inline std::vector<Vertex_index> vertices_of_self_intersections(const std::vector<Vec3>& positions,
                                                                const std::vector<Face>& faces,
                                                                unsigned threads = 1)
{
  return vertices_of_self_intersections(positions, triangles_of_faces(faces), threads);
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
