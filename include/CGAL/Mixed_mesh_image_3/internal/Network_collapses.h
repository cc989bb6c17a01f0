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
#include <CGAL/Mixed_mesh_3/internal/surface/self_intersections.h>
#include <CGAL/Mixed_mesh_image_3/internal/Label_network.h>
#include <CGAL/Mixed_mesh_image_3/internal/Quadric_collapses.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
Collapses edges of a network of labels, edges first that move it least from the planes of its triangles.

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
    bool has_other; // one at the other end of the edge, which costs more

    bool operator<(const Candidate& other) const
    {
      return std::tie(cost, end, place) < std::tie(other.cost, other.end, other.place);
    }
  };

  struct Entry
  {
    double cost;
    Index vertex, time; // of the last move of the vertex

    bool operator>(const Entry& other) const
    {
      return std::tie(cost, vertex) > std::tie(other.cost, other.vertex);
    }
  };

  enum Kind { ON_SURFACE, ON_CURVE, FIXED };

  // A list of each vertex, all in one array: a list that is to grow is written anew behind all others. Where
  // the array ends, values of lists that are gone are left out. So memory is used that has been used before.
  template <class T>
  class Lists
  {
    std::vector<T> m_values, m_others; // the latter is memory only
    std::vector<std::array<Index, 2>> m_ranges;

  public:
    class List
    {
      T *m_begin, *m_end;

    public:
      List(T* begin, T* end) : m_begin(begin), m_end(end) {}
      T* begin() const { return m_begin; }
      T* end() const { return m_end; }
      bool empty() const { return m_begin == m_end; }
    };

    explicit Lists(std::size_t number) : m_ranges(number, {0, 0}) {}

    void reserve(std::size_t number_of_values) { m_values.reserve(number_of_values); }
    bool is_empty(std::size_t i) const { return m_ranges[i][0] == m_ranges[i][1]; }
    List operator[](std::size_t i)
    {
      return {m_values.data() + m_ranges[i][0], m_values.data() + m_ranges[i][1]};
    }
    /// Begins a list anew: `append()` is for this one then.
    void start(std::size_t i) { m_ranges[i].fill(Index(m_values.size())); }
    void append(std::size_t i, const T& value)
    {
      if(m_values.size() == m_values.capacity())
        leave_out_gaps(i);
      m_values.push_back(value);
      ++m_ranges[i][1];
    }
    /// The last value takes the place of one that is removed.
    void remove(std::size_t i, T* value) { *value = m_values[--m_ranges[i][1]]; }
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
  Lists<Index> m_incident; // triangles of each vertex
  Interface_curves m_curves;
  std::vector<Kind> m_kinds;
  std::vector<Plane_quadric> m_quadrics;
  // Edges to be collapsed, each at that end which has moved later: so a collapse brings one entry of the
  // queue for all edges at a vertex, and makes all others of them void. The least one is the first.
  Lists<Candidate> m_candidates;
  std::vector<Index> m_moved; // time at which each vertex has moved, a number of collapses
  Index m_time = 0;
  std::vector<Index> m_marks; // of the vertices that a loop has met
  Index m_last_mark = 0;
  std::vector<Index> m_merged_into;
  std::vector<Index> m_around; // triangles around the vertex that is left of an edge
  std::size_t m_number_of_vertices;
  using Queue = std::priority_queue<Entry, std::vector<Entry>, std::greater<>>;
  Queue m_queue; // least cost of each vertex

public:
  /// \param is_fixed whether each vertex stays where it is
  Network_collapses(Label_network network, const std::vector<bool>& is_fixed)
    : m_network(std::move(network)), m_incident(m_network.points.size()),
      m_curves(faces(m_network), m_network.points.size()), m_quadrics(m_network.points.size()),
      m_candidates(m_network.points.size()), m_moved(m_network.points.size(), 0),
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
    m_candidates.reserve(3 * m_network.triangles.size()); // two for each edge
    std::vector<Entry> entries;
    for(Index v = 0; v < m_network.points.size(); ++v) {
      m_candidates.start(v);
      for_each_neighbor(v, [&](Index w) {
        if(v < w)
          add_candidate(v, w);
      });
      if(!m_candidates.is_empty(v))
        entries.push_back(least_of(v));
    }
    m_queue = Queue(std::greater<>(), std::move(entries));
  }

  /// Collapses edges until the number of vertices is reached, or no edge can be collapsed.
  void operator()(std::size_t number_of_vertices)
  {
    while(m_number_of_vertices > number_of_vertices && !m_queue.empty()) {
      const Entry next = m_queue.top();
      m_queue.pop();
      const Index u = next.vertex;
      if(m_incident.is_empty(u) || m_moved[u] != next.time)
        continue;
      Candidate* const candidate = m_candidates[u].begin();
      const Index v = candidate->end;
      if(m_incident.is_empty(v) || m_moved[v] > m_moved[u]) {
        m_candidates.remove(u, candidate);
      } else {
        const auto [removed, kept] = roles(u, v);
        const Vec3 p = place(u, v, quadric(u, v), candidate->place);
        const bool may_be_merged = keeps_topology(removed, kept);
        if(may_be_merged && keeps_sides(removed, kept, p) && keeps_sides(kept, removed, p)) {
          collapse(removed, kept, p);
          continue;
        }
        // Half of the triangles stay as they are if one vertex does. Without these places, slivers keep their
        // vertices, and the surfaces of a head lie four times as far from where they were.
        if(candidate->has_other)
          *candidate = at(u, v, candidate->place == AT_VERTEX ? AT_END : AT_VERTEX);
        else if(may_be_merged && candidate->place == LEAST_COST && has_choice(u, v))
          *candidate = at_an_end(u, v);
        else
          m_candidates.remove(u, candidate);
      }
      if(!m_candidates.is_empty(u))
        m_queue.push(least_of(u));
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

  Vec3 place(Index u, Index v, const Plane_quadric& of_both, Place place) const
  {
    if(!has_choice(u, v))
      return point(roles(u, v).second);
    return place == AT_VERTEX ? point(u)
           : place == AT_END  ? point(v)
                              : of_both.minimum_near(0.5 * (point(u) + point(v)));
  }

  Plane_quadric quadric(Index u, Index v) const
  {
    Plane_quadric sum = m_quadrics[u];
    sum += m_quadrics[v];
    return sum;
  }

  Candidate at(Index u, Index v, Place where) const
  {
    const Plane_quadric of_both = quadric(u, v);
    return {cost_of_collapse(of_both, place(u, v, of_both, where), point(v) - point(u)), v, where, false};
  }

  // That of the ends which costs less.
  Candidate at_an_end(Index u, Index v) const
  {
    const Candidate here = at(u, v, AT_VERTEX), there = at(u, v, AT_END);
    Candidate result = there < here ? there : here;
    result.has_other = true;
    return result;
  }

  void add_candidate(Index u, Index v)
  {
    const auto [removed, kept] = roles(u, v);
    if(m_kinds[removed] != FIXED && (m_kinds[removed] != ON_CURVE || is_on_common_curve(removed, kept)))
      m_candidates.append(u, at(u, v, LEAST_COST));
  }

  // Makes the least candidate the first one. \pre there is one
  Entry least_of(Index v)
  {
    const auto all = m_candidates[v];
    std::iter_swap(all.begin(), std::min_element(all.begin(), all.end()));
    return {all.begin()->cost, v, m_moved[v]};
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
    m_moved[kept] = ++m_time;
    m_candidates.clear(removed);
    m_candidates.start(kept);
    for_each_neighbor(kept, [&](Index w) { add_candidate(kept, w); });
    if(!m_candidates.is_empty(kept))
      m_queue.push(least_of(kept));
  }
};

/// Simplifies a network to about a number of vertices, in steps. Where triangles would cut each other,
/// vertices stay as they are; a step that this does not help is not taken.
inline Label_network simplified(Label_network network, std::size_t number_of_vertices, unsigned threads)
{
  constexpr int most_attempts = 8;
  constexpr std::size_t factor = 4; // between steps: an attempt repeats only one of them
  constexpr auto none = std::uint32_t(-1);
  std::size_t next = number_of_vertices;
  while(factor * next < network.points.size())
    next *= factor;
  std::vector<bool> is_fixed(network.points.size(), false);
  for(int attempt = 0; next >= number_of_vertices && next < network.points.size();) {
    const auto number_of_fixed = std::size_t(std::count(is_fixed.begin(), is_fixed.end(), true));
    Network_collapses collapses(network, is_fixed);
    collapses(next + number_of_fixed);
    Label_network result;
    std::vector<std::uint32_t> numbers(network.points.size(), none), origins;
    std::vector<std::array<Vertex_index, 3>> triangles;
    for(std::size_t t = 0; t < network.triangles.size(); ++t) {
      if(!collapses.is_left(t))
        continue;
      Label_network::Triangle triangle = collapses.network().triangles[t];
      for(std::uint32_t& v : triangle.vertices) {
        const std::uint32_t origin = v;
        if(numbers[origin] == none) {
          numbers[origin] = std::uint32_t(origins.size());
          origins.push_back(origin);
          result.points.push_back(collapses.network().points[origin]);
        }
        v = numbers[origin];
      }
      result.triangles.push_back(triangle);
      const auto& v = triangle.vertices;
      triangles.push_back({Vertex_index(v[0]), Vertex_index(v[1]), Vertex_index(v[2])});
    }
    const std::vector<Vertex_index> cuts = vertices_of_self_intersections(result.points, triangles, threads);
    if(cuts.empty()) {
      std::vector<bool> is_still_fixed;
      for(std::uint32_t origin : origins)
        is_still_fixed.push_back(is_fixed[origin]);
      is_fixed = std::move(is_still_fixed);
      network = std::move(result);
      next /= factor;
      attempt = 0;
      continue;
    }
    if(++attempt == most_attempts)
      break;
    std::vector<bool> is_cut(network.points.size(), false);
    for(Vertex_index v : cuts)
      is_cut[origins[v]] = true;
    for(std::uint32_t v = 0; v < network.points.size(); ++v)
      is_fixed[v] = is_fixed[v] || is_cut[collapses.merged_into(v)];
  }
  return network;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_INTERNAL_NETWORK_COLLAPSES_H
