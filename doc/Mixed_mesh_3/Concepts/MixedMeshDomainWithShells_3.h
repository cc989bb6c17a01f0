// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgMixedMesh3Concepts
\cgalConcept

\cgalRefines{MixedMeshDomain_3}

The concept `MixedMeshDomainWithShells_3` describes a domain that knows the shells of its surface and its
volume: topology and volume of the mesh are compared with them. With domains that are no models of this
concept, nothing is compared, and `CGAL::Mixed_mesh_result_3::shells_of_domain` is empty.

\cgalHasModelsBegin
\cgalHasModels{CGAL::Polyhedral_mixed_mesh_domain_3}
\cgalHasModels{CGAL::Labeled_polyhedral_mixed_mesh_domain_3}
\cgalHasModelsEnd
*/
class MixedMeshDomainWithShells_3
{
public:
  /// The tag by which a model says that it has the functions below. With `CGAL::Tag_false`, or without the
  /// tag, the functions are not called; a model that has them, but no tag, does not compile.
  typedef CGAL::Tag_true Has_shells;

  /// The number of shells of the surface, its Euler characteristic and, if known, the number of shells around
  /// cavities. Where the boundary of the mesh has other values, another one is cut along the surface, and if
  /// the values still differ, the status is `CGAL::Mixed_mesh_status::TOPOLOGY_DIFFERS`.
  /// If the result is empty, topology and volume are not compared.
  std::optional<CGAL::Mixed_meshes_3::Shell_counts> shells() const;

  /// The volume of the domain, if known: a type that converts to this one, such as `double`, is possible as
  /// well. If the volume of the mesh, or that of one of its shells, differs by more than 5 %, another mesh
  /// is made in the same way, and if volumes still differ, the status is
  /// `CGAL::Mixed_mesh_status::VOLUME_DIFFERS`.
  std::optional<double> volume() const;
};
