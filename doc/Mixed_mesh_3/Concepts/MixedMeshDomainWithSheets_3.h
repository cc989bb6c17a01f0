// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgMixedMesh3Concepts
\cgalConcept

\cgalRefines{MixedMeshLabeledDomain_3}

The concept `MixedMeshDomainWithSheets_3` describes a domain that may have sheets inside: surfaces that need
not enclose a volume, such as the falx of a brain. Faces of the mesh are brought onto the sheets.

\cgalHasModelsBegin
\cgalHasModels{CGAL::Labeled_polyhedral_mixed_mesh_domain_3}
\cgalHasModelsEnd
*/
class MixedMeshDomainWithSheets_3
{
public:
  /// The tag by which a model says that it has the function below. With `CGAL::Tag_false`, or without the
  /// tag, the domain has no sheets; a model that has the function, but no tag, does not compile.
  typedef CGAL::Tag_true Has_sheets;

  /// The sheets: a range of pointers, of any kind, to `CGAL::Mixed_mesh_sheet_3`, or to a type with the same
  /// functions `may_intersect()`, `do_intersect()`, `closest_point()` and `locate()`.
  unspecified_type sheets() const;
};
