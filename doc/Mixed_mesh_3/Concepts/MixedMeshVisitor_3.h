// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgMixedMesh3Concepts
\cgalConcept

The concept `MixedMeshVisitor_3` describes an object that observes a run, and can stop the run.

The search for the budget tries several octrees. For each of them, the calls are

    begin_stage(OCTREE)  end_stage(OCTREE)  go_on()
    begin_stage(TRANSITIONS)  end_stage(TRANSITIONS)
    begin_stage(BOUNDARY)  end_stage(BOUNDARY)
    progress(number_of_vertices, budget)

After these calls follow one `begin_stage(OCTREE)` and `end_stage(OCTREE)` for the rest of the search, and, if
there is a mesh, the stages `ASSEMBLY` and, if the boundary is to be fitted, `OPTIMIZATION`, in which
`go_on()` is called before each round. With a tolerance, as by default, octrees of coarse meshes come first,
with the same calls. All of these calls repeat where more than one mesh is made: where the
mesh begins finer or walls are resolved, octrees may have more vertices than the budget. Stages are not
nested, and each stage ends. All calls come from the thread that called `CGAL::make_mixed_mesh_3()`.

A model that derives from `CGAL::Mixed_meshes_3::Default_visitor` has all members, and redefines those it
needs.

`CGAL::optimize_mixed_mesh_3()`, `CGAL::simplify_mixed_mesh_3()` and `CGAL::fit_mixed_mesh_to_surface()`
call `go_on()` only.

A model need not be copyable: pass it as `CGAL::parameters::visitor(std::ref(my_visitor))`. Members need not
be `const`. The visitor must outlive the call.

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
  /// \param number_of_vertices the number of vertices of that mesh. The number may exceed the budget, and is
  ///        not monotonic
  /// \param budget the maximal number of vertices of the result
  void progress(std::size_t number_of_vertices, std::size_t budget);

  /// Whether to continue. Called for each mesh that is tried, after its octree and before its elements are
  /// made, and before each round of the optimization. After `false`, the function is not called again, and
  /// the result has the status `STOPPED`. The mesh of `CGAL::make_mixed_mesh_3()` is empty then, unless the
  /// criteria have `keep_mesh_if_stopped(true)`; the mesh of the other functions is valid, with the changes
  /// made until then.
  bool go_on();

  /// Called with each mesh before its boundary is fitted, in the stage `OPTIMIZATION`: the result is made
  /// from the last one.
  void before_fitting(const CGAL::Mixed_mesh_3<CGAL::Mixed_meshes_3::Predicates_kernel>& mesh);
};
