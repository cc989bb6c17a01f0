// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_DEFAULT_VISITOR_H
#define CGAL_MIXED_MESH_3_DEFAULT_VISITOR_H

#include <cstddef>

namespace CGAL {
namespace Mixed_meshes_3 {

/// The stages of the method, in the order of their first run. The search for the budget runs the
/// octree, transition and boundary stages several times.
enum class Stage { OCTREE, TRANSITIONS, BOUNDARY, ASSEMBLY, OPTIMIZATION };

inline constexpr int number_of_stages = 5;
inline constexpr const char* stage_names[number_of_stages] = {"octree", "transitions", "boundary", "assembly",
                                                              "optimization"};

/// \brief Model of `MixedMeshVisitor_3` that does nothing.
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
};

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_DEFAULT_VISITOR_H
