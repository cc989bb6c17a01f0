// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_BASE_LEVEL_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_BASE_LEVEL_H

#include <CGAL/Mixed_mesh_criteria_3.h>

#include <algorithm>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

// Cells of 1/8 of the domain; see the manual, "Choosing parameters".
inline constexpr int default_base_level = 3;
inline constexpr int coarsest_automatic_base_level = 1;
inline constexpr int finest_automatic_base_level = 6;
// A judgment: what is lost is reported in any case. With less tolerated, more domains get a finer base level,
// and the region has fewer vertices.
inline constexpr double tolerated_share_of_lost_cells = 0.05;
// What may be spent outside the region: beyond, elements there are not what limits the solution.
inline constexpr double largest_share_for_base_level = 0.5;

/// The level that the criteria give. Else the default, or a finer one if the budget is large: with elements
/// as coarse as for a small one, the solution would not gain from more vertices in the region. With a
/// tolerance, that says where to be finer.
/// \param root the octree with nothing but its root
template <class Octree_>
int first_base_level(const Octree_& root, const Mixed_mesh_criteria_3& criteria)
{
  if(criteria.base_level() != Mixed_mesh_criteria_3::automatic)
    return criteria.base_level();
  const double limit = largest_share_for_base_level * double(criteria.maximal_number_of_vertices());
  int level = 0;
  for(Octree_ octree = root; criteria.tolerance() == 0 && level < finest_automatic_base_level; ++level) {
    if(8 * double(octree.number_of_cells_inside()) > limit)
      break;
    octree.refine(octree.leaves_to_refine(level, false));
    if(double(octree.number_of_cells()) > limit) // about as many as vertices
      break;
  }
  return (std::max)(level, default_base_level);
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_BASE_LEVEL_H
