// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgMixedMesh3Concepts
\cgalConcept

The concept `MixedMeshRegion_3` describes where a mesh shall be fine. It needs to tell where cells
are, as a domain does, and what comes first when the budget does not reach everything; it needs no
surface. It may extend beyond the domain.

`MixedMeshDomain_3` does not refine this concept, nor the other way round.

A model need not be copied. It must outlive the call.

\cgalHasModelsBegin
\cgalHasModels{CGAL::Polyhedral_mixed_mesh_region_3}
\cgalHasModels{CGAL::Implicit_mixed_mesh_region_3}
\cgalHasModels{CGAL::Ball_mixed_mesh_region_3}
\cgalHasModels{CGAL::Everywhere_mixed_mesh_region_3}
\cgalHasModels{CGAL::Union_mixed_mesh_region_3<Regions...>}
\cgalHasModels{CGAL::Polyhedral_mixed_mesh_regions_3}
\cgalHasModels{CGAL::Weighted_mixed_mesh_region_3<Region>}
\cgalHasModelsEnd

\sa `MixedMeshDomain_3`
\sa `CGAL::make_mixed_mesh_3()`
*/
class MixedMeshRegion_3
{
public:
  /// What is known about the region's surface in a cell: a model of `DefaultConstructible` and
  /// `MoveConstructible`. Copies of the octree share it.
  typedef unspecified_type Surface_part;

  /// What is known before any query: the part for the root cell.
  Surface_part surface_part() const;

  /*!
  Where a cell is.

  \tparam Cell the cell type of a model of `OctreeCellTraits_3`
  \param cell a cell
  \param parent the part of a cell that contains it: of its parent in the octree, or
         `surface_part()`
  \param part default constructed; to be filled if the answer is `ON_BOUNDARY`, and ignored if not
  \return `ON_BOUNDED_SIDE` if the cell and all cells in it meet the region; `ON_UNBOUNDED_SIDE`
          if none does; `ON_BOUNDARY` if the cell counts as meeting it, and its children are to be
          asked about
  */
  template <class Cell>
  CGAL::Bounded_side locate(const Cell& cell, const Surface_part& parent, Surface_part& part) const;

  /// How deep a point is in the region; negative outside: minus the distance from the region, or about that.
  /// The farther the center of a cell is outside, the less it counts
  /// (`CGAL::Mixed_mesh_criteria_3::grading()`); a depth that overstates the distance makes the mesh coarse
  /// around the region. Inside, depths decide between cells of one size that count the same: the deepest is
  /// refined first. Cells that are small against the region share the depth of an ancestor.
  ///
  /// Depths are lengths, in the unit of the points: they are rounded to units of \f$ 2^{-24} \f$ of
  /// the diagonal of the root cell. They must not be NaN.
  /// \param p a `CGAL::Mixed_meshes_3::Predicates_kernel::Point_3`, as cell traits return it
  double depth(const Point_3& p) const;

  /*!
  How many times as much an error counts at a point as it would if only its distance from the region did.
  Optional: 1 in a model without this function.

  \param p the center of a cell, as that of `depth()`
  \param reach over what distance from a region the weight falls: at a distance d, the weight 1 has fallen to
         \f$ (1 + d / reach)^{-6} \f$; 0 if it counts in the region only
  \return 0 or more, finite
  */
  double weight(const Point_3& p, double reach) const;
};
