// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pairs of faces of a surface that cut each other, where sheets of the surface may touch.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_SURFACE_CROSSINGS_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_SURFACE_CROSSINGS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/internal/surface/Surface.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/polygon_soup.h>
#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_3/internal/base/box_pairs.h>
#include <CGAL/Mixed_mesh_3/internal/base/is_crossing.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/enum.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

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

// Whether another vertex is at the same point, for each vertex: few are.
inline std::vector<bool> vertices_that_share_points(const Surface& mesh)
{
  std::vector<Surface::Vertex_index> sorted(vertices(mesh).begin(), vertices(mesh).end());
  std::sort(sorted.begin(), sorted.end(), [&mesh](Surface::Vertex_index v, Surface::Vertex_index w) {
    return mesh.point(v) < mesh.point(w);
  });
  std::vector<bool> shares_point(mesh.num_vertices(), false);
  for(std::size_t i = 1; i < sorted.size(); ++i)
    if(mesh.point(sorted[i]) == mesh.point(sorted[i - 1]))
      shares_point[sorted[i]] = shares_point[sorted[i - 1]] = true;
  return shares_point;
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
  const std::vector<bool> shares_point = vertices_that_share_points(mesh);
  std::vector<Surface::Edge_index> sorted;
  for(const auto e : edges(mesh))
    if(shares_point[mesh.source(mesh.halfedge(e))] && shares_point[mesh.target(mesh.halfedge(e))])
      sorted.push_back(e);
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

// Whether the faces around a vertex, seen from some direction, lie side by side around the vertex: then they
// meet only in what they share.
inline bool is_flat_fan(Surface::Vertex_index v, const Surface& mesh)
{
  // The margin is ten times the rounding of sines, 2^-53 times the ratio of coordinates to edges, if that
  // ratio is 10^9. The faces of a fan that is rejected are tested exactly.
  constexpr double margin = 1e-6;
  const auto start = mesh.halfedge(v);
  if(start == Surface::null_halfedge())
    return false;
  const Vec3 apex = to_vec3(mesh.point(v));
  Vec3 normal{};
  auto h = start; // leads to the vertex, as all that follow
  do {
    if(mesh.is_border(h))
      return false;
    const Vec3 a = to_vec3(mesh.point(mesh.source(h))) - apex,
               b = to_vec3(mesh.point(mesh.target(mesh.next(h)))) - apex;
    const Vec3 n = cross(b, a);
    normal = normal + 1 / norm(n) * n;
    h = mesh.opposite(mesh.next(h));
  } while(h != start);
  const double length = norm(normal);
  if(!(length > margin))
    return false;
  normal = 1 / length * normal;
  // Edges, seen from the normal, turn one way; how often they pass the first edge is the number of turns.
  const Vec3 first = to_vec3(mesh.point(mesh.source(start))) - apex;
  const Vec3 side = cross(normal, first);
  if(!(norm(side) > margin * norm(first)))
    return false;
  int number_of_passes = 0;
  bool was_left = true; // the start is on the left, by definition
  do {
    const Vec3 a = to_vec3(mesh.point(mesh.source(h))) - apex,
               b = to_vec3(mesh.point(mesh.target(mesh.next(h)))) - apex;
    if(!(dot(normal, cross(b, a)) > margin * norm(a) * norm(b)))
      return false;
    h = mesh.opposite(mesh.next(h));
    const bool is_left = h == start || dot(side, b) > 0;
    number_of_passes += is_left != was_left;
    was_left = is_left;
  } while(h != start);
  return number_of_passes == 2;
}

// Whether any two faces, of which none is degenerate, meet in more than what they share. Of the pairs whose
// boxes overlap, most share a vertex with a flat fan.
inline bool cuts_or_touches_itself(const Surface& mesh)
{
  using namespace Mixed_meshes_3::internal;
  std::vector<std::uint8_t> is_flat(mesh.num_vertices(), 0);
  for(const auto v : vertices(mesh))
    is_flat[v] = is_flat_fan(v, mesh);
  std::vector<Numbered_box> boxes;
  boxes.reserve(mesh.number_of_faces());
  for(const auto f : faces(mesh)) {
    const Triangle_view t(f, mesh);
    boxes.emplace_back(t.points[0].bbox() + t.points[1].bbox() + t.points[2].bbox(), std::size_t(f));
  }
  const auto vertices_of = [&mesh](std::size_t face) {
    return Triangle_view(Surface::Face_index(std::uint32_t(face)), mesh).vertices;
  };
  bool is_found = false;
  for_each_pair_of_boxes(boxes, [&](const auto& b, const auto& c) {
    if(is_found)
      return;
    const auto s = vertices_of(std::size_t(b.info())), t = vertices_of(std::size_t(c.info()));
    const bool shares_flat_fan = std::any_of(s.begin(), s.end(), [&](Surface::Vertex_index v) {
      return is_flat[v] != 0 && std::find(t.begin(), t.end(), v) != t.end();
    });
    is_found = !shares_flat_fan && is_crossing(s, t, mesh.points());
  });
  return is_found;
}

// Pairs of faces that cut each other. CGAL lists them, which takes longer than to find that there are none.
inline std::vector<Face_pair> self_intersections(const Surface& mesh)
{
  if(!cuts_or_touches_itself(mesh))
    return {};
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

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_SURFACE_CROSSINGS_H
