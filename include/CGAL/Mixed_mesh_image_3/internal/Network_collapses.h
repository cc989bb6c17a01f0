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

  struct Candidate
  {
    double cost;
    Index u, v, version;

    bool operator>(const Candidate& other) const
    {
      return std::tie(cost, u, v) > std::tie(other.cost, other.u, other.v);
    }
  };

  enum Kind { ON_SURFACE, ON_CURVE, FIXED };

  Label_network m_network;
  std::vector<std::vector<Index>> m_incident; // triangles of each vertex
  Interface_curves m_curves;
  std::vector<Kind> m_kinds;
  std::vector<Plane_quadric> m_quadrics;
  std::vector<Index> m_version; // of each vertex: grows when the vertex moves
  std::vector<Index> m_merged_into;
  std::vector<Index> m_marks; // of the vertices that a loop has met
  Index m_last_mark = 0;
  std::size_t m_number_of_vertices;
  std::vector<Candidate> m_queue; // a heap, the least first

public:
  /// \param is_fixed whether each vertex stays where it is
  Network_collapses(Label_network network, const std::vector<bool>& is_fixed)
    : m_network(std::move(network)), m_incident(m_network.points.size()),
      m_curves(faces(m_network), m_network.points.size()), m_quadrics(m_network.points.size()),
      m_version(m_network.points.size(), 0), m_marks(m_network.points.size(), 0),
      m_number_of_vertices(m_network.points.size())
  {
    for(Index t = 0; t < m_network.triangles.size(); ++t) {
      const std::array<Index, 3>& v = m_network.triangles[t].vertices;
      Plane_quadric quadric;
      quadric.add(point(v[0]), point(v[1]), point(v[2]));
      for(Index u : v) {
        m_incident[u].push_back(t);
        m_quadrics[u] += quadric;
      }
    }
    for(Index v = 0; v < m_network.points.size(); ++v) {
      m_kinds.push_back(is_fixed[v] || m_curves.is_corner(v) ? FIXED
                        : m_curves.is_on_curve(v)            ? ON_CURVE
                                                             : ON_SURFACE);
      m_merged_into.push_back(v);
    }
  }

  /// Collapses edges until the number of vertices is reached, or no edge can be collapsed.
  void operator()(std::size_t number_of_vertices)
  {
    for(Index v = 0; v < m_incident.size(); ++v)
      for_each_neighbor(v, [&](Index w) {
        if(v < w)
          add_candidate(v, w);
      });
    std::make_heap(m_queue.begin(), m_queue.end(), std::greater<>());
    while(m_number_of_vertices > number_of_vertices && !m_queue.empty()) {
      std::pop_heap(m_queue.begin(), m_queue.end(), std::greater<>());
      const Candidate next = m_queue.back();
      m_queue.pop_back();
      if(m_incident[next.u].empty() || m_incident[next.v].empty()
         || m_version[next.u] + m_version[next.v] != next.version)
        continue; // there is a newer one
      const auto [removed, kept] = roles(next.u, next.v);
      const Vec3 p = place(removed, kept);
      if(keeps_topology(removed, kept) && keeps_sides(removed, kept, p) && keeps_sides(kept, removed, p))
        collapse(removed, kept, p);
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
    for(const Triangle& t : network.triangles)
      result.push_back(
        {Vertex_index(t.vertices[0]), Vertex_index(t.vertices[1]), Vertex_index(t.vertices[2])});
    return result;
  }

  const Vec3& point(Index v) const { return m_network.points[v]; }

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

  Vec3 place(Index removed, Index kept) const
  {
    if(m_kinds[kept] == FIXED || m_kinds[kept] != m_kinds[removed])
      return point(kept);
    return quadric(removed, kept).minimum_near(0.5 * (point(removed) + point(kept)));
  }

  Plane_quadric quadric(Index u, Index v) const
  {
    Plane_quadric sum = m_quadrics[u];
    sum += m_quadrics[v];
    return sum;
  }

  // \return whether there is one
  bool add_candidate(Index u, Index v)
  {
    const auto [removed, kept] = roles(u, v);
    if(m_kinds[removed] == FIXED || (m_kinds[removed] == ON_CURVE && !is_on_common_curve(removed, kept)))
      return false;
    const Plane_quadric sum = quadric(u, v);
    m_queue.push_back(
      {cost_of_collapse(sum, place(removed, kept), point(v) - point(u)), u, v, m_version[u] + m_version[v]});
    return true;
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
  bool has_triangle(Index u, const std::array<Index, 3>& other, Index v) const
  {
    return std::any_of(m_incident[u].begin(), m_incident[u].end(), [&](Index t) {
      const std::array<Index, 3>& w = m_network.triangles[t].vertices;
      return std::all_of(other.begin(), other.end(),
                         [&](Index x) { return x == v || std::find(w.begin(), w.end(), x) != w.end(); });
    });
  }

  // Whether triangles at a vertex that moves, except those at the edge, keep their side and do not become
  // needles.
  bool keeps_sides(Index center, Index other, const Vec3& p) const
  {
    return std::all_of(m_incident[center].begin(), m_incident[center].end(), [&](Index t) {
      std::array<Index, 3> v = m_network.triangles[t].vertices;
      if(std::find(v.begin(), v.end(), other) != v.end())
        return true;
      std::rotate(v.begin(), std::find(v.begin(), v.end(), center), v.end());
      return keeps_side(point(v[0]), p, point(v[1]), point(v[2]));
    });
  }

  void collapse(Index removed, Index kept, const Vec3& p)
  {
    const std::vector<Index> around = std::move(m_incident[removed]);
    m_incident[removed].clear();
    for(Index t : around) {
      std::array<Index, 3>& v = m_network.triangles[t].vertices;
      if(std::find(v.begin(), v.end(), kept) != v.end()) {
        for(Index u : v)
          if(u != removed)
            m_incident[u].erase(std::find(m_incident[u].begin(), m_incident[u].end(), t));
        v = {kept, kept, kept};
      } else {
        std::replace(v.begin(), v.end(), removed, kept);
        m_incident[kept].push_back(t);
      }
    }
    if(m_kinds[removed] == ON_CURVE)
      m_curves.collapse(Vertex_index(removed), Vertex_index(kept));
    m_quadrics[kept] += m_quadrics[removed];
    m_network.points[kept] = p;
    m_version[kept] += m_version[removed] + 1; // more than those of all edges to both vertices
    m_merged_into[removed] = kept;
    --m_number_of_vertices;
    for_each_neighbor(kept, [&](Index w) {
      if(add_candidate((std::min)(w, kept), (std::max)(w, kept)))
        std::push_heap(m_queue.begin(), m_queue.end(), std::greater<>());
    });
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
