// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_OPTIMIZATION_RESULT_3_H
#define CGAL_MIXED_MESH_OPTIMIZATION_RESULT_3_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {

/// \ingroup PkgMixedMesh3Optimization
/// The outcome of `optimize_mixed_mesh_3()`: the last of the statuses that apply.
enum class Mixed_mesh_optimization_status {
  SUCCESS,               ///< the boundary is on the surface, and within the tolerance if there is one
  TOLERANCE_NOT_REACHED, ///< the boundary vertices are on the surface, but places between them are farther
  NOT_ALL_ARRIVED,       ///< valid, but boundary vertices have not arrived: elements would be too bad,
                         ///< or faces of the boundary would cut each other
  STOPPED,               ///< valid, but incomplete, or unchanged: the visitor stopped the run
  INVALID_MESH,          ///< unchanged: an element is inverted, or has a vertex that does not exist
  EMPTY                  ///< unchanged: there is no element
};

namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMesh3Functions
/// The status in a few words.
inline const char* description(Mixed_mesh_optimization_status status)
{
  switch(status) {
  case Mixed_mesh_optimization_status::SUCCESS: return "success";
  case Mixed_mesh_optimization_status::TOLERANCE_NOT_REACHED: return "tolerance not reached";
  case Mixed_mesh_optimization_status::NOT_ALL_ARRIVED: return "boundary partly off the surface";
  case Mixed_mesh_optimization_status::STOPPED: return "stopped";
  case Mixed_mesh_optimization_status::INVALID_MESH: return "invalid mesh";
  case Mixed_mesh_optimization_status::EMPTY: return "empty";
  }
  return "";
}

} // namespace Mixed_meshes_3

/// \ingroup PkgMixedMesh3Optimization
/// The result of `optimize_mixed_mesh_3()`.
struct Mixed_mesh_optimization_result_3
{
  /// The outcome.
  Mixed_mesh_optimization_status status = Mixed_mesh_optimization_status::EMPTY;
  std::size_t number_of_boundary_vertices = 0; ///< including new ones
  std::size_t number_of_arrived_vertices = 0;  ///< boundary vertices on the surface
  std::size_t number_of_flips = 0;             ///< flips of tetrahedra
  std::size_t number_of_bisections = 0;        ///< bisected boundary edges, each with a new vertex
  std::size_t number_of_merged_vertices = 0;   ///< boundary vertices merged, or removed
  bool is_boundary_simple = true;              ///< whether the boundary does not cut itself
  /// Rounds of moves that were done.
  std::size_t number_of_rounds = 0;
  /// The largest distance between boundary and surface, either way, at sample points; with a tolerance only.
  double largest_distance = 0;
  /// The length of the sharp edges of the surface, unless they are only noise.
  double length_of_sharp_edges = 0;
  /// The length of the part of sharp edges within 0.05 of the length of the edge of the mesh that follows
  /// them.
  double length_of_sharp_edges_kept = 0;
  /// The other parts of sharp edges, each as the points of a polyline.
  std::vector<std::vector<Mixed_meshes_3::Vec3>> lost_sharp_edges = {};
  std::size_t number_of_corners = 0;      ///< places where sharp edges of the surface end or turn
  std::size_t number_of_corners_kept = 0; ///< corners that have a vertex
  double quality_bound = std::numeric_limits<double>::infinity(); ///< bound of the criteria
  /// Elements that are not proved to cost at most the bound: 0 if the mesh had none at the start.
  std::size_t number_of_elements_above_bound = 0;
};

} // namespace CGAL

#endif // CGAL_MIXED_MESH_OPTIMIZATION_RESULT_3_H
