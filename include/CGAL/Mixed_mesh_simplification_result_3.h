// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_SIMPLIFICATION_RESULT_3_H
#define CGAL_MIXED_MESH_SIMPLIFICATION_RESULT_3_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <cstddef>

namespace CGAL {

/// \ingroup PkgMixedMesh3Optimization
/// The outcome of `simplify_mixed_mesh_3()`.
enum class Mixed_mesh_simplification_status {
  SUCCESS,            ///< the mesh has the number of vertices, or, if that is 0, as few as the limits allow
  NUMBER_NOT_REACHED, ///< valid, but with more vertices: each further collapse would exceed a limit
  STOPPED,            ///< valid, but incomplete, or unchanged: the visitor stopped the run
  INVALID_MESH,       ///< unchanged: an element is inverted, or has a vertex that does not exist
  EMPTY               ///< unchanged: there is no element
};

namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMesh3Functions
/// The status in a few words.
inline const char* description(Mixed_mesh_simplification_status status)
{
  switch(status) {
  case Mixed_mesh_simplification_status::SUCCESS: return "success";
  case Mixed_mesh_simplification_status::NUMBER_NOT_REACHED: return "number of vertices not reached";
  case Mixed_mesh_simplification_status::STOPPED: return "stopped";
  case Mixed_mesh_simplification_status::INVALID_MESH: return "invalid mesh";
  case Mixed_mesh_simplification_status::EMPTY: return "empty";
  }
  return "";
}

} // namespace Mixed_meshes_3

/// \ingroup PkgMixedMesh3Optimization
/// The result of `simplify_mixed_mesh_3()`.
struct Mixed_mesh_simplification_result_3
{
  /// The outcome.
  Mixed_mesh_simplification_status status = Mixed_mesh_simplification_status::EMPTY;
  std::size_t number_of_vertices = 0;  ///< vertices of the mesh in the end
  std::size_t number_of_collapses = 0; ///< collapsed edges, each with a vertex that is removed
  /// The length of the edges of the mesh along sharp edges of the surface, in the end.
  double length_of_sharp_edges_followed = 0;
  /// Whether the boundary does not cut itself: always, if it did not at the start.
  bool is_boundary_simple = true;
};

} // namespace CGAL

#endif // CGAL_MIXED_MESH_SIMPLIFICATION_RESULT_3_H
