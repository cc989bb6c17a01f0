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
#include <CGAL/Mixed_mesh_3/internal/fitting/simplify.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/fine_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/make_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/stage_scopes.h>
#include <CGAL/Mixed_mesh_3/internal/surface/self_intersections.h>
#include <CGAL/Mixed_mesh_3/quality.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Whether a fine mesh is made first: for a domain without sheets, unless only cells in the region are to be
/// refined.
inline bool begins_fine(const Located_octree& root, const Mixed_mesh_criteria_3& c)
{
  return c.simplification() && (root.is_region_everywhere() || c.grading() > 0) && !root.domain().has_sheets()
         && c.fit_to_surface() && c.boundary_mode() == Boundary_mode::VERTEX_ORDER
         && c.base_level() == Mixed_mesh_criteria_3::automatic;
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

/// What elements and boundary may lose on the way from a fine mesh to the budget.
struct Simplification_limits
{
  double distance;       ///< from the surface, as asked for
  double usual_distance; ///< that nearly every mesh keeps
  double bound;          ///< of elements
  double bound_to_fit;   ///< the same, while the mesh is finer than the budget
  double largest_bound;  ///< the same, where there is room for flatter elements only
  bool stays_simple;     ///< whether the boundary does not cut itself, and stays so
};

/// Brings the boundary of a mesh that is finer than the budget onto the surface, its sharp edges, and curves
/// where interfaces meet, and improves its elements. Vertices that do not arrive are left where they are, as
/// they will be removed first, and vertices of flat elements soon after. The mesh stays as it is if its
/// boundary would cut itself then, and did not before.
/// \param number_of_bisections on sharp edges
inline void fit_fine_mesh(Meshing_state& s, const Simplification_limits& limits,
                          std::size_t number_of_bisections, Core_mesh& mesh, Followed_features& followed)
{
  const auto rough = Mixed_mesh_optimization_criteria_3()
                       .quality_bound(limits.bound_to_fit)
                       .sharp_angle(s.criteria.sharp_angle())
                       .number_of_bisections(number_of_bisections)
                       .number_of_rounds(1);
  Core_mesh start = limits.stays_simple ? mesh : Core_mesh();
  Followed_features followed_at_start = limits.stays_simple ? followed : Followed_features();
  const Mixed_mesh_optimization_result_3 result = optimize_bounded(
    mesh, s.root.domain(), {rough, s.criteria.number_of_threads}, Aspect_ratio_quality_3(),
    [&s] { return s.go_on(); }, {0, 0, true, limits.stays_simple}, &followed);
  if(limits.stays_simple && !result.is_boundary_simple) {
    mesh = std::move(start);
    followed = std::move(followed_at_start);
  }
}

/// A mesh on its way to the budget.
struct Mesh_to_simplify
{
  Core_mesh mesh;
  Followed_features followed;
  double bound; ///< of elements, that was necessary so far
};

/// Removes vertices, and gives up something for their number only if the concessions say so.
/// \return whether there are so few vertices
inline bool simplify(Meshing_state& s, const Simplification_concessions& concessions, double distance,
                     std::size_t number_of_vertices, Mesh_to_simplify& m)
{
  return m.mesh.number_of_vertices() <= number_of_vertices
         || simplify(m.mesh, m.followed, s.root.domain(), Aspect_ratio_quality_3(), number_of_vertices,
                     s.radius_of_weights(), distance, m.bound, concessions,
                     [&s] { return s.go_on() || s.keeps_mesh_if_stopped(); });
}

/// The same within the limits.
inline bool simplify_within(Meshing_state& s, const Simplification_limits& limits,
                            std::size_t number_of_vertices, Mesh_to_simplify& m)
{
  return simplify(s, {false, false, limits.distance, m.bound, false}, limits.distance, number_of_vertices, m);
}

/// Removes vertices within the limits, and fits what is left, in turn: where elements are too flat for more
/// vertices to be removed, moves and flips make them better. Then the limits are given up.
/// \return whether there are so few vertices
inline bool simplify_in_turns(Meshing_state& s, const Simplification_limits& limits,
                              std::size_t number_of_vertices, Mesh_to_simplify& m)
{
  constexpr double least_share = 0.05; // of the vertices, that a turn removes
  for(std::size_t before = std::size_t(-1);
      !simplify_within(s, limits, number_of_vertices, m)
      && double(m.mesh.number_of_vertices()) <= (1 - least_share) * double(before) && !s.is_stopped;) {
    before = m.mesh.number_of_vertices();
    fit_fine_mesh(s, limits, 0, m.mesh, m.followed);
  }
  return simplify(s, {true, true, limits.usual_distance, limits.largest_bound, true}, limits.distance,
                  number_of_vertices, m);
}

/// Brings the boundary of a mesh with the vertices of the budget onto the surface. Vertices that have not
/// arrived within the bound in force do so with flatter elements, where there is room for these only; they
/// could not be removed either.
/// \param largest_bound of these elements
inline void fit_with_flatter_elements(Meshing_state& s, double largest_bound, Core_mesh& mesh,
                                      Followed_features& followed)
{
  const Mixed_mesh_status status = s.result.status;
  optimize_boundary(s, mesh, &followed);
  const std::size_t number_off = s.number_not_arrived();
  if(mesh.is_empty() || number_off == 0 || s.is_stopped || !(s.quality_bound < largest_bound))
    return;
  const Mixed_mesh_result_3 result = s.result;
  Core_mesh flatter = mesh;
  s.result.status = status;
  const double bound = std::exchange(s.quality_bound, largest_bound);
  optimize_boundary(s, flatter, &followed);
  s.quality_bound = bound;
  const bool is_better = s.result.optimization.is_boundary_simple && s.number_not_arrived() < number_off;
  if(!s.is_stopped && !is_better) {
    s.result = result;
    return;
  }
  mesh = std::move(flatter);
  if(!mesh.is_empty())
    s.result.quality_bound = (std::max)(bound, quality_statistics(mesh).back().maximum);
}

/// Brings the boundary of a mesh that has lost its vertices onto the surface.
/// \param is_last whether the mesh has all vertices of the budget; otherwise some are left for bisections
/// \param mesh is set; empty if there is none
/// \return whether there is a mesh, all of the boundary is on the surface, and the budget is filled
inline bool fit_simplified_mesh(Meshing_state& s, const Simplification_limits& limits, bool is_last,
                                std::size_t number_of_fine_vertices, Mesh_to_simplify&& m, Core_mesh& mesh)
{
  mesh = std::move(m.mesh);
  if(s.has_quality_bound())
    s.quality_bound = m.bound;
  s.result.number_of_vertices_needed = mesh.number_of_vertices();
  s.result.number_of_collapsed_vertices = number_of_fine_vertices - mesh.number_of_vertices();
  s.result.number_of_transition_vertices = s.result.number_of_boundary_vertices_inserted = 0;
  s.result.number_of_vertices_in_region = number_of_vertices_in_region(mesh);
  if(s.is_stopped) {
    s.result.status = Mixed_mesh_status::STOPPED;
    s.result.is_kept = s.keeps_mesh_if_stopped() && !cuts_itself(mesh);
    if(!s.result.is_kept)
      mesh.clear();
    return false;
  }
  if(is_last)
    fit_with_flatter_elements(s, limits.largest_bound, mesh, m.followed);
  else
    optimize_boundary(s, mesh, &m.followed);
  return !mesh.is_empty() && s.result.optimization.is_boundary_simple
         && s.number_not_arrived() <= s.number_off_tolerated()
         && double(mesh.number_of_vertices())
              >= Mixed_mesh_criteria_3::full_share * double(s.criteria.maximal_number_of_vertices());
}

/// Largest bound in bounds that were asked for: in thin walls there is room for flatter elements only.
/// Between layers, few elements may have any: no octree resolves these.
constexpr double largest_multiple_of_bound = 5;

/// Makes a mesh with the vertices of the budget out of a finer one.
/// \param is_cut whether the finer one is cut, or on the lattice
/// \param mesh empty; stays so if there is none
inline void make_simplified_mesh(Meshing_state& s, bool is_cut, Core_mesh& mesh)
{
  // The same, before vertices are removed: vertices of flat elements go early. Without that, one to five
  // vertices of plates and gears stay off the surface in the end, with 3 or 5 parts keep less of their sharp
  // edges.
  constexpr double multiple_on_the_way = 2;
  // For each vertex of the budget. Folded layers leave 30 times as many: with 8, seven meshes of cortices are
  // the same, in 1.05 times the time, with 16 in 1.4 times.
  constexpr std::size_t most_vertices_to_fit = 4;
  Core_mesh fine = is_cut ? cut_fine_mesh(s) : fine_mesh_on_lattice(s);
  if(s.result.is_lattice_on_surface)
    return make_mesh(s, mesh);
  const auto note_stop = [&s] { s.result.status = Mixed_mesh_status::STOPPED; };
  if(fine.is_empty())
    return s.is_stopped ? note_stop() : void();
  const Stage_scope scope(s.visitor, Stage::OPTIMIZATION);
  Simplification_limits limits;
  limits.bound = s.has_quality_bound() ? s.quality_bound
                                       : Mixed_mesh_optimization_criteria_3::default_quality_bound;
  limits.usual_distance = share_of_edge_tolerated * s.mean_edge();
  limits.distance = s.result.tolerance > 0 ? s.result.tolerance : limits.usual_distance;
  limits.largest_bound = (s.criteria.is_quality_bound_strict() ? 1 : largest_multiple_of_bound)
                         * limits.bound;
  limits.bound_to_fit = (std::min)(multiple_on_the_way * limits.bound, limits.largest_bound);
  limits.stays_simple = is_cut;
  const std::size_t n = s.criteria.maximal_number_of_vertices(), number = fine.number_of_vertices();
  Mesh_to_simplify m{std::move(fine), {}, limits.bound};
  // Sharp edges are found by the fit: they would be lost before.
  if(is_cut && s.root.domain().sharp_edges(s.criteria.sharp_angle()).edges.empty()) {
    simplify_within(s, limits, most_vertices_to_fit * n, m);
    m.followed = {};
  }
  fit_fine_mesh(s, limits, n / 10, m.mesh, m.followed);
  if(s.is_stopped && !s.keeps_mesh_if_stopped())
    return note_stop();
  if(!simplify_in_turns(s, limits, n, m)) {
    s.result.number_of_vertices_needed = m.mesh.number_of_vertices();
    s.result.status = s.is_stopped ? Mixed_mesh_status::STOPPED : Mixed_mesh_status::BUDGET_TOO_SMALL;
    return;
  }
  // A part of the vertices bisect edges that are far from the surface. Where these do not arrive, all are
  // left of the fine mesh; so they are where so few vertices have flat elements already.
  const Mixed_mesh_result_3 result = s.result;
  bool is_right = false;
  if(s.budget() < n && !(m.bound > limits.bound)) {
    Mesh_to_simplify fewer = m;
    is_right = simplify_in_turns(s, limits, s.budget(), fewer)
               && fit_simplified_mesh(s, limits, false, number, std::move(fewer), mesh);
  }
  if(!is_right && (mesh.is_empty() || !s.is_stopped)) {
    s.result = result;
    fit_simplified_mesh(s, limits, true, number, std::move(m), mesh);
  }
  if(mesh.is_empty())
    return;
  const Mixed_mesh_optimization_result_3& fit = s.result.optimization;
  const bool is_above = fit.number_of_elements_above_bound > 0;
  const double worst = is_above ? quality_statistics(mesh).back().maximum : 0;
  const bool is_bad = worst > limits.largest_bound && s.criteria.is_quality_bound_strict();
  if(!fit.is_boundary_simple || is_bad) { // the octree of the budget is tried
    mesh.clear();
    s.result.is_kept = false;
    s.result.status = s.is_stopped ? Mixed_mesh_status::STOPPED : Mixed_mesh_status::EMPTY;
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
