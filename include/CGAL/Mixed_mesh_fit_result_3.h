// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_FIT_RESULT_3_H
#define CGAL_MIXED_MESH_FIT_RESULT_3_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <cstddef>

namespace CGAL {

/// \ingroup PkgMixedMesh3Optimization
/// The outcome of `fit_mixed_mesh_to_surface()`: the last of the statuses that apply.
enum class Mixed_mesh_fit_status {
  SUCCESS,         ///< the boundary is on the surface, all elements that moved are of acceptable quality
  CAP_REACHED,     ///< the boundary is on the surface; stiffening did not make all elements acceptable
  NOT_ALL_ARRIVED, ///< valid, but boundary vertices have not arrived: elements would be inverted
  SOLVER_FAILED,   ///< valid, but incomplete: the solver did not solve a system
  STOPPED,         ///< valid, but incomplete: the visitor stopped the run
  INVALID_MESH,    ///< unchanged: an element is inverted, or has a vertex that does not exist
  EMPTY            ///< unchanged: there is no element
};

namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMesh3Functions
/// The status in a few words.
inline const char* description(Mixed_mesh_fit_status status)
{
  switch(status) {
  case Mixed_mesh_fit_status::SUCCESS: return "success";
  case Mixed_mesh_fit_status::CAP_REACHED: return "cap reached";
  case Mixed_mesh_fit_status::NOT_ALL_ARRIVED: return "boundary partly off the surface";
  case Mixed_mesh_fit_status::SOLVER_FAILED: return "solver failed";
  case Mixed_mesh_fit_status::STOPPED: return "stopped";
  case Mixed_mesh_fit_status::INVALID_MESH: return "invalid mesh";
  case Mixed_mesh_fit_status::EMPTY: return "empty";
  }
  return "";
}

} // namespace Mixed_meshes_3

/// \ingroup PkgMixedMesh3Optimization
/// The result of `fit_mixed_mesh_to_surface()`.
struct Mixed_mesh_fit_result_3
{
  /// The outcome.
  Mixed_mesh_fit_status status = Mixed_mesh_fit_status::EMPTY;
  /// The number of all vertices of the boundary.
  std::size_t number_of_boundary_vertices = 0;
  std::size_t number_of_arrived_vertices = 0; ///< boundary vertices on the surface
  std::size_t number_of_frozen_vertices = 0;  ///< held in the last attempt, lest elements be inverted
  std::size_t number_of_folded_faces = 0;     ///< boundary faces whose target could not be unfolded
  std::size_t number_of_solves = 0;           ///< solved systems of linear equations
  std::size_t number_of_halvings = 0;         ///< halvings of steps
  /// Elements of unacceptable quality among those that moved: stiffened up to the largest stiffness, or
  /// without an inner vertex, or bad from the start and not worse now.
  std::size_t number_of_unacceptable_elements = 0;

  /// Whether the mesh is valid and all its boundary vertices are on the surface.
  bool is_on_surface() const
  {
    return status == Mixed_mesh_fit_status::SUCCESS || status == Mixed_mesh_fit_status::CAP_REACHED;
  }
};

} // namespace CGAL

#endif // CGAL_MIXED_MESH_FIT_RESULT_3_H
