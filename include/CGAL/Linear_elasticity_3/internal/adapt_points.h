// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The adaptation of a mesh to load cases: steps along configurational forces, each taken only if it lowers
// the energy. Neither the kernel of the mesh nor the class of the solver is known here.

#ifndef CGAL_LINEAR_ELASTICITY_3_INTERNAL_ADAPT_POINTS_H
#define CGAL_LINEAR_ELASTICITY_3_INTERNAL_ADAPT_POINTS_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <CGAL/Linear_elasticity_3/Mixed_mesh_adaptation_criteria_3.h>
#include <CGAL/Linear_elasticity_3/Mixed_mesh_adaptation_result_3.h>
#include <CGAL/Linear_elasticity_3/internal/Elasticity_solver.h>
#include <CGAL/Linear_elasticity_3/internal/compiled.h>
#include <CGAL/Mixed_mesh_3/Elastic_material.h>
#include <CGAL/Mixed_mesh_3/Element_attributes.h>
#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The vertices whose elements are all of one subdomain, one material and one side of a sheet, and that are
/// not on the boundary.
/// \param materials one for all elements, or one for each
std::vector<bool> inner_vertices(const Element_list& elements,
                                 const std::vector<Element_attributes>& attributes,
                                 const std::vector<Elastic_material>& materials,
                                 std::size_t number_of_vertices);

/// \param points of all vertices; changed
/// \param is_movable of each vertex; those with prescribed displacements stay as well
/// \param make_solver called for each set of vertices with prescribed displacements
/// \param go_on asked before each step
Mixed_mesh_adaptation_result_3 adapt_points(
  const Element_list& elements, std::vector<Vec3>& points, const std::vector<Elastic_material>& materials,
  std::vector<bool> is_movable, const std::vector<Prescribed_displacements>& cases,
  const Mixed_mesh_adaptation_criteria_3& criteria,
  const std::function<std::unique_ptr<Elasticity_solver>()>& make_solver, const std::function<bool()>& go_on);

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#ifndef CGAL_LINEAR_ELASTICITY_3_COMPILED
#include <CGAL/Linear_elasticity_3/internal/adapt_points_impl.h>
#endif

#endif // CGAL_LINEAR_ELASTICITY_3_INTERNAL_ADAPT_POINTS_H
