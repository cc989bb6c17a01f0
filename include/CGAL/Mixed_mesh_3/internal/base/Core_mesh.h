// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_BASE_CORE_MESH_H
#define CGAL_MIXED_MESH_3_INTERNAL_BASE_CORE_MESH_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The mesh that the method works on, whatever the kernel of the user is; the coordinates are doubles.
using Core_mesh = Mixed_mesh_3<Predicates_kernel>;

/// A mesh of any kernel as a mesh in doubles: the mesh itself, or a copy.
template <class Mesh>
decltype(auto) as_core_mesh(const Mesh& mesh)
{
  if constexpr(std::is_same_v<Mesh, Core_mesh>) {
    return (mesh);
  } else {
    std::vector<Core_mesh::Point_3> points;
    points.reserve(mesh.number_of_vertices());
    for(const auto& p : mesh.points())
      points.emplace_back(rounded(p.x()), rounded(p.y()), rounded(p.z()));
    Core_mesh core;
    core.assign(std::move(points), mesh.elements(), mesh.attributes(), mesh.vertex_data(),
                mesh.element_data());
    return core;
  }
}

/// Returns `f(core_mesh)` for a mesh of any kernel, which becomes what `f` has made of `core_mesh`.
/// Coordinates are rounded to doubles; coordinates that do not change keep their value.
template <class Mesh, class Function>
auto with_core_mesh(Mesh& mesh, const Function& f)
{
  if constexpr(std::is_same_v<Mesh, Core_mesh>) {
    return f(mesh);
  } else {
    using Point_3 = typename Mesh::Point_3;
    Core_mesh core = as_core_mesh(mesh);
    const std::vector<Core_mesh::Point_3> core_points = core.points();
    const auto result = f(core);
    std::vector<Point_3> points;
    points.reserve(core.number_of_vertices());
    for(std::size_t v = 0; v < core.number_of_vertices(); ++v) {
      const Core_mesh::Point_3& p = core.points()[v];
      if(v < core_points.size() && p == core_points[v])
        points.push_back(mesh.points()[v]);
      else
        points.emplace_back(p.x(), p.y(), p.z());
    }
    mesh.assign(std::move(points), core.elements(), core.attributes(), core.vertex_data(),
                core.element_data());
    return result;
  }
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_BASE_CORE_MESH_H
