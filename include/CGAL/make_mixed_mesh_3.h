// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MAKE_MIXED_MESH_3_H
#define CGAL_MAKE_MIXED_MESH_3_H

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/Default_visitor.h>
#include <CGAL/Mixed_mesh_3/Octree_cell_traits_3.h>
#include <CGAL/Mixed_mesh_3/internal/Boundary_stage.h>
#include <CGAL/Mixed_mesh_3/internal/Located_octree.h>
#include <CGAL/Mixed_mesh_3/internal/apply_transitions.h>
#include <CGAL/Mixed_mesh_3/internal/assemble_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/refine_in_region.h>
#include <CGAL/Mixed_mesh_criteria_3.h>
#include <CGAL/Mixed_mesh_regions_3.h>
#include <CGAL/Polyhedral_mixed_mesh_domain_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Named_function_parameters.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {

/// How `make_mixed_mesh_3()` ended.
enum class Mixed_mesh_status {
  SUCCESS,            ///< the budget is filled to at least 97 %
  BUDGET_NOT_FILLED,  ///< valid, but below 97 %: each cell tried would exceed the budget
  PARTS_LOST,         ///< valid, but parts of the domain thinner than a cell are not meshed
  BUDGET_TOO_SMALL,   ///< no mesh: the coarsest one has more vertices than the budget
  EMPTY,              ///< no mesh: no octree vertex is inside the domain
  REGION_NOT_MET,     ///< no mesh: the region does not meet the domain
  BOUNDARY_NOT_MANIFOLD, ///< the boundary is pinched where no further cell can be added
  STOPPED             ///< no mesh: the visitor said so
};

/// What `make_mixed_mesh_3()` did.
struct Mixed_mesh_result_3
{
  Mixed_mesh_status status = Mixed_mesh_status::EMPTY;
  int base_level = 0;
  int deepest_level = 0;
  std::size_t number_of_cells = 0;                       ///< leaves that meet the domain
  /// Those of the mesh; without one, those (at least) of the coarsest mesh at `base_level`.
  std::size_t number_of_vertices_needed = 0;
  std::size_t number_of_transition_vertices = 0;         ///< inserted by the transition templates
  std::size_t number_of_boundary_vertices_inserted = 0;  ///< inserted by the boundary stage
  std::size_t number_of_relabelled_vertices = 0;         ///< to make the boundary a manifold
  std::size_t number_of_trials = 0;                      ///< octrees tried in search of the budget
  /// Cells that meet the domain, but are more than a cell away from the mesh: parts of the domain
  /// thinner than a cell that no octree vertex is inside of.
  std::size_t number_of_lost_cells = 0;
  Bbox_3 lost_cells; ///< what contains those cells

  /// Whether there is a mesh, and it is what was asked for or as close to it as possible.
  bool has_mesh() const
  {
    return status == Mixed_mesh_status::SUCCESS || status == Mixed_mesh_status::BUDGET_NOT_FILLED
           || status == Mixed_mesh_status::PARTS_LOST
           || status == Mixed_mesh_status::BOUNDARY_NOT_MANIFOLD;
  }
};

namespace Mixed_meshes_3 {
namespace internal {

// Cells of 1/8 of the domain; see the manual, "Choosing parameters".
constexpr int default_base_level = 3;
constexpr int coarsest_automatic_base_level = 1;
constexpr int finest_automatic_base_level = 6;
constexpr double tolerated_share_of_lost_cells = 0.05;

// One octree with the mesh made of it.
struct Candidate
{
  std::size_t number_of_vertices = 0;
  bool is_stopped = false; // by the visitor
  Lattice_mesh mesh;
  Boundary_pieces boundary;

  bool is_manifold() const { return boundary.defects.empty(); }
};

template <class Octree_>
std::size_t number_of_cells(const Octree_& located)
{
  std::size_t n = 0;
  for(Octree::Node_index c = 0; c < located.octree().size(); ++c)
    n += located.octree().is_leaf(c) && located.is_alive(c);
  return n;
}

// The leaves that meet the domain while neither they nor their neighbours have elements.
template <class Octree_>
std::vector<Octree::Node_index> lost_cells(const Octree_& located, const Candidate& candidate)
{
  const Octree& octree = located.octree();
  std::vector<std::uint8_t> is_meshed(octree.size(), 0);
  for(std::size_t e = 0; e < candidate.mesh.cells.size(); ++e)
    if(!candidate.boundary.is_replaced[e])
      is_meshed[candidate.mesh.cells[e]] = 1;
  for(Element_index e : candidate.boundary.origins)
    is_meshed[candidate.mesh.cells[e]] = 1;
  for(Octree::Node_index n = Octree::Node_index(octree.size()) - 1; n > 0; --n)
    if(is_meshed[n])
      is_meshed[octree.parent(n)] = 1;

  const auto directions = neighbour_directions(Adjacency::VERTEX);
  std::vector<Octree::Node_index> lost;
  for(Octree::Node_index n = 0; n < octree.size(); ++n)
    if(octree.is_leaf(n) && located.is_alive(n) && !is_meshed[n]
       && std::none_of(directions.begin(), directions.end(), [&](const std::array<int, 3>& d) {
            const Octree::Node_index m = octree.neighbour(n, d);
            return m != Octree::no_node && is_meshed[m];
          }))
      lost.push_back(n);
  return lost;
}

template <class Domain, class Region, class CellTraits, class Mesh, class Visitor>
Mixed_mesh_result_3 make_mesh(const Domain& domain, const Region& region,
                              const Mixed_mesh_criteria_3& criteria, const CellTraits& traits,
                              Mesh& mesh, Visitor& visitor)
{
  using Octree_ = Located_octree<Domain, Region, CellTraits>;
  const std::size_t budget = criteria.maximal_number_of_vertices();
  const unsigned threads = criteria.number_of_threads();
  Mixed_mesh_result_3 result;
  mesh.clear();

  // The stages that follow the octree, for each octree on the way to the budget.
  const auto try_octree = [&](const Octree_& octree) {
    Candidate c;
    visitor.end_stage(Stage::OCTREE);
    c.is_stopped = !visitor.go_on();
    if(!c.is_stopped) {
      visitor.begin_stage(Stage::TRANSITIONS);
      c.mesh = apply_transitions(octree, criteria.transition_templates(), threads);
      visitor.end_stage(Stage::TRANSITIONS);
      visitor.begin_stage(Stage::BOUNDARY);
      c.boundary = split_boundary(octree, c.mesh, criteria.boundary_mode(), threads);
      visitor.end_stage(Stage::BOUNDARY);
      ++result.number_of_trials;
      c.number_of_vertices = c.boundary.number_of_vertices;
      visitor.progress(c.number_of_vertices, budget);
    }
    visitor.begin_stage(Stage::OCTREE);
    return c;
  };

  // If no base level is given: coarser than the default if the budget demands it; finer, as far as the
  // budget allows, if much of a thin domain would have no elements.
  const bool is_automatic = criteria.base_level() == Mixed_mesh_criteria_3::automatic;
  int base_level = is_automatic ? default_base_level : criteria.base_level();
  visitor.begin_stage(Stage::OCTREE);
  const Octree_ root(domain, region, traits);
  Octree_ octree(root);
  Candidate best;
  std::vector<Octree::Node_index> lost;
  for(int level = base_level, step = 0;; level += step) {
    Octree_ trial(root);
    Candidate candidate = refine_in_region(trial, budget, level, try_octree);
    const bool is_above = candidate.number_of_vertices > budget;
    if(is_above && step <= 0) {
      result.base_level = level;
      result.number_of_vertices_needed = candidate.number_of_vertices;
    }
    if(candidate.is_stopped || !is_above || step <= 0) {
      base_level = level;
      octree = std::move(trial);
      best = std::move(candidate);
    }
    if(best.is_stopped)
      break;
    lost = lost_cells(octree, best);
    const bool is_too_coarse = best.number_of_vertices == 0
                               || double(lost.size())
                                    > tolerated_share_of_lost_cells * double(number_of_cells(octree));
    if(is_automatic && is_above && step <= 0 && level > coarsest_automatic_base_level)
      step = -1;
    else if(is_automatic && !is_above && step >= 0 && is_too_coarse && level < finest_automatic_base_level)
      step = 1;
    else
      break;
  }
  visitor.end_stage(Stage::OCTREE);

  const std::size_t n = best.number_of_vertices;
  if(n != 0 || result.number_of_vertices_needed == 0) { // else: of the coarsest mesh that is not empty
    result.number_of_vertices_needed = n;
    result.base_level = base_level;
  }
  result.number_of_cells = number_of_cells(octree);
  result.number_of_lost_cells = lost.size();
  for(Octree::Node_index c : lost)
    result.lost_cells += traits.cell(octree.octree().corner(c), octree.octree().side(c)).bbox();
  bool meets_region = false;
  for(Octree::Node_index c = 0; c < octree.octree().size(); ++c)
    if(octree.octree().is_leaf(c) && octree.is_alive(c)) {
      result.deepest_level = (std::max)(result.deepest_level, octree.octree().level(c));
      meets_region = meets_region || octree.is_in_region(c);
    }
  const auto& is_used = best.boundary.is_used;
  result.number_of_transition_vertices = std::size_t(
    std::count(is_used.begin() + std::ptrdiff_t(best.mesh.first_inserted_vertex),
               is_used.end() - std::ptrdiff_t(best.boundary.number_of_inserted_vertices), 1));
  result.number_of_boundary_vertices_inserted = best.boundary.number_of_inserted_vertices;
  result.number_of_relabelled_vertices = best.boundary.number_of_relabelled_vertices;
  result.status = best.is_stopped                           ? Mixed_mesh_status::STOPPED
                  : result.number_of_vertices_needed > budget ? Mixed_mesh_status::BUDGET_TOO_SMALL
                  : n == 0                                  ? Mixed_mesh_status::EMPTY
                  : !meets_region                           ? Mixed_mesh_status::REGION_NOT_MET
                  : !best.is_manifold()                     ? Mixed_mesh_status::BOUNDARY_NOT_MANIFOLD
                  : !lost.empty()                           ? Mixed_mesh_status::PARTS_LOST
                  : double(n) < 0.97 * double(budget)       ? Mixed_mesh_status::BUDGET_NOT_FILLED
                                                            : Mixed_mesh_status::SUCCESS;
  if(result.has_mesh()) {
    visitor.begin_stage(Stage::ASSEMBLY);
    assemble_mesh(octree, best.mesh, best.boundary, mesh);
    visitor.end_stage(Stage::ASSEMBLY);
  }
  return result;
}

} // namespace internal
} // namespace Mixed_meshes_3

/*!
\brief Meshes a domain with mixed elements, fine in a region of interest, within a vertex budget.

The octree of the domain is split in the region only (single cells around it apart, where a small budget
would be left over), balanced across faces and edges, and made
conforming by transition templates; elements at the surface are split so that they can follow it
(Lobos, Bucki, Hitschfeld, Payan: sections 5.1 and 5.2). Boundary vertices stay where the octree has
them; all are outside or on the surface.

Guarantees if `result.has_mesh()`: at most `criteria.maximal_number_of_vertices()` vertices; conforming;
every element has positive volume, and so have its corner tetrahedra; the boundary is a closed
oriented 2-manifold unless the status says otherwise; the same input gives the same mesh, whatever the
number of threads.

\tparam Domain a model of `MixedMeshDomain_3`
\tparam Region a model of `MixedMeshRegion_3`
\tparam CellTraits a model of `OctreeCellTraits_3`
\tparam GeomTraits a model of `MixedMeshTraits_3`
\param domain what to mesh
\param region where to refine
\param criteria the budget, and how to mesh
\param cell_traits the frame of the octree
\param mesh the result; cleared first
\param np an optional sequence of named parameters: `visitor(std::ref(v))` with `v` a model of
       `MixedMeshVisitor_3` (default: `Mixed_meshes_3::Default_visitor`)
\return the status and what was done
\cost linear in the number of vertices, and in the number of triangles of the surfaces
*/
template <class Domain, class Region, class CellTraits, class GeomTraits,
          class NamedParameters = parameters::Default_named_parameters>
Mixed_mesh_result_3 make_mixed_mesh_3(const Domain& domain, const Region& region,
                                      const Mixed_mesh_criteria_3& criteria,
                                      const CellTraits& cell_traits, Mixed_mesh_3<GeomTraits>& mesh,
                                      const NamedParameters& np = parameters::default_values())
{
  using Visitor = typename internal_np::Lookup_named_param_def<
    internal_np::visitor_t, NamedParameters, Mixed_meshes_3::Default_visitor>::reference;
  Mixed_meshes_3::Default_visitor default_visitor;
  Visitor visitor = parameters::choose_parameter(
    parameters::get_parameter_reference(np, internal_np::visitor), default_visitor);
  return Mixed_meshes_3::internal::make_mesh(domain, region, criteria, cell_traits, mesh, visitor);
}

/// As above, with cells parallel to the axes and the root that the criteria say.
template <class Domain, class Region, class GeomTraits,
          class NamedParameters = parameters::Default_named_parameters>
Mixed_mesh_result_3 make_mixed_mesh_3(const Domain& domain, const Region& region,
                                      const Mixed_mesh_criteria_3& criteria,
                                      Mixed_mesh_3<GeomTraits>& mesh,
                                      const NamedParameters& np = parameters::default_values())
{
  const Mixed_meshes_3::Axis_aligned_octree_cell_traits_3 traits(domain.bbox(),
                                                                 criteria.root_cell());
  return make_mixed_mesh_3(domain, region, criteria, traits, mesh, np);
}

/*!
As above, for two closed triangulated surfaces and a vertex budget.

\tparam Surface, RegionSurface models of `FaceListGraph`, with points of any CGAL kernel
\param surface the surface of the domain. \pre closed and triangulated
\param region_surface the surface of the region of interest. \pre closed and triangulated
\param maximal_number_of_vertices the vertex budget. \pre at least 1
\param mesh the result; cleared first
\param np an optional sequence of named parameters, as above
*/
template <class Surface, class RegionSurface, class GeomTraits,
          class NamedParameters = parameters::Default_named_parameters>
Mixed_mesh_result_3 make_mixed_mesh_3(const Surface& surface, const RegionSurface& region_surface,
                                      std::size_t maximal_number_of_vertices,
                                      Mixed_mesh_3<GeomTraits>& mesh,
                                      const NamedParameters& np = parameters::default_values())
{
  return make_mixed_mesh_3(Polyhedral_mixed_mesh_domain_3(surface),
                           Polyhedral_mixed_mesh_region_3(region_surface),
                           Mixed_mesh_criteria_3(maximal_number_of_vertices), mesh, np);
}

} // namespace CGAL

#endif // CGAL_MAKE_MIXED_MESH_3_H
