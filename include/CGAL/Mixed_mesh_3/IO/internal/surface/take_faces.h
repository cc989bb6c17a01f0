// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The faces of a file: indices and coordinates checked, without superfluous points and polygons.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_TAKE_FACES_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_TAKE_FACES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/internal/surface/Surface_soup.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/note_repair.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/polygon_soup.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/weld_points.h>
#include <CGAL/Mixed_mesh_3/IO/Read_surface_options.h>
#include <CGAL/Mixed_mesh_3/IO/Surface_input.h>
#include <CGAL/Mixed_mesh_3/IO/internal/errors.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

// Checks indices, then numbers: a file may have any content.
inline void check_indices(const std::string& path, const Surface_soup& soup)
{
  constexpr std::size_t most_points = std::size_t(1) << 31;
  if(soup.points.empty() || soup.polygons.empty())
    refuse(path, "has no faces");
  if(soup.points.size() >= most_points)
    refuse(path, "has 2^31 points or more");
  for(std::size_t i = 0; i < soup.polygons.size(); ++i) {
    if(soup.polygons[i].size() < 3)
      refuse(path, "face " + std::to_string(i) + " has fewer than three vertices");
    for(std::size_t v : soup.polygons[i])
      if(v >= soup.points.size())
        refuse(path, "face " + std::to_string(i) + " has a vertex that does not exist");
  }
}

// Refuses coordinates for which volumes and squared volumes of cells 2^20 times smaller over- or underflow.
// Tiny coordinates beside ordinary ones are zeros with an error: they become zero, or products of them would
// underflow in predicates, and their inverses be infinite.
inline void check_coordinates(const std::string& path, Surface_soup& soup)
{
  double largest = 0, extent = 0;
  for(int k = 0; k < 3; ++k) {
    double lower = std::numeric_limits<double>::infinity(), upper = -lower;
    for(std::size_t i = 0; i < soup.points.size(); ++i) {
      const double x = soup.points[i][k];
      if(!std::isfinite(x))
        refuse(path, not_finite(i));
      largest = (std::max)(largest, std::abs(x));
      lower = (std::min)(lower, x);
      upper = (std::max)(upper, x);
    }
    extent = (std::max)(extent, upper - lower);
  }
  if(largest > 1e90)
    refuse(path, "coordinates up to " + number_text(largest) + " overflow");
  if(extent < 1e-40)
    refuse(path, "its extent is zero or underflows");
  if(extent < largest * 1e-9)
    refuse(path, "it is so small, and so far from the origin, that its coordinates have no digits left");
  const double smallest = std::ldexp(extent, -60);
  for(Vec3& p : soup.points)
    for(double& x : p)
      if(std::abs(x) < smallest)
        x = 0;
}

// Removes polygons that have the same vertices as another one in the same order, forwards or backwards,
// except the first of them; returns their number. CGAL's function compares points, and asserts that points of
// a polygon differ.
inline std::size_t remove_repeated(Polygons& polygons)
{
  std::vector<std::size_t> p;
  const auto normalized = [&p](const std::vector<std::size_t>& polygon) -> const std::vector<std::size_t>& {
    p.assign(polygon.begin(), polygon.end());
    std::rotate(p.begin(), std::min_element(p.begin(), p.end()), p.end());
    if(p[1] > p.back())
      std::reverse(p.begin() + 1, p.end());
    return p;
  };
  // The first three vertices, by which nearly all polygons differ, and the polygon.
  std::vector<std::array<std::size_t, 4>> keys;
  keys.reserve(polygons.size());
  for(std::size_t f = 0; f < polygons.size(); ++f) {
    const std::vector<std::size_t>& first = normalized(polygons[f]);
    keys.push_back({first[0], first[1], first[2], f});
  }
  std::sort(keys.begin(), keys.end());
  std::size_t number = 0;
  for(auto first = keys.begin(), last = first; first != keys.end(); first = last) {
    while(last != keys.end() && std::equal(first->begin(), first->begin() + 3, last->begin()))
      ++last;
    std::set<std::vector<std::size_t>> met;
    for(auto key = first; last - first > 1 && key != last; ++key)
      if(std::vector<std::size_t>& polygon = polygons[(*key)[3]]; !met.insert(normalized(polygon)).second) {
        polygon.clear();
        ++number;
      }
  }
  polygons.erase(std::remove_if(polygons.begin(), polygons.end(), [](const auto& p) { return p.empty(); }),
                 polygons.end());
  return number;
}

// Numbers of polygons with a vertex twice, of repeated polygons, and of unused points, which are removed.
struct Superfluous
{
  std::size_t degenerate = 0, repeated = 0, unused = 0;

  void remove(Points& points, Polygons& polygons)
  {
    const std::size_t before = polygons.size();
    std::vector<std::size_t> p;
    polygons.erase(std::remove_if(polygons.begin(), polygons.end(),
                                  [&p](const std::vector<std::size_t>& polygon) {
                                    p.assign(polygon.begin(), polygon.end());
                                    std::sort(p.begin(), p.end());
                                    return std::adjacent_find(p.begin(), p.end()) != p.end();
                                  }),
                   polygons.end());
    degenerate += before - polygons.size();
    repeated += remove_repeated(polygons);
    unused += CGAL::Polygon_mesh_processing::remove_isolated_points_in_polygon_soup(points, polygons);
  }

  void warn(Surface_input& input) const
  {
    if(degenerate != 0)
      input.warnings.push_back("dropped " + counted(degenerate, "degenerate face", "degenerate faces"));
    if(repeated != 0)
      input.warnings.push_back("merged " + counted(repeated, "duplicate face", "duplicate faces"));
    if(unused != 0)
      input.warnings.push_back("ignored " + counted(unused, "unused point", "unused points"));
  }
};

inline double diagonal_of(const Points& points)
{
  const Bbox_3 b = CGAL::bbox_3(points.begin(), points.end());
  return norm(Vec3{b.x_span(), b.y_span(), b.z_span()});
}

// Largest distance of points that are the same point, as a share of the diagonal: some ten times the last
// digit of a float.
constexpr double rounding_of_points = 1e-6;

// Welds points at borders if fewer edges are open then, and no more than before have several faces.
// \param distance largest distance of points that are the same point; 0: as float numbers differ by rounding
inline void weld(double distance, Points& points, Polygons& polygons, Superfluous& superfluous,
                 Surface_input& input)
{
  if(!(distance > 0))
    distance = rounding_of_points * diagonal_of(points);
  Points welded_points = points;
  Polygons welded = polygons;
  const Welding welding = weld_border_points(distance, welded_points, welded);
  if(welding.number_of_points == 0)
    return;
  Superfluous more = superfluous;
  more.remove(welded_points, welded);
  const Edge_counts before = count_edges(polygons), after = count_edges(welded);
  if(welded.empty() || after.open >= before.open || after.nonmanifold > before.nonmanifold)
    return;
  points = std::move(welded_points);
  polygons = std::move(welded);
  superfluous = more;
  note_repair("welded " + counted(welding.number_of_points, "point", "points") + " to others, up to "
                + number_text(welding.distance) + " away",
              input);
}

// The least of the distances ..., 1, 2, 5, 10, ... at which welding closes a surface, by pairs of points and
// not by chains, which would close a hole by pulling its border together; 0 if there is none up to a
// hundredth of the diagonal.
// \param least distance at which welding did not close the surface; 0: as for weld()
inline double closing_weld_distance(double least, const Points& points, const Polygons& polygons)
{
  constexpr double largest_share = 0.01;
  const double diagonal = diagonal_of(points);
  if(!(least > 0))
    least = rounding_of_points * diagonal;
  const std::size_t nonmanifold = count_edges(polygons).nonmanifold;
  double longest = 0; // a chain: at a distance below half of it, it still is one
  for(int exponent = int(std::floor(std::log10(least)));; ++exponent)
    for(const double digit : {1., 2., 5.}) {
      const double distance = digit * std::pow(10., exponent);
      if(distance > largest_share * diagonal)
        return 0;
      if(distance <= least || distance < longest / 2)
        continue;
      Points welded_points = points;
      Polygons welded = polygons;
      const Welding welding = weld_border_points(distance, welded_points, welded);
      longest = welding.distance;
      if(welding.number_of_points == 0 || longest > distance)
        continue;
      Superfluous().remove(welded_points, welded);
      const Edge_counts edges = count_edges(welded);
      if(!welded.empty() && edges.open == 0 && edges.nonmanifold <= nonmanifold)
        return distance;
    }
}

// Takes the faces of a soup, without superfluous ones. What is not closed is welded; if strict, only if the
// distance is given.
inline void take_faces(const std::string& path, const Read_surface_options& options, Surface_soup soup,
                       Points& points, Polygons& polygons, Surface_input& input)
{
  check_indices(path, soup);
  check_coordinates(path, soup);
  points.reserve(soup.points.size());
  for(const Vec3& p : soup.points)
    points.emplace_back(p[0], p[1], p[2]);
  soup.points = {};
  polygons = std::move(soup.polygons);
  input.warnings = std::move(soup.warnings);
  input.number_of_points = points.size();
  input.number_of_polygons = polygons.size();

  Superfluous superfluous;
  if(!soup.repeats_points)
    superfluous.remove(points, polygons); // edges of a face that is there twice look closed
  if(soup.repeats_points || count_edges(polygons).open != 0) {
    std::vector<std::size_t> open(points.size()); // points of open edges: all, if each face has its own
    if(soup.repeats_points)
      std::iota(open.begin(), open.end(), std::size_t(0));
    else
      open = border_points(polygons, points.size());
    const std::size_t merged = merge_equal_points(open, points, polygons);
    if(merged != 0 && !soup.repeats_points)
      input.warnings.push_back("merged " + counted(merged, "duplicate point", "duplicate points"));
    if(merged != 0)
      superfluous.remove(points, polygons);
    if(count_edges(polygons).open != 0 && (!options.is_strict || options.weld_distance > 0))
      weld(options.weld_distance, points, polygons, superfluous, input);
  }
  superfluous.warn(input);
  if(polygons.empty())
    refuse(path, "all its faces are degenerate");
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_TAKE_FACES_H
