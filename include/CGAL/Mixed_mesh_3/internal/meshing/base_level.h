// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_BASE_LEVEL_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_BASE_LEVEL_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/octree/Located_octree.h>
#include <CGAL/Mixed_mesh_criteria_3.h>

#include <algorithm>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

// Level of cells of 1/8 of the domain; see the manual, "Choosing parameters".
inline constexpr int default_base_level = 3;
inline constexpr int coarsest_automatic_base_level = 1;
inline constexpr int finest_automatic_base_level = 6;
// Share chosen by judgment: lost cells are reported in any case. With a smaller share, more domains get a
// finer base level, and the region has fewer vertices.
inline constexpr double tolerated_share_of_lost_cells = 0.05;
/// The level that the criteria give, or the default.
inline int first_base_level(const Mixed_mesh_criteria_3& criteria)
{
  return criteria.base_level() != Mixed_mesh_criteria_3::automatic ? criteria.base_level()
                                                                   : default_base_level;
}

/// Refines cells that meet the domain to a level, unless there would be far more cells than vertices are
/// allowed.
/// \return whether the cells were refined
inline bool refine_to_level(Located_octree& octree, int base_level, std::size_t budget)
{
  // So many vertices take 21 s (benchmark/results/threads.md).
  constexpr std::size_t far_above_budget = 1000000;
  for(int level = 0; level < base_level; ++level) {
    // Cells inside have their smallest corners inside, and eight children each: a lower bound of the number
    // of vertices.
    if(8 * octree.number_of_cells_inside() > (std::max)(budget, far_above_budget))
      return false;
    octree.refine(octree.leaves_to_refine(level, false));
  }
  return true;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_BASE_LEVEL_H
