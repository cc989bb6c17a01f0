// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The four element kinds as constant tables. Every algorithm loops over these tables; no algorithm enumerates
// faces or edges by hand.

#ifndef CGAL_MIXED_MESH_3_MIXED_ELEMENT_TRAITS_3_H
#define CGAL_MIXED_MESH_3_MIXED_ELEMENT_TRAITS_3_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <array>
#include <cstdint>

namespace CGAL {
namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMesh3Elements
/// The kinds of elements; the value is the index into `reference_elements` and the value of the
/// cell data `kind` in the files written.
enum Element_kind : std::uint8_t {
  TETRAHEDRON, ///< four vertices
  PYRAMID,     ///< five vertices: a quadrilateral and an apex
  PRISM,       ///< six vertices: two triangles
  HEXAHEDRON   ///< eight vertices
};

/// \ingroup PkgMixedMesh3Elements
/// The number of kinds of elements.
inline constexpr int number_of_element_kinds = 4;
/// \ingroup PkgMixedMesh3Elements
/// All kinds, in the order of their values.
inline constexpr Element_kind element_kinds[number_of_element_kinds] = {TETRAHEDRON, PYRAMID, PRISM,
                                                                        HEXAHEDRON};

/// \ingroup PkgMixedMesh3Elements
/// A face of an element: its local vertices, counter-clockwise seen from outside the element.
struct Element_face
{
  /// The number of vertices, three or four.
  int size;
  /// Local numbers of the vertices; the fourth of a triangle has no meaning.
  std::uint8_t vertices[4];
};

/*!
\ingroup PkgMixedMesh3Elements

A row of the table of element kinds: combinatorics and reference coordinates.

Vertex order (positive Jacobian; the order of Gmsh, Abaqus, Medit and FEBio):

         3                 4                  5                 7-------6
        /|\              / /|\               /|\               /|      /|
       / | \            / / | \             / | \             4-------5 |
      /  |  \          / 3-/---2           3-----4            | |     | |
     0---|---2        / / /   /            |  2  |            | 3-----|-2
      \  |  /        0-------1             | / \ |            |/      |/
       \ | /                               |/   \|            0-------1
         1                                 0-----1
*/
struct Reference_element
{
  /// The name in the singular.
  const char* name;
  /// The name in the plural.
  const char* plural;
  /// The number of vertices, from 4 to 8.
  int number_of_vertices;
  /// The number of edges, from 6 to 12.
  int number_of_edges;
  /// Local vertices of each edge.
  std::uint8_t edges[12][2];
  /// The number of faces, from 4 to 6.
  int number_of_faces;
  /// The faces, in our own order, which is that of `Face::local_index()`.
  Element_face faces[6];
  /// The number of corner tetrahedra: a vertex with its three neighbors (the apex of a pyramid has four
  /// neighbors, so it has no corner tetrahedron; the four at the base cover the pyramid).
  int number_of_corners;
  /// Local vertices of each corner tetrahedron, positively oriented.
  std::uint8_t corners[8][4];
  /// Coordinates of the vertices of the reference element: barycentric in tetrahedron and triangle, [-1,1] in
  /// the other directions, height 1 for the pyramid.
  std::int8_t coordinates[8][3];
};

/// \ingroup PkgMixedMesh3Elements
/// The table of element kinds, by `Element_kind`.
inline constexpr Reference_element reference_elements[] = {
  {"tetrahedron",
   "tetrahedra",
   4,
   6,
   {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}},
   4,
   {{3, {1, 2, 3}}, {3, {0, 3, 2}}, {3, {0, 1, 3}}, {3, {0, 2, 1}}},
   1,
   {{0, 1, 2, 3}},
   {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
  {"pyramid",
   "pyramids",
   5,
   8,
   {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}},
   5,
   {{4, {0, 3, 2, 1}}, {3, {0, 1, 4}}, {3, {1, 2, 4}}, {3, {2, 3, 4}}, {3, {3, 0, 4}}},
   4,
   {{0, 1, 3, 4}, {1, 2, 0, 4}, {2, 3, 1, 4}, {3, 0, 2, 4}},
   {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 1}}},
  {"prism",
   "prisms",
   6,
   9,
   {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}},
   5,
   {{3, {0, 2, 1}}, {3, {3, 4, 5}}, {4, {0, 1, 4, 3}}, {4, {1, 2, 5, 4}}, {4, {2, 0, 3, 5}}},
   6,
   {{0, 1, 2, 3}, {1, 2, 0, 4}, {2, 0, 1, 5}, {3, 5, 4, 0}, {4, 3, 5, 1}, {5, 4, 3, 2}},
   {{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}},
  {"hexahedron",
   "hexahedra",
   8,
   12,
   {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}},
   6,
   {{4, {0, 4, 7, 3}},
    {4, {1, 2, 6, 5}},
    {4, {0, 1, 5, 4}},
    {4, {3, 7, 6, 2}},
    {4, {0, 3, 2, 1}},
    {4, {4, 5, 6, 7}}},
   8,
   {{0, 1, 3, 4},
    {1, 2, 0, 5},
    {2, 3, 1, 6},
    {3, 0, 2, 7},
    {4, 7, 5, 0},
    {5, 4, 6, 1},
    {6, 5, 7, 2},
    {7, 6, 4, 3}},
   {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}}};
static_assert(sizeof(reference_elements) / sizeof(reference_elements[0]) == number_of_element_kinds,
              "a row for each kind");

namespace internal {

/// Orders of the vertices of a tetrahedron that keep its orientation; each vertex is first in one order.
inline constexpr int even_permutations[4][4] = {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 0, 1, 3}, {3, 0, 2, 1}};

} // namespace internal

/*!
\ingroup PkgMixedMesh3Elements

\brief Model of `MixedElementTraits_3` for one kind, known at compile time.

Adds the shape functions to the table.

\tparam Kind the element kind.
\cgalModels{MixedElementTraits_3}
*/
template <Element_kind Kind>
struct Mixed_element_traits_3
{
  /// The kind.
  static constexpr Element_kind kind = Kind;
  /// The row of the kind in the table.
  static constexpr const Reference_element& reference = reference_elements[Kind];
  /// The number of vertices.
  static constexpr int number_of_vertices = reference_elements[Kind].number_of_vertices;
  /// A value for each vertex.
  using Shape_values = std::array<double, number_of_vertices>;
  /// Derivatives by the three reference coordinates, for each vertex.
  using Shape_gradients = std::array<std::array<double, 3>, number_of_vertices>;

  /// Values of the shape functions at the point `(r,s,t)` of the reference element. Shape functions are 1 at
  /// their vertex, 0 at the others, and sum to 1. The shape functions of the pyramid are rational (Bedrosian,
  /// 1992), so that they are linear on the triangular faces, and continuous at the apex.
  static Shape_values shape_functions(double r, double s, double t)
  {
    Shape_values n{};
    if constexpr(Kind == TETRAHEDRON) {
      n = {1 - r - s - t, r, s, t};
    } else if constexpr(Kind == PYRAMID) {
      const double d = 1 - t;
      const double rs = d > 0 ? r * s * t / d : 0;
      for(int i = 0; i < 4; ++i) {
        const auto& c = reference.coordinates[i];
        n[i] = ((1 + c[0] * r) * (1 + c[1] * s) - t + c[0] * c[1] * rs) / 4;
      }
      n[4] = t;
    } else if constexpr(Kind == PRISM) {
      const double l[3] = {1 - r - s, r, s};
      for(int i = 0; i < 6; ++i)
        n[i] = l[i % 3] * (1 + reference.coordinates[i][2] * t) / 2;
    } else {
      static_assert(Kind == HEXAHEDRON, "the shape functions of this kind are missing");
      for(int i = 0; i < 8; ++i) {
        const auto& c = reference.coordinates[i];
        n[i] = (1 + c[0] * r) * (1 + c[1] * s) * (1 + c[2] * t) / 8;
      }
    }
    return n;
  }

  /// Gradients of the shape functions in reference coordinates; not defined at the pyramid's apex.
  static Shape_gradients shape_gradients(double r, double s, double t)
  {
    Shape_gradients g{};
    if constexpr(Kind == TETRAHEDRON) {
      g = {{{-1, -1, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    } else if constexpr(Kind == PYRAMID) {
      const double d = 1 - t;
      for(int i = 0; i < 4; ++i) {
        const auto& c = reference.coordinates[i];
        const double cc = c[0] * c[1];
        g[i] = {(c[0] * (1 + c[1] * s) + cc * s * t / d) / 4, (c[1] * (1 + c[0] * r) + cc * r * t / d) / 4,
                (-1 + cc * r * s / (d * d)) / 4};
      }
      g[4] = {0, 0, 1};
    } else if constexpr(Kind == PRISM) {
      const double l[3] = {1 - r - s, r, s};
      const double dl[3][2] = {{-1, -1}, {1, 0}, {0, 1}};
      for(int i = 0; i < 6; ++i) {
        const double c = reference.coordinates[i][2], h = (1 + c * t) / 2;
        g[i] = {dl[i % 3][0] * h, dl[i % 3][1] * h, l[i % 3] * c / 2};
      }
    } else {
      static_assert(Kind == HEXAHEDRON, "the shape functions of this kind are missing");
      for(int i = 0; i < 8; ++i) {
        const auto& c = reference.coordinates[i];
        const double a = 1 + c[0] * r, b = 1 + c[1] * s, e = 1 + c[2] * t;
        g[i] = {c[0] * b * e / 8, a * c[1] * e / 8, a * b * c[2] / 8};
      }
    }
    return g;
  }
};

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_MIXED_ELEMENT_TRAITS_3_H
