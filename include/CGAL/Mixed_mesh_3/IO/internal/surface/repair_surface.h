// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Harmful defects of a surface: repaired, with a line that says so, or refused.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_REPAIR_SURFACE_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_REPAIR_SURFACE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/Read_surface_options.h>
#include <CGAL/Mixed_mesh_3/IO/Surface_input.h>
#include <CGAL/Mixed_mesh_3/IO/internal/errors.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/note_repair.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/polygon_soup.h>
#include <CGAL/Mixed_mesh_3/internal/repair/Solid_reading.h>
#include <CGAL/Mixed_mesh_3/internal/repair/fill_holes.h>
#include <CGAL/Mixed_mesh_3/internal/repair/wrap.h>

#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <locale>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

namespace repair = Mixed_meshes_3::internal;

/// A defect that ends a reading.
struct Surface_defect
{
  std::string text;
  double wrap_diameter = 0; ///< diameter with which a wrap is possible
  double weld_distance = 0; ///< distance at which welding closes the surface; 0: none
};

// Checks whether repairs are allowed; if not, the defect ends the reading.
inline void check_repair(const Read_surface_options& options, const Surface_defect& defect)
{
  if(options.is_strict)
    throw defect;
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

// Drops faces that stand out of a surface: components with a border, beside edges of more than two faces.
// Returns the number of dropped faces; 0 if they are more than a quarter of the area, or the surface has
// other borders.
inline std::size_t drop_protruding_faces(const Points& points, Polygons& polygons)
{
  // 0.1 and 0.5 read 315 surfaces, of CGAL's data and with defects made, alike.
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
    // Of 86 repairs, 2 have more that is inside out, and 16 less, but more than rounding.
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
  // Share of the area. With 0.98, a triangle of 1.2 % of the area that cuts a tetrahedron is no open sheet to
  // be dropped; 0.999 reads 315 surfaces, of CGAL's data and with defects made, as 0.99 does.
  constexpr double least_enclosed_share = 0.99;
  // Share of the area that is invented. Of 77 surfaces with holes made, 53 are filled, 24 of them with more
  // than 10 % of error in volume; with 0.1, 33 and 9; with 0.5, 74 and 42.
  constexpr double largest_share = 0.25;
  constexpr double margin = 1.1; // factor of the width that a wrap has to close
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

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_REPAIR_SURFACE_H
