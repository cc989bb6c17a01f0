// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The octree, in integers only. Nodes are in one array, the eight children of a node side by side; the octree
// does not know the geometry.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_OCTREE_OCTREE_H
#define CGAL_MIXED_MESH_3_INTERNAL_OCTREE_OCTREE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Lattice_point.h>

#include <CGAL/assertions.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

namespace internal {

/*!
An octree over the lattice [0, 2^21]^3. A cell of level `l` has side 2^(21-l), so that the center
of a cell of the deepest level, 20, still is a lattice point.

Children are numbered by their position: bit 0 is x, bit 1 is y, bit 2 is z.
*/
class Octree
{
public:
  using Node_index = std::uint32_t;

  static constexpr int max_level = deepest_octree_level;
  static constexpr std::uint32_t root_side = lattice_root_side;
  static constexpr Node_index no_node = Node_index(-1);

  Octree() : m_nodes(1) {}

  std::size_t size() const { return m_nodes.size(); }
  static constexpr Node_index root() { return 0; }
  bool is_leaf(Node_index n) const { return m_nodes[n].first_child == 0; }
  Node_index child(Node_index n, int i) const { return m_nodes[n].first_child + Node_index(i); }
  /// The parent of a node. \pre `n` is not the root
  Node_index parent(Node_index n) const { return m_parents[(n - 1) / 8]; }
  int level(Node_index n) const { return m_nodes[n].level; }
  const Lattice_point& corner(Node_index n) const { return m_nodes[n].corner; }
  std::uint32_t side(Node_index n) const { return side_at(level(n)); }
  static std::uint32_t side_at(int level) { return root_side >> level; }

  /// Splits a leaf into eight; returns the first child. Indices of other nodes stay valid.
  Node_index split(Node_index n)
  {
    CGAL_precondition(is_leaf(n) && level(n) < max_level);
    if(m_nodes.size() > std::size_t(no_node) - 8)
      throw std::length_error("Mixed_mesh_3: more than 2^32 octree nodes");
    const Node parent = m_nodes[n];
    const std::uint32_t half = side_at(parent.level + 1);
    const Node_index first = Node_index(m_nodes.size());
    m_nodes[n].first_child = first;
    m_parents.push_back(n);
    for(std::uint32_t i = 0; i < 8; ++i)
      m_nodes.push_back({{parent.corner[0] + (i & 1) * half, parent.corner[1] + (i >> 1 & 1) * half,
                          parent.corner[2] + (i >> 2) * half},
                         0,
                         std::uint8_t(parent.level + 1)});
    return first;
  }

  /// Undoes all splits but the first ones: those that made the nodes below `size`.
  void truncate(std::size_t size)
  {
    CGAL_precondition(size % 8 == 1 && size <= m_nodes.size());
    for(std::size_t i = (size - 1) / 8; i < m_parents.size(); ++i)
      m_nodes[m_parents[i]].first_child = 0;
    m_nodes.resize(size);
    m_parents.resize((size - 1) / 8);
  }

  /// The node of at most the level of `n` that covers the cell of the size of `n` next to it in
  /// direction `d` (components -1, 0, 1); `no_node` outside the root.
  Node_index neighbor(Node_index n, const std::array<int, 3>& d) const
  {
    const int l = level(n);
    Lattice_point p = corner(n);
    std::uint32_t difference = 0;
    for(int k = 0; k < 3; ++k) {
      p[k] += std::uint32_t(d[k]) * side_at(l); // modulo 2^32: below 0 becomes large
      if(p[k] >= root_side)
        return no_node;
      difference |= p[k] ^ corner(n)[k];
    }
    // The path goes up to the first common ancestor, whose children's bit is the highest that differs, and
    // down.
    int common = l;
    for(; difference >> (max_level + 1 - common) != 0; --common)
      n = parent(n);
    for(; common < l && !is_leaf(n); ++common) {
      const int bit = max_level - common;
      n = child(n, (p[0] >> bit & 1) | (p[1] >> bit & 1) << 1 | (p[2] >> bit & 1) << 2);
    }
    return n;
  }

  /*!
  Visits every vertex of the subdivision once, by descending cells, faces and edges together, with
  no search and no sorting: `visit(p, leaves)` gets the position and the eight leaves around it,
  `leaves[i]` on the upper side along axis `k` iff bit `k` of `i` is set, `no_node` outside the
  root. A leaf may occur several times. Linear in the number of leaves.
  */
  template <class Visitor>
  void for_each_vertex(const Visitor& visit) const
  {
    const Descent<Visitor> descend{*this, visit};
    const Node_index o = no_node, r = root();
    for(int axis = 0; axis < 3; ++axis) {
      descend.face(axis, {o, r});
      descend.face(axis, {r, o});
      for(int i = 0; i < 4; ++i) {
        std::array<Node_index, 4> around{o, o, o, o};
        around[i] = r;
        descend.edge(axis, around);
      }
    }
    for(int i = 0; i < 8; ++i) {
      std::array<Node_index, 8> around{o, o, o, o, o, o, o, o};
      around[i] = r;
      descend.vertex(around);
    }
    descend.cell(r);
  }

private:
  struct Node
  {
    Lattice_point corner{};
    Node_index first_child = 0; // 0: leaf (the root is nobody's child)
    std::uint8_t level = 0;
  };

  // The recursion of for_each_vertex(). A vertex is the center of exactly one refined cell, of one
  // face or edge with a refined cell beside it, or a corner of the root.
  template <class Visitor>
  struct Descent
  {
    const Octree& octree;
    const Visitor& visit;

    bool is_leaf(Node_index n) const { return n == no_node || octree.is_leaf(n); }
    Node_index child(Node_index n, int i) const { return is_leaf(n) ? n : octree.child(n, i); }

    void cell(Node_index n) const
    {
      if(is_leaf(n))
        return;
      for(int i = 0; i < 8; ++i)
        cell(child(n, i));
      for(int axis = 0; axis < 3; ++axis) {
        const int a = 1 << axis, b = 1 << (axis + 1) % 3, c = 1 << (axis + 2) % 3;
        for(int o : {0, b, c, b | c})
          face(axis, {child(n, o), child(n, o | a)});
        for(int o : {0, a})
          edge(axis, {child(n, o), child(n, o | b), child(n, o | c), child(n, o | b | c)});
      }
      std::array<Node_index, 8> around;
      for(int i = 0; i < 8; ++i)
        around[i] = child(n, i);
      vertex(around);
    }

    // The face orthogonal to `axis` between two cells of equal size (or larger leaves).
    void face(int axis, const std::array<Node_index, 2>& n) const
    {
      if(is_leaf(n[0]) && is_leaf(n[1]))
        return;
      const int a = 1 << axis, b = 1 << (axis + 1) % 3, c = 1 << (axis + 2) % 3;
      for(int o : {0, b, c, b | c})
        face(axis, {child(n[0], o | a), child(n[1], o)});
      // The edges in the face are along b, then along c; around an edge along k, bit 0 is axis k+1.
      for(int o : {0, b})
        edge((axis + 1) % 3,
             {child(n[0], o | a), child(n[0], o | a | c), child(n[1], o), child(n[1], o | c)});
      for(int o : {0, c})
        edge((axis + 2) % 3,
             {child(n[0], o | a), child(n[1], o), child(n[0], o | a | b), child(n[1], o | b)});
      std::array<Node_index, 8> around;
      for(int i = 0; i < 8; ++i)
        around[i] = child(n[i & a ? 1 : 0], i ^ a);
      vertex(around);
    }

    // The edge along `axis` between four cells; bit 0 of their number is axis+1, bit 1 axis+2.
    void edge(int axis, const std::array<Node_index, 4>& n) const
    {
      if(is_leaf(n[0]) && is_leaf(n[1]) && is_leaf(n[2]) && is_leaf(n[3]))
        return;
      const int a = 1 << axis, b = 1 << (axis + 1) % 3, c = 1 << (axis + 2) % 3;
      for(int o : {0, a})
        edge(axis, {child(n[0], o | b | c), child(n[1], o | c), child(n[2], o | b), child(n[3], o)});
      std::array<Node_index, 8> around;
      for(int i = 0; i < 8; ++i)
        around[i] = child(n[(i & b ? 1 : 0) | (i & c ? 2 : 0)], i ^ b ^ c);
      vertex(around);
    }

    void vertex(std::array<Node_index, 8> n) const
    {
      int finest = -1;
      for(int i = 0; i < 8; ++i) {
        while(!is_leaf(n[i]))
          n[i] = octree.child(n[i], i ^ 7);
        if(n[i] != no_node && (finest < 0 || octree.level(n[i]) > octree.level(n[finest])))
          finest = i;
      }
      Lattice_point p = octree.corner(n[finest]);
      for(int k = 0; k < 3; ++k)
        if(!(finest >> k & 1))
          p[k] += octree.side(n[finest]);
      visit(p, n);
    }
  };

  std::vector<Node> m_nodes;
  std::vector<Node_index> m_parents; // parents of groups of eight siblings
};

/// A number for each lattice point; sorts by x, then y, then z.
inline std::uint64_t lattice_key(const Lattice_point& p)
{
  constexpr std::uint64_t radix = Octree::root_side + 1;
  return (p[0] * radix + p[1]) * radix + p[2];
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_OCTREE_OCTREE_H
