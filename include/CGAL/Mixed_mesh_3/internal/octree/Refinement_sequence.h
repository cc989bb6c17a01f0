// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The order in which cells are split: first the cell where a vertex removes most of the error.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_OCTREE_REFINEMENT_SEQUENCE_H
#define CGAL_MIXED_MESH_3_INTERNAL_OCTREE_REFINEMENT_SEQUENCE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/octree/Located_octree.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Octree.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/weight_in_region.h>

#include <CGAL/enum.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The radius of a ball with the volume that the region has in common with the domain, by the centers of some
/// hundred cells; 0 if region and domain do not meet. If the region is too thin for that, a bound by the
/// number of cells that meet the region.
/// \param root the octree with nothing but its root
inline double mean_radius_of_region(const Located_octree& root)
{
  // An error of a tenth in the count of 100 cells is one of 3 % in the radius.
  constexpr std::size_t sufficient_number = 100, largest_number = 20000;
  const auto radius_of = [](double number, double edge) { return std::cbrt(0.75 / M_PI * number) * edge; };
  double radius = 0;
  Located_octree octree = root;
  for(int level = 0; level < Octree::max_level; ++level) {
    const std::vector<Octree::Node_index> leaves = octree.leaves_to_refine(level, true);
    const auto count = std::count_if(leaves.begin(), leaves.end(),
                                     [&](Octree::Node_index n) { return octree.depth_in_region(n) >= 0; });
    if(count > 0)
      radius = radius_of(double(count), octree.edge_length(leaves.front()));
    if(leaves.empty() || std::size_t(count) >= sufficient_number)
      break;
    if(leaves.size() > largest_number) // the region lies between their centers
      return count > 0 ? radius : radius_of(double(leaves.size()), octree.edge_length(leaves.front()));
    octree.refine(leaves);
  }
  return radius;
}

/*!
The splits of an octree, in the order of a key: the error that a vertex removes if it is spent in the cell.

The error of a functional of the solution in the region, for linear elements, is the sum of w h^2 over the
volume, where w is the product of the second derivatives of the solution and of the functional's influence;
splitting a cell of side h removes error w h^5 and costs a fixed number of vertices. Outside the region w
falls like a power of the distance d: the key is (1 + d / r)^-6 h^5, times the weight that the region gives
the place. With r = 0 this is the rule of the paper: cells that meet the region are split, the largest first.

Cells at the surface come two levels of 32^(1/2) earlier: displacements are prescribed there and elements are
tetrahedra, which are less accurate. In a graded region they come a whole level earlier, and so do, by less,
cells below them: errors of displacements that are prescribed at a patch are largest there. Cells at the
surface also remove volume between the surface and the boundary, which falls like h^4: so they get a share of
the error that does not depend on the region.

Cells at sharp edges come first without a region, up to a level finer than others at the surface, and cells of
equal keys are split here and there, so that the last level is not at one end.

The octree after any number of steps is a prefix of the octree after all steps, as nodes of an octree are
numbered in the order of the splits.
*/
class Refinement_sequence
{
  using Node_index = Octree::Node_index;
  // Entries of equal keys are ordered by depth in the region, the deepest first, then by lattice position.
  using Entry = std::tuple<double, double, std::uint64_t, Node_index>;

public:
  // Factors measured like the exponent. Outside a region and without one, factors from 2 to 16 differ by less
  // than 10 %. With ten times the weight of the volume, a sixth fewer vertices are left for the region at
  // 10,000 vertices; with 3e-4, 0.47 % of the volume are missing instead of 0.44.
  static constexpr double factor_at_surface = 4, weight_of_volume = 4e-4;
  // Factor at the surface in the region, and by how much it falls for each level up to the ancestor that
  // meets the surface: 32, 8, 2, 1. With 4 and 1 alone, errors of a bump are larger by an eighth at 2,000 and
  // 10,000 vertices; 16 at the surface alone gains a hundredth. With 128, 32 and 4, those at
  // 10,000 vertices are nearly as large as with 4, and smooth ones by a quarter larger.
  static constexpr double factor_at_surface_in_region = 32, fall_of_factor = 4;
  // Factor by which cells at sharp edges come a level, of 32^(1/2), before those at the surface, as these
  // come before those inside.
  static constexpr double factor_at_sharp_edges = 16;

  using Point = Located_octree::Point_3;

private:
  Located_octree m_octree; // octree after all steps
  const double m_radius;
  std::vector<double> m_depths;     // depth of each node in the region
  std::vector<std::size_t> m_sizes; // numbers of nodes, and of leaves that meet the domain, after each step
  std::vector<std::size_t> m_cells;
  std::vector<Node_index> m_split;          // cell that each step splits
  const bool m_is_everywhere;               // whether the region is everywhere
  std::vector<std::vector<Point>> m_points; // points on sharp edges in each node
  std::priority_queue<Entry> m_queue;

public:
  /// \param start octree with the splits that have been made already
  /// \param radius the distance from the region at which the weight has fallen to 2^-6; 0: the region only
  /// \param points points on sharp edges, at distances less than cell sizes; points count without a region
  /// only
  Refinement_sequence(Located_octree start, double radius, std::vector<Point> points = {})
    : m_octree(std::move(start)), m_radius(radius), m_is_everywhere(m_octree.is_region_everywhere())
  {
    if(m_is_everywhere && !points.empty())
      m_points.push_back(std::move(points));
    append(0, 0);
  }

  std::size_t number_of_steps() const { return m_split.size(); }
  /// The number of leaves that meet the domain after some steps.
  std::size_t number_of_cells(std::size_t steps) const { return m_cells[steps]; }
  /// The first step after which there are so many cells; the last one if there is none.
  std::size_t first_step_with(double number_of_cells) const
  {
    const auto found = std::partition_point(m_cells.begin(), m_cells.end() - 1, [&](std::size_t cells) {
      return double(cells) < number_of_cells;
    });
    return std::size_t(found - m_cells.begin());
  }
  /// The number of nodes after some steps.
  std::size_t number_of_nodes(std::size_t steps) const { return m_sizes[steps]; }
  /// The cell that a step splits.
  Node_index cell(std::size_t step) const { return m_split[step]; }

  Located_octree octree(std::size_t steps) const
  {
    Located_octree result = m_octree;
    result.truncate(m_sizes[steps]);
    return result;
  }

  /// Adds one step, unless there is nothing left to split.
  bool extend()
  {
    while(!m_queue.empty()) {
      const Node_index n = std::get<3>(m_queue.top());
      m_queue.pop();
      if(!m_octree.octree().is_leaf(n))
        continue; // the cell has been split for the balance
      const std::size_t size = m_octree.octree().size();
      m_octree.refine(std::vector<Node_index>{n});
      m_split.push_back(n);
      append(size, m_cells.back());
      return true;
    }
    return false;
  }

private:
  // Adds the nodes from `first` on; `cells` is the number of leaves before.
  void append(std::size_t first, std::size_t cells)
  {
    const Octree& octree = m_octree.octree();
    for(Node_index n = Node_index(first); n < octree.size(); ++n) {
      const bool meets_domain = m_octree.meets_domain(n);
      m_depths.push_back(meets_domain ? depth(n) : 0);
      if(n > 0 && (n - 1) % 8 == 0)
        pass_points_to_children(octree.parent(n), n);
      if(n > 0 && (n - 1) % 8 == 0)
        cells -= m_octree.meets_domain(octree.parent(n));
      cells += meets_domain;
      if(meets_domain && octree.is_leaf(n) && octree.level(n) < Octree::max_level && key(n) > 0)
        m_queue.emplace(key(n), m_octree.quantized(m_depths[n]), rank_of_equals(n), n);
    }
    m_sizes.push_back(octree.size());
    m_cells.push_back(cells);
  }

  // Depth of a cell in the region; cells that are small against the radius take the depth from their parents.
  double depth(Node_index n) const
  {
    return n > 0 && m_octree.edge_length(n) < m_radius / 2 ? m_depths[m_octree.octree().parent(n)]
                                                           : m_octree.depth_in_region(n);
  }

  std::uint64_t rank_of_equals(Node_index n) const
  {
    const std::uint64_t k = ~lattice_key(m_octree.octree().corner(n));
    return m_is_everywhere ? k * 0x9E3779B97F4A7C15u : k; // Fibonacci hashing (Knuth)
  }

  // Passes the points of a node on to its children, the first of which is given.
  void pass_points_to_children(Node_index parent, Node_index first)
  {
    if(m_points.empty())
      return;
    m_points.resize(std::size_t(first) + 8);
    for(const Point& p : m_points[parent])
      m_points[m_octree.nearest_child(first, p)].push_back(p);
  }

  // Factor of the weight at the surface and below it. Without grading, the largest cells of the region come
  // first, as in the paper.
  double factor_by_surface(Node_index n) const
  {
    if(m_radius == 0 || m_is_everywhere || !m_octree.is_in_region(n))
      return m_octree.side(n) == ON_BOUNDARY ? factor_at_surface : 1;
    double factor = factor_at_surface_in_region;
    for(; factor > 1 && n > 0 && m_octree.side(n) != ON_BOUNDARY; n = m_octree.octree().parent(n))
      factor /= fall_of_factor;
    return (std::max)(factor, 1.);
  }

  double key(Node_index n) const
  {
    const double edge = m_octree.edge_length(n);
    double weight = m_octree.is_in_region(n) ? 1
                    : m_radius > 0 ? weight_of_distance(-m_octree.rounded(m_depths[n]) - edge / 2, m_radius)
                                   : 0;
    if(weight > 0)
      weight *= m_octree.weight_in_region(n, m_radius);
    weight *= factor_by_surface(n);
    if(m_octree.side(n) == ON_BOUNDARY)
      weight += weight_of_volume * m_radius / edge;
    if(n < m_points.size() && !m_points[n].empty())
      weight *= factor_at_sharp_edges;
    return weight * std::pow(edge, 5);
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_OCTREE_REFINEMENT_SEQUENCE_H
