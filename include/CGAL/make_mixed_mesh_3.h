// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MAKE_MIXED_MESH_3_H
#define CGAL_MAKE_MIXED_MESH_3_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/Octree_cell_traits_3.h>
#include <CGAL/Mixed_mesh_3/internal/base/Concurrency.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/arguments.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/mesh_domain.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/usual_models.h>
#include <CGAL/Mixed_mesh_3/internal/octree/place_lattice.h>
#include <CGAL/Mixed_mesh_criteria_3.h>
#include <CGAL/Mixed_mesh_regions_3.h>
#include <CGAL/Polyhedral_mixed_mesh_region_3.h>
#include <CGAL/Mixed_mesh_result_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Named_function_parameters.h>
#include <CGAL/tags.h>

namespace CGAL {

/*!
\ingroup PkgMixedMesh3Functions

\brief Meshes a domain with mixed elements, fine in a region of interest, within a vertex budget.

The octree of the domain is split where a vertex removes most of the error of the solution in the region:
cells are smallest in the region and grow with the distance from it (`criteria.grading()`). Before that,
cells are split where the boundary would be farther from the surface than `criteria.tolerance()`. The octree
is balanced across faces and edges, and made conforming by transition templates; elements at the surface are
split so that they can follow the surface (Lobos, Bucki, Hitschfeld, Payan: sections 5.1 and 5.2). Then the
boundary is brought onto the surface, some of its edges are bisected (`criteria.share_of_bisections()`), and
the elements are optimized, as `optimize_mixed_mesh_3()` does; with `criteria.fit_to_surface(false)` boundary
vertices stay where the octree has them, all outside or on the surface.

Guarantees if `result.has_mesh()`: at most `criteria.maximal_number_of_vertices()` vertices; conforming;
the Jacobian of every element is positive on the whole element; no element has an aspect-ratio coefficient
above `criteria.quality_bound()` if that is at least 3.2, cells are cubes and the boundary mode is the
default; the boundary is a closed oriented 2-manifold unless the status says otherwise; the same input gives
the same mesh, whatever the number of threads.

\tparam ConcurrencyTag enables sequential versus parallel algorithm: `Sequential_tag`, `Parallel_tag`, which
        needs TBB, or `Parallel_if_available_tag`
\tparam Domain a model of `MixedMeshDomain_3`, or of `FaceListGraph`
\tparam Region a model of `MixedMeshRegion_3`, or of `FaceListGraph`
\tparam CellTraits a model of `OctreeCellTraits_3`
\tparam GeomTraits a model of `MixedMeshTraits_3`
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"
\tparam RegionNamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"
\param domain domain to be meshed, or its surface, with points of any CGAL kernel. \pre a surface is closed
and triangulated
\param region region to be refined, or its surface. \pre a surface is closed and triangulated
\param criteria criteria of the mesh; a number is a budget
\param cell_traits frame of the octree
\param mesh the result; cleared first
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those below
\param np_region sequence of named parameters for the region's surface

\cgalNamedParamsBegin
  \cgalParamNBegin{visitor}
    \cgalParamDescription{what is told of the progress, and may stop the run; of `np` only}
    \cgalParamType{a model of `MixedMeshVisitor_3`, as `std::ref(visitor)`}
    \cgalParamDefault{`Mixed_meshes_3::Default_visitor`}
  \cgalParamNEnd
  \cgalParamNBegin{vertex_point_map}
    \cgalParamDescription{the points of the surface that is given as `domain` (in `np`) or `region` (in
    `np_region`)}
    \cgalParamType{a model of `ReadablePropertyMap` with the vertices as keys and points as values}
    \cgalParamDefault{`get_const_property_map(CGAL::vertex_point, surface)`}
  \cgalParamNEnd
\cgalNamedParamsEnd

\return the status and the numbers of the result
\par Complexity
For n vertices and t triangles of the surfaces O(n log n + t log t), nearly linear; a query for a
      closest point for each boundary vertex that moves, and for each sample point of a tolerance
*/
template <class ConcurrencyTag = Sequential_tag, class Domain, class Region, class CellTraits,
          class GeomTraits, class NamedParameters = parameters::Default_named_parameters,
          class RegionNamedParameters = parameters::Default_named_parameters>
Mixed_mesh_result_3 make_mixed_mesh_3(const Domain& domain, const Region& region,
                                      const Mixed_mesh_criteria_3& criteria, const CellTraits& cell_traits,
                                      Mixed_mesh_3<GeomTraits>& mesh,
                                      const NamedParameters& np = parameters::default_values(),
                                      const RegionNamedParameters& np_region = parameters::default_values())
{
  namespace mm3 = Mixed_meshes_3::internal;
  const auto& d = mm3::as_domain(domain, np);
  const auto& r = mm3::as_region(region, np_region);
  return mm3::with_visitor(np, [&](auto& visitor) {
    return mm3::mesh_models(d, r, {criteria, mm3::number_of_threads<ConcurrencyTag>()}, cell_traits, visitor,
                            mesh);
  });
}

/*!
\ingroup PkgMixedMesh3Functions

Overload with cells parallel to the axes and the root of the criteria. If the whole surface is perpendicular
to the axes, as the surface of a box is, cells are placed such that the surface lies in lattice planes if
possible: then elements at the surface stay whole, vertices have the coordinates of the surface exactly, and
without a region all elements are hexahedra, as far as the budget allows. Cells are boxes, whose edges have a
ratio of at most the quality bound (1.25 with a region), or more in walls that are too thin for the budget.
*/
template <class ConcurrencyTag = Sequential_tag, class Domain, class Region, class GeomTraits,
          class NamedParameters = parameters::Default_named_parameters,
          class RegionNamedParameters = parameters::Default_named_parameters>
Mixed_mesh_result_3 make_mixed_mesh_3(const Domain& domain, const Region& region,
                                      const Mixed_mesh_criteria_3& criteria, Mixed_mesh_3<GeomTraits>& mesh,
                                      const NamedParameters& np = parameters::default_values(),
                                      const RegionNamedParameters& np_region = parameters::default_values())
{
  namespace mm3 = Mixed_meshes_3::internal;
  const auto& d = mm3::as_domain(domain, np);
  const auto& r = mm3::as_region(region, np_region);
  return make_mixed_mesh_3<ConcurrencyTag>(d, r, criteria, mm3::cell_traits_of(d, r, criteria), mesh, np);
}

/*!
\ingroup PkgMixedMesh3Functions

Overload without a region: refined everywhere alike, and somewhat more at the surface.
*/
template <class ConcurrencyTag = Sequential_tag, class Domain, class GeomTraits,
          class NamedParameters = parameters::Default_named_parameters>
Mixed_mesh_result_3 make_mixed_mesh_3(const Domain& domain, const Mixed_mesh_criteria_3& criteria,
                                      Mixed_mesh_3<GeomTraits>& mesh,
                                      const NamedParameters& np = parameters::default_values())
{
  return make_mixed_mesh_3<ConcurrencyTag>(domain, Everywhere_mixed_mesh_region_3(), criteria, mesh, np);
}

} // namespace CGAL

#endif // CGAL_MAKE_MIXED_MESH_3_H
