// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The boundary stage as a whole: orders the vertices, splits elements, looks for pinched places, relabels,
// and repeats.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_BOUNDARY_BOUNDARY_STAGE_H
#define CGAL_MIXED_MESH_3_INTERNAL_BOUNDARY_BOUNDARY_STAGE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/octree/Located_octree.h>
#include <CGAL/Mixed_mesh_3/internal/transitions/Lattice_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/elements/manifold_defects.h>
#include <CGAL/Mixed_mesh_3/internal/base/parallel_for.h>
#include <CGAL/Mixed_mesh_3/internal/boundary/Sheet_layer.h>
#include <CGAL/Mixed_mesh_3/internal/boundary/balance_interfaces.h>
#include <CGAL/Mixed_mesh_3/internal/boundary/boundary_polygons.h>
#include <CGAL/Mixed_mesh_3/internal/boundary/split_by_order.h>
#include <CGAL/Mixed_mesh_3/internal/boundary/split_by_parity.h>
#include <CGAL/Mixed_mesh_3/options.h>

#include <CGAL/assertions.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <map>
#include <set>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

namespace internal {

/// The result of the boundary stage for a lattice mesh: elements replaced by pieces.
struct Boundary_pieces
{
  Element_list pieces;
  std::vector<Element_index> origins;          ///< element that each piece comes from; sorted
  std::vector<Subdomain_rank> subdomains;      ///< subdomain of each piece
  std::vector<Compartment_index> compartments; ///< compartment of each piece; empty without sheets
  std::vector<std::uint8_t> is_replaced;       ///< whether pieces replace the element, for each element
  std::vector<std::uint8_t> is_used;           ///< whether the result has the vertex, for each vertex
  std::size_t number_of_vertices = 0;          ///< number of vertices of the result
  std::size_t number_of_relabeled_vertices = 0;
  std::size_t number_of_inserted_vertices = 0;
  std::size_t number_of_lost_sheets = 0;
  Manifold_defects defects; ///< defects that relabeling could not repair
};

template <class Sheets>
class Boundary_stage : private Boundary_pieces
{
  const Located_octree& m_located;
  Lattice_mesh& m_mesh;
  const std::size_t m_number_of_subdomains;
  const Boundary_mode m_mode;
  const unsigned m_threads;
  // Whether a vertex is an interface vertex: not inside the subdomain of some element, but on the boundary or
  // between two.
  std::vector<std::uint8_t> m_is_on_interface;
  bool m_has_vertices_on_surface = false; // before vertices move
  Sheets m_sheets;
  std::vector<std::uint8_t> m_is_on_sheet;
  std::vector<Element_index> m_outer; // elements outside, or with interface or sheet vertices
  std::vector<double> m_distances;    // distances of vertices, where asked for
  std::vector<std::uint32_t> m_ranks;
  std::map<Vertex_index, std::map<Subdomain_rank, int>> m_around; // pieces of each subdomain, if several

  static constexpr std::uint32_t last_rank = std::uint32_t(-1);

public:
  Boundary_stage(const Located_octree& located, Lattice_mesh& mesh, Boundary_mode mode, unsigned threads,
                 Sheets sheets)
    : m_located(located), m_mesh(mesh), m_number_of_subdomains(located.domain().subdomain_indices().size()),
      m_mode(m_number_of_subdomains > 1 || !sheets.is_none() ? Boundary_mode::VERTEX_ORDER : mode),
      m_threads(threads), m_sheets(std::move(sheets))
  {
    m_distances.assign(mesh.vertices.size(), -1);
    const std::size_t first_inserted = mesh.vertices.size();
    if(m_number_of_subdomains > 1)
      balance_interfaces(located, mesh, threads);
    do {
      while(mesh.vertices.size() > first_inserted)
        mesh.remove_last_vertex();
      find_interface();
      rank_vertices();
      split_elements();
      if(m_number_of_subdomains > 1)
        join_flat_pieces();
    } while(relabel() || m_sheets.mend(pieces));
    compartments = m_sheets.compartments();
    number_of_lost_sheets = m_sheets.number_of_lost();
    number_of_inserted_vertices = mesh.vertices.size() - first_inserted;
    count_vertices();
  }

  Boundary_pieces result() && { return std::move(*this); }

private:
  bool is_on_interface(Vertex_index v) const // works for vertices inserted later too
  {
    return v < m_is_on_interface.size() && m_is_on_interface[v];
  }

  bool is_on_interface_or_sheet(Vertex_index v) const
  {
    return is_on_interface(v) || (v < m_is_on_sheet.size() && m_is_on_sheet[v]);
  }

  // Whether a vertex is on the surface already: it counts as inside where elements are split.
  bool is_on_surface(Vertex_index v) const
  {
    return m_number_of_subdomains == 1 && m_mode == Boundary_mode::VERTEX_ORDER && m_sheets.is_none()
           && v < m_mesh.sides.size() && m_mesh.sides[v] == ON_BOUNDARY;
  }

  // Whether an element without vertices outside is inside: some or all of its vertices are on the surface.
  bool is_whole(Element_index e) const
  {
    const Element_view element = m_mesh.elements[e];
    if(!std::all_of(element.begin(), element.end(),
                    [this](Vertex_index v) { return m_mesh.is_inside(v) || is_on_surface(v); }))
      return false;
    if(std::any_of(element.begin(), element.end(), [this](Vertex_index v) { return m_mesh.is_inside(v); }))
      return true;
    auto middle = m_located.point(m_mesh.vertices[element[0]]) - CGAL::ORIGIN;
    for(int i = 1; i < element.size(); ++i)
      middle = middle + (m_located.point(m_mesh.vertices[element[i]]) - CGAL::ORIGIN);
    return m_located.domain().bounded_side(CGAL::ORIGIN + middle / element.size(),
                                           m_located.surface_part(m_mesh.cells[e]))
           == ON_BOUNDED_SIDE;
  }

  bool has_only_interface_vertices(const Element_view& element) const
  {
    return std::all_of(element.begin(), element.end(), [this](Vertex_index v) { return is_on_interface(v); });
  }

  // The first one of the subdomains of the vertices.
  Subdomain_rank subdomain(const Element_view& element) const
  {
    Subdomain_rank first = outside_rank;
    for(Vertex_index v : element)
      first = (std::min)(first, m_mesh.subdomain(v));
    return first;
  }

  void find_interface()
  {
    m_is_on_interface.assign(m_mesh.vertices.size(), 0);
    for(Vertex_index v = 0; v < m_is_on_interface.size(); ++v)
      m_is_on_interface[v] = is_on_surface(v);
    m_has_vertices_on_surface = std::count(m_is_on_interface.begin(), m_is_on_interface.end(), 1) > 0;
    for(Element_index e = 0; e < m_mesh.elements.size(); ++e) {
      const Element_view element = m_mesh.elements[e];
      const Subdomain_rank mine = subdomain(element);
      for(Vertex_index v : element)
        if(m_mesh.subdomain(v) != mine)
          m_is_on_interface[v] = 1;
    }
    if(!m_sheets.is_none()) {
      m_is_on_sheet.assign(m_mesh.vertices.size(), 0);
      for(Vertex_index v = 0; v < m_is_on_sheet.size(); ++v)
        m_is_on_sheet[v] = m_sheets.is_on(v);
    }
    m_outer.clear();
    for(Element_index e = 0; e < m_mesh.elements.size(); ++e) {
      const Element_view element = m_mesh.elements[e];
      if(!m_mesh.is_inside(element[0]) || std::any_of(element.begin(), element.end(), [this](Vertex_index v) {
           return is_on_interface_or_sheet(v);
         }))
        m_outer.push_back(e);
    }
  }

  // Ranks the vertices: interface vertices first, the nearest to the surface first, ties by lattice position;
  // then sheet vertices.
  void rank_vertices()
  {
    std::vector<Vertex_index> vertices;
    for(Vertex_index v = 0; v < m_is_on_interface.size(); ++v)
      if(m_is_on_interface[v] && !is_on_surface(v))
        vertices.push_back(v);
    parallel_for(vertices.size(), m_threads, [&](std::size_t i) {
      const Vertex_index v = vertices[i];
      if(m_distances[v] < 0)
        m_distances[v] = m_mesh.sides[v] == ON_BOUNDARY ? 0 : distance(v);
    });
    std::vector<std::tuple<double, std::uint64_t, Vertex_index>> order;
    for(Vertex_index v : vertices)
      order.emplace_back(m_located.quantized(m_distances[v]), lattice_key(m_mesh.vertices[v]), v);
    std::sort(order.begin(), order.end());
    m_ranks.assign(m_mesh.vertices.size(), last_rank);
    for(std::size_t i = 0; i < order.size(); ++i)
      m_ranks[std::get<2>(order[i])] = std::uint32_t(i);
    rank_sheet_vertices(std::uint32_t(order.size()));
    CGAL_assertion(is_order_total());
  }

  // Whether no two vertices at which elements are split have the same rank: each diagonal then belongs to
  // only one of its ends.
  bool is_order_total() const
  {
    std::vector<std::uint32_t> ranks;
    for(Vertex_index v = 0; v < m_ranks.size(); ++v)
      if(is_on_interface_or_sheet(v) && !is_on_surface(v))
        ranks.push_back(m_ranks[v]);
    std::sort(ranks.begin(), ranks.end());
    return std::adjacent_find(ranks.begin(), ranks.end()) == ranks.end()
           && (ranks.empty() || ranks.back() != last_rank);
  }

  void rank_sheet_vertices(std::uint32_t first)
  {
    std::vector<std::tuple<double, std::uint64_t, Vertex_index>> order;
    for(Vertex_index v = 0; v < m_is_on_sheet.size(); ++v)
      if(m_is_on_sheet[v] && !m_is_on_interface[v])
        order.emplace_back(m_located.quantized(m_sheets.depth(v)), lattice_key(m_mesh.vertices[v]), v);
    std::sort(order.begin(), order.end());
    for(std::size_t i = 0; i < order.size(); ++i)
      m_ranks[std::get<2>(order[i])] = first + std::uint32_t(i);
  }

  double distance(Vertex_index v) const
  {
    const auto p = m_located.point(m_mesh.vertices[v]);
    const auto q = m_located.domain().closest_point(p, m_located.surface_part(m_mesh.leaves[v]));
    return std::sqrt(CGAL::squared_distance(p, q));
  }

  void split_elements()
  {
    pieces = Element_list();
    origins.clear();
    subdomains.clear();
    is_replaced.assign(m_mesh.elements.size(), 0);
    for(Element_index e : m_outer)
      is_replaced[e] = 1;
    if(m_mode == Boundary_mode::PAPER) {
      const auto meets_surface = [&](Element_index e) {
        return m_located.side(m_mesh.cells[e]) == ON_BOUNDARY;
      };
      Parity_splitter(m_mesh, meets_surface)([&](Element_index e, Element_kind kind,
                                                 const Vertex_index* v) { add_piece(e, kind, v); },
                                             is_replaced);
    } else {
      for(Element_index e : m_outer)
        if(m_has_vertices_on_surface && is_whole(e))
          add(e, m_mesh.elements[e].kind(), m_mesh.elements[e].begin(), 0);
        else if(subdomain(m_mesh.elements[e]) != outside_rank)
          split_element(
            m_mesh.elements[e], [&](Vertex_index v) { return m_ranks[v]; },
            [&](Vertex_index v) { return !is_on_interface_or_sheet(v) || is_on_surface(v); },
            [&](Element_kind kind, std::initializer_list<Vertex_index> v) { add_piece(e, kind, v.begin()); });
    }
  }

  void add_piece(Element_index origin, Element_kind kind, const Vertex_index* v)
  {
    const Subdomain_rank mine = subdomain(Element_view(kind, v));
    if(mine != outside_rank)
      add(origin, kind, v, mine);
  }

  void add(Element_index origin, Element_kind kind, const Vertex_index* v, Subdomain_rank mine)
  {
    pieces.add(kind, v);
    origins.push_back(origin);
    subdomains.push_back(mine);
  }

  // Joins flat pieces to an earlier subdomain. A piece all of whose vertices an earlier subdomain has too
  // would be flat once the vertices are on the surface of that subdomain; after the join, the vertices may be
  // inside.
  void join_flat_pieces()
  {
    m_around.clear();
    std::vector<std::size_t> flat;
    for(std::size_t i = 0; i < pieces.size(); ++i) {
      for(Vertex_index v : pieces[i])
        if(is_on_interface(v))
          ++m_around[v][subdomains[i]];
      if(has_only_interface_vertices(pieces[i]))
        flat.push_back(i);
    }
    for(bool changed = true; changed;) {
      changed = false;
      for(std::size_t i : flat) {
        const Element_view piece = pieces[i];
        for(const auto& [earlier, count] : m_around[piece[0]]) {
          const Subdomain_rank a = earlier;
          if(a >= subdomains[i])
            break;
          if(std::all_of(piece.begin(), piece.end(),
                         [&](Vertex_index v) { return m_around[v].count(a) > 0; })) {
            join(i, a);
            changed = true;
            break;
          }
        }
      }
    }
  }

  void join(std::size_t piece, Subdomain_rank a)
  {
    for(Vertex_index v : pieces[piece]) {
      std::map<Subdomain_rank, int>& around = m_around[v];
      ++around[a];
      if(--around[subdomains[piece]] == 0)
        around.erase(subdomains[piece]);
    }
    subdomains[piece] = a;
  }

  // The nearer end of each bad edge, seen from the surface, and the bad vertices.
  std::vector<Vertex_index> pinched_vertices(const Manifold_defects& defects) const
  {
    std::vector<Vertex_index> pinched = defects.vertices;
    for(const auto& [a, b] : defects.edges) {
      const bool first = m_mesh.is_on_rim[b] || (!m_mesh.is_on_rim[a] && m_ranks[a] < m_ranks[b]);
      pinched.push_back(first ? a : b);
    }
    return pinched;
  }

  // Labels pinched vertices: vertices of the boundary get inside, vertices of a subdomain or an interface get
  // the subdomain before it. Vertices on the rim can not be inside: the vertices around them are labeled
  // instead.
  bool relabel()
  {
    const Boundary_polygons polygons = internal::boundary_polygons(
      pieces, subdomains, m_number_of_subdomains > 1, [this](Vertex_index v) { return is_on_interface(v); });
    defects = manifold_defects(polygons.whole);
    bool changed = false;
    std::set<Vertex_index> on_rim;
    const auto relabel_each = [&](const std::vector<Vertex_index>& pinched, Subdomain_rank subdomain) {
      for(Vertex_index v : pinched)
        if(is_outside_on_rim(v))
          on_rim.insert(v);
        else
          changed = relabel(v, subdomain) || changed;
    };
    relabel_each(pinched_vertices(defects), outside_rank);
    on_rim.clear();
    for(const auto& [subdomain, its_polygons] : polygons.of_subdomains)
      relabel_each(pinched_vertices(manifold_defects(its_polygons)), subdomain);
    if(!changed)
      for(const auto& [pair, its_polygons] : polygons.of_interfaces)
        relabel_each(vertices_with_several_fans(its_polygons), pair.second);
    return changed || relabel_around(on_rim);
  }

  // Labels the vertices around with the first subdomain at one of the given vertices.
  bool relabel_around(const std::set<Vertex_index>& vertices)
  {
    bool changed = false;
    for(std::size_t i = 0; i < pieces.size() && !vertices.empty(); ++i)
      for(Vertex_index v : pieces[i])
        if(vertices.count(v) > 0)
          for(Vertex_index w : pieces[i])
            if(m_mesh.is_inside(w))
              changed = set_subdomain(w, m_around[v].begin()->first) || changed;
    return changed;
  }

  bool relabel(Vertex_index v, Subdomain_rank pinched)
  {
    Subdomain_rank label = 0;
    if(m_number_of_subdomains > 1) {
      const std::map<Subdomain_rank, int>& around = m_around[v];
      const auto mine = around.lower_bound(pinched);
      label = mine == around.begin() ? mine->first : std::prev(mine)->first;
    }
    return set_subdomain(v, label);
  }

  bool is_outside_on_rim(Vertex_index v) const { return m_mesh.is_on_rim[v] && !m_mesh.is_inside(v); }

  bool set_subdomain(Vertex_index v, Subdomain_rank label)
  {
    if(m_mesh.subdomain(v) <= label)
      return false;
    m_mesh.sides[v] = ON_BOUNDED_SIDE;
    m_mesh.subdomains[v] = label;
    ++number_of_relabeled_vertices;
    return true;
  }

  void count_vertices()
  {
    is_used.assign(m_mesh.vertices.size(), 0);
    for(Vertex_index v = 0; v < is_used.size(); ++v)
      is_used[v] = m_mesh.is_inside(v);
    for(Vertex_index v : pieces.connectivity())
      is_used[v] = 1;
    number_of_vertices = std::size_t(std::count(is_used.begin(), is_used.end(), 1));
  }
};

/*!
Runs the boundary stage. The result keeps exactly the elements that have a vertex inside, in pieces if they
have other vertices too, so that all boundary vertices are outside (or on) the surface. Pinched boundary
vertices are labeled inside until the boundary is a closed oriented 2-manifold; \c defects tells what remains:
defects can only be where a leaf around the vertex has no elements, at the border of the root cell or beside
dead leaves.

The same holds for each subdomain of a labeled domain, as if the subdomains after it were outside: an element
belongs to the first subdomain that has one of its vertices inside.

Elements at sheets are split too, and their pieces get compartments; the vertices of the result are the same.

\param mesh lattice mesh; the labels of pinched vertices change, and the paper's mode adds vertices
\param mode way to split; the paper's mode knows one subdomain only: several are split by the vertex order
\par Complexity
O(n + m log m) for n elements, m of them at the surface, plus m closest-point queries
*/
template <class Sheets = No_sheets>
Boundary_pieces split_boundary(const Located_octree& octree, Lattice_mesh& mesh, Boundary_mode mode,
                               unsigned threads = 1, Sheets sheets = Sheets())
{
  return Boundary_stage<Sheets>(octree, mesh, mode, threads, std::move(sheets)).result();
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_BOUNDARY_BOUNDARY_STAGE_H
