// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Names of the kinds of elements in other programs, and their orders of the vertices.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_ELEMENT_NAMES_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_ELEMENT_NAMES_H

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

  // Our edges in the order of a format's nodes in their middles, for quadratic elements.
  std::uint8_t vtk_edges[12] = {};
  std::uint8_t gmsh_edges[12] = {};
  std::uint8_t abaqus_edges[12] = {}; ///< of FEBio, too
};

inline constexpr Element_names element_names[] = {
  {10, {0, 1, 2, 3}, 4, "Tetrahedra", "C3D4", "tet4", {3, 4, 2, 1}},
  {14, {0, 1, 2, 3, 4}, 7, "Pyramids", "C3D5", "pyra5", {1, 2, 3, 4, 5}},
  {13, {0, 2, 1, 3, 5, 4}, 6, "Prisms", "C3D6", "penta6", {1, 2, 3, 4, 5}},
  {12, {0, 1, 2, 3, 4, 5, 6, 7}, 5, "Hexahedra", "C3D8", "hex8", {6, 4, 3, 5, 1, 2}}};
static_assert(sizeof(element_names) / sizeof(element_names[0]) == number_of_element_kinds,
              "a name for each kind, in the order of Element_kind");

/// Quadratic elements with a node in the middle of each edge, and none in faces or within: the only family
/// of which all formats have a tetrahedron, a prism and a hexahedron whose faces fit together, and all but
/// Abaqus a pyramid. VTK's quadratic wedge is the mirror image of our prism, too. Medit's format has none
/// here.
inline constexpr Element_names quadratic_element_names[] = {{24,
                                                             {0, 1, 2, 3},
                                                             11,
                                                             nullptr,
                                                             "C3D10",
                                                             "tet10",
                                                             {3, 4, 2, 1},
                                                             {0, 3, 1, 2, 4, 5},
                                                             {0, 3, 1, 2, 5, 4},
                                                             {0, 3, 1, 2, 4, 5}},
                                                            {27,
                                                             {0, 1, 2, 3, 4},
                                                             19,
                                                             nullptr,
                                                             nullptr, // Abaqus has no pyramid with 13 nodes
                                                             "pyra13",
                                                             {1, 2, 3, 4, 5},
                                                             {0, 1, 2, 3, 4, 5, 6, 7},
                                                             {0, 3, 4, 1, 5, 2, 6, 7},
                                                             {0, 1, 2, 3, 4, 5, 6, 7}},
                                                            {26,
                                                             {0, 2, 1, 3, 5, 4},
                                                             18,
                                                             nullptr,
                                                             "C3D15",
                                                             "penta15",
                                                             {1, 2, 3, 4, 5},
                                                             {2, 1, 0, 5, 4, 3, 6, 8, 7},
                                                             {0, 2, 6, 1, 7, 8, 3, 5, 4},
                                                             {0, 1, 2, 3, 4, 5, 6, 7, 8}},
                                                            {25,
                                                             {0, 1, 2, 3, 4, 5, 6, 7},
                                                             17,
                                                             nullptr,
                                                             "C3D20",
                                                             "hex20",
                                                             {6, 4, 3, 5, 1, 2},
                                                             {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11},
                                                             {0, 3, 8, 1, 9, 2, 10, 11, 4, 7, 5, 6},
                                                             {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}}};
static_assert(sizeof(quadratic_element_names) / sizeof(quadratic_element_names[0]) == number_of_element_kinds,
              "a name for each kind, in the order of Element_kind");

/// Names of elements of order 1 or 2.
inline const Element_names& names_of(Element_kind kind, int order)
{
  return order == 2 ? quadratic_element_names[kind] : element_names[kind];
}

inline const char* febio_face_type(int size, int order)
{
  return order == 2 ? (size == 3 ? "tri6" : "quad8") : size == 3 ? "tri3" : "quad4";
}

/// The type of a face in Gmsh: by its number of vertices and order.
inline int gmsh_face_type(int size, int order)
{
  return order == 2 ? (size == 3 ? 9 : 16) : size == 3 ? 2 : 3;
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_ELEMENT_NAMES_H
