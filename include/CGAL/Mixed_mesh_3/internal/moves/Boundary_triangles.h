// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The boundary while its edges are collapsed: the triangles that a new triangle would cut are found near it.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MOVES_BOUNDARY_TRIANGLES_H
#define CGAL_MIXED_MESH_3_INTERNAL_MOVES_BOUNDARY_TRIANGLES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Face.h>
#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/Interface_curves.h>
#include <CGAL/Mixed_mesh_3/internal/surface/self_intersections.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Triangles, with lists of those at each vertex and those in each cell of a grid. Positions do not change.
class Boundary_triangles
{
public:
  using Triangle = std::array<Vertex_index, 3>;

private:
  using Number = std::uint32_t;
  using Cell = std::array<std::int64_t, 3>;

  std::vector<Predicates_kernel::Point_3> m_points;
  std::vector<Triangle> m_triangles;
  std::vector<std::vector<Number>> m_at_vertex;
  std::unordered_map<std::uint64_t, std::vector<Number>> m_in_cell;
  double m_side = 1; // side of the cells of the grid
  Vec3 m_origin{0, 0, 0};

public:
  /// \param number_at_most approximate number of triangles in the end
  /// \pre the faces are triangles
  Boundary_triangles(const std::vector<Vec3>& positions, const std::vector<Face>& faces,
                     std::size_t number_at_most)
    : Boundary_triangles(positions, vertices_of_faces(faces), number_at_most)
  {
  }

  Boundary_triangles(const std::vector<Vec3>& positions, const std::vector<Face_vertices>& faces,
                     std::size_t number_at_most)
    : m_at_vertex(positions.size())
  {
    for(const Vec3& p : positions)
      m_points.emplace_back(p[0], p[1], p[2]);
    double doubled_area = 0;
    for(const Face_vertices& v : faces) {
      CGAL_precondition(v.size() == 3);
      m_triangles.push_back({v[0], v[1], v[2]});
      doubled_area += norm(cross(positions[v[1]] - positions[v[0]], positions[v[2]] - positions[v[0]]));
    }
    if(faces.empty())
      return;
    m_origin = positions[m_triangles.front()[0]];
    for(const Triangle& t : m_triangles)
      for(Vertex_index v : t)
        for(int k = 0; k < 3; ++k)
          m_origin[k] = (std::min)(m_origin[k], positions[v][k]);
    m_side = 2 * std::sqrt(doubled_area / double((std::max)(number_at_most, std::size_t(1))));
    for(Number i = 0; i < m_triangles.size(); ++i)
      add(i);
  }

  /// The triangles at a vertex.
  std::vector<Triangle> at(Vertex_index v) const
  {
    std::vector<Triangle> triangles;
    for(Number i : m_at_vertex[v])
      triangles.push_back(m_triangles[i]);
    return triangles;
  }

  template <class Visit>
  void for_each_at(Vertex_index v, const Visit& visit) const
  {
    for(Number i : m_at_vertex[v])
      visit(m_triangles[i]);
  }

  /// Whether triangles would meet in more than vertices and edges they share, if w replaced v in all
  /// triangles. The test is exact.
  bool would_cross(Vertex_index v, Vertex_index w) const
  {
    std::vector<Triangle> fan;
    for(Number i : m_at_vertex[v])
      if(!has(i, w)) {
        fan.push_back(m_triangles[i]);
        std::replace(fan.back().begin(), fan.back().end(), v, w);
      }
    for(std::size_t i = 0; i < fan.size(); ++i)
      for(std::size_t j = 0; j < i; ++j)
        if(is_crossing(fan[i], fan[j], m_points))
          return true;
    return std::any_of(fan.begin(), fan.end(), [&](const Triangle& t) {
      return any_cell_of(t, [&](std::uint64_t cell) {
        const auto found = m_in_cell.find(cell);
        return found != m_in_cell.end()
               && std::any_of(found->second.begin(), found->second.end(), [&](Number i) {
                    return !has(i, v) && do_boxes_meet(m_triangles[i], t)
                           && is_crossing(m_triangles[i], t, m_points);
                  });
      });
    });
  }

  /// Replaces v by w in all triangles of v; triangles of both are removed.
  void collapse(Vertex_index v, Vertex_index w)
  {
    const std::vector<Number> at_v = m_at_vertex[v];
    for(Number i : at_v) {
      const bool stays = !has(i, w);
      remove(i);
      if(stays) {
        std::replace(m_triangles[i].begin(), m_triangles[i].end(), v, w);
        add(i);
      }
    }
  }

private:
  bool has(Number i, Vertex_index v) const
  {
    return std::find(m_triangles[i].begin(), m_triangles[i].end(), v) != m_triangles[i].end();
  }

  void add(Number i)
  {
    for(Vertex_index v : m_triangles[i])
      m_at_vertex[v].push_back(i);
    any_cell_of(m_triangles[i], [&](std::uint64_t cell) {
      m_in_cell[cell].push_back(i);
      return false;
    });
  }

  void remove(Number i)
  {
    const auto erase = [i](std::vector<Number>& numbers) {
      numbers.erase(std::find(numbers.begin(), numbers.end(), i));
    };
    for(Vertex_index v : m_triangles[i])
      erase(m_at_vertex[v]);
    any_cell_of(m_triangles[i], [&](std::uint64_t cell) {
      erase(m_in_cell[cell]);
      return false;
    });
  }

  double least(const Triangle& t, int k) const
  {
    return (std::min)({m_points[t[0]][k], m_points[t[1]][k], m_points[t[2]][k]});
  }
  double largest(const Triangle& t, int k) const
  {
    return (std::max)({m_points[t[0]][k], m_points[t[1]][k], m_points[t[2]][k]});
  }

  bool do_boxes_meet(const Triangle& s, const Triangle& t) const
  {
    for(int k = 0; k < 3; ++k)
      if(largest(s, k) < least(t, k) || largest(t, k) < least(s, k))
        return false;
    return true;
  }

  // Whether something holds for any cell that the box of a triangle meets.
  template <class Holds>
  bool any_cell_of(const Triangle& t, const Holds& holds) const
  {
    Cell first, last;
    for(int k = 0; k < 3; ++k) {
      first[std::size_t(k)] = std::int64_t(std::floor((least(t, k) - m_origin[k]) / m_side));
      last[std::size_t(k)] = std::int64_t(std::floor((largest(t, k) - m_origin[k]) / m_side));
    }
    for(std::int64_t x = first[0]; x <= last[0]; ++x)
      for(std::int64_t y = first[1]; y <= last[1]; ++y)
        for(std::int64_t z = first[2]; z <= last[2]; ++z)
          if(holds((std::uint64_t(x) << 42) ^ (std::uint64_t(y) << 21) ^ std::uint64_t(z)))
            return true;
    return false;
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MOVES_BOUNDARY_TRIANGLES_H
