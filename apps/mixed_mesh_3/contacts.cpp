// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mixed_mesh_3/contacts.h"

#include "core/messages.h"

#include <CGAL/Mixed_mesh_3/IO/internal/surface/take_faces.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/weld_points.h>
#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Mixed_mesh_3/internal/base/box_pairs.h>
#include <CGAL/Mixed_mesh_3/internal/repair/Solid_reading.h>
#include <CGAL/Mixed_mesh_3/internal/repair/Triangle_arrangement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>

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

// The triangles with boxes that meet those of triangles of other surfaces, ascending.
std::vector<std::size_t> triangles_near_others(const Soup& soup)
{
  std::vector<Numbered_box> boxes;
  for(std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const auto& [a, b, c] = soup.triangles[t];
    boxes.emplace_back(soup.points[a].bbox() + soup.points[b].bbox() + soup.points[c].bbox(), t);
  }
  std::vector<char> is_near(soup.triangles.size(), 0);
  mm3::internal::for_each_pair_of_boxes(boxes, [&](const Numbered_box& a, const Numbered_box& b) {
    if(soup.solid_of_triangle[a.info()] != soup.solid_of_triangle[b.info()])
      is_near[a.info()] = is_near[b.info()] = 1;
  });
  std::vector<std::size_t> near;
  for(std::size_t t = 0; t < is_near.size(); ++t)
    if(is_near[t])
      near.push_back(t);
  return near;
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
  const double welded = options.is_strict && options.weld_distance == 0 ? 0 : weld(distance, soup);
  std::vector<char> is_changed(subdomains.size(), 0);
  for(std::size_t v = 0; v < before.size(); ++v)
    if(soup.points[v] != before[v])
      is_changed[soup.solid_of_point[v]] = 1;
  if(!cut(soup, is_changed))
    warnings.push_back("the surfaces of " + subdomains.back().name + " and its subdomains meet in more than "
                       + std::to_string(most_meetings) + " pairs of triangles, and stay as they are");
  if(welded > 0)
    warnings.push_back("the surfaces of " + subdomains.back().name
                       + " and its subdomains touch in points up to " + rounded(welded)
                       + " apart, which are one point each");
  for(std::size_t i = 0; i < subdomains.size(); ++i)
    if(is_changed[i])
      if(auto surface = surface_of(soup, i, subdomains[i].name))
        subdomains[i].surface = std::move(surface);
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
