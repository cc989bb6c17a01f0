// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MAKE_MIXED_MESH_3_H
#define CGAL_MAKE_MIXED_MESH_3_H

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/Default_visitor.h>
#include <CGAL/Mixed_mesh_3/Octree_cell_traits_3.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/Driver.h>
#include <CGAL/Mixed_mesh_3/internal/octree/place_lattice.h>
#include <CGAL/Mixed_mesh_criteria_3.h>
#include <CGAL/Mixed_mesh_regions_3.h>
#include <CGAL/Mixed_mesh_result_3.h>
#include <CGAL/Polyhedral_mixed_mesh_domain_3.h>

#include <CGAL/Named_function_parameters.h>

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {

/*!
\brief Meshes a domain with mixed elements, fine in a region of interest, within a vertex budget.

The octree of the domain is split in the region only (single cells around it apart, where a small budget
would be left over), balanced across faces and edges, and made conforming by transition templates;
elements at the surface are split so that they can follow it (Lobos, Bucki, Hitschfeld, Payan: sections
5.1 and 5.2). Then the boundary is carried onto the surface and the elements are optimized, as
`optimize_mixed_mesh_3()` does; with `criteria.fit_to_surface(false)` boundary vertices stay where the octree
has them, all outside or on the surface.

Guarantees if `result.has_mesh()`: at most `criteria.maximal_number_of_vertices()` vertices; conforming;
the Jacobian of every element is positive on the whole element; the boundary is a closed oriented
2-manifold unless the status says otherwise; the same input gives the same mesh, whatever the number of
threads.

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
  using Driver = Mixed_meshes_3::internal::Driver<Domain, Region, CellTraits, Mixed_mesh_3<GeomTraits>,
                                                  std::remove_reference_t<Visitor>>;
  return Driver(domain, region, criteria, cell_traits, visitor)(mesh);
}

namespace Mixed_meshes_3 {
namespace internal {

/// Whether a result is to be preferred: valid, then within the tolerance, then with more vertices in the region
/// (or, outside the tolerance, nearer to the surface).
inline bool is_better(const Mixed_mesh_result_3& a, const Mixed_mesh_result_3& b, double tolerance)
{
  const auto rank = [&](const Mixed_mesh_result_3& r) {
    const bool is_within = r.optimization.largest_distance <= tolerance;
    return std::make_tuple(r.has_mesh(), r.status != Mixed_mesh_status::NOT_ALL_ARRIVED, is_within,
                           is_within ? double(r.number_of_vertices_in_region) : -r.optimization.largest_distance);
  };
  return rank(a) > rank(b);
}

} // namespace internal
} // namespace Mixed_meshes_3

/*!
As above, with cells parallel to the axes and the root that the criteria say. With a tolerance and a budget of
at most 20,000 vertices, roots of other sizes and positions are tried too, as these decide how many vertices
are left for the region.
*/
template <class Domain, class Region, class GeomTraits,
          class NamedParameters = parameters::Default_named_parameters>
Mixed_mesh_result_3 make_mixed_mesh_3(const Domain& domain, const Region& region,
                                      const Mixed_mesh_criteria_3& criteria,
                                      Mixed_mesh_3<GeomTraits>& mesh,
                                      const NamedParameters& np = parameters::default_values())
{
  namespace place = Mixed_meshes_3::internal;
  using Traits = Mixed_meshes_3::Axis_aligned_octree_cell_traits_3;
  const auto make = [&](const Bbox_3& root, const Mixed_mesh_criteria_3& c, Mixed_mesh_3<GeomTraits>& m) {
    return make_mixed_mesh_3(domain, region, c, Traits(root, c.root_cell()), m, np);
  };
  const std::size_t budget = criteria.maximal_number_of_vertices();
  if(!(criteria.tolerance() > 0) || criteria.root_cell() != Mixed_meshes_3::Root_cell::CUBE
     || budget > place::largest_budget_to_place_lattice)
    return make(domain.bbox(), criteria, mesh);

  // Of the roots that leave most vertices to the region, the one whose mesh is within the tolerance with most
  // vertices in the region, else nearest to it.
  Mixed_mesh_3<GeomTraits> trial;
  bool is_stopped = false;
  const std::vector<Bbox_3> roots = place::best_roots(
    place::candidate_roots(domain.bbox()), place::vertices_to_compare_roots / budget + 1,
    [&](const Bbox_3& root) -> std::size_t {
      if(is_stopped)
        return 0;
      const Mixed_mesh_result_3 result =
        make(root, Mixed_mesh_criteria_3(criteria).tolerance(0).fit_to_surface(false), trial);
      is_stopped = result.status == Mixed_mesh_status::STOPPED;
      return result.has_mesh() ? result.number_of_vertices_in_region : 0;
    });
  if(is_stopped) {
    mesh.clear();
    Mixed_mesh_result_3 result;
    result.status = Mixed_mesh_status::STOPPED;
    return result;
  }
  const Mixed_mesh_criteria_3 fitted = Mixed_mesh_criteria_3(criteria).fit_to_surface(true);
  Mixed_mesh_result_3 best = make(roots.front(), fitted, mesh);
  Bbox_3 best_root = roots.front();
  for(std::size_t i = 1; i < roots.size() && best.status != Mixed_mesh_status::STOPPED; ++i) {
    const Mixed_mesh_result_3 result = make(roots[i], fitted, trial);
    if(result.status == Mixed_mesh_status::STOPPED || place::is_better(result, best, criteria.tolerance())) {
      best = result;
      best_root = roots[i];
      std::swap(mesh, trial);
    }
  }
  if(!criteria.fit_to_surface() && best.has_mesh())
    return make(best_root, criteria, mesh);
  return best;
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
