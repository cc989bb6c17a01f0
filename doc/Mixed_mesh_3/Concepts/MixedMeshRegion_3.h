// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgMixedMesh3Concepts
\cgalConcept

The concept `MixedMeshRegion_3` describes where a mesh is to be fine. A region answers where cells are, as a
domain does, and which cells have priority when the budget does not suffice for all; a region needs no
surface. A region may extend beyond the domain.

`MixedMeshDomain_3` does not refine this concept, and this concept does not refine `MixedMeshDomain_3`.

A model need not be copyable. A model must outlive the call.

\cgalHasModelsBegin
\cgalHasModels{CGAL::Polyhedral_mixed_mesh_region_3}
\cgalHasModels{CGAL::Implicit_mixed_mesh_region_3}
\cgalHasModels{CGAL::Ball_mixed_mesh_region_3}
\cgalHasModels{CGAL::Everywhere_mixed_mesh_region_3}
\cgalHasModels{CGAL::Union_mixed_mesh_region_3<Regions...>}
\cgalHasModels{CGAL::Polyhedral_mixed_mesh_regions_3}
\cgalHasModels{CGAL::Weighted_mixed_mesh_region_3<Region>}
\cgalHasModelsEnd

\sa `MixedMeshRegionWithWeights_3`
\sa `MixedMeshDomain_3`
\sa `CGAL::make_mixed_mesh_3()`
*/
class MixedMeshRegion_3
{
public:
  /// The data of the model about the region's surface in a cell: a model of `DefaultConstructible` and
  /// `MoveConstructible`. Copies of the octree share the part.
  typedef unspecified_type Surface_part;

  /// The part for the root cell, before any query.
  Surface_part surface_part() const;

  /*!
  Computes the position of a cell relative to the region.

  \tparam Cell the cell type of a model of `OctreeCellTraits_3`
  \param cell a cell
  \param parent the part of a cell that contains it: of its parent in the octree, or
         `surface_part()`
  \param part default constructed; a model fills the part if the answer is `ON_BOUNDARY`; otherwise the part
         is ignored
  \return `ON_BOUNDED_SIDE` if the cell and all cells in it meet the region; `ON_UNBOUNDED_SIDE` if none of
          them does; `ON_BOUNDARY` if the cell counts as meeting the region, and the children of the cell are
          to be queried
  */
  template <class Cell>
  CGAL::Bounded_side locate(const Cell& cell, const Surface_part& parent, Surface_part& part) const;

  /// The depth of a point in the region. The depth is negative outside: minus the distance from the region,
  /// or approximately so. The weight of a cell decreases with the distance of its center from the region
  /// (`CGAL::Mixed_mesh_criteria_3::grading()`); a depth that overstates the distance makes the mesh coarse
  /// around the region. Inside, the depth decides between cells of the same size and weight: the deepest cell
  /// is refined first. Cells that are small compared with the region share the depth of an ancestor.
  ///
  /// Depths are lengths, in the unit of the points; they are rounded to units of \f$ 2^{-24} \f$ of the
  /// diagonal of the root cell. Depths must not be NaN.
  /// \param p a `CGAL::Mixed_meshes_3::Predicates_kernel::Point_3`, as cell traits return it
  double depth(const Point_3& p) const;
};
