// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// 2:1 balance: the "one-irregular" octree of section 5.2 of the paper, and the edge patterns by which
// transition templates are looked up.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_OCTREE_BALANCE_H
#define CGAL_MIXED_MESH_3_INTERNAL_OCTREE_BALANCE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/octree/Octree.h>
#include <CGAL/Mixed_mesh_3/options.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

namespace internal {

using Directions = std::vector<std::array<int, 3>>;

/// The directions to the neighbors of a cell across faces, edges, vertices.
inline const Directions& neighbor_directions(Adjacency adjacency)
{
  const auto directions_up_to = [](int largest_rank) {
    Directions directions;
    for(int x = -1; x <= 1; ++x)
      for(int y = -1; y <= 1; ++y)
        for(int z = -1; z <= 1; ++z) {
          const int rank = std::abs(x) + std::abs(y) + std::abs(z);
          if(rank >= 1 && rank <= largest_rank)
            directions.push_back({x, y, z});
        }
    return directions;
  };
  static const std::array<Directions, 3> all{directions_up_to(1), directions_up_to(2), directions_up_to(3)};
  return all[std::size_t(adjacency) - 1];
}

/*!
Splits leaves until no two leaves adjacent across `adjacency` differ by more than one level.

Dead cells are balanced like the others, so that every face between two cells is either whole or
split in four. A refined cell asks for neighbors of its own size; from the deepest level up, each refined cell
is looked at once.

\param refined the nodes split since the octree was last balanced
\param split called as `split(node)` to split a leaf, so that the caller can keep data per node
\par Complexity
Linear in the number of refined nodes, times the depth
*/
template <class Split>
void balance(const Octree& octree, const std::vector<Octree::Node_index>& refined, Adjacency adjacency,
             const Split& split)
{
  const Directions& directions = neighbor_directions(adjacency);
  std::array<std::vector<Octree::Node_index>, Octree::max_level + 1> queue;
  for(Octree::Node_index n : refined)
    queue[octree.level(n)].push_back(n);
  for(int level = Octree::max_level; level > 0; --level)
    for(Octree::Node_index n : queue[level])
      for(const auto& d : directions)
        for(;;) {
          const Octree::Node_index m = octree.neighbor(n, d);
          if(m == Octree::no_node || octree.level(m) == level)
            break;
          split(m);
          queue[octree.level(m)].push_back(m);
        }
}

/// Whether all neighbors of split nodes are at least as small as these nodes, as `balance()` leaves them.
inline bool are_balanced(const Octree& octree, const std::vector<Octree::Node_index>& refined,
                         Adjacency adjacency)
{
  const Directions& directions = neighbor_directions(adjacency);
  return std::all_of(refined.begin(), refined.end(), [&](Octree::Node_index n) {
    return std::all_of(directions.begin(), directions.end(), [&](const std::array<int, 3>& d) {
      const Octree::Node_index m = octree.neighbor(n, d);
      return m == Octree::no_node || octree.level(m) == octree.level(n);
    });
  });
}

/// Edge patterns: for each node that is a leaf, bit `e` tells that edge `e` has a vertex in its
/// middle (numbering in transition_templates.h). \pre the octree is balanced across edges
inline std::vector<std::uint16_t> edge_patterns(const Octree& octree)
{
  // The bits of the edges that a leaf shares with its neighbor in direction -d.
  const Directions& directions = neighbor_directions(Adjacency::EDGE);
  std::vector<std::uint16_t> shared;
  for(const auto& d : directions) {
    std::uint16_t bits = 0;
    for(int e = 0; e < 12; ++e) {
      const int axis = e / 4, k1 = axis == 0 ? 1 : 0, k2 = axis == 2 ? 1 : 2;
      const int side1 = e % 2 ? 1 : -1, side2 = e % 4 / 2 ? 1 : -1;
      if(d[axis] == 0 && (d[k1] == 0 || d[k1] == -side1) && (d[k2] == 0 || d[k2] == -side2))
        bits = std::uint16_t(bits | 1 << e);
    }
    shared.push_back(bits);
  }
  std::vector<std::uint16_t> patterns(octree.size(), 0);
  for(Octree::Node_index n = 0; n < octree.size(); ++n) {
    if(octree.is_leaf(n))
      continue;
    for(std::size_t i = 0; i < directions.size(); ++i) {
      const Octree::Node_index m = octree.neighbor(n, directions[i]);
      if(m != Octree::no_node && octree.is_leaf(m))
        patterns[m] = std::uint16_t(patterns[m] | shared[i]);
    }
  }
  return patterns;
}

} // namespace internal

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_OCTREE_BALANCE_H
