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
#include <CGAL/Mixed_mesh_3/internal/meshing/meshing_postconditions.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Working_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/moves/bisect_edge.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Located_octree.h>
#include <CGAL/Mixed_mesh_3/internal/transitions/Lattice_mesh.h>

#include <CGAL/assertions.h>
#include <CGAL/enum.h>

#include <boost/container/small_vector.hpp>
#include <boost/functional/hash.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// An edge that is cut.
struct Edge_cut
{
  Vec3 point;      ///< on the interface
  double share;    ///< of the edge before the point
  bool is_contact; ///< whether the subdomains of the ends meet there, not another one
};

/// The subdomain that an edge passes between those of its ends.
struct Hidden_subdomain
{
  double share = 0; ///< of the edge, where the subdomain is; 0: there is none
  Subdomain_rank rank = outside_rank;
};

/// What is known of edges, by the positions of their ends: most edges of an octree are those of the one
/// before, which has a few cells less.
struct Known_edges
{
  using Ends = std::array<Vec3, 2>;

  struct Hash
  {
    std::size_t operator()(const Ends& ends) const
    {
      std::size_t hash = 0;
      for(const Vec3& p : ends)
        boost::hash_range(hash, p.begin(), p.end());
      return hash;
    }
  };

  template <class T>
  using Map = std::unordered_map<Ends, T, Hash>;

  Map<Hidden_subdomain> hidden;
  Map<Edge_cut> cuts;
};

/*!
Cuts the elements of a lattice along the interfaces of subdomains. All are tetrahedra, but hexahedra that are
to stay, beside no surface, and pyramids and others between these.

A subdomain that an edge passes, between others, first gets a vertex there: so a layer keeps its own vertices
if it is a quarter as thick as a cell, or more. Then one subdomain after the other is separated from those
that follow, the outside first. Vertices that are near to its surface, beside the length of their edges, are
moved there (as in isosurface stuffing: Labelle, Shewchuk, 2007), and the edges that still cross it are
bisected there (as in lattice cleaving: Bronson, Levine, Whitaker, 2014). A vertex on that surface belongs to
one of those that follow when these are separated, so that edges on the boundary are bisected where layers end
at it: where no vertex is moved, each surface is that of marching tetrahedra, a manifold, divided by curves.
Bisections keep the mesh conforming, and at the end no element has vertices inside different subdomains.
*/
class Interface_cutter
{
  using Edge = Working_mesh::Edge;

  struct Cut : Edge_cut
  {
    std::array<Vertex_index, 2> ends;
  };

  // Instead of a subdomain, for vertices of the lattice that are exactly on an interface.
  static constexpr Subdomain_rank on_interface = outside_rank - 2;

  // The place of a subdomain in the order in which they are separated: the outside is the first.
  static Subdomain_rank step(Subdomain_rank rank) { return Subdomain_rank(rank + 1); }
  using Steps = boost::container::small_vector<Subdomain_rank, 2>;

  const Located_octree& m_octree;
  const std::size_t m_size_of_lattice; // number of vertices
  std::vector<std::uint8_t> m_is_near; // whether a vertex is at a cell that meets a surface
  Working_mesh m_mesh;
  std::vector<Subdomain_rank> m_ranks; // of subdomains of vertices: the last one where several meet
  std::vector<Steps> m_surfaces;       // those of the subdomains before the last one, ascending
  std::vector<std::uint8_t> m_stays;   // whether a vertex is not moved
  std::vector<Cut> m_cuts;             // of edges between subdomains, before any is bisected; ascending
  bool m_is_clear;
  std::vector<Vertex_index> m_vertices; // vertices of the result
  double m_shortest;                    // edge of the octree near a surface

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  // Share of the edge up to which its end is moved. With a larger one there are fewer and better elements,
  // but tetrahedra of the octree may be inverted, which is tested. With half of it, the volume of a brain is
  // 0.969 instead of 0.979; with twice as much, worst aspect-ratio coefficients of two of 18 meshes are 4.1
  // and 4.8 instead of 2.6 and 3.1 (constants.md).
  static constexpr double near = 0.3;
  // Accuracy of the points where edges are cut, in edges; they are so far from the ends, at least.
  // With a tenth and ten times of it, largest distances are 1.06 and 0.89 times as large in the median.
  static constexpr double accuracy = 1e-3;

public:
  using Leaf_predicate = std::function<bool(Octree::Node_index)>;

  /// \param is_kept whether hexahedra of a leaf stay whole, if they are not beside a surface
  /// \param known edges of octrees of the same domain; those of this one are added
  Interface_cutter(const Located_octree& octree, const Lattice_mesh& lattice, const Leaf_predicate& is_kept,
                   Known_edges& known)
    : m_octree(octree), m_size_of_lattice(lattice.vertices.size()), m_is_near(near_vertices(octree, lattice)),
      m_mesh(split_elements(octree, lattice, m_is_near, is_kept),
             std::vector<Stratum>(lattice.vertices.size(), free_stratum))
  {
    for(Vertex_index v = 0; v < lattice.vertices.size(); ++v)
      m_ranks.push_back(lattice.sides[v] == ON_BOUNDARY ? on_interface : lattice.subdomain(v));
    m_surfaces.resize(m_ranks.size());
    std::vector<Edge> near_surfaces = edges(
      [this](Vertex_index a, Vertex_index b) { return m_is_near[a] && m_is_near[b]; });
    m_shortest = shortest(near_surfaces);
    m_is_clear = insert_hidden_vertices(std::move(near_surfaces), known);
    if(m_is_clear)
      m_cuts = all_cuts(known);
  }

  /// Whether there are no hidden subdomains all over, as between surfaces that should be one.
  bool is_clear() const { return m_is_clear; }

  /// Places on edges between subdomains that do not meet there: another one is between them.
  std::vector<Vec3> places_without_contact() const
  {
    std::vector<Vec3> places;
    for(const Cut& cut : m_cuts) {
      const Vec3 &p = m_mesh.points[cut.ends[0]], &q = m_mesh.points[cut.ends[1]];
      if(!cut.is_contact && is_inside(cut.ends[0]) && is_inside(cut.ends[1]))
        places.push_back(p + cut.share * (q - p));
    }
    return places;
  }

  /// The number of vertices before edges are bisected.
  std::size_t number_of_vertices() const { return m_ranks.size(); }

  /// \param stays vertices, of those before, that are not moved; nor are those that bisect their edges
  /// \param keeps_thin_parts whether vertices between two sheets of an interface stay as well
  /// \pre `is_clear()`
  Core_mesh operator()(std::vector<std::uint8_t> stays, bool keeps_thin_parts)
  {
    CGAL_precondition(is_clear() && stays.size() == number_of_vertices());
    m_stays = std::move(stays);
    std::map<Subdomain_rank, std::vector<Edge>> edges; // by step
    for(const Cut& cut : m_cuts)
      edges[first_step(cut.ends[0], cut.ends[1])].emplace_back(cut.ends[0], cut.ends[1]);
    const auto add_edges_of = [&](Vertex_index v) { // on the surface of this step: these are of later ones
      for(Vertex_index u : m_mesh.neighbors(v))
        if(is_between(u, v))
          edges[first_step(u, v)].push_back(std::minmax(u, v));
    };
    for(; !edges.empty(); edges.erase(edges.begin())) {
      std::vector<Edge>& of_step = edges.begin()->second;
      std::sort(of_step.begin(), of_step.end());
      of_step.erase(std::unique(of_step.begin(), of_step.end()), of_step.end());
      std::vector<Cut> cuts;
      for(const auto& [a, b] : of_step)
        if(is_between(a, b))
          cuts.push_back(cut_of(a, b));
      for(Vertex_index v : move_near_vertices(cuts, keeps_thin_parts))
        add_edges_of(v);
      for(const Cut& cut : cuts)
        if(const Vertex_index v = is_between(cut.ends[0], cut.ends[1]) ? bisect(cut) : no_vertex;
           v != no_vertex)
          add_edges_of(v);
    }
    return mesh_of_subdomains();
  }

  /// The vertices where the boundary of the result, or an interface, is no manifold, and those around.
  std::vector<Vertex_index> defects(const Core_mesh& result) const
  {
    std::vector<Face_vertices> polygons;
    for(const Face& face : boundary_faces(result))
      polygons.push_back(face.vertices());
    const Manifold_defects of_boundary = manifold_defects(polygons);
    std::vector<Vertex_index> centers = of_boundary.vertices, vertices;
    for(const auto& edge : of_boundary.edges)
      centers.insert(centers.end(), edge.begin(), edge.end());
    for(const Subdomain_interface& one : find_interfaces(result)) {
      centers.insert(centers.end(), one.bad_vertices.begin(), one.bad_vertices.end());
      for(const auto& [a, b] : one.bad_edges)
        centers.insert(centers.end(), {a, b});
    }
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

  bool is_inside(Vertex_index v) const { return m_ranks[v] != on_interface && m_surfaces[v].empty(); }

  bool is_on(Vertex_index v, Subdomain_rank step) const
  {
    return std::binary_search(m_surfaces[v].begin(), m_surfaces[v].end(), step);
  }

  // The step that separates the subdomains of two vertices.
  Subdomain_rank first_step(Vertex_index a, Vertex_index b) const
  {
    return (std::min)(step(m_ranks[a]), step(m_ranks[b]));
  }

  // Whether the edge of two vertices has to be bisected.
  bool is_between(Vertex_index a, Vertex_index b) const
  {
    if(m_ranks[a] == m_ranks[b] || m_ranks[a] == on_interface || m_ranks[b] == on_interface)
      return false;
    const Subdomain_rank first = first_step(a, b);
    return !is_on(a, first) && !is_on(b, first);
  }

  // Sets a vertex on the surface that separates the subdomains of two vertices.
  void set_on_surface(Vertex_index v, Vertex_index a, Vertex_index b)
  {
    Steps steps;
    std::set_intersection(m_surfaces[a].begin(), m_surfaces[a].end(), m_surfaces[b].begin(),
                          m_surfaces[b].end(), std::back_inserter(steps));
    const Subdomain_rank first = first_step(a, b);
    steps.insert(std::upper_bound(steps.begin(), steps.end(), first), first);
    m_ranks[v] = step(m_ranks[a]) == first ? m_ranks[b] : m_ranks[a];
    m_surfaces[v] = std::move(steps);
  }

  // Edges of tetrahedra, each once, ascending.
  template <class Is_chosen>
  std::vector<Edge> edges(const Is_chosen& is_chosen) const
  {
    std::vector<Edge> all;
    std::vector<Vertex_index> met_from(m_mesh.points.size(), no_vertex);
    for(Vertex_index v = 0; v < m_mesh.points.size(); ++v) {
      const auto first = std::ptrdiff_t(all.size());
      for(Element_index e : m_mesh.incident[v])
        if(m_mesh.elements[e].kind == TETRAHEDRON)
          for(Vertex_index u : m_mesh.elements[e])
            if(v < u && std::exchange(met_from[u], v) != v && is_chosen(v, u))
              all.emplace_back(v, u);
      std::sort(all.begin() + first, all.end());
    }
    return all;
  }

  double shortest(const std::vector<Edge>& edges) const
  {
    double least = infinity;
    for(const auto& [a, b] : edges)
      least = (std::min)(least, norm(m_mesh.points[b] - m_mesh.points[a]));
    return least;
  }

  // The subdomain that an edge passes between those of its ends; the one with the longest part of it.
  Hidden_subdomain hidden_subdomain(Vertex_index a, Vertex_index b) const
  {
    constexpr std::size_t n = 8; // parts of the edge
    // Samples: a single one may be between surfaces that should be one. If one suffices, four of 18 largest
    // distances are larger and none is smaller (constants.md).
    constexpr std::size_t least = 2;
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
    Hidden_subdomain hidden;
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

  Vertex_index bisect(Vertex_index a, Vertex_index b, const Vec3& p, Subdomain_rank rank,
                      double bound = infinity)
  {
    if(!bisect_edge(m_mesh, Aspect_ratio_quality_3(), a, b, p, free_stratum, bound))
      return no_vertex;
    m_ranks.push_back(rank);
    m_surfaces.emplace_back();
    m_is_near.push_back(1);
    if(!m_stays.empty())
      m_stays.push_back(m_stays[a] || m_stays[b]);
    return Vertex_index(m_ranks.size() - 1);
  }

  // \return whether there are not too many: at most as many as the lattice has
  bool insert_hidden_vertices(std::vector<Edge> queue, Known_edges& known)
  {
    constexpr double least_length = 0.5; // in edges of the octree: shorter ones are not bisected
    for(std::size_t i = 0; i < queue.size(); ++i) {
      const auto [a, b] = queue[i];
      const Vec3 edge = m_mesh.points[b] - m_mesh.points[a];
      if(norm(edge) < least_length * m_shortest || !m_mesh.has_element_with(a, b))
        continue;
      const auto [found, is_new] = known.hidden.try_emplace({m_mesh.points[a], m_mesh.points[b]});
      if(is_new)
        found->second = hidden_subdomain(a, b);
      const Hidden_subdomain hidden = found->second;
      if(hidden.share == 0)
        continue;
      const Vertex_index v = bisect(a, b, m_mesh.points[a] + hidden.share * edge, hidden.rank, 1 / accuracy);
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
  std::vector<Cut> all_cuts(Known_edges& known) const
  {
    std::vector<Cut> cuts;
    for(const auto& [a, b] : edges([this](Vertex_index u, Vertex_index v) { return is_between(u, v); })) {
      const auto [found, is_new] = known.cuts.try_emplace({m_mesh.points[a], m_mesh.points[b]});
      if(is_new) {
        found->second = crossing(a, b);
        found->second.is_contact = is_contact(a, b, found->second.share);
      }
      cuts.push_back({found->second, {a, b}});
    }
    return cuts;
  }

  // Whether the subdomains of the ends of an edge meet where it is cut.
  bool is_contact(Vertex_index a, Vertex_index b, double share) const
  {
    constexpr double part = 0.05; // of the edge, before and behind; half and twice: 18 meshes are the same
    const Vec3 p = m_mesh.points[a], edge = m_mesh.points[b] - p;
    const auto is_of_another = [&](double where) {
      const Subdomain_rank rank = m_octree.subdomain_rank(p + where * edge);
      return rank != m_ranks[a] && rank != m_ranks[b];
    };
    return m_octree.domain().subdomain_indices().size() == 1
           || !((share > part && is_of_another(share - part))
                || (share < 1 - part && is_of_another(share + part)));
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
    constexpr int most_steps = 6; // twice as many: 18 meshes are the same; half: six differ (constants.md)
    const Vec3 p = m_mesh.points[a], edge = m_mesh.points[b] - p;
    const double length = norm(edge);
    double low = 0, high = 1, share = 0.5;
    for(int step = 0; step < most_steps; ++step) {
      const Vec3 x = p + share * edge, way = closest(x, m_ranks[a], m_ranks[b]) - x;
      const double distance = norm(way), along = dot(way, edge);
      if(distance < accuracy * length)
        break;
      const Subdomain_rank rank = m_octree.subdomain_rank(x); // another one beside a curve of the boundary
      if(rank == m_ranks[a])
        low = share;
      else if(rank == m_ranks[b])
        high = share;
      const double next = along == 0 ? low : share + distance * distance / along;
      share = low < next && next < high ? next : (low + high) / 2;
    }
    share = (std::min)((std::max)(share, accuracy), 1 - accuracy);
    const Vec3 x = p + share * edge, q = closest(x, m_ranks[a], m_ranks[b]);
    return {{norm(q - x) < accuracy * length ? q : x, share, true}, {a, b}};
  }

  // The cut of an edge, found before if its ends are where they were.
  Cut cut_of(Vertex_index a, Vertex_index b) const
  {
    if(!is_inside(a) || !is_inside(b))
      return crossing(a, b);
    const auto found = std::lower_bound(m_cuts.begin(), m_cuts.end(), std::array<Vertex_index, 2>{a, b},
                                        [](const Cut& c, const auto& ends) { return c.ends < ends; });
    CGAL_assertion(found != m_cuts.end() && found->ends[0] == a && found->ends[1] == b);
    return *found;
  }

  // An end of a cut.
  struct End
  {
    Vertex_index vertex, other;
    double share; // of the edge before the point of the cut
    Vec3 point;
  };

  // The ends of cuts from which these are near, of vertices that may move, the nearest first.
  // \param is_one_sheet whether all cuts of a vertex have to be on the side where the interface is nearest: a
  // vertex between two sheets of it that left for one of them would take along what is between it and the
  // other
  std::vector<End> near_ends(const std::vector<Cut>& cuts, bool is_one_sheet) const
  {
    std::vector<End> ends, chosen;
    for(const Cut& cut : cuts)
      for(std::size_t i = 0; i < 2; ++i)
        ends.push_back({cut.ends[i], cut.ends[1 - i], i == 0 ? cut.share : 1 - cut.share, cut.point});
    std::stable_sort(ends.begin(), ends.end(), [](const End& a, const End& b) {
      return std::tie(a.vertex, a.share) < std::tie(b.vertex, b.share);
    });
    for(auto first = ends.begin(), last = first; first != ends.end(); first = last) {
      const Vertex_index v = first->vertex;
      last = std::find_if(first, ends.end(), [v](const End& end) { return end.vertex != v; });
      if(m_stays[v] || !(first->share < near))
        continue;
      const Vec3& p = m_mesh.points[v];
      const Vec3 way = is_one_sheet ? closest(p, m_ranks[v], m_ranks[first->other]) - p : Vec3{};
      if(std::all_of(first, last, [&](const End& end) { return dot(way, end.point - p) >= 0; }))
        std::copy_if(first, last, std::back_inserter(chosen), [](const End& e) { return e.share < near; });
    }
    std::stable_sort(chosen.begin(), chosen.end(),
                     [](const End& a, const End& b) { return a.share < b.share; });
    return chosen;
  }

  // Moves vertices to the nearest one of the points where their edges are cut, the nearest first; those on
  // surfaces along these.
  // \return the vertices
  std::vector<Vertex_index> move_near_vertices(const std::vector<Cut>& cuts, bool keeps_thin_parts)
  {
    std::vector<Vertex_index> moved;
    for(const auto& [v, other, share, point] : near_ends(cuts, keeps_thin_parts)) {
      const Steps &mine = m_surfaces[v], &others = m_surfaces[other];
      if(!is_between(v, other) || !std::includes(others.begin(), others.end(), mine.begin(), mine.end()))
        continue;
      const Vec3 before = std::exchange(m_mesh.points[v], point);
      if(std::all_of(m_mesh.incident[v].begin(), m_mesh.incident[v].end(),
                     [&](Element_index e) { return m_mesh.is_positive(m_mesh.elements[e]); })) {
        set_on_surface(v, v, other);
        moved.push_back(v);
      } else {
        m_mesh.points[v] = before;
      }
    }
    return moved;
  }

  // A point that is not quite on the edge may be impossible where tetrahedra are flat.
  Vertex_index bisect(const Cut& cut)
  {
    const auto [a, b] = cut.ends;
    const Vec3 on_edge = m_mesh.points[a] + cut.share * (m_mesh.points[b] - m_mesh.points[a]);
    Vertex_index v = bisect(a, b, cut.point, on_interface, 1 / accuracy);
    if(v == no_vertex)
      v = bisect(a, b, on_edge, on_interface);
    if(v != no_vertex)
      set_on_surface(v, a, b);
    return v;
  }

  // The subdomain of a tetrahedron: the first one of its vertices, if the others are inside it or on its
  // surface. That of its center, if all vertices are on one surface, or some edge could not be bisected.
  Subdomain_rank subdomain(const Working_mesh::Element& t) const
  {
    Vertex_index first = no_vertex;
    Steps common; // surfaces that all vertices are on
    Vec3 sum{};
    for(Vertex_index v : t) {
      sum = sum + m_mesh.points[v];
      if(m_ranks[v] == on_interface)
        continue;
      if(first == no_vertex)
        common = m_surfaces[v];
      common.erase(std::remove_if(common.begin(), common.end(), [&](auto s) { return !is_on(v, s); }),
                   common.end());
      if(first == no_vertex || step(m_ranks[v]) < step(m_ranks[first]))
        first = v;
    }
    const bool is_clear = first != no_vertex && common.empty()
                          && std::none_of(t.begin(), t.end(),
                                          [&](Vertex_index v) { return is_between(first, v); });
    return is_clear ? m_ranks[first] : m_octree.subdomain_rank((1. / double(t.size())) * sum);
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
The mesh of a cutter. Where the boundary or an interface would be no manifold, vertices are not moved; in the
end none is: then all are manifolds, unless vertices of the lattice are on surfaces, or some edge could not be
cut.

\param keeps_thin_parts whether vertices between two sheets of an interface are not moved: parts and gaps
that are thinner than cells are there then, of more and flatter elements
\return an empty mesh if one of them is no manifold all the same
\par Complexity
Some queries for each edge at a cell that meets a surface
\pre `uncut.is_clear()`
*/
inline Core_mesh cut_by_interfaces(const Interface_cutter& uncut, bool keeps_thin_parts)
{
  // With half as many, the worst aspect-ratio coefficient of a cube with tunnels is 4.6 instead of 2.9; with
  // twice as many, 18 meshes are the same (constants.md).
  constexpr int most_attempts = 4;
  std::vector<std::uint8_t> stays(uncut.number_of_vertices(), 0);
  for(int attempt = 0; attempt < most_attempts; ++attempt) {
    Interface_cutter cut = uncut;
    Core_mesh mesh = cut(stays, keeps_thin_parts);
    const std::vector<Vertex_index> defects = cut.defects(mesh);
    if(defects.empty()) {
      CGAL_expensive_postcondition(is_valid_cut(mesh));
      return mesh;
    }
    for(Vertex_index v : defects)
      if(v < stays.size()) // others are on the interface
        stays[v] = 1;
    if(attempt == most_attempts - 2)
      std::fill(stays.begin(), stays.end(), 1);
  }
  return {};
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_CUT_BY_INTERFACES_H
