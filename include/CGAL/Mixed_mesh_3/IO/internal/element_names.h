// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Names of the kinds of elements in other programs, and their orders of the vertices.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_ELEMENT_NAMES_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_ELEMENT_NAMES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Mixed_element_traits_3.h>

#include <cstdint>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

/// Names and orders of a kind. Gmsh, Abaqus, Medit and FEBio order vertices as we do. VTK's linear wedge is
/// the mirror image of our prism: `vtk_order` lists, for each VTK position, our vertex to be written there.
struct Element_names
{
  int vtk_type;
  std::uint8_t vtk_order[8];
  int gmsh_type;
  const char* medit_keyword;
  const char* abaqus_type;
  const char* febio_type;
  std::uint8_t abaqus_faces[6]; ///< Abaqus's number of each of our faces
};

inline constexpr Element_names element_names[] = {
  {10, {0, 1, 2, 3}, 4, "Tetrahedra", "C3D4", "tet4", {3, 4, 2, 1}},
  {14, {0, 1, 2, 3, 4}, 7, "Pyramids", "C3D5", "pyra5", {1, 2, 3, 4, 5}},
  {13, {0, 2, 1, 3, 5, 4}, 6, "Prisms", "C3D6", "penta6", {1, 2, 3, 4, 5}},
  {12, {0, 1, 2, 3, 4, 5, 6, 7}, 5, "Hexahedra", "C3D8", "hex8", {6, 4, 3, 5, 1, 2}}};
static_assert(sizeof(element_names) / sizeof(element_names[0]) == number_of_element_kinds,
              "a name for each kind, in the order of Element_kind");

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_ELEMENT_NAMES_H
