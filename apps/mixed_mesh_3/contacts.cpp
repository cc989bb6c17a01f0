// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mixed_mesh_3/contacts.h"

#include "core/messages.h"

#include <CGAL/Mixed_mesh_3/IO/internal/surface/take_faces.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/weld_points.h>
#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Mixed_mesh_3/internal/base/Disjoint_sets.h>
#include <CGAL/Mixed_mesh_3/internal/base/box_pairs.h>
#include <CGAL/Mixed_mesh_3/internal/repair/Solid_reading.h>
#include <CGAL/Mixed_mesh_3/internal/repair/Triangle_arrangement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace mm3 = CGAL::Mixed_meshes_3;

namespace {

using Point = Kernel::Point_3;
using Triangle = std::array<std::size_t, 3>;
using mm3::internal::Numbered_box;

constexpr std::size_t most_meetings = 300000; // takes some ten seconds

// The triangles of several surfaces.
struct Soup
{
  std::vector<Point> points;
  std::vector<Triangle> triangles;
  std::vector<std::size_t> solid_of_point, solid_of_triangle; // numbers of subdomains

  Soup() = default;

  explicit Soup(const std::vector<Subdomain>& subdomains)
  {
    for(std::size_t i = 0; i < subdomains.size(); ++i)
      if(subdomains[i].index != 0)
        add(*subdomains[i].surface, i, false);
  }

  void add(const Surface& surface, std::size_t solid, bool is_reversed)
  {
    std::map<Surface::Vertex_index, std::size_t> number;
    for(const auto v : surface.vertices()) {
      number[v] = points.size();
      points.push_back(surface.point(v));
    }
    for(const auto f : surface.faces()) {
      triangles.emplace_back();
      std::size_t k = 0;
      for(const auto v : surface.vertices_around_face(surface.halfedge(f)))
        triangles.back()[k++] = number[v];
      if(is_reversed)
        std::swap(triangles.back()[1], triangles.back()[2]);
    }
    solid_of_point.resize(points.size(), solid);
    solid_of_triangle.resize(triangles.size(), solid);
  }
};

// The boundary of what triangles wind around more often outwards than inwards.
Surface solid_of(const Soup& soup, const std::string& name)
{
  const auto solid = mm3::internal::read_solid(soup.points, soup.triangles, most_meetings);
  if(!solid.is_complete)
    throw std::runtime_error("the surfaces of " + name + " and other subdomains meet in too many places");
  Surface surface;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(solid.points, solid.triangles, surface);
  return surface;
}

bool have_common_point(const Surface& s, const Surface& t)
{
  std::vector<Point> points(s.points().begin(), s.points().end());
  std::sort(points.begin(), points.end());
  return std::any_of(t.points().begin(), t.points().end(),
                     [&](const Point& p) { return std::binary_search(points.begin(), points.end(), p); });
}

// Makes points of different surfaces equal that are at most that far apart, and the coordinates of planes
// that differ by about as much. Returns the largest distance of such points.
double weld(double distance, Soup& soup)
{
  namespace internal = mm3::IO::internal;
  std::vector<std::size_t> first(soup.points.size()), all(soup.points.size());
  std::iota(first.begin(), first.end(), std::size_t(0));
  all = first;
  double longest = 0;
  mm3::Vec3 error{};
  internal::for_each_near_pair(soup.points, all, distance, [&](std::size_t a, std::size_t b) {
    const mm3::Vec3 d = mm3::to_vec3(soup.points[a]) - mm3::to_vec3(soup.points[b]);
    if(soup.solid_of_point[a] == soup.solid_of_point[b] || mm3::norm(d) == 0)
      return;
    first[b] = (std::min)(first[b], first[a]);
    longest = (std::max)(longest, mm3::norm(d));
    for(std::size_t k = 0; k < 3; ++k)
      error[k] = (std::max)(error[k], std::abs(d[k]));
  });
  for(int k = 0; k < 3; ++k)
    if(error[std::size_t(k)] > 0)
      internal::align_coordinates(k, (std::min)(2 * error[std::size_t(k)], distance), soup.points);
  for(std::size_t v = 0; v < first.size(); ++v) // the first one of a chain comes first
    soup.points[v] = soup.points[first[v] = first[first[v]]];
  return longest;
}

// Lets points at the same place be one.
void unite_equal_points(Soup& soup)
{
  std::map<Point, std::size_t> place;
  for(Triangle& t : soup.triangles)
    for(std::size_t& v : t)
      v = place.emplace(soup.points[v], v).first->second;
}

CGAL::Bbox_3 box_of(const Soup& soup, const Triangle& t, double margin)
{
  const CGAL::Bbox_3 b = soup.points[t[0]].bbox() + soup.points[t[1]].bbox() + soup.points[t[2]].bbox();
  return {b.xmin() - margin, b.ymin() - margin, b.zmin() - margin,
          b.xmax() + margin, b.ymax() + margin, b.zmax() + margin};
}

// Calls `use(s, t)` for pairs of triangles of different surfaces whose boxes, with a margin, meet.
template <class Use>
void for_each_pair_of_others(const Soup& soup, double margin, const Use& use)
{
  std::vector<Numbered_box> boxes;
  for(std::size_t t = 0; t < soup.triangles.size(); ++t)
    boxes.emplace_back(box_of(soup, soup.triangles[t], margin), t);
  mm3::internal::for_each_pair_of_boxes(boxes, [&](const Numbered_box& a, const Numbered_box& b) {
    if(soup.solid_of_triangle[a.info()] != soup.solid_of_triangle[b.info()])
      use(a.info(), b.info());
  });
}

// The triangles with boxes that meet those of triangles of other surfaces, ascending.
std::vector<std::size_t> triangles_near_others(const Soup& soup)
{
  std::vector<char> is_near(soup.triangles.size(), 0);
  for_each_pair_of_others(soup, 0, [&is_near](std::size_t s, std::size_t t) { is_near[s] = is_near[t] = 1; });
  std::vector<std::size_t> near;
  for(std::size_t t = 0; t < is_near.size(); ++t)
    if(is_near[t])
      near.push_back(t);
  return near;
}

// Replaces triangles by those that are given for them, which inherit their subdomains.
void replace(const std::map<std::size_t, std::vector<Triangle>>& pieces, Soup& soup,
             std::vector<char>& is_changed)
{
  std::vector<Triangle> triangles;
  std::vector<std::size_t> solids;
  for(std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const auto found = pieces.find(t);
    const std::size_t solid = soup.solid_of_triangle[t];
    if(found == pieces.end())
      triangles.push_back(soup.triangles[t]);
    else
      for(const Triangle& piece : found->second)
        if(piece[0] != piece[1] && piece[1] != piece[2] && piece[2] != piece[0])
          triangles.push_back(piece);
    is_changed[solid] = is_changed[solid] || found != pieces.end();
    solids.resize(triangles.size(), solid);
  }
  soup.triangles = std::move(triangles);
  soup.solid_of_triangle = std::move(solids);
}

// Splits edges at vertices of other surfaces that are at most that far from them: then surfaces that touch
// along lines, which rounding makes crooked, have equal edges there. Returns whether no such vertex is left.
bool split_edges(double distance, Soup& soup, std::vector<char>& is_changed)
{
  using Edge = std::array<std::size_t, 3>; // of a surface
  struct Split
  {
    std::size_t vertex;
    double offset; // from the middle
  };
  constexpr int most_rounds = 64; // splits next to the middle halve the vertices at an edge, roughly
  for(int round = 0; round < most_rounds; ++round) {
    std::map<Edge, Split> splits;
    const auto edge_of = [&soup](std::size_t t, std::size_t k) {
      const auto [a, b] = std::minmax(soup.triangles[t][k], soup.triangles[t][(k + 1) % 3]);
      return Edge{a, b, soup.solid_of_triangle[t]};
    };
    const auto look = [&](std::size_t t, std::size_t other) {
      for(std::size_t k = 0; k < 3; ++k) {
        const Edge edge = edge_of(t, k);
        const mm3::Vec3 a = mm3::to_vec3(soup.points[edge[0]]),
                        along = mm3::to_vec3(soup.points[edge[1]]) - a;
        const double length = mm3::norm(along);
        for(std::size_t v : soup.triangles[other]) {
          if(v == edge[0] || v == edge[1])
            continue;
          const mm3::Vec3 to = mm3::to_vec3(soup.points[v]) - a;
          const double x = mm3::dot(to, along) / length;
          if(!(x > distance && x < length - distance) || mm3::norm(mm3::cross(along, to)) > distance * length)
            continue;
          const double offset = std::abs(x - length / 2);
          const auto [found, is_new] = splits.emplace(edge, Split{v, offset});
          if(!is_new && std::pair(offset, v) < std::pair(found->second.offset, found->second.vertex))
            found->second = {v, offset};
        }
      }
    };
    for_each_pair_of_others(soup, distance, [&look](std::size_t s, std::size_t t) {
      look(s, t);
      look(t, s);
    });
    if(splits.empty())
      return true;
    std::map<std::size_t, std::vector<Triangle>> pieces;
    for(std::size_t t = 0; t < soup.triangles.size(); ++t)
      for(std::size_t k = 0; k < 3; ++k) {
        const auto split = splits.find(edge_of(t, k));
        if(split == splits.end())
          continue;
        const std::size_t v = split->second.vertex;
        std::vector<Triangle>& of_t = pieces.try_emplace(t, 1, soup.triangles[t]).first->second;
        const std::size_t a = soup.triangles[t][k], b = soup.triangles[t][(k + 1) % 3];
        for(std::size_t i = 0; i < of_t.size(); ++i)
          for(std::size_t j = 0; j < 3; ++j)
            if(of_t[i][j] == a && of_t[i][(j + 1) % 3] == b) {
              const std::size_t c = of_t[i][(j + 2) % 3];
              of_t[i] = {a, v, c};
              of_t.push_back({v, b, c});
              i = of_t.size() - 1;
              break;
            }
      }
    replace(pieces, soup, is_changed);
  }
  return false;
}

// Whether two triangles touch in a face: where one is above the other, the region is wider than the distance,
// and nowhere are they farther apart.
bool have_common_face(const std::array<mm3::Vec3, 3>& s, const std::array<mm3::Vec3, 3>& t, double distance)
{
  const mm3::Vec3 normal = mm3::cross(s[1] - s[0], s[2] - s[0]);
  const double size = mm3::norm(normal);
  if(size == 0)
    return false;
  std::vector<mm3::Vec3> part(t.begin(), t.end());
  for(std::size_t k = 0; k < 3; ++k) { // what is beyond an edge is cut off
    const mm3::Vec3 inwards = mm3::cross(normal, s[(k + 1) % 3] - s[k]);
    std::vector<mm3::Vec3> rest;
    for(std::size_t i = 0; i < part.size(); ++i) {
      const mm3::Vec3 &p = part[i], &q = part[(i + 1) % part.size()];
      const double x = mm3::dot(inwards, p - s[k]), y = mm3::dot(inwards, q - s[k]);
      if(x >= 0)
        rest.push_back(p);
      if((x > 0 && y < 0) || (x < 0 && y > 0))
        rest.push_back(p + (x / (x - y)) * (q - p));
    }
    part = std::move(rest);
    if(part.size() < 3)
      return false;
  }
  mm3::Vec3 area{};
  double perimeter = 0;
  for(std::size_t i = 0; i < part.size(); ++i) {
    if(std::abs(mm3::dot(normal, part[i] - s[0])) > distance * size)
      return false;
    const mm3::Vec3 &p = part[i], &q = part[(i + 1) % part.size()];
    perimeter += mm3::norm(q - p);
    area = area + 0.5 * mm3::cross(p - part[0], q - part[0]);
  }
  return 2 * mm3::norm(area) > distance * perimeter; // of a strip, the width is the quotient
}

// Sets of triangles of different surfaces that touch in faces, in triangles that are not equal.
std::vector<std::vector<std::size_t>> touching_triangles(double distance, const Soup& soup)
{
  mm3::internal::Disjoint_sets touching(soup.triangles.size());
  const auto corners = [&soup](std::size_t t) {
    const auto& [a, b, c] = soup.triangles[t];
    return std::array<mm3::Vec3, 3>{mm3::to_vec3(soup.points[a]), mm3::to_vec3(soup.points[b]),
                                    mm3::to_vec3(soup.points[c])};
  };
  for_each_pair_of_others(soup, distance, [&](std::size_t s, std::size_t t) {
    const Triangle &a = soup.triangles[s], &b = soup.triangles[t];
    if(!std::is_permutation(a.begin(), a.end(), b.begin())
       && have_common_face(corners((std::min)(s, t)), corners((std::max)(s, t)), distance))
      touching.unite(s, t);
  });
  const auto [set_of, number_of_sets] = touching.numbered();
  std::vector<std::vector<std::size_t>> sets(number_of_sets);
  for(std::size_t t = 0; t < set_of.size(); ++t)
    sets[set_of[t]].push_back(t);
  sets.erase(std::remove_if(sets.begin(), sets.end(), [](const auto& set) { return set.size() == 1; }),
             sets.end());
  return sets;
}

// Triangulates the face in which triangles touch once for all: seen along the axis that is most upright, they
// are in a plane exactly, whatever rounding has made of the plane. Nothing happens if they are in no plane.
void join_face(const std::vector<std::size_t>& set, double distance, Soup& soup,
               std::map<std::size_t, std::vector<Triangle>>& pieces)
{
  using Exact = mm3::internal::Triangle_arrangement::Kernel;
  const auto normal_of = [&soup](std::size_t t) {
    const auto& [a, b, c] = soup.triangles[t];
    return CGAL::normal(soup.points[a], soup.points[b], soup.points[c]);
  };
  const std::size_t largest = *std::max_element(set.begin(), set.end(), [&](std::size_t s, std::size_t t) {
    return normal_of(s).squared_length() < normal_of(t).squared_length();
  });
  const Kernel::Vector_3 normal = normal_of(largest);
  const Point& origin = soup.points[soup.triangles[largest][0]];
  int axis = 0;
  for(int k = 1; k < 3; ++k)
    if(std::abs(normal[k]) > std::abs(normal[axis]))
      axis = k;
  const int first = (axis + 1) % 3, second = (axis + 2) % 3;
  std::map<Point, std::size_t> at; // vertices by their places in the plane
  std::vector<Point> flat;
  std::vector<Triangle> triangles;
  for(std::size_t t : set) {
    triangles.emplace_back();
    for(std::size_t k = 0; k < 3; ++k) {
      const Point& p = soup.points[soup.triangles[t][k]];
      if(std::abs(normal * (p - origin)) > distance * std::sqrt(normal.squared_length()))
        return;
      triangles.back()[k] = flat.size();
      flat.emplace_back(p[first], p[second], 0);
      if(at.emplace(flat.back(), soup.triangles[t][k]).first->second != soup.triangles[t][k])
        return;
    }
  }
  const mm3::internal::Triangle_arrangement arrangement(flat, triangles, most_meetings);
  std::vector<std::size_t> number(arrangement.points().size(), std::size_t(-1));
  const auto number_of = [&](std::size_t v, std::size_t triangle) {
    if(number[v] != std::size_t(-1))
      return number[v];
    const auto& q = arrangement.points()[v];
    CGAL::exact(q);
    const Point near(CGAL::to_double(q.x()), CGAL::to_double(q.y()), 0);
    const auto [found, is_new] = at.emplace(near, soup.points.size());
    if(is_new) { // a place where edges cross, which becomes a point of the first triangle there
      std::array<Exact::Point_3, 3> p;
      for(std::size_t k = 0; k < 3; ++k) {
        const Point& corner = soup.points[soup.triangles[triangle][k]];
        p[k] = Exact::Point_3(corner.x(), corner.y(), corner.z());
      }
      const auto n = CGAL::normal(p[0], p[1], p[2]);
      const auto height = p[0][axis]
                          - (n[first] * (q.x() - p[0][first]) + n[second] * (q.y() - p[0][second])) / n[axis];
      CGAL::exact(height);
      std::array<double, 3> x{};
      x[std::size_t(first)] = near.x();
      x[std::size_t(second)] = near.y();
      x[std::size_t(axis)] = CGAL::to_double(height);
      soup.points.emplace_back(x[0], x[1], x[2]);
    }
    return number[v] = found->second;
  };
  for(const auto& piece : arrangement.pieces()) {
    const std::size_t t = set[piece.triangle];
    const auto& [a, b, c] = piece.vertices;
    pieces[t].push_back({number_of(a, t), number_of(b, t), number_of(c, t)});
  }
}

// Lets surfaces have equal triangles where they touch in faces up to that distance.
void join_faces(double distance, Soup& soup, std::vector<char>& is_changed)
{
  std::map<std::size_t, std::vector<Triangle>> pieces;
  for(const std::vector<std::size_t>& set : touching_triangles(distance, soup))
    join_face(set, distance, soup, pieces);
  replace(pieces, soup, is_changed);
}

// Replaces triangles by their pieces; nothing happens if too many meet.
// Returns whether a triangle of each subdomain is cut.
bool cut(Soup& soup, std::vector<char>& is_cut)
{
  const std::vector<std::size_t> near = triangles_near_others(soup);
  std::vector<Triangle> input;
  for(std::size_t t : near)
    input.push_back(soup.triangles[t]);
  const mm3::internal::Triangle_arrangement arrangement(soup.points, input, most_meetings);
  if(!arrangement.is_complete())
    return false;
  std::vector<std::size_t> number(arrangement.points().size(), std::size_t(-1));
  const auto number_of = [&](std::size_t v) {
    if(number[v] == std::size_t(-1)) {
      const auto& p = arrangement.points()[v];
      CGAL::exact(p);
      number[v] = soup.points.size();
      soup.points.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
    }
    return number[v];
  };
  std::vector<std::size_t> pieces(input.size(), 0);
  for(const auto& piece : arrangement.pieces())
    ++pieces[piece.triangle];
  std::vector<char> is_replaced(soup.triangles.size(), 0);
  for(std::size_t i = 0; i < near.size(); ++i)
    if(pieces[i] != 1) {
      is_replaced[near[i]] = 1;
      is_cut[soup.solid_of_triangle[near[i]]] = 1;
    }
  for(const auto& piece : arrangement.pieces())
    if(pieces[piece.triangle] != 1) {
      const auto& [a, b, c] = piece.vertices;
      soup.triangles.push_back({number_of(a), number_of(b), number_of(c)});
      soup.solid_of_triangle.push_back(soup.solid_of_triangle[near[piece.triangle]]);
    }
  std::size_t n = 0;
  for(std::size_t t = 0; t < soup.triangles.size(); ++t)
    if(t >= is_replaced.size() || !is_replaced[t]) {
      soup.triangles[n] = soup.triangles[t];
      soup.solid_of_triangle[n++] = soup.solid_of_triangle[t];
    }
  soup.triangles.resize(n);
  soup.solid_of_triangle.resize(n);
  return true;
}

// The surface of one subdomain; null if its triangles do not bound a solid any more.
std::shared_ptr<const Surface> surface_of(const Soup& soup, std::size_t solid, const std::string& name)
{
  std::map<Point, std::size_t> number;
  std::vector<Point> points;
  std::vector<Triangle> triangles;
  for(std::size_t t = 0; t < soup.triangles.size(); ++t) {
    if(soup.solid_of_triangle[t] != solid)
      continue;
    Triangle triangle{};
    for(std::size_t k = 0; k < 3; ++k) {
      const Point& p = soup.points[soup.triangles[t][k]];
      const auto [found, is_new] = number.emplace(p, points.size());
      if(is_new)
        points.push_back(p);
      triangle[k] = found->second;
    }
    if(triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0])
      triangles.push_back(triangle);
  }
  auto surface = std::make_shared<Surface>();
  std::string error;
  if(!mm3::IO::make_closed_surface(points, triangles, name, {}, *surface, &error))
    return nullptr;
  return surface;
}

} // namespace

void join_contacts(std::vector<Subdomain>& subdomains, const mm3::IO::Read_surface_options& options,
                   std::vector<std::string>& warnings)
{
  Soup soup(subdomains);
  const std::vector<Point> before = soup.points;
  const double distance = options.weld_distance > 0
                            ? options.weld_distance
                            : mm3::IO::internal::rounding_of_points * mm3::IO::internal::diagonal_of(before);
  const bool is_welded = !options.is_strict || options.weld_distance > 0;
  const double welded = is_welded ? weld(distance, soup) : 0;
  std::vector<char> is_changed(subdomains.size(), 0);
  for(std::size_t v = 0; v < before.size(); ++v)
    if(soup.points[v] != before[v])
      is_changed[soup.solid_of_point[v]] = 1;
  unite_equal_points(soup);
  bool is_joined = true;
  if(is_welded) {
    is_joined = split_edges(distance, soup, is_changed);
    join_faces(distance, soup, is_changed);
    is_joined = is_joined && split_edges(distance, soup, is_changed); // around faces, at new vertices
  }
  is_joined = is_joined && cut(soup, is_changed);
  std::vector<std::shared_ptr<const Surface>> joined(subdomains.size());
  for(std::size_t i = 0; i < subdomains.size() && is_joined; ++i)
    if(is_changed[i])
      is_joined = (joined[i] = surface_of(soup, i, subdomains[i].name)) != nullptr;
  if(!is_joined) {
    warnings.push_back("the surfaces of " + subdomains.back().name
                       + " and its subdomains cannot be joined where they meet, and stay as they are");
    return;
  }
  for(std::size_t i = 0; i < subdomains.size(); ++i)
    if(joined[i])
      subdomains[i].surface = std::move(joined[i]);
  if(welded > 0)
    warnings.push_back("the surfaces of " + subdomains.back().name
                       + " and its subdomains touch in points up to " + rounded(welded)
                       + " apart, which are one point each");
}

void take_overlaps(std::vector<Subdomain>& subdomains, std::vector<std::string>& warnings)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  const Soup all(subdomains);
  // An overlap of that thickness is rounding.
  const double thickness = mm3::IO::internal::rounding_of_points * mm3::IO::internal::diagonal_of(all.points);
  for(std::size_t i = 0; i < subdomains.size(); ++i) {
    Subdomain& s = subdomains[i];
    if(s.index == 0)
      continue;
    // Earlier surfaces do not overlap any more: the winding number is 1 in this one without them.
    Soup soup;
    soup.add(*s.surface, i, false);
    for(std::size_t j = 0; j < i; ++j)
      if(subdomains[j].index != 0 && have_common_point(*subdomains[j].surface, *s.surface))
        soup.add(*subdomains[j].surface, j, true);
    if(soup.solid_of_triangle.front() == soup.solid_of_triangle.back())
      continue;
    auto rest = std::make_shared<Surface>(solid_of(soup, s.name));
    const double volume = rest->is_empty() ? 0 : PMP::volume(*rest),
                 least = thickness * PMP::area(*s.surface);
    if(volume <= least) {
      warnings.push_back("the subdomain " + s.name + ": nothing is left of it, earlier ones have all inside");
    } else if(PMP::volume(*s.surface) - volume > least) {
      s.surface = std::move(rest);
      s.solid = nullptr;
    }
  }
}

Surface union_of(const std::vector<Subdomain>& subdomains)
{
  // Each surface winds once around what it encloses, and all together at least once around the union.
  return solid_of(Soup(subdomains), subdomains.back().name);
}
