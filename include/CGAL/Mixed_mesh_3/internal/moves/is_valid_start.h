// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The condition on a mesh whose validity moves are to keep.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MOVES_IS_VALID_START_H
#define CGAL_MIXED_MESH_3_INTERNAL_MOVES_IS_VALID_START_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/certificate.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Whether the vertices of elements exist, at finite positions, and no element is inverted.
template <class Mesh>
bool is_valid_start(const Mesh& mesh)
{
  for(const auto& p : mesh.points())
    if(!std::isfinite(norm(to_vec3(p))))
      return false;
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e) {
    const Element_view element = mesh.element(Element_index(e));
    if(std::any_of(element.begin(), element.end(),
                   [&](Vertex_index v) { return v >= mesh.number_of_vertices(); })
       || jacobian_sign(mesh, Element_index(e)) != Jacobian_sign::POSITIVE)
      return false;
  }
  return true;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MOVES_IS_VALID_START_H
