// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The octree, its balance and its edge patterns, compared with brute force over all nodes: neighbor() is used
// only where it is tested.

#include <CGAL/Mixed_mesh_3/internal/octree/Octree.h>
#include <CGAL/Mixed_mesh_3/internal/octree/balance.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace test_octree {

using CGAL::Mixed_meshes_3::Adjacency;
using CGAL::Mixed_meshes_3::Lattice_point;
using CGAL::Mixed_meshes_3::internal::Octree;
using CGAL::Mixed_meshes_3::internal::balance;
using CGAL::Mixed_meshes_3::internal::edge_patterns;
using CGAL::Mixed_meshes_3::internal::neighbor_directions;

using Node_index = Octree::Node_index;

// A cell without an octree around it.
struct Cell
{
  Lattice_point corner;
  int level;
  std::uint32_t side() const { return Octree::root_side >> level; }
  bool operator<(const Cell& c) const { return std::tie(corner, level) < std::tie(c.corner, c.level); }
  bool operator==(const Cell& c) const { return corner == c.corner && level == c.level; }
};

Cell cell(const Octree& octree, Node_index n) { return {octree.corner(n), octree.level(n)}; }

// Whether a half-open cell contains a position, so that exactly one leaf contains a position inside the root.
bool contains(const Cell& c, const Lattice_point& p)
{
  for(int k = 0; k < 3; ++k)
    if(p[k] < c.corner[k] || p[k] - c.corner[k] >= c.side())
      return false;
  return true;
}

std::vector<Node_index> leaves(const Octree& octree)
{
  std::vector<Node_index> result;
  for(Node_index n = 0; n < octree.size(); ++n)
    if(octree.is_leaf(n))
      result.push_back(n);
  return result;
}

std::vector<Node_index> refined_nodes(const Octree& octree)
{
  std::vector<Node_index> result;
  for(Node_index n = 0; n < octree.size(); ++n)
    if(!octree.is_leaf(n))
      result.push_back(n);
  return result;
}

std::vector<Cell> leaf_cells(const Octree& octree)
{
  std::vector<Cell> result;
  for(Node_index n : leaves(octree))
    result.push_back(cell(octree, n));
  std::sort(result.begin(), result.end());
  return result;
}

Node_index leaf_at(const Octree& octree, const Lattice_point& p)
{
  Node_index n = Octree::root();
  while(!octree.is_leaf(n))
    for(int i = 0; i < 8; ++i)
      if(contains(cell(octree, octree.child(n, i)), p)) {
        n = octree.child(n, i);
        break;
      }
  return n;
}

// ---- random octrees ----------------------------------------------------------------------------

Octree scattered(std::mt19937& random, int n)
{
  Octree octree;
  for(int i = 0; i < n; ++i) {
    const std::vector<Node_index> l = leaves(octree);
    const Node_index leaf = l[random() % l.size()];
    if(octree.level(leaf) < Octree::max_level)
      octree.split(leaf);
  }
  return octree;
}

// Descends to a level at a point, which may be on the border of the root or next to its middle.
void descend_to(Octree& octree, const Lattice_point& p, int level)
{
  for(;;) {
    const Node_index n = leaf_at(octree, p);
    if(octree.level(n) >= level)
      return;
    octree.split(n);
  }
}

std::vector<Octree> random_octrees(unsigned seed)
{
  std::mt19937 random(seed);
  const auto coordinate = [&] { return std::uint32_t(random() % Octree::root_side); };
  constexpr std::uint32_t last = Octree::root_side - 1, middle = Octree::root_side / 2;
  std::vector<Octree> octrees(2);
  octrees[1].split(Octree::root());
  for(int n : {5, 20, 60})
    octrees.push_back(scattered(random, n));
  // The octrees are narrow: the worst for balance.
  for(const Lattice_point& p :
      {Lattice_point{0, 0, 0}, Lattice_point{last, last, 0}, Lattice_point{middle, middle, middle},
       Lattice_point{middle - 1, middle, 0}, Lattice_point{coordinate(), coordinate(), coordinate()}}) {
    octrees.emplace_back();
    descend_to(octrees.back(), p, Octree::max_level);
  }
  octrees.push_back(scattered(random, 10));
  for(int i = 0; i < 3; ++i)
    descend_to(octrees.back(), {coordinate(), coordinate(), coordinate()}, 5 + 4 * i);
  return octrees;
}

// ---- the octree --------------------------------------------------------------------------------

void test_structure(const Octree& octree)
{
  std::uint64_t volume = 0;
  for(Node_index n = 0; n < octree.size(); ++n) {
    BOOST_TEST_EQ(octree.side(n), Octree::root_side >> octree.level(n));
    if(octree.is_leaf(n)) {
      volume += std::uint64_t(octree.side(n)) * octree.side(n) * octree.side(n);
      continue;
    }
    for(int i = 0; i < 8; ++i) {
      const Node_index c = octree.child(n, i);
      BOOST_TEST_EQ(octree.parent(c), n);
      BOOST_TEST_EQ(octree.level(c), octree.level(n) + 1);
      for(int k = 0; k < 3; ++k)
        BOOST_TEST_EQ(octree.corner(c)[k], octree.corner(n)[k] + (i >> k & 1 ? octree.side(c) : 0));
    }
  }
  BOOST_TEST_EQ(volume, std::uint64_t(1) << 3 * (Octree::max_level + 1));
}

void test_neighbors(const Octree& octree)
{
  for(Node_index n = 0; n < octree.size(); ++n)
    for(const auto& d : neighbor_directions(Adjacency::VERTEX)) {
      std::array<std::int64_t, 3> p;
      bool is_in_root = true;
      for(int k = 0; k < 3; ++k) {
        p[k] = std::int64_t(octree.corner(n)[k]) + d[k] * std::int64_t(octree.side(n));
        is_in_root = is_in_root && p[k] >= 0 && p[k] < Octree::root_side;
      }
      Node_index expected = Octree::no_node;
      if(is_in_root) {
        const Lattice_point q{std::uint32_t(p[0]), std::uint32_t(p[1]), std::uint32_t(p[2])};
        for(Node_index m = 0; m < octree.size(); ++m)
          if(octree.level(m) <= octree.level(n) && contains(cell(octree, m), q)
             && (expected == Octree::no_node || octree.level(m) > octree.level(expected)))
            expected = m;
      }
      BOOST_TEST_EQ(octree.neighbor(n, d), expected);
    }
}

std::set<Lattice_point> corners_of_leaves(const Octree& octree)
{
  std::set<Lattice_point> corners;
  for(Node_index n : leaves(octree))
    for(std::uint32_t i = 0; i < 8; ++i) {
      Lattice_point p = octree.corner(n);
      for(int k = 0; k < 3; ++k)
        p[k] += (i >> k & 1) * octree.side(n);
      corners.insert(p);
    }
  return corners;
}

void test_vertices(const Octree& octree)
{
  std::map<Lattice_point, std::array<Node_index, 8>> visited;
  octree.for_each_vertex([&](const Lattice_point& p, const std::array<Node_index, 8>& around) {
    BOOST_TEST(visited.emplace(p, around).second); // once only
  });
  const std::set<Lattice_point> expected = corners_of_leaves(octree);
  BOOST_TEST_EQ(visited.size(), expected.size());
  for(const auto& [p, around] : visited) {
    BOOST_TEST_EQ(expected.count(p), 1u);
    for(std::uint32_t i = 0; i < 8; ++i) {
      // The lattice cell of side 1 is on that side of the vertex.
      Lattice_point q;
      bool is_in_root = true;
      for(int k = 0; k < 3; ++k) {
        const bool upper = i >> k & 1;
        is_in_root = is_in_root && (upper ? p[k] < Octree::root_side : p[k] > 0);
        q[k] = upper ? p[k] : p[k] - 1;
      }
      BOOST_TEST_EQ(around[i], is_in_root ? leaf_at(octree, q) : Octree::no_node);
    }
  }
}

// ---- balance -----------------------------------------------------------------------------------

// The rank: 1 if the closed boxes share a part of a face, 2: of an edge, 3: a vertex only, 0: nothing.
int rank_of_contact(const Cell& a, const Cell& b)
{
  int rank = 0;
  for(int k = 0; k < 3; ++k) {
    const std::uint32_t lower = (std::max)(a.corner[k], b.corner[k]);
    const std::uint32_t upper = (std::min)(a.corner[k] + a.side(), b.corner[k] + b.side());
    if(lower > upper)
      return 0;
    rank += lower == upper;
  }
  return rank;
}

// Whether cells are balanced, by the boxes of all pairs of leaves.
bool is_balanced(const std::vector<Cell>& cells, Adjacency adjacency)
{
  for(const Cell& a : cells)
    for(const Cell& b : cells)
      if(a.level + 1 < b.level) {
        const int rank = rank_of_contact(a, b);
        if(rank > 0 && rank <= int(adjacency))
          return false;
      }
  return true;
}

// The coarsest balanced refinement: a cell that is too large for one of its neighbors is too large for any
// refinement of the neighbor, so that it has to be split in any refinement.
std::vector<Cell> naively_balanced(std::vector<Cell> cells, Adjacency adjacency)
{
  for(bool changed = true; changed;) {
    std::vector<Cell> result;
    for(const Cell& a : cells) {
      const bool is_too_large = std::any_of(cells.begin(), cells.end(), [&](const Cell& b) {
        if(a.level + 1 >= b.level)
          return false;
        const int rank = rank_of_contact(a, b);
        return rank > 0 && rank <= int(adjacency);
      });
      if(!is_too_large) {
        result.push_back(a);
        continue;
      }
      for(std::uint32_t i = 0; i < 8; ++i) {
        Cell child{a.corner, a.level + 1};
        for(int k = 0; k < 3; ++k)
          child.corner[k] += (i >> k & 1) * child.side();
        result.push_back(child);
      }
    }
    changed = result.size() != cells.size();
    cells = std::move(result);
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

Octree balanced(Octree octree, Adjacency adjacency)
{
  balance(octree, refined_nodes(octree), adjacency, [&](Node_index n) { octree.split(n); });
  return octree;
}

// Returns how many of the octrees were not balanced before.
int test_balance(const Octree& octree, std::mt19937& random)
{
  const std::vector<Cell> before = leaf_cells(octree);
  int number_unbalanced = 0;
  for(Adjacency adjacency : {Adjacency::FACE, Adjacency::EDGE, Adjacency::VERTEX}) {
    number_unbalanced += !is_balanced(before, adjacency);
    const Octree after = balanced(octree, adjacency);
    const std::vector<Cell> cells = leaf_cells(after);
    BOOST_TEST(is_balanced(cells, adjacency));
    BOOST_TEST(cells == naively_balanced(before, adjacency));
    BOOST_TEST(leaf_cells(balanced(after, adjacency)) == cells);

    // Only new nodes have to be looked at from one balanced octree to the next.
    Octree next = after;
    std::vector<Node_index> refined;
    for(Node_index n : leaves(after))
      if(random() % 16 == 0 && next.level(n) < Octree::max_level) {
        next.split(n);
        refined.push_back(n);
      }
    Octree all = next;
    balance(next, refined, adjacency, [&](Node_index n) { next.split(n); });
    BOOST_TEST(leaf_cells(next) == leaf_cells(balanced(all, adjacency)));
    if(cells.size() < 1000)
      BOOST_TEST(is_balanced(leaf_cells(next), adjacency));
  }
  const Octree by_edges = balanced(octree, Adjacency::EDGE);
  const Octree by_faces_then_edges = balanced(balanced(octree, Adjacency::FACE), Adjacency::EDGE);
  BOOST_TEST(leaf_cells(by_edges) == leaf_cells(by_faces_then_edges));
  return number_unbalanced;
}

// An edge is split iff its middle is the corner of a leaf.
std::size_t test_edge_patterns(const Octree& octree)
{
  const std::set<Lattice_point> vertices = corners_of_leaves(octree);
  const std::vector<std::uint16_t> patterns = edge_patterns(octree);
  BOOST_TEST_EQ(patterns.size(), octree.size());
  // The numbers are those of the drawing of transition_templates.h.
  static constexpr int midpoints[12] = {1, 7, 19, 25, 3, 5, 21, 23, 9, 11, 15, 17};
  std::set<int> seen;
  for(Node_index n : leaves(octree)) {
    int expected = 0;
    const std::uint32_t half = octree.side(n) / 2;
    for(int e = 0; e < 12; ++e) {
      const std::uint32_t m = std::uint32_t(midpoints[e]);
      const Lattice_point& c = octree.corner(n);
      expected |= int(vertices.count({c[0] + m % 3 * half, c[1] + m / 3 % 3 * half, c[2] + m / 9 * half}))
                  << e;
    }
    BOOST_TEST_EQ(int(patterns[n]), expected);
    seen.insert(expected);
  }
  return seen.size();
}

int run(int, char*[])
{
  int number_unbalanced = 0;
  std::size_t most_patterns = 0;
  for(unsigned seed : {1u, 2u}) {
    std::mt19937 random(seed);
    for(const Octree& octree : random_octrees(seed)) {
      test_structure(octree);
      test_neighbors(octree);
      test_vertices(octree);
      number_unbalanced += test_balance(octree, random);
      const Octree by_edges = balanced(octree, Adjacency::EDGE);
      test_structure(by_edges);
      test_vertices(by_edges);
      if(by_edges.size() < 1500)
        test_neighbors(by_edges);
      most_patterns = (std::max)(most_patterns, test_edge_patterns(by_edges));
      test_edge_patterns(balanced(octree, Adjacency::VERTEX));
    }
  }
  // The octrees are not trivial.
  BOOST_TEST_GE(number_unbalanced, 40);
  BOOST_TEST_GE(most_patterns, 50u);
  return boost::report_errors();
}

} // namespace test_octree
