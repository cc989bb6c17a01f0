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

/// Brings the boundary of the fine mesh onto the surface and its sharp edges. Vertices that do not arrive are
/// left where they are, as they will be removed first, and vertices of flat elements soon after.
/// \param bound that elements may have on the way to the budget
/// \param stays_simple whether the boundary does not cut itself, and stays so
inline void fit_fine_mesh(Meshing_state& s, double bound, bool stays_simple, Core_mesh& mesh,
                          Followed_features& followed)
{
  const auto rough = Mixed_mesh_optimization_criteria_3()
                       .quality_bound(bound)
                       .sharp_angle(s.criteria.sharp_angle())
                       .number_of_bisections(s.criteria.maximal_number_of_vertices() / 10) // on sharp edges
                       .number_of_rounds(1);
  optimize_bounded(
    mesh, s.root.domain(), {rough, s.criteria.number_of_threads}, Aspect_ratio_quality_3(),
    [&s] { return s.go_on(); }, {0, 0, true, stays_simple}, &followed);
}

/// Brings the boundary of a fine mesh that is cut, which is on the surface already, onto sharp edges and
/// curves where interfaces meet, and improves the elements that the cut has left. The mesh stays as it is if
/// its boundary would cut itself then.
inline void fit_cut_mesh(Meshing_state& s, double bound, Core_mesh& mesh, Followed_features& followed)
{
  Core_mesh fitted = mesh;
  fit_fine_mesh(s, bound, true, fitted, followed);
  if(cuts_itself(fitted))
    followed = {};
  else
    mesh = std::move(fitted);
}

/// Brings the boundary of a mesh with the vertices of the budget onto the surface. Vertices that have not
/// arrived within the bound in force do so with flatter elements, where there is room for these only; they
/// could not be removed either.
/// \param largest_bound of these elements
inline void fit_simplified_mesh(Meshing_state& s, double largest_bound, Core_mesh& mesh,
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

/// What elements and boundary may lose on the way from a fine mesh to the budget.
struct Simplification_limits
{
  double distance;       ///< from the surface, as asked for
  double usual_distance; ///< that nearly every mesh keeps
  double bound;          ///< of elements
  double largest_bound;  ///< the same, where there is room for flatter elements only
};

/// Removes vertices of a fine mesh, and brings the boundary onto the surface.
/// \param goal number of vertices; the rest of the budget is for bisections
/// \return whether there is a mesh, all of the boundary is on the surface, and the budget is filled
inline bool simplify_and_fit(Meshing_state& s, const Simplification_limits& limits, std::size_t goal,
                             Followed_features& followed, Core_mesh& mesh)
{
  const std::size_t number = mesh.number_of_vertices(), n = s.criteria.maximal_number_of_vertices();
  double bound = limits.bound;
  const bool is_simplified = simplify(mesh, followed, s.root.domain(), Aspect_ratio_quality_3(), goal,
                                      s.radius_of_weights(), limits.distance, bound,
                                      {true, limits.usual_distance, limits.largest_bound, true},
                                      [&s] { return s.go_on() || s.keeps_mesh_if_stopped(); });
  if(!is_simplified) {
    s.result.number_of_vertices_needed = mesh.number_of_vertices();
    mesh.clear();
    s.result.status = s.is_stopped ? Mixed_mesh_status::STOPPED : Mixed_mesh_status::BUDGET_TOO_SMALL;
    return false;
  }
  if(s.has_quality_bound())
    s.quality_bound = bound;
  s.result.number_of_vertices_needed = mesh.number_of_vertices();
  s.result.number_of_collapsed_vertices = number - mesh.number_of_vertices();
  s.result.number_of_transition_vertices = s.result.number_of_boundary_vertices_inserted = 0;
  s.result.number_of_vertices_in_region = number_of_vertices_in_region(mesh);
  if(s.is_stopped) {
    s.result.status = Mixed_mesh_status::STOPPED;
    s.result.is_kept = !cuts_itself(mesh);
    if(!s.result.is_kept)
      mesh.clear();
    return false;
  }
  if(goal < n)
    optimize_boundary(s, mesh, &followed);
  else
    fit_simplified_mesh(s, limits.largest_bound, mesh, followed);
  return !mesh.is_empty() && s.result.optimization.is_boundary_simple
         && s.number_not_arrived() <= s.number_off_tolerated()
         && double(mesh.number_of_vertices()) >= Mixed_mesh_criteria_3::full_share * double(n);
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
  Core_mesh fine = is_cut ? cut_fine_mesh(s) : fine_mesh_on_lattice(s);
  if(s.result.is_lattice_on_surface)
    return make_mesh(s, mesh);
  const auto note_stop = [&s] { s.result.status = Mixed_mesh_status::STOPPED; };
  if(fine.is_empty())
    return s.is_stopped ? note_stop() : void();
  const Stage_scope scope(s.visitor, Stage::OPTIMIZATION);
  Followed_features followed;
  Simplification_limits limits;
  limits.bound = s.has_quality_bound() ? s.quality_bound
                                       : Mixed_mesh_optimization_criteria_3::default_quality_bound;
  limits.usual_distance = share_of_edge_tolerated * s.mean_edge();
  limits.distance = s.result.tolerance > 0 ? s.result.tolerance : limits.usual_distance;
  limits.largest_bound = (s.criteria.is_quality_bound_strict() ? 1 : largest_multiple_of_bound)
                         * limits.bound;
  const double bound_on_the_way = (std::min)(multiple_on_the_way * limits.bound, limits.largest_bound);
  if(is_cut)
    fit_cut_mesh(s, bound_on_the_way, fine, followed);
  else
    fit_fine_mesh(s, bound_on_the_way, false, fine, followed);
  if(s.is_stopped && !s.keeps_mesh_if_stopped())
    return note_stop();
  // A part of the vertices bisect edges that are far from the surface. Where these do not arrive, all are
  // left of the fine mesh; not where no more could be removed than leave more than all.
  const Mixed_mesh_result_3 result = s.result;
  const std::size_t n = s.criteria.maximal_number_of_vertices();
  bool is_right = false, has_too_many = false;
  if(s.budget() < n) {
    Followed_features f = followed;
    mesh = fine;
    is_right = simplify_and_fit(s, limits, s.budget(), f, mesh);
    has_too_many = s.result.status == Mixed_mesh_status::BUDGET_TOO_SMALL
                   && s.result.number_of_vertices_needed > n;
  }
  if(!is_right && !has_too_many && !s.is_stopped) {
    s.result = result;
    mesh = std::move(fine);
    simplify_and_fit(s, limits, n, followed, mesh);
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
