// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_REPAIR_WRAP_IMPL_H
#define CGAL_MIXED_MESH_3_INTERNAL_REPAIR_WRAP_IMPL_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/compiled.h>
#include <CGAL/Mixed_mesh_3/internal/repair/wrap.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

CGAL_MIXED_MESH_3_INLINE void wrap(double diameter, std::vector<Predicates_kernel::Point_3>& points,
                                   std::vector<std::array<std::size_t, 3>>& triangles)
{
  // A larger offset makes the solid larger; a smaller one increases the number of triangles.
  constexpr double offset = 1. / 60; // CGAL's default, alpha / 30, where alpha is half of the diameter
  CGAL::Surface_mesh<Predicates_kernel::Point_3> mesh;
  CGAL::alpha_wrap_3(points, triangles, diameter / 2, offset * diameter, mesh);
  points.assign(mesh.points().begin(), mesh.points().end());
  triangles.clear();
  for(const auto f : faces(mesh)) {
    triangles.emplace_back();
    std::size_t i = 0;
    for(const auto v : vertices_around_face(halfedge(f, mesh), mesh))
      triangles.back()[i++] = std::size_t(v);
  }
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_REPAIR_WRAP_IMPL_H
