// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_IMAGE_3_INTERNAL_NETWORK_COLLAPSES_H
#define CGAL_MIXED_MESH_IMAGE_3_INTERNAL_NETWORK_COLLAPSES_H

#include <CGAL/Mixed_mesh_3/Face.h>
#include <CGAL/Mixed_mesh_3/internal/base/Plane_quadric.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/Interface_curves.h>
#include <CGAL/Mixed_mesh_image_3/internal/Label_network.h>
#include <CGAL/Mixed_mesh_image_3/internal/Quadric_collapses.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
Collapses edges of a network of labels, edges first that move it least from the planes of its triangles: in
rounds, each of which takes at most half of the vertices, in the order of their numbers. Neighbors have near
numbers, so that what a collapse needs is in the cache: a head of 1.7 million vertices takes a third of the
time that a queue of all edges takes, and lies as near to where it was.

The surfaces around labels keep their topology, and so do the curves in which three or more of them meet: the
link condition holds in the network and in its curves (Dey, Edelsbrunner, Guha, Nekhayev: Topology preserving
edge contraction, 1999). Vertices of curves are removed along these only, and vertices at which curves end
stay. No triangle turns over; the caller has to check that triangles that are no neighbors do not cut each
other.
*/
class Network_collapses
{
  using Index = std::uint32_t;
  using Triangle = Label_network::Triangle;
  using Triangle_of_vertices = std::array<Index, 3>;

  // Where the vertex goes that two are merged into.
  enum Place : std::uint8_t { LEAST_COST, AT_VERTEX, AT_END };

  struct Candidate
  {
    double cost;
    Index end;
    Place place;
    Vec3 point;

    bool operator<(const Candidate& other) const
    {
      return std::tie(cost, end, place) < std::tie(other.cost, other.end, other.place);
    }
  };

  enum Kind { ON_SURFACE, ON_CURVE, FIXED };

  // A list of each vertex, all in one array: a list that is to grow is written anew behind all others. Where
  // the array ends, values of lists that are gone are left out. So memory is used that has been used before.
  class Lists
  {
    std::vector<Index> m_values, m_others; // the latter is memory only
    std::vector<std::array<Index, 2>> m_ranges;

  public:
    class List
    {
      Index *m_begin, *m_end;

    public:
      List(Index* begin, Index* end) : m_begin(begin), m_end(end) {}
      Index* begin() const { return m_begin; }
      Index* end() const { return m_end; }
    };

    explicit Lists(std::size_t number) : m_ranges(number, {0, 0}) {}

    void reserve(std::size_t number_of_values) { m_values.reserve(number_of_values); }
    List operator[](std::size_t i)
    {
      return {m_values.data() + m_ranges[i][0], m_values.data() + m_ranges[i][1]};
    }
    /// Begins a list anew: `append()` is for this one then.
    void start(std::size_t i) { m_ranges[i].fill(Index(m_values.size())); }
    void append(std::size_t i, Index value)
    {
      if(m_values.size() == m_values.capacity())
        leave_out_gaps(i);
      m_values.push_back(value);
      ++m_ranges[i][1];
    }
    /// The last value takes the place of one that is removed.
    void remove(std::size_t i, Index* value) { *value = m_values[--m_ranges[i][1]]; }
    void clear(std::size_t i) { m_ranges[i][1] = m_ranges[i][0]; }

  private:
    // \param last list that stays the last one
    void leave_out_gaps(std::size_t last)
    {
      m_others.clear();
      m_others.reserve(m_values.capacity());
      const auto move = [this](std::array<Index, 2>& range) {
        const auto first = Index(m_others.size());
        m_others.insert(m_others.end(), m_values.begin() + range[0], m_values.begin() + range[1]);
        range = {first, Index(m_others.size())};
      };
      for(std::size_t i = 0; i < m_ranges.size(); ++i)
        if(i != last)
          move(m_ranges[i]);
      move(m_ranges[last]);
      m_values.swap(m_others);
      // Half of the memory at least is for new lists: else they would be moved too often.
      m_values.reserve(2 * m_values.size() + 1);
    }
  };

  Label_network m_network;
  CGAL::Bbox_3 m_box; // where vertices may be
  Lists m_incident;   // triangles of each vertex
  Interface_curves m_curves;
  std::vector<Kind> m_kinds;
  std::vector<Plane_quadric> m_quadrics;
  std::vector<double> m_least_costs;      // of the edges of each vertex to others with larger numbers
  std::vector<std::uint8_t> m_is_changed; // vertices whose least cost may be another one
  std::vector<Candidate> m_candidates;    // of one vertex
  std::vector<Index> m_marks;             // of the vertices that a loop has met
  Index m_last_mark = 0;
  std::vector<Index> m_merged_into;
  std::vector<Index> m_around; // triangles around the vertex that is left of an edge
  std::size_t m_number_of_vertices;

  static constexpr double never = std::numeric_limits<double>::infinity();
  // Vertices of which at most one is removed in a round. With four, simplified heads are nearer by 1 %, and
  // take a third more time.
  static constexpr std::size_t vertices_for_one = 2;

public:
  /// \param is_fixed whether each vertex stays where it is
  /// \param box where vertices may move to
  Network_collapses(Label_network network, const std::vector<bool>& is_fixed, const CGAL::Bbox_3& box)
    : m_network(std::move(network)), m_box(box), m_incident(m_network.points.size()),
      m_curves(faces(m_network), m_network.points.size()), m_quadrics(m_network.points.size()),
      m_least_costs(m_network.points.size()), m_is_changed(m_network.points.size(), 1),
      m_marks(m_network.points.size(), 0), m_number_of_vertices(m_network.points.size())
  {
    for(const Triangle& t : m_network.triangles) {
      const Triangle_of_vertices& v = t.vertices;
      Plane_quadric quadric;
      quadric.add(point(v[0]), point(v[1]), point(v[2]));
      for(Index u : v)
        m_quadrics[u] += quadric;
    }
    list_incident_triangles();
    for(Index v = 0; v < m_network.points.size(); ++v)
      m_kinds.push_back(is_fixed[v] || m_curves.is_corner(v) ? FIXED
                        : m_curves.is_on_curve(v)            ? ON_CURVE
                                                             : ON_SURFACE);
    m_merged_into.resize(m_network.points.size());
    std::iota(m_merged_into.begin(), m_merged_into.end(), Index(0));
  }

  /// Collapses edges until the number of vertices is reached, or no edge can be collapsed.
  void operator()(std::size_t number_of_vertices)
  {
    std::vector<double> costs;
    while(m_number_of_vertices > number_of_vertices) {
      costs.clear();
      for(Index v = 0; v < m_least_costs.size(); ++v) {
        if(std::exchange(m_is_changed[v], 0))
          m_least_costs[v] = least_cost(v);
        if(m_least_costs[v] != never)
          costs.push_back(m_least_costs[v]);
      }
      if(costs.empty())
        return;
      const std::size_t most = (std::min)(m_number_of_vertices - number_of_vertices,
                                          m_number_of_vertices / vertices_for_one + 1);
      const auto last = costs.begin() + std::ptrdiff_t((std::min)(most, costs.size()) - 1);
      std::nth_element(costs.begin(), last, costs.end());
      for(Index v = 0; v < m_least_costs.size() && m_number_of_vertices > number_of_vertices; ++v)
        if(m_least_costs[v] <= *last)
          merge(v, *last);
    }
  }

  const Label_network& network() const { return m_network; }
  /// Whether a triangle is left.
  bool is_left(std::size_t triangle) const
  {
    const auto& v = m_network.triangles[triangle].vertices;
    return v[0] != v[1];
  }

  /// The vertex that a vertex was merged into.
  Index merged_into(Index v) const
  {
    while(m_merged_into[v] != v)
      v = m_merged_into[v];
    return v;
  }

private:
  static std::vector<Face_vertices> faces(const Label_network& network)
  {
    std::vector<Face_vertices> result;
    result.reserve(network.triangles.size());
    for(const Triangle& t : network.triangles)
      result.push_back(
        {Vertex_index(t.vertices[0]), Vertex_index(t.vertices[1]), Vertex_index(t.vertices[2])});
    return result;
  }

  const Vec3& point(Index v) const { return m_network.points[v]; }

  static bool has(const Triangle_of_vertices& t, Index v) { return t[0] == v || t[1] == v || t[2] == v; }

  void list_incident_triangles()
  {
    // A list of the corners of each vertex, which is linked: corner i of triangle t has the number 3 t + i.
    constexpr auto none = Index(-1);
    const auto number_of_corners = Index(3 * m_network.triangles.size());
    std::vector<Index> first(m_network.points.size(), none), next(number_of_corners);
    for(Index c = number_of_corners; c-- > 0;)
      next[c] = std::exchange(first[m_network.triangles[c / 3].vertices[c % 3]], c);
    m_incident.reserve(6 * m_network.triangles.size()); // two for each corner
    for(Index v = 0; v < first.size(); ++v) {
      m_incident.start(v);
      for(Index c = first[v]; c != none; c = next[c])
        m_incident.append(v, c / 3);
    }
  }

  // Calls `f` for each neighbor of a vertex, once.
  template <class F>
  void for_each_neighbor(Index v, const F& f)
  {
    const Index mark = ++m_last_mark;
    m_marks[v] = mark;
    for(Index t : m_incident[v])
      for(Index u : m_network.triangles[t].vertices)
        if(std::exchange(m_marks[u], mark) != mark)
          f(u);
  }

  // The vertex that is removed, and the other one.
  std::pair<Index, Index> roles(Index u, Index v) const
  {
    return m_kinds[u] > m_kinds[v] ? std::pair(v, u) : std::pair(u, v);
  }

  bool is_on_common_curve(Index u, Index v) const
  {
    const std::vector<Vertex_index>& ends = m_curves.neighbors(u);
    return std::find(ends.begin(), ends.end(), Vertex_index(v)) != ends.end();
  }

  bool has_choice(Index u, Index v) const { return m_kinds[u] == m_kinds[v]; }

  Candidate candidate(Index u, Index v, Place where) const
  {
    Plane_quadric of_both = m_quadrics[u];
    of_both += m_quadrics[v];
    const Vec3 p = !has_choice(u, v)    ? point(roles(u, v).second)
                   : where == AT_VERTEX ? point(u)
                   : where == AT_END    ? point(v)
                                        : of_both.minimum_near(0.5 * (point(u) + point(v)));
    return {cost_of_collapse(of_both, p, point(v) - point(u)), v, where, p};
  }

  // Whether the kinds of two neighbors allow that they are merged.
  bool are_mergeable(Index u, Index v) const
  {
    const auto [removed, kept] = roles(u, v);
    return m_kinds[removed] != FIXED && (m_kinds[removed] != ON_CURVE || is_on_common_curve(removed, kept));
  }

  // The least cost of the edges to neighbors with larger numbers.
  double least_cost(Index u)
  {
    double least = never;
    for_each_neighbor(u, [&](Index v) {
      if(u < v && are_mergeable(u, v))
        least = (std::min)(least, candidate(u, v, LEAST_COST).cost);
    });
    return least;
  }

  // Merges a vertex with that neighbor with a larger number which costs least, and at most a bound. If there
  // is none, the least cost is that of those beyond the bound.
  void merge(Index u, double bound)
  {
    m_candidates.clear();
    for_each_neighbor(u, [&](Index v) {
      if(u < v && are_mergeable(u, v))
        m_candidates.push_back(candidate(u, v, LEAST_COST));
    });
    std::sort(m_candidates.begin(), m_candidates.end());
    double& least = m_least_costs[u] = never;
    for(const Candidate& c : m_candidates) {
      if(c.cost > bound) {
        least = (std::min)(least, c.cost);
        return;
      }
      const auto [removed, kept] = roles(u, c.end);
      if(!keeps_topology(removed, kept))
        continue;
      if(merge_at(c.point, removed, kept))
        return;
      if(!has_choice(u, c.end))
        continue;
      // Half of the triangles stay as they are if one vertex does. Without these places, slivers keep their
      // vertices, and the surfaces of a head lie four times as far from where they were.
      std::array<Candidate, 2> ends{candidate(u, c.end, AT_VERTEX), candidate(u, c.end, AT_END)};
      std::sort(ends.begin(), ends.end());
      for(const Candidate& end : ends)
        if(end.cost > bound)
          least = (std::min)(least, end.cost);
        else if(merge_at(end.point, removed, kept))
          return;
    }
  }

  bool is_in_box(const Vec3& p) const
  {
    return p[0] >= m_box.xmin() && p[0] <= m_box.xmax() && p[1] >= m_box.ymin() && p[1] <= m_box.ymax()
           && p[2] >= m_box.zmin() && p[2] <= m_box.zmax();
  }

  bool merge_at(const Vec3& p, Index removed, Index kept)
  {
    const bool is_possible = is_in_box(p) && keeps_sides(removed, kept, p) && keeps_sides(kept, removed, p);
    if(is_possible)
      collapse(removed, kept, p);
    return is_possible;
  }

  // The link condition: common neighbors are opposite to the edge in its triangles, no edge is opposite to
  // both vertices, and no curve is closed by three edges.
  bool keeps_topology(Index u, Index v)
  {
    std::size_t number_of_apexes = 0, number_of_common = 0;
    for_each_neighbor(u, [](Index) {});
    const Index of_u = m_last_mark;
    for(Index t : m_incident[v]) {
      const std::array<Index, 3>& w = m_network.triangles[t].vertices;
      const auto is_at_u = [&](Index x) { return x == v || m_marks[x] == of_u; };
      if(std::find(w.begin(), w.end(), u) != w.end())
        ++number_of_apexes;
      else if(std::all_of(w.begin(), w.end(), is_at_u) && has_triangle(u, w, v))
        return false;
    }
    for(Index t : m_incident[v])
      for(Index w : m_network.triangles[t].vertices)
        if(w != u && w != v && m_marks[w] == of_u) {
          m_marks[w] = 0;
          ++number_of_common;
        }
    return number_of_common == number_of_apexes
           && (m_kinds[u] != ON_CURVE || m_curves.is_link(Vertex_index(u), Vertex_index(v)));
  }

  // Whether a vertex has a triangle with the edge opposite to v in another one.
  bool has_triangle(Index u, const std::array<Index, 3>& other, Index v)
  {
    const auto all = m_incident[u];
    return std::any_of(all.begin(), all.end(), [&](Index t) {
      const std::array<Index, 3>& w = m_network.triangles[t].vertices;
      return std::all_of(other.begin(), other.end(),
                         [&](Index x) { return x == v || std::find(w.begin(), w.end(), x) != w.end(); });
    });
  }

  // Whether triangles at a vertex that moves, except those at the edge, keep their side and do not become
  // needles.
  bool keeps_sides(Index center, Index other, const Vec3& p)
  {
    const auto all = m_incident[center];
    return std::all_of(all.begin(), all.end(), [&](Index t) {
      std::array<Index, 3> v = m_network.triangles[t].vertices;
      if(std::find(v.begin(), v.end(), other) != v.end())
        return true;
      std::rotate(v.begin(), std::find(v.begin(), v.end(), center), v.end());
      return keeps_side(point(v[0]), p, point(v[1]), point(v[2]));
    });
  }

  void collapse(Index removed, Index kept, const Vec3& p)
  {
    m_around.clear();
    for(Index t : m_incident[kept])
      if(!has(m_network.triangles[t].vertices, removed))
        m_around.push_back(t);
    for(Index t : m_incident[removed]) {
      Triangle_of_vertices& w = m_network.triangles[t].vertices;
      if(has(w, kept)) {
        for(Index x : w)
          if(x != removed && x != kept) {
            const auto at_apex = m_incident[x];
            m_incident.remove(x, std::find(at_apex.begin(), at_apex.end(), t));
          }
        w = {kept, kept, kept};
      } else {
        std::replace(w.begin(), w.end(), removed, kept);
        m_around.push_back(t);
      }
    }
    m_incident.clear(removed);
    m_incident.start(kept);
    for(Index t : m_around)
      m_incident.append(kept, t);
    if(m_kinds[removed] == ON_CURVE)
      m_curves.collapse(Vertex_index(removed), Vertex_index(kept));
    m_quadrics[kept] += m_quadrics[removed];
    m_network.points[kept] = p;
    m_merged_into[removed] = kept;
    --m_number_of_vertices;
    m_least_costs[removed] = never;
    m_is_changed[removed] = 0;
    m_is_changed[kept] = 1;
    for_each_neighbor(kept, [&](Index w) { m_is_changed[w] = 1; });
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_INTERNAL_NETWORK_COLLAPSES_H
