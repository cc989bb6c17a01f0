// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Implementation of `read_closed_surface()` and `read_sheet()`: the file, the topology, repairs of harmless
// defects, the orientation.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_READ_SURFACE_IMPL_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_READ_SURFACE_IMPL_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/internal/read_surface_file.h>
#include <CGAL/Mixed_mesh_3/IO/internal/repair_surface.h>
#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Mixed_mesh_3/internal/base/compiled.h>
#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

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
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/enum.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <iterator>
#include <limits>
#include <locale>
#include <map>
#include <numeric>
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

// Checks indices, then numbers: a file may have any content.
inline void check_indices(const std::string& path, const Surface_soup& soup)
{
  if(soup.points.empty() || soup.polygons.empty())
    refuse(path, "has no faces");
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
  constexpr double tolerance = 1e-13; // some hundred roundings
  return height <= tolerance * extent;
}

using Face_pair = std::pair<Surface::Face_index, Surface::Face_index>;

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

// The place of a face, in the coordinates of the file; the number of a face is ours, not the file's.
inline std::string place_of(Surface::Face_index face, const Surface& mesh)
{
  return place_text(Triangle_view(face, mesh).points[0]);
}

// Whether two faces meet only in a point or an edge that both have, of vertices that are different there: the
// surface touches itself.
inline bool is_contact(Surface::Face_index f, Surface::Face_index g, const Surface& mesh)
{
  using Segment = Predicates_kernel::Segment_3;
  using Triangle = Predicates_kernel::Triangle_3;
  const Triangle_view a(f, mesh), b(g, mesh);
  const auto& p = a.points;
  const auto& q = b.points;
  std::vector<std::array<std::size_t, 2>> common;
  for(std::size_t i = 0; i < 3; ++i)
    for(std::size_t j = 0; j < 3; ++j)
      if(p[i] == q[j])
        common.push_back({i, j});
  const auto do_intersect = Predicates_kernel().do_intersect_3_object();
  if(common.size() == 1) {
    const auto [i, j] = common[0];
    return !do_intersect(Triangle(p[0], p[1], p[2]), Segment(q[(j + 1) % 3], q[(j + 2) % 3]))
           && !do_intersect(Triangle(q[0], q[1], q[2]), Segment(p[(i + 1) % 3], p[(i + 2) % 3]));
  }
  if(common.size() != 2)
    return false;
  const auto& r = p[3 - common[0][0] - common[1][0]];
  const auto& s = q[3 - common[0][1] - common[1][1]];
  const auto &source = p[common[0][0]], &target = p[common[1][0]];
  return CGAL::orientation(source, target, r, s) != CGAL::COPLANAR
         || CGAL::coplanar_orientation(source, target, r, s) == CGAL::NEGATIVE;
}

// Two faces at an edge, with the points opposite to the edge.
struct Edge_sheet
{
  Surface::Point source, target, left, right;
  Surface::Face_index face;
};

// Whether a turn around the edge from left to right meets a point.
inline bool is_between(const Edge_sheet& s, const Surface::Point& p)
{
  const auto turn = [&s](const Surface::Point& a, const Surface::Point& b) {
    return CGAL::orientation(s.source, s.target, a, b);
  };
  switch(turn(s.left, s.right)) {
  case CGAL::POSITIVE: return turn(s.left, p) == CGAL::POSITIVE && turn(p, s.right) == CGAL::POSITIVE;
  case CGAL::NEGATIVE: return !(turn(s.right, p) == CGAL::POSITIVE && turn(p, s.left) == CGAL::POSITIVE);
  default: return turn(s.left, p) == CGAL::POSITIVE;
  }
}

// Pairs of faces of two sheets of the surface that go through each other at a common edge, where sheets may
// also just touch: the edges of both are the same all along then, and faces meet nowhere else.
inline std::vector<Face_pair> crossings_at_edges(const Surface& mesh)
{
  const auto upwards = [&mesh](Surface::Edge_index e) {
    const auto h = mesh.halfedge(e);
    return mesh.point(mesh.target(h)) < mesh.point(mesh.source(h)) ? mesh.opposite(h) : h;
  };
  const auto is_less = [&](Surface::Edge_index e, Surface::Edge_index f) {
    const auto g = upwards(e), h = upwards(f);
    const auto &a = mesh.point(mesh.source(g)), &b = mesh.point(mesh.source(h));
    return a != b ? a < b : mesh.point(mesh.target(g)) < mesh.point(mesh.target(h));
  };
  const auto sheet = [&](Surface::Edge_index e) {
    const auto h = upwards(e);
    const auto opposite = [&mesh](auto g) { return mesh.point(mesh.target(mesh.next(g))); };
    return Edge_sheet{mesh.point(mesh.source(h)), mesh.point(mesh.target(h)), opposite(h),
                      opposite(mesh.opposite(h)), mesh.face(h)};
  };
  std::vector<Surface::Edge_index> sorted(edges(mesh).begin(), edges(mesh).end());
  std::sort(sorted.begin(), sorted.end(), is_less);
  std::vector<Face_pair> crossings;
  for(auto e = sorted.begin(); e != sorted.end(); ++e)
    for(auto f = e + 1; f != sorted.end() && !is_less(*e, *f); ++f) {
      const Edge_sheet one = sheet(*e), other = sheet(*f);
      if(is_between(one, other.left) != is_between(one, other.right))
        crossings.emplace_back(one.face, other.face);
    }
  return crossings;
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
    return "has " + counted(n, "degenerate face", "degenerate faces")
           + " (three vertices on a line), the first near " + place;
  input.warnings.push_back("removed " + counted(n, "degenerate face", "degenerate faces"));
  Surface compact; // without the places of removed faces
  CGAL::copy_face_graph(mesh, compact);
  clear(mesh);
  CGAL::copy_face_graph(compact, mesh);
  return "";
}

inline std::vector<Face_pair> self_intersections(const Surface& mesh)
{
  std::vector<Face_pair> crossings;
  CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(crossings));
  crossings.erase(std::remove_if(crossings.begin(), crossings.end(),
                                 [&mesh](const Face_pair& pair) {
                                   return is_contact(pair.first, pair.second, mesh);
                                 }),
                  crossings.end());
  return crossings;
}

inline std::string describe(const std::vector<Face_pair>& crossings, const Surface& mesh)
{
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
  return text;
}

// The volume with points relative to a vertex: far from the origin, digits would be lost.
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

struct Component_counts
{
  std::size_t all = 0, cavities = 0, reversed = 0;
};

// Orients the components such that the solid is on their inner side. A component that cuts another one is not
// inside it. PMP::orient_to_bound_a_volume() looks at one vertex of a component only; where components touch,
// that vertex may be in both.
inline Component_counts orient_components(Surface& mesh, const std::vector<Face_pair>& crossings = {})
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

  std::set<std::pair<std::size_t, std::size_t>> cutting;
  for(const Face_pair& pair : crossings) {
    const std::size_t c = get(component_map, pair.first), d = get(component_map, pair.second);
    cutting.insert({c, d});
    cutting.insert({d, c});
  }

  for(const Component& outer : components) {
    std::vector<Component*> candidates;
    for(Component& c : components) {
      bool is_within = &c != &outer
                       && cutting.count(
                            {std::size_t(&c - components.data()), std::size_t(&outer - components.data())})
                            == 0;
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
  Component_counts counts{components.size(), 0, 0};
  for(const Component& c : components) {
    counts.cavities += c.is_cavity;
    if((c.volume < 0) != c.is_cavity) {
      PMP::reverse_face_orientations(c.faces, mesh);
      ++counts.reversed;
    }
  }
  return counts;
}

// Removes polygons that have the same vertices as another one in the same order, forwards or backwards,
// except the first of them; returns their number. CGAL's function compares points, and asserts that points of
// a polygon differ.
inline std::size_t remove_repeated(Polygons& polygons)
{
  std::set<std::vector<std::size_t>> met;
  const auto is_repeated = [&met](std::vector<std::size_t> p) {
    std::rotate(p.begin(), std::min_element(p.begin(), p.end()), p.end());
    if(p[1] > p.back())
      std::reverse(p.begin() + 1, p.end());
    return !met.insert(std::move(p)).second;
  };
  const std::size_t before = polygons.size();
  polygons.erase(std::remove_if(polygons.begin(), polygons.end(), is_repeated), polygons.end());
  return before - polygons.size();
}

// Removes polygons with a vertex twice, repeated polygons, and unused points.
inline void remove_superfluous(Points& points, Polygons& polygons, Surface_input& input)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
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
  const std::size_t doubled = remove_repeated(polygons);
  if(doubled != 0)
    input.warnings.push_back("merged " + counted(doubled, "duplicate face", "duplicate faces"));
  const std::size_t unused = PMP::remove_isolated_points_in_polygon_soup(points, polygons);
  if(unused != 0)
    input.warnings.push_back("ignored " + counted(unused, "unused point", "unused points"));
}

// Merges points at edges of one face only; returns the number of removed points. If a surface is closed as
// given, points at the same place belong to sheets that touch.
inline std::size_t merge_border_points(Points& points, Polygons& polygons)
{
  std::vector<std::array<std::size_t, 2>> edges;
  for(const auto& polygon : polygons)
    for(std::size_t i = 0; i < polygon.size(); ++i) {
      const auto [a, b] = std::minmax(polygon[i], polygon[(i + 1) % polygon.size()]);
      edges.push_back({a, b});
    }
  std::sort(edges.begin(), edges.end());
  std::vector<std::size_t> border;
  for(auto first = edges.begin(), last = first; first != edges.end(); first = last) {
    last = std::upper_bound(first, edges.end(), *first);
    if(last - first == 1)
      border.insert(border.end(), first->begin(), first->end());
  }
  std::sort(border.begin(), border.end(), [&points](std::size_t a, std::size_t b) {
    return points[a] != points[b] ? points[a] < points[b] : a < b;
  });
  std::vector<std::size_t> place(points.size()); // first point at each place, then its new index
  std::iota(place.begin(), place.end(), std::size_t(0));
  for(std::size_t i = 1; i < border.size(); ++i)
    if(points[border[i]] == points[border[i - 1]])
      place[border[i]] = place[border[i - 1]];
  std::size_t n = 0;
  for(std::size_t v = 0; v < points.size(); ++v) {
    if(place[v] == v) {
      points[n] = points[v];
      place[v] = n++;
    } else {
      place[v] = place[place[v]];
    }
  }
  const std::size_t merged = points.size() - n;
  points.erase(points.begin() + std::ptrdiff_t(n), points.end());
  for(auto& polygon : polygons)
    for(std::size_t& v : polygon)
      v = place[v];
  return merged;
}

// Gives bodies that have edges in common their own vertices there: each body consists of faces connected by
// edges of two faces. Nothing is changed if a body would not be closed then.
inline void separate_bodies(Points& points, Polygons& polygons)
{
  using Edge = std::array<std::size_t, 3>; // two vertices and the face
  std::vector<Edge> edges;
  for(std::size_t f = 0; f < polygons.size(); ++f)
    for(std::size_t i = 0; i < polygons[f].size(); ++i) {
      const auto [a, b] = std::minmax(polygons[f][i], polygons[f][(i + 1) % polygons[f].size()]);
      edges.push_back({a, b, f});
    }
  std::sort(edges.begin(), edges.end());
  std::vector<std::size_t> parent(polygons.size());
  std::iota(parent.begin(), parent.end(), std::size_t(0));
  const auto body = [&parent](std::size_t f) {
    while(parent[f] != f)
      f = parent[f] = parent[parent[f]];
    return f;
  };
  const auto for_each_edge = [&edges](const auto& use) {
    for(auto first = edges.begin(), last = first; first != edges.end(); first = last) {
      last = std::find_if(first, edges.end(),
                          [&](const Edge& e) { return e[0] != (*first)[0] || e[1] != (*first)[1]; });
      use(first, last);
    }
  };
  for_each_edge([&](auto first, auto last) {
    if(last - first == 2)
      parent[body(first[0][2])] = body(first[1][2]);
  });

  std::set<std::size_t> shared; // vertices of edges with more than two faces
  bool can_be_closed = true;
  for_each_edge([&](auto first, auto last) {
    if(last - first <= 2)
      return;
    shared.insert({(*first)[0], (*first)[1]});
    std::map<std::size_t, int> faces;
    for(auto e = first; e != last; ++e)
      ++faces[body((*e)[2])];
    for(const auto& [of, n] : faces)
      can_be_closed = can_be_closed && n == 2;
  });
  if(!can_be_closed)
    return;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> copies; // copies of a vertex for a body
  std::set<std::size_t> taken;
  for(std::size_t f = 0; f < polygons.size(); ++f)
    for(std::size_t& v : polygons[f])
      if(shared.count(v) != 0) {
        const auto [copy, is_new] = copies.emplace(std::make_pair(v, body(f)), v);
        if(is_new && !taken.insert(v).second) {
          copy->second = points.size();
          points.push_back(Surface::Point(points[v]));
        }
        v = copy->second;
      }
}

// Converts points to RAS, the space of all other data.
inline void set_space(Surface_soup& soup, const Read_surface_options& options)
{
  const Anatomical_space space = soup.is_RAS
                                   ? Anatomical_space::RAS
                                   : options.space.value_or(soup.space.value_or(Anatomical_space::RAS));
  if(space == Anatomical_space::RAS)
    return;
  for(Vec3& p : soup.points)
    p = {-p[0], -p[1], p[2]};
  soup.warnings.push_back(std::string(options.space ? "is read as LPS" : "says that it is in LPS")
                          + ": x and y are negated, the result is in RAS");
}

// Makes a mesh of faces that are closed, and a manifold except at points. Returns whether the mesh is
// oriented.
inline bool make_mesh(Points& points, Polygons& polygons, bool is_oriented, Surface& mesh,
                      Surface_input& input)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  if(!PMP::is_polygon_soup_a_polygon_mesh(polygons)) {
    // Pinched points are duplicated, and points of edges that have to be cut, as in a Moebius band.
    const std::size_t n = points.size();
    PMP::orient_polygon_soup(points, polygons);
    if(count_edges(polygons).open != 0 || !PMP::is_polygon_soup_a_polygon_mesh(polygons))
      return false;
    if(!is_oriented)
      input.warnings.push_back("oriented the faces consistently");
    const std::set<Surface::Point> pinched(points.begin() + std::ptrdiff_t(n), points.end());
    if(!pinched.empty())
      input.warnings.push_back("the surface is pinched at " + counted(pinched.size(), "point", "points"));
  }
  clear(mesh);
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

// Makes a mesh of the faces: closed, without self-intersections, oriented outwards.
inline Component_counts make_solid(const Read_surface_options& options, Points points, Polygons polygons,
                                   Surface& mesh, Surface_input& input)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  Edge_counts edges = count_edges(polygons);
  if(edges.open != 0) {
    const std::size_t open = edges.open;
    close(options, points, polygons, input);
    edges = count_edges(polygons);
    if(edges.open != 0)
      throw Surface_defect{not_closed(open), wrap_diameter_for(points)};
  }
  if(edges.nonmanifold != 0) {
    const std::size_t nonmanifold = edges.nonmanifold;
    separate_bodies(points, polygons);
    edges = count_edges(polygons);
    if(edges.nonmanifold == 0) {
      input.warnings.push_back("bodies touch along " + counted(nonmanifold, "edge", "edges"));
    } else {
      bound(options,
            "the surface is not a manifold: "
              + counted(nonmanifold, "edge has more than two faces", "edges have more than two faces"),
            points, polygons, input);
      edges = count_edges(polygons);
    }
  }
  const bool is_oriented = edges.is_oriented;
  Points whole_points = points;
  Polygons whole = polygons;
  if(!make_mesh(points, polygons, is_oriented, mesh, input)) {
    bound(options, "the surface cannot be oriented", whole_points, whole, input);
    if(!make_mesh(whole_points, whole, true, mesh, input))
      throw Surface_defect{"the faces do not form a surface"};
  }
  if(!triangulate(polygons, mesh, input))
    throw Surface_defect{"its polygons cannot be triangulated"};

  // Rounding the points where faces cut each other may make other faces cut.
  constexpr int most_passes = 5;
  for(int pass = 0;; ++pass) {
    std::string defect = remove_degenerate_faces(mesh, input);
    std::vector<Face_pair> crossings;
    if(defect.empty()) {
      crossings = self_intersections(mesh);
      const std::vector<Face_pair> at_edges = crossings.empty() ? crossings_at_edges(mesh) : crossings;
      if(at_edges.empty())
        return orient_components(mesh);
      defect = !crossings.empty()
                 ? describe(crossings, mesh)
                 : "the surface crosses itself along an edge near " + place_of(at_edges.front().first, mesh);
      crossings = at_edges;
    }
    if(pass == most_passes)
      throw Surface_defect{defect};
    if(pass == 0)
      orient_components(mesh, crossings);
    points.assign(mesh.points().begin(), mesh.points().end());
    polygons.clear();
    for(const auto face : faces(mesh)) {
      const Triangle_view t(face, mesh);
      polygons.push_back({t.vertices[0], t.vertices[1], t.vertices[2]});
    }
    bound(options, pass == 0 ? defect : "", points, polygons, input);
    if(!make_mesh(points, polygons, true, mesh, input))
      throw Surface_defect{defect};
  }
}

// Takes the faces of a soup, without superfluous ones.
inline void take_faces(const std::string& path, const Read_surface_options& options, Surface_soup soup,
                       Points& points, Polygons& polygons, Surface_input& input)
{
  check_indices(path, soup);
  set_space(soup, options);
  check_coordinates(path, soup);
  for(const Vec3& p : soup.points)
    points.emplace_back(p[0], p[1], p[2]);
  soup.points = {};
  polygons = std::move(soup.polygons);
  input.warnings = std::move(soup.warnings);
  input.number_of_points = points.size();
  input.number_of_polygons = polygons.size();

  if(count_edges(polygons).open != 0) {
    const std::size_t merged = merge_border_points(points, polygons);
    if(merged != 0 && !soup.repeats_points)
      input.warnings.push_back("merged " + counted(merged, "duplicate point", "duplicate points"));
  }
  remove_superfluous(points, polygons, input);
  if(polygons.empty())
    refuse(path, "all its faces are degenerate");
}

CGAL_MIXED_MESH_3_INLINE void read_surface(const std::string& path, const Read_surface_options& options,
                                           Surface& mesh, Surface_input& input)
{
  make_surface(path, options, read_surface_file(path), mesh, input);
}

CGAL_MIXED_MESH_3_INLINE void make_surface(const std::string& path, const Read_surface_options& options,
                                           Surface_soup soup, Surface& mesh, Surface_input& input)
{
  Points points;
  Polygons polygons;
  take_faces(path, options, std::move(soup), points, polygons, input);
  if(is_flat(points))
    refuse(path, "the surface is flat: it encloses no volume");

  const Bbox_3 b = CGAL::bbox_3(points.begin(), points.end());
  const double box = b.x_span() * b.y_span() * b.z_span();
  Component_counts components;
  if(options.wrap_diameter > 0) {
    wrap_faces(path, options.wrap_diameter, points, polygons);
    make_mesh(points, polygons, true, mesh, input);
    components = orient_components(mesh);
    note_repair("wrapped it, closing what is narrower than " + number_text(options.wrap_diameter), input);
  } else {
    try {
      components = make_solid(options, points, polygons, mesh, input);
    } catch(const Surface_defect& defect) {
      input.wrap_diameter = defect.wrap_diameter;
      refuse(path, defect.text);
    }
  }
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
    refuse(path, "the surface encloses no volume");
}

CGAL_MIXED_MESH_3_INLINE void read_sheet(const std::string& path, const Read_surface_options& options,
                                         Surface& mesh, Surface_input& input)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  Points points;
  Polygons polygons;
  take_faces(path, options, read_surface_file(path), points, polygons, input);
  const Edge_counts edges = count_edges(polygons);
  if(edges.nonmanifold != 0)
    refuse(path,
           "the sheet is not a manifold: "
             + counted(edges.nonmanifold, "edge has more than two faces", "edges have more than two faces"));
  if(!PMP::is_polygon_soup_a_polygon_mesh(polygons)) {
    PMP::orient_polygon_soup(points, polygons); // duplicates points, see above
    if(count_edges(polygons).open != edges.open)
      refuse(path, "the sheet cannot be oriented");
    if(!PMP::is_polygon_soup_a_polygon_mesh(polygons))
      refuse(path, "the faces do not form a surface");
    if(!edges.is_oriented)
      input.warnings.push_back("oriented the faces consistently");
  }
  clear(mesh);
  PMP::polygon_soup_to_polygon_mesh(points, polygons, mesh);
  if(!triangulate(polygons, mesh, input))
    refuse(path, "its polygons cannot be triangulated");
  std::vector<Surface::Face_index> degenerate;
  PMP::degenerate_faces(mesh, std::back_inserter(degenerate));
  if(!degenerate.empty())
    refuse(path, "has " + counted(degenerate.size(), "degenerate face", "degenerate faces")
                   + " (three vertices on a line), the first near " + place_of(degenerate.front(), mesh));
  const std::vector<Face_pair> crossings = self_intersections(mesh);
  if(!crossings.empty())
    refuse(path, describe(crossings, mesh));
  input.number_of_components = PMP::connected_components(mesh,
                                                         get(CGAL::dynamic_face_property_t<std::size_t>(),
                                                             mesh));
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_READ_SURFACE_IMPL_H
