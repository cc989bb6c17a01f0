// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From the octree to tetrahedra that are cut where edges lead from one subdomain to another: vertices of
// interfaces are on their surfaces, and a layer may be thinner than a cell.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_CUT_BY_INTERFACES_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_CUT_BY_INTERFACES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Aspect_ratio_quality_3.h>
#include <CGAL/Mixed_mesh_3/Element_attributes.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/interfaces.h>
#include <CGAL/Mixed_mesh_3/internal/base/Core_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/base/labeled_domain.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/boundary/split_by_order.h>
#include <CGAL/Mixed_mesh_3/internal/elements/manifold_defects.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Working_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/moves/bisect_edge.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Located_octree.h>
#include <CGAL/Mixed_mesh_3/internal/transitions/Lattice_mesh.h>

#include <CGAL/assertions.h>
#include <CGAL/enum.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
Cuts the elements of a lattice along the interfaces of subdomains. All are tetrahedra, but hexahedra that are
to stay, beside no surface, and pyramids and others between these.

A subdomain that an edge passes, between others, first gets a vertex there: so a layer keeps its own vertices
if it is a quarter as thick as a cell, or more. Then a vertex that is near to an interface, beside the length
of its edges, is moved there (as in isosurface stuffing: Labelle, Shewchuk, 2007), and each edge whose ends
are in different subdomains is bisected where it crosses the interface (as in lattice cleaving: Bronson,
Levine, Whitaker, 2014). Bisections keep the mesh conforming, whatever subdomains meet, and at the end no
element has vertices inside different subdomains.
*/
class Interface_cutter
{
  using Edge = Working_mesh::Edge;

  struct Cut
  {
    std::array<Vertex_index, 2> ends;
    Vec3 point;   // on the interface
    double share; // of the edge before the point, seen from the first end
  };

  // The state of a vertex of an interface is that it is inside no subdomain.
  static constexpr Subdomain_rank on_interface = outside_rank - 2;

  const Located_octree& m_octree;
  const std::size_t m_size_of_lattice; // number of vertices
  std::vector<std::uint8_t> m_is_near; // whether a vertex is at a cell that meets a surface
  Working_mesh m_mesh;
  std::vector<Subdomain_rank> m_ranks; // of the subdomains that vertices are inside, or `on_interface`
  std::vector<Cut> m_cuts;             // of edges between subdomains
  bool m_is_clear;
  std::vector<Vertex_index> m_vertices; // vertices of the result
  double m_shortest;                    // edge of the octree near a surface

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  // Share of the edge up to which its end is moved. With a larger one there are fewer and better elements,
  // but tetrahedra of the octree may be inverted, which is tested.
  static constexpr double near = 0.3;

public:
  using Leaf_predicate = std::function<bool(Octree::Node_index)>;

  /// \param is_kept whether hexahedra of a leaf stay whole, if they are not beside a surface
  Interface_cutter(const Located_octree& octree, const Lattice_mesh& lattice, const Leaf_predicate& is_kept)
    : m_octree(octree), m_size_of_lattice(lattice.vertices.size()), m_is_near(near_vertices(octree, lattice)),
      m_mesh(split_elements(octree, lattice, m_is_near, is_kept),
             std::vector<Stratum>(lattice.vertices.size(), free_stratum))
  {
    for(Vertex_index v = 0; v < lattice.vertices.size(); ++v)
      m_ranks.push_back(lattice.sides[v] == ON_BOUNDARY ? on_interface : lattice.subdomain(v));
    m_shortest = shortest_edge();
    m_is_clear = insert_hidden_vertices();
    if(m_is_clear)
      m_cuts = all_cuts();
  }

  /// Whether there are no hidden subdomains all over, as between surfaces that should be one.
  bool is_clear() const { return m_is_clear; }

  /// The number of vertices before edges are bisected.
  std::size_t number_of_vertices() const { return m_ranks.size(); }

  /// \param stays vertices, of those before, that are not moved
  /// \param keeps_thin_parts whether vertices between two sheets of an interface stay as well
  /// \pre `is_clear()`
  Core_mesh operator()(const std::vector<std::uint8_t>& stays, bool keeps_thin_parts)
  {
    CGAL_precondition(is_clear() && stays.size() == number_of_vertices());
    move_near_vertices(stays, keeps_thin_parts);
    for(const Cut& cut : m_cuts)
      if(is_inside(cut.ends[0]) && is_inside(cut.ends[1]))
        bisect(cut);
    return mesh_of_subdomains();
  }

  /// The vertices where the boundary of the result is no manifold, and those around.
  std::vector<Vertex_index> defects(const Core_mesh& result) const
  {
    std::vector<Face_vertices> polygons;
    for(const Face& face : boundary_faces(result))
      polygons.push_back(face.vertices());
    const Manifold_defects all = manifold_defects(polygons);
    std::vector<Vertex_index> centers = all.vertices, vertices;
    for(const auto& edge : all.edges)
      centers.insert(centers.end(), edge.begin(), edge.end());
    for(Vertex_index center : centers)
      for(Element_index e : m_mesh.incident[m_vertices[center]])
        vertices.insert(vertices.end(), m_mesh.elements[e].begin(), m_mesh.elements[e].end());
    return vertices;
  }

private:
  static std::vector<std::uint8_t> near_vertices(const Located_octree& octree, const Lattice_mesh& lattice)
  {
    std::vector<std::uint8_t> is_near(lattice.vertices.size(), 0);
    for(Element_index e = 0; e < lattice.elements.size(); ++e)
      if(octree.side(lattice.cells[e]) == ON_BOUNDARY)
        for(Vertex_index v : lattice.elements[e])
          is_near[v] = 1;
    return is_near;
  }

  // Elements of the lattice, split into tetrahedra but for hexahedra that stay, and what is between these.
  static Core_mesh split_elements(const Located_octree& octree, const Lattice_mesh& lattice,
                                  const std::vector<std::uint8_t>& is_near, const Leaf_predicate& is_kept)
  {
    std::vector<Core_mesh::Point_3> points;
    for(const Lattice_point& p : lattice.vertices) {
      const auto q = octree.point(p);
      points.emplace_back(q.x(), q.y(), q.z());
    }
    constexpr Subdomain_index some_subdomain = 1; // the result has those of the domain
    std::vector<Element_attributes> attributes;
    for(Octree::Node_index n : lattice.cells)
      attributes.push_back({some_subdomain, octree.is_in_region(n), 0});
    Core_mesh mesh;
    mesh.assign(std::move(points), lattice.elements, std::move(attributes));
    return split_but_hexahedra(mesh, [&](Element_index e) {
      const Element_view element = mesh.element(e);
      return is_kept(lattice.cells[e])
             && std::none_of(element.begin(), element.end(), [&](Vertex_index v) { return is_near[v] != 0; });
    });
  }

  bool is_inside(Vertex_index v) const { return m_ranks[v] != on_interface; }

  // Edges of tetrahedra, each once, ascending.
  template <class Is_chosen>
  std::vector<Edge> edges(const Is_chosen& is_chosen) const
  {
    std::vector<Edge> all;
    for(const Working_mesh::Element& t : m_mesh.elements)
      for(std::size_t i = 0; i < 4 && !t.is_removed && t.kind == TETRAHEDRON; ++i)
        for(std::size_t j = 0; j < i; ++j)
          if(is_chosen(t.vertices[i], t.vertices[j]))
            all.push_back(std::minmax(t.vertices[i], t.vertices[j]));
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  std::vector<Edge> edges_near_surfaces() const
  {
    return edges([this](Vertex_index a, Vertex_index b) { return m_is_near[a] && m_is_near[b]; });
  }

  double shortest_edge() const
  {
    double shortest = infinity;
    for(const auto& [a, b] : edges_near_surfaces())
      shortest = (std::min)(shortest, norm(m_mesh.points[b] - m_mesh.points[a]));
    return shortest;
  }

  struct Hidden
  {
    double share = 0; // of the edge, where the subdomain is; 0: there is none
    Subdomain_rank rank = outside_rank;
  };

  // The subdomain that an edge passes between those of its ends; the one with the longest part of it.
  Hidden hidden_subdomain(Vertex_index a, Vertex_index b) const
  {
    constexpr std::size_t n = 8;     // parts of the edge
    constexpr std::size_t least = 2; // samples: a single one may be between surfaces that should be one
    const Vec3 p = m_mesh.points[a], edge = m_mesh.points[b] - p;
    std::array<Subdomain_rank, n + 1> ranks;
    for(std::size_t i = 1; i < n; ++i)
      ranks[i] = m_octree.subdomain_rank(p + (double(i) / n) * edge);
    ranks[0] = is_inside(a) ? m_ranks[a] : ranks[1];
    ranks[n] = is_inside(b) ? m_ranks[b] : ranks[n - 1];
    const auto first = std::find_if(ranks.begin(), ranks.end(),
                                    [&](Subdomain_rank r) { return r != ranks[0]; });
    auto last = ranks.end();
    while(last != first && *(last - 1) == ranks[n])
      --last;
    Hidden hidden;
    std::ptrdiff_t longest = least - 1;
    for(auto i = first; i != last;) {
      const auto end = std::find_if(i, last, [&](Subdomain_rank r) { return r != *i; });
      if(end - i > longest) {
        longest = end - i;
        hidden = {double((i - ranks.begin()) + (end - 1 - ranks.begin())) / (2 * n), *i};
      }
      i = end;
    }
    return hidden;
  }

  Vertex_index bisect(Vertex_index a, Vertex_index b, const Vec3& p, Subdomain_rank rank)
  {
    if(!bisect_edge(m_mesh, Aspect_ratio_quality_3(), a, b, p, free_stratum, infinity))
      return no_vertex;
    m_ranks.push_back(rank);
    m_is_near.push_back(1);
    return Vertex_index(m_ranks.size() - 1);
  }

  // \return whether there are not too many: at most as many as the lattice has
  bool insert_hidden_vertices()
  {
    constexpr double least_length = 0.5; // in edges of the octree: shorter ones are not bisected
    std::vector<Edge> queue = edges_near_surfaces();
    for(std::size_t i = 0; i < queue.size(); ++i) {
      const auto [a, b] = queue[i];
      const Vec3 edge = m_mesh.points[b] - m_mesh.points[a];
      if(norm(edge) < least_length * m_shortest || m_mesh.elements_at_edge(a, b).empty())
        continue;
      const Hidden hidden = hidden_subdomain(a, b);
      if(hidden.share == 0)
        continue;
      const Vertex_index v = bisect(a, b, m_mesh.points[a] + hidden.share * edge, hidden.rank);
      if(v == no_vertex)
        continue;
      if(v - m_size_of_lattice > m_size_of_lattice)
        return false;
      for(Vertex_index u : m_mesh.neighbors(v))
        queue.emplace_back(u, v);
    }
    return true;
  }

  // The edges between subdomains, with the points where they are cut.
  std::vector<Cut> all_cuts() const
  {
    std::vector<Cut> cuts;
    for(const auto& [a, b] : edges([this](Vertex_index u, Vertex_index v) {
          return m_ranks[u] != m_ranks[v] && is_inside(u) && is_inside(v);
        }))
      cuts.push_back(crossing(a, b));
    return cuts;
  }

  Vec3 closest(const Vec3& p, Subdomain_rank a, Subdomain_rank b) const
  {
    const std::vector<Subdomain_index>& indices = m_octree.domain().subdomain_indices();
    const auto [first, second] = std::minmax(a, b);
    return to_vec3(m_octree.domain().closest_point(Any_domain::Point_3(p[0], p[1], p[2]), indices[first],
                                                   second == outside_rank ? 0 : indices[second]));
  }

  // Where an edge crosses the interface: the next point is in the plane through the closest point of this
  // one, at right angles to the way there.
  Cut crossing(Vertex_index a, Vertex_index b) const
  {
    constexpr int most_steps = 6;
    constexpr double accuracy = 1e-3; // in edges; so far from the ends, at least
    const Vec3 p = m_mesh.points[a], edge = m_mesh.points[b] - p;
    const double length = norm(edge);
    double low = 0, high = 1, share = 0.5;
    for(int step = 0; step < most_steps; ++step) {
      const Vec3 x = p + share * edge, way = closest(x, m_ranks[a], m_ranks[b]) - x;
      const double distance = norm(way), along = dot(way, edge);
      if(distance < accuracy * length)
        break;
      (m_octree.subdomain_rank(x) == m_ranks[a] ? low : high) = share;
      const double next = along == 0 ? low : share + distance * distance / along;
      share = low < next && next < high ? next : (low + high) / 2;
    }
    share = (std::min)((std::max)(share, accuracy), 1 - accuracy);
    const Vec3 x = p + share * edge, q = closest(x, m_ranks[a], m_ranks[b]);
    return {{a, b}, norm(q - x) < accuracy * length ? q : x, share};
  }

  // An end of a cut.
  struct End
  {
    Vertex_index vertex, other;
    Vec3 way;     // to the point of the cut
    double share; // of the edge before it
  };

  End end_of(const Cut& cut, std::size_t i) const
  {
    return {cut.ends[i], cut.ends[1 - i], cut.point - m_mesh.points[cut.ends[i]],
            i == 0 ? cut.share : 1 - cut.share};
  }

  template <class Function>
  void for_each_end(const Function& f) const
  {
    for(std::size_t i = 0; i < 2 * m_cuts.size(); ++i)
      f(i, end_of(m_cuts[i / 2], i % 2));
  }

  // Whether all cuts of the edges of a vertex are of the same subdomains.
  // \param is_one_sheet and on the side where the interface is nearest: a vertex between two sheets of it
  // that left for one of them would take along what is between it and the other
  std::vector<std::uint8_t> vertices_beside_one_interface(bool is_one_sheet) const
  {
    const std::size_t n = m_ranks.size();
    std::vector<End> nearest(n, {no_vertex, no_vertex, {}, near});
    for_each_end([&](std::size_t, const End& end) {
      if(end.share < nearest[end.vertex].share)
        nearest[end.vertex] = end;
    });
    std::vector<std::uint8_t> is_beside_one(n, 0);
    std::vector<Vec3> ways(n); // to the interface
    for(const End& end : nearest)
      if(end.vertex != no_vertex) {
        const Vec3& p = m_mesh.points[end.vertex];
        is_beside_one[end.vertex] = 1;
        if(is_one_sheet)
          ways[end.vertex] = closest(p, m_ranks[end.vertex], m_ranks[end.other]) - p;
      }
    for_each_end([&](std::size_t, const End& end) {
      const Vertex_index v = end.vertex;
      is_beside_one[v] = is_beside_one[v] && m_ranks[end.other] == m_ranks[nearest[v].other]
                         && (!is_one_sheet || dot(ways[v], end.way) >= 0);
    });
    return is_beside_one;
  }

  // Moves vertices to the nearest one of the points where their edges are cut, the nearest first.
  void move_near_vertices(const std::vector<std::uint8_t>& stays, bool keeps_thin_parts)
  {
    const std::vector<std::uint8_t> is_beside_one = vertices_beside_one_interface(keeps_thin_parts);
    std::vector<std::pair<double, std::size_t>> order; // of ends
    for_each_end([&](std::size_t i, const End& end) {
      if(end.share < near && is_beside_one[end.vertex] && !stays[end.vertex])
        order.emplace_back(end.share, i);
    });
    std::sort(order.begin(), order.end());
    for(const auto& [share, i] : order) {
      const Cut& cut = m_cuts[i / 2];
      const Vertex_index v = cut.ends[i % 2];
      if(!is_inside(cut.ends[0]) || !is_inside(cut.ends[1]))
        continue;
      const Vec3 before = std::exchange(m_mesh.points[v], cut.point);
      if(std::all_of(m_mesh.incident[v].begin(), m_mesh.incident[v].end(),
                     [&](Element_index e) { return m_mesh.is_positive(m_mesh.elements[e]); }))
        m_ranks[v] = on_interface;
      else
        m_mesh.points[v] = before;
    }
  }

  // A point that is not quite on the edge may be impossible where tetrahedra are flat.
  void bisect(const Cut& cut)
  {
    const auto [a, b] = cut.ends;
    const Vec3 on_edge = m_mesh.points[a] + cut.share * (m_mesh.points[b] - m_mesh.points[a]);
    if(bisect(a, b, cut.point, on_interface) == no_vertex)
      bisect(a, b, on_edge, on_interface);
  }

  // The subdomain that vertices of a tetrahedron are inside; where there are none, or several, that of its
  // center.
  Subdomain_rank subdomain(const Working_mesh::Element& t) const
  {
    Subdomain_rank rank = on_interface;
    bool is_clear = true;
    Vec3 sum{};
    for(Vertex_index v : t) {
      sum = sum + m_mesh.points[v];
      if(is_inside(v)) {
        is_clear = is_clear && (rank == on_interface || rank == m_ranks[v]);
        rank = m_ranks[v];
      }
    }
    return is_clear && rank != on_interface ? rank : m_octree.subdomain_rank((1. / double(t.size())) * sum);
  }

  Core_mesh mesh_of_subdomains()
  {
    const std::vector<Subdomain_index>& indices = m_octree.domain().subdomain_indices();
    std::vector<Vertex_index> numbers(m_mesh.points.size(), no_vertex);
    std::vector<Core_mesh::Point_3> points;
    Element_list elements;
    std::vector<Element_attributes> attributes;
    for(const Working_mesh::Element& t : m_mesh.elements) {
      const Subdomain_rank rank = t.is_removed ? outside_rank : subdomain(t);
      if(rank == outside_rank)
        continue;
      std::array<Vertex_index, 8> v;
      for(int i = 0; i < t.size(); ++i) {
        Vertex_index& number = numbers[t.vertices[i]];
        if(number == no_vertex) {
          number = Vertex_index(points.size());
          const Vec3& p = m_mesh.points[t.vertices[i]];
          points.emplace_back(p[0], p[1], p[2]);
          m_vertices.push_back(t.vertices[i]);
        }
        v[i] = number;
      }
      elements.add(t.kind, v.data());
      attributes.push_back({indices[rank], t.attributes.is_in_region, 0});
    }
    Core_mesh mesh;
    mesh.assign(std::move(points), std::move(elements), std::move(attributes));
    return mesh;
  }
};

/*!
The elements of a lattice, cut along the interfaces of subdomains. Where the boundary would be no manifold,
vertices are not moved; none is if some interface would be none, or in the end: then all are manifolds, unless
some edge could not be cut.

\param is_kept whether hexahedra of a leaf stay, if they are not beside a surface
\param keeps_thin_parts whether vertices between two sheets of an interface are not moved: parts and gaps
that are thinner than cells are there then, of more and flatter elements
\return an empty mesh if one of them is no manifold all the same, or if the surfaces do not fit together
\par Complexity
Some queries for each edge at a cell that meets a surface
*/
inline Core_mesh cut_by_interfaces(const Located_octree& octree, const Lattice_mesh& lattice,
                                   const Interface_cutter::Leaf_predicate& is_kept, bool keeps_thin_parts)
{
  constexpr int most_attempts = 4;
  const Interface_cutter uncut(octree, lattice, is_kept);
  if(!uncut.is_clear())
    return {};
  std::vector<std::uint8_t> stays(uncut.number_of_vertices(), 0);
  for(int attempt = 0; attempt < most_attempts; ++attempt) {
    Interface_cutter cut = uncut;
    Core_mesh mesh = cut(stays, keeps_thin_parts);
    const std::vector<Vertex_index> defects = cut.defects(mesh);
    for(Vertex_index v : defects)
      if(v < stays.size()) // others are on the interface
        stays[v] = 1;
    if(defects.empty()) {
      const std::vector<Subdomain_interface> interfaces = find_interfaces(mesh);
      if(std::all_of(interfaces.begin(), interfaces.end(),
                     [](const Subdomain_interface& one) { return one.is_manifold(); }))
        return mesh;
    }
    if(defects.empty() || attempt == most_attempts - 2)
      std::fill(stays.begin(), stays.end(), 1);
  }
  return {};
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_CUT_BY_INTERFACES_H
