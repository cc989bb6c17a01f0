// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgMixedMesh3Concepts
\cgalConcept

The concept `MixedElementTraits_3` describes one kind of element at compile time, for code that is written
once for all kinds, for example for the assembly of a stiffness matrix. All members are static: a model need
not be constructible.

\cgalHasModelsBegin
\cgalHasModels{CGAL::Mixed_meshes_3::Mixed_element_traits_3<Kind>\, for each of the four kinds}
\cgalHasModelsEnd

\sa `CGAL::Mixed_meshes_3::Reference_element`
*/
class MixedElementTraits_3
{
public:
  /// The kind.
  static constexpr CGAL::Mixed_meshes_3::Element_kind kind;

  /// The entry of `CGAL::Mixed_meshes_3::reference_elements` for the kind: vertices, edges, faces,
  /// corner tetrahedra, reference coordinates, and the names in files.
  static constexpr const CGAL::Mixed_meshes_3::Reference_element& reference;

  /// The number of vertices, as a constant expression.
  static constexpr int number_of_vertices;

  /// One value for each vertex: `std::array<double, number_of_vertices>`.
  typedef unspecified_type Shape_values;

  /// One gradient for each vertex: `std::array<std::array<double, 3>, number_of_vertices>`.
  typedef unspecified_type Shape_gradients;

  /// The values of the shape functions at the point `(r,s,t)` of the reference element. The shape function of
  /// a vertex is 1 at this vertex and 0 at the other vertices, and the values sum to 1.
  static Shape_values shape_functions(double r, double s, double t);

  /// The gradients of the shape functions with respect to `(r,s,t)`. They need not be defined at
  /// the apex of a pyramid.
  static Shape_gradients shape_gradients(double r, double s, double t);
};
