// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_FIT_MIXED_MESH_TO_SURFACE_H
#define CGAL_FIT_MIXED_MESH_TO_SURFACE_H

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/Default_visitor.h>
#include <CGAL/Mixed_mesh_3/Symmetric_solver_traits.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Working_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/relax_to_surface.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/surface_targets.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_fit_criteria_3.h>
#include <CGAL/Mixed_mesh_fit_result_3.h>
#include <CGAL/Polyhedral_mixed_mesh_domain_3.h>

#include <CGAL/Named_function_parameters.h>

#include <cstddef>
#include <vector>

namespace CGAL {

namespace Mixed_meshes_3 {
namespace internal {

/// Targets, and Algorithm 1; vertices that stay behind get new targets, those nearest to where they have come.
template <class Domain, class Mesh, class Quality, class Solver, class Go_on>
Mixed_mesh_fit_result_3 fit(Mesh& mesh, const Domain& domain, const Quality& quality,
                            const Mixed_mesh_fit_criteria_3& criteria, Solver& solver, const Go_on& go_on)
{
  constexpr int maximal_number_of_attempts = 3;
  Mixed_mesh_fit_result_3 result;
  if(mesh.is_empty())
    return result;
  if(!is_valid_start(mesh)) {
    result.status = Mixed_mesh_fit_status::INVALID_MESH;
    return result;
  }
  std::vector<Vec3> points;
  points.reserve(mesh.number_of_vertices());
  for(const auto& p : mesh.points())
    points.push_back(to_vec3(p));
  const std::vector<Face> boundary = boundary_faces(mesh);
  for(int attempt = 0; attempt < maximal_number_of_attempts; ++attempt) {
    const Surface_targets targets = surface_targets(boundary, points, domain);
    Surface_relaxation relaxation(mesh.elements(), targets, criteria, quality, solver, go_on, points);
    result = relaxation(result);
    if(result.status != Mixed_mesh_fit_status::NOT_ALL_ARRIVED)
      break;
  }
  for(std::size_t v = 0; v < points.size(); ++v)
    if(to_vec3(mesh.points()[v]) != points[v])
      mesh.points()[v] = typename Mesh::Point_3(points[v][0], points[v][1], points[v][2]);
  return result;
}

} // namespace internal
} // namespace Mixed_meshes_3

/*!
\brief Carries the boundary of a mixed mesh onto a closed surface, and lets the inner vertices follow.

Each boundary vertex goes to the closest point of the surface, or to one near it where boundary faces would
fold otherwise, step by step; the inner vertices follow as an elastic medium does, in which elements whose
quality suffers are stiffened (Lobos, Bucki, Hitschfeld, Payan: Algorithm 1). The mesh may come from anywhere,
and need not have been made for this surface. No element is added, removed or inverted.

Guarantees: if the mesh was valid, it is valid after each step and in the end; boundary vertices counted in
`number_of_arrived_vertices` are on the surface up to the rounding of `double`; the same input gives the same
mesh.

\tparam Domain has `closest_point(p)` and `closest_point(p, hint)` as `Polyhedral_mixed_mesh_domain_3`
\tparam GeomTraits a model of `MixedMeshTraits_3`
\tparam Quality a model of `MixedMeshQuality_3`; its gradients are not used
\param mesh its points are changed
\param domain its surface is where the boundary goes
\param quality elements of a cost that is not acceptable are stiffened; `acceptable_aspect_ratio()` of the
       criteria is not used
\param criteria how to get there
\param np an optional sequence of named parameters:
       - `visitor(std::ref(v))` with `v` a model of `MixedMeshVisitor_3`, asked `go_on()` before each solve
         (default: `Mixed_meshes_3::Default_visitor`);
       - `sparse_linear_solver(std::ref(s))` with `s` a model of `SparseLinearAlgebraWithFactorTraits_d` for
         symmetric positive definite matrices (default: conjugate gradients of Eigen)
\return the status and what was done
\cost a linear system with three unknowns for each vertex that moves inside, in each step and each time that
      elements are stiffened
*/
template <class Domain, class GeomTraits, class Quality,
          class NamedParameters = parameters::Default_named_parameters>
Mixed_mesh_fit_result_3 fit_mixed_mesh_to_surface(Mixed_mesh_3<GeomTraits>& mesh, const Domain& domain,
                                                 const Quality& quality,
                                                 const Mixed_mesh_fit_criteria_3& criteria,
                                                 const NamedParameters& np = parameters::default_values())
{
  using Default_visitor = Mixed_meshes_3::Default_visitor;
  using Default_solver = Mixed_meshes_3::Conjugate_gradient_solver_traits;
  using Visitor = typename internal_np::Lookup_named_param_def<internal_np::visitor_t, NamedParameters,
                                                               Default_visitor>::reference;
  using Solver = typename internal_np::Lookup_named_param_def<internal_np::sparse_linear_solver_t,
                                                              NamedParameters, Default_solver>::reference;
  Default_visitor default_visitor;
  Visitor visitor = parameters::choose_parameter(
    parameters::get_parameter_reference(np, internal_np::visitor), default_visitor);
  Default_solver default_solver;
  default_solver.solver().setTolerance(1e-3); // inner vertices need no more
  Solver solver = parameters::choose_parameter(
    parameters::get_parameter_reference(np, internal_np::sparse_linear_solver), default_solver);
  return Mixed_meshes_3::internal::fit(mesh, domain, quality, criteria, solver, [&] { return visitor.go_on(); });
}

/// As above, with the paper's aspect-ratio coefficient, acceptable up to `acceptable_aspect_ratio()`.
template <class Domain, class GeomTraits, class NamedParameters = parameters::Default_named_parameters>
Mixed_mesh_fit_result_3 fit_mixed_mesh_to_surface(Mixed_mesh_3<GeomTraits>& mesh, const Domain& domain,
                                                 const Mixed_mesh_fit_criteria_3& criteria,
                                                 const NamedParameters& np = parameters::default_values())
{
  const Mixed_meshes_3::internal::Aspect_ratio_bound quality(criteria.acceptable_aspect_ratio());
  return fit_mixed_mesh_to_surface(mesh, domain, quality, criteria, np);
}

/*!
As above, with a closed triangulated surface and the default criteria.

\tparam Surface a model of `FaceListGraph`, with points of any CGAL kernel
\param mesh its points are changed
\param surface where the boundary goes. \pre closed and triangulated
\param np an optional sequence of named parameters: those above, and `vertex_point_map` of the surface
*/
template <class Surface, class GeomTraits, class NamedParameters = parameters::Default_named_parameters>
Mixed_mesh_fit_result_3 fit_mixed_mesh_to_surface(Mixed_mesh_3<GeomTraits>& mesh, const Surface& surface,
                                                  const NamedParameters& np = parameters::default_values())
{
  return fit_mixed_mesh_to_surface(mesh, Polyhedral_mixed_mesh_domain_3(surface, np),
                                   Mixed_mesh_fit_criteria_3(), np);
}

} // namespace CGAL

#endif // CGAL_FIT_MIXED_MESH_TO_SURFACE_H
