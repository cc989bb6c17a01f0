// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fine first, then fewer: a mesh that is fine enough to be faithful is fitted once, and loses vertices until
// the budget is met.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_SIMPLIFY_TO_BUDGET_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_SIMPLIFY_TO_BUDGET_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/fitting/Followed_features.h>
#include <CGAL/Mixed_mesh_3/internal/elements/Interface_curves.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/simplify.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/coarsen_to_budget.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/cut_by_interfaces.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/fill_budget.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/layer_cells.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/make_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/sharp_cells.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/stage_scopes.h>
#include <CGAL/Mixed_mesh_3/internal/surface/self_intersections.h>
#include <CGAL/Mixed_mesh_3/internal/transitions/apply_transitions.h>
#include <CGAL/Mixed_mesh_3/quality.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Whether a fine mesh is made first: for a domain without sheets, refined everywhere alike.
inline bool begins_fine(const Located_octree& root, const Mixed_mesh_criteria_3& c)
{
  return root.is_region_everywhere() && !root.domain().has_sheets() && c.fit_to_surface()
         && c.boundary_mode() == Boundary_mode::VERTEX_ORDER
         && c.base_level() == Mixed_mesh_criteria_3::automatic && c.thin_parts() == Thin_parts::WHERE_NEEDED;
}

/// The number of vertices of the fine mesh, for a budget.
inline std::size_t number_of_fine_vertices(std::size_t budget)
{
  // With 3 times the budget, mean distances of parts with edges are larger by a tenth to a half, with 4 the
  // time is that of as many moves as the optimization of the whole. Beyond some number, the surface of a fine
  // mesh has vertices enough, and removing more would take more time than all other stages.
  constexpr double multiple = 4, most_removed = 30000;
  return budget + std::size_t((std::min)((multiple - 1) * double(budget), most_removed));
}

/// How many times the budget cells may have that are split for narrow places and for the topology.
constexpr std::size_t most_cells_for_narrow_places = 8, most_vertices_for_topology = 16;

/// Lets the octree begin with cells that are small enough for sharp edges that are near to each other, and
/// for curved ones, as far as the budget allows.
/// \param size edge of the cells that the fine mesh has anyway
inline void resolve_sharp_edges(Meshing_state& s, double size)
{
  constexpr double reach = 2;         // wider places are resolved by the cells that there are anyway
  constexpr double samples = 8;       // in a cell
  constexpr double smallest = 1. / 8; // of these cells
  const Sharp_edges edges = s.root.domain().sharp_edges(s.criteria.sharp_angle());
  if(edges.edges.empty())
    return;
  const std::vector<Narrow_place> places = narrow_places(Sharp_features(edges, size), reach * size,
                                                         size / samples);
  const std::size_t most = most_cells_for_narrow_places * s.criteria.maximal_number_of_vertices();
  for(double share = smallest; !places.empty() && share < reach; share *= 2) {
    Located_octree octree = s.root;
    if(!refine_to_level(octree, s.coarsest_level(), s.budget()))
      return;
    split_narrow_cells(octree, places, share * size);
    if(octree.number_of_cells() <= most) {
      s.thin_start = std::move(octree);
      return;
    }
  }
}

/// Refines the octree for the fine mesh: until it has its number of vertices, and sharp edges and topology
/// are resolved.
inline void fill_fine_octree(Meshing_state& s)
{
  const Stage_scope scope(s.visitor, Stage::OCTREE);
  if(fill_lattice(s))
    return;
  const std::size_t budget = s.criteria.maximal_number_of_vertices();
  std::size_t number = number_of_fine_vertices(budget);
  resolve_sharp_edges(s, std::cbrt(volume_of_domain(s.root) / double(number)));
  if(s.thin_start) // what is beside these places needs cells as well
    number += s.try_octree(*s.thin_start).number_of_vertices;
  s.number_exchanged = number - s.budget();
  fill_budget(s);
  s.number_exchanged = 0;
}

/// Makes the fine mesh of one subdomain.
/// \return an empty mesh if there is none, or if the octree is the mesh
inline Core_mesh fine_mesh(Meshing_state& s)
{
  fill_fine_octree(s);
  if(s.is_stopped || s.result.is_lattice_on_surface)
    return {};
  const std::size_t most = most_vertices_for_topology * s.criteria.maximal_number_of_vertices();
  if(s.misfit_on_lattice().is_topology_wrong())
    find_finer_octree(s, s.octree, 0, most);
  s.make_best_again();
  s.result.number_of_vertices_needed = 0; // it is simplified
  describe_octree(s);
  if(!s.result.has_mesh())
    return {};
  Core_mesh fine = split_to_tetrahedra(assembled_mesh(s));
  s.best.release();
  return fine;
}

/// Splits cells at the surfaces of subdomains that these cells would not be round enough for, as long as
/// there are not too many cells.
inline void split_cells_at_small_subdomains(Located_octree& octree, std::size_t most)
{
  // Width in mean chords, which are 4/3 of the radius of a ball: edges of two thirds of it are as long as
  // 0.27 of the radius, and the polyhedron lacks some hundredths of the volume.
  constexpr double share_of_chord = 0.3, samples = 2; // in a width
  const Any_domain& domain = octree.domain();
  for(Subdomain_index index : domain.subdomain_indices()) {
    const double width = share_of_chord * domain.mean_chord_length(index);
    std::vector<Narrow_place> places;
    for(const auto& p : domain.surface_samples(width / samples, index))
      places.push_back({to_vec3(p), width});
    Located_octree trial = octree;
    if(places.size() <= most)
      split_narrow_cells(trial, places, 0);
    if(trial.number_of_cells() <= most)
      octree = std::move(trial);
  }
}

/// The number of vertices where interfaces meet in such a way that none of them can be removed.
inline std::size_t number_of_corners(const Core_mesh& mesh, const Any_surface& domain)
{
  const Interface_curves curves(Strata(domain).sorted_faces(mesh).faces, mesh.number_of_vertices());
  std::size_t number = 0;
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
    number += curves.is_corner(v);
  return number;
}

/// Makes the fine mesh of several subdomains: its vertices on interfaces are there, but for curves where
/// interfaces meet.
/// \return an empty mesh if there is none, or if the surfaces do not fit together: where they should be one,
/// and cut each other all over, there would be too many vertices that have to stay
inline Core_mesh fine_mesh_of_subdomains(Meshing_state& s)
{
  constexpr std::size_t vertices_per_corner = 10; // of the budget, at least
  constexpr std::size_t vertices_per_cell = 2;    // about, in a mesh that is cut
  // Cells for each vertex of the budget. With four times as many, a head of five labels has half as many
  // corners and takes twice as long; three spherical layers need no more.
  constexpr std::size_t most_cells_for_layers = 2;
  const std::size_t budget = s.criteria.maximal_number_of_vertices();
  Located_octree octree = s.root;
  {
    const Stage_scope scope(s.visitor, Stage::OCTREE);
    if(!refine_to_level(octree, s.coarsest_level(), s.budget()))
      return {};
    Refinement_sequence sequence(octree, s.graded_radius());
    while(vertices_per_cell * sequence.number_of_cells(sequence.number_of_steps())
            < number_of_fine_vertices(budget)
          && sequence.extend()) {
    }
    octree = sequence.octree(sequence.number_of_steps());
    split_cells_at_small_subdomains(octree, octree.number_of_cells() + budget);
    split_layer_cells(octree, most_cells_for_layers * budget);
  }
  s.octree = std::move(octree);
  s.result.status = Mixed_mesh_status::SUCCESS;
  if(!describe_cells(s))
    s.result.status = Mixed_mesh_status::REGION_NOT_MET;
  if(!s.go_on() || !s.result.has_mesh())
    return {};
  Lattice_mesh lattice;
  {
    const Stage_scope scope(s.visitor, Stage::TRANSITIONS);
    lattice = apply_transitions(s.octree, s.criteria.transition_templates(), s.criteria.number_of_threads);
  }
  const Stage_scope scope(s.visitor, Stage::BOUNDARY);
  Core_mesh fine = cut_by_interfaces(s.octree, lattice);
  if(fine.is_empty()) {
    s.result.status = Mixed_mesh_status::EMPTY;
  } else if(vertices_per_corner * number_of_corners(fine, s.root.domain()) > budget) {
    s.result.status = Mixed_mesh_status::BUDGET_TOO_SMALL;
    fine.clear();
  }
  return fine;
}

/// Brings the boundary of the fine mesh onto the surface and its sharp edges. Vertices that do not arrive are
/// left where they are, as they will be removed first.
inline void fit_fine_mesh(Meshing_state& s, Core_mesh& mesh, Followed_features& followed)
{
  const auto rough = Mixed_mesh_optimization_criteria_3()
                       .quality_bound(s.quality_bound)
                       .sharp_angle(s.criteria.sharp_angle())
                       .number_of_bisections(s.criteria.maximal_number_of_vertices() / 10) // on sharp edges
                       .number_of_rounds(1);
  optimize_bounded(
    mesh, s.root.domain(), {rough, s.criteria.number_of_threads}, Aspect_ratio_quality_3(),
    [&s] { return s.go_on(); }, {0, 0, true}, {}, &followed);
}

/// Makes a mesh with the vertices of the budget out of a finer one.
/// \param mesh empty; stays so if there is none
inline void make_simplified_mesh(Meshing_state& s, Core_mesh& mesh)
{
  // Largest bound in bounds that were asked for: in thin walls there is room for flatter elements only. And
  // what few elements may have between layers, which no octree resolves better; above, they are no use.
  constexpr double largest_multiple = 5, largest_between_layers = 30;
  const std::size_t budget = s.criteria.maximal_number_of_vertices();
  const auto note_stop = [&s] { s.result.status = Mixed_mesh_status::STOPPED; };
  Core_mesh fine = s.has_several_subdomains() ? fine_mesh_of_subdomains(s) : fine_mesh(s);
  if(s.result.is_lattice_on_surface)
    return make_mesh(s, mesh);
  if(fine.is_empty())
    return s.is_stopped ? note_stop() : void();
  const Stage_scope scope(s.visitor, Stage::OPTIMIZATION);
  Followed_features followed;
  fit_fine_mesh(s, fine, followed);
  const std::size_t number = fine.number_of_vertices();
  double bound = s.has_quality_bound() ? s.quality_bound
                                       : Mixed_mesh_optimization_criteria_3::default_quality_bound;
  const double distance = s.result.tolerance > 0 ? s.result.tolerance
                                                 : share_of_edge_tolerated * s.mean_edge();
  const double largest = s.criteria.is_quality_bound_strict() ? bound : largest_multiple * bound;
  const bool is_kept = s.criteria.keep_mesh_if_stopped() && s.best.is_manifold(); // within the budget only
  if(s.is_stopped && !is_kept)
    return note_stop();
  const bool is_simplified = simplify(fine, followed, s.root.domain(), budget, distance, bound, largest,
                                      [&] { return s.go_on() || is_kept; });
  if(!is_simplified) {
    s.result.status = s.is_stopped ? Mixed_mesh_status::STOPPED : Mixed_mesh_status::BUDGET_TOO_SMALL;
    return;
  }
  if(s.has_quality_bound())
    s.quality_bound = bound;
  mesh = std::move(fine);
  s.result.number_of_vertices_needed = mesh.number_of_vertices();
  s.result.number_of_collapsed_vertices = number - mesh.number_of_vertices();
  s.result.number_of_transition_vertices = s.result.number_of_boundary_vertices_inserted = 0;
  s.result.number_of_vertices_in_region = number_of_vertices_in_region(mesh);
  if(s.is_stopped) {
    s.result.is_kept = !cuts_itself(mesh);
    if(!s.result.is_kept)
      mesh.clear();
    return note_stop();
  }
  optimize_boundary(s, mesh, {}, &followed);
  if(mesh.is_empty())
    return;
  const Mixed_mesh_optimization_result_3& fit = s.result.optimization;
  const bool is_above = fit.number_of_elements_above_bound > 0;
  const double worst = is_above ? quality_statistics(mesh).back().maximum : 0;
  const bool is_bad = worst > largest
                      && (!s.has_several_subdomains() || worst > largest_between_layers * bound);
  if(!fit.is_boundary_simple || is_bad) { // the octree of the budget is tried
    mesh.clear();
    s.result.is_kept = false;
    s.result.status = s.is_stopped ? Mixed_mesh_status::STOPPED : Mixed_mesh_status::BUDGET_TOO_SMALL;
    return;
  }
  if(is_above)
    s.result.quality_bound = worst;
  note_lost_cells(s, mesh);
  note_share_filled(s, mesh.number_of_vertices());
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_SIMPLIFY_TO_BUDGET_H
