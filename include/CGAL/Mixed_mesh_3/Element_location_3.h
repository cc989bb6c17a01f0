// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_ELEMENT_LOCATION_3_H
#define CGAL_MIXED_MESH_3_ELEMENT_LOCATION_3_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Index.h>

#include <array>

namespace CGAL {
namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMesh3Fields
/// The location of a point in a mesh: an element, and reference coordinates.
struct Element_location_3
{
  /// The element; -1 before a location is found.
  Element_index element = Element_index(-1);
  std::array<double, 3> coordinates{}; ///< reference coordinates
  /// Values of the shape functions, in the order of the element's vertices: a field of the mesh is the sum of
  /// its values at the vertices times these values.
  std::array<double, 8> weights{};
  double distance = 0; ///< distance of the given point; 0 if the point is in the element
};

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_ELEMENT_LOCATION_3_H
