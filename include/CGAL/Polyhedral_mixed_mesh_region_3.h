// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Regions of interest inside surfaces: models of `MixedMeshRegion_3`.

#ifndef CGAL_POLYHEDRAL_MIXED_MESH_REGION_3_H
#define CGAL_POLYHEDRAL_MIXED_MESH_REGION_3_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/oracle/weight_in_region.h>
#include <CGAL/Mixed_mesh_3/internal/surface/Surface_oracle_3.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/assertions.h>
#include <CGAL/squared_distance_3.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {

/*!
\ingroup PkgMixedMesh3Domains

\brief The region inside a closed triangulated surface.

\cgalModels{MixedMeshRegion_3}
*/
class Polyhedral_mixed_mesh_region_3 : private Mixed_meshes_3::internal::Surface_oracle_3
{
  using Base = Mixed_meshes_3::internal::Surface_oracle_3;

public:
  using Base::Kernel;
  using Base::Point_3;
  using Base::Surface_part;

  /*!
  \tparam FaceListGraph a model of `FaceListGraph`, with points of any CGAL kernel
  \param surface surface. \pre `CGAL::is_triangle_mesh(surface) && CGAL::is_closed(surface)`
  \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those below

  \cgalNamedParamsBegin
    \cgalParamNBegin{vertex_point_map}
      \cgalParamDescription{the points of `surface`}
      \cgalParamType{a model of `ReadablePropertyMap` with the vertices as keys and points as values}
      \cgalParamDefault{`get_const_property_map(CGAL::vertex_point, surface)`}
    \cgalParamNEnd
  \cgalNamedParamsEnd
  */
  template <class FaceListGraph, class NamedParameters = parameters::Default_named_parameters>
  explicit Polyhedral_mixed_mesh_region_3(const FaceListGraph& surface,
                                          const NamedParameters& np = parameters::default_values())
    : Base(surface, np)
  {
  }

  using Base::bbox;
  using Base::bounded_side;
  using Base::closest_point;
  using Base::locate;
  using Base::surface_part;

  /// Depth below the surface; negative outside.
  double depth(const Point_3& p) const
  {
    const double d = std::sqrt(CGAL::squared_distance(p, closest_point(p, Surface_part())));
    return bounded_side(p) == ON_UNBOUNDED_SIDE ? -d : d;
  }
};

/*!
\ingroup PkgMixedMesh3Domains

\brief The union of any number of regions inside closed triangulated surfaces, each with a weight.

An error counts as in the region in which it counts most. Without regions, an error counts everywhere alike,
as with `Everywhere_mixed_mesh_region_3`. Copies share the regions.

\cgalModels{MixedMeshRegionWithWeights_3}
*/
class Polyhedral_mixed_mesh_regions_3
{
  using Region = Polyhedral_mixed_mesh_region_3;

public:
  /// The type of points.
  using Point_3 = Mixed_meshes_3::Predicates_kernel::Point_3;
  using Has_weights = Tag_true;
  /// The parts of the regions, and the side of the cell relative to each region.
  struct Surface_part
  {
    /// A part of each region.
    std::vector<Region::Surface_part> parts;
    /// The side of the cell relative to each region.
    std::vector<Bounded_side> sides;
  };

  /// Adds a region.
  /// \param region region, which copies share
  /// \param weight weight as that of a `Weighted_mixed_mesh_region_3`. \pre positive and finite
  void add(std::shared_ptr<const Polyhedral_mixed_mesh_region_3> region, double weight = 1)
  {
    CGAL_precondition(weight > 0 && std::isfinite(weight));
    m_has_weights = m_has_weights || (size() > 0 && weight != m_regions.front().weight);
    m_regions.push_back({std::move(region), weight});
  }

  /// Adds the region inside a surface.
  /// \param surface,np parameters of `Polyhedral_mixed_mesh_region_3`
  /// \param weight weight as above
  template <class FaceListGraph, class NamedParameters = parameters::Default_named_parameters,
            std::enable_if_t<!std::is_convertible_v<FaceListGraph, std::shared_ptr<const Region>>>* = nullptr>
  void add(const FaceListGraph& surface, double weight = 1,
           const NamedParameters& np = parameters::default_values())
  {
    add(std::make_shared<const Region>(surface, np), weight);
  }

  /// The number of regions.
  std::size_t size() const { return m_regions.size(); }

  Surface_part surface_part() const
  {
    Surface_part part;
    for(const Weighted& r : m_regions)
      part.parts.push_back(r.region->surface_part());
    part.sides.assign(size(), ON_BOUNDARY);
    return part;
  }

  template <class Cell>
  Bounded_side locate(const Cell& cell, const Surface_part& parent, Surface_part& part) const
  {
    if(size() == 0)
      return ON_BOUNDED_SIDE;
    part.parts.resize(size());
    part.sides = parent.sides;
    for(std::size_t i = 0; i < size(); ++i)
      if(part.sides[i] == ON_BOUNDARY)
        part.sides[i] = m_regions[i].region->locate(cell, parent.parts[i], part.parts[i]);
    return *std::max_element(part.sides.begin(), part.sides.end());
  }

  double depth(const Point_3& p) const
  {
    if(size() == 0)
      return 0;
    double depth = -std::numeric_limits<double>::infinity();
    for(const Weighted& r : m_regions)
      depth = (std::max)(depth, r.region->depth(p));
    return depth;
  }

  double weight(const Point_3& p, double reach) const
  {
    if(!m_has_weights)
      return size() == 0 ? 1 : m_regions.front().weight;
    std::vector<std::pair<double, double>> depths_and_weights;
    for(const Weighted& r : m_regions)
      depths_and_weights.emplace_back(r.region->depth(p), r.weight);
    return Mixed_meshes_3::internal::weight_in_union(depths_and_weights, reach);
  }

private:
  struct Weighted
  {
    std::shared_ptr<const Region> region;
    double weight;
  };
  std::vector<Weighted> m_regions;
  bool m_has_weights = false; // whether weights differ
};

} // namespace CGAL

#endif // CGAL_POLYHEDRAL_MIXED_MESH_REGION_3_H
