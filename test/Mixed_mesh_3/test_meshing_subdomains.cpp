// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Domains of several subdomains: the subdomain of a point, and meshes whose interfaces are on the surfaces.

#include "test_lattice.h"
#include "test_meshing.h"

#include <CGAL/Labeled_polyhedral_mixed_mesh_domain_3.h>
#include <CGAL/Mixed_mesh_3/Octree_cell_traits_3.h>
#include <CGAL/Mixed_mesh_3/interfaces.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/cut_by_interfaces.h>
#include <CGAL/Mixed_mesh_3/internal/transitions/apply_transitions.h>
#include <CGAL/Mixed_mesh_3/surface_distance.h>
#include <CGAL/Polygon_mesh_processing/measure.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <utility>
#include <vector>

using Domain = CGAL::Labeled_polyhedral_mixed_mesh_domain_3;
using CGAL::ON_BOUNDARY;
using CGAL::ON_BOUNDED_SIDE;
using CGAL::ON_UNBOUNDED_SIDE;

namespace test_meshing_subdomains {

struct Box
{
  int from[3], to[3];
  Subdomain_index index;

  CGAL::Bounded_side side(const Point_3& p) const
  {
    CGAL::Bounded_side side = ON_BOUNDED_SIDE;
    for(int k = 0; k < 3; ++k) {
      if(p[k] < from[k] || p[k] > to[k])
        return ON_UNBOUNDED_SIDE;
      if(p[k] == from[k] || p[k] == to[k])
        side = ON_BOUNDARY;
    }
    return side;
  }
};

// The subdomain of a point by definition.
Subdomain_index subdomain_by_hand(const std::vector<Box>& boxes, const Point_3& p)
{
  for(const Box& b : boxes)
    if(b.side(p) == ON_BOUNDED_SIDE)
      return b.index;
  return 0;
}

CGAL::Bounded_side side_by_hand(const std::vector<Box>& boxes, const Point_3& p)
{
  bool is_on_surface = false;
  for(const Box& b : boxes) {
    const CGAL::Bounded_side side = b.side(p);
    is_on_surface = is_on_surface || side == ON_BOUNDARY;
    if(side != ON_UNBOUNDED_SIDE && b.index == 0)
      break; // what is behind is outside
    if(side == ON_BOUNDED_SIDE)
      return ON_BOUNDED_SIDE;
  }
  return is_on_surface ? ON_BOUNDARY : ON_UNBOUNDED_SIDE;
}

// Checks cells from the root down, as the octree asks; points on all lattice planes, so that many are on
// surfaces.
template <class Cell_traits>
void check_cells(const Domain& domain, const std::vector<Box>& boxes, const Cell_traits& traits,
                 const Lattice_point& corner, std::uint32_t side, const Domain::Surface_part& parent)
{
  Domain::Surface_part part;
  const auto cell = traits.cell(corner, side);
  const CGAL::Bounded_side where = domain.locate(cell, parent, part);
  const std::uint32_t quarter = side / 4;
  for(std::uint32_t i = 0; i < 125; ++i) {
    const auto p = traits.point(
      {corner[0] + i % 5 * quarter, corner[1] + i / 5 % 5 * quarter, corner[2] + i / 25 * quarter});
    const CGAL::Bounded_side expected = side_by_hand(boxes, p);
    if(where != ON_BOUNDARY)
      BOOST_TEST_EQ(int(where), int(expected));
    else
      BOOST_TEST_EQ(int(domain.bounded_side(p, part)), int(expected));
    if(expected == ON_BOUNDED_SIDE) {
      BOOST_TEST_EQ(domain.subdomain_index(p, part), subdomain_by_hand(boxes, p));
      BOOST_TEST_EQ(domain.subdomain_index(p), subdomain_by_hand(boxes, p));
    }
  }
  if(where == ON_BOUNDARY && quarter * 16 > CGAL::Mixed_meshes_3::internal::lattice_root_side / 8)
    for(std::uint32_t i = 0; i < 8; ++i)
      check_cells(domain, boxes, traits,
                  {corner[0] + (i & 1) * side / 2, corner[1] + (i >> 1 & 1) * side / 2,
                   corner[2] + (i >> 2) * side / 2},
                  side / 2, part);
}

void test_domain()
{
  std::mt19937 random(1);
  const auto coordinate = [&] { return int(random() % 9); };
  for(int round = 0; round < 12; ++round) {
    std::vector<Box> boxes;
    Domain domain;
    for(int i = 0; i < 5; ++i) {
      Box b{};
      for(int k = 0; k < 3; ++k) {
        b.from[k] = coordinate();
        b.to[k] = (b.from[k] + 1 + coordinate() % 8) % 10;
        if(b.to[k] <= b.from[k])
          b.to[k] = b.from[k] + 1;
      }
      b.index = i == round % 5 ? 0 : i + 1;
      boxes.push_back(b);
      domain.add(box(Point_3(b.from[0], b.from[1], b.from[2]), Point_3(b.to[0], b.to[1], b.to[2])), b.index);
    }
    BOOST_TEST_EQ(domain.subdomain_indices().size(), 4u);
    const Axis_aligned_octree_cell_traits_3 traits(CGAL::Bbox_3(0, 0, 0, 8, 8, 8), Root_cell::BOX);
    check_cells(domain, boxes, traits, {0, 0, 0}, CGAL::Mixed_meshes_3::internal::lattice_root_side,
                domain.surface_part());
  }
}

void test_closest_points()
{
  Domain domain;
  domain.add(box(Point_3(0, 0, 0), Point_3(1, 1, 1)), 0);
  domain.add(box(Point_3(4, 0, 0), Point_3(5, 1, 1)), 7);
  domain.add(box(Point_3(-1, -1, -1), Point_3(9, 2, 2)), 3);
  const Point_3 p(2, 0.5, 0.5);
  BOOST_TEST(domain.closest_point(p) == Point_3(1, 0.5, 0.5));
  BOOST_TEST(domain.closest_point(p, 7, 3) == Point_3(4, 0.5, 0.5));
  BOOST_TEST(domain.closest_point(p, Point_3(4, 0, 0), 7, 3) == Point_3(4, 0.5, 0.5));
  BOOST_TEST(domain.closest_point(p, 3, 0) == Point_3(1, 0.5, 0.5)); // the cavity, nearer than outside
  BOOST_TEST(domain.closest_point(Point_3(8.5, 0.5, 0.5), 3, 0) == Point_3(9, 0.5, 0.5));
  BOOST_TEST(std::abs(domain.mean_chord_length(7) - 2. / 3) < 1e-15);
  for(const Point_3& q : domain.surface_samples(0.4, 7))
    BOOST_TEST(domain.closest_point(q, 7, 3) == q);

  // Hidden surfaces have no samples.
  domain.add(box(Point_3(4.2, 0.2, 0.2), Point_3(4.8, 0.8, 0.8)), 5);
  BOOST_TEST(domain.surface_samples(0.4, 5).empty());
}

// Checks conditions that hold for the mesh of any labeled domain.
void check_subdomains(const Mesh& mesh, const Domain& domain, const Mixed_mesh_result_3& result)
{
  std::size_t off = 0;
  for(const Subdomain_interface& one : find_interfaces(mesh))
    off += number_of_vertices_off_interface(mesh, one, domain);
  const auto& fitted = result.optimization;
  // A vertex can be on several interfaces.
  BOOST_TEST_EQ(off == 0, fitted.number_of_arrived_vertices == fitted.number_of_boundary_vertices);
  BOOST_TEST_EQ(number_of_boundary_self_intersections(mesh), 0u);
  // Between two interfaces there may be room for flatter elements only, which the result tells.
  BOOST_TEST(fitted.number_of_elements_above_bound == 0 || result.quality_bound > fitted.quality_bound);
}

// Three layers that are half as thick as the cells that a mesh with so many vertices has elsewhere, and a
// mesh with fewer vertices: each layer is there, everywhere.
void test_layers()
{
  const double radii[] = {0.86, 0.93, 1};
  Domain domain;
  for(int i = 0; i < 3; ++i)
    domain.add(sphere(Point_3(0, 0, 0), radii[i], 24), i + 1);
  for(std::size_t n : {1500, 2500}) {
    Mesh mesh;
    const Mixed_mesh_result_3 result = run(domain, CGAL::Everywhere_mixed_mesh_region_3(),
                                           Mixed_mesh_criteria_3(n), mesh);
    check_subdomains(mesh, domain, result);
    BOOST_TEST_EQ(mesh.number_of_vertices(), n);
    BOOST_TEST_EQ(result.optimization.number_of_arrived_vertices,
                  result.optimization.number_of_boundary_vertices);
    const std::vector<Subdomain_interface> interfaces = find_interfaces(mesh);
    BOOST_TEST_EQ(interfaces.size(), 3u); // no layer has a hole
    std::vector<int> number_of_interfaces(mesh.number_of_vertices(), 0);
    for(const Subdomain_interface& one : interfaces) {
      BOOST_TEST(one.is_manifold());
      for(Vertex_index v : vertices_of(one.faces))
        ++number_of_interfaces[v];
    }
    BOOST_TEST_LE(*std::max_element(number_of_interfaces.begin(), number_of_interfaces.end()), 1);
    const auto volumes = volumes_of_subdomains(mesh);
    double within = 0;
    for(int i = 0; i < 3; ++i) {
      const double whole = CGAL::to_double(
        CGAL::Polygon_mesh_processing::volume(sphere(Point_3(0, 0, 0), radii[i], 24)));
      BOOST_TEST_LE(std::abs(volumes.at(i + 1) / (whole - within) - 1), 0.05);
      within = whole;
    }
  }
}

// A ball in a ball beside another one, in a ball around all; without junctions.
void test_nested()
{
  Domain domain;
  domain.add(sphere(Point_3(-0.4, 0, 0), 0.2, 8), 4);
  domain.add(sphere(Point_3(-0.4, 0, 0), 0.4, 12), 1);
  domain.add(sphere(Point_3(0.5, 0, 0), 0.3, 10), 2);
  domain.add(sphere(Point_3(0, 0, 0), 1, 16), 3);
  Mesh mesh;
  const Mixed_mesh_result_3 result = run(domain, CGAL::Everywhere_mixed_mesh_region_3(),
                                         Mixed_mesh_criteria_3(3000), mesh);
  check_subdomains(mesh, domain, result);
  BOOST_TEST_EQ(result.optimization.number_of_elements_above_bound, 0u);
  const auto volume_of = [](const Surface& s) {
    return CGAL::to_double(CGAL::Polygon_mesh_processing::volume(s));
  };
  const double inner = volume_of(sphere(Point_3(0, 0, 0), 0.2, 8)),
               outer = volume_of(sphere(Point_3(0, 0, 0), 0.4, 12)),
               other = volume_of(sphere(Point_3(0, 0, 0), 0.3, 10)),
               whole = volume_of(sphere(Point_3(0, 0, 0), 1, 16));
  const auto volumes = volumes_of_subdomains(mesh);
  BOOST_TEST_EQ(volumes.size(), 4u);
  for(const auto& [index, v] : std::map<Subdomain_index, double>{
        {4, inner}, {1, outer - inner}, {2, other}, {3, whole - outer - other}}) {
    BOOST_TEST_GT(volumes.at(index), 0.93 * v);
    BOOST_TEST_LT(volumes.at(index), 1.07 * v);
  }
  const std::vector<Subdomain_interface> interfaces = find_interfaces(mesh);
  BOOST_TEST_EQ(interfaces.size(), 4u);
  for(const Subdomain_interface& one : interfaces) {
    BOOST_TEST(one.is_manifold());
    BOOST_TEST_EQ(number_of_vertices_off_interface(mesh, one, domain), 0u);
  }

  // The bytes are the same from several threads.
  Mesh again;
  const Thread_limit limit(4);
  run<CGAL::Parallel_if_available_tag>(domain, CGAL::Everywhere_mixed_mesh_region_3(),
                                       Mixed_mesh_criteria_3(3000), again);
  BOOST_TEST(content(again) == content(mesh));

  // One surface is a domain without labels.
  Domain one;
  one.add(sphere(Point_3(0, 0, 0), 1, 16), 5);
  Mesh labeled, plain;
  run(one, CGAL::Everywhere_mixed_mesh_region_3(), Mixed_mesh_criteria_3(300), labeled);
  run(Polyhedral_mixed_mesh_domain_3(sphere(Point_3(0, 0, 0), 1, 16)), CGAL::Everywhere_mixed_mesh_region_3(),
      Mixed_mesh_criteria_3(300), plain);
  BOOST_TEST(content(labeled) == content(plain));
  BOOST_TEST_EQ(labeled.subdomain_index(0), 5);
}

// Two halves of a box: their interface ends at the boundary, where vertices are on two surfaces.
void test_junction()
{
  Domain domain;
  domain.add(box(Point_3(-2, -2, -2), Point_3(0.1, 2, 2)), 1);
  domain.add(sphere(Point_3(0, 0, 0), 1, 16), 2);
  // The rest of the first box is far from the second: only the plane matters.
  Mesh mesh;
  const Mixed_mesh_result_3 result = make_mixed_mesh_3(domain, Mixed_mesh_criteria_3(2500), mesh);
  check(mesh, result, 2500);
  const std::vector<Subdomain_interface> interfaces = find_interfaces(mesh);
  BOOST_TEST_EQ(interfaces.size(), 3u);
  for(const Subdomain_interface& one : interfaces)
    BOOST_TEST(one.is_manifold());
  std::vector<int> strata(mesh.number_of_vertices(), 0);
  for(const Subdomain_interface& one : interfaces)
    for(Vertex_index v : vertices_of(one.faces))
      ++strata[v];
  std::size_t junctions = 0, arrived = 0;
  for(Vertex_index v = 0; v < strata.size(); ++v)
    if(strata[v] == 3) {
      ++junctions;
      const double r = std::sqrt(CGAL::to_double(CGAL::squared_distance(mesh.point(v), Point_3(0, 0, 0))));
      arrived += std::abs(mesh.point(v).x() - 0.1) < 1e-8 && r > 0.9 && r <= 1;
    }
  BOOST_TEST_GT(junctions, 10u);
  BOOST_TEST_GT(double(arrived), 0.7 * double(junctions));
}

// Balls and boxes anywhere: touching, crossing, nested, thin.
void test_any()
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for(int round = 0; round < 16; ++round) {
    Domain domain;
    const int n = 2 + round % 4;
    for(int i = 0; i < n; ++i) {
      const Point_3 c(unit(random), unit(random), unit(random));
      if(round % 3 == 0) {
        const double d[3] = {0.02 + 0.4 * unit(random), 0.02 + 0.4 * unit(random), 0.02 + 0.4 * unit(random)};
        domain.add(box(Point_3(c.x() - d[0], c.y() - d[1], c.z() - d[2]),
                       Point_3(c.x() + d[0], c.y() + d[1], c.z() + d[2])),
                   i + 1);
      } else {
        domain.add(sphere(c, 0.05 + 0.4 * unit(random), 6), round % 5 == 4 && i == 1 ? 0 : i + 1);
      }
    }
    domain.add(sphere(Point_3(0.5, 0.5, 0.5), 0.6, 10), n + 1);
    Mesh mesh;
    const Mixed_mesh_result_3 result = make_mixed_mesh_3(domain, Mixed_mesh_criteria_3(400), mesh);
    check(mesh, result, 400);
    check_subdomains(mesh, domain, result);
    for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
      BOOST_TEST(mesh.subdomain_index(e) >= 1 && mesh.subdomain_index(e) <= n + 1);
  }
}

// A mesh of cubes with two subdomains: the interface is their common square.
// Balls and boxes anywhere, cut out of a lattice whose cells are often larger than they are: the boundary and
// all interfaces are manifolds, also where layers end at the boundary, and the volumes are right.
void test_cuts()
{
  const Aligned_traits traits({-0.27, -0.31, -0.29, 1.33, 1.29, 1.31});
  const CGAL::Everywhere_mixed_mesh_region_3 region;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  for(int round = 0; round < 40; ++round) {
    Domain domain;
    const int n = 2 + round % 4;
    for(int i = 0; i < n; ++i) {
      const Point_3 c(unit(random), unit(random), unit(random));
      domain.add(sphere(c, 0.1 + 0.3 * unit(random), 8), i + 1);
    }
    if(round % 2 == 0)
      domain.add(sphere(Point_3(0.5, 0.5, 0.5), 0.6, 10), n + 1);
    Located_octree octree(domain, region, traits);
    for(int level = 0; level < 3 + round % 3; ++level)
      octree.refine(octree.leaves_to_refine(level, false));
    internal::Known_edges known;
    const internal::Core_mesh mesh = internal::cut_by_interfaces(
      {octree, internal::apply_transitions(octree, Transition_templates_choice::FEWEST_VERTICES),
       [](internal::Octree::Node_index) { return false; }, known},
      false);
    BOOST_TEST(!mesh.is_empty());
    if(mesh.is_empty())
      continue;
    BOOST_TEST(find_defects(mesh).none());
    for(const Subdomain_interface& one : find_interfaces(mesh))
      BOOST_TEST(one.is_manifold());
  }
}

void test_interfaces()
{
  Mesh mesh;
  const int n = 3;
  for(int z = 0; z <= n; ++z)
    for(int y = 0; y <= n; ++y)
      for(int x = 0; x <= 2 * n; ++x)
        mesh.add_vertex(Point_3(x, y, z));
  const auto at = [&](int x, int y, int z) {
    return Vertex_index(std::uint32_t(x + (2 * n + 1) * (y + (n + 1) * z)));
  };
  for(int z = 0; z < n; ++z)
    for(int y = 0; y < n; ++y)
      for(int x = 0; x < 2 * n; ++x)
        mesh.add_element(HEXAHEDRON,
                         {at(x, y, z), at(x + 1, y, z), at(x + 1, y + 1, z), at(x, y + 1, z), at(x, y, z + 1),
                          at(x + 1, y, z + 1), at(x + 1, y + 1, z + 1), at(x, y + 1, z + 1)},
                         {x < n ? 2 : 1, false});
  const auto interfaces = [&] {
    std::map<std::pair<int, int>, Subdomain_interface> by;
    for(Subdomain_interface& one : find_interfaces(mesh))
      by.emplace(std::make_pair(one.first, one.second), one);
    return by;
  };
  auto found = interfaces();
  BOOST_TEST_EQ(found.size(), 3u);
  BOOST_TEST_EQ((found.at({1, 2}).faces.size()), std::size_t(n * n));
  BOOST_TEST_EQ((found.at({1, 2}).area), double(n * n));
  BOOST_TEST_EQ((found.at({1, 0}).faces.size()), std::size_t(5 * n * n));
  for(const auto& [subdomains, one] : found) {
    BOOST_TEST(one.is_manifold());
    for(const Face& f : one.faces)
      BOOST_TEST_EQ(mesh.subdomain_index(f.element()), subdomains.first);
  }
  BOOST_TEST_EQ(volumes_of_subdomains(mesh).at(1), double(n * n * n));

  // Two cubes touch along an edge only, and at a vertex only, within the other subdomain.
  const auto cube = [&](int x, int y, int z) {
    return Element_index(std::uint32_t(x + 2 * n * (y + n * z)));
  };
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
    mesh.set_subdomain_index(e, 1);
  mesh.set_subdomain_index(cube(1, 1, 1), 2);
  mesh.set_subdomain_index(cube(2, 2, 1), 2);
  found = interfaces();
  BOOST_TEST_EQ((found.at({1, 2}).bad_edges.size()), 1u);
  mesh.set_subdomain_index(cube(2, 2, 1), 1);
  BOOST_TEST((interfaces().at({1, 2}).is_manifold()));
  mesh.set_subdomain_index(cube(2, 2, 2), 2);
  found = interfaces();
  BOOST_TEST_EQ((found.at({1, 2}).bad_edges.size()), 0u);
  BOOST_TEST_EQ((found.at({1, 2}).bad_vertices.size()), 1u);
}

// An interface between subdomains has vertices on both sides of its surface before it is fitted, and inner
// ones next to it; thin parts have elements nevertheless. The boundary is outside.
void test_both_sides()
{
  Domain domain;
  domain.add(sphere(Point_3(0, 0, 0), 0.4, 16), 1);
  domain.add(sphere(Point_3(0, 0, 0), 1, 16), 2);
  Mesh mesh;
  run(domain, CGAL::Everywhere_mixed_mesh_region_3(), Mixed_mesh_criteria_3(2000).fit_to_surface(false),
      mesh);
  const std::vector<Subdomain_interface> interfaces = find_interfaces(mesh);
  BOOST_TEST_EQ(interfaces.size(), 2u);
  for(const Subdomain_interface& one : interfaces) {
    double longest = 0, deepest = 0;
    for(const Face& f : one.faces)
      for(int i = 0; i < f.vertices().size(); ++i)
        longest = (std::max)(longest, std::sqrt(CGAL::squared_distance(
                                        mesh.point(f.vertices()[i]),
                                        mesh.point(f.vertices()[(i + 1) % f.vertices().size()]))));
    std::size_t inside = 0, outside = 0;
    for(Vertex_index v : vertices_of(one.faces)) {
      const double depth = (one.second == 0 ? 1 : 0.4)
                           - std::sqrt(CGAL::squared_distance(Point_3(0, 0, 0), mesh.point(v)));
      deepest = (std::max)(deepest, depth);
      ++(depth > 0 ? inside : outside);
    }
    BOOST_TEST_GT(outside, 20u);
    if(one.second == 0) {
      BOOST_TEST_LT(deepest, 0.02); // the polyhedron is inside of the ball
    } else {
      BOOST_TEST_GT(inside, 10u);
      BOOST_TEST_LT(deepest, 0.3 * longest + 0.02);
    }
  }
}

// The subdomains in the quarters around the middle of a segment of length 1 along an axis.
std::array<Subdomain_index, 4> subdomains_around(const std::vector<Box>& boxes,
                                                 const std::array<int, 3>& from, int axis)
{
  std::array<Subdomain_index, 4> around{};
  for(std::size_t q = 0; q < 4; ++q) {
    double x[3];
    x[axis] = from[axis] + 0.5;
    x[(axis + 1) % 3] = from[(axis + 1) % 3] + (q % 2 ? 0.25 : -0.25);
    x[(axis + 2) % 3] = from[(axis + 2) % 3] + (q / 2 ? 0.25 : -0.25);
    around[q] = subdomain_by_hand(boxes, Point_3(x[0], x[1], x[2]));
  }
  return around;
}

bool is_on_edge(const Box& b, const std::array<int, 3>& from, int axis)
{
  const auto is_at_end = [&](int k) { return from[k] == b.from[k] || from[k] == b.to[k]; };
  return b.from[axis] <= from[axis] && from[axis] < b.to[axis] && is_at_end((axis + 1) % 3)
         && is_at_end((axis + 2) % 3);
}

// Sharp edges of boxes that are nested, touch, or cross each other, against the quarters around all segments.
void test_sharp_edges()
{
  constexpr int size = 6;
  using Segment = std::pair<std::array<int, 3>, int>; // lower end, axis
  std::mt19937 random(7);
  std::size_t number = 0, number_cut = 0;
  for(int trial = 0; trial < 200; ++trial) {
    std::vector<Box> boxes(3);
    Domain domain;
    for(std::size_t i = 0; i < boxes.size(); ++i) {
      Box& b = boxes[i];
      b.index = trial % 4 == 0 ? Subdomain_index(i) : Subdomain_index(i + 1);
      for(int k = 0; k < 3; ++k) {
        b.from[k] = int(random() % size);
        b.to[k] = b.from[k] + 1 + int(random() % unsigned(size - b.from[k]));
      }
      domain.add(box(Point_3(b.from[0], b.from[1], b.from[2]), Point_3(b.to[0], b.to[1], b.to[2])), b.index);
    }
    std::map<Segment, std::set<Subdomain_index>> expected, found;
    for(int axis = 0; axis < 3; ++axis)
      for(int i = 0; i < (size + 1) * (size + 1) * (size + 1); ++i) {
        const std::array<int, 3> from{i % (size + 1), i / (size + 1) % (size + 1),
                                      i / (size + 1) / (size + 1)};
        const auto q = subdomains_around(boxes, from, axis);
        const bool is_flat = (q[0] == q[1] && q[2] == q[3]) || (q[0] == q[2] && q[1] == q[3]);
        if(!is_flat && std::any_of(boxes.begin(), boxes.end(), [&](const Box& b) {
             return is_on_edge(b, from, axis);
           }))
          expected[{from, axis}].insert(q.begin(), q.end());
      }
    const Sharp_edges edges = domain.sharp_edges(50);
    BOOST_TEST_EQ(edges.edges.size(), edges.subdomains.size());
    for(std::size_t e = 0; e < edges.edges.size(); ++e) {
      Vec3 p = edges.points[edges.edges[e][0]], q = edges.points[edges.edges[e][1]];
      int axis = 0;
      while(p[axis] == q[axis])
        ++axis;
      if(p[axis] > q[axis])
        std::swap(p, q);
      for(int x = int(std::lround(p[axis])); x < int(std::lround(q[axis])); ++x) {
        std::array<int, 3> from{int(std::lround(p[0])), int(std::lround(p[1])), int(std::lround(p[2]))};
        from[axis] = x;
        BOOST_TEST((found.count({from, axis}) == 0));
        found[{from, axis}].insert(edges.subdomains[e].begin(), edges.subdomains[e].end());
      }
    }
    BOOST_TEST(found == expected);
    number += expected.size();
    number_cut += edges.crossings.size();
  }
  BOOST_TEST_GT(number, 5000u);
  BOOST_TEST_GT(number_cut, 200u);
}

// Meshes of boxes keep all edges and corners of all subdomains: side by side, nested, and with a sheet across
// edges.
void test_sharp_edges_of_meshes()
{
  struct Case
  {
    std::vector<Test_surface> surfaces;
    double volume;
    double length; // of all sharp edges
    std::size_t corners;
    bool has_sheet = false;
  };
  const Case cases[] = {
    {{box(Point_3(1, 0, 0), Point_3(2, 1, 1)), box(Point_3(0, 0, 0), Point_3(1, 1, 1))}, 2, 20, 12},
    {{box(Point_3(0.3, 0.3, 0.3), Point_3(0.7, 0.7, 0.7)), box(Point_3(0, 0, 0), Point_3(1, 1, 1))},
     1,
     16.8,
     16},
    {{box(Point_3(0, 0, 0), Point_3(1, 1, 1))}, 1, 12, 12, true}};
  for(const Case& one : cases) {
    Domain domain;
    for(std::size_t i = 0; i < one.surfaces.size(); ++i)
      domain.add(one.surfaces[i], Subdomain_index(i) + 1);
    if(one.has_sheet) {
      Test_surface sheet;
      const auto a = sheet.add_vertex(Point_3(-1, -1, 0.4)), b = sheet.add_vertex(Point_3(2, -1, 0.5)),
                 c = sheet.add_vertex(Point_3(2, 2, 0.6)), d = sheet.add_vertex(Point_3(-1, 2, 0.5));
      sheet.add_face(a, b, c);
      sheet.add_face(a, c, d);
      domain.add_sheet(sheet);
    }
    Mesh mesh;
    const auto result = run(domain, CGAL::Everywhere_mixed_mesh_region_3(), Mixed_mesh_criteria_3(1000),
                            mesh);
    const auto& fit = result.optimization;
    BOOST_TEST_EQ(fit.number_of_arrived_vertices, fit.number_of_boundary_vertices);
    BOOST_TEST_LT(std::abs(fit.length_of_sharp_edges - one.length), 1e-9);
    BOOST_TEST_GT(fit.length_of_sharp_edges_kept, 0.999 * one.length);
    BOOST_TEST_EQ(fit.number_of_corners, one.corners);
    BOOST_TEST_EQ(fit.number_of_corners_kept, one.corners);
    BOOST_TEST_LT(std::abs(volume(mesh) - one.volume), 1e-9);
  }
}

int run(int, char*[])
{
  test_domain();
  test_closest_points();
  test_interfaces();
  test_nested();
  test_layers();
  test_junction();
  test_any();
  test_cuts();
  test_both_sides();
  test_sharp_edges();
  test_sharp_edges_of_meshes();
  return boost::report_errors();
}

} // namespace test_meshing_subdomains
