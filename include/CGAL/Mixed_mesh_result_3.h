// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_RESULT_3_H
#define CGAL_MIXED_MESH_RESULT_3_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Surface_description.h>
#include <CGAL/Mixed_mesh_optimization_result_3.h>

#include <CGAL/Bbox_3.h>

#include <cstddef>
#include <optional>

namespace CGAL {

/// \ingroup PkgMixedMesh3Functions
/// The outcome of `make_mixed_mesh_3()`, in the order of precedence: the last of the statuses that apply.
/// `VOLUME_DIFFERS` and `TOPOLOGY_DIFFERS` are found by `make_mixed_mesh_3()` as far as the domain describes
/// its surface (`MixedMeshDomain_3::shells()`, `volume()`), by numbers for the whole and its shells; and
/// by `Mixed_meshes_3::compare_with_surface()` for each body, cavity and handle.
enum class Mixed_mesh_status {
  SUCCESS,               ///< the budget is filled to at least 97 %, and the boundary is where it should be
  BUDGET_NOT_FILLED,     ///< valid, but below 97 %: each cell tried would exceed the budget
  TOLERANCE_NOT_REACHED, ///< valid, with vertices on the surface, but places between them are farther than
                         ///< the given tolerance
  PARTS_LOST, ///< valid, but parts of the domain thinner than a cell are not meshed, or a sheet has no faces
  NOT_ALL_ARRIVED, ///< valid, but some boundary vertices have not arrived: elements would be too bad,
                   ///< or faces of the boundary would cut each other
  VOLUME_DIFFERS,  ///< valid, but the volume of the whole, of a body or of a cavity is not that of the domain
  TOPOLOGY_DIFFERS, ///< valid, but bodies, cavities or handles of the domain are lost, added, joined or split
  BOUNDARY_NOT_MANIFOLD, ///< the boundary is pinched where no further cell can be added
  REGION_NOT_MET,        ///< no mesh: the region does not meet the domain
  EMPTY,                 ///< no mesh: no octree vertex is inside the domain, which is too thin for the budget
  BUDGET_TOO_SMALL,      ///< no mesh: the coarsest mesh has more vertices than the budget
  STOPPED                ///< no mesh, unless the criteria keep it: the visitor stopped the run
};

namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMesh3Functions
/// The one of two statuses that has precedence; every function of the package decides by this one.
inline Mixed_mesh_status worse_status(Mixed_mesh_status a, Mixed_mesh_status b) { return a < b ? b : a; }

/// \ingroup PkgMixedMesh3Functions
/// The status of the whole after an optimization.
inline Mixed_mesh_status status_of(Mixed_mesh_optimization_status status)
{
  switch(status) {
  case Mixed_mesh_optimization_status::SUCCESS: return Mixed_mesh_status::SUCCESS;
  case Mixed_mesh_optimization_status::TOLERANCE_NOT_REACHED: return Mixed_mesh_status::TOLERANCE_NOT_REACHED;
  case Mixed_mesh_optimization_status::NOT_ALL_ARRIVED: return Mixed_mesh_status::NOT_ALL_ARRIVED;
  case Mixed_mesh_optimization_status::STOPPED: return Mixed_mesh_status::STOPPED;
  case Mixed_mesh_optimization_status::INVALID_MESH:
  case Mixed_mesh_optimization_status::EMPTY: break;
  }
  return Mixed_mesh_status::EMPTY;
}

/// \ingroup PkgMixedMesh3Functions
/// The status in a few words.
inline const char* description(Mixed_mesh_status status)
{
  switch(status) {
  case Mixed_mesh_status::SUCCESS: return "success";
  case Mixed_mesh_status::BUDGET_NOT_FILLED: return "budget not filled";
  case Mixed_mesh_status::TOLERANCE_NOT_REACHED: return "tolerance not reached";
  case Mixed_mesh_status::PARTS_LOST: return "parts lost";
  case Mixed_mesh_status::NOT_ALL_ARRIVED: return "boundary partly off the surface";
  case Mixed_mesh_status::VOLUME_DIFFERS: return "volume differs";
  case Mixed_mesh_status::TOPOLOGY_DIFFERS: return "other bodies, holes or cavities";
  case Mixed_mesh_status::BOUNDARY_NOT_MANIFOLD: return "boundary not manifold";
  case Mixed_mesh_status::REGION_NOT_MET: return "region not met";
  case Mixed_mesh_status::EMPTY: return "empty";
  case Mixed_mesh_status::BUDGET_TOO_SMALL: return "budget too small";
  case Mixed_mesh_status::STOPPED: return "stopped";
  }
  return "";
}

} // namespace Mixed_meshes_3

/// \ingroup PkgMixedMesh3Functions
/// The result of `make_mixed_mesh_3()`.
struct Mixed_mesh_result_3
{
  /// The outcome.
  Mixed_mesh_status status = Mixed_mesh_status::EMPTY;
  /// The octree level that all of the domain is refined to.
  int base_level = 0;
  /// The level of the smallest cells.
  int deepest_level = 0;
  std::size_t number_of_cells = 0; ///< leaves that meet the domain
  /// The number of vertices of the octree's mesh, or of its simplified mesh, before bisections; without a
  /// mesh, the number (at least) for the coarsest one at `base_level`.
  std::size_t number_of_vertices_needed = 0;
  std::size_t number_of_transition_vertices = 0;        ///< inserted by the transition templates
  std::size_t number_of_boundary_vertices_inserted = 0; ///< inserted by the boundary stage
  std::size_t number_of_relabeled_vertices = 0;         ///< relabeled to make the boundary a manifold
  std::size_t number_of_trials = 0;                     ///< octrees tried in search of the budget
  /// The number of budgets with which a mesh was made: more than one only with
  /// `Mixed_mesh_criteria_3::fewest_vertices()`.
  std::size_t number_of_budgets = 1;
  /// The quality bound in force in the end: the bound of the criteria, or a larger one, see
  /// `Mixed_mesh_criteria_3::strict_quality_bound()`.
  double quality_bound = 0;
  std::size_t vertex_budget = 0; ///< budget of the criteria, or the smallest one found to suffice
  /// The number of cells that meet the domain, but are more than a cell away from the mesh: parts of the
  /// domain thinner than a cell that have no octree vertex inside. Cells that the boundary has come near to,
  /// once it is on the surface, do not count.
  std::size_t number_of_lost_cells = 0;
  Bbox_3 lost_cells;                     ///< box of the lost cells
  std::size_t number_of_lost_sheets = 0; ///< without faces: outside the domain, or too small for the cells
  std::size_t number_of_vertices_in_region = 0; ///< before bisections
  /// The number of vertices removed by edge collapses, where the mesh is made of a finer one:
  /// `Mixed_mesh_criteria_3::simplification()`. The numbers of cells and octree are then those of the finer
  /// mesh.
  std::size_t number_of_collapsed_vertices = 0;
  /// The largest distance between boundary and surface: the tolerance of the criteria, or, if the criteria
  /// leave it open, the default for this domain and budget.
  double tolerance = 0;
  /// The number of vertices that the coarse mesh (of the base level, and finer where the tolerance asks for
  /// it, without the region) takes of the budget; 0 without a tolerance, and where the mesh is made of a
  /// finer one.
  std::size_t number_of_vertices_for_tolerance = 0;
  /// The shells of the domain's surface, `MixedMeshDomain_3::shells()`. Nothing if the domain does not tell:
  /// then topology and volume of the mesh have not been compared.
  std::optional<Mixed_meshes_3::Shell_counts> shells_of_domain;
  /// The shells of the boundary of the mesh, if the domain describes its own: where these numbers differ, the
  /// topologies differ.
  std::optional<Mixed_meshes_3::Shell_counts> shells;
  /// The result of fitting and optimization; its status is `EMPTY` if these did not run.
  Mixed_mesh_optimization_result_3 optimization;

  /// Whether the surface is perpendicular to the axes, and all elements are boxes between its planes, in
  /// layers of one width between two planes. Such a mesh may leave much of the budget unused.
  bool is_lattice_on_surface = false;
  bool is_kept = false; ///< whether the mesh is the one kept when the visitor stopped the run

  /// Whether there is a mesh, which is as asked for or as close to that as possible, or incomplete.
  bool has_mesh() const { return status <= Mixed_mesh_status::BOUNDARY_NOT_MANIFOLD || is_kept; }
};

} // namespace CGAL

#endif // CGAL_MIXED_MESH_RESULT_3_H
