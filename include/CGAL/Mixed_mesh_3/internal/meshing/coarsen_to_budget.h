// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A finer mesh than the budget allows, whose topology is right, is coarsened to the budget.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_COARSEN_TO_BUDGET_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_COARSEN_TO_BUDGET_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/boundary/split_by_order.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/coarsen.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/make_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/thin_cells.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Working_mesh.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

// How many times the budget a mesh may have that is coarsened to it: where more is wrong than the distance,
// and else.
constexpr double finer_multiple = 20, finer_multiple_for_distance = 5;

/// Octrees that get finer, level by level: where walls and gaps ask for it, or at the whole surface.
class Finer_octrees
{
  Located_octree m_octree;
  bool m_only_thin;
  int m_level;
  bool m_is_over = false;
  double m_vertices_per_cell = 0; // of the last one that was tried

  static constexpr double most_cells_per_vertex = 2; // at most, nearly
  // Share of the number of vertices that is expected from the octree before: the number for each cell hardly
  // changes, and a trial takes as long as all the smaller ones.
  static constexpr double sure_share = 0.9;

public:
  Finer_octrees(Located_octree start, bool only_thin, int level)
    : m_octree(std::move(start)), m_only_thin(only_thin), m_level(level)
  {
  }

  const Located_octree& octree() const { return m_octree; }
  bool only_thin() const { return m_only_thin; }
  bool is_over() const { return m_is_over; }
  std::size_t number_of_cells() const { return m_octree.number_of_cells(); }

  /// Goes on to the next octree that may have at most that number of vertices. \return whether there is one
  bool advance(std::size_t most)
  {
    std::vector<Octree::Node_index> leaves;
    for(; leaves.empty() && m_level < Octree::max_level; ++m_level)
      leaves = m_only_thin ? thin_cells(m_octree, m_level, 1) : cells_at_surface();
    m_octree.refine(leaves);
    m_is_over = leaves.empty()
                || (std::max)(1 / most_cells_per_vertex, sure_share * m_vertices_per_cell)
                       * double(number_of_cells())
                     > double(most);
    return !m_is_over;
  }

  /// Notes the number of vertices of the octree; those after it have more.
  void note(std::size_t number_of_vertices, std::size_t most)
  {
    m_vertices_per_cell = double(number_of_vertices) / double(number_of_cells());
    m_is_over = number_of_vertices > most;
  }

private:
  std::vector<Octree::Node_index> cells_at_surface() const
  {
    std::vector<Octree::Node_index> leaves;
    for(Octree::Node_index n : m_octree.leaves_to_refine(m_level, false))
      if(m_octree.side(n) == ON_BOUNDARY)
        leaves.push_back(n);
    return leaves;
  }
};

/// Finds an octree with which the topology is right, with cells as small as walls and gaps ask for, or with
/// all cells at the surface smaller: the one with fewer cells, nearly. It becomes the best.
/// \param start from which to start
/// \param least number of its vertices
/// \return whether there is one
inline bool find_finer_octree(Meshing_state& s, const Located_octree& start, std::size_t least,
                              std::size_t most)
{
  const Stage_scope scope(s.visitor, Stage::OCTREE);
  Finer_octrees thin(start, true, s.coarsest_level()), all(start, false, s.coarsest_level());
  while(!thin.is_over() || !all.is_over()) {
    const bool is_thin_next = all.is_over()
                              || (!thin.is_over() && thin.number_of_cells() <= all.number_of_cells());
    Finer_octrees& next = is_thin_next ? thin : all;
    if(!next.advance(most))
      continue;
    s.are_gaps_wider = next.only_thin();
    Candidate candidate = s.try_octree(next.octree());
    if(candidate.is_stopped)
      return false;
    next.note(candidate.number_of_vertices, most);
    if(next.is_over() || candidate.number_of_vertices < least || !candidate.is_manifold()
       || s.misfit_on_lattice(next.octree(), candidate, 0).is_topology_wrong())
      continue;
    s.take(next.octree(), std::move(candidate));
    return true;
  }
  return false;
}

/// The mesh of the octree, on the lattice.
inline Core_mesh assembled_mesh(const Meshing_state& s)
{
  const Stage_scope scope(s.visitor, Stage::ASSEMBLY);
  return assembled_mesh(s.octree, s.best);
}

/// The mesh with its elements split into tetrahedra, but for hexahedra in the region and near it, and for
/// elements between these.
/// \param radius of the weights that tell what is near; 0: nothing outside the region is
inline Core_mesh split_far_elements(const Core_mesh& mesh, double radius)
{
  // With 0.1, a fifth fewer hexahedra are left of 2,000 vertices; errors are the same.
  constexpr double least_weight = 0.03;
  const std::vector<double> weights = weights_of_vertices(
    Working_mesh(mesh, std::vector<Stratum>(mesh.number_of_vertices(), free_stratum)), radius);
  return split_but_hexahedra(mesh, [&](Element_index e) {
    const Element_view element = mesh.element(e);
    return mesh.attributes(e).is_in_region
           || (radius > 0 && std::all_of(element.begin(), element.end(), [&](Vertex_index v) {
                 return weights[v] > least_weight;
               }));
  });
}

/// The mesh of the octree, on the lattice, as it is coarsened.
/// \param keeps_region whether elements in the region and near it stay
inline Core_mesh mesh_to_coarsen(const Meshing_state& s, bool keeps_region)
{
  const Core_mesh assembled = assembled_mesh(s);
  return !keeps_region || s.criteria.only_tetrahedra() || s.root.is_region_everywhere()
           ? split_to_tetrahedra(assembled)
           : split_far_elements(assembled, s.graded_radius());
}

/// Brings most of the boundary of a mesh onto the surface.
inline void fit_roughly(Meshing_state& s, Core_mesh& mesh)
{
  // Share of the boundary vertices: those off the surface go first.
  constexpr double tolerated_share_not_arrived = 0.2;
  const Stage_scope scope(s.visitor, Stage::OPTIMIZATION);
  const auto rough = Mixed_mesh_optimization_criteria_3()
                       .quality_bound(s.quality_bound)
                       .sharp_angle(s.criteria.sharp_angle())
                       .number_of_rounds(1);
  optimize_bounded(mesh, s.root.domain(), {rough, s.criteria.number_of_threads}, Aspect_ratio_quality_3(),
                   [&s] { return s.go_on(); }, {tolerated_share_not_arrived});
}

/// The number of vertices of elements in the region.
inline std::size_t number_of_vertices_in_region(const Core_mesh& mesh)
{
  std::vector<std::uint8_t> is_in_region(mesh.number_of_vertices(), 0);
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
    if(mesh.attributes(e).is_in_region)
      for(Vertex_index v : mesh.element(e))
        is_in_region[v] = 1;
  return std::size_t(std::count(is_in_region.begin(), is_in_region.end(), 1));
}

/// Makes a mesh with the vertices of the budget out of a finer one.
/// \param number_of_vertices that are left for the optimization, which adds some
/// \param mesh empty; stays so if edges that may be collapsed do not suffice
inline void coarsen_and_optimize(Meshing_state& s, const Core_mesh& fine, std::size_t number_of_vertices,
                                 Coarsening_goal goal, Core_mesh& mesh)
{
  const Stage_scope scope(s.visitor, Stage::OPTIMIZATION);
  Core_mesh coarse = fine;
  if(s.is_stopped || !coarsen_to(s, coarse, number_of_vertices, goal))
    return;
  s.result.is_lattice_on_surface = false;
  s.result.number_of_vertices_needed = coarse.number_of_vertices();
  s.result.number_of_transition_vertices = s.result.number_of_boundary_vertices_inserted = 0;
  s.result.number_of_vertices_in_region = number_of_vertices_in_region(coarse);
  mesh = std::move(coarse);
  s.result.number_of_collapsed_vertices = fine.number_of_vertices() - mesh.number_of_vertices();
  const Mixed_mesh_status status = s.result.status;
  optimize_boundary(s, mesh, vertex_removal(s));
  remove_unarrived_vertices(s, mesh, status);
  note_lost_cells(s, mesh);
  note_share_filled(s, mesh.number_of_vertices());
}

/// Makes the mesh of an octree that is finer than the budget: once its boundary is on the surface, vertices
/// are removed until the budget is met, by a rule that keeps the volume if one that keeps the shape has lost
/// too much of it.
/// \param keeps_region whether elements in the region and near it stay
inline void make_coarsened_mesh(Meshing_state& s, bool keeps_region, Core_mesh& mesh)
{
  mesh.clear();
  s.make_best_again();
  describe_octree(s);
  if(!s.result.has_mesh())
    return;
  Core_mesh fine = mesh_to_coarsen(s, keeps_region);
  fit_roughly(s, fine);
  const Mixed_mesh_result_3 result = s.result;
  coarsen_and_optimize(s, fine, s.budget(), Coarsening_goal::SHAPE, mesh);
  if(s.is_stopped || !s.result.has_mesh())
    return;
  const Misfit first = s.misfit_of(mesh);
  if(!first.is_volume_wrong())
    return;
  const Mixed_mesh_result_3 first_result = s.result;
  s.result = result;
  Core_mesh other;
  coarsen_and_optimize(s, fine, s.budget(), Coarsening_goal::VOLUME, other);
  if(!s.is_stopped && s.result.optimization.number_of_elements_above_bound == 0 && s.misfit_of(other) < first)
    mesh = std::move(other);
  else
    s.result = first_result;
}

/// The best of several meshes.
struct Best_mesh
{
  Misfit misfit;
  Mixed_mesh_result_3 result;
  std::optional<Core_mesh> mesh; // none if the first one is best
  bool keeps_region = false;     // while meshes are coarsened

  /// Makes the mesh of the octree, and takes it if it is better.
  /// \param is_finer whether the octree is finer than the budget
  void try_octree(Meshing_state& s, bool is_finer)
  {
    Core_mesh other;
    if(is_finer)
      make_coarsened_mesh(s, keeps_region, other);
    else
      make_mesh(s, other);
    const Misfit of_other = s.misfit_of(other);
    if(s.is_stopped || !(of_other < misfit))
      return;
    misfit = of_other;
    result = s.result;
    mesh = std::move(other);
  }
};

/// Tries larger quality bounds with the octree as it is: into a thin wall only flatter elements fit, and
/// topology, volume and arrival have precedence. The first bound that suffices is taken, so that elements are
/// no flatter than needed.
inline void try_flatter_elements(Meshing_state& s, bool is_finer, Best_mesh& best)
{
  constexpr std::array<double, 3> multiples{1.5, 2.5, 5};
  const double bound = s.criteria.quality_bound();
  for(const double multiple : multiples) {
    if(s.is_stopped || best.misfit.has_distance_only())
      break;
    s.quality_bound = multiple * bound;
    best.try_octree(s, is_finer);
  }
  s.quality_bound = bound;
}

/// Tries finer and finer octrees, until nothing is wrong with the coarsened mesh, then flatter elements. The
/// best mesh is taken; if the run is stopped, the one that there was stays.
inline void improve_by_finer_octree(Meshing_state& s, Core_mesh& mesh, Misfit& misfit)
{
  constexpr int most_trials = 3;
  if(s.is_stopped || !s.criteria.fit_to_surface() || s.root.domain().has_sheets())
    return;
  const double multiple = misfit.has_distance_only() ? finer_multiple_for_distance : finer_multiple;
  const std::size_t most = std::size_t(multiple * double(s.criteria.maximal_number_of_vertices()));
  std::size_t least = s.budget() + s.budget() / 4;
  // The cells in the region stay small.
  Located_octree start = s.root.is_region_everywhere() ? s.root : s.octree;
  if(!refine_to_level(start, s.coarsest_level(), most))
    return;
  const Mixed_mesh_result_3 result_before = s.result;
  // Vertices off the surface and far places are no reason to give up the region; a topology, or a volume, is.
  Best_mesh best{misfit, s.result, std::nullopt, misfit.is_none()};
  bool is_finer = false;
  for(int trial = 0; trial < most_trials && !s.is_stopped && !best.misfit.is_right(); ++trial) {
    if(!find_finer_octree(s, start, least, most))
      break;
    is_finer = true;
    least = 2 * s.best.number_of_vertices;
    best.try_octree(s, is_finer);
  }
  const bool may_be_flatter = s.has_quality_bound() && !s.criteria.is_quality_bound_strict();
  if(may_be_flatter && (is_finer || best.misfit.is_topology_right())) // which no bound changes
    try_flatter_elements(s, is_finer, best);
  s.result = s.is_stopped ? result_before : best.result;
  if(best.mesh && !s.is_stopped) {
    mesh = std::move(*best.mesh);
    misfit = best.misfit;
  }
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_COARSEN_TO_BUDGET_H
