// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_READ_CLOSED_SURFACE_H
#define CGAL_MIXED_MESH_3_IO_READ_CLOSED_SURFACE_H

#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

/// What a surface file held, and what had to be mended.
struct Surface_input
{
  std::size_t number_of_points = 0, number_of_polygons = 0; ///< in the file
  std::size_t number_of_components = 0;
  double volume = 0;                                        ///< enclosed, in the cube of the unit
  std::vector<std::string> warnings;                        ///< a line each, without the file's name
};

namespace internal {

[[noreturn]] inline void refuse(const std::string& path, const std::string& defect)
{
  throw std::runtime_error(path + ": " + defect);
}

inline std::string counted(std::size_t n, const char* one, const char* many)
{
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

using Soup_edges = std::vector<std::pair<std::size_t, std::size_t>>;

// Undirected edges, sorted.
inline Soup_edges edges_of(const std::vector<std::vector<std::size_t>>& polygons)
{
  Soup_edges edges;
  for(const auto& polygon : polygons)
    for(std::size_t i = 0; i < polygon.size(); ++i) {
      const std::size_t a = polygon[i], b = polygon[(i + 1) % polygon.size()];
      edges.emplace_back((std::min)(a, b), (std::max)(a, b));
    }
  std::sort(edges.begin(), edges.end());
  return edges;
}

// What stands in a file may be anything: numbers first, then topology.
template <class Point>
void check_soup(const std::string& path, const std::vector<Point>& points,
                const std::vector<std::vector<std::size_t>>& polygons)
{
  if(points.empty() || polygons.empty())
    refuse(path, "has no faces");
  double largest = 0;
  std::array<double, 3> lower, upper;
  lower.fill(std::numeric_limits<double>::infinity());
  upper.fill(-std::numeric_limits<double>::infinity());
  for(std::size_t i = 0; i < points.size(); ++i)
    for(int k = 0; k < 3; ++k) {
      const double x = CGAL::to_double(points[i][k]);
      if(!std::isfinite(x))
        refuse(path, "vertex " + std::to_string(i) + " has a coordinate that is not a finite number");
      largest = (std::max)(largest, std::abs(x));
      lower[k] = (std::min)(lower[k], x);
      upper[k] = (std::max)(upper[k], x);
    }
  for(std::size_t i = 0; i < polygons.size(); ++i) {
    if(polygons[i].size() < 3)
      refuse(path, "face " + std::to_string(i) + " has fewer than three vertices");
    for(std::size_t v : polygons[i])
      if(v >= points.size())
        refuse(path, "face " + std::to_string(i) + " has a vertex that does not exist");
  }
  // Volumes and squared volumes of cells 2^20 times smaller shall neither over- nor underflow.
  const double extent = (std::max)({upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]});
  if(largest > 1e90)
    refuse(path, "coordinates up to " + std::to_string(largest) + " overflow");
  if(extent < 1e-40)
    refuse(path, "its extent is zero or underflows");
  if(extent < largest * 1e-9)
    refuse(path, "it is so small, and so far from the origin, that its coordinates have no digits left");
}

} // namespace internal

/*!
Reads a closed surface from an OFF, OBJ, STL or PLY file, and mends what is harmless: duplicate points
and faces, unused points, polygons (triangulated), inconsistent or inward orientation.

\tparam Mesh a model of `MutableFaceGraph` with an internal vertex point map
\param path the file; its format follows from the extension
\param mesh the result: triangulated, closed, not self-intersecting, oriented outwards
\return what was read, with a warning for everything mended
\throw std::runtime_error a line naming the file and the defect, if the file cannot be read or is not
       the surface of a solid
\cost O(n log n)
*/
template <class Mesh>
Surface_input read_closed_surface(const std::string& path, Mesh& mesh)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  using Point = typename boost::property_traits<
    typename boost::property_map<Mesh, CGAL::vertex_point_t>::type>::value_type;
  using internal::counted;
  using internal::refuse;

  Surface_input input;
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  if(extension != ".off" && extension != ".obj" && extension != ".stl" && extension != ".ply")
    refuse(path, "unknown format; expected .off, .obj, .stl or .ply");
  if(std::filesystem::is_directory(path))
    refuse(path, "is a directory");
  errno = 0;
  if(!std::ifstream(path))
    refuse(path, std::string("cannot be opened: ") + std::strerror(errno));

  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> polygons;
  bool is_read = false;
  try {
    is_read = CGAL::IO::read_polygon_soup(path, points, polygons);
  } catch(const std::exception&) { // for example, counts beyond memory
  }
  if(!is_read)
    refuse(path, "cannot be read: not a complete " + extension.substr(1) + " file");
  internal::check_soup(path, points, polygons);
  input.number_of_points = points.size();
  input.number_of_polygons = polygons.size();

  // STL repeats the points of every triangle; elsewhere that deserves a word.
  const std::size_t merged = PMP::merge_duplicate_points_in_polygon_soup(points, polygons);
  if(merged != 0 && extension != ".stl")
    input.warnings.push_back("merged " + counted(merged, "duplicate point", "duplicate points"));
  const std::size_t before = polygons.size();
  polygons.erase(std::remove_if(polygons.begin(), polygons.end(),
                                [](std::vector<std::size_t> p) {
                                  std::sort(p.begin(), p.end());
                                  return std::adjacent_find(p.begin(), p.end()) != p.end();
                                }),
                 polygons.end());
  if(polygons.size() != before)
    input.warnings.push_back("dropped " + counted(before - polygons.size(), "degenerate face",
                                                  "degenerate faces"));
  const std::size_t doubled = PMP::merge_duplicate_polygons_in_polygon_soup(points, polygons);
  if(doubled != 0)
    input.warnings.push_back("merged " + counted(doubled, "duplicate face", "duplicate faces"));
  const std::size_t unused = PMP::remove_isolated_points_in_polygon_soup(points, polygons);
  if(unused != 0)
    input.warnings.push_back("ignored " + counted(unused, "unused point", "unused points"));
  if(polygons.empty())
    refuse(path, "all its faces are degenerate");

  const internal::Soup_edges edges = internal::edges_of(polygons);
  std::size_t open = 0, crowded = 0;
  for(auto first = edges.begin(), last = first; first != edges.end(); first = last) {
    last = std::upper_bound(first, edges.end(), *first);
    open += last - first == 1;
    crowded += last - first > 2;
  }
  if(open != 0)
    refuse(path, "the surface is not closed: " + counted(open, "border edge", "border edges"));
  if(crowded != 0)
    refuse(path, "the surface is not a manifold: "
                   + counted(crowded, "edge has more than two faces", "edges have more than two faces"));
  if(!PMP::is_polygon_soup_a_polygon_mesh(polygons)) {
    const std::size_t n = points.size();
    PMP::orient_polygon_soup(points, polygons);
    if(!PMP::is_polygon_soup_a_polygon_mesh(polygons))
      refuse(path, "the faces do not form a surface");
    // orient_polygon_soup() duplicates points where it has to cut: pinched vertices, or a Moebius band
    if(internal::edges_of(polygons).size() == edges.size() && points.size() > n)
      input.warnings.push_back("duplicated " + counted(points.size() - n, "pinched point",
                                                       "pinched points"));
    else
      input.warnings.push_back("oriented the faces consistently");
  }
  clear(mesh);
  PMP::polygon_soup_to_polygon_mesh(points, polygons, mesh);
  if(!CGAL::is_closed(mesh))
    refuse(path, "the surface cannot be oriented");
  if(!CGAL::is_triangle_mesh(mesh)) {
    const std::size_t n = std::size_t(std::count_if(polygons.begin(), polygons.end(),
                                                    [](const auto& p) { return p.size() > 3; }));
    if(!PMP::triangulate_faces(mesh))
      refuse(path, "its polygons cannot be triangulated");
    input.warnings.push_back("triangulated " + counted(n, "polygon", "polygons"));
  }

  const Bbox_3 b = PMP::bbox(mesh);
  const double box = b.x_span() * b.y_span() * b.z_span();
  if(!(box > 0))
    refuse(path, "the surface is flat: it encloses no volume");
  std::vector<std::pair<typename boost::graph_traits<Mesh>::face_descriptor,
                        typename boost::graph_traits<Mesh>::face_descriptor>> crossings;
  PMP::self_intersections(mesh, std::back_inserter(crossings));
  if(!crossings.empty()) {
    std::string pairs;
    for(std::size_t i = 0; i < crossings.size() && i < 5; ++i)
      pairs += (i == 0 ? " " : ", ") + std::to_string(std::size_t(crossings[i].first)) + "-"
               + std::to_string(std::size_t(crossings[i].second));
    refuse(path, "the surface intersects itself in " + counted(crossings.size(), "pair", "pairs")
                   + " of faces:" + pairs + (crossings.size() > 5 ? ", ..." : ""));
  }
  auto components = get(CGAL::dynamic_face_property_t<std::size_t>(), mesh);
  input.number_of_components = PMP::connected_components(mesh, components);
  if(input.number_of_components == 1) {
    if(!PMP::is_outward_oriented(mesh)) {
      PMP::reverse_face_orientations(mesh);
      input.warnings.push_back("turned the surface inside out: it was oriented inwards");
    }
  } else {
    PMP::orient_to_bound_a_volume(mesh);
    input.warnings.push_back("has " + std::to_string(input.number_of_components)
                             + " components: one inside another is a cavity");
  }
  input.volume = CGAL::to_double(PMP::volume(mesh));
  if(!(input.volume > 1e-12 * box))
    refuse(path, "the surface encloses no volume");
  return input;
}

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_READ_CLOSED_SURFACE_H
