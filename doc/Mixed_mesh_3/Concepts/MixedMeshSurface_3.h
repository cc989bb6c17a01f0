// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgMixedMesh3Concepts
\cgalConcept

The concept `MixedMeshSurface_3` describes where the boundary of a mesh is to be: all queries that
`CGAL::optimize_mixed_mesh_3()`, `CGAL::simplify_mixed_mesh_3()` and `CGAL::fit_mixed_mesh_to_surface()` need.

\cgalHasModelsBegin
\cgalHasModels{CGAL::Polyhedral_mixed_mesh_domain_3}
\cgalHasModels{CGAL::Implicit_mixed_mesh_domain_3}
\cgalHasModels{CGAL::Labeled_polyhedral_mixed_mesh_domain_3}
\cgalHasModelsEnd

\sa `MixedMeshDomain_3`
\sa `CGAL::optimize_mixed_mesh_3()`
\sa `CGAL::simplify_mixed_mesh_3()`
\sa `CGAL::fit_mixed_mesh_to_surface()`
*/
class MixedMeshSurface_3
{
public:
  /*!
  A point of a CGAL kernel whose number type converts to `double`: `CGAL::squared_distance()` of two such
  points is computed, and the point is constructed from three `double`s. The points of the cell traits must
  convert to this type. With our cell traits, the type is `CGAL::Mixed_meshes_3::Predicates_kernel::Point_3`.
  */
  typedef unspecified_type Point_3;

  /// A box that contains the surface, of positive finite extents. `CGAL::make_mixed_mesh_3()` without cell
  /// traits places its root cell around the box; with cell traits, the root cell defines the scale on which
  /// lengths are compared.
  CGAL::Bbox_3 bbox() const;

  /// A point of the surface closest to `p`: the target of a boundary vertex.
  ///
  /// A point that is not the closest one reduces quality or fidelity, not validity. The returned point
  /// becomes the position of the vertex, to the last bit: the point should be on the surface up to the
  /// rounding of `double`.
  /// \param p any finite point, inside or outside
  /// \param hint a point of the surface that is probably near `p`: the result for a point near `p`
  Point_3 closest_point(const Point_3& p, const Point_3& hint) const;

  /// As above, where no point of the surface is known yet.
  Point_3 closest_point(const Point_3& p) const;

  /// Points of the surface, such that no point of the surface is much farther than `spacing` from the nearest
  /// of them. Called only if there is a tolerance, as in `CGAL::make_mixed_mesh_3()` by default; the distance
  /// from the mesh is measured at these points. The result is a range of points, in a fixed order;
  /// consecutive points should be near each other.
  std::vector<Point_3> surface_samples(double spacing) const;
};
