// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_OPTIMIZE_MIXED_MESH_3_H
#define CGAL_OPTIMIZE_MIXED_MESH_3_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/Aspect_ratio_quality_3.h>
#include <CGAL/Mixed_mesh_3/internal/base/Concurrency.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Bounded_optimization.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/optimize_bounded.h>
#include <CGAL/Mixed_mesh_3/internal/moves/is_valid_start.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/arguments.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/usual_models.h>
#include <CGAL/Mixed_mesh_optimization_criteria_3.h>
#include <CGAL/Mixed_mesh_optimization_result_3.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/tags.h>

namespace CGAL {

/*!
\ingroup PkgMixedMesh3Optimization

\brief Brings the boundary of a mixed mesh onto a surface, moves vertices and flips tetrahedra to improve
elements, and bisects edges of the boundary if asked to.

Boundary vertices that are not on the surface yet are brought there, each as far at a time as its elements
allow, while inner vertices give way. Then, alternately, each vertex descends on the sum of the powers (4,
later 8) of the costs of its elements, and tetrahedra are replaced by others between the same vertices where
that sum falls: 2-3 flips, and the removal of edges with up to 7 tetrahedra around. Boundary vertices slide on
the surface where an element is bad, or toward places of the surface that are farther than the tolerance. This
is the improvement of slivers that the paper announces (Lobos, Bucki, Hitschfeld, Payan: section 7).

Up to `criteria.number_of_bisections()` edges of the boundary, none by default, are bisected after the first
round: the middle goes to the closest point of the surface, and the tetrahedra around the edge are split in
two. Each bisection adds one vertex, on the surface, behind the existing vertices.

No element gets a cost above `criteria.quality_bound()`, or, if an element is above already, above the worst
one at the start: where that bound and the surface conflict, boundary vertices do not arrive. In the end,
these vertices are merged with neighbors on the boundary, where the elements stay within the bound and the
topology is the same, or removed with their elements, where the boundary stays near and the topology the same.

Guarantees: if the mesh was valid, it is valid after each move and in the end (the Jacobian of each element is
proved positive on the whole element, on the coordinates as they are); boundary vertices counted in
`number_of_arrived_vertices` are on the surface up to the rounding of `double`; the boundary does not cut
itself (if it does at the start, `is_boundary_simple` may be false); hexahedra, prisms and pyramids stay;
vertices are added by bisections only; only vertices that do not arrive are removed, with those whose elements
all go with theirs: then the vertices behind get smaller numbers; the boundary's faces stay except at bisected
edges, at removed vertices, and where a flat tetrahedron on the boundary is removed; the same input gives the
same mesh. With `criteria.flips(false)` no vertex and no
element is removed.

\tparam ConcurrencyTag enables sequential versus parallel algorithm: `Sequential_tag`, `Parallel_tag`, which
        needs TBB, or `Parallel_if_available_tag`
\tparam GeomTraits a model of `MixedMeshTraits_3`
\tparam Surface a model of `MixedMeshSurface_3`, or of `FaceListGraph`
\tparam Quality a model of `MixedMeshQuality_3`
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"
\param mesh mesh whose points and tetrahedra are changed; bisections add some
\param surface target of the boundary vertices. \pre a `FaceListGraph` is closed and triangulated
\param quality cost of an element
\param criteria criteria of the optimization
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those below

\cgalNamedParamsBegin
  \cgalParamNBegin{visitor}
    \cgalParamDescription{asked `go_on()` before each round}
    \cgalParamType{a model of `MixedMeshVisitor_3`, as `std::ref(visitor)`}
    \cgalParamDefault{`Mixed_meshes_3::Default_visitor`}
  \cgalParamNEnd
  \cgalParamNBegin{vertex_point_map}
    \cgalParamDescription{the points of `surface`, if that is a `FaceListGraph`}
    \cgalParamType{a model of `ReadablePropertyMap` with the vertices as keys and points as values}
    \cgalParamDefault{`get_const_property_map(CGAL::vertex_point, surface)`}
  \cgalParamNEnd
\cgalNamedParamsEnd

\return the status and the numbers of the result
\par Complexity
Proportional to the number of elements whose cost can be improved, times the rounds. With more than 100,000
vertices, the vertices of hexahedra, prisms and pyramids beyond the third layer of elements at the boundary
are considered good unless an element there costs more than 3.
*/
template <class ConcurrencyTag = Sequential_tag, class GeomTraits, class Surface, class Quality,
          class NamedParameters = parameters::Default_named_parameters>
Mixed_mesh_optimization_result_3
optimize_mixed_mesh_3(Mixed_mesh_3<GeomTraits>& mesh, const Surface& surface, const Quality& quality,
                      const Mixed_mesh_optimization_criteria_3& criteria,
                      const NamedParameters& np = parameters::default_values())
{
  namespace mm3 = Mixed_meshes_3::internal;
  Mixed_mesh_optimization_result_3 result;
  if(mesh.is_empty())
    return result;
  if(!mm3::is_valid_start(mesh)) {
    result.status = Mixed_mesh_optimization_status::INVALID_MESH;
    return result;
  }
  const auto& s = mm3::as_surface(surface, np);
  const mm3::Surface_reference any_surface(s);
  return mm3::with_visitor(np, [&](auto& visitor) {
    return mm3::with_core_mesh(mesh, [&](mm3::Core_mesh& core) {
      return mm3::optimize_bounded(core, any_surface, {criteria, mm3::number_of_threads<ConcurrencyTag>()},
                                   quality, [&] { return visitor.go_on(); });
    });
  });
}

/*!
\ingroup PkgMixedMesh3Optimization

Overload with the aspect-ratio coefficient as the cost of an element.
*/
template <class ConcurrencyTag = Sequential_tag, class GeomTraits, class Surface,
          class NamedParameters = parameters::Default_named_parameters>
Mixed_mesh_optimization_result_3
optimize_mixed_mesh_3(Mixed_mesh_3<GeomTraits>& mesh, const Surface& surface,
                      const Mixed_mesh_optimization_criteria_3& criteria,
                      const NamedParameters& np = parameters::default_values())
{
  return optimize_mixed_mesh_3<ConcurrencyTag>(mesh, surface, Mixed_meshes_3::Aspect_ratio_quality_3(),
                                               criteria, np);
}

/*!
\ingroup PkgMixedMesh3Optimization

Overload with the default criteria.
*/
template <class ConcurrencyTag = Sequential_tag, class Surface, class GeomTraits,
          class NamedParameters = parameters::Default_named_parameters>
Mixed_mesh_optimization_result_3
optimize_mixed_mesh_3(Mixed_mesh_3<GeomTraits>& mesh, const Surface& surface,
                      const NamedParameters& np = parameters::default_values())
{
  return optimize_mixed_mesh_3<ConcurrencyTag>(mesh, surface, Mixed_mesh_optimization_criteria_3(), np);
}

} // namespace CGAL

#endif // CGAL_OPTIMIZE_MIXED_MESH_3_H
