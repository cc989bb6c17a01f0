// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_ELEMENT_POINTS_H
#define CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_ELEMENT_POINTS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <array>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

using Element_points = std::array<Vec3, 8>;

// Positions relative to the element's first vertex, so that no digits are lost far from the origin.
/// \param position `Vec3(Vertex_index)`
template <class Position>
Element_points relative_points(const Element_view& element, const Position& position)
{
  Element_points p{};
  const Vec3 origin = position(element[0]);
  for(int i = 1; i < element.size(); ++i)
    p[i] = position(element[i]) - origin;
  return p;
}

template <class Mesh>
Element_points element_points(const Mesh& mesh, const Element_view& element)
{
  return relative_points(element, [&](Vertex_index v) { return to_vec3(mesh.point(v)); });
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_ELEMENT_POINTS_H
