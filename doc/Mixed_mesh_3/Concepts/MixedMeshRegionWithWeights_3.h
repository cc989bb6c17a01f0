// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgMixedMesh3Concepts
\cgalConcept

\cgalRefines{MixedMeshRegion_3}

The concept `MixedMeshRegionWithWeights_3` describes a region in which errors count more, or less, than in
other regions. `CGAL::Union_mixed_mesh_region_3` is a model if one of its regions is.

\cgalHasModelsBegin
\cgalHasModels{CGAL::Weighted_mixed_mesh_region_3<Region>}
\cgalHasModels{CGAL::Union_mixed_mesh_region_3<Regions...>}
\cgalHasModels{CGAL::Polyhedral_mixed_mesh_regions_3}
\cgalHasModelsEnd
*/
class MixedMeshRegionWithWeights_3
{
public:
  /// The tag by which a model says that it has the function below. With `CGAL::Tag_false`, or without the
  /// tag, the weight is 1; a model that has the function, but no tag, does not compile.
  typedef CGAL::Tag_true Has_weights;

  /*!
  The factor by which an error at a point is multiplied, in addition to the factor for the distance of the
  point from the region.

  \param p the center of a cell, as that of `depth()`
  \param reach the length over which the weight decreases: at a distance d from a region, the weight 1 has
         decreased to \f$ (1 + d / reach)^{-6} \f$; 0 if it counts in the region only
  \return 0 or more, finite
  */
  double weight(const Point_3& p, double reach) const;
};
