// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SIMPLIFY_MIXED_MESH_3_H
#define CGAL_SIMPLIFY_MIXED_MESH_3_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/Aspect_ratio_quality_3.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/simplify_within_limits.h>
#include <CGAL/Mixed_mesh_3/internal/moves/is_valid_start.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/arguments.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/usual_models.h>
#include <CGAL/Mixed_mesh_simplification_criteria_3.h>
#include <CGAL/Mixed_mesh_simplification_result_3.h>

#include <CGAL/Named_function_parameters.h>

namespace CGAL {

/*!
\ingroup PkgMixedMesh3Optimization

\brief Removes vertices of a mixed mesh whose boundary is on a surface, by edge collapses, until the mesh has
a number of vertices, or as few as a distance allows.

This is the stage of `make_mixed_mesh_3()` that makes a mesh of the budget out of a fine one. Edges collapse
in the order of what is lost: the cube of the longest new edge, and on the boundary the volume between its old
and its new faces, which counts more. No vertex moves: the vertices of the result are some of those of the
start. `optimize_mixed_mesh_3()` improves the result.

A vertex goes into a vertex of its own stratum, or of one in its closure: one inside into any vertex, one of
the boundary or of an interface of subdomains into another one there, one of a curve where interfaces meet
along the curve, one of a sharp edge of the surface along that. Corners stay, as do all vertices of hexahedra,
prisms and pyramids, and of sheets.

The sharp edges that the mesh follows are those that it has: the edges between successive vertices on a sharp
edge of the surface. Parts of sharp edges that the mesh does not follow are as the rest of the boundary.
Vertices of the boundary that are not on the surface go first, and their faces may turn far: the boundary
should have been brought onto the surface, by `make_mixed_mesh_3()`, `optimize_mixed_mesh_3()` or
`fit_mixed_mesh_to_surface()`.

Guarantees: if the mesh was valid, it is valid after each collapse (the Jacobian of each element is proved
positive); the topology of the mesh, of its boundary, of subdomains, of interfaces and of the sharp edges that
it follows stays; the boundary does not cut itself if it did not at the start; hexahedra, prisms and pyramids
stay; each place on the surface of a vertex of the boundary at the start is within `criteria.distance()` of
the boundary in the end; no element gets a cost above `criteria.quality_bound()`, but in the place of elements
that were above, or off the surface; the same input gives the same mesh. The distance is that of places of the
start: it tells how much the simplification changes the boundary, and not how far the mesh of the start was
from the surface between its vertices.

\tparam GeomTraits a model of `MixedMeshTraits_3`
\tparam Surface a model of `MixedMeshSurface_3`, or of `FaceListGraph`
\tparam Quality a model of `MixedMeshQuality_3`
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"
\param mesh mesh whose vertices and tetrahedra are removed; the vertices behind get smaller numbers
\param surface surface that the boundary is on. \pre a `FaceListGraph` is closed and triangulated
\param quality cost of an element
\param criteria criteria of the simplification; a number of vertices converts to them
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those below

\cgalNamedParamsBegin
  \cgalParamNBegin{visitor}
    \cgalParamDescription{asked `go_on()` after each 256 collapses}
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
Some 60 microseconds for each vertex that is removed. The sharp edges that the mesh follows are found in a
time proportional to the number of corners and polylines, times the number of vertices of the boundary.
*/
template <class GeomTraits, class Surface, class Quality,
          class NamedParameters = parameters::Default_named_parameters>
Mixed_mesh_simplification_result_3
simplify_mixed_mesh_3(Mixed_mesh_3<GeomTraits>& mesh, const Surface& surface, const Quality& quality,
                      const Mixed_mesh_simplification_criteria_3& criteria,
                      const NamedParameters& np = parameters::default_values())
{
  namespace mm3 = Mixed_meshes_3::internal;
  Mixed_mesh_simplification_result_3 result;
  result.number_of_vertices = mesh.number_of_vertices();
  if(mesh.is_empty())
    return result;
  if(!mm3::is_valid_start(mesh)) {
    result.status = Mixed_mesh_simplification_status::INVALID_MESH;
    return result;
  }
  const auto& s = mm3::as_surface(surface, np);
  const mm3::Surface_reference any_surface(s);
  return mm3::with_visitor(np, [&](auto& visitor) {
    return mm3::with_core_mesh(mesh, [&](mm3::Core_mesh& core) {
      return mm3::simplify_within_limits(core, any_surface, quality, criteria,
                                         [&] { return visitor.go_on(); });
    });
  });
}

/*!
\ingroup PkgMixedMesh3Optimization

Overload with the aspect-ratio coefficient as the cost of an element.
*/
template <class GeomTraits, class Surface, class NamedParameters = parameters::Default_named_parameters>
Mixed_mesh_simplification_result_3
simplify_mixed_mesh_3(Mixed_mesh_3<GeomTraits>& mesh, const Surface& surface,
                      const Mixed_mesh_simplification_criteria_3& criteria,
                      const NamedParameters& np = parameters::default_values())
{
  return simplify_mixed_mesh_3(mesh, surface, Mixed_meshes_3::Aspect_ratio_quality_3(), criteria, np);
}

} // namespace CGAL

#endif // CGAL_SIMPLIFY_MIXED_MESH_3_H
