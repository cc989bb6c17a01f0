// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgMixedMesh3Concepts
\cgalConcept

\cgalRefines{MixedMeshSurface_3}

The concept `MixedMeshDomain_3` describes the domain to be meshed, by a few queries. The method does not use a
surface mesh: a domain may be the inside of a polyhedron, of an implicit surface, or of a segmented image.

The octree queries the domain, from the root down. A domain can pass its data about the surface in a cell, for
example the triangles that meet the cell, to the children of the cell: this is `Surface_part`. A domain
without such data uses an empty struct.

Points have the type `MixedMeshSurface_3::Point_3`, and hold doubles: with the cell traits of the package, the
type is `CGAL::Mixed_meshes_3::Predicates_kernel::Point_3`, whatever the kernel of the mesh. Where an answer
needs exact numbers, a model constructs them from the coordinates.

Answers may be conservative, but must be consistent: where `locate()` does not answer `ON_BOUNDARY`,
`bounded_side()` must give the same answer for every point of the closed cell.

A model need not be copyable. A model must outlive the call. If the function that takes the domain is called
with `CGAL::Parallel_tag`, several threads call `bounded_side()` and `closest_point()` at the same time; both
must not throw then.

\cgalHasModelsBegin
\cgalHasModels{CGAL::Polyhedral_mixed_mesh_domain_3}
\cgalHasModels{CGAL::Implicit_mixed_mesh_domain_3}
\cgalHasModels{CGAL::Labeled_polyhedral_mixed_mesh_domain_3}
\cgalHasModelsEnd

The example \ref Mixed_mesh_3/mixed_mesh_custom_domain.cpp has a model that is given by a formula.

\sa `MixedMeshDomainWithFeatures_3`
\sa `MixedMeshDomainWithShells_3`
\sa `MixedMeshLabeledDomain_3`
\sa `MixedMeshRegion_3`
\sa `CGAL::make_mixed_mesh_3()`
*/
class MixedMeshDomain_3
{
public:
  /// The data of the model about the surface in a cell: a model of `DefaultConstructible` and
  /// `MoveConstructible`. There is one `Surface_part` for each octree node that meets the surface; a part is
  /// never copied or changed, and copies of the octree share it.
  typedef unspecified_type Surface_part;

  /// The part for the root cell, before any query.
  Surface_part surface_part() const;

  /*!
  Computes the position of a cell relative to the domain.

  \tparam Cell the cell type of a model of `OctreeCellTraits_3`
  \param cell a cell
  \param parent the part of a cell that contains it: of its parent in the octree, or
         `surface_part()`
  \param part default constructed; a model fills the part if the answer is `ON_BOUNDARY`; otherwise the part
         is ignored
  \return `ON_BOUNDED_SIDE` if the closed cell is in the interior of the domain; `ON_UNBOUNDED_SIDE` if the
          cell is in the exterior; `ON_BOUNDARY` if the cell meets the surface, or might meet it. The children
          of a cell off the surface are not queried.
  */
  template <class Cell>
  CGAL::Bounded_side locate(const Cell& cell, const Surface_part& parent, Surface_part& part) const;

  /// The side of a point.
  /// \param p a vertex of a cell, or the center of a face or of a cell
  /// \param part the part of a cell which contains `p`, and for which `locate()` answered `ON_BOUNDARY`
  CGAL::Bounded_side bounded_side(const Point_3& p, const Surface_part& part) const;

  /// A point of the surface closest to `p`.
  ///
  /// For vertices outside the domain, only the distance to this point matters: the distance determines the
  /// order in which boundary elements are split, in units of \f$ 2^{-24} \f$ of the diagonal of the root
  /// cell. For corners and centers of cells without elements, the point itself tells whether the boundary
  /// of the mesh has come near to this part of the surface.
  /// \param p any point
  /// \param part the part of a cell which contains `p`, or a default-constructed part if that cell does not
  ///        meet the surface; the part is a hint, and the closest point may lie elsewhere
  Point_3 closest_point(const Point_3& p, const Surface_part& part) const;
};
