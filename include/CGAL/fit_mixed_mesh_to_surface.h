// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_FIT_MIXED_MESH_TO_SURFACE_H
#define CGAL_FIT_MIXED_MESH_TO_SURFACE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/Symmetric_solver_traits.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/fit.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/arguments.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/usual_models.h>
#include <CGAL/Mixed_mesh_fit_criteria_3.h>
#include <CGAL/Mixed_mesh_fit_result_3.h>

#include <CGAL/Named_function_parameters.h>

namespace CGAL {

/*!
\ingroup PkgMixedMesh3Optimization

\brief Brings the boundary of a mixed mesh onto a closed surface, and lets the inner vertices follow.

Each boundary vertex goes to the closest point of the surface, or to one near it where boundary faces would
fold otherwise, step by step; the inner vertices follow as an elastic medium does, in which elements whose
quality suffers are stiffened (Lobos, Bucki, Hitschfeld, Payan: Algorithm 1). The mesh may come from anywhere,
and need not have been made for this surface. No element is added, removed or inverted.

Guarantees: if the mesh was valid, it is valid after each step and in the end; boundary vertices counted in
`number_of_arrived_vertices` are on the surface up to the rounding of `double`; the same input gives the same
mesh.

\tparam GeomTraits a model of `MixedMeshTraits_3`
\tparam Surface a model of `MixedMeshSurface_3`, or of `FaceListGraph`
\tparam Quality a model of `MixedMeshQuality_3`; its gradients are not used
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"
\param mesh mesh whose points are changed
\param surface target of the boundary. \pre a `FaceListGraph` is closed and triangulated
\param quality cost of elements: elements of a cost that is not acceptable are stiffened;
`acceptable_aspect_ratio()` of the criteria is not used
\param criteria criteria of the fitting
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those below

\cgalNamedParamsBegin
  \cgalParamNBegin{visitor}
    \cgalParamDescription{asked `go_on()` before each solve}
    \cgalParamType{a model of `MixedMeshVisitor_3`, as `std::ref(visitor)`}
    \cgalParamDefault{`Mixed_meshes_3::Default_visitor`}
  \cgalParamNEnd
  \cgalParamNBegin{sparse_linear_solver}
    \cgalParamDescription{the solver, for symmetric positive definite matrices}
    \cgalParamType{a model of `SparseLinearAlgebraWithFactorTraits_d`, as `std::ref(solver)`}
    \cgalParamDefault{conjugate gradients of Eigen}
  \cgalParamNEnd
  \cgalParamNBegin{vertex_point_map}
    \cgalParamDescription{the points of `surface`, if that is a `FaceListGraph`}
    \cgalParamType{a model of `ReadablePropertyMap` with the vertices as keys and points as values}
    \cgalParamDefault{`get_const_property_map(CGAL::vertex_point, surface)`}
  \cgalParamNEnd
\cgalNamedParamsEnd

\return the status and the numbers of the result
\par Complexity
A linear system with three unknowns for each vertex that moves inside, in each step and each time that
      elements are stiffened
*/
template <class GeomTraits, class Surface, class Quality,
          class NamedParameters = parameters::Default_named_parameters>
Mixed_mesh_fit_result_3 fit_mixed_mesh_to_surface(Mixed_mesh_3<GeomTraits>& mesh, const Surface& surface,
                                                  const Quality& quality,
                                                  const Mixed_mesh_fit_criteria_3& criteria,
                                                  const NamedParameters& np = parameters::default_values())
{
  namespace mm3 = Mixed_meshes_3::internal;
  using Default_solver = Mixed_meshes_3::Conjugate_gradient_solver_traits;
  using Solver = typename internal_np::Lookup_named_param_def<internal_np::sparse_linear_solver_t,
                                                              NamedParameters, Default_solver>::reference;
  Default_solver default_solver;
  default_solver.solver().setTolerance(1e-3); // inner vertices need no smaller tolerance
  Solver solver = parameters::choose_parameter(
    parameters::get_parameter_reference(np, internal_np::sparse_linear_solver), default_solver);
  const auto& s = mm3::as_surface(surface, np);
  const mm3::Surface_reference any_surface(s);
  return mm3::with_visitor(np, [&](auto& visitor) {
    return mm3::with_core_mesh(mesh, [&](mm3::Core_mesh& core) {
      return mm3::fit(core, any_surface, quality, criteria, solver, [&] { return visitor.go_on(); });
    });
  });
}

/*!
\ingroup PkgMixedMesh3Optimization

Overload with the paper's aspect-ratio coefficient, acceptable up to `acceptable_aspect_ratio()`.
*/
template <class GeomTraits, class Surface, class NamedParameters = parameters::Default_named_parameters>
Mixed_mesh_fit_result_3 fit_mixed_mesh_to_surface(Mixed_mesh_3<GeomTraits>& mesh, const Surface& surface,
                                                  const Mixed_mesh_fit_criteria_3& criteria,
                                                  const NamedParameters& np = parameters::default_values())
{
  const Mixed_meshes_3::internal::Aspect_ratio_bound quality(criteria.acceptable_aspect_ratio());
  return fit_mixed_mesh_to_surface(mesh, surface, quality, criteria, np);
}

/*!
\ingroup PkgMixedMesh3Optimization

Overload with the default criteria.
*/
template <class GeomTraits, class Surface, class NamedParameters = parameters::Default_named_parameters>
Mixed_mesh_fit_result_3 fit_mixed_mesh_to_surface(Mixed_mesh_3<GeomTraits>& mesh, const Surface& surface,
                                                  const NamedParameters& np = parameters::default_values())
{
  return fit_mixed_mesh_to_surface(mesh, surface, Mixed_mesh_fit_criteria_3(), np);
}

} // namespace CGAL

#endif // CGAL_FIT_MIXED_MESH_TO_SURFACE_H
