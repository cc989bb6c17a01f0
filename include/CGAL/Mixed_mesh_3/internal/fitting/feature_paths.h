// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Paths of edges of the boundary that shall become the sharp edges of the surface.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_FEATURE_PATHS_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_FEATURE_PATHS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Strata.h>
#include <CGAL/Mixed_mesh_3/internal/moves/bisect_edge.h>
#include <CGAL/Mixed_mesh_3/internal/surface/Sharp_features.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <queue>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
Each corner takes the boundary vertex that will be nearest, and each polyline, the longest first, takes the
shortest path between the vertices of its ends, where the length of an edge counts the more, the farther the
edge is from the polyline. Paths have no vertex in common but at corners, and no edge joins two vertices of a
path past a vertex between them: such an edge would fold on the polyline. A path may lead through the middle
of an edge too, which is bisected then. With several subdomains, corners and paths lie between the same
subdomains as the corners and sharp edges of the surface.

Where a path leads past a corner on the wrong side, another polyline does not reach the corner: then the path
gives way to that of the other polyline, and is chosen anew, as wires of a circuit are (rip-up and reroute).

Vertices of paths get the strata of their polylines and corners, edges are noted in
`Working_mesh::sharp_edges`.
*/
template <class Quality>
class Feature_paths
{
  using Edge = Working_mesh::Edge;
  using Node = Edge; // a vertex, twice, or an edge for its middle

  // A vertex of the path of a polyline: the arc length at which it will be, and its future place before.
  struct Path_vertex
  {
    Vertex_index vertex;
    double length;
    Vec3 place_before;
  };
  using Path = std::vector<Path_vertex>;

  // The triangles at an edge: their apexes and strata.
  struct Edge_star
  {
    boost::container::small_vector<std::pair<Vertex_index, Stratum>, 2> triangles;
    Stratum stratum = free_stratum; // what the strata have in common
  };

  Working_mesh& m_mesh;
  const Quality& m_quality;
  const Sharp_features& m_features;
  Strata& m_strata;
  const double m_worst;
  std::size_t m_bisections_left;
  std::vector<Vec3> m_places; // future places of boundary vertices
  std::vector<double> m_sizes;
  std::vector<std::uint8_t> m_is_free;
  std::vector<std::vector<Vertex_index>> m_neighbors; // neighbors on the boundary
  std::map<Edge, Edge_star> m_stars;
  std::set<Edge> m_whole;              // edges that can not be bisected
  std::vector<Vertex_index> m_corners; // vertex of each corner, or none
  std::vector<Path> m_paths;           // of each polyline; empty if it has none
  std::vector<Edge> m_bisected;
  Stratum m_stratum = free_stratum; // of the polyline whose path is chosen

  // Weights of the length of edges: edges as far from the polyline as they are long count about
  // `distance_weight` times as much, and middles count more than vertices. Limits in sizes: farther away
  // there is no path, and no corner takes a vertex. Of a part, a gear and a slot of 2,000 vertices, the slot
  // keeps less of its sharp edges with half or twice the weight, 0.973 and 0.979 instead of 0.984. With half
  // of the factor, which prefers middles, the part keeps 0.37; with twice as much, distances are larger by 5
  // to 10 %. Half or twice as many trials are the same. Of 38 surfaces, with half of the reach a star with
  // spikes keeps 0.929 instead of 0.994, with twice as much two boxes 0.938 instead of 0.968; with half of
  // the reach of corners, a blade keeps 0.44 instead of 0.88.
  static constexpr double distance_weight = 8, bisection_factor = 1.8, reach = 5, reach_of_corners = 8;
  static constexpr int trials = 20;

public:
  /// \param strata,boundary strata and faces of the boundary and of interfaces
  /// \param places future places of all vertices
  /// \param is_blocked whether paths must not use a vertex
  /// \param worst largest cost of halves of bisected tetrahedra
  Feature_paths(Working_mesh& mesh, const Quality& quality, const Sharp_features& features, Strata& strata,
                const Interface_faces& boundary, std::vector<Vec3> places,
                const std::vector<std::uint8_t>& is_blocked, double worst, std::size_t bisections)
    : m_mesh(mesh), m_quality(quality), m_features(features), m_strata(strata), m_worst(worst),
      m_bisections_left(bisections), m_places(std::move(places)), m_sizes(mesh.points.size(), 0),
      m_is_free(mesh.points.size(), 0), m_neighbors(mesh.points.size()),
      m_corners(features.corners().size(), no_vertex), m_paths(features.polylines().size())
  {
    for(std::size_t f = 0; f < boundary.faces.size(); ++f) {
      const Face_vertices& v = boundary.faces[f].vertices();
      for(int i = 0; i < v.size(); ++i) {
        const Vertex_index a = v[i], b = v[(i + 1) % v.size()];
        m_is_free[a] = !is_blocked[a];
        m_neighbors[a].push_back(b);
        m_neighbors[b].push_back(a);
        add_triangle(edge(a, b), v[(i + 2) % v.size()], boundary.strata[f]);
        if(v.size() != 3)
          m_whole.insert(edge(a, b));
      }
    }
    for(Vertex_index v = 0; v < m_neighbors.size(); ++v) {
      std::sort(m_neighbors[v].begin(), m_neighbors[v].end());
      m_neighbors[v].erase(std::unique(m_neighbors[v].begin(), m_neighbors[v].end()), m_neighbors[v].end());
      for(Vertex_index u : m_neighbors[v])
        m_sizes[v] += norm(m_mesh.points[u] - m_mesh.points[v]) / double(m_neighbors[v].size());
    }
  }

  void operator()()
  {
    take_corners();
    const std::vector<Feature_polyline>& polylines = m_features.polylines();
    std::vector<std::size_t> order(polylines.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
      return polylines[i].length() > polylines[j].length();
    });
    for(std::size_t i : order)
      choose_path(i);
    for(std::size_t i : order)
      if(m_paths[i].empty())
        choose_path_across_others(i);
    cut_short_cuts();
  }

  /// Edges that were bisected, in the order of their middles, which are the last vertices.
  const std::vector<Edge>& bisected() const { return m_bisected; }
  /// Future places of the vertices; the vertices of paths are in order.
  const std::vector<Vec3>& places() const { return m_places; }

private:
  static Edge edge(Vertex_index a, Vertex_index b) { return std::minmax(a, b); }
  static bool is_vertex(const Node& n) { return n.first == n.second; }

  Vec3 place(const Node& n) const { return 0.5 * (m_places[n.first] + m_places[n.second]); }
  double size(const Node& n) const { return 0.5 * (m_sizes[n.first] + m_sizes[n.second]); }

  Stratum stratum_of(const Edge& e) const { return m_stars.at(e).stratum; }

  void add_triangle(const Edge& e, Vertex_index apex, Stratum stratum)
  {
    Edge_star& star = m_stars[e];
    star.triangles.emplace_back(apex, stratum);
    star.stratum = star.stratum == free_stratum ? stratum : m_strata.meet(star.stratum, stratum);
  }

  void take_corners()
  {
    const std::vector<Vec3>& corners = m_features.corners();
    std::vector<std::size_t> degrees(corners.size(), 0);
    for(const Feature_polyline& p : m_features.polylines())
      for(std::size_t c : p.corners)
        ++degrees[c];
    std::vector<Stratum> strata;
    for(std::size_t c = 0; c < corners.size(); ++c)
      strata.push_back(m_strata.of_subdomains(m_features.subdomains(m_features.polylines().size() + c)));
    std::vector<std::tuple<double, std::size_t, Vertex_index>> pairs;
    for(Vertex_index v = 0; v < m_neighbors.size(); ++v)
      if(m_is_free[v])
        for(std::size_t c = 0; c < corners.size(); ++c) {
          if(m_mesh.strata[v] != strata[c])
            continue;
          // Several vertices may have the same place.
          const double d = norm(m_places[v] - corners[c]) + 0.1 * norm(m_mesh.points[v] - corners[c]);
          if(d < reach_of_corners * m_sizes[v] && m_neighbors[v].size() >= degrees[c])
            pairs.emplace_back(d, c, v);
        }
    std::sort(pairs.begin(), pairs.end());
    for(const auto& [d, c, v] : pairs)
      if(m_is_free[v] && m_corners[c] == no_vertex) {
        m_corners[c] = v;
        take(v, Stratum(first_sharp_stratum + m_features.polylines().size() + c), corners[c]);
      }
  }

  void take(Vertex_index v, Stratum stratum, const Vec3& where)
  {
    m_is_free[v] = 0;
    m_mesh.strata[v] = stratum;
    m_places[v] = where;
  }

  Stratum stratum_of_polyline(std::size_t number) const
  {
    return m_strata.of_subdomains(m_features.subdomains(number));
  }

  // The polyline whose path an edge or a vertex is of, but for corners.
  std::optional<std::size_t> polyline_of(const Node& n) const
  {
    const Stratum s = is_vertex(n) ? m_mesh.strata[n.first] : m_mesh.sharp_stratum(n.first, n.second);
    const std::size_t number = std::size_t(s) - std::size_t(first_sharp_stratum);
    return s >= first_sharp_stratum && number < m_paths.size() ? std::optional(number) : std::nullopt;
  }

  // Chooses a path that crosses no others. \return whether there is one
  bool choose_path(std::size_t number)
  {
    const Feature_polyline& polyline = m_features.polylines()[number];
    m_stratum = stratum_of_polyline(number);
    for(int trial = 0; trial < trials; ++trial) {
      std::vector<Node> nodes = shortest_path(number);
      if(nodes.empty())
        return false;
      if(!bisect(nodes))
        continue;
      nodes = without_short_cuts(nodes, polyline);
      std::vector<double> lengths = ascending_lengths(nodes, polyline);
      take_turns(polyline, lengths);
      Path path;
      for(std::size_t i = 0; i < nodes.size(); ++i)
        path.push_back({nodes[i].first, lengths[i], m_places[nodes[i].first]});
      lay(number, std::move(path));
      return true;
    }
    return false;
  }

  // Chooses a path in whose way others are. If not all of these get new paths, none is changed.
  void choose_path_across_others(std::size_t number)
  {
    std::map<std::size_t, Path> before{{number, {}}};
    if(reroute(number, before))
      return;
    for(const auto& [changed, path] : before)
      lift(changed);
    for(const auto& [changed, path] : before)
      lay(changed, with_middles(path));
  }

  // \param before the paths before of the polylines that are rerouted: others must not cross these again
  // \return whether all have paths
  bool reroute(std::size_t number, std::map<std::size_t, Path>& before)
  {
    if(choose_path(number))
      return true;
    std::vector<std::size_t> others;
    for(const Node& n : shortest_path(number, &before))
      if(const std::optional<std::size_t> other = polyline_of(n))
        if(before.emplace(*other, m_paths[*other]).second)
          others.push_back(*other);
    if(others.empty())
      return false;
    for(std::size_t other : others)
      lift(other);
    return choose_path(number) && std::all_of(others.begin(), others.end(), [&](std::size_t other) {
             return reroute(other, before);
           });
  }

  void lay(std::size_t number, Path path)
  {
    const Stratum stratum = Stratum(first_sharp_stratum + number);
    for(std::size_t i = 0; i + 1 < path.size(); ++i) {
      m_mesh.sharp_edges[edge(path[i].vertex, path[i + 1].vertex)] = stratum;
      if(i > 0)
        take(path[i].vertex, stratum, m_features.polylines()[number].at(path[i].length));
    }
    m_paths[number] = std::move(path);
  }

  // Takes a path away.
  void lift(std::size_t number)
  {
    const Path path = std::exchange(m_paths[number], {});
    for(std::size_t i = 0; i + 1 < path.size(); ++i) {
      m_mesh.sharp_edges.erase(edge(path[i].vertex, path[i + 1].vertex));
      if(i > 0) {
        take(path[i].vertex, stratum_of_polyline(number), path[i].place_before);
        m_is_free[path[i].vertex] = 1;
      }
    }
  }

  // A path with the middles of its edges that have been bisected.
  Path with_middles(const Path& path) const
  {
    if(path.empty())
      return {};
    const Vertex_index first_middle = Vertex_index(m_mesh.points.size() - m_bisected.size());
    Path result{path.front()};
    for(std::size_t i = 1; i < path.size(); ++i) {
      Path rest{path[i]};
      while(!rest.empty()) {
        const Path_vertex &a = result.back(), &b = rest.back();
        const auto found = std::find(m_bisected.begin(), m_bisected.end(), edge(a.vertex, b.vertex));
        if(found == m_bisected.end()) {
          result.push_back(b);
          rest.pop_back();
        } else {
          const Vertex_index middle = Vertex_index(first_middle + (found - m_bisected.begin()));
          rest.push_back({middle, 0.5 * (a.length + b.length), m_places[middle]});
        }
      }
    }
    return result;
  }

  // Visits vertices and middles of edges that are joined by an edge of the stratum in force, or would be
  // after bisections.
  // \param is_across whether across paths too
  template <class Visit>
  void for_each_neighbor(const Node& n, bool is_across, const Visit& visit) const
  {
    const auto middle = [&](Vertex_index a, Vertex_index b) {
      // The edge may be a diagonal of a quadrilateral.
      const auto star = m_stars.find(edge(a, b));
      if(m_bisections_left > 0 && star != m_stars.end() && star->second.stratum == m_stratum
         && m_whole.count(edge(a, b)) == 0 && (is_across || !m_mesh.is_sharp(a, b)))
        visit(edge(a, b));
    };
    if(is_vertex(n)) {
      for(Vertex_index u : m_neighbors[n.first]) {
        const Edge_star& star = m_stars.at(edge(n.first, u));
        if(star.stratum == m_stratum)
          visit({u, u});
        for(const auto& [w, stratum] : star.triangles)
          if(w > u && stratum == m_stratum) // each pair once
            middle(u, w);
      }
    } else {
      for(const auto& [w, stratum] : m_stars.at(n).triangles) {
        visit({w, w});
        middle(n.first, w);
        middle(n.second, w);
      }
    }
  }

  // The shortest path of a polyline; empty if there is none.
  // \param kept paths that it must not cross; each vertex and edge of another path counts as much as the
  // length of its polyline, which is at stake; null: it must not cross any
  std::vector<Node> shortest_path(std::size_t number, const std::map<std::size_t, Path>* kept = nullptr) const
  {
    const Feature_polyline& polyline = m_features.polylines()[number];
    const Vertex_index first = m_corners[polyline.corners[0]], last = m_corners[polyline.corners[1]];
    if(first == no_vertex || last == no_vertex)
      return {};
    struct State
    {
      double cost = std::numeric_limits<double>::infinity();
      double distance = 0; // distance from the polyline
      double length = 0;   // arc length of the closest point
      Node from;
    };
    std::map<Node, State> states;
    const Node start{first, first}, end{last, last};
    const auto locate = [&](const Node& n, State& state) {
      const Vec3 p = place(n);
      const Feature_polyline::Position closest = polyline.closest(p);
      state.distance = norm(p - closest.point);
      state.length = n == end ? polyline.length() : closest.length;
    };
    using Entry = std::pair<double, Node>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
    states[start].cost = 0;
    queue.emplace(0, start);
    while(!queue.empty()) {
      const double cost = queue.top().first;
      const Node n = queue.top().second;
      queue.pop();
      const State state = states.at(n);
      if(cost > state.cost)
        continue;
      if(n == end)
        break;
      for_each_neighbor(n, kept != nullptr, [&](const Node& m) {
        const std::optional<std::size_t> other = kept != nullptr ? polyline_of(m) : std::nullopt;
        if(other ? kept->count(*other) > 0 || stratum_of_polyline(*other) != m_stratum
                 : is_vertex(m) && m != end && (!m_is_free[m.first] || m_mesh.strata[m.first] != m_stratum))
          return;
        if(m == end && n == start && m_mesh.is_sharp(first, last))
          return; // an edge of another polyline between the same corners
        const auto [found, is_new] = states.try_emplace(m);
        State& next = found->second;
        if(is_new)
          locate(m, next);
        const double h = size(m);
        if(next.distance > reach * h)
          return;
        const Vec3 a = place(n), b = place(m), middle = 0.5 * (a + b);
        const double off = norm(middle - polyline.closest(middle).point);
        const double squares = state.distance * state.distance + next.distance * next.distance
                               + 2 * off * off;
        // A step to another arm of the polyline leaves out what is between.
        const double length = (std::max)(norm(b - a), std::abs(next.length - state.length)) + 0.05 * h;
        const double c = cost
                         + length * (1 + distance_weight * squares / (4 * h * h))
                             * (is_vertex(m) ? 1 : bisection_factor)
                         + (other ? m_features.polylines()[*other].length() : 0);
        if(c < next.cost) {
          next.cost = c;
          next.from = n;
          queue.emplace(c, m);
        }
      });
    }
    const auto arrived = states.find(end);
    if(arrived == states.end() || !(arrived->second.cost < std::numeric_limits<double>::infinity()))
      return {};
    std::vector<Node> path{end};
    while(path.back() != start)
      path.push_back(states.at(path.back()).from);
    std::reverse(path.begin(), path.end());
    return path;
  }

  // Bisects the edges of a path. \return whether all middles are vertices now
  bool bisect(std::vector<Node>& path)
  {
    for(Node& n : path) {
      if(is_vertex(n))
        continue;
      const auto [a, b] = n;
      const Vec3 middle = 0.5 * (m_mesh.points[a] + m_mesh.points[b]);
      const Vec3 where = place(n);
      if(m_bisections_left == 0 || !bisect_edge(m_mesh, m_quality, a, b, middle, stratum_of(n), m_worst)) {
        m_whole.insert(n);
        return false;
      }
      --m_bisections_left;
      m_bisected.push_back(n);
      const Vertex_index v = Vertex_index(m_mesh.points.size() - 1);
      m_places.push_back(where);
      m_sizes.push_back(size(n));
      m_is_free.push_back(1);
      update(a, b, v);
      n = {v, v};
    }
    return true;
  }

  void update(Vertex_index a, Vertex_index b, Vertex_index middle)
  {
    const Edge_star old = m_stars.at(edge(a, b));
    m_stars.erase(edge(a, b));
    m_stars[edge(a, middle)] = m_stars[edge(b, middle)] = old;
    const auto replace = [](auto& vertices, Vertex_index from, Vertex_index to) {
      std::replace(vertices.begin(), vertices.end(), from, to);
    };
    const auto replace_apex = [&](const Edge& e, Vertex_index from) {
      for(auto& triangle : m_stars.at(e).triangles)
        if(triangle.first == from)
          triangle.first = middle;
    };
    replace(m_neighbors[a], b, middle);
    replace(m_neighbors[b], a, middle);
    m_neighbors.push_back({a, b});
    for(const auto& [c, stratum] : old.triangles) {
      add_triangle(edge(c, middle), a, stratum);
      add_triangle(edge(c, middle), b, stratum);
      replace_apex(edge(c, a), b);
      replace_apex(edge(c, b), a);
      m_neighbors[c].push_back(middle);
      m_neighbors[middle].push_back(c);
    }
  }

  // Bisects the third edge of triangles with two sharp edges that continue each other nearly straight: the
  // triangle would be a needle; the new vertex is free to move away.
  void cut_short_cuts()
  {
    constexpr double straight = -0.5; // cosine of the angle between the two edges
    std::vector<Edge> short_cuts;
    for(const auto& [e, star] : m_stars)
      for(const auto& [c, stratum] : star.triangles) {
        const auto [a, b] = e;
        if(m_mesh.is_sharp(a, b) || !m_mesh.is_sharp(a, c) || !m_mesh.is_sharp(b, c))
          continue;
        const Vec3 to_a = m_places[a] - m_places[c], to_b = m_places[b] - m_places[c];
        if(dot(to_a, to_b) < straight * norm(to_a) * norm(to_b))
          short_cuts.push_back(e);
      }
    for(const Edge& e : short_cuts)
      if(m_whole.count(e) == 0 && m_stars.count(e) > 0) {
        std::vector<Node> nodes{e};
        bisect(nodes);
      }
  }

  bool are_neighbors(Vertex_index a, Vertex_index b) const
  {
    return std::find(m_neighbors[a].begin(), m_neighbors[a].end(), b) != m_neighbors[a].end();
  }

  // Removes short cuts: goes as far as possible at a time, unless the polyline takes a longer way.
  std::vector<Node> without_short_cuts(const std::vector<Node>& path, const Feature_polyline& polyline) const
  {
    // With half of it, a slot of 2,000 vertices keeps 0.971 of its sharp edges instead of 0.984, with twice
    // as much it is the same.
    constexpr double longer_way = 1.5;
    std::vector<Node> result{path.front()};
    for(std::size_t i = 0; i + 1 < path.size();) {
      std::size_t j = path.size() - 1;
      for(; j > i + 1; --j) {
        const Vec3 &a = m_places[path[i].first], &b = m_places[path[j].first];
        if(are_neighbors(path[i].first, path[j].first)
           && stratum_of(edge(path[i].first, path[j].first)) == m_stratum
           && !m_mesh.is_sharp(path[i].first, path[j].first)
           && std::abs(position(path, j, polyline) - position(path, i, polyline)) < longer_way * norm(b - a))
          break;
      }
      result.push_back(path[j]);
      i = j;
    }
    return result;
  }

  double position(const std::vector<Node>& path, std::size_t i, const Feature_polyline& polyline) const
  {
    return i == 0                 ? 0
           : i + 1 == path.size() ? polyline.length()
                                  : polyline.closest(m_places[path[i].first]).length;
  }

  // Each vertex of the polyline where it turns takes the vertex of the path that is nearest to it, as an edge
  // past it would cut it off.
  static void take_turns(const Feature_polyline& polyline, std::vector<double>& lengths)
  {
    // Cosine of 5 degrees: an edge past such a turn is off by a fiftieth of its length.
    constexpr double least_turn = 0.996;
    constexpr double reach = 0.6; // share of the distance of a neighbor on the path
    std::size_t first = 1;
    for(double turn : polyline.turns(least_turn)) {
      while(first + 1 < lengths.size() && lengths[first] < turn
            && std::abs(lengths[first + 1] - turn) < std::abs(lengths[first] - turn))
        ++first;
      if(first + 1 >= lengths.size())
        return;
      const double before = lengths[first - 1], after = lengths[first + 1], old = lengths[first];
      if(before < turn && turn < after && turn - old < reach * (after - old)
         && old - turn < reach * (old - before)) {
        lengths[first] = turn;
        ++first;
      }
      if(first + 1 >= lengths.size())
        return;
    }
  }

  // Arc lengths of the closest points, moved apart until they are in order. With half of the least share, a
  // part and a slot of 2,000 vertices keep 0.003 and 0.005 less of their sharp edges; with twice as much, a
  // gear keeps 0.007 less, and the worst aspect-ratio coefficient of the part is 3.0 instead of 2.4.
  std::vector<double> ascending_lengths(const std::vector<Node>& path, const Feature_polyline& polyline) const
  {
    constexpr int rounds = 100;
    constexpr double least_share = 0.4;
    std::vector<double> lengths;
    for(std::size_t i = 0; i < path.size(); ++i)
      lengths.push_back(position(path, i, polyline));
    const double least = least_share * polyline.length() / double(path.size() - 1);
    for(int round = 0; round < rounds; ++round)
      for(std::size_t i = 1; i + 1 < path.size(); ++i)
        if((std::min)(lengths[i] - lengths[i - 1], lengths[i + 1] - lengths[i]) < least)
          lengths[i] = 0.5 * (lengths[i - 1] + lengths[i + 1]);
    for(std::size_t i = 1; i < path.size(); ++i)
      if(!(lengths[i] > lengths[i - 1])) {
        for(std::size_t j = 0; j < path.size(); ++j)
          lengths[j] = polyline.length() * double(j) / double(path.size() - 1);
        break;
      }
    return lengths;
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_FEATURE_PATHS_H
