// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surface of a solid, of the faces of a file: closed, not self-intersecting, oriented outwards.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_MAKE_SOLID_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_MAKE_SOLID_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/Read_surface_options.h>
#include <CGAL/Mixed_mesh_3/IO/Surface_input.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/orient_components.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/repair_surface.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/separate_bodies.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/surface_crossings.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/take_faces.h>
#include <CGAL/Mixed_mesh_3/internal/elements/is_polygon_mesh.h>

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <iterator>
#include <set>
#include <string>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

inline std::string describe_degenerate(std::size_t number, const std::string& place_of_first)
{
  return "has " + counted(number, "degenerate face", "degenerate faces")
         + " (three vertices on a line), the first near " + place_of_first;
}

inline std::string describe_nonmanifold(const std::string& what, std::size_t number_of_edges)
{
  return what + " is not a manifold: "
         + counted(number_of_edges, "edge has more than two faces", "edges have more than two faces");
}

// Removes triangles whose vertices are on a line; returns the defect if they could not be removed.
inline std::string remove_degenerate_faces(Surface& mesh, Surface_input& input)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  std::vector<Surface::Face_index> degenerate;
  PMP::degenerate_faces(mesh, std::back_inserter(degenerate));
  if(degenerate.empty())
    return "";
  if(degenerate.size() == faces(mesh).size())
    return "all its faces are degenerate";
  std::size_t n = degenerate.size();
  std::string place = place_of(degenerate.front(), mesh);
  bool is_intact = false;
  try {
    PMP::remove_degenerate_faces(mesh);
    is_intact = CGAL::is_valid_polygon_mesh(mesh) && CGAL::is_closed(mesh) && CGAL::is_triangle_mesh(mesh);
  } catch(const std::exception&) { // an assertion of CGAL
  }
  degenerate.clear();
  if(is_intact) {
    PMP::degenerate_faces(mesh, std::back_inserter(degenerate));
    if(!degenerate.empty()) {
      n = degenerate.size();
      place = place_of(degenerate.front(), mesh);
    }
  }
  if(!is_intact || !degenerate.empty())
    return describe_degenerate(n, place);
  input.warnings.push_back("removed " + counted(n, "degenerate face", "degenerate faces"));
  Surface compact; // without the places of removed faces
  CGAL::copy_face_graph(mesh, compact);
  clear(mesh);
  CGAL::copy_face_graph(compact, mesh);
  return "";
}

// Makes a mesh of faces that are closed, and a manifold except at points. Returns whether the faces can be
// oriented; if not, they stay as they are.
inline bool make_mesh(Points& points, Polygons& polygons, bool is_oriented, Surface& mesh,
                      Surface_input& input)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  using Mixed_meshes_3::internal::is_polygon_mesh;
  if(!is_polygon_mesh(polygons, points.size())) {
    // Pinched points are duplicated, and points of edges that have to be cut, as in a Moebius band.
    const std::size_t n = points.size();
    Points points_before = points;
    Polygons polygons_before = polygons;
    PMP::orient_polygon_soup(points, polygons);
    if(count_edges(polygons).open != 0 || !is_polygon_mesh(polygons, points.size())) {
      points = std::move(points_before);
      polygons = std::move(polygons_before);
      return false;
    }
    if(!is_oriented)
      input.warnings.push_back("oriented the faces consistently");
    const std::set<Surface::Point> pinched(points.begin() + std::ptrdiff_t(n), points.end());
    if(!pinched.empty())
      input.warnings.push_back("the surface is pinched at " + counted(pinched.size(), "point", "points"));
  }
  clear(mesh);
  mesh.reserve(std::uint32_t(points.size()), std::uint32_t(3 * polygons.size() / 2),
               std::uint32_t(polygons.size()));
  PMP::polygon_soup_to_polygon_mesh(points, polygons, mesh);
  return true;
}

inline bool triangulate(const Polygons& polygons, Surface& mesh, Surface_input& input)
{
  if(CGAL::is_triangle_mesh(mesh))
    return true;
  const std::size_t n = std::size_t(
    std::count_if(polygons.begin(), polygons.end(), [](const auto& p) { return p.size() > 3; }));
  if(!CGAL::Polygon_mesh_processing::triangulate_faces(mesh))
    return false;
  input.warnings.push_back("triangulated " + counted(n, "polygon", "polygons"));
  return true;
}

// Closes the faces, and gives bodies that touch along edges their own vertices; what is not a manifold then
// becomes the boundary of a solid.
inline Edge_counts make_closed_manifold(const Read_surface_options& options, Points& points,
                                        Polygons& polygons, Surface_input& input)
{
  Edge_counts edges = count_edges(polygons);
  if(edges.open != 0) {
    const std::size_t open = edges.open;
    try {
      close(options, points, polygons, input);
    } catch(Surface_defect& defect) {
      defect.weld_distance = closing_weld_distance(options.weld_distance, points, polygons);
      throw;
    }
    edges = count_edges(polygons);
    if(edges.open != 0)
      throw Surface_defect{not_closed(open), wrap_diameter_for(points)};
  }
  const std::size_t nonmanifold = edges.nonmanifold;
  if(nonmanifold == 0)
    return edges;
  separate_bodies(points, polygons);
  edges = count_edges(polygons);
  if(edges.nonmanifold == 0) {
    input.warnings.push_back("bodies touch along " + counted(nonmanifold, "edge", "edges"));
    return edges;
  }
  bound(options, describe_nonmanifold("the surface", nonmanifold), points, polygons, input);
  return count_edges(polygons);
}

// The faces of a mesh as polygons.
inline void set_polygons(const Surface& mesh, Points& points, Polygons& polygons)
{
  points.assign(mesh.points().begin(), mesh.points().end());
  polygons.clear();
  for(const auto face : faces(mesh)) {
    const Triangle_view t(face, mesh);
    polygons.push_back({t.vertices[0], t.vertices[1], t.vertices[2]});
  }
}

// Faces that cut each other, and the defect in words; there may be a defect without such faces.
struct Mesh_defect
{
  std::string text;
  std::vector<Face_pair> crossings;
};

// Removes degenerate faces, and finds a defect that is left.
inline Mesh_defect find_mesh_defect(Surface& mesh, Surface_input& input)
{
  Mesh_defect defect{remove_degenerate_faces(mesh, input), {}};
  if(!defect.text.empty())
    return defect;
  defect.crossings = self_intersections(mesh);
  if(!defect.crossings.empty()) {
    defect.text = describe(defect.crossings, mesh);
    return defect;
  }
  defect.crossings = crossings_at_edges(mesh);
  if(!defect.crossings.empty())
    defect.text = "the surface crosses itself along an edge near "
                  + place_of(defect.crossings.front().first, mesh);
  return defect;
}

// Makes a mesh of the faces: closed, without self-intersections, oriented outwards.
inline Component_counts make_solid(const Read_surface_options& options, Points points, Polygons polygons,
                                   Surface& mesh, Surface_input& input)
{
  const bool is_oriented = make_closed_manifold(options, points, polygons, input).is_oriented;
  if(!make_mesh(points, polygons, is_oriented, mesh, input)) {
    bound(options, "the surface cannot be oriented", points, polygons, input);
    if(!make_mesh(points, polygons, true, mesh, input))
      throw Surface_defect{"the faces do not form a surface"};
  }
  if(!triangulate(polygons, mesh, input))
    throw Surface_defect{"its polygons cannot be triangulated"};
  points = Points(); // the mesh has them
  polygons = Polygons();

  // Rounding the points where faces cut each other may make other faces cut. Of 262 surfaces that are read,
  // of CGAL's data and with defects made, 83 need one pass, one needs two, and one needs three.
  constexpr int most_passes = 5;
  for(int pass = 0;; ++pass) {
    const Mesh_defect defect = find_mesh_defect(mesh, input);
    if(defect.text.empty())
      return orient_components(mesh);
    if(pass == most_passes)
      throw Surface_defect{defect.text};
    if(pass == 0)
      orient_components(mesh, defect.crossings);
    set_polygons(mesh, points, polygons);
    bound(options, pass == 0 ? defect.text : "", points, polygons, input);
    if(!make_mesh(points, polygons, true, mesh, input))
      throw Surface_defect{defect.text};
  }
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_MAKE_SOLID_H
