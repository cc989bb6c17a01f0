// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Conversion of the balanced octree to a conforming mixed mesh (section 5.2 of the paper): numbers the
// vertices, finds on which side of the surface they are, and replaces each cell by its template.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_TRANSITIONS_APPLY_TRANSITIONS_H
#define CGAL_MIXED_MESH_3_INTERNAL_TRANSITIONS_APPLY_TRANSITIONS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/transitions/Lattice_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Located_octree.h>
#include <CGAL/Mixed_mesh_3/internal/base/parallel_for.h>
#include <CGAL/Mixed_mesh_3/internal/transitions/transition_templates.h>
#include <CGAL/Mixed_mesh_3/options.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

namespace internal {

class Apply_transitions
{
  using Node_index = Octree::Node_index;
  // The vertices of a leaf on its 3x3x3 lattice; corners at even positions.
  using Leaf_vertices = std::array<Vertex_index, 27>;

  const Located_octree& m_located;
  const Octree& m_octree;
  const std::vector<std::uint16_t> m_patterns;
  // Slots of the leaves. A leaf without hanging vertices becomes one hexahedron, whose number is the slot of
  // the leaf; the slot of another leaf is its number in m_leaf_vertices.
  std::vector<std::uint32_t> m_slots;
  std::vector<Leaf_vertices> m_leaf_vertices;
  std::unordered_map<std::uint64_t, Vertex_index> m_inserted;
  Lattice_mesh m_mesh;

  static constexpr std::uint32_t no_slot = std::uint32_t(-1);
  static constexpr int cell_center = 13; // the point (1, 1, 1): 1 + 3 + 9

  bool is_used(Node_index n) const { return m_slots[n] != no_slot; }

public:
  explicit Apply_transitions(const Located_octree& octree)
    : m_located(octree), m_octree(octree.octree()), m_patterns(edge_patterns(m_octree))
  {
  }

  Lattice_mesh operator()(Transition_templates_choice choice, unsigned threads)
  {
    choose_leaves();
    number_vertices();
    m_mesh.first_inserted_vertex = m_mesh.vertices.size();
    add_transition_elements(choice);
    find_sides(threads);
    return std::move(m_mesh);
  }

private:
  // Chooses leaves that meet the domain, and dead leaves beside them: the boundary stage needs dead leaves if
  // it has to label one of their vertices inside.
  void choose_leaves()
  {
    m_slots.assign(m_octree.size(), no_slot);
    const Directions& directions = neighbor_directions(Adjacency::VERTEX);
    for(Node_index n = 0; n < m_octree.size(); ++n) {
      if(!m_octree.is_leaf(n))
        continue;
      const auto touches_domain = [&](const std::array<int, 3>& d) {
        const Node_index m = m_octree.neighbor(n, d);
        return m != Octree::no_node && (!m_octree.is_leaf(m) || m_located.meets_domain(m));
      };
      if(!m_located.meets_domain(n) && std::none_of(directions.begin(), directions.end(), touches_domain))
        continue;
      if(m_patterns[n] == 0) {
        m_slots[n] = std::uint32_t(m_mesh.cells.size());
        m_mesh.cells.push_back(n);
      } else {
        m_slots[n] = std::uint32_t(m_leaf_vertices.size());
        m_leaf_vertices.emplace_back();
        m_leaf_vertices.back().fill(Vertex_index(-1));
      }
    }
    m_mesh.elements.add_many(HEXAHEDRON, m_mesh.cells.size());
  }

  void number_vertices()
  {
    static constexpr int hexahedron_vertex[8] = {0, 1, 3, 2, 4, 5, 7, 6}; // for corners of cells
    m_octree.for_each_vertex([this](const Lattice_point& p, const std::array<Node_index, 8>& around) {
      // A leaf that does not meet the surface decides; the side of a vertex whose leaves all meet the surface
      // is asked for later.
      std::int8_t side = Lattice_mesh::unknown_side;
      Node_index leaf = Octree::no_node;
      bool is_on_rim = false;
      for(Node_index n : around)
        if(n != Octree::no_node && is_used(n)) {
          if(m_located.side(n) != ON_BOUNDARY)
            side = std::int8_t(m_located.side(n));
          if(leaf == Octree::no_node || m_located.side(n) == ON_BOUNDARY)
            leaf = n;
        } else {
          is_on_rim = true;
        }
      if(leaf == Octree::no_node)
        return;
      const Vertex_index v = m_mesh.add_vertex(p, side, leaf, is_on_rim);
      for(int i = 0; i < 8; ++i) {
        const Node_index n = around[i];
        if(n == Octree::no_node || !is_used(n))
          continue;
        if(m_patterns[n] == 0)
          m_mesh.elements.connectivity()[8 * std::size_t(m_slots[n]) + hexahedron_vertex[i ^ 7]] = v;
        else
          m_leaf_vertices[m_slots[n]][local_position(n, p)] = v;
      }
    });
  }

  int local_position(Node_index n, const Lattice_point& p) const
  {
    const Lattice_point& c = m_octree.corner(n);
    const int shift = Octree::max_level - m_octree.level(n);
    return int(((p[0] - c[0]) >> shift) + 3 * ((p[1] - c[1]) >> shift) + 9 * ((p[2] - c[2]) >> shift));
  }

  void add_transition_elements(Transition_templates_choice choice)
  {
    const Transition_templates& templates = Transition_templates::get();
    for(Node_index n = 0; n < m_octree.size(); ++n) {
      if(!is_used(n) || m_patterns[n] == 0)
        continue;
      Leaf_vertices& vertices = m_leaf_vertices[m_slots[n]];
      const bool centered = choice == Transition_templates_choice::CENTERED;
      for(const Template_element& e :
          centered ? templates.centered(m_patterns[n]) : templates[m_patterns[n]]) {
        std::array<Vertex_index, 8> v;
        for(int i = 0; i < e.size; ++i) {
          Vertex_index& u = vertices[e.vertices[i]];
          if(u == Vertex_index(-1))
            u = inserted_vertex(n, e.vertices[i]);
          v[i] = u;
        }
        m_mesh.elements.add(Element_kind(e.kind), v.data());
        m_mesh.cells.push_back(n);
      }
    }
  }

  // Inserts a vertex that the octree does not have: the center of the cell, or of a face whose four edges are
  // split while the cell behind the face is not; such a face center is shared by two leaves.
  Vertex_index inserted_vertex(Node_index n, int local)
  {
    const std::uint32_t half = m_octree.side(n) / 2;
    const Lattice_point& c = m_octree.corner(n);
    const Lattice_point p{c[0] + local % 3 * half, c[1] + local / 3 % 3 * half, c[2] + local / 9 * half};
    const auto [known, is_new] = m_inserted.try_emplace(lattice_key(p), Vertex_index(m_mesh.vertices.size()));
    if(is_new) {
      const Bounded_side side = m_located.side(n);
      m_mesh.add_vertex(p, side == ON_BOUNDARY ? Lattice_mesh::unknown_side : std::int8_t(side), n,
                        local != cell_center); // until the leaf behind the face asks for the vertex, too
    } else {
      m_mesh.is_on_rim[known->second] = false;
      if(m_located.side(n) != ON_BOUNDARY)
        m_mesh.sides[known->second] = std::int8_t(m_located.side(n));
    }
    return known->second;
  }

  void find_sides(unsigned threads)
  {
    std::vector<Vertex_index> unknown;
    for(Vertex_index v = 0; v < m_mesh.vertices.size(); ++v)
      if(m_mesh.sides[v] == Lattice_mesh::unknown_side)
        unknown.push_back(v);
    parallel_for(unknown.size(), threads, [&](std::size_t i) {
      const Vertex_index v = unknown[i];
      m_mesh.sides[v] = std::int8_t(
        m_located.domain().bounded_side(m_located.point(m_mesh.vertices[v]),
                                        m_located.surface_part(m_mesh.leaves[v])));
    });
    if(m_located.domain().is_labeled())
      parallel_for(m_mesh.vertices.size(), threads, [&](std::size_t i) {
        const Vertex_index v = Vertex_index(i);
        if(m_mesh.is_inside(v))
          m_mesh.subdomains[v] = m_located.subdomain_rank(m_mesh.vertices[v], m_mesh.leaves[v]);
      });
  }
};

/*!
Replaces the leaves of a balanced octree by hexahedra and transition templates.

Two leaves of the mesh agree on every face, because face splits depend on the face's split edges
only. Vertices get the side of the surface they are on; a vertex exactly on the surface has `ON_BOUNDARY`.

\par Complexity
Linear in the number of nodes, times the depth
*/
inline Lattice_mesh apply_transitions(const Located_octree& octree, Transition_templates_choice choice,
                                      unsigned threads = 1)
{
  return Apply_transitions(octree)(choice, threads);
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_TRANSITIONS_APPLY_TRANSITIONS_H
