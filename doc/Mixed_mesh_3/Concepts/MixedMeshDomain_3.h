// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgMixedMesh3Concepts
\cgalConcept

\cgalRefines{MixedMeshSurface_3}

The concept `MixedMeshDomain_3` describes what is meshed, by a handful of queries. The method never
sees a surface: a domain may be the inside of a polyhedron, of an implicit surface, or of a
segmented image.

Queries come from the octree, from the root down. A domain can hand what it knows about its surface
in a cell, for example the triangles that meet it, down to the children of the cell: this is
`Surface_part`. A domain that has no use for it takes an empty struct.

Points are those of `MixedMeshSurface_3::Point_3`, of doubles: with the cell traits of the package,
`CGAL::Mixed_meshes_3::Predicates_kernel::Point_3`, whatever the kernel of the mesh. Where an answer takes
exact numbers, a model makes them of the coordinates.

Answers may be too cautious, but must not contradict each other: where `locate()` does not answer
`ON_BOUNDARY`, `bounded_side()` would say the same of every point of the closed cell.

A model need not be copied. It must outlive the call. `bounded_side()` and `closest_point()` are
called by several threads at once if the function that takes the domain is called with `CGAL::Parallel_tag`,
and must not throw then.

\cgalHasModelsBegin
\cgalHasModels{CGAL::Polyhedral_mixed_mesh_domain_3}
\cgalHasModels{CGAL::Implicit_mixed_mesh_domain_3}
\cgalHasModels{CGAL::Labeled_polyhedral_mixed_mesh_domain_3}
\cgalHasModelsEnd

The example \ref Mixed_mesh_3/mixed_mesh_custom_domain.cpp has a model given by a formula.

\sa `MixedMeshRegion_3`
\sa `CGAL::make_mixed_mesh_3()`
*/
class MixedMeshDomain_3
{
public:
  /// What is known about the surface in a cell: a model of `DefaultConstructible` and
  /// `MoveConstructible`. There is one for each octree node that meets the surface; it is never
  /// copied nor changed, copies of the octree share it.
  typedef unspecified_type Surface_part;

  /// A box that contains the domain, of positive finite extents. Needed only by the overload of
  /// `CGAL::make_mixed_mesh_3()` that takes no cell traits: with cell traits, all lengths are
  /// compared on the scale of their root.
  CGAL::Bbox_3 bbox() const;

  /// What is known before any query: the part for the root cell.
  Surface_part surface_part() const;

  /*!
  Where a cell is.

  \tparam Cell the cell type of a model of `OctreeCellTraits_3`
  \param cell a cell
  \param parent the part of a cell that contains it: of its parent in the octree, or
         `surface_part()`
  \param part default constructed; to be filled if the answer is `ON_BOUNDARY`, and ignored if not
  \return `ON_BOUNDED_SIDE` if the closed cell is in the interior of the domain; `ON_UNBOUNDED_SIDE`
          if it is in the exterior; `ON_BOUNDARY` if it meets the surface, or might. The children of
          a cell that is off the surface are not asked about.
  */
  template <class Cell>
  CGAL::Bounded_side locate(const Cell& cell, const Surface_part& parent, Surface_part& part) const;

  /// The side of a point.
  /// \param p a vertex of a cell, or the center of a face or of a cell
  /// \param part that of a cell which contains `p`, and for which `locate()` answered `ON_BOUNDARY`
  CGAL::Bounded_side bounded_side(const Point_3& p, const Surface_part& part) const;

  /// A point of the surface as near to `p` as any. Asked for vertices outside the domain.
  ///
  /// Only the distance counts: it decides the order in which boundary elements are split, in units of
  /// \f$ 2^{-24} \f$ of the diagonal of the root cell.
  /// \param p any point
  /// \param part that of a cell which contains `p`, or a default-constructed one if that cell does not
  ///        meet the surface; a hint, the closest point may lie elsewhere
  Point_3 closest_point(const Point_3& p, const Surface_part& part) const;

  /// \name Optional Functions
  /// What a domain tells of its surface as a whole. A model without one of these functions is meshed all
  /// the same.
  /// @{

  /// How many shells the surface has, its Euler characteristic and, if that is known, how many of the shells
  /// are around cavities. Where the boundary of the mesh is not like that, thin walls and narrow gaps are
  /// resolved first, and if it still is not, the status is `CGAL::Mixed_mesh_status::TOPOLOGY_DIFFERS`.
  /// Without this function, topology and volume are not compared, and
  /// `CGAL::Mixed_mesh_result_3::shells_of_domain` is empty; so it is where the result is.
  std::optional<CGAL::Mixed_meshes_3::Shell_counts> shells() const;

  /// The volume of the domain. If that of the mesh differs by more than 5 %, thin parts are resolved first,
  /// and if it still does, the status is `CGAL::Mixed_mesh_status::VOLUME_DIFFERS`. Asked for if `shells()`
  /// tells.
  double volume() const;

  /// The planes that the surface lies in, if all of it is perpendicular to the axes; else nothing. Then cells
  /// are placed such that these planes are between them, as the overload of `CGAL::make_mixed_mesh_3()`
  /// without cell traits says. Asked for if there is `volume()`, which must be positive then.
  CGAL::Mixed_meshes_3::Axis_parallel_planes axis_parallel_planes() const;
  /// @}
};
