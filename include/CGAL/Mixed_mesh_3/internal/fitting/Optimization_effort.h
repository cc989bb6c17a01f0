// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_OPTIMIZATION_EFFORT_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_OPTIMIZATION_EFFORT_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <cstddef>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The share of boundary vertices that may be off the surface without another run: of a brain of a million
/// vertices one was, of 200,000, and further runs took three times as long, in vain.
inline constexpr double share_not_arrived_tolerated = 1e-4;

/// What suffices where the boundary of a mesh is only estimated.
struct Fitting_estimate
{
  /// Share of the boundary vertices that may have not arrived without a further run.
  double tolerated_share_not_arrived = 0;
  /// Number of vertices of the mesh that a coarser one is fitted for: the effort for that number suffices,
  /// and the largest distance is not measured. 0: none.
  std::size_t number_of_vertices = 0;
  /// Whether what does not arrive is left as it is, as those vertices will be removed: one run, in which
  /// vertices stay on their way to sharp edges, and bad elements are not mended.
  bool leaves_rest = false;
  /// Whether places where the boundary would cut itself are held, as it does not at the start. Otherwise it
  /// may, if `leaves_rest`.
  bool stays_simple = false;
};

/*!
Effort for each vertex: the more vertices, the less effort. Most of many vertices are inside, where much time
gains little. Pairs are for the fourth power of the costs, which serves all elements, and the eighth, which
serves the worst ones: vertices whose elements are all better than `good_enough` stay.
*/
struct Optimization_effort
{
  int sweeps_to_arrive = 2; ///< sweeps over inner vertices after each step of the boundary
  double good_enough_to_arrive = 1.02, good_enough[2] = {1.02, 1.4};
  double first_step = 0.1;  ///< first step, as a share of the shortest edge
  double step_growth = 1.5; ///< growth of steps that succeed
  int sweeps[2] = {8, 8};   ///< sweeps of a round, if rounds are few
  bool moves_by_colors = false;
  int layers = 0;                ///< layers of elements at the boundary; beyond, the octree stays; 0: all
  bool samples_coarsely = false; ///< samples of the distance to the surface
  double share_of_late_bisections = 0.3;

  // Number of vertices above which thresholds are larger. With 50,000 vertices, the thresholds of smaller
  // meshes would take a third more time, for a mean aspect-ratio coefficient of 1.378 instead of 1.381;
  // shorter steps and more sweeps would take a quarter more moves, for 1.389 instead of 1.390; the second
  // threshold of smaller meshes and five sweeps in the end an eighth more time, for 1.385 instead of 1.387; a
  // fourth round a tenth, for 1.387 instead of 1.388; two sweeps and a threshold of 1.5 for the arrival a
  // tenth, for the same mean, or, with other regions, 0.002 to 0.008 less.
  static constexpr std::size_t large_number = 20000;
  // Number of vertices above which the effort is least. With 200,000, the values above would take 2.2 times
  // as long, for a mean of 1.343 instead of 1.379: half of the moves were in the fourth layer and beyond, or
  // gained less than a tenth of what others did. A threshold of 2 for the arrival would take a tenth more
  // time, for 1.403 instead of 1.404.
  static constexpr std::size_t very_large_number = 100000;

  explicit Optimization_effort(std::size_t number_of_vertices)
  {
    if(number_of_vertices > large_number) {
      sweeps_to_arrive = 1;
      good_enough_to_arrive = 2;
      good_enough[0] = 1.3;
      good_enough[1] = 1.6;
      first_step = 0.3;
      step_growth = 2;
      sweeps[0] = sweeps[1] = 3;
      moves_by_colors = true;
    }
    if(number_of_vertices > very_large_number) {
      good_enough_to_arrive = 3;
      layers = 3;
      samples_coarsely = true;
      share_of_late_bisections = 0;
    }
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_OPTIMIZATION_EFFORT_H
