// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Weight of an error: how it falls with the distance from a region, and what several regions add.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_ORACLE_WEIGHT_IN_REGION_H
#define CGAL_MIXED_MESH_3_INTERNAL_ORACLE_WEIGHT_IN_REGION_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/oracle/refinements.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// \param distance distance from a region; 0 or less: inside
/// \param reach the distance at which the weight has fallen to 2^-6; 0: errors count inside only
inline double weight_of_distance(double distance, double reach)
{
  // Exponent measured on five regions and patches of a brain (benchmark/Linear_elasticity_3): exponents from
  // 5 to 7 differ by less than 10 %.
  constexpr double exponent = 6;
  return distance <= 0 ? 1 : reach > 0 ? std::pow(1 + distance / reach, -exponent) : 0;
}

/// The weight of an error at a point, without the factor for the distance from the region.
template <class Region, class Point>
double weight_in_region(const Region& region, [[maybe_unused]] const Point& p, [[maybe_unused]] double reach)
{
  if constexpr(has_weights<Region>())
    return region.weight(p, reach);
  else
    return 1;
}

/// The weight in the region in which an error counts most, relative to the weight if only the distance from
/// the union counted.
/// \param regions depth and weight in each, as pairs
template <class Range>
double weight_in_union(const Range& regions, double reach)
{
  double depth = -std::numeric_limits<double>::infinity();
  for(const auto& region : regions)
    depth = (std::max)(depth, region.first);
  const double distance = (std::max)(0., -depth);
  double weight = 0;
  for(const auto& region : regions)
    weight = (std::max)(weight,
                        region.second * weight_of_distance(-region.first - distance, reach + distance));
  return weight;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_ORACLE_WEIGHT_IN_REGION_H
