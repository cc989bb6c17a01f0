// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cells that are too coarse for the topology: as large as a wall is thick, or a gap is wide.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_THIN_CELLS_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_THIN_CELLS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Located_octree.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Octree.h>
#include <CGAL/Mixed_mesh_3/internal/transitions/Lattice_mesh.h>

#include <CGAL/enum.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
Function object that tells whether two sheets of the surface are too near to each other for a cell: a line
from the point of the surface that is nearest to a point of the cell, at right angles to the surface, soon
leads to the other side of the surface.

A wall needs an octree vertex inside, everywhere: along the axis that is most at right angles to the wall,
vertices are at a distance of the side of a cell, and the wall has to have that thickness. A gap needs two
layers of vertices that are not inside, one for each of its sheets, but may take such vertices from the solid:
vertices that are not deep are not labeled inside there. Boundary vertices then begin a little inside, and are
moved outwards.
*/
class Thin_cell_finder
{
  using Point_3 = Located_octree::Point_3;
  using Node_index = Octree::Node_index;

  const Located_octree& m_octree;
  const double m_strictness;
  std::map<Lattice_point, bool> m_is_thin_at; // corners of leaves are mostly common to four leaves

  static constexpr double cells_per_wall = 1, cells_per_gap = 1;
  // Limits in sides of cells: width of gaps that are widened, and largest widening on each side.
  static constexpr double wide_gap = 2.5, widening = 1;
  // Points of a line that are tested: thinner parts may be missed between the points.
  static constexpr double shares_of_line[] = {0.25, 0.5, 0.75, 1};

public:
  /// \param strictness factor for the theoretical number of cells that should suffice
  Thin_cell_finder(const Located_octree& octree, double strictness)
    : m_octree(octree), m_strictness(strictness)
  {
  }

  /// Whether a leaf that meets the surface is too large, seen from its corners and its center.
  /// \pre all tested leaves have the same level
  bool operator()(Node_index n)
  {
    const Octree& octree = m_octree.octree();
    const std::uint32_t half = octree.side(n) / 2;
    Point_3 hint = m_octree.domain().closest_point(m_octree.point(at(n, half, half, half)),
                                                   m_octree.surface_part(n));
    if(is_thin(n, at(n, half, half, half), hint))
      return true;
    for(std::uint32_t i = 0; i < 8; ++i) {
      const Lattice_point corner = at(n, (i & 1) * 2 * half, (i >> 1 & 1) * 2 * half, (i >> 2) * 2 * half);
      const auto [known, is_new] = m_is_thin_at.try_emplace(corner, false);
      if(is_new)
        known->second = is_thin(n, corner, hint);
      if(known->second)
        return true;
    }
    return false;
  }

  /// Whether a vertex inside is so near to a gap that the vertex should not be labeled inside.
  /// \param hint point of the surface; becomes the closest one
  bool is_beside_gap(const Lattice_point& lattice_point, Node_index leaf, Point_3& hint) const
  {
    const Vec3 p = to_vec3(m_octree.point(lattice_point)), q = closest(p, hint);
    const double distance = norm(p - q), edge = m_octree.edge_length(leaf);
    if(!(distance > 1e-9 * edge && distance < widening * edge))
      return false;
    const Vec3 outwards = (1 / distance) * (q - p);
    return is_reached(q, outwards, wide_gap * edge, ON_BOUNDED_SIDE)
           && !is_reached(q, -1 * outwards, distance + cells_per_wall * edge, ON_UNBOUNDED_SIDE);
  }

private:
  Lattice_point at(Node_index n, std::uint32_t x, std::uint32_t y, std::uint32_t z) const
  {
    const Lattice_point& corner = m_octree.octree().corner(n);
    return {corner[0] + x, corner[1] + y, corner[2] + z};
  }

  Vec3 closest(const Vec3& p, Point_3& hint) const
  {
    hint = m_octree.domain().closest_point(Point_3(p[0], p[1], p[2]), hint);
    return to_vec3(hint);
  }

  // Whether a part is thin at the point of the surface that is nearest to a point of the leaf, on either
  // side.
  bool is_thin(Node_index n, const Lattice_point& lattice_point, Point_3& hint) const
  {
    const auto point = m_octree.point(lattice_point);
    const Bounded_side side = m_octree.domain().bounded_side(point, m_octree.surface_part(n));
    const Vec3 p = to_vec3(point), q = closest(p, hint);
    const double distance = norm(p - q), edge = m_octree.edge_length(n);
    if(side == ON_BOUNDARY || !(distance > 1e-9 * edge))
      return false;
    const Vec3 normal = (1 / distance) * (p - q);
    const Vec3 outwards = side == ON_BOUNDED_SIDE ? -1 * normal : normal;
    return is_reached(q, outwards, cells_per_gap * m_strictness * edge, ON_BOUNDED_SIDE)
           || is_reached(q, -1 * outwards, cells_per_wall * m_strictness * edge, ON_UNBOUNDED_SIDE);
  }

  // Whether a line of some length reaches a side.
  bool is_reached(const Vec3& q, const Vec3& direction, double length, Bounded_side side) const
  {
    return std::any_of(std::begin(shares_of_line), std::end(shares_of_line), [&](double share) {
      return m_octree.bounded_side(q + share * length * direction) == side;
    });
  }
};

/// The leaves of a level that meet the surface and are too large for a wall or a gap.
inline std::vector<Octree::Node_index> thin_cells(const Located_octree& octree, int level, double strictness)
{
  Thin_cell_finder is_thin(octree, strictness);
  std::vector<Octree::Node_index> leaves;
  for(const Octree::Node_index n : octree.leaves_to_refine(level, false))
    if(octree.side(n) == ON_BOUNDARY && is_thin(n))
      leaves.push_back(n);
  return leaves;
}

/// Removes the label of vertices inside that are next to narrow gaps.
inline void widen_gaps(const Located_octree& octree, Lattice_mesh& mesh)
{
  const Thin_cell_finder finder(octree, 1);
  auto hint = octree.domain().closest_point(octree.point({0, 0, 0}));
  for(Vertex_index v = 0; v < mesh.vertices.size(); ++v)
    if(mesh.is_inside(v) && finder.is_beside_gap(mesh.vertices[v], mesh.leaves[v], hint))
      mesh.sides[v] = ON_UNBOUNDED_SIDE;
}

/// The result of splitting cells for walls and gaps.
struct Thin_cell_splits
{
  bool is_complete = true;            ///< whether the budget sufficed
  std::size_t number_of_vertices = 0; ///< about, once all are split; at most some hundred budgets
};

/*!
Splits cells that are too large for walls and gaps, the largest cells first, level by level, as long as the
mesh fits the budget.

\param number_of_vertices `std::size_t(octree)`: the number of vertices of the mesh of an octree
\par Complexity
A dozen or more queries for closest points for each leaf at the surface
*/
template <class Count>
Thin_cell_splits split_thin_cells(Located_octree& octree, double strictness, std::size_t budget,
                                  const Count& number_of_vertices)
{
  constexpr double most_cells_per_vertex = 4;    // approximate maximum: meshes of more cells would be in vain
  constexpr double cells_per_budget_vertex = 16; // times the budget
  constexpr double vertices_per_cell = 1.4;      // vertices for each cell at the surface
  Thin_cell_splits result;
  Located_octree trial = octree;
  for(int level = 0; level < Octree::max_level; ++level) {
    const std::vector<Octree::Node_index> leaves = thin_cells(trial, level, strictness);
    if(leaves.empty())
      continue;
    trial.refine(leaves);
    const double cells = double(trial.number_of_cells());
    result.number_of_vertices = std::size_t(vertices_per_cell * cells);
    if(result.is_complete) {
      const bool is_feasible = cells < most_cells_per_vertex * double(budget);
      if(is_feasible)
        result.number_of_vertices = number_of_vertices(trial);
      result.is_complete = is_feasible && result.number_of_vertices <= budget;
      if(result.is_complete)
        octree = trial;
    }
    if(cells > cells_per_budget_vertex * double(budget))
      break;
  }
  return result;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_THIN_CELLS_H
