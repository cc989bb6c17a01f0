// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Changes of a working mesh that are accepted, or undone, as a whole.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MOVES_TRANSACTION_H
#define CGAL_MIXED_MESH_3_INTERNAL_MOVES_TRANSACTION_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/moves/Working_mesh.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
A move opens a transaction, makes its changes by it, and asks for acceptance. Changes that are not accepted
when the transaction ends are undone: the working mesh is the same to the byte then, with the elements around
each vertex in the same order, so that what follows does not depend on moves that have failed. The cost is
proportional to what is changed.

A transaction may be opened within another one: changes that the inner one accepts become changes of the outer
one, which may still undo them. Positions that `Vertex_optimizer` changes are not among them. Acceptance does
not look at the topology, which moves have to keep.
*/
class Transaction
{
  Working_mesh& m_mesh;
  Transaction* const m_outer;
  struct Changes
  {
    std::vector<std::function<void(Working_mesh&)>> undo; // each undoes a change after all later ones
    std::vector<Element_index> added, removed;
    std::map<Vertex_index, Vec3> moved; // positions before
  } m_changes;

public:
  explicit Transaction(Working_mesh& mesh) : m_mesh(mesh), m_outer(std::exchange(mesh.transaction, this)) {}
  Transaction(const Transaction&) = delete;
  ~Transaction()
  {
    roll_back();
    m_mesh.transaction = m_outer;
  }

  void add(const Working_mesh::Element& element)
  {
    m_changes.added.push_back(m_mesh.add(element));
    m_changes.undo.emplace_back([](Working_mesh& mesh) { mesh.remove_last(); });
  }

  void remove(Element_index e)
  {
    m_changes.removed.push_back(e);
    const auto places = m_mesh.remove(e);
    m_changes.undo.emplace_back([e, places](Working_mesh& mesh) { mesh.put_back(e, places); });
  }

  void set_attributes(Element_index e, const Element_attributes& attributes)
  {
    const Element_attributes before = std::exchange(m_mesh.elements[e].attributes, attributes);
    m_changes.undo.emplace_back([e, before](Working_mesh& mesh) { mesh.elements[e].attributes = before; });
  }

  Vertex_index add_vertex(const Vec3& p, Stratum stratum, const Working_mesh::Edge& bisected)
  {
    m_mesh.add_vertex(p, stratum, bisected);
    m_changes.undo.emplace_back([](Working_mesh& mesh) { mesh.remove_last_vertex(); });
    return Vertex_index(m_mesh.points.size() - 1);
  }

  void move(Vertex_index v, const Vec3& p)
  {
    const Vec3 before = std::exchange(m_mesh.points[v], p);
    m_changes.moved.emplace(v, before);
    m_changes.undo.emplace_back([v, before](Working_mesh& mesh) { mesh.points[v] = before; });
  }

  void set_stratum(Vertex_index v, Stratum stratum)
  {
    const Stratum before = std::exchange(m_mesh.strata[v], stratum);
    m_changes.undo.emplace_back([v, before](Working_mesh& mesh) { mesh.strata[v] = before; });
  }

  /// \param stratum `free_stratum`: the edge is not sharp any more
  void set_sharp_edge(Vertex_index a, Vertex_index b, Stratum stratum)
  {
    const auto set = [a, b](Working_mesh& mesh, Stratum s) {
      mesh.sharp_edges[std::minmax(a, b)] = s;
      if(s == free_stratum)
        mesh.sharp_edges.erase(std::minmax(a, b));
    };
    const Stratum before = m_mesh.sharp_stratum(a, b);
    m_changes.undo.emplace_back([set, before](Working_mesh& mesh) { set(mesh, before); });
    set(m_mesh, stratum);
  }

  /// Makes the edges of a vertex not sharp: all sharp edges of the mesh are looked at, if the vertex is on
  /// one.
  void leave_sharp_edges(Vertex_index v, Stratum stratum)
  {
    if(m_mesh.strata[v] < first_sharp_stratum)
      return set_stratum(v, stratum);
    for(auto e = m_mesh.sharp_edges.begin(); e != m_mesh.sharp_edges.end();)
      if(const auto [a, b] = (e++)->first; a == v || b == v)
        set_sharp_edge(a, b, free_stratum);
    set_stratum(v, stratum);
  }

  /// Notes that another vertex takes the place of this one. \pre the vertex has no elements any more
  void merge(Vertex_index v)
  {
    CGAL_precondition(m_mesh.incident[v].empty());
    leave_sharp_edges(v, free_stratum);
    m_mesh.merged.push_back(v);
    m_changes.undo.emplace_back([](Working_mesh& mesh) { mesh.merged.pop_back(); });
  }

  /// The largest cost before the changes of the elements that they replace.
  template <class Quality>
  double worst_before(const Quality& quality) const
  {
    const auto position = [&](Vertex_index v) {
      const auto found = m_changes.moved.find(v);
      return found == m_changes.moved.end() ? m_mesh.points[v] : found->second;
    };
    double worst = 0;
    for(Element_index e : with_moved_elements(m_changes.removed))
      if(!std::binary_search(m_changes.added.begin(), m_changes.added.end(), e))
        worst = (std::max)(worst,
                           quality(m_mesh.elements[e].kind, relative_points(m_mesh.elements[e], position)));
    return worst;
  }

  /// Accepts the changes if all elements that were added, or whose vertices were moved, cost at most `most`
  /// and are proved positive; undoes them otherwise.
  /// \param most the bound in force, or `worst_before()` if that is more and elements may be as bad
  template <class Quality>
  bool accept(const Quality& quality, double most)
  {
    const std::vector<Element_index> changed = with_moved_elements(m_changes.added);
    const bool is_good = std::all_of(changed.begin(), changed.end(), [&](Element_index e) {
      const Working_mesh::Element& element = m_mesh.elements[e];
      return element.is_removed
             || (quality(element.kind, m_mesh.relative_points(element)) <= most
                 && m_mesh.is_positive(element));
    });
    is_good ? keep() : roll_back();
    return is_good;
  }

  /// Accepts changes that change no element, or that inner transactions have accepted.
  void keep()
  {
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    if(m_outer != nullptr) {
      append(m_outer->m_changes.undo, m_changes.undo);
      append(m_outer->m_changes.added, m_changes.added);
      append(m_outer->m_changes.removed, m_changes.removed);
      m_outer->m_changes.moved.insert(m_changes.moved.begin(), m_changes.moved.end());
    }
    m_changes = {};
  }

  /// Undoes the changes that are not accepted.
  void roll_back()
  {
    CGAL_assertion(m_mesh.transaction == this);
    std::for_each(m_changes.undo.rbegin(), m_changes.undo.rend(), [this](const auto& undo) { undo(m_mesh); });
    m_changes = {};
  }

private:
  // Elements, with those around moved vertices, each once.
  std::vector<Element_index> with_moved_elements(std::vector<Element_index> elements) const
  {
    for(const auto& [v, before] : m_changes.moved)
      elements.insert(elements.end(), m_mesh.incident[v].begin(), m_mesh.incident[v].end());
    std::sort(elements.begin(), elements.end());
    elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
    return elements;
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MOVES_TRANSACTION_H
