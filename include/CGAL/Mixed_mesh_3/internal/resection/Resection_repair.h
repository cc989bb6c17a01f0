// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Repair of a set of elements to be removed: the rest has a manifold boundary, and no loose pieces.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_RESECTION_RESECTION_REPAIR_H
#define CGAL_MIXED_MESH_3_INTERNAL_RESECTION_RESECTION_REPAIR_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/Face.h>
#include <CGAL/Mixed_mesh_3/internal/elements/for_each_face.h>
#include <CGAL/Mixed_mesh_3/internal/elements/manifold_defects.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The elements around each vertex, and across each face.
class Element_adjacency
{
  std::vector<std::size_t> m_offsets;
  std::vector<Element_index> m_elements;
  std::vector<std::array<Element_index, 6>> m_neighbors;

public:
  /// \par Complexity
  /// Linear in the number of elements, if the number of elements at a vertex is bounded; 56 bytes per
  /// hexahedron
  Element_adjacency(const Element_list& elements, std::size_t number_of_vertices)
    : m_offsets(number_of_vertices + 1, 0), m_elements(elements.connectivity().size())
  {
    for(Vertex_index v : elements.connectivity())
      ++m_offsets[v + 1];
    for(std::size_t v = 0; v < number_of_vertices; ++v)
      m_offsets[v + 1] += m_offsets[v];
    std::vector<std::size_t> ends(m_offsets.begin(), m_offsets.end() - 1);
    for(Element_index e = 0; e < elements.size(); ++e)
      for(Vertex_index v : elements[e])
        m_elements[ends[v]++] = e;
    std::array<Element_index, 6> none;
    none.fill(no_element);
    m_neighbors.assign(elements.size(), none);
    for_each_face(elements, number_of_vertices, [this](const auto& group) {
      if(group.size() == 2) {
        m_neighbors[group.element(0)][std::size_t(group.local_index(0))] = group.element(1);
        m_neighbors[group.element(1)][std::size_t(group.local_index(1))] = group.element(0);
      }
    });
  }

  /// The elements of a vertex, in increasing order.
  const Element_index* begin(Vertex_index v) const { return m_elements.data() + m_offsets[v]; }
  const Element_index* end(Vertex_index v) const { return m_elements.data() + m_offsets[v + 1]; }

  /// The element across face `f` of an element; `no_element` on the boundary.
  Element_index neighbor(Element_index e, int f) const { return m_neighbors[e][std::size_t(f)]; }
};

/*!
Selection of the elements that have to be removed, and of those that have to stay after all.

*Pinched vertices.* The elements around a vertex form a sphere (together with the outside, if the vertex is on
the boundary): the surface of a small ball. On the sphere, the kept elements, and the other elements, form
fans: sets connected across faces. If there is one fan of each kind, the line between the fans is one closed
curve: a line that touched itself, or several lines, would cut one of the two fans (Jordan). So the boundary
is a manifold iff no vertex has a surplus fan of either kind; edges need no test of their own.

*Repair.* A move changes the state of an element at a pinched vertex, or of a fan, or (if neither suffices) of
two neighbors. A move is made only if the number of surplus fans falls, summed over all vertices of the move.
Of the possible moves, the one with the least cost for each fan is made: the cost is the volume that differs
from the request, where tissue that is taken without request counts twice as much as tissue that is left. (On
a brain of 660 vertices, with spheres as tumors, that takes a third less tissue without request than equal
weights, and changes 4 % more in all; with a factor of 4, the former gains nothing, and the latter grows by a
quarter.) Hence one element more or less is taken where cavities touch at an edge or a vertex; a hinge of
large parts is filled if few elements suffice, and small parts that dangle are taken.

*Termination.* The number of surplus fans is a natural number that each move decreases. If no move decreases
the number, an element at each vertex that is still pinched is removed for good, the one that adds least;
there are finitely many elements, and without elements no vertex is pinched. (On the same mesh, with random
sets of elements, this happens to one in 400 pinched vertices; with spheres it has not been seen.)

*Loose pieces.* A connected piece has whole fans at its vertices; without a piece, the fans around it that are
not kept become one fan. So the removal of pieces pinches no vertex. Pieces are removed before the repair,
which then need not consider them, and after the repair, in case it cuts a piece off.
*/
class Resection_repair
{
public:
  struct Piece
  {
    std::vector<Element_index> elements; // in increasing order
    double volume;
  };
  enum class State : std::uint8_t {
    KEPT,
    GONE,  // removed before
    ASKED, // removed as asked
    FLOATING,
    PINCH // removed in addition, and why
  };

private:
  const Element_list& m_elements;
  const std::size_t m_number_of_vertices;
  const std::vector<double>& m_volumes; // volumes of the elements
  const Element_adjacency m_adjacency;
  std::vector<State> m_states;
  std::vector<std::uint8_t> m_is_asked, m_is_locked; // for each element; locked: removed for good
  std::vector<Piece> m_floating;
  mutable std::vector<std::uint8_t> m_is_seen; // for each element; all 0 between calls
  mutable std::vector<Element_index> m_fan;

  static constexpr double cost_of_healthy_tissue = 2; // relative to the cost of requested tissue that is left

  using Move = std::vector<Element_index>; // elements that change their state

  enum class Effort {
    SMALL, // an element or a fan
    LARGE, // also two elements with a common face
    FORCED // removes something for good, whatever the number of fans becomes
  };

public:
  /// \param elements the mesh
  /// \param number_of_vertices number of vertices of the mesh
  /// \param volumes volumes of the elements
  /// \param states state of each element: `ASKED`, `GONE` or `KEPT`
  Resection_repair(const Element_list& elements, std::size_t number_of_vertices,
                   const std::vector<double>& volumes, std::vector<State> states)
    : m_elements(elements), m_number_of_vertices(number_of_vertices), m_volumes(volumes),
      m_adjacency(elements, number_of_vertices), m_states(std::move(states)), m_is_asked(elements.size()),
      m_is_locked(elements.size()), m_is_seen(elements.size())
  {
    for(std::size_t e = 0; e < elements.size(); ++e) {
      m_is_asked[e] = m_states[e] == State::ASKED;
      m_is_locked[e] = m_states[e] == State::GONE;
    }
  }

  const std::vector<State>& states() const { return m_states; }
  bool is_asked(Element_index e) const { return m_is_asked[e] != 0; }

  /// The floating pieces found so far.
  const std::vector<Piece>& floating() const { return m_floating; }

  /// Finds pieces that came loose: of each connected part of the elements that were there before, all pieces
  /// but the largest, or, among several largest ones, the first.
  /// \par Complexity
  /// Linear
  void find_floating(bool remove)
  {
    const auto was_there = [this](Element_index e) { return m_states[e] != State::GONE; };
    std::vector<std::size_t> part_of(m_elements.size());
    std::size_t number_of_parts = 0;
    for_each_component(was_there, [&](const std::vector<Element_index>& part) {
      for(Element_index e : part)
        part_of[e] = number_of_parts;
      ++number_of_parts;
    });
    std::vector<Piece> pieces;
    const std::size_t none = std::size_t(-1);
    std::vector<std::size_t> largest(number_of_parts, none);
    for_each_component([this](Element_index e) { return is_kept(e); },
                       [&](std::vector<Element_index>& piece) {
                         std::sort(piece.begin(), piece.end());
                         double volume = 0;
                         for(Element_index e : piece)
                           volume += m_volumes[e];
                         std::size_t& best = largest[part_of[piece.front()]];
                         if(best == none || volume > pieces[best].volume)
                           best = pieces.size();
                         pieces.push_back({std::move(piece), volume});
                       });
    for(std::size_t i = 0; i < pieces.size(); ++i)
      if(largest[part_of[pieces[i].elements.front()]] != i) {
        if(remove)
          remove_piece(pieces[i]);
        if(!pieces[i].elements.empty())
          m_floating.push_back(std::move(pieces[i]));
      }
  }

  /// \par Complexity
  /// Linear in the number of elements, plus a constant for each fan too many
  void remove_pinches()
  {
    std::vector<Vertex_index> todo, changed, stuck;
    for(Vertex_index v = 0; v < m_number_of_vertices; ++v)
      if(surplus(v) != 0)
        todo.push_back(v);
    while(!todo.empty()) {
      changed.clear(), stuck.clear();
      for(Vertex_index v : todo)
        while(surplus(v) != 0)
          if(!change_around(v, Effort::SMALL, changed)) {
            stuck.push_back(v);
            break;
          }
      for(Effort effort : {Effort::LARGE, Effort::FORCED})
        if(changed.empty())
          for(Vertex_index v : stuck)
            if(surplus(v) != 0)
              change_around(v, effort, changed);
      changed.insert(changed.end(), stuck.begin(), stuck.end());
      sort_and_unique(changed);
      todo.swap(changed);
    }
  }

  /// Number of vertices where the boundary is not a manifold, counted by its faces, independently of the
  /// functions above.
  /// \par Complexity
  /// O(n log n) for n boundary faces
  std::size_t number_of_pinched_vertices() const
  {
    std::vector<Face_vertices> polygons;
    for(Element_index e = 0; e < m_elements.size(); ++e)
      for(int f = 0; is_kept(e) && f < m_elements[e].reference().number_of_faces; ++f) {
        const Element_index neighbor = m_adjacency.neighbor(e, f);
        if(neighbor == no_element || !is_kept(neighbor))
          polygons.push_back(Face(m_elements, e, f).vertices());
      }
    Manifold_defects defects = manifold_defects(polygons);
    for(const auto& edge : defects.edges)
      defects.vertices.insert(defects.vertices.end(), edge.begin(), edge.end());
    sort_and_unique(defects.vertices);
    return defects.vertices.size();
  }

private:
  bool is_kept(Element_index e) const { return m_states[e] == State::KEPT; }

  static void sort_and_unique(std::vector<Vertex_index>& v)
  {
    std::sort(v.begin(), v.end());
    v.erase(std::unique(v.begin(), v.end()), v.end());
  }

  // Calls `visit(elements)` for sets of elements connected across faces, ordered by their first element.
  template <class Is_member, class Visitor>
  void for_each_component(const Is_member& is_member, const Visitor& visit) const
  {
    std::vector<Element_index> component;
    for(Element_index first = 0; first < m_elements.size(); ++first) {
      if(m_is_seen[first] || !is_member(first))
        continue;
      component.assign(1, first);
      m_is_seen[first] = 1;
      for(std::size_t i = 0; i < component.size(); ++i)
        for(int f = 0; f < 6; ++f) {
          const Element_index e = m_adjacency.neighbor(component[i], f);
          if(e != no_element && !m_is_seen[e] && is_member(e)) {
            m_is_seen[e] = 1;
            component.push_back(e);
          }
        }
      visit(component);
    }
    m_is_seen.assign(m_elements.size(), 0);
  }

  // Removes a piece. Elements that were requested, and put back by the repair, are removed as requested, and
  // not as part of the piece.
  void remove_piece(Piece& piece)
  {
    for(Element_index e : piece.elements) {
      m_states[e] = m_is_asked[e] ? State::ASKED : State::FLOATING;
      m_is_locked[e] = 1;
    }
    const auto is_asked = [this](Element_index e) { return m_is_asked[e] != 0; };
    piece.elements.erase(std::remove_if(piece.elements.begin(), piece.elements.end(), is_asked),
                         piece.elements.end());
    piece.volume = 0;
    for(Element_index e : piece.elements)
      piece.volume += m_volumes[e];
  }

  // Calls `visit(elements, is_outside)` for each fan at a vertex; `is_outside` tells whether some of its
  // faces there are on the boundary of the mesh.
  template <class Visitor>
  void for_each_fan(Vertex_index v, const Visitor& visit) const
  {
    for(const Element_index* first = m_adjacency.begin(v); first != m_adjacency.end(v); ++first) {
      if(m_is_seen[*first])
        continue;
      m_fan.assign(1, *first);
      m_is_seen[*first] = 1;
      bool is_outside = false;
      for(std::size_t i = 0; i < m_fan.size(); ++i) {
        const Element_view element = m_elements[m_fan[i]];
        for(int f = 0; f < element.reference().number_of_faces; ++f) {
          const Element_face& face = element.reference().faces[f];
          if(std::none_of(face.vertices, face.vertices + face.size, [&](int k) { return element[k] == v; }))
            continue;
          const Element_index e = m_adjacency.neighbor(m_fan[i], f);
          is_outside = is_outside || e == no_element;
          if(e != no_element && !m_is_seen[e] && is_kept(e) == is_kept(*first)) {
            m_is_seen[e] = 1;
            m_fan.push_back(e);
          }
        }
      }
      visit(m_fan, is_outside);
    }
    for(const Element_index* e = m_adjacency.begin(v); e != m_adjacency.end(v); ++e)
      m_is_seen[*e] = 0;
  }

  // The number of surplus fans at a vertex.
  std::size_t surplus(Vertex_index v) const
  {
    const auto is_kept_here = [this](Element_index e) { return is_kept(e); };
    if(std::all_of(m_adjacency.begin(v), m_adjacency.end(v), is_kept_here)) // as before
      return 0;
    std::size_t kept = 0, removed = 0, outside = 0;
    for_each_fan(v, [&](const std::vector<Element_index>& fan, bool is_outside) {
      kept += is_kept(fan.front());
      removed += !is_kept(fan.front()) && !is_outside;
      outside = outside || is_outside;
    });
    return kept == 0 ? 0 : kept - 1 + (removed + outside - 1);
  }

  std::size_t surplus(const std::vector<Vertex_index>& vertices) const
  {
    std::size_t sum = 0;
    for(Vertex_index v : vertices)
      sum += surplus(v);
    return sum;
  }

  // Changes the state of the elements of a move, which are all kept, or all removed.
  void flip(const Move& move)
  {
    for(Element_index e : move)
      m_states[e] = !is_kept(e) ? State::KEPT : m_is_asked[e] ? State::ASKED : State::PINCH;
  }

  // The increase of the volume that differs from the request, weighted.
  double cost(const Move& move) const
  {
    double sum = 0;
    for(Element_index e : move)
      sum += (is_kept(e) != (m_is_asked[e] != 0) ? 1 : -1) * (m_is_asked[e] ? 1 : cost_of_healthy_tissue)
             * m_volumes[e];
    return sum;
  }

  std::vector<Move> moves(Vertex_index v, Effort effort) const
  {
    std::vector<Move> moves;
    for_each_fan(v, [&](const std::vector<Element_index>& fan, bool is_outside) {
      const bool is_kept_here = is_kept(fan.front());
      if(!is_kept_here && effort == Effort::FORCED)
        return;
      const auto is_free = [&](Element_index e) { return is_kept_here || !m_is_locked[e]; };
      if(fan.size() > 1 && (is_kept_here || !is_outside) && std::all_of(fan.begin(), fan.end(), is_free))
        moves.push_back(fan);
      for(Element_index e : fan) {
        if(!is_free(e))
          continue;
        moves.push_back({e});
        for(int f = 0; f < 6 && effort == Effort::LARGE; ++f) {
          const Element_index other = m_adjacency.neighbor(e, f); // at the vertex or opposite to it
          if(other != no_element && is_kept(other) == is_kept_here && is_free(other))
            moves.push_back({e, other});
        }
      }
    });
    return moves;
  }

  // Makes the best move at a pinched vertex, if there is one; appends the vertices of the move.
  bool change_around(Vertex_index v, Effort effort, std::vector<Vertex_index>& changed)
  {
    const bool is_forced = effort == Effort::FORCED;
    Move best;
    double best_cost = 0;
    std::ptrdiff_t best_gain = 0;
    std::vector<Vertex_index> vertices;
    for(Move& move : moves(v, effort)) {
      vertices.clear();
      for(Element_index e : move)
        vertices.insert(vertices.end(), m_elements[e].begin(), m_elements[e].end());
      sort_and_unique(vertices);
      const double move_cost = cost(move);
      const std::size_t before = surplus(vertices);
      flip(move);
      const std::ptrdiff_t gain = std::ptrdiff_t(before) - std::ptrdiff_t(surplus(vertices));
      flip(move);
      if(!is_forced && gain <= 0)
        continue;
      if(best.empty()
         || (is_forced ? std::make_pair(-gain, move_cost) < std::make_pair(-best_gain, best_cost)
                       : move_cost * double(best_gain) < best_cost * double(gain))) {
        best = std::move(move);
        best_cost = move_cost;
        best_gain = gain;
      }
    }
    if(best.empty())
      return false;
    flip(best);
    for(Element_index e : best) {
      m_is_locked[e] = m_is_locked[e] || is_forced;
      changed.insert(changed.end(), m_elements[e].begin(), m_elements[e].end());
    }
    return true;
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_RESECTION_RESECTION_REPAIR_H
