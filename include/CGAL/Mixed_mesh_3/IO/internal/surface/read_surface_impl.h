// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Implementation of `read_closed_surface()` and `read_sheet()`.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_READ_SURFACE_IMPL_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_READ_SURFACE_IMPL_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/drop_components.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/make_solid.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/read_surface_file.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/repair_surface.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/take_faces.h>
#include <CGAL/Mixed_mesh_3/internal/base/compiled.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/is_polygon_mesh.h>

#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>
#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

// Whether all points are in one plane, up to rounding.
inline bool is_flat(const std::vector<Surface::Point>& points)
{
  // The directions lead from the first point to the farthest, then away from that line, then from the plane.
  const Vec3 origin = to_vec3(points.front());
  Vec3 along{}, across{};
  double extent = 0, width = 0, height = 0;
  for(const Surface::Point& p : points)
    if(norm(to_vec3(p) - origin) > extent) {
      along = to_vec3(p) - origin;
      extent = norm(along);
    }
  along = 1 / extent * along;
  for(const Surface::Point& p : points)
    if(norm(cross(along, to_vec3(p) - origin)) > width) {
      across = cross(along, to_vec3(p) - origin);
      width = norm(across);
    }
  for(const Surface::Point& p : points)
    height = (std::max)(height, std::abs(dot(across, to_vec3(p) - origin)) / (width > 0 ? width : 1));
  // The tolerance is 900 times 2^-53, the rounding of coordinates: points of a plane are flat although the
  // plane is oblique, and as far from the origin as some hundred times its extent.
  constexpr double tolerance = 1e-13;
  return height <= tolerance * extent;
}

CGAL_MIXED_MESH_3_INLINE void make_surface(const std::string& name, const Read_surface_options& options,
                                           Surface_soup soup, Surface& mesh, Surface_input& input)
{
  Points points;
  Polygons polygons;
  take_faces(name, options, std::move(soup), points, polygons, input);
  if(is_flat(points))
    refuse(name, "the surface is flat: it encloses no volume");

  const Bbox_3 b = CGAL::bbox_3(points.begin(), points.end());
  const double box = b.x_span() * b.y_span() * b.z_span();
  Component_counts components;
  if(options.wrap_diameter > 0) {
    wrap_faces(name, options.wrap_diameter, points, polygons);
    make_mesh(points, polygons, true, mesh, input);
    components = orient_components(mesh);
    note_repair("wrapped it, closing what is narrower than " + number_text(options.wrap_diameter), input);
  } else {
    try {
      components = make_solid(options, std::move(points), std::move(polygons), mesh, input);
    } catch(const Surface_defect& defect) {
      input.wrap_diameter = defect.wrap_diameter;
      input.weld_distance = defect.weld_distance;
      refuse(name, defect.text);
    }
  }
  if(options.keep_largest || options.least_volume > 0)
    components = drop_components(name, options, components, mesh, input);
  input.number_of_components = components.all;
  if(components.all > 1)
    input.warnings.push_back("has " + std::to_string(components.all) + " components"
                             + (components.cavities == 0
                                  ? ""
                                  : ", " + std::to_string(components.cavities) + " of them inside another: "
                                      + (components.cavities == 1 ? "a cavity" : "cavities")));
  else if(components.reversed == 1)
    input.warnings.push_back("turned the surface inside out: it was oriented inwards");
  input.volume = enclosed_volume(mesh);
  if(!(input.volume > 1e-12 * box))
    refuse(name, "the surface encloses no volume");
}

CGAL_MIXED_MESH_3_INLINE void make_sheet(const std::string& name, const Read_surface_options& options,
                                         Surface_soup soup, Surface& mesh, Surface_input& input)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  Points points;
  Polygons polygons;
  take_faces(name, options, std::move(soup), points, polygons, input);
  const Edge_counts edges = count_edges(polygons);
  if(edges.nonmanifold != 0)
    refuse(name, describe_nonmanifold("the sheet", edges.nonmanifold));
  if(!Mixed_meshes_3::internal::is_polygon_mesh(polygons, points.size())) {
    PMP::orient_polygon_soup(points, polygons); // duplicates points, as for make_mesh()
    if(count_edges(polygons).open != edges.open)
      refuse(name, "the sheet cannot be oriented");
    if(!Mixed_meshes_3::internal::is_polygon_mesh(polygons, points.size()))
      refuse(name, "the faces do not form a surface");
    if(!edges.is_oriented)
      input.warnings.push_back("oriented the faces consistently");
  }
  clear(mesh);
  PMP::polygon_soup_to_polygon_mesh(points, polygons, mesh);
  if(!triangulate(polygons, mesh, input))
    refuse(name, "its polygons cannot be triangulated");
  std::vector<Surface::Face_index> degenerate;
  PMP::degenerate_faces(mesh, std::back_inserter(degenerate));
  if(!degenerate.empty())
    refuse(name, describe_degenerate(degenerate.size(), place_of(degenerate.front(), mesh)));
  const std::vector<Face_pair> crossings = self_intersections(mesh);
  if(!crossings.empty())
    refuse(name, describe(crossings, mesh));
  input.number_of_components = PMP::connected_components(mesh,
                                                         get(CGAL::dynamic_face_property_t<std::size_t>(),
                                                             mesh));
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_READ_SURFACE_IMPL_H
