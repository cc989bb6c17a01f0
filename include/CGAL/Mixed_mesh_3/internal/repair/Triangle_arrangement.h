// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Arrangement of triangles, cut exactly where they meet.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_REPAIR_TRIANGLE_ARRANGEMENT_H
#define CGAL_MIXED_MESH_3_INTERNAL_REPAIR_TRIANGLE_ARRANGEMENT_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_3/internal/base/box_pairs.h>
#include <CGAL/Mixed_mesh_3/internal/base/compatibility.h>
#include <CGAL/Mixed_mesh_3/internal/base/is_crossing.h>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/enum.h>
#include <CGAL/intersections.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// A piece of a triangle, or of several that overlap.
struct Arrangement_facet
{
  std::array<std::size_t, 3> vertices; ///< ascending: the front is where they are counterclockwise
  int weight = 0;                      ///< number of triangles oriented so, minus that of the others
  int number = 0;                      ///< number of triangles
};

/// A piece of one triangle, oriented as the triangle.
struct Triangle_piece
{
  std::array<std::size_t, 3> vertices;
  std::size_t triangle;
};

/*!
Triangles that have nothing in common but vertices and edges, and cover the same points as the given
triangles.

All coordinates are exact: equal points are one vertex, equal pieces one facet.
*/
class Triangle_arrangement
{
public:
  using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
  using Point = Kernel::Point_3;
  using Triangle = std::array<std::size_t, 3>;

private:
  using Input_point = Predicates_kernel::Point_3;
  using Pair = std::pair<std::size_t, std::size_t>;
  using Point_2 = Kernel::Point_2;
  using Constrained_triangulation = CGAL::Constrained_triangulation_plus_2<
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Default, CGAL::Exact_intersections_tag>>;

  std::vector<Point> m_points;
  std::vector<Arrangement_facet> m_facets;
  std::vector<Triangle_piece> m_pieces;
  bool m_is_complete = true;
  std::map<Point, std::size_t> m_index;
  std::map<Triangle, std::size_t> m_facet;

  struct Too_many
  {
  };

public:
  /// \param most limit of the number of pairs of triangles that meet, and of pieces; above the limit the
  /// arrangement is empty and not complete
  Triangle_arrangement(const std::vector<Input_point>& points, const std::vector<Triangle>& input,
                       std::size_t most)
  {
    std::map<Input_point, std::size_t> place; // first point at each place
    std::vector<std::size_t> first(points.size());
    for(std::size_t v = 0; v < points.size(); ++v)
      first[v] = place.emplace(points[v], v).first->second;
    std::vector<Triangle> triangles;
    std::vector<std::size_t> numbers; // numbers in the input
    for(std::size_t i = 0; i < input.size(); ++i) {
      const Triangle& t = input[i];
      const Triangle u{first[t[0]], first[t[1]], first[t[2]]};
      if(!CGAL::collinear(points[u[0]], points[u[1]], points[u[2]])) {
        triangles.push_back(u);
        numbers.push_back(i);
      }
    }
    try {
      arrange(points, std::move(triangles), numbers, most);
    } catch(const Too_many&) {
      m_points.clear();
      m_facets.clear();
      m_pieces.clear();
      m_is_complete = false;
    }
  }

  bool is_complete() const { return m_is_complete; }
  const std::vector<Point>& points() const { return m_points; }
  const std::vector<Arrangement_facet>& facets() const { return m_facets; }

  /// The pieces of all triangles, by the number of the triangle: where triangles overlap, each has its piece.
  const std::vector<Triangle_piece>& pieces() const { return m_pieces; }

private:
  void arrange(const std::vector<Input_point>& points, std::vector<Triangle> triangles,
               const std::vector<std::size_t>& numbers, std::size_t most)
  {
    const std::vector<Pair> pairs = meetings(points, triangles, most);
    std::vector<std::vector<std::size_t>> met(triangles.size());
    for(const auto& [s, t] : pairs) {
      met[s].push_back(t);
      met[t].push_back(s);
    }
    std::vector<std::size_t> index(points.size(), std::size_t(-1));
    for(const Triangle& t : triangles)
      for(std::size_t v : t)
        if(index[v] == std::size_t(-1)) {
          index[v] = m_points.size();
          m_points.emplace_back(points[v].x(), points[v].y(), points[v].z());
        }
    // The index has only places that may be met again.
    for(std::size_t t = 0; t < triangles.size(); ++t)
      if(!met[t].empty())
        for(std::size_t v : triangles[t])
          m_index.emplace(m_points[index[v]], index[v]);
    for(Triangle& t : triangles)
      t = {index[t[0]], index[t[1]], index[t[2]]};
    for(std::size_t t = 0; t < triangles.size(); ++t)
      if(met[t].empty())
        add(triangles[t], numbers[t]);
      else
        cut(t, met[t], triangles, numbers[t], triangles.size() + most);
  }

  static std::vector<Pair> meetings(const std::vector<Input_point>& points,
                                    const std::vector<Triangle>& triangles, std::size_t most)
  {
    std::vector<Numbered_box> boxes;
    for(std::size_t t = 0; t < triangles.size(); ++t)
      boxes.emplace_back(points[triangles[t][0]].bbox() + points[triangles[t][1]].bbox()
                           + points[triangles[t][2]].bbox(),
                         t);
    std::vector<Pair> pairs;
    for_each_pair_of_boxes(boxes, [&](const Numbered_box& a, const Numbered_box& b) {
      const Triangle &s = triangles[a.info()], &t = triangles[b.info()];
      if(std::is_permutation(s.begin(), s.end(), t.begin()) // equal triangles are one facet
         || !is_crossing(s, t, points))
        return;
      pairs.push_back(std::minmax(a.info(), b.info()));
      if(pairs.size() > most)
        throw Too_many();
    });
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

  std::size_t index_of(const Point& p)
  {
    const auto [found, is_new] = m_index.emplace(p, m_points.size());
    if(is_new)
      m_points.push_back(p);
    return found->second;
  }

  void add(const Triangle& t, std::size_t number)
  {
    m_pieces.push_back({t, number});
    Triangle key = t;
    std::sort(key.begin(), key.end());
    const auto [found, is_new] = m_facet.emplace(key, m_facets.size());
    if(is_new)
      m_facets.push_back({key});
    const std::size_t smallest = std::size_t(std::min_element(t.begin(), t.end()) - t.begin());
    Arrangement_facet& facet = m_facets[found->second];
    facet.weight += t[(smallest + 1) % 3] < t[(smallest + 2) % 3] ? 1 : -1;
    ++facet.number;
  }

  // A triangle seen along the axis that is most upright: exactly, and from the same end of the axis for all
  // triangles of a plane. The Delaunay triangulation of points on a circle depends on the view; where
  // triangles overlap, the triangulations must be equal.
  class View
  {
    Point m_origin;
    Kernel::Vector_3 m_normal;
    int m_axis = 0, m_first, m_second;
    std::map<Point_2, Point> m_lifted;

  public:
    explicit View(const std::array<Point, 3>& p)
      : m_origin(p[0]), m_normal(CGAL::cross_product(p[1] - p[0], p[2] - p[0]))
    {
      for(int k = 1; k < 3; ++k)
        if(CGAL::abs(m_normal[k]) > CGAL::abs(m_normal[m_axis]))
          m_axis = k;
      m_first = (m_axis + 1) % 3;
      m_second = (m_axis + 2) % 3;
    }

    bool is_from_behind() const { return CGAL::is_negative(m_normal[m_axis]); }

    Point_2 flat(const Point& q)
    {
      const Point_2 result(q[m_first], q[m_second]);
      m_lifted.emplace(result, q);
      return result;
    }

    // The point of the triangle's plane at a place; where constraints cross, it is new.
    Point lifted(const Point_2& q) const
    {
      const auto found = m_lifted.find(q);
      if(found != m_lifted.end())
        return found->second;
      std::array<Kernel::FT, 3> x;
      x[std::size_t(m_first)] = q.x();
      x[std::size_t(m_second)] = q.y();
      x[std::size_t(m_axis)] = m_origin[m_axis]
                               - (m_normal[m_first] * (q.x() - m_origin[m_first])
                                  + m_normal[m_second] * (q.y() - m_origin[m_second]))
                                   / m_normal[m_axis];
      return Point(x[0], x[1], x[2]);
    }
  };

  Kernel::Triangle_3 triangle_of(const Triangle& t) const
  {
    return Kernel::Triangle_3(m_points[t[0]], m_points[t[1]], m_points[t[2]]);
  }

  // Adds what two triangles have in common.
  template <class Intersection>
  static void constrain(const Intersection& common, View& view, Constrained_triangulation& cdt)
  {
    const auto add = [&](const Point& a, const Point& b) {
      cdt.insert_constraint(view.flat(a), view.flat(b));
    };
    if(const Point* q = alternative<Point>(common)) {
      cdt.insert(view.flat(*q));
    } else if(const auto* s = alternative<Kernel::Segment_3>(common)) {
      add(s->source(), s->target());
    } else if(const auto* u = alternative<Kernel::Triangle_3>(common)) {
      for(int i = 0; i < 3; ++i)
        add(u->vertex(i), u->vertex(i + 1));
    } else if(const auto* polygon = alternative<std::vector<Point>>(common)) {
      for(std::size_t i = 0; i < polygon->size(); ++i)
        add((*polygon)[i], (*polygon)[(i + 1) % polygon->size()]);
    }
  }

  // Triangulates a triangle such that its edges have all points that other triangles have on them.
  void cut(std::size_t number, const std::vector<std::size_t>& met, const std::vector<Triangle>& triangles,
           std::size_t number_in_input, std::size_t most_facets)
  {
    const Triangle t = triangles[number];
    const std::array<Point, 3> p{m_points[t[0]], m_points[t[1]], m_points[t[2]]};
    View view(p);
    Constrained_triangulation cdt;
    for(int i = 0; i < 3; ++i)
      cdt.insert_constraint(view.flat(p[i]), view.flat(p[(i + 1) % 3]));
    for(std::size_t other : met) {
      // The order is the same for both triangles: the same construction gives the same point.
      const auto common = CGAL::intersection(triangle_of(triangles[(std::min)(number, other)]),
                                             triangle_of(triangles[(std::max)(number, other)]));
      if(m_facets.size() + cdt.number_of_vertices() > most_facets)
        throw Too_many();
      if(common)
        constrain(*common, view, cdt);
    }
    std::map<Constrained_triangulation::Vertex_handle, std::size_t> indices;
    for(auto v = cdt.finite_vertices_begin(); v != cdt.finite_vertices_end(); ++v)
      indices[v] = index_of(view.lifted(v->point()));
    const bool is_from_behind = view.is_from_behind();
    for(auto f = cdt.finite_faces_begin(); f != cdt.finite_faces_end(); ++f)
      add({indices[f->vertex(0)], indices[f->vertex(is_from_behind ? 2 : 1)],
           indices[f->vertex(is_from_behind ? 1 : 2)]},
          number_in_input);
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_REPAIR_TRIANGLE_ARRANGEMENT_H
