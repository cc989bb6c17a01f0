// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The method as a function that is compiled once, whatever the types of domain, region, cell traits and
// visitor and the kernel of the mesh are.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_MESH_DOMAIN_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_MESH_DOMAIN_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Concurrency.h>
#include <CGAL/Mixed_mesh_3/internal/base/Core_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/Any_visitor.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/Oracles.h>
#include <CGAL/Mixed_mesh_criteria_3.h>
#include <CGAL/Mixed_mesh_result_3.h>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Runs the driver.
using Meshing_criteria = With_threads<Mixed_mesh_criteria_3>;

Mixed_mesh_result_3 mesh_domain(const Oracles& oracles, const Meshing_criteria& criteria,
                                Any_visitor& visitor, Core_mesh& mesh);

/// Runs the driver on models of the concepts.
template <class Domain, class Region, class CellTraits, class Visitor, class Mesh>
Mixed_mesh_result_3 mesh_models(const Domain& domain, const Region& region, const Meshing_criteria& criteria,
                                const CellTraits& cell_traits, Visitor& visitor, Mesh& mesh)
{
  mesh.clear();
  Visitor_reference<Visitor> any_visitor(visitor);
  return with_core_mesh(mesh, [&](Core_mesh& core) {
    return mesh_domain(oracles_of(domain, region, cell_traits), criteria, any_visitor, core);
  });
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#ifndef CGAL_MIXED_MESH_3_COMPILED
#include <CGAL/Mixed_mesh_3/internal/meshing/mesh_domain_impl.h>
#endif

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_MESH_DOMAIN_H
