// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cells that are too large for sharp edges that are near to each other.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_SHARP_CELLS_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_SHARP_CELLS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Located_octree.h>
#include <CGAL/Mixed_mesh_3/internal/surface/Sharp_features.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// A point of a sharp edge, with its distance from the nearest other sharp edge: the width of what is
/// between.
struct Narrow_place
{
  Vec3 point;
  double width;
};

/*!
Points of sharp edges beside which other sharp edges run, or other parts of the same one. Edges that part at a
corner at a large angle are not narrow there, however near to each other they are.

\param reach largest width of interest
\param step distance of the points
*/
inline std::vector<Narrow_place> narrow_places(const Sharp_features& features, double reach, double step)
{
  // Sine of an angle of 30 degrees, about: edges that part at a larger one are not narrow at their corner.
  constexpr double least_ratio = 0.5;
  // Width in radii: cells of two thirds of it, and edges about as long, are off by a twentieth.
  constexpr double width_of_radius = 0.6;
  struct Sample
  {
    Vec3 point;
    std::size_t polyline;
    double length;
  };
  using Cell = std::array<long, 3>;
  std::vector<Sample> samples;
  std::map<Cell, std::vector<std::size_t>> grid;
  const auto cell = [&](const Vec3& p) {
    return Cell{long(std::floor(p[0] / reach)), long(std::floor(p[1] / reach)),
                long(std::floor(p[2] / reach))};
  };
  const std::vector<Feature_polyline>& polylines = features.polylines();
  for(std::size_t i = 0; i < polylines.size(); ++i) {
    const int n = int(std::ceil(polylines[i].length() / step));
    for(int k = 0; k <= n; ++k) {
      const double length = polylines[i].length() * k / n;
      samples.push_back({polylines[i].at(length), i, length});
      grid[cell(samples.back().point)].push_back(samples.size() - 1);
    }
  }
  // Whether two points are on edges that part at a common corner, or on one edge, so that the distance of the
  // points is that along the edges, nearly.
  const auto is_beside = [&](const Sample& a, const Sample& b, double distance) {
    if(a.polyline == b.polyline)
      return distance >= least_ratio * std::abs(a.length - b.length);
    for(std::size_t c : polylines[a.polyline].corners)
      for(std::size_t d : polylines[b.polyline].corners)
        if(c == d) {
          const Vec3& corner = features.corners()[c];
          if(distance >= least_ratio * (std::max)(norm(a.point - corner), norm(b.point - corner)))
            return true;
        }
    return false;
  };
  std::vector<Narrow_place> places;
  for(const Sample& a : samples) {
    const Cell center = cell(a.point);
    double width = std::numeric_limits<double>::infinity();
    for(long x = -1; x <= 1; ++x)
      for(long y = -1; y <= 1; ++y)
        for(long z = -1; z <= 1; ++z) {
          const auto found = grid.find({center[0] + x, center[1] + y, center[2] + z});
          if(found == grid.end())
            continue;
          for(std::size_t i : found->second) {
            const double distance = norm(samples[i].point - a.point);
            if(distance < (std::min)(width, reach) && !is_beside(a, samples[i], distance))
              width = distance;
          }
        }
    // An edge along a curve of radius r is off by the share e / (8 r) of its length e.
    const Feature_polyline& polyline = polylines[a.polyline];
    const double window = reach / 2;
    if(a.length >= window && a.length <= polyline.length() - window) {
      const Vec3 to = a.point - polyline.at(a.length - window),
                 from = polyline.at(a.length + window) - a.point;
      const double angle = std::atan2(norm(cross(to, from)), dot(to, from));
      if(angle > 0)
        width = (std::min)(width, width_of_radius * window / angle);
    }
    if(width < reach)
      places.push_back({a.point, width});
  }
  return places;
}

/// Splits cells at narrow places, until two of them fit side by side, or they would be smaller than a limit.
inline void split_narrow_cells(Located_octree& octree, const std::vector<Narrow_place>& places,
                               double smallest)
{
  // With half of it, meshes keep 0.6 % less of their sharp edges; one of 18 has vertices off the surface.
  constexpr double cells_per_width = 1.5;
  for(;;) {
    std::vector<Octree::Node_index> leaves;
    for(const Narrow_place& place : places) {
      const double edge = place.width / cells_per_width;
      for(int corner = 0; corner < 8; ++corner) {
        const auto shift = [&](int k) { return (corner >> k & 1 ? 0.5 : -0.5) * edge; };
        const Octree::Node_index n = octree.leaf_at(
          {place.point[0] + shift(0), place.point[1] + shift(1), place.point[2] + shift(2)});
        if(octree.side(n) == ON_BOUNDARY && octree.edge_length(n) > (std::max)(edge, 2 * smallest))
          leaves.push_back(n);
      }
    }
    if(leaves.empty())
      return;
    std::sort(leaves.begin(), leaves.end());
    leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
    octree.refine(leaves);
  }
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_SHARP_CELLS_H
