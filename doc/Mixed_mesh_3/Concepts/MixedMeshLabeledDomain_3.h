// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgMixedMesh3Concepts
\cgalConcept

\cgalRefines{MixedMeshDomain_3}

The concept `MixedMeshLabeledDomain_3` describes a domain of several subdomains, such as the tissues of a
brain. Indices of subdomains are positive; 0 is the index of the outside, as in the labeled domains of other
packages of \cgal.

The subdomains have an order. Where two subdomains meet, the surface of the first one is their interface;
where subdomains \f$ a_1, \dots, a_n \f$ meet, in this order and the outside last, a vertex has to be on the
interfaces of \f$ a_i \f$ and \f$ a_{i+1} \f$ for all i.

`locate()` also answers `ON_BOUNDARY` for cells that meet an interface. The part that `locate()` fills is also
kept if the answer is `ON_BOUNDED_SIDE`, because the part gives the subdomain of the cell.

\cgalHasModelsBegin
\cgalHasModels{CGAL::Labeled_polyhedral_mixed_mesh_domain_3}
\cgalHasModelsEnd
*/
class MixedMeshLabeledDomain_3
{
public:
  /// The tag by which a model says that it has the functions below. With `CGAL::Tag_false`, or without the
  /// tag, the domain has one subdomain, 1; a model with `subdomain_indices()` or `subdomain_index()`, but no
  /// tag, does not compile.
  typedef CGAL::Tag_true Has_subdomains;

  /// The subdomains in their order: a range of `CGAL::Mixed_meshes_3::Subdomain_index`, all positive and
  /// different.
  unspecified_type subdomain_indices() const;

  /// The subdomain of a point for which `bounded_side()` answers `ON_BOUNDED_SIDE`, and 0 for others. A point
  /// on an interface belongs to the later subdomain.
  /// \param p a point
  /// \param part the part of a cell that contains `p` and meets the domain
  CGAL::Mixed_meshes_3::Subdomain_index subdomain_index(const Point_3& p, const Surface_part& part) const;

  /// A point closest to `p` on the interface between two subdomains, or on the surface that contains this
  /// interface.
  /// \param p any point
  /// \param first a subdomain
  /// \param second a later one, or 0, the outside
  Point_3 closest_point(const Point_3& p, CGAL::Mixed_meshes_3::Subdomain_index first,
                        CGAL::Mixed_meshes_3::Subdomain_index second) const;

  /// As above; `hint` is a point of that interface near `p`, which may make the query faster.
  Point_3 closest_point(const Point_3& p, const Point_3& hint, CGAL::Mixed_meshes_3::Subdomain_index first,
                        CGAL::Mixed_meshes_3::Subdomain_index second) const;

  /// Points of the surface of a subdomain, as dense as those of `MixedMeshSurface_3`, without the parts of
  /// the surface inside an earlier subdomain; for index 0, points of the surfaces of cavities.
  unspecified_type surface_samples(double spacing, CGAL::Mixed_meshes_3::Subdomain_index index) const;

  /// Four times the volume of a subdomain divided by its area, approximately: the tolerance for the surface
  /// of the subdomain is a share of this thickness.
  double mean_chord_length(CGAL::Mixed_meshes_3::Subdomain_index index) const;
};
