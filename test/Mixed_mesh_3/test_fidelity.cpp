// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes compared with the solids that they represent: solids of voxels, whose topology is counted by
// flooding, and meshes of round solids. Each difference is reported for a mesh that has it, and not for
// others.

#include "test_meshing.h"
#include "test_surfaces.h"

#include <CGAL/Mixed_mesh_3/fidelity.h>

#include <CGAL/Polygon_mesh_processing/orientation.h>

#include <boost/core/lightweight_test.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace test_fidelity {

using Kind = Solid_difference_kind;

constexpr int n = 12; // voxels along an axis
using Solid = std::function<bool(int x, int y, int z)>;

bool is_in(const Solid& solid, int x, int y, int z)
{
  const auto is_within = [](int i) { return 0 <= i && i < n; };
  return is_within(x) && is_within(y) && is_within(z) && solid(x, y, z);
}

Solid block(const std::array<int, 3>& from, const std::array<int, 3>& to)
{
  return [=](int x, int y, int z) {
    return from[0] <= x && x < to[0] && from[1] <= y && y < to[1] && from[2] <= z && z < to[2];
  };
}

Solid operator+(const Solid& a, const Solid& b)
{
  return [=](int x, int y, int z) { return a(x, y, z) || b(x, y, z); };
}

Solid operator-(const Solid& a, const Solid& b)
{
  return [=](int x, int y, int z) { return a(x, y, z) && !b(x, y, z); };
}

// A hexahedron for each voxel.
Mesh mesh_of(const Solid& solid)
{
  Mesh mesh;
  std::vector<Vertex_index> index(std::size_t(n + 1) * (n + 1) * (n + 1), Vertex_index(-1));
  const auto vertex = [&](int x, int y, int z) {
    Vertex_index& v = index[std::size_t(x + (n + 1) * (y + (n + 1) * z))];
    if(v == Vertex_index(-1))
      v = mesh.add_vertex({double(x), double(y), double(z)});
    return v;
  };
  for(int z = 0; z < n; ++z)
    for(int y = 0; y < n; ++y)
      for(int x = 0; x < n; ++x)
        if(solid(x, y, z)) {
          std::array<Vertex_index, 8> v{};
          for(std::size_t i = 0; i < 8; ++i) {
            const auto& c = reference_elements[HEXAHEDRON].coordinates[i];
            v[i] = vertex(x + (c[0] + 1) / 2, y + (c[1] + 1) / 2, z + (c[2] + 1) / 2);
          }
          mesh.add_element(HEXAHEDRON, v);
        }
  BOOST_TEST(find_defects(mesh).none());
  return mesh;
}

// A surface with triangles other than those of the boundary of a mesh: four around the middle of each
// quadrilateral.
Surface surface_of(const Solid& solid)
{
  const Mesh mesh = mesh_of(solid);
  Surface surface;
  for(const auto& p : mesh.points())
    surface.add_vertex(p);
  for(const Face& face : boundary_faces(mesh)) {
    const Face_vertices& v = face.vertices();
    const auto at = [&](int i) { return Surface::Vertex_index(v[i % 4]); };
    const auto middle = surface.add_vertex(CGAL::midpoint(mesh.point(v[0]), mesh.point(v[2])));
    for(int i = 0; i < 4; ++i)
      surface.add_face(at(i), at(i + 1), middle);
  }
  for(const auto v : surface.vertices())
    if(surface.is_isolated(v))
      surface.remove_vertex(v);
  surface.collect_garbage();
  return surface;
}

// The number of components of voxels where a predicate holds, in the grid with a layer around.
std::size_t number_of_components(const Solid& solid)
{
  constexpr int m = n + 2;
  const auto index = [](const std::array<int, 3>& p) { return std::size_t(p[0] + m * (p[1] + m * p[2])); };
  std::vector<bool> is_open(std::size_t(m) * m * m);
  std::vector<std::array<int, 3>> all;
  for(int z = 0; z < m; ++z)
    for(int y = 0; y < m; ++y)
      for(int x = 0; x < m; ++x) {
        all.push_back({x, y, z});
        is_open[index(all.back())] = solid(x - 1, y - 1, z - 1);
      }
  std::size_t number = 0;
  for(const auto& start : all) {
    number += is_open[index(start)];
    std::vector<std::array<int, 3>> stack{start};
    while(!stack.empty()) {
      const auto p = stack.back();
      stack.pop_back();
      if(!is_open[index(p)])
        continue;
      is_open[index(p)] = false;
      for(std::size_t k = 0; k < 3; ++k)
        for(int step : {-1, 1}) {
          auto q = p;
          q[k] += step;
          if(0 <= q[k] && q[k] < m)
            stack.push_back(q);
        }
    }
  }
  return number;
}

// Cells of all dimensions of the voxels in a solid: the number of cells of even dimension minus the others.
std::ptrdiff_t euler_characteristic(const Solid& solid)
{
  std::ptrdiff_t sum = 0;
  constexpr int m = 2 * n + 1; // a cell has an odd coordinate along each of its axes
  for(int z = 0; z < m; ++z)
    for(int y = 0; y < m; ++y)
      for(int x = 0; x < m; ++x) {
        bool is_part = false;
        for(int i = 0; i < 8; ++i) { // the voxels around: twice each that is the same
          const auto around = [](int c, bool upper) { return c % 2 == 1 ? c / 2 : c / 2 - !upper; };
          is_part = is_part || is_in(solid, around(x, i & 1), around(y, i & 2), around(z, i & 4));
        }
        sum += is_part * ((x + y + z) % 2 == 0 ? 1 : -1);
      }
  return sum;
}

void check(const Solid_topology& topology, const Solid& solid)
{
  const std::size_t bodies = number_of_components([&](int x, int y, int z) { return is_in(solid, x, y, z); });
  const std::size_t voids = number_of_components([&](int x, int y, int z) { return !is_in(solid, x, y, z); });
  BOOST_TEST_EQ(topology.number_of_bodies, bodies);
  BOOST_TEST_EQ(topology.number_of_cavities, voids - 1);
  BOOST_TEST_EQ(std::ptrdiff_t(bodies + voids - 1) - std::ptrdiff_t(topology.number_of_handles),
                euler_characteristic(solid));
  BOOST_TEST_EQ(topology.euler_characteristic(), 2 * euler_characteristic(solid));
  double volume = 0;
  for(int z = 0; z < n; ++z)
    for(int y = 0; y < n; ++y)
      for(int x = 0; x < n; ++x)
        volume += solid(x, y, z);
  BOOST_TEST(std::abs(topology.volume - volume) < 1e-9 * volume);
}

struct Expected
{
  Kind kind;
  std::string begin;                  // beginning of the sentence
  std::array<double, 3> lower, upper; // box that contains the point
};

// Compares a mesh of `wrong` with the surface of `right`; right meshes have no difference.
void compare(const Solid& right, const Solid& wrong, const std::vector<Expected>& expected)
{
  const Surface surface = surface_of(right);
  const Solid_comparison same = compare_with_surface(mesh_of(right), surface);
  BOOST_TEST(same.differences.empty());
  BOOST_TEST(same.has_same_topology() && same.mesh.has_same_topology(same.surface));
  BOOST_TEST(status_of(same) == Status::SUCCESS);
  check(same.mesh, right);
  check(same.surface, right);
  BOOST_TEST(compare_with_surface(mesh_of(wrong), surface_of(wrong)).differences.empty());

  const Solid_comparison c = compare_with_surface(mesh_of(wrong), surface);
  check(c.mesh, wrong);
  check(c.surface, right);
  BOOST_TEST_EQ(c.differences.size(), expected.size());
  bool is_topology = false;
  for(std::size_t i = 0; i < expected.size() && i < c.differences.size(); ++i) {
    const Solid_difference& d = c.differences[i];
    const Expected& e = expected[i];
    is_topology = is_topology || e.kind != Kind::VOLUME;
    BOOST_TEST(d.kind == e.kind);
    BOOST_TEST_EQ(d.sentence.substr(0, e.begin.size()), e.begin);
    for(int k = 0; k < 3; ++k)
      BOOST_TEST(e.lower[std::size_t(k)] <= d.point[k] && d.point[k] <= e.upper[std::size_t(k)]);
  }
  BOOST_TEST_EQ(c.has_same_topology(), !is_topology);
  BOOST_TEST(status_of(c)
             == (is_topology        ? Status::TOPOLOGY_DIFFERS
                 : expected.empty() ? Status::SUCCESS
                                    : Status::VOLUME_DIFFERS));
}

const Solid large = block({1, 1, 1}, {6, 6, 6}), small = block({8, 2, 2}, {11, 5, 5});
const Solid both = large + small;
const Solid bridge = block({6, 3, 3}, {8, 4, 4});

void test_bodies()
{
  compare(both, both + bridge,
          {{Kind::BODIES_JOINED, "2 bodies are joined near (7, ", {6, 2, 2}, {8, 5, 5}}});
  compare(both + bridge, both,
          {{Kind::BODY_SPLIT, "a body falls into 2 pieces near (7, ", {6, 2, 2}, {8, 5, 5}}});
  compare(
    both, large,
    {{Kind::BODY_MISSING, "a piece of volume 27 cubic units near (9.", {8, 2, 2}, {11, 5, 5}},
     {Kind::VOLUME, "the volume of all bodies is 17.8 % less, for example near (", {8, 2, 2}, {11, 5, 5}}});
  compare(large, both,
          {{Kind::BODY_ADDED, "a piece of volume 27 cubic units near (9.", {8, 2, 2}, {11, 5, 5}},
           {Kind::VOLUME, "the volume of all bodies is 21.6 % more", {8, 2, 2}, {11, 5, 5}}});
  // The numbers are the same, but the bodies are not.
  const Solid two = block({1, 1, 1}, {6, 4, 4}) + block({1, 8, 8}, {6, 11, 11});
  const Solid halves = block({1, 1, 1}, {3, 4, 4}) + block({4, 1, 1}, {6, 4, 4});
  compare(two, halves,
          {{Kind::BODY_MISSING, "a piece of volume 45 cubic units ", {1, 8, 8}, {6, 11, 11}},
           {Kind::BODY_SPLIT, "a body falls into 2 pieces ", {3, 1, 1}, {4, 4, 4}},
           {Kind::VOLUME, "the volume of all bodies is 60 % less", {1, 1, 1}, {6, 11, 11}},
           {Kind::VOLUME, "a body near (3.5, ", {3, 1, 1}, {4, 4, 4}}});
}

void test_cavities()
{
  const Solid outer = block({1, 1, 1}, {11, 11, 11});
  const Solid hole = block({2, 2, 2}, {4, 5, 4}), other_hole = block({6, 2, 2}, {9, 5, 5});
  const Solid shell = outer - hole - other_hole;
  compare(shell, outer - other_hole,
          {{Kind::CAVITY_FILLED, "a cavity of volume 12 cubic units near (", {2, 2, 2}, {4, 5, 4}}});
  compare(outer - other_hole, shell,
          {{Kind::CAVITY_ADDED, "a cavity of volume 12 cubic units near (", {2, 2, 2}, {4, 5, 4}}});
  compare(shell, shell - block({2, 3, 1}, {3, 4, 2}),
          {{Kind::CAVITY_OPENED, "a cavity of volume 12 cubic units near (", {2, 2, 2}, {4, 5, 4}}});
  compare(shell, shell - block({4, 3, 2}, {6, 4, 3}),
          {{Kind::CAVITIES_JOINED, "2 cavities are joined near (5, ", {4, 2, 2}, {6, 5, 4}},
           {Kind::VOLUME, "a cavity near (5", {4, 3, 2}, {6, 4, 3}}});
  compare(shell - block({4, 3, 2}, {6, 4, 3}), shell,
          {{Kind::CAVITY_SPLIT, "a cavity falls into 2 pieces near (5, ", {4, 2, 2}, {6, 5, 4}}});
  // A body within a cavity.
  const Solid room = outer - block({2, 2, 2}, {10, 10, 10}), kernel = block({4, 4, 4}, {8, 8, 8});
  compare(room + kernel, room,
          {{Kind::BODY_MISSING, "a piece of volume 64 cubic units near (", {4, 4, 4}, {8, 8, 8}},
           {Kind::VOLUME, "the volume of all bodies is 11.6 % less", {4, 4, 4}, {8, 8, 8}},
           {Kind::VOLUME, "a cavity ", {4, 4, 4}, {8, 8, 8}}});
}

void test_handles()
{
  const Solid plate = block({1, 1, 1}, {11, 11, 3});
  const Solid hole = block({3, 3, 1}, {4, 4, 3}), other_hole = block({6, 6, 1}, {8, 8, 3}),
              third_hole = block({9, 3, 1}, {10, 4, 3});
  const Solid riddled = plate - hole - other_hole - third_hole;
  compare(riddled, riddled, {});
  compare(riddled, riddled + hole, {{Kind::HANDLES_LOST, "1 handle is lost near (3.", {3, 3, 1}, {4, 4, 3}}});
  compare(riddled + other_hole, riddled,
          {{Kind::HANDLES_ADDED, "1 handle is added near (", {6, 6, 1}, {8, 8, 3}}});
  compare(riddled, plate,
          {{Kind::HANDLES_LOST, "3 handles are lost near (", {3, 3, 1}, {10, 8, 3}},
           {Kind::VOLUME, "a body near (", {3, 3, 1}, {10, 8, 3}}});
  // The ring is cut.
  const Solid ring = plate - block({3, 3, 1}, {9, 9, 3}), cut = block({1, 5, 1}, {3, 7, 3});
  compare(ring, ring - cut,
          {{Kind::HANDLES_LOST, "1 handle is lost near (", {1, 5, 1}, {3, 7, 3}},
           {Kind::VOLUME, "a body near (", {1, 5, 1}, {3, 7, 3}}});
  // The ring is filled.
  compare(ring, plate,
          {{Kind::HANDLES_LOST, "1 handle is lost near (", {3, 3, 1}, {9, 9, 3}},
           {Kind::VOLUME, "a body near (", {3, 3, 1}, {9, 9, 3}}});
}

void test_volume()
{
  const Solid block_10 = block({1, 1, 1}, {11, 11, 11});
  compare(block_10, block_10 - block({10, 1, 1}, {11, 11, 5}), {}); // 4 %
  compare(block_10, block_10 - block({10, 1, 1}, {11, 11, 8}),      // 7 %
          {{Kind::VOLUME, "a body near (10.", {10, 1, 1}, {11, 11, 8}}});
  const Mesh thinner = mesh_of(block_10 - block({10, 1, 1}, {11, 11, 8}));
  const auto differences = compare_with_surface(thinner, surface_of(block_10)).differences;
  BOOST_TEST(!differences.empty()
             && differences[0].sentence.find(" has 7 % less volume") != std::string::npos);
  BOOST_TEST(compare_with_surface(thinner, surface_of(block_10), 0.08).differences.empty());
}

// Solids that are not of voxels: round, turned, far from the origin, with faces oriented inwards; and a
// surface with corners of two shells in a common point.
void test_placements()
{
  const auto moved = [](const Point_3& p) {
    return Point_3(1e4 + 0.8 * p.x() - 0.6 * p.y(), 0.6 * p.x() + 0.8 * p.y(), 1e-3 * p.z());
  };
  Surface surface = transformed(surface_of(both), moved);
  CGAL::Polygon_mesh_processing::reverse_face_orientations(surface);
  const auto turned = [&](const Solid& solid) {
    Mesh mesh = mesh_of(solid);
    std::vector<Point_3> points;
    for(const auto& p : mesh.points())
      points.push_back(moved(p));
    Mesh result;
    result.assign(points, mesh.elements(), std::vector<Element_attributes>(mesh.number_of_elements()));
    return result;
  };
  BOOST_TEST(compare_with_surface(turned(both), surface).differences.empty());
  const auto joined = compare_with_surface(turned(both + bridge), surface).differences;
  BOOST_TEST(joined.size() == 1 && joined[0].kind == Kind::BODIES_JOINED);

  Surface corner;
  for(const auto& from : {Point_3(1, 1, 1), Point_3(4, 4, 4)})
    add_box(corner, from, from + Kernel::Vector_3(3, 3, 3));
  const auto apart = compare_with_surface(mesh_of(block({1, 1, 1}, {4, 4, 4})), corner);
  BOOST_TEST(apart.surface.number_of_bodies == 2 && apart.differences.size() == 2
             && apart.differences[0].kind == Kind::BODY_MISSING);
}

// Meshes that make_mixed_mesh_3() makes of two balls: one that is too coarse for the gap, and one that is
// not.
void test_balls()
{
  Surface balls = sphere({0, 0, 0}, 1, 16);
  add_sphere(balls, {2.35, 0, 0}, 1, 16);
  const Polyhedral_mixed_mesh_domain_3 domain(balls);
  for(int level : {3, 5}) {
    Mesh mesh;
    const auto result = make_mixed_mesh_3(domain, CGAL::Everywhere_mixed_mesh_region_3(),
                                          Mixed_mesh_criteria_3(level == 3 ? 600 : 8000).base_level(level),
                                          mesh);
    BOOST_TEST(result.has_mesh());
    const Solid_comparison c = compare_with_surface(mesh, balls);
    BOOST_TEST_EQ(c.surface.number_of_bodies, 2u);
    if(level == 3) {
      BOOST_TEST_EQ(c.mesh.number_of_bodies, 1u);
      BOOST_TEST(!c.differences.empty() && c.differences[0].kind == Kind::BODIES_JOINED);
      BOOST_TEST(std::abs(c.differences[0].point.x() - 1.175) < 0.1);
    } else {
      BOOST_TEST_EQ(c.mesh.number_of_bodies, 2u);
      BOOST_TEST(c.has_same_topology());
      BOOST_TEST_LT(std::abs(c.ratio_of_volumes() - 1), 0.05);
    }
  }
}

int run(int, char*[])
{
  test_bodies();
  test_cavities();
  test_handles();
  test_volume();
  test_placements();
  test_balls();
  return boost::report_errors();
}

} // namespace test_fidelity
