// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The state that the steps of the method share.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_MESHING_STATE_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_MESHING_STATE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Concurrency.h>
#include <CGAL/Mixed_mesh_3/internal/base/Core_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/boundary/lost_cells.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Optimization_effort.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/Candidate.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/Misfit.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/Tolerance_search.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/base_level.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Located_octree.h>
#include <CGAL/Mixed_mesh_3/internal/octree/place_lattice.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Refinement_sequence.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/Any_visitor.h>
#include <CGAL/Mixed_mesh_criteria_3.h>
#include <CGAL/Mixed_mesh_result_3.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The tolerance by default, as a share of the edge of the cube that a vertex of the budget has to serve.
constexpr double share_of_edge_tolerated = 0.42;

/// Share of the tolerance that the distance should be within at the points where it is measured: the distance
/// between these points is larger by about a tenth at most.
constexpr double share_of_tolerance = 0.9;

/// The octree on its way to the budget, the mesh of it on the lattice, and what is known of both. The steps
/// of the method are functions of this state.
struct Meshing_state
{
  const Meshing_criteria& criteria;
  Any_visitor& visitor;
  const Located_octree root; // with nothing but its root
  Located_octree octree;
  const double radius; // of the region
  const Lattice_on_surface lattice;
  Candidate best;
  std::vector<Octree::Node_index> lost;
  std::optional<Located_octree> start;  // narrow places at sharp edges are resolved
  bool is_stopped = false;              // by the visitor, which is not asked again then
  std::size_t number_beyond_budget = 0; // vertices that the octree may have, to be removed
  double quality_bound;                 // in force: larger than that of the criteria where walls need it
  Mixed_mesh_result_3 result;
  Tolerance_search tolerance_search;

  /// \param r the octree with nothing but its root
  Meshing_state(const Located_octree& r, const Meshing_criteria& c, Any_visitor& v)
    : criteria(c), visitor(v), root(r), octree(root), radius(mean_radius_of_region(root)),
      lattice(root.cell_traits().lattice_on_surface()), quality_bound(criteria.quality_bound()),
      tolerance_search(root, criteria, visitor, result)
  {
  }

  Meshing_state(const Meshing_state&) = delete; // the search refers to members
  Meshing_state& operator=(const Meshing_state&) = delete;

  bool has_several_subdomains() const { return root.domain().subdomain_indices().size() > 1; }

  /// Of the budget, for vertices that bisect edges of the boundary.
  double share_of_bisections() const
  {
    return criteria.share_of_bisections_for(root.domain().subdomain_indices().size());
  }

  bool has_quality_bound() const
  {
    return criteria.quality_bound() < std::numeric_limits<double>::infinity();
  }

  /// The number of vertices that the octree may have; the rest is for the optimization.
  std::size_t budget() const
  {
    const std::size_t n = criteria.maximal_number_of_vertices();
    return n - std::size_t(share_of_bisections() * double(n));
  }

  /// The same, with those that will be removed.
  std::size_t octree_budget() const { return budget() + number_beyond_budget; }

  /// The approximate volume of the domain; found once, as an octree over all facets is needed for it.
  double volume() const
  {
    if(!m_volume)
      m_volume = volume_of_domain(root);
    return *m_volume;
  }

  /// The edge of the cubes that the vertices of the budget have to serve.
  double mean_edge() const { return std::cbrt(volume() / double(criteria.maximal_number_of_vertices())); }

  /// The distance from the region over which its weight decreases.
  double graded_radius() const { return criteria.grading() * radius; }

  /// The same, for weights of vertices; 0 without a region, where all weights are equal.
  double radius_of_weights() const { return root.is_region_everywhere() ? 0 : graded_radius(); }

  /// Whether there is a mesh within the budget to be kept if the run is stopped, and one is to be kept.
  bool keeps_mesh_if_stopped() const { return criteria.keep_mesh_if_stopped() && best.is_manifold(); }

  int coarsest_level() const { return (std::max)(first_base_level(criteria), lattice.level); }

  bool go_on()
  {
    is_stopped = is_stopped || !visitor.go_on();
    return !is_stopped;
  }

  /// The mesh of an octree on the lattice.
  Candidate try_octree(const Located_octree& o)
  {
    Candidate c;
    c.is_stopped = is_stopped;
    if(is_stopped)
      return c;
    c = make_candidate(o, criteria, visitor);
    is_stopped = c.is_stopped;
    result.number_of_trials += !c.is_stopped;
    return c;
  }

  /// The octree and its mesh become the best.
  void take(Located_octree o, Candidate candidate)
  {
    octree = std::move(o);
    best = std::move(candidate);
    lost = lost_cells(octree, best.mesh, best.boundary);
    result.number_of_cells = octree.number_of_cells();
  }

  /// Makes the lattice mesh of the best again, if it was released.
  void make_best_again()
  {
    if(best.is_released())
      make_lattice_mesh(octree, criteria, visitor, best);
  }

  /// The misfit of the best, whose boundary is not fitted. \pre the best is not released
  Misfit misfit_on_lattice() const
  {
    CGAL_precondition(!best.is_released());
    return best.number_of_vertices == 0
             ? Misfit::without_mesh()
             : Misfit(assembled_mesh(octree, best), root.domain(), false, lost.size(), 0, 0, 0);
  }

  Misfit misfit_of(const Core_mesh& mesh) const
  {
    if(mesh.number_of_elements() == 0)
      return Misfit::without_mesh();
    const double tolerance = criteria.tolerance(), distance = result.optimization.largest_distance;
    return Misfit(mesh, root.domain(), criteria.fit_to_surface(), result.number_of_lost_cells,
                  number_not_arrived(), number_of_lost_edges(),
                  tolerance > 0 ? distance / (share_of_tolerance * tolerance) - 1 : 0);
  }

  /// The length of sharp edges that the mesh optimized last cuts off, beyond a tolerated share, in mean
  /// edges.
  std::size_t number_of_lost_edges() const
  {
    constexpr double tolerated_share = 0.05; // half and twice of it: 18 meshes are the same (constants.md)
    const Mixed_mesh_optimization_result_3& fit = result.optimization;
    const double lost = (1 - tolerated_share) * fit.length_of_sharp_edges - fit.length_of_sharp_edges_kept;
    return lost > 0 ? std::size_t(std::ceil(lost / mean_edge())) : 0;
  }

  /// The number of boundary vertices of the mesh optimized last that are not on the surface.
  std::size_t number_not_arrived() const
  {
    const Mixed_mesh_optimization_result_3& fit = result.optimization;
    return fit.number_of_boundary_vertices - fit.number_of_arrived_vertices;
  }

  /// The number of those with which a mesh is taken at once: none of less than 10,000, as other meshes take
  /// as long as this one; more near curves in which interfaces of labels meet: 3 % of those of a head of five
  /// labels are off. Few vertices off their surface are less to see than layers that are lost, which need
  /// flat elements that octrees do not have.
  std::size_t number_off_tolerated() const
  {
    constexpr double tolerated_at_junctions = 0.05; // half and twice: 18 meshes are the same (constants.md)
    return std::size_t((has_several_subdomains() ? tolerated_at_junctions : share_not_arrived_tolerated)
                       * double(result.optimization.number_of_boundary_vertices));
  }

private:
  mutable std::optional<double> m_volume; // of the domain
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_MESHING_STATE_H
