// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cells into which triangles divide space, and whether they are solid.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_REPAIR_SPACE_PARTITION_H
#define CGAL_MIXED_MESH_3_INTERNAL_REPAIR_SPACE_PARTITION_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Disjoint_sets.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/repair/Solid_rule.h>
#include <CGAL/Mixed_mesh_3/internal/repair/Triangle_arrangement.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/enum.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
The cells of an arrangement. The two sides of each facet see one cell each; around an edge, neighbors see the
same cell. So facets that are connected by edges have consistent cells; a ray tells where the cells are.
*/
class Space_partition
{
  using Kernel = Triangle_arrangement::Kernel;
  using Point = Triangle_arrangement::Point;
  struct Edge_use
  {
    std::array<std::size_t, 2> edge; // ascending
    std::size_t facet;
  };

  const std::vector<Point>& m_points;
  const std::vector<Arrangement_facet>& m_facets;
  std::vector<Bbox_3> m_boxes;
  Bbox_3 m_bbox;
  std::vector<std::vector<std::size_t>> m_around;  // facets around an edge, in cyclic order
  std::vector<std::array<std::size_t, 2>> m_edges; // edges, vertices ascending
  std::vector<std::size_t> m_cell;                 // cell by side: the least side that sees it
  std::vector<int> m_winding;                      // winding number by side
  Solid_rule m_rule = Solid_rule::WINDING;
  bool m_is_complete = true;

public:
  explicit Space_partition(const Triangle_arrangement& arrangement)
    : m_points(arrangement.points()), m_facets(arrangement.facets())
  {
    for(const Arrangement_facet& f : m_facets) {
      m_boxes.push_back(m_points[f.vertices[0]].bbox() + m_points[f.vertices[1]].bbox()
                        + m_points[f.vertices[2]].bbox());
      m_bbox += m_boxes.back();
    }
    find_edges();
    Disjoint_sets sides(2 * m_facets.size());
    for_each_edge([&](std::size_t a, std::size_t b, const std::vector<std::size_t>& around) {
      for(std::size_t i = 0; i < around.size(); ++i) {
        const std::size_t side = side_after(around[i], a, b),
                          next = side_after(around[(i + 1) % around.size()], a, b) ^ 1;
        sides.unite(side, next);
      }
    });
    m_cell = sides.least_of_all();
    find_rule();
    find_windings();
  }

  static std::size_t front(std::size_t facet) { return 2 * facet; }
  static std::size_t back(std::size_t facet) { return 2 * facet + 1; }

  Solid_rule rule() const { return m_rule; }

  /// Whether all cells are known: no ray tells if facets overlap, as facets of an arrangement do not.
  bool is_complete() const { return m_is_complete; }

  /// Calls back with each edge and the facets around the edge, in the order of a right turn seen along the
  /// edge.
  template <class Use>
  void for_each_edge(const Use& use) const
  {
    for(std::size_t e = 0; e < m_edges.size(); ++e)
      use(m_edges[e][0], m_edges[e][1], m_around[e]);
  }

  /// The side of a facet that faces the next facet around an edge.
  std::size_t side_after(std::size_t facet, std::size_t a, std::size_t b) const
  {
    const auto& v = m_facets[facet].vertices;
    const bool is_along = (v[0] == a && v[1] == b) || (v[1] == a && v[2] == b) || (v[2] == a && v[0] == b);
    return is_along ? front(facet) : back(facet);
  }

  bool is_solid(std::size_t side) const
  {
    return m_rule == Solid_rule::PARITY ? m_winding[side] % 2 != 0 : m_winding[side] > 0;
  }

  /// The volume of cells around which triangles wind inwards, each times its winding number.
  double inverted_volume() const
  {
    if(m_rule != Solid_rule::WINDING || m_facets.empty())
      return 0;
    double volume = 0;
    const auto vec = [this](std::size_t v) {
      return Vec3{CGAL::to_double(m_points[v].x()), CGAL::to_double(m_points[v].y()),
                  CGAL::to_double(m_points[v].z())};
    };
    const Vec3 origin = vec(m_facets.front().vertices[0]);
    for(std::size_t f = 0; f < m_facets.size(); ++f) {
      const auto& v = m_facets[f].vertices;
      const int increment = (std::min)(m_winding[back(f)], 0) - (std::min)(m_winding[front(f)], 0);
      if(increment != 0)
        volume -= increment * determinant(vec(v[0]) - origin, vec(v[1]) - origin, vec(v[2]) - origin) / 6;
    }
    return volume;
  }

private:
  void find_edges()
  {
    std::vector<Edge_use> uses;
    for(std::size_t f = 0; f < m_facets.size(); ++f) {
      const auto& v = m_facets[f].vertices;
      for(const auto& [a, b] : {std::pair(v[0], v[1]), std::pair(v[1], v[2]), std::pair(v[0], v[2])})
        uses.push_back({{a, b}, f});
    }
    std::sort(uses.begin(), uses.end(), [](const Edge_use& u, const Edge_use& w) {
      return u.edge != w.edge ? u.edge < w.edge : u.facet < w.facet;
    });
    for(auto first = uses.begin(), last = first; first != uses.end(); first = last) {
      std::vector<std::size_t> around;
      for(; last != uses.end() && last->edge == first->edge; ++last)
        around.push_back(last->facet);
      if(around.size() > 2)
        sort_around(first->edge[0], first->edge[1], around);
      m_edges.push_back(first->edge);
      m_around.push_back(std::move(around));
    }
  }

  const Point& opposite(std::size_t facet, std::size_t a, std::size_t b) const
  {
    const auto& v = m_facets[facet].vertices;
    return m_points[*std::find_if(v.begin(), v.end(), [&](std::size_t w) { return w != a && w != b; })];
  }

  // Sorts facets around an edge by the angle from the first facet.
  void sort_around(std::size_t a, std::size_t b, std::vector<std::size_t>& around) const
  {
    const Point &p = m_points[a], &q = m_points[b], start = opposite(around[0], a, b);
    const auto turn = [&](const Point& r, const Point& s) { return CGAL::orientation(p, q, r, s); };
    const auto half = [&](const Point& r) { // 0: up to half a turn, 1: half, 2: more
      const Orientation o = turn(start, r);
      return o == CGAL::POSITIVE ? 0 : o == CGAL::COPLANAR ? 1 : 2;
    };
    std::sort(around.begin() + 1, around.end(), [&](std::size_t f, std::size_t g) {
      const Point &r = opposite(f, a, b), &s = opposite(g, a, b);
      const int of_r = half(r), of_s = half(s);
      return of_r != of_s ? of_r < of_s : turn(r, s) == CGAL::POSITIVE;
    });
  }

  // Finds the rule by the edges: in a closed surface, as many triangles run along each edge as against it.
  void find_rule()
  {
    for_each_edge([this](std::size_t a, std::size_t b, const std::vector<std::size_t>& around) {
      int sum = 0, number = 0;
      for(std::size_t f : around) {
        sum += side_after(f, a, b) == front(f) ? m_facets[f].weight : -m_facets[f].weight;
        number += m_facets[f].number;
      }
      if(sum != 0 && m_rule == Solid_rule::WINDING)
        m_rule = Solid_rule::PARITY;
      if(number % 2 != 0)
        m_rule = Solid_rule::ENCLOSED;
    });
  }

  // Increase of the winding number from the back to the front of a facet.
  int winding_increment(std::size_t f) const
  {
    return m_rule == Solid_rule::PARITY ? m_facets[f].number : m_facets[f].weight;
  }

  // Numbers the components of facets connected by edges; returns the first facet of each component.
  std::vector<std::size_t> find_components(std::vector<std::size_t>& component) const
  {
    Disjoint_sets sets(m_facets.size());
    for(const auto& around : m_around)
      for(std::size_t f : around)
        sets.unite(f, around[0]);
    component = sets.least_of_all();
    std::vector<std::size_t> first;
    for(std::size_t f = 0; f < m_facets.size(); ++f)
      if(component[f] == f)
        first.push_back(f);
    return first;
  }

  void find_windings()
  {
    m_winding.resize(m_cell.size());
    const std::size_t unknown = std::size_t(-1);
    std::vector<int> winding(m_cell.size(), 0); // winding numbers by cell
    std::vector<char> is_known(m_cell.size(), 0);
    std::vector<std::vector<std::size_t>> facets_of(m_cell.size());
    for(std::size_t f = 0; f < m_facets.size(); ++f)
      for(std::size_t s : {front(f), back(f)})
        facets_of[m_cell[s]].push_back(f);
    std::vector<std::size_t> component;
    for(std::size_t first : find_components(component)) {
      const std::optional<Segment_result> result = cast_segment(first, component);
      if(!result) {
        m_is_complete = false;
        return;
      }
      const auto [side, outside, w] = *result;
      std::vector<std::size_t> queue{m_rule == Solid_rule::ENCLOSED ? m_cell[outside] : m_cell[side]};
      winding[queue[0]] = m_rule == Solid_rule::ENCLOSED ? 0 : w;
      is_known[queue[0]] = 1;
      for(std::size_t i = 0; i < queue.size() && queue[i] != unknown; ++i)
        for(std::size_t f : facets_of[queue[i]]) {
          const std::size_t s = m_cell[front(f)] == queue[i] ? front(f) : back(f), other = m_cell[s ^ 1];
          if(is_known[other])
            continue;
          is_known[other] = 1;
          winding[other] = m_rule == Solid_rule::ENCLOSED ? 1
                           : s == front(f)                ? winding[queue[i]] + winding_increment(f)
                                                          : winding[queue[i]] - winding_increment(f);
          queue.push_back(other);
        }
    }
    for(std::size_t s = 0; s < m_cell.size(); ++s)
      m_winding[s] = winding[m_cell[s]];
  }

  struct Segment_result
  {
    std::size_t side;    // side at which the segment starts
    std::size_t outside; // side at which the segment last leaves the component
    int winding;         // winding number around `side`
  };

  // Casts segments from the middle of a facet to far away; nothing if all of some forty segments touch
  // edges.
  std::optional<Segment_result> cast_segment(std::size_t start,
                                             const std::vector<std::size_t>& component) const
  {
    const auto& v = m_facets[start].vertices;
    const Point p = CGAL::centroid(m_points[v[0]], m_points[v[1]], m_points[v[2]]);
    // The direction is nearly along an axis, so that few boxes are met.
    const double length = 2 * ((std::max)({m_bbox.x_span(), m_bbox.y_span(), m_bbox.z_span()}) + 1e-30);
    constexpr int most_trials = 40; // the last one is of slope 200
    double slope = 1e-3;
    for(int trial = 0; trial < most_trials; ++trial) {
      slope = trial == 0 ? slope : 1.37 * slope;
      const Kernel::Vector_3 out(length, slope * length, 0.618 * slope * (trial + 1) * length);
      const std::optional<Segment_result> result = cast_segment(start, p, p + out, component);
      if(result)
        return result;
    }
    return std::nullopt;
  }

  // Casts a segment; nothing if the segment touches an edge, or is parallel to a facet that it touches.
  std::optional<Segment_result> cast_segment(std::size_t start, const Point& p, const Point& q,
                                             const std::vector<std::size_t>& component) const
  {
    const auto side_of = [this](std::size_t f, const Point& r) {
      const auto& v = m_facets[f].vertices;
      return CGAL::orientation(m_points[v[0]], m_points[v[1]], m_points[v[2]], r);
    };
    const Orientation leaves_to = side_of(start, q);
    if(leaves_to == COPLANAR)
      return std::nullopt;
    Segment_result result;
    result.side = result.outside = leaves_to == POSITIVE ? front(start) : back(start);
    result.winding = 0;
    Kernel::FT farthest = 0;
    const Bbox_3 box = p.bbox() + q.bbox();
    for(std::size_t f = 0; f < m_facets.size(); ++f) {
      if(f == start || !CGAL::do_overlap(box, m_boxes[f]))
        continue;
      const auto& v = m_facets[f].vertices;
      const Orientation of_p = side_of(f, p), of_q = side_of(f, q);
      if(of_p == of_q && of_p != COPLANAR)
        continue;
      const Point &a = m_points[v[0]], &b = m_points[v[1]], &c = m_points[v[2]];
      const Orientation o0 = CGAL::orientation(p, q, a, b), o1 = CGAL::orientation(p, q, b, c);
      if(o0 * o1 == -1)
        continue;
      const Orientation o2 = CGAL::orientation(p, q, c, a);
      if(o0 * o2 == -1 || o1 * o2 == -1)
        continue;
      if(of_p == COPLANAR || of_q == COPLANAR || o0 == COPLANAR || o1 == COPLANAR || o2 == COPLANAR)
        return std::nullopt;
      result.winding += of_p == NEGATIVE ? winding_increment(f) : -winding_increment(f);
      if(component[f] != component[start])
        continue;
      const Kernel::FT from_p = CGAL::volume(a, b, c, p), from_q = CGAL::volume(a, b, c, q),
                       t = from_p / (from_p - from_q);
      if(t > farthest) {
        farthest = t;
        result.outside = of_q == POSITIVE ? front(f) : back(f);
      }
    }
    return result;
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_REPAIR_SPACE_PARTITION_H
