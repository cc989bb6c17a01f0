// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What `read_closed_surface()` does: the file, the topology, what can be mended, the orientation.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_READ_SURFACE_IMPL_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_READ_SURFACE_IMPL_H

#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Mixed_mesh_3/internal/base/compiled.h>
#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>

#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/enum.h>
#include <CGAL/number_utils.h>

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
#include <locale>
#include <set>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

inline std::string counted(std::size_t n, const char* one, const char* many)
{
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

struct Edge_counts
{
  std::size_t open = 0, crowded = 0; // edges with one face, and with more than two
  bool is_oriented = true;           // no edge occurs twice in the same direction
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
    counts.crowded += last - first > 2;
    if(last - first == 2 && first[0].is_upwards == first[1].is_upwards)
      counts.is_oriented = false;
  }
  return counts;
}

// What stands in a file may be anything: numbers first, then topology.
inline void check_soup(const std::string& path, const std::vector<Predicates_kernel::Point_3>& points,
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

struct Triangle_view
{
  std::array<Surface::Vertex_index, 3> vertices;
  std::array<Surface::Point, 3> points;

  Triangle_view(Surface::Face_index face, const Surface& mesh)
  {
    auto h = mesh.halfedge(face);
    for(std::size_t i = 0; i < 3; ++i, h = mesh.next(h)) {
      vertices[i] = mesh.target(h);
      points[i] = mesh.point(vertices[i]);
    }
  }
};

// "(1, 2, 3)": the place of a face, in the coordinates of the file; its number is ours, not the file's.
inline std::string place_of(Surface::Face_index face, const Surface& mesh)
{
  const auto p = Triangle_view(face, mesh).points[0];
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(7);
  out << "(" << CGAL::to_double(p.x()) << ", " << CGAL::to_double(p.y()) << ", " << CGAL::to_double(p.z())
      << ")";
  return out.str();
}

// Whether two faces meet in nothing but the point of two different vertices: a pinched point.
inline bool meet_in_pinched_point(Surface::Face_index f, Surface::Face_index g, const Surface& mesh)
{
  using Segment = Predicates_kernel::Segment_3;
  using Triangle = Predicates_kernel::Triangle_3;
  const Triangle_view a(f, mesh), b(g, mesh);
  const auto& p = a.points;
  const auto& q = b.points;
  const auto do_intersect = Predicates_kernel().do_intersect_3_object();
  for(std::size_t i = 0; i < 3; ++i)
    for(std::size_t j = 0; j < 3; ++j)
      if(p[i] == q[j] && a.vertices[i] != b.vertices[j])
        return !do_intersect(Triangle(p[0], p[1], p[2]), Segment(q[(j + 1) % 3], q[(j + 2) % 3]))
               && !do_intersect(Triangle(q[0], q[1], q[2]), Segment(p[(i + 1) % 3], p[(i + 2) % 3]));
  return false;
}

// Removes triangles whose vertices are on a line, or refuses.
inline void remove_degenerate_faces(const std::string& path, Surface& mesh, Surface_input& input)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  std::vector<Surface::Face_index> degenerate;
  PMP::degenerate_faces(mesh, std::back_inserter(degenerate));
  if(degenerate.empty())
    return;
  if(degenerate.size() == faces(mesh).size())
    refuse(path, "all its faces are degenerate");
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
    refuse(path, "has " + counted(n, "degenerate face", "degenerate faces")
                   + " (three vertices on a line), the first near " + place);
  input.warnings.push_back("removed " + counted(n, "degenerate face", "degenerate faces"));
  Surface compact; // without the places of removed faces
  CGAL::copy_face_graph(mesh, compact);
  clear(mesh);
  CGAL::copy_face_graph(compact, mesh);
}

inline void refuse_self_intersections(const std::string& path, const Surface& mesh)
{
  std::vector<std::pair<Surface::Face_index, Surface::Face_index>> crossings;
  CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(crossings));
  crossings.erase(std::remove_if(crossings.begin(), crossings.end(),
                                 [&mesh](const auto& pair) {
                                   return meet_in_pinched_point(pair.first, pair.second, mesh);
                                 }),
                  crossings.end());
  if(crossings.empty())
    return;
  std::vector<std::string> places;
  for(std::size_t i = 0; i < crossings.size() && places.size() < 3; ++i) {
    const std::string place = place_of(crossings[i].first, mesh);
    if(std::find(places.begin(), places.end(), place) == places.end())
      places.push_back(place);
  }
  std::string text = "the surface intersects itself in " + counted(crossings.size(), "pair", "pairs")
                     + " of faces, for example near ";
  for(std::size_t i = 0; i < places.size(); ++i)
    text += (i == 0 ? "" : ", ") + places[i];
  refuse(path, text);
}

// Seen from a vertex: far from the origin, the digits would be lost.
inline double enclosed_volume(const Surface& mesh)
{
  const Surface::Point origin = mesh.point(*vertices(mesh).first);
  double volume = 0;
  for(Surface::Face_index face : faces(mesh)) {
    const Triangle_view t(face, mesh);
    volume += CGAL::volume(origin, t.points[0], t.points[1], t.points[2]);
  }
  return volume;
}

// Orients the components such that the solid is on their inner side; returns the number of components.
// PMP::orient_to_bound_a_volume() looks at one vertex of a component only; where components touch, that
// vertex may be in both.
inline std::size_t orient_components(Surface& mesh, std::size_t& number_of_reversed)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  using Side = CGAL::Side_of_triangle_mesh<Surface, Predicates_kernel>;
  struct Component
  {
    std::vector<Surface::Face_index> faces;
    Bbox_3 bbox;
    double volume = 0;
    bool is_cavity = false;
  };

  const auto component_map = get(CGAL::dynamic_face_property_t<std::size_t>(), mesh);
  std::vector<Component> components(PMP::connected_components(mesh, component_map));
  for(Surface::Face_index face : faces(mesh))
    components[get(component_map, face)].faces.push_back(face);
  for(Component& c : components) {
    const Surface::Point origin = Triangle_view(c.faces.front(), mesh).points[0];
    for(Surface::Face_index face : c.faces) {
      const Triangle_view t(face, mesh);
      for(const auto& p : t.points)
        c.bbox += p.bbox();
      c.volume += CGAL::to_double(CGAL::volume(origin, t.points[0], t.points[1], t.points[2]));
    }
  }

  for(const Component& outer : components) {
    std::vector<Component*> candidates;
    for(Component& c : components) {
      bool is_within = &c != &outer;
      for(int k = 0; k < 3; ++k)
        is_within = is_within && outer.bbox.min(k) <= c.bbox.min(k) && c.bbox.max(k) <= outer.bbox.max(k);
      if(is_within)
        candidates.push_back(&c);
    }
    if(candidates.empty())
      continue;
    const Side::AABB_tree tree(outer.faces.begin(), outer.faces.end(), mesh, get(CGAL::vertex_point, mesh));
    const Side side(tree);
    for(Component* c : candidates) {
      Bounded_side s = ON_BOUNDARY;
      for(std::size_t i = 0; i < c->faces.size() && s == ON_BOUNDARY; ++i)
        for(const auto& p : Triangle_view(c->faces[i], mesh).points)
          if(s == ON_BOUNDARY)
            s = side(p);
      c->is_cavity ^= s == ON_BOUNDED_SIDE;
    }
  }
  number_of_reversed = 0;
  for(const Component& c : components)
    if((c.volume < 0) != c.is_cavity) {
      PMP::reverse_face_orientations(c.faces, mesh);
      ++number_of_reversed;
    }
  return components.size();
}

CGAL_MIXED_MESH_3_INLINE void read_surface(const std::string& path, Surface& mesh, Surface_input& input)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
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

  std::vector<Surface::Point> points;
  std::vector<std::vector<std::size_t>> polygons;
  bool is_read = false;
  try {
    is_read = CGAL::IO::read_polygon_soup(path, points, polygons);
  } catch(const std::exception&) { // for example, counts beyond memory
  }
  if(!is_read)
    refuse(path, "cannot be read: not a complete " + extension.substr(1) + " file");
  check_soup(path, points, polygons);
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
    input.warnings.push_back("dropped "
                             + counted(before - polygons.size(), "degenerate face", "degenerate faces"));
  const std::size_t doubled = PMP::merge_duplicate_polygons_in_polygon_soup(points, polygons);
  if(doubled != 0)
    input.warnings.push_back("merged " + counted(doubled, "duplicate face", "duplicate faces"));
  const std::size_t unused = PMP::remove_isolated_points_in_polygon_soup(points, polygons);
  if(unused != 0)
    input.warnings.push_back("ignored " + counted(unused, "unused point", "unused points"));
  if(polygons.empty())
    refuse(path, "all its faces are degenerate");

  const Edge_counts edges = count_edges(polygons);
  if(edges.open != 0)
    refuse(path, "the surface is not closed: " + counted(edges.open, "border edge", "border edges"));
  if(edges.crowded != 0)
    refuse(path,
           "the surface is not a manifold: "
             + counted(edges.crowded, "edge has more than two faces", "edges have more than two faces"));
  if(!PMP::is_polygon_soup_a_polygon_mesh(polygons)) {
    // Duplicates pinched points, and those of edges that it has to cut, as in a Moebius band.
    const std::size_t n = points.size();
    PMP::orient_polygon_soup(points, polygons);
    if(count_edges(polygons).open != 0)
      refuse(path, "the surface cannot be oriented");
    if(!PMP::is_polygon_soup_a_polygon_mesh(polygons))
      refuse(path, "the faces do not form a surface");
    if(!edges.is_oriented)
      input.warnings.push_back("oriented the faces consistently");
    const std::set<Surface::Point> pinched(points.begin() + std::ptrdiff_t(n), points.end());
    if(!pinched.empty())
      input.warnings.push_back("the surface is pinched at " + counted(pinched.size(), "point", "points"));
  }
  clear(mesh);
  PMP::polygon_soup_to_polygon_mesh(points, polygons, mesh);
  if(!CGAL::is_triangle_mesh(mesh)) {
    const std::size_t n = std::size_t(
      std::count_if(polygons.begin(), polygons.end(), [](const auto& p) { return p.size() > 3; }));
    if(!PMP::triangulate_faces(mesh))
      refuse(path, "its polygons cannot be triangulated");
    input.warnings.push_back("triangulated " + counted(n, "polygon", "polygons"));
  }

  const Bbox_3 b = PMP::bbox(mesh);
  const double box = b.x_span() * b.y_span() * b.z_span();
  if(!(box > 0))
    refuse(path, "the surface is flat: it encloses no volume");
  remove_degenerate_faces(path, mesh, input);
  refuse_self_intersections(path, mesh);
  std::size_t number_of_reversed;
  input.number_of_components = orient_components(mesh, number_of_reversed);
  if(input.number_of_components > 1)
    input.warnings.push_back("has " + std::to_string(input.number_of_components)
                             + " components: one inside another is a cavity");
  else if(number_of_reversed == 1)
    input.warnings.push_back("turned the surface inside out: it was oriented inwards");
  input.volume = enclosed_volume(mesh);
  if(!(input.volume > 1e-12 * box))
    refuse(path, "the surface encloses no volume");
}

} // namespace internal

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_READ_SURFACE_IMPL_H
