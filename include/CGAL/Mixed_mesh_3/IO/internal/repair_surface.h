// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Harmful defects of a surface: repaired, with a line that says so, or refused.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_REPAIR_SURFACE_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_REPAIR_SURFACE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/Read_surface_options.h>
#include <CGAL/Mixed_mesh_3/IO/Surface_input.h>
#include <CGAL/Mixed_mesh_3/IO/internal/errors.h>
#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/repair/Solid_reading.h>
#include <CGAL/Mixed_mesh_3/internal/repair/fill_holes.h>
#include <CGAL/Mixed_mesh_3/internal/repair/wrap.h>

#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <iterator>
#include <locale>
#include <map>
#include <numeric>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

namespace repair = Mixed_meshes_3::internal;

using Points = std::vector<Predicates_kernel::Point_3>;
using Polygons = std::vector<std::vector<std::size_t>>;
using Triangles = std::vector<std::array<std::size_t, 3>>;

inline std::string counted(std::size_t n, const char* one, const char* many)
{
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

struct Edge_counts
{
  std::size_t open = 0, nonmanifold = 0; // edges with one face, and with more than two
  bool is_oriented = true;               // no edge occurs twice in the same direction
};

inline Edge_counts count_edges(const std::vector<std::vector<std::size_t>>& polygons)
{
  struct Edge
  {
    std::size_t low, high;
    bool is_upwards;
    bool operator<(const Edge& e) const { return low != e.low ? low < e.low : high < e.high; }
  };
  std::vector<Edge> edges;
  for(const auto& polygon : polygons)
    for(std::size_t i = 0; i < polygon.size(); ++i) {
      const std::size_t a = polygon[i], b = polygon[(i + 1) % polygon.size()];
      edges.push_back({(std::min)(a, b), (std::max)(a, b), a < b});
    }
  std::sort(edges.begin(), edges.end());
  Edge_counts counts;
  for(auto first = edges.begin(), last = first; first != edges.end(); first = last) {
    last = std::upper_bound(first, edges.end(), *first);
    counts.open += last - first == 1;
    counts.nonmanifold += last - first > 2;
    if(last - first == 2 && first[0].is_upwards == first[1].is_upwards)
      counts.is_oriented = false;
  }
  return counts;
}

// "1.25e+200"
inline std::string number_text(double x)
{
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(7);
  out << x;
  return out.str();
}

// "(1, 2, 3)"
inline std::string place_text(const Predicates_kernel::Point_3& point)
{
  const Vec3 p = to_vec3(point);
  return "(" + number_text(p[0]) + ", " + number_text(p[1]) + ", " + number_text(p[2]) + ")";
}

/// A defect that ends a reading.
struct Surface_defect
{
  std::string text;
  double wrap_diameter = 0; ///< diameter with which a wrap is possible
};

// Checks whether repairs are allowed; if not, the defect ends the reading.
inline void check_repair(const Read_surface_options& options, const Surface_defect& defect)
{
  if(options.is_strict)
    throw defect;
}

inline void note_repair(const std::string& text, Surface_input& input)
{
  input.warnings.push_back(text);
  input.repairs.push_back(text);
}

// Triangulates polygons such that the area is small, if a polygon is not convex.
inline Triangles triangulated(const Points& points, const Polygons& polygons)
{
  Triangles triangles;
  for(const auto& polygon : polygons) {
    std::vector<CGAL::Triple<int, int, int>> found;
    if(polygon.size() > 3) {
      Points corners;
      for(std::size_t v : polygon)
        corners.push_back(points[v]);
      try {
        CGAL::Polygon_mesh_processing::triangulate_hole_polyline(corners, std::back_inserter(found));
      } catch(const std::exception&) { // an assertion of CGAL
        found.clear();
      }
    }
    for(const auto& t : found)
      triangles.push_back(
        {polygon[std::size_t(t.first)], polygon[std::size_t(t.second)], polygon[std::size_t(t.third)]});
    for(std::size_t i = 2; found.empty() && i < polygon.size(); ++i)
      triangles.push_back({polygon[0], polygon[i - 1], polygon[i]});
  }
  return triangles;
}

inline void set_triangles(Points triangle_points, const Triangles& triangles, Points& points,
                          Polygons& polygons)
{
  points = std::move(triangle_points);
  polygons.clear();
  for(const auto& t : triangles)
    polygons.emplace_back(t.begin(), t.end());
}

inline double area(const Points& points, const Triangles& triangles)
{
  double sum = 0;
  for(const auto& t : triangles) {
    const Vec3 a = to_vec3(points[t[0]]);
    sum += norm(cross(to_vec3(points[t[1]]) - a, to_vec3(points[t[2]]) - a)) / 2;
  }
  return sum;
}

inline double volume(const Points& points, const Triangles& triangles)
{
  double sum = 0;
  const Vec3 origin = to_vec3(points.front());
  for(const auto& t : triangles)
    sum += determinant(to_vec3(points[t[0]]) - origin, to_vec3(points[t[1]]) - origin,
                       to_vec3(points[t[2]]) - origin)
           / 6;
  return sum;
}

inline std::string percent(double share)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(2);
  text << 100 * share << " %";
  return text.str();
}

// The diameter of a wrap if nothing else is known: a fiftieth of the diagonal.
inline double wrap_diameter_for(const Points& points)
{
  const Bbox_3 b = CGAL::bbox_3(points.begin(), points.end());
  return std::sqrt(b.x_span() * b.x_span() + b.y_span() * b.y_span() + b.z_span() * b.z_span()) / 50;
}

inline repair::Solid_reading read_solid_or_refuse(const std::string& defect, const Points& points,
                                                  const Triangles& triangles)
{
  repair::Solid_reading reading = repair::read_solid(points, triangles);
  if(!reading.is_complete)
    throw Surface_defect{defect + "; too often for a repair", wrap_diameter_for(points)};
  return reading;
}

// Undirected edges of polygons, with the polygons at each edge.
using Edge_polygons = std::map<std::array<std::size_t, 2>, std::vector<std::size_t>>;

inline Edge_polygons edges_of(const Polygons& polygons)
{
  Edge_polygons edges;
  for(std::size_t f = 0; f < polygons.size(); ++f)
    for(std::size_t i = 0; i < polygons[f].size(); ++i) {
      const auto [a, b] = std::minmax(polygons[f][i], polygons[f][(i + 1) % polygons[f].size()]);
      edges[{a, b}].push_back(f);
    }
  return edges;
}

// Numbers the components of polygons connected by edges of at most `most` polygons; returns their number.
inline std::size_t find_parts(const Polygons& polygons, const Edge_polygons& edges, std::size_t most,
                              std::vector<std::size_t>& part)
{
  part.resize(polygons.size());
  std::iota(part.begin(), part.end(), std::size_t(0));
  const auto root = [&part](std::size_t f) {
    while(part[f] != f)
      f = part[f] = part[part[f]];
    return f;
  };
  for(const auto& [edge, around] : edges)
    for(std::size_t i = 1; i < around.size() && around.size() <= most; ++i) {
      const auto [low, high] = std::minmax({root(around[0]), root(around[i])});
      part[high] = low; // roots are the smallest
    }
  std::size_t n = 0;
  for(std::size_t f = 0; f < polygons.size(); ++f)
    part[f] = part[f] == f ? n++ : part[part[f]];
  return n;
}

inline std::vector<Polygons> parts_of(const Polygons& polygons)
{
  std::vector<std::size_t> part;
  const std::size_t all = std::size_t(-1);
  std::vector<Polygons> parts(find_parts(polygons, edges_of(polygons), all, part));
  for(std::size_t f = 0; f < polygons.size(); ++f)
    parts[part[f]].push_back(polygons[f]);
  return parts;
}

// Drops faces that stand out of a surface: components with a border, beside edges of more than two faces.
// Returns the number of dropped faces; 0 if they are more than a quarter of the area, or the surface has
// other borders.
inline std::size_t drop_protruding_faces(const Points& points, Polygons& polygons)
{
  constexpr double largest_share = 0.25;
  const Edge_polygons edges = edges_of(polygons);
  std::vector<std::size_t> part;
  const std::size_t n = find_parts(polygons, edges, 2, part);
  std::vector<char> has_border(n, 0), is_beside(n, 0);
  for(const auto& [edge, around] : edges)
    for(std::size_t f : around) {
      has_border[part[f]] |= char(around.size() == 1);
      is_beside[part[f]] |= char(around.size() > 2);
    }
  Polygons kept;
  for(std::size_t f = 0; f < polygons.size(); ++f)
    if(!has_border[part[f]] || !is_beside[part[f]])
      kept.push_back(polygons[f]);
  const std::size_t dropped = polygons.size() - kept.size();
  if(dropped == 0 || kept.empty() || count_edges(kept).open != 0
     || area(points, triangulated(points, kept))
          < (1 - largest_share) * area(points, triangulated(points, polygons)))
    return 0;
  polygons = std::move(kept);
  return dropped;
}

// Replaces components of a surface that are not oriented manifolds, or cut themselves, by the boundary of the
// solid that they enclose. Without a defect, the repair goes on without a message.
inline void bound(const Read_surface_options& options, const std::string& defect, Points& points,
                  Polygons& polygons, Surface_input& input)
{
  if(!defect.empty())
    check_repair(options, {defect});
  repair::Solid_reading all;
  double volume_of_all = 0;
  const bool is_manifold = count_edges(polygons).nonmanifold == 0; // components may cut each other
  for(const Polygons& part : is_manifold ? std::vector<Polygons>{polygons} : parts_of(polygons)) {
    repair::Solid_reading reading;
    const Edge_counts edges = count_edges(part);
    if(is_manifold || edges.nonmanifold != 0)
      reading = read_solid_or_refuse(defect, points, triangulated(points, part));
    else
      reading.points = points, reading.triangles = triangulated(points, part);
    if(reading.triangles.empty())
      continue;
    volume_of_all += volume(reading.points, reading.triangles);
    all.inverted_volume += reading.inverted_volume;
    for(auto t : reading.triangles) {
      for(std::size_t& v : t)
        v += all.points.size();
      all.triangles.push_back(t);
    }
    all.points.insert(all.points.end(), reading.points.begin(), reading.points.end());
  }
  if(all.triangles.empty())
    throw Surface_defect{defect.empty() ? "the surface encloses no volume"
                                        : defect + "; it encloses no volume"};
  if(!defect.empty()) {
    constexpr double negligible_share = 1e-3;
    const double inverted = all.inverted_volume / (volume_of_all + all.inverted_volume);
    note_repair(defect + ": read as the solid that it encloses"
                  + (inverted > negligible_share ? ", without " + percent(inverted) + " that are inside out"
                                                 : ""),
                input);
  }
  set_triangles(std::move(all.points), all.triangles, points, polygons);
  CGAL::Polygon_mesh_processing::remove_isolated_points_in_polygon_soup(points, polygons);
}

inline std::string describe(const repair::Surface_hole& hole, const Points& points)
{
  return "length " + number_text(hole.length) + " near " + place_text(points[hole.place()]);
}

inline std::string not_closed(std::size_t border_edges)
{
  return "the surface is not closed: " + counted(border_edges, "border edge", "border edges");
}

// Closes a surface with border edges.
inline void close(const Read_surface_options& options, Points& points, Polygons& polygons,
                  Surface_input& input)
{
  constexpr double least_enclosed_share = 0.99; // share of the area
  constexpr double largest_share = 0.25;        // share of the area that is invented
  constexpr double margin = 1.1;                // factor of the width that a wrap has to close
  const Edge_counts edges = count_edges(polygons);
  const std::string defect = not_closed(edges.open);
  if(edges.nonmanifold != 0) {
    Polygons rest = polygons;
    const std::size_t dropped = drop_protruding_faces(points, rest);
    if(dropped != 0) {
      check_repair(options, {defect, wrap_diameter_for(points)});
      note_repair("dropped " + counted(dropped, "face that stands", "faces that stand") + " out", input);
      polygons = std::move(rest);
      CGAL::Polygon_mesh_processing::remove_isolated_points_in_polygon_soup(points, polygons);
      return;
    }
  }
  Triangles triangles = triangulated(points, polygons);
  {
    // Faces may meet without equal edges.
    repair::Solid_reading reading = read_solid_or_refuse(defect, points, triangles);
    if(area(reading.points, reading.triangles) > least_enclosed_share * area(points, triangles)) {
      check_repair(options, {defect, wrap_diameter_for(points)});
      note_repair(defect + ", which lie on others: read as the solid that it encloses", input);
      set_triangles(std::move(reading.points), reading.triangles, points, polygons);
      return;
    }
  }
  Points closed = points;
  const repair::Hole_filling holes = repair::fill_holes(closed, triangles, largest_share);
  if(!holes.left.empty()) {
    const repair::Surface_hole& widest = *std::max_element(holes.left.begin(), holes.left.end(),
                                                           [](const auto& g, const auto& h) {
                                                             return g.width < h.width;
                                                           });
    const double width = widest.width > 0 ? margin * widest.width : wrap_diameter_for(points);
    throw Surface_defect{defect + ", and " + counted(holes.left.size(), "hole", "holes")
                           + " too large to be filled, the largest of "
                           + describe(holes.left.front(), closed),
                         width};
  }
  double width = wrap_diameter_for(points);
  for(const repair::Surface_hole& hole : holes.filled)
    width = (std::max)(width, margin * hole.width);
  check_repair(options, {defect, width});
  if(triangles.empty())
    throw Surface_defect{defect, width};
  if(!holes.filled.empty())
    note_repair("filled " + counted(holes.filled.size(), "hole", "holes") + ", the largest of "
                  + describe(holes.filled.front(), closed),
                input);
  if(holes.number_of_dropped_faces != 0)
    note_repair("dropped " + counted(holes.number_of_dropped_faces, "face", "faces") + " of open sheets, "
                  + percent(holes.share_of_dropped_area) + " of the area",
                input);
  set_triangles(std::move(closed), triangles, points, polygons);
  CGAL::Polygon_mesh_processing::remove_isolated_points_in_polygon_soup(points, polygons);
}

// Replaces a surface by its wrap.
inline void wrap_faces(const std::string& path, double diameter, Points& points, Polygons& polygons)
{
  // The number of triangles is about what smaller details need; a wrap of 10^6 takes a minute.
  constexpr double most = 1e6;
  Triangles triangles = triangulated(points, polygons);
  const double number = 10 * area(points, triangles) / (diameter * diameter);
  if(number > most)
    refuse(path, "a wrap of " + number_text(diameter) + " would take more than a million triangles; "
                   + number_text(diameter * std::sqrt(number / most)) + " takes about a million");
  repair::wrap(diameter, points, triangles);
  if(triangles.empty())
    refuse(path, "nothing is left of it in a wrap of " + number_text(diameter));
  Points wrapped = points;
  set_triangles(std::move(wrapped), triangles, points, polygons);
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_REPAIR_SURFACE_H
