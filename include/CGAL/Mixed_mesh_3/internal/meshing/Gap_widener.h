// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Widening of gaps that are narrower than the cells, at the expense of the solid beside them.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_GAP_WIDENER_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_GAP_WIDENER_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/shell_counts.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Located_octree.h>
#include <CGAL/Mixed_mesh_3/internal/transitions/Lattice_mesh.h>

#include <CGAL/enum.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
Removes the label of vertices inside, where a gap lies between them and other vertices inside.

Vertices that are not inside become boundary vertices if an element joins them with a vertex inside. So a gap
needs two layers of such vertices, one for each of its sheets. Two vertices inside, between which there is a
gap,

- shall not belong to one element: both lose their label;
- shall not belong to elements with a common vertex that is not inside: the vertex whose sheet is farther from
the common vertex loses its label, and the other sheet gets the common vertex.

The line between the two vertices tells whether there is a gap: the line is followed in steps as long as the
surface is far away.
*/
class Gap_widener
{
  using Point_3 = Located_octree::Point_3;

  const Located_octree& m_octree;
  Lattice_mesh& m_mesh;
  std::vector<Vec3> m_points, m_closest;          // of vertices of cells that meet the surface
  std::vector<double> m_distances;                // negative elsewhere
  std::vector<Vertex_index> m_taken;              // vertices whose labels were removed
  std::unordered_map<std::uint64_t, bool> m_gaps; // whether pairs of vertices have a gap between them
  Point_3 m_hint;

  static constexpr double smallest_step = 1. / 64; // step on a line: narrower gaps may be missed
  static constexpr int most_rounds = 3;
  static constexpr std::size_t smallest_wall = 9; // vertices that stay if they would be lost together

public:
  Gap_widener(const Located_octree& octree, Lattice_mesh& mesh)
    : m_octree(octree), m_mesh(mesh), m_hint(octree.domain().closest_point(octree.point({0, 0, 0})))
  {
    measure();
  }

  void operator()()
  {
    part_elements();
    for(int round = 0; round < most_rounds && part_vertices(); ++round) {
    }
    return_labels();
  }

private:
  bool is_near(Vertex_index v) const { return m_distances[v] >= 0; }

  void measure()
  {
    const std::size_t n = m_mesh.vertices.size();
    m_points.resize(n);
    m_closest.resize(n);
    m_distances.assign(n, -1);
    for(Element_index e = 0; e < m_mesh.elements.size(); ++e)
      if(meets_surface(e))
        for(Vertex_index v : m_mesh.elements[e])
          if(!is_near(v)) {
            m_points[v] = point(v);
            m_closest[v] = closest(m_points[v]);
            m_distances[v] = norm(m_points[v] - m_closest[v]);
          }
  }

  Vec3 point(Vertex_index v) const { return to_vec3(m_octree.point(m_mesh.vertices[v])); }

  bool meets_surface(Element_index e) const { return m_octree.side(m_mesh.cells[e]) == ON_BOUNDARY; }

  Vec3 closest(const Vec3& p)
  {
    m_hint = m_octree.domain().closest_point(Point_3(p[0], p[1], p[2]), m_hint);
    return to_vec3(m_hint);
  }

  void part_elements()
  {
    std::vector<Vertex_index> parted;
    for(Element_index e = 0; e < m_mesh.elements.size(); ++e) {
      if(!meets_surface(e))
        continue;
      const Element_view element = m_mesh.elements[e];
      for(int i = 0; i < element.size(); ++i)
        for(int j = 0; j < i; ++j)
          if(m_mesh.is_inside(element[i]) && m_mesh.is_inside(element[j])
             && has_gap_between(element[i], element[j])) {
            parted.push_back(element[i]);
            parted.push_back(element[j]);
          }
    }
    for(Vertex_index v : parted)
      take_label(v);
  }

  // Removes labels. \return whether labels were removed
  bool part_vertices()
  {
    // Vertices inside of the elements around each vertex that is not inside.
    std::vector<std::vector<Vertex_index>> all_around(m_mesh.vertices.size());
    for(Element_index e = 0; e < m_mesh.elements.size(); ++e)
      for(Vertex_index v : m_mesh.elements[e])
        if(is_near(v) && !m_mesh.is_inside(v))
          for(Vertex_index w : m_mesh.elements[e])
            if(is_near(w) && m_mesh.is_inside(w))
              all_around[v].push_back(w);
    const std::size_t taken_before = m_taken.size();
    for(Vertex_index v = 0; v < all_around.size(); ++v) {
      std::vector<Vertex_index>& around = all_around[v];
      std::sort(around.begin(), around.end());
      around.erase(std::unique(around.begin(), around.end()), around.end());
      for(std::size_t i = 0; i < around.size(); ++i)
        for(std::size_t j = 0; j < i; ++j) {
          const Vertex_index a = around[i], b = around[j];
          if(!m_mesh.is_inside(a) || !m_mesh.is_inside(b) || !has_gap_between(a, b))
            continue;
          const Vec3 to_sheet = m_closest[v] - m_points[v];
          const double to_a = cosine(to_sheet, m_points[a] - m_points[v]),
                       to_b = cosine(to_sheet, m_points[b] - m_points[v]);
          take_label(to_a < to_b ? a : b);
        }
    }
    return m_taken.size() > taken_before;
  }

  void take_label(Vertex_index v)
  {
    m_mesh.sides[v] = ON_UNBOUNDED_SIDE;
    m_taken.push_back(v);
  }

  // Returns the labels of a wall that would have no vertex inside any more, but not those of corners, which
  // have few vertices.
  void return_labels()
  {
    const std::size_t n = m_mesh.vertices.size();
    std::vector<std::uint8_t> is_alone(n, 0); // among vertices that are not inside
    for(Vertex_index v : m_taken)
      is_alone[v] = 1;
    for(Element_index e = 0; e < m_mesh.elements.size(); ++e) {
      const Element_view element = m_mesh.elements[e];
      if(std::any_of(element.begin(), element.end(), [this](Vertex_index v) { return m_mesh.is_inside(v); }))
        for(Vertex_index v : element)
          is_alone[v] = 0;
    }
    std::vector<std::vector<Vertex_index>> elements;
    for(Element_index e = 0; e < m_mesh.elements.size(); ++e) {
      std::vector<Vertex_index> alone;
      for(Vertex_index v : m_mesh.elements[e])
        if(is_alone[v])
          alone.push_back(v);
      if(!alone.empty())
        elements.push_back(std::move(alone));
    }
    const Shells_of_vertices parts = find_shells(elements, n);
    std::vector<std::size_t> sizes(parts.counts.number_of_shells, 0);
    for(Vertex_index v = 0; v < n; ++v)
      if(is_alone[v])
        ++sizes[parts.shell_of[v]];
    for(Vertex_index v = 0; v < n; ++v)
      if(is_alone[v] && sizes[parts.shell_of[v]] >= smallest_wall)
        m_mesh.sides[v] = ON_BOUNDED_SIDE;
  }

  static double cosine(const Vec3& a, const Vec3& b) { return dot(a, b) / norm(b); }

  // Whether there is a gap between two vertices inside; many pairs have several elements or vertices in
  // common.
  bool has_gap_between(Vertex_index a, Vertex_index b)
  {
    if(a < b)
      std::swap(a, b);
    const auto [found, is_new] = m_gaps.try_emplace(std::uint64_t(a) << 32 | b, false);
    if(is_new)
      found->second = is_gap_between(a, b);
    return found->second;
  }

  bool is_gap_between(Vertex_index a, Vertex_index b)
  {
    if(!is_near(a) || !is_near(b))
      return false;
    const Vec3 line = m_points[b] - m_points[a];
    const double length = norm(line), step = smallest_step * length;
    if(m_distances[a] + m_distances[b] > length)
      return false;
    for(double t = (std::max)(m_distances[a], step); t < length - m_distances[b];) {
      const Vec3 p = m_points[a] + (t / length) * line;
      const double distance = norm(p - closest(p));
      if(distance < length / 2 && m_octree.bounded_side(p) == ON_UNBOUNDED_SIDE)
        return true;
      t += (std::max)(distance, step);
    }
    return false;
  }
};

/// Widens gaps like `widen_gaps()`, by lines instead of normals: rims of gaps are found, too, but walls
/// between gaps may be lost.
inline void widen_gaps_by_lines(const Located_octree& octree, Lattice_mesh& mesh)
{
  Gap_widener(octree, mesh)();
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_GAP_WIDENER_H
