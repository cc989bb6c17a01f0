// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Collapses by quadrics: Garland and Heckbert: Surface simplification using quadric error metrics (1997).

#ifndef CGAL_MIXED_MESH_IMAGE_3_INTERNAL_QUADRIC_COLLAPSES_H
#define CGAL_MIXED_MESH_IMAGE_3_INTERNAL_QUADRIC_COLLAPSES_H

#include <CGAL/Mixed_mesh_3/internal/base/Plane_quadric.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The cost of a collapse to a point. The weight of the length is for plane parts of the surface, where all
/// places are equally good: short edges first keep triangles compact.
inline double cost_of_collapse(const Plane_quadric& quadric, const Vec3& point, const Vec3& edge)
{
  constexpr double weight_of_length = 1e-5;
  return quadric(point) + weight_of_length * quadric.area() * dot(edge, edge);
}

/// Whether a triangle keeps its side and does not become a needle when its corner p moves.
inline bool keeps_side(const Vec3& p, const Vec3& moved, const Vec3& a, const Vec3& b)
{
  constexpr double least_cosine = 0.2, least_shape = 0.05; // cosine of angles; shape, 0.29 if equilateral
  const Vec3 before = cross(a - p, b - p), after = cross(a - moved, b - moved);
  const double cosine = dot(before, after);
  const auto shape = [&](const Vec3& normal, const Vec3& corner) {
    const double squares = dot(a - corner, a - corner) + dot(b - corner, b - corner) + dot(a - b, a - b);
    return norm(normal) / squares;
  };
  return cosine > 0
         && cosine * cosine >= least_cosine * least_cosine * dot(before, before) * dot(after, after)
         && shape(after, moved) >= (std::min)(least_shape, shape(before, p));
}

/*!
Collapses edges of a closed triangulated surface, edges first that move the surface least from the planes of
its triangles.

The method uses arrays of numbers, and a cost of few operations: it is some 50 times as fast as the collapse
by volume and shape, for which it leaves a multiple of the vertices. The topology is kept (the link
condition), and no triangle turns over; the caller has to check that triangles that are no neighbors do not
cut each other.

Edges are half-edges in pairs. Half-edge `3 t + i` goes from corner `i` of triangle `t` to the next corner.
*/
class Quadric_collapses
{
public:
  using Index = std::uint32_t;
  using Triangle = std::array<Index, 3>;

private:
  static constexpr Index none = Index(-1);

  struct Candidate
  {
    double cost;
    Index halfedge, version;

    // The half-edge decides between equal costs, so that the order does not depend on the queue.
    bool operator>(const Candidate& other) const
    {
      return cost > other.cost || (cost == other.cost && halfedge > other.halfedge);
    }
  };

  std::vector<Vec3> m_points;
  std::vector<Index> m_source;   // source of each half-edge; none if its triangle is removed
  std::vector<Index> m_opposite; // opposite of each half-edge
  std::vector<Index> m_outgoing; // a half-edge of each vertex
  std::vector<Index> m_version;  // version of each vertex: grows when the vertex moves
  std::vector<Plane_quadric> m_quadrics;
  std::vector<bool> m_is_fixed; // one value for each vertex
  std::size_t m_number_of_vertices;
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> m_queue;

public:
  /// \param opposite opposite half-edge of each half-edge
  /// \param is_fixed whether each vertex stays where it is
  Quadric_collapses(std::vector<Vec3> points, const std::vector<Triangle>& triangles,
                    std::vector<Index> opposite, std::vector<bool> is_fixed)
    : m_points(std::move(points)), m_opposite(std::move(opposite)), m_outgoing(m_points.size(), none),
      m_version(m_points.size(), 0), m_quadrics(m_points.size()), m_is_fixed(std::move(is_fixed)),
      m_number_of_vertices(m_points.size())
  {
    for(const Triangle& t : triangles) {
      Plane_quadric quadric;
      quadric.add(m_points[t[0]], m_points[t[1]], m_points[t[2]]);
      for(const Index v : t) {
        m_quadrics[v] += quadric;
        m_outgoing[v] = Index(m_source.size());
        m_source.push_back(v);
      }
    }
  }

  /// Collapses edges until the number of vertices is reached, or no edge can be collapsed.
  void operator()(std::size_t number_of_vertices)
  {
    for(Index h = 0; h < m_source.size(); ++h)
      if(h < m_opposite[h])
        add_candidate(h);
    while(m_number_of_vertices > number_of_vertices && !m_queue.empty()) {
      const Candidate next = m_queue.top();
      m_queue.pop();
      const Index h = next.halfedge;
      if(m_source[h] == none || version_of(h) != next.version)
        continue; // there is a newer one
      const Vec3 point = place_of(h);
      if(may_collapse(h, point))
        collapse(h, point);
    }
  }

  /// The remaining surface: in the former order, without gaps.
  std::pair<std::vector<Vec3>, std::vector<Triangle>> result() const
  {
    std::pair<std::vector<Vec3>, std::vector<Triangle>> left;
    std::vector<Index> number(m_points.size(), none);
    for(Index v = 0; v < m_points.size(); ++v)
      if(m_outgoing[v] != none) {
        number[v] = Index(left.first.size());
        left.first.push_back(m_points[v]);
      }
    for(std::size_t h = 0; h < m_source.size(); h += 3)
      if(m_source[h] != none)
        left.second.push_back({number[m_source[h]], number[m_source[h + 1]], number[m_source[h + 2]]});
    return left;
  }

private:
  static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static Index previous(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }
  Index target(Index h) const { return m_source[next(h)]; }
  Index version_of(Index h) const { return m_version[m_source[h]] + m_version[target(h)]; }

  /// Calls `f` for each half-edge from a vertex.
  template <class F>
  void for_each_outgoing(Index v, const F& f) const
  {
    Index h = m_outgoing[v];
    do {
      f(h);
      h = m_opposite[previous(h)];
    } while(h != m_outgoing[v]);
  }

  Plane_quadric quadric_of(Index h) const
  {
    Plane_quadric quadric = m_quadrics[m_source[h]];
    quadric += m_quadrics[target(h)];
    return quadric;
  }

  Vec3 place_of(Index h) const
  {
    return quadric_of(h).minimum_near(0.5 * (m_points[m_source[h]] + m_points[target(h)]));
  }

  void add_candidate(Index h)
  {
    if(m_is_fixed[m_source[h]] || m_is_fixed[target(h)])
      return;
    const Plane_quadric quadric = quadric_of(h);
    const Vec3 &p = m_points[m_source[h]], &q = m_points[target(h)];
    const double cost = cost_of_collapse(quadric, quadric.minimum_near(0.5 * (p + q)), q - p);
    m_queue.push({cost, h, version_of(h)});
  }

  bool may_collapse(Index h, const Vec3& point) const
  {
    return keeps_topology(h) && keeps_sides(h, point) && keeps_sides(m_opposite[h], point);
  }

  // Whether the link condition holds: the ends have two common neighbors, opposite to the edge, with more
  // than three edges.
  bool keeps_topology(Index h) const
  {
    const Index u = m_source[h], v = target(h);
    int common = 0;
    for_each_outgoing(u, [&](Index a) {
      for_each_outgoing(v, [&](Index b) { common += target(a) == target(b); });
    });
    const auto has_more_than_three = [this](Index w) {
      int degree = 0;
      for_each_outgoing(w, [&degree](Index) { ++degree; });
      return degree > 3;
    };
    return common == 2 && has_more_than_three(m_source[previous(h)])
           && has_more_than_three(m_source[previous(m_opposite[h])]);
  }

  // Whether triangles at the source, except those at the edge, keep their side and do not become needles.
  bool keeps_sides(Index edge, const Vec3& point) const
  {
    bool is_kept = true;
    for_each_outgoing(m_source[edge], [&](Index h) {
      if(is_kept && h != edge && h != next(m_opposite[edge]))
        is_kept = keeps_side(m_points[m_source[h]], point, m_points[target(h)],
                             m_points[m_source[previous(h)]]);
    });
    return is_kept;
  }

  // Collapses an edge: the source is merged into the target, which moves to the point.
  void collapse(Index h, const Vec3& point)
  {
    const Index o = m_opposite[h], u = m_source[h], v = target(h);
    const Plane_quadric quadric = quadric_of(h);
    for_each_outgoing(u, [this, v](Index outgoing) { m_source[outgoing] = v; });
    const auto close_triangle = [this](Index edge) {
      const Index a = m_opposite[next(edge)], b = m_opposite[previous(edge)];
      m_opposite[a] = b;
      m_opposite[b] = a;
      m_outgoing[m_source[a]] = a;
      m_outgoing[m_source[b]] = b;
      for(const Index gone : {edge, next(edge), previous(edge)})
        m_source[gone] = none;
    };
    close_triangle(h);
    close_triangle(o);
    m_outgoing[u] = none;
    m_points[v] = point;
    m_quadrics[v] = quadric;
    m_version[v] += m_version[u] + 1; // more than those of all edges to both vertices
    --m_number_of_vertices;
    for_each_outgoing(v,
                      [this](Index outgoing) { add_candidate((std::min)(outgoing, m_opposite[outgoing])); });
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_INTERNAL_QUADRIC_COLLAPSES_H
