// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_LINEAR_ELASTICITY_3_MIXED_MESH_ADAPTATION_RESULT_3_H
#define CGAL_LINEAR_ELASTICITY_3_MIXED_MESH_ADAPTATION_RESULT_3_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <cstddef>
#include <vector>

namespace CGAL {

/// \ingroup PkgLinearElasticity3Ref
/// The outcome of `adapt_mixed_mesh_3()`.
enum class Mixed_mesh_adaptation_status {
  CONVERGED,        ///< steps gain next to nothing any more, or no vertex can move where it should
  SOLVES_EXHAUSTED, ///< steps still gain, but the maximal number of solves was reached
  STOPPED,          ///< incomplete: the visitor stopped the run
  NO_INNER_VERTEX,  ///< unchanged: no vertex may move
  NO_LOAD,          ///< unchanged: no load case strains the mesh
  SOLVER_FAILED,    ///< unchanged: a load case leaves rigid motions free, or elements are connected by hinges
  INVALID_MESH,     ///< unchanged: an element is inverted
  EMPTY             ///< unchanged: there is no element
};

namespace Mixed_meshes_3 {

/// \ingroup PkgLinearElasticity3Ref
/// The status in a few words.
inline const char* description(Mixed_mesh_adaptation_status status)
{
  switch(status) {
  case Mixed_mesh_adaptation_status::CONVERGED: return "converged";
  case Mixed_mesh_adaptation_status::SOLVES_EXHAUSTED: return "maximal number of solves reached";
  case Mixed_mesh_adaptation_status::STOPPED: return "stopped";
  case Mixed_mesh_adaptation_status::NO_INNER_VERTEX: return "no inner vertex";
  case Mixed_mesh_adaptation_status::NO_LOAD: return "no load";
  case Mixed_mesh_adaptation_status::SOLVER_FAILED: return "solver failed";
  case Mixed_mesh_adaptation_status::INVALID_MESH: return "invalid mesh";
  case Mixed_mesh_adaptation_status::EMPTY: return "empty";
  }
  return "";
}

} // namespace Mixed_meshes_3

/// \ingroup PkgLinearElasticity3Ref
/// The result of `adapt_mixed_mesh_3()`.
struct Mixed_mesh_adaptation_result_3
{
  /// The outcome.
  Mixed_mesh_adaptation_status status = Mixed_mesh_adaptation_status::EMPTY;
  int number_of_steps = 0;                  ///< accepted steps: each has lowered the functional
  int number_of_solves = 0;                 ///< solves of all load cases: in steps, and on the initial mesh
  std::size_t number_of_inner_vertices = 0; ///< vertices that may move
  /// Energies of standard elements before the adaptation, of each load case, in microjoules (mN mm).
  std::vector<double> energies_before;
  /// Energies after the adaptation. One of several energies may have grown; the sum of their ratios has not.
  std::vector<double> energies_after;
  /// Energies of the guard loads before the adaptation, in microjoules: of displacements of up to 1 mm.
  std::vector<double> guard_energies_before;
  std::vector<double> guard_energies_after; ///< after the adaptation: none has grown
  /// The largest aspect-ratio coefficient (ARC) before the adaptation.
  double worst_aspect_ratio_before = 0;
  double worst_aspect_ratio_after = 0; ///< after the adaptation

  /// The mean ratio of energies after and before, over the load cases that strain the mesh. The minimized
  /// functional has, in addition, the mean ratio over guard loads, times their weight.
  double functional = 1;
};

} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_MIXED_MESH_ADAPTATION_RESULT_3_H
