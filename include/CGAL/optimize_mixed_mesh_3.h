// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_OPTIMIZE_MIXED_MESH_3_H
#define CGAL_OPTIMIZE_MIXED_MESH_3_H

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/Aspect_ratio_quality_3.h>
#include <CGAL/Mixed_mesh_3/Default_visitor.h>
#include <CGAL/Mixed_mesh_3/certificate.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Surface_optimizer.h>
#include <CGAL/Mixed_mesh_optimization_criteria_3.h>
#include <CGAL/Polyhedral_mixed_mesh_domain_3.h>

#include <CGAL/Named_function_parameters.h>

namespace CGAL {

/*!
\brief Brings the boundary of a mixed mesh onto a surface, moves vertices and flips tetrahedra to improve elements.

Boundary vertices that are not on the surface yet are brought there, each as far at a time as its elements
allow, while inner vertices give way. Then, in turns, each vertex descends on the sum of the powers (4, later
8) of the costs of its elements, and tetrahedra are replaced by others between the same vertices where that
sum falls: 2-3 flips, and the removal of edges with up to 7 tetrahedra around. Boundary vertices slide on the
surface where an element is bad, or towards places of the surface that are farther than the tolerance. This is
the improvement of slivers that the paper announces (Lobos, Bucki, Hitschfeld, Payan: section 7).

Guarantees: if the mesh was valid, it is valid after each move and in the end (the Jacobian of each element is
proved positive on the whole element, on the coordinates as they are); boundary vertices counted in
`number_of_arrived_vertices` are on the surface up to the rounding of `double`; the boundary does not cut itself
unless `is_boundary_simple` says so; hexahedra, prisms and pyramids stay, no vertex is added or removed, and
the boundary's faces stay but where a flat tetrahedron on it is removed; the same input gives the same mesh.

\tparam GeomTraits a model of `MixedMeshTraits_3`
\tparam Domain has `closest_point(p)`, `closest_point(p, hint)` and `surface_samples(spacing)` as
        `Polyhedral_mixed_mesh_domain_3`
\tparam Quality a model of `MixedMeshQuality_3`
\param mesh its points and tetrahedra are changed
\param domain its surface is where boundary vertices are to be
\param quality the cost of an element
\param criteria what to reach
\param np an optional sequence of named parameters: `visitor(std::ref(v))` with `v` a model of
       `MixedMeshVisitor_3`, asked `go_on()` before each round (default: `Mixed_meshes_3::Default_visitor`)
\return the status and what was done
\cost proportional to the number of elements whose cost can be improved, times the rounds
*/
template <class GeomTraits, class Domain, class Quality,
          class NamedParameters = parameters::Default_named_parameters>
Mixed_mesh_optimization_result_3
optimize_mixed_mesh_3(Mixed_mesh_3<GeomTraits>& mesh, const Domain& domain, const Quality& quality,
                      const Mixed_mesh_optimization_criteria_3& criteria,
                      const NamedParameters& np = parameters::default_values())
{
  using Default_visitor = Mixed_meshes_3::Default_visitor;
  using Visitor = typename internal_np::Lookup_named_param_def<internal_np::visitor_t, NamedParameters,
                                                               Default_visitor>::reference;
  Default_visitor default_visitor;
  Visitor visitor = parameters::choose_parameter(
    parameters::get_parameter_reference(np, internal_np::visitor), default_visitor);
  Mixed_mesh_optimization_result_3 result;
  if(mesh.is_empty())
    return result;
  if(!Mixed_meshes_3::internal::is_valid_start(mesh)) {
    result.status = Mixed_mesh_optimization_status::INVALID_MESH;
    return result;
  }
  return Mixed_meshes_3::internal::Surface_optimizer(mesh, domain, criteria, quality)(
    [&] { return visitor.go_on(); });
}

/// As above, with the aspect-ratio coefficient as the cost of an element.
template <class GeomTraits, class Domain, class NamedParameters = parameters::Default_named_parameters>
Mixed_mesh_optimization_result_3
optimize_mixed_mesh_3(Mixed_mesh_3<GeomTraits>& mesh, const Domain& domain,
                      const Mixed_mesh_optimization_criteria_3& criteria,
                      const NamedParameters& np = parameters::default_values())
{
  return optimize_mixed_mesh_3(mesh, domain, Mixed_meshes_3::Aspect_ratio_quality_3(), criteria, np);
}

/*!
As above, with a closed triangulated surface and the default criteria.

\tparam Surface a model of `FaceListGraph`, with points of any CGAL kernel
\param mesh its points and tetrahedra are changed
\param surface where boundary vertices are to be. \pre closed and triangulated
\param np an optional sequence of named parameters: that above, and `vertex_point_map` of the surface
*/
template <class Surface, class GeomTraits, class NamedParameters = parameters::Default_named_parameters>
Mixed_mesh_optimization_result_3
optimize_mixed_mesh_3(Mixed_mesh_3<GeomTraits>& mesh, const Surface& surface,
                      const NamedParameters& np = parameters::default_values())
{
  return optimize_mixed_mesh_3(mesh, Polyhedral_mixed_mesh_domain_3(surface, np),
                               Mixed_mesh_optimization_criteria_3(), np);
}

} // namespace CGAL

#endif // CGAL_OPTIMIZE_MIXED_MESH_3_H
