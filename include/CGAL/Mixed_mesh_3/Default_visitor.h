// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_DEFAULT_VISITOR_H
#define CGAL_MIXED_MESH_3_DEFAULT_VISITOR_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <cstddef>

namespace CGAL {
namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMesh3Visitors
/// The stages of the method, in the order of their first run. The search for the budget runs the
/// octree, transition and boundary stages several times.
enum class Stage {
  OCTREE,      ///< cells are split, and balanced
  TRANSITIONS, ///< cells with hanging vertices become elements
  BOUNDARY,    ///< elements at the surface are split
  ASSEMBLY,    ///< the mesh is filled
  OPTIMIZATION ///< the boundary goes to the surface, elements are improved
};

/// \ingroup PkgMixedMesh3Visitors
/// The number of values of `Stage`.
inline constexpr int number_of_stages = 5;
/// \ingroup PkgMixedMesh3Visitors
/// Names of the stages, for progress and reports, by `Stage`.
inline constexpr const char* stage_names[number_of_stages] = {"octree", "transitions", "boundary", "assembly",
                                                              "optimization"};

/// \ingroup PkgMixedMesh3Visitors
/// \brief Model of `MixedMeshVisitor_3` that does nothing.
///
/// \cgalModels{MixedMeshVisitor_3}
struct Default_visitor
{
  /// Called when a stage starts.
  void begin_stage(Stage) {}
  /// Called when a stage ends.
  void end_stage(Stage) {}
  /// Called when a mesh has been tried: its number of vertices, and the budget.
  void progress(std::size_t /* number_of_vertices */, std::size_t /* budget */) {}
  /// Asked between stages; `false` stops the run with the status `STOPPED`.
  bool go_on() { return true; }
  /// Called with each mesh before its boundary is fitted.
  template <class Mesh>
  void before_fitting(const Mesh&)
  {
  }
};

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_DEFAULT_VISITOR_H
