// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgMixedMesh3Concepts
\cgalConcept

\cgalRefines{MixedMeshDomain_3}

The concept `MixedMeshDomainWithFeatures_3` describes a domain whose surface has sharp edges, or lies in
planes perpendicular to the axes. A model of `MixedMeshSurface_3` that is no domain may have sharp edges as
well: `Has_features` and `sharp_edges()` are sufficient then.

\cgalHasModelsBegin
\cgalHasModels{CGAL::Polyhedral_mixed_mesh_domain_3}
\cgalHasModels{CGAL::Labeled_polyhedral_mixed_mesh_domain_3}
\cgalHasModelsEnd
*/
class MixedMeshDomainWithFeatures_3
{
public:
  /// The tag by which a model says that it has the functions below. With `CGAL::Tag_false`, or without the
  /// tag, the functions are not called; a model that has them, but no tag, does not compile.
  typedef CGAL::Tag_true Has_features;

  /// The edges where the surface is not smooth, by an angle in degrees or more: paths of edges of the mesh
  /// follow these edges, if the edges are long enough.
  /// \param angle the angle between the normals on both sides, positive
  CGAL::Mixed_meshes_3::Sharp_edges sharp_edges(double angle) const;

  /// The planes that contain the surface, if all of its facets are perpendicular to the axes; else nothing.
  /// Then cells are placed such that these planes are between cells, as described for the overload of
  /// `CGAL::make_mixed_mesh_3()` without cell traits. Then `locate()` is asked for the boxes between the
  /// planes.
  CGAL::Mixed_meshes_3::Axis_parallel_planes axis_parallel_planes() const;
};
