// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_LINEAR_ELASTICITY_3_ADAPT_MIXED_MESH_3_H
#define CGAL_LINEAR_ELASTICITY_3_ADAPT_MIXED_MESH_3_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <CGAL/Linear_elasticity_3/Mixed_mesh_adaptation_criteria_3.h>
#include <CGAL/Linear_elasticity_3/Mixed_mesh_adaptation_result_3.h>
#include <CGAL/Linear_elasticity_3/internal/Elasticity_solver.h>
#include <CGAL/Linear_elasticity_3/internal/adapt_points.h>
#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/Default_visitor.h>
#include <CGAL/Mixed_mesh_3/Elastic_material.h>
#include <CGAL/Mixed_mesh_3/Symmetric_solver_traits.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/assertions.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {

/*!
\ingroup PkgLinearElasticity3Ref

\brief Moves the inner vertices of a mixed mesh along configurational forces, so that the energy of finite
elements falls, and with it their error in energy, for the loads that are to come.

The loads are displacements of some vertices; the others are free, without forces. The functional is the
mean, over the load cases, of the energy of the solution with standard elements, divided by that on the mesh
at first, and the same mean over six *guard loads*, times a weight. Guard loads displace the whole boundary
smoothly, most where the load cases do. Each step moves vertices along the gradient of the functional,
relative to the size and to the energy of the elements around, solves again, and is undone if the functional
or the mean of the load cases has not fallen, or if a guard load has more energy than at first. Elements,
their order and their attributes stay.

These do not move: vertices of the boundary, where the data would move with them; of the interfaces between
subdomains or materials; of sheets; with a prescribed displacement; of elements that have such vertices and
also free ones of the boundary; and constrained ones.

Guarantees: the mean energy of the load cases and the energy of each guard load do not grow. If elements
were valid, they are after each step (their Jacobians are proved positive on the whole element, on the
coordinates as they are); no element gets an aspect-ratio coefficient above the bound of the criteria, or
above what it had at first, whatever is larger. Vertices that do not move have the same coordinates, bit by
bit. The same input gives the same mesh, if the solver gives the same solution.

With standard elements, the energy of the solution is that of the exact one plus half the square of the
error in the energy norm: so the error of standard elements falls in that norm, and that of guard loads
does not grow. That it falls in another norm, for other elements such as those of `Linear_elasticity_3`, or
for other loads, is not proved; see \ref Linear_elasticity_3_adaptation "the manual".

\tparam SolverTraits a direct model of `SparseLinearAlgebraWithFactorTraits_d`; one for each set of
        vertices with prescribed displacements is constructed by default
\tparam GeomTraits a model of `MixedMeshTraits_3`
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"
\param mesh its points are changed
\param materials one for all elements, or one for each; `Mixed_meshes_3::materials_of_elements()` tells
       them by subdomain
\param cases the displacements of some vertices in each load case; enough of them to hold rigid motions
\param criteria how far to go
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those below

\cgalNamedParamsBegin
  \cgalParamNBegin{visitor}
    \cgalParamDescription{asked `go_on()` before each step}
    \cgalParamType{a class with a member `bool go_on()`, such as a model of `MixedMeshVisitor_3`, as
                   `std::ref(visitor)`}
    \cgalParamDefault{`Mixed_meshes_3::Default_visitor`}
  \cgalParamNEnd
  \cgalParamNBegin{vertex_is_constrained_map}
    \cgalParamDescription{vertices that stay, besides those named above}
    \cgalParamType{a model of `ReadablePropertyMap` with `Mixed_meshes_3::Vertex_index` as key and `bool` as
    value}
    \cgalParamDefault{none is}
  \cgalParamNEnd
\cgalNamedParamsEnd

\return the status, and what was done
\pre vertices of the cases exist, displacements are finite, and there is a material or as many as elements
\par Complexity
For each step, that of a sparse factorization for each set of vertices with prescribed displacements: load
cases that prescribe the same vertices share it
*/
template <class SolverTraits = Mixed_meshes_3::Direct_solver_traits, class GeomTraits,
          class NamedParameters = parameters::Default_named_parameters>
Mixed_mesh_adaptation_result_3
adapt_mixed_mesh_3(Mixed_mesh_3<GeomTraits>& mesh,
                   const std::vector<Mixed_meshes_3::Elastic_material>& materials,
                   const std::vector<Mixed_meshes_3::Prescribed_displacements>& cases,
                   const Mixed_mesh_adaptation_criteria_3& criteria = Mixed_mesh_adaptation_criteria_3(),
                   const NamedParameters& np = parameters::default_values())
{
  using namespace Mixed_meshes_3;
  using Point_3 = typename Mixed_mesh_3<GeomTraits>::Point_3;
  using Visitor = typename internal_np::Lookup_named_param_def<internal_np::visitor_t, NamedParameters,
                                                               Default_visitor>::reference;
  const std::size_t n = mesh.number_of_vertices();
  CGAL_precondition(materials.size() == 1 || materials.size() == mesh.number_of_elements());
  CGAL_precondition(std::all_of(cases.begin(), cases.end(), [n](const Prescribed_displacements& u) {
    return std::all_of(u.begin(), u.end(),
                       [n](const auto& one) { return one.first < n && std::isfinite(norm(one.second)); });
  }));
  Default_visitor default_visitor;
  Visitor visitor = parameters::choose_parameter(parameters::get_parameter_reference(np,
                                                                                     internal_np::visitor),
                                                 default_visitor);
  const auto is_constrained = parameters::choose_parameter(
    parameters::get_parameter(np, internal_np::vertex_is_constrained),
    Static_boolean_property_map<Vertex_index, false>());
  std::vector<bool> is_movable = Mixed_meshes_3::internal::inner_vertices(mesh.elements(), mesh.attributes(),
                                                                          materials, n);
  std::vector<Vec3> points;
  for(Vertex_index v = 0; v < n; ++v) {
    points.push_back(to_vec3(mesh.point(v)));
    is_movable[v] = is_movable[v] && !get(is_constrained, v);
  }
  const std::vector<Vec3> points_before = points;
  const auto result = Mixed_meshes_3::internal::adapt_points(
    mesh.elements(), points, materials, std::move(is_movable), cases, criteria,
    [] { return std::make_unique<Mixed_meshes_3::internal::Elasticity_solver_adaptor<SolverTraits>>(); },
    [&visitor] { return visitor.go_on(); });
  for(Vertex_index v = 0; v < n; ++v)
    if(points[v] != points_before[v])
      mesh.points()[v] = Point_3(points[v][0], points[v][1], points[v][2]);
  return result;
}

} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_ADAPT_MIXED_MESH_3_H
