// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points at the border of a surface that are the same point: at the same place, or nearly.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_WELD_POINTS_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_WELD_POINTS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/internal/surface/polygon_soup.h>
#include <CGAL/Mixed_mesh_3/internal/base/Disjoint_sets.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

// Points at edges of one face only, ascending. If a surface is closed as given, there are none, and points at
// the same place belong to sheets that touch.
inline std::vector<std::size_t> border_points(const Polygons& polygons, std::size_t number_of_points)
{
  std::vector<bool> is_at_border(number_of_points, false);
  for_each_edge(polygons, [&is_at_border](auto first, auto last) {
    if(last - first == 1)
      is_at_border[first->low()] = is_at_border[first->high()] = true;
  });
  std::vector<std::size_t> border;
  for(std::size_t v = 0; v < number_of_points; ++v)
    if(is_at_border[v])
      border.push_back(v);
  return border;
}

// Replaces each point by `first[point]`, which is not larger, and is its own; returns the number of removed
// points.
inline std::size_t merge_points(std::vector<std::size_t> first, Points& points, Polygons& polygons)
{
  std::size_t n = 0;
  for(std::size_t v = 0; v < points.size(); ++v) {
    if(first[v] == v) {
      points[n] = points[v];
      first[v] = n++;
    } else {
      first[v] = first[first[v]];
    }
  }
  const std::size_t merged = points.size() - n;
  points.erase(points.begin() + std::ptrdiff_t(n), points.end());
  for(auto& polygon : polygons)
    for(std::size_t& v : polygon)
      v = first[v];
  return merged;
}

// Merges points at the same place, of some that are given ascending; returns the number of removed points.
inline std::size_t merge_equal_points(const std::vector<std::size_t>& some, Points& points,
                                      Polygons& polygons)
{
  // Points with their first coordinate, by which most differ.
  std::vector<std::pair<double, std::uint32_t>> sorted;
  sorted.reserve(some.size());
  for(std::size_t v : some)
    sorted.emplace_back(points[v].x(), std::uint32_t(v));
  std::sort(sorted.begin(), sorted.end(), [&points](const auto& a, const auto& b) {
    if(a.first != b.first)
      return a.first < b.first;
    const auto &p = points[a.second], &q = points[b.second];
    return p != q ? p < q : a.second < b.second;
  });
  std::vector<std::size_t> first(points.size());
  std::iota(first.begin(), first.end(), std::size_t(0));
  for(std::size_t i = 1; i < sorted.size(); ++i)
    if(points[sorted[i].second] == points[sorted[i - 1].second])
      first[sorted[i].second] = first[sorted[i - 1].second];
  return merge_points(std::move(first), points, polygons);
}

// Calls `use(a, b)` for pairs of points at most that far apart, by a grid of cells of that width.
template <class Use>
void for_each_near_pair(const Points& points, const std::vector<std::size_t>& of, double distance,
                        const Use& use)
{
  using Cell = std::array<double, 3>; // whole numbers, however large
  std::vector<std::pair<Cell, std::size_t>> sorted;
  sorted.reserve(of.size());
  for(std::size_t v : of) {
    const Vec3 p = to_vec3(points[v]);
    sorted.push_back(
      {{std::floor(p[0] / distance), std::floor(p[1] / distance), std::floor(p[2] / distance)}, v});
  }
  std::sort(sorted.begin(), sorted.end());
  for(std::size_t i = 0; i < sorted.size(); ++i)
    for(int x = -1; x <= 1; ++x)
      for(int y = -1; y <= 1; ++y) { // columns of three cells
        const Cell& c = sorted[i].first;
        auto other = std::lower_bound(sorted.begin(), sorted.end(),
                                      std::pair<Cell, std::size_t>{{c[0] + x, c[1] + y, c[2] - 1}, 0});
        for(; other != sorted.end() && other->first <= Cell{c[0] + x, c[1] + y, c[2] + 1}; ++other)
          if(other->second < sorted[i].second
             && norm(to_vec3(points[other->second]) - to_vec3(points[sorted[i].second])) <= distance)
            use(other->second, sorted[i].second);
      }
}

// The largest power of two that divides a number: of several numbers that are equal up to rounding, the one
// with the largest divisor is probably exact.
inline double binary_divisor(double x)
{
  if(x == 0)
    return std::numeric_limits<double>::infinity();
  int exponent = 0;
  const auto digits = std::int64_t(std::ldexp(std::abs(std::frexp(x, &exponent)), 53));
  return std::ldexp(double(digits & -digits), exponent - 53);
}

// Makes coordinates equal that differ by at most that much: a plane at right angles to an axis stays a plane.
inline void align_coordinates(int axis, double distance, Points& points)
{
  std::vector<std::pair<double, std::size_t>> sorted;
  for(std::size_t v = 0; v < points.size(); ++v)
    sorted.emplace_back(points[v][axis], v);
  std::sort(sorted.begin(), sorted.end());
  for(auto first = sorted.begin(), last = first; first != sorted.end(); first = last) {
    double roundest = first->first;
    for(; last != sorted.end() && last->first - first->first <= distance; ++last)
      if(binary_divisor(last->first) > binary_divisor(roundest))
        roundest = last->first;
    for(auto i = first; i != last; ++i) {
      std::array<double, 3> p{points[i->second].x(), points[i->second].y(), points[i->second].z()};
      p[std::size_t(axis)] = roundest;
      points[i->second] = {p[0], p[1], p[2]};
    }
  }
}

struct Welding
{
  std::size_t number_of_points = 0; // removed points
  double distance = 0;              // largest distance of a removed point from the one that replaces it
};

// Merges border points that are connected by steps of at most that distance, and makes coordinates equal that
// differ by about as much as those of merged points.
inline Welding weld_border_points(double distance, Points& points, Polygons& polygons)
{
  Mixed_meshes_3::internal::Disjoint_sets sets(points.size());
  for_each_near_pair(points, border_points(polygons, points.size()), distance,
                     [&sets](std::size_t a, std::size_t b) { sets.unite(a, b); });
  std::vector<std::size_t> first = sets.least_of_all();
  Welding welding;
  Vec3 error{};
  for(std::size_t v = 0; v < points.size(); ++v) {
    const Vec3 d = to_vec3(points[v]) - to_vec3(points[first[v]]);
    welding.distance = (std::max)(welding.distance, norm(d));
    for(std::size_t k = 0; k < 3; ++k)
      error[k] = (std::max)(error[k], std::abs(d[k]));
  }
  // Before points are merged, as any of them may have the exact coordinate. An error is the difference of two
  // coordinates, of which neither may be at an end of the range.
  for(int k = 0; k < 3; ++k)
    if(error[std::size_t(k)] > 0)
      align_coordinates(k, (std::min)(2 * error[std::size_t(k)], distance), points);
  welding.number_of_points = merge_points(std::move(first), points, polygons);
  return welding;
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_WELD_POINTS_H
