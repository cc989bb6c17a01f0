// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgMixedMesh3Concepts
\cgalConcept

The concept `MixedMeshSurface_3` describes where the boundary of a mesh is to be: all that
`CGAL::optimize_mixed_mesh_3()` and `CGAL::fit_mixed_mesh_to_surface()` ask for.

\cgalHasModelsBegin
\cgalHasModels{CGAL::Polyhedral_mixed_mesh_domain_3}
\cgalHasModels{CGAL::Implicit_mixed_mesh_domain_3}
\cgalHasModels{CGAL::Labeled_polyhedral_mixed_mesh_domain_3}
\cgalHasModelsEnd

\sa `MixedMeshDomain_3`
\sa `CGAL::optimize_mixed_mesh_3()`
\sa `CGAL::fit_mixed_mesh_to_surface()`
*/
class MixedMeshSurface_3
{
public:
  /*!
  A point of a CGAL kernel whose number type converts to `double`: `CGAL::squared_distance()` of two
  of them is taken, and it is constructed from three `double`s. The points of the cell traits must
  convert to it. With our cell traits: `CGAL::Mixed_meshes_3::Predicates_kernel::Point_3`.
  */
  typedef unspecified_type Point_3;

  /// A point of the surface as near to `p` as any: where a boundary vertex goes.
  ///
  /// A point that is not the nearest costs quality or fidelity, not validity. What is returned is the
  /// position of the vertex, to the last bit: it should be on the surface up to the rounding of `double`.
  /// \param p any finite point, inside or outside
  /// \param hint a point of the surface that is probably near: what was returned for a point near `p`
  Point_3 closest_point(const Point_3& p, const Point_3& hint) const;

  /// As above, where no point of the surface is known yet.
  Point_3 closest_point(const Point_3& p) const;

  /// Points of the surface, such that none of its points is much farther than `spacing` from one of them.
  /// Asked for only if there is a tolerance, as `CGAL::make_mixed_mesh_3()` has by default; the distance from
  /// the mesh is measured there. The result is a range of points, in a fixed order; neighbors in that order
  /// should be near to each other.
  std::vector<Point_3> surface_samples(double spacing) const;

  /// The edges where the surface is not smooth, by an angle in degrees or more: paths of edges of the mesh
  /// will be on them, as far as they are long enough to be followed. Optional: none in a model without this
  /// function.
  /// \param angle positive, between the normals on both sides
  CGAL::Mixed_meshes_3::Sharp_edges sharp_edges(double angle) const;
};
