// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Correspondence of the bodies and cavities of two solids.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_SURFACE_COMPARE_SHELLS_H
#define CGAL_MIXED_MESH_3_INTERNAL_SURFACE_COMPARE_SHELLS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Disjoint_sets.h>
#include <CGAL/Mixed_mesh_3/internal/surface/Nested_shells.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Location of a region of one solid in another solid, by its sample points, weighted by the lengths of their
/// chords.
struct Region_location
{
  std::size_t same = Nested_shells::outside; ///< the region of the same kind that has most of it
  double share_in_solid = 0;                 ///< share of its sample points that are in bodies
  Predicates_kernel::Point_3 middle;         ///< the sample point nearest to their mean
  Nested_shells::Sample elsewhere{{}, 0}; ///< a sample point on the other side, in a body and not in a cavity
                                          ///< or conversely; length 0 if there is none
};

/// The sample point that is nearest to the mean of all: inside the region even if the region is bent.
/// \pre `samples` is not empty
inline Predicates_kernel::Point_3 middle_of(const std::vector<Nested_shells::Sample>& samples)
{
  Vec3 sum{};
  double length = 0;
  for(const Nested_shells::Sample& s : samples) {
    sum = sum + s.length * to_vec3(s.point);
    length += s.length;
  }
  const Vec3 mean = (1 / length) * sum;
  const auto distance = [&](const Nested_shells::Sample& s) { return norm(to_vec3(s.point) - mean); };
  return std::min_element(samples.begin(), samples.end(),
                          [&](const auto& s, const auto& t) { return distance(s) < distance(t); })
    ->point;
}

inline Region_location locate_region(const Nested_shells& a, std::size_t region, const Nested_shells& b)
{
  constexpr double least_share = 0.1; // parts on the border of a region do not belong to it
  Region_location location;
  const std::vector<Nested_shells::Sample> samples = a.samples(region);
  location.middle = samples.empty() ? a.point_on(region) : middle_of(samples);
  std::map<std::size_t, double> lengths; // lengths in regions of b
  double sum = 0, sum_in_solid = 0;
  for(const Nested_shells::Sample& s : samples) {
    const std::size_t other = b.region_of(s.point);
    lengths[other] += s.length;
    sum += s.length;
    sum_in_solid += b.is_solid(other) ? s.length : 0;
    if(b.is_solid(other) != a.is_solid(region) && s.length > location.elsewhere.length)
      location.elsewhere = s;
  }
  location.share_in_solid = sum > 0 ? sum_in_solid / sum : 0;
  double best = least_share * sum;
  for(const auto& [other, length] : lengths)
    if(other != Nested_shells::outside && b.is_solid(other) == a.is_solid(region) && length > best) {
      best = length;
      location.same = other;
    }
  return location;
}

inline std::vector<Region_location> locate_regions(const Nested_shells& a, const Nested_shells& b)
{
  std::vector<Region_location> locations;
  for(std::size_t r = 0; r < a.size(); ++r)
    locations.push_back(locate_region(a, r, b));
  return locations;
}

/// The regions that are in each region of the other solid.
inline std::vector<std::vector<std::size_t>> indices_at(const std::vector<Region_location>& locations,
                                                        std::size_t number_of_others)
{
  std::vector<std::vector<std::size_t>> regions(number_of_others);
  for(std::size_t r = 0; r < locations.size(); ++r)
    if(locations[r].same != Nested_shells::outside)
      regions[locations[r].same].push_back(r);
  return regions;
}

/// Regions of two solids that belong to each other, directly or through other regions.
struct Region_group
{
  std::vector<std::size_t> in_a, in_b;
};

inline std::vector<Region_group> groups(const std::vector<Region_location>& of_a,
                                        const std::vector<Region_location>& of_b)
{
  Disjoint_sets sets(of_a.size() + of_b.size());
  for(std::size_t r = 0; r < of_a.size(); ++r)
    if(of_a[r].same != Nested_shells::outside)
      sets.unite(r, of_a.size() + of_a[r].same);
  for(std::size_t r = 0; r < of_b.size(); ++r)
    if(of_b[r].same != Nested_shells::outside)
      sets.unite(of_a.size() + r, of_b[r].same);
  const auto [group_of, number_of_groups] = sets.numbered();
  std::vector<Region_group> result(number_of_groups);
  for(std::size_t r = 0; r < group_of.size(); ++r) {
    Region_group& group = result[group_of[r]];
    if(r < of_a.size())
      group.in_a.push_back(r);
    else
      group.in_b.push_back(r - of_a.size());
  }
  return result;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_SURFACE_COMPARE_SHELLS_H
