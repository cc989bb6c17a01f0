// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgMixedMesh3Concepts
\cgalConcept

The concept `MixedMeshVisitor_3` is told how a run goes, and can stop it.

The search for the budget tries several octrees. For each of them, the calls are

    begin_stage(OCTREE)  end_stage(OCTREE)  go_on()
    begin_stage(TRANSITIONS)  end_stage(TRANSITIONS)
    begin_stage(BOUNDARY)  end_stage(BOUNDARY)
    progress(number_of_vertices, budget)

They are followed by one `begin_stage(OCTREE)` and `end_stage(OCTREE)` for what remains of the
search, and, if there is a mesh, by the stages `ASSEMBLY` and, unless the boundary shall stay where the
octree has it, `OPTIMIZATION`, in which `go_on()` is asked before each round. With a tolerance, as by default,
octrees of coarse meshes come first, with the same calls. Stages are neither nested nor left open. All calls
come from the thread that called `CGAL::make_mixed_mesh_3()`.

`CGAL::optimize_mixed_mesh_3()` and `CGAL::fit_mixed_mesh_to_surface()` ask `go_on()` only.

A model need not be copied: pass it as `CGAL::parameters::visitor(std::ref(my_visitor))`. Members
need not be `const`. The visitor must outlive the call.

\cgalHasModelsBegin
\cgalHasModels{CGAL::Mixed_meshes_3::Default_visitor}
\cgalHasModelsEnd

The example \ref Mixed_mesh_3/mixed_mesh_visitor.cpp has another model.

\sa `CGAL::make_mixed_mesh_3()`
*/
class MixedMeshVisitor_3
{
public:
  /// Called when a stage starts.
  void begin_stage(CGAL::Mixed_meshes_3::Stage stage);

  /// Called when a stage ends.
  void end_stage(CGAL::Mixed_meshes_3::Stage stage);

  /// Called when a mesh has been tried.
  /// \param number_of_vertices of that mesh. It may exceed the budget, and is not monotonic
  /// \param budget the maximal number of vertices of the result
  void progress(std::size_t number_of_vertices, std::size_t budget);

  /// Whether to go on. Asked for each mesh that is tried, when its octree is there and its elements are
  /// not, and before each round of the optimization. After `false` it is not asked again, and the result
  /// has the status `STOPPED`. The mesh of `CGAL::make_mixed_mesh_3()` is empty then, unless the criteria say
  /// `keep_mesh_if_stopped(true)`; that of other functions is valid, as far as it went.
  bool go_on();

  /// \name Optional
  /// @{

  /// Called with each mesh whose boundary is to be fitted next, in the stage `OPTIMIZATION`: the last one is
  /// what the result is made from. A model need not have this function.
  void before_fitting(const CGAL::Mixed_mesh_3<CGAL::Mixed_meshes_3::Predicates_kernel>& mesh);
  /// @}
};
