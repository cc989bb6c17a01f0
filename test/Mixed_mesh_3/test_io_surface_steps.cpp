// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The steps from the faces of a file to a surface, each alone: edges and parts of polygons, faces that are
// taken, bodies that are separated, faces that cut each other, components that are oriented.

#include <CGAL/Mixed_mesh_3/IO/internal/surface/orient_components.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/separate_bodies.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/surface_crossings.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/take_faces.h>

#include <CGAL/Mixed_mesh_3/internal/elements/is_polygon_mesh.h>

#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace test_io_surface_steps {

using namespace CGAL::Mixed_meshes_3::IO::internal;
using CGAL::Mixed_meshes_3::IO::Surface_input;

std::mt19937 random_bits(11);

std::size_t random_below(std::size_t n) { return std::size_t(random_bits() % n); }
double random_coordinate() { return double(random_below(1000)) / 1000; }

// Whether random polygons are a mesh, beside CGAL's answer.
void test_is_polygon_mesh()
{
  std::array<int, 2> counts{};
  for(int i = 0; i < 20000; ++i) {
    const std::size_t number_of_points = 4 + random_below(4);
    Polygons polygons(1 + random_below(6));
    for(auto& polygon : polygons)
      for(std::size_t n = random_below(5) == 0 ? 4 : 3; polygon.size() < n;)
        if(const std::size_t v = random_below(number_of_points);
           random_below(20) == 0 || std::find(polygon.begin(), polygon.end(), v) == polygon.end())
          polygon.push_back(v);
    const bool is_mesh = CGAL::Polygon_mesh_processing::is_polygon_soup_a_polygon_mesh(polygons);
    BOOST_TEST_EQ(CGAL::Mixed_meshes_3::internal::is_polygon_mesh(polygons, number_of_points), is_mesh);
    ++counts[is_mesh];
  }
  BOOST_TEST_GE(std::min(counts[0], counts[1]), 1000);
}

// The triangles of a cube from a corner, with points of its own.
void add_cube(double x, double y, double z, double size, Points& points, Polygons& polygons,
              bool is_reversed = false)
{
  const std::size_t first = points.size();
  for(int v = 0; v < 8; ++v)
    points.emplace_back(x + size * (v & 1), y + size * (v >> 1 & 1), z + size * (v >> 2));
  for(const auto& q : std::vector<std::array<std::size_t, 4>>{
        {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
    for(std::size_t i = 1; i < 3; ++i) {
      polygons.push_back({first + q[0], first + q[i], first + q[i + 1]});
      if(is_reversed)
        std::reverse(polygons.back().begin(), polygons.back().end());
    }
}

Surface mesh_of(const Points& points, const Polygons& polygons)
{
  Surface mesh;
  std::vector<Surface::Vertex_index> vertices;
  for(const auto& p : points)
    vertices.push_back(mesh.add_vertex(p));
  for(const auto& t : polygons)
    BOOST_TEST(mesh.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]) != Surface::null_face());
  return mesh;
}

// Fans of a closed bipyramid, whose apex is moved, and whose equator winds once or twice: faces around a
// vertex with a flat fan meet only in what they share, and the search finds what CGAL finds.
void test_flat_fans()
{
  std::array<int, 2> flat{}, cut{};
  for(int i = 0; i < 2000; ++i) {
    const std::size_t n = 3 + random_below(6), turns = 1 + (n > 4 ? random_below(2) : 0);
    Points points;
    for(std::size_t v = 0; v < n; ++v) {
      const double angle = 2 * M_PI * double(turns) * double(v) / double(n), r = 0.5 + random_coordinate();
      points.emplace_back(r * std::cos(angle), r * std::sin(angle), random_coordinate());
    }
    points.emplace_back(random_coordinate() - 0.5, random_coordinate() - 0.5, 2 * random_coordinate());
    points.emplace_back(0, 0, -3);
    Polygons polygons;
    for(std::size_t v = 0; v < n; ++v) {
      polygons.push_back({v, (v + 1) % n, n});
      polygons.push_back({(v + 1) % n, v, n + 1});
    }
    const Surface mesh = mesh_of(points, polygons);
    std::vector<Face_pair> found;
    CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(found));
    BOOST_TEST_EQ(cuts_or_touches_itself(mesh), !found.empty());
    ++cut[!found.empty()];
    for(const auto v : vertices(mesh)) {
      const bool is_flat = is_flat_fan(v, mesh);
      ++flat[is_flat];
      const auto has_vertex = [&](Surface::Face_index f) {
        const auto& around = Triangle_view(f, mesh).vertices;
        return std::find(around.begin(), around.end(), v) != around.end();
      };
      for(const Face_pair& pair : found)
        BOOST_TEST(!is_flat || !has_vertex(pair.first) || !has_vertex(pair.second));
    }
  }
  for(int k = 0; k < 2; ++k) {
    BOOST_TEST_GE(flat[k], 500);
    BOOST_TEST_GE(cut[k], 200);
  }
}

// Counts of edges and connected parts of random triangles, beside maps and a search from each triangle.
void test_edges_and_parts()
{
  for(int trial = 0; trial < 100; ++trial) {
    Polygons polygons;
    for(std::size_t n = 1 + random_below(30); n > 0; --n) {
      std::set<std::size_t> corners;
      while(corners.size() < 3)
        corners.insert(random_below(12));
      polygons.emplace_back(corners.begin(), corners.end());
      std::shuffle(polygons.back().begin(), polygons.back().end(), random_bits);
    }
    std::map<std::pair<std::size_t, std::size_t>, std::vector<bool>> directions;
    for(const auto& t : polygons)
      for(std::size_t i = 0; i < 3; ++i)
        directions[std::minmax(t[i], t[(i + 1) % 3])].push_back(t[i] < t[(i + 1) % 3]);
    Edge_counts expected;
    for(const auto& [edge, d] : directions) {
      expected.open += d.size() == 1;
      expected.nonmanifold += d.size() > 2;
      expected.is_oriented = expected.is_oriented && !(d.size() == 2 && d[0] == d[1]);
    }
    const Edge_counts counts = count_edges(polygons);
    BOOST_TEST_EQ(counts.open, expected.open);
    BOOST_TEST_EQ(counts.nonmanifold, expected.nonmanifold);
    BOOST_TEST_EQ(counts.is_oriented, expected.is_oriented);

    const Edge_polygons edges = edges_of(polygons);
    for(std::size_t most : {std::size_t(2), std::size_t(-1)}) {
      std::vector<std::size_t> part, expected_part(polygons.size(), std::size_t(-1));
      const std::size_t number = find_parts(polygons, edges, most, part);
      std::size_t last = 0;
      for(std::size_t f = 0; f < polygons.size(); ++f) {
        if(expected_part[f] != std::size_t(-1))
          continue;
        std::vector<std::size_t> reached{f};
        expected_part[f] = last;
        while(!reached.empty()) {
          const std::size_t g = reached.back();
          reached.pop_back();
          for(const auto& [edge, around] : edges)
            if(around.size() <= most && std::find(around.begin(), around.end(), g) != around.end())
              for(std::size_t h : around)
                if(expected_part[h] == std::size_t(-1)) {
                  expected_part[h] = last;
                  reached.push_back(h);
                }
        }
        ++last;
      }
      BOOST_TEST_EQ(number, last);
      BOOST_TEST(part == expected_part);
    }
  }
}

// A cube of separate triangles, with a face twice, one with a vertex twice, and a point that nothing uses.
void test_taken_faces()
{
  Points points, taken_points;
  Polygons polygons, taken;
  add_cube(0, 0, 0, 1, points, polygons);
  Surface_soup soup;
  for(const auto& t : polygons) {
    soup.polygons.emplace_back();
    for(std::size_t v : t) {
      soup.polygons.back().push_back(soup.points.size());
      soup.points.push_back(CGAL::Mixed_meshes_3::to_vec3(points[v]));
    }
  }
  soup.polygons.push_back({2, 1, 0}); // the first one, seen from behind
  soup.polygons.push_back({3, 3, 4});
  soup.points.push_back({9, 9, 9});
  Surface_input input;
  take_faces("soup", {}, soup, taken_points, taken, input);
  BOOST_TEST_EQ(taken_points.size(), 8u);
  BOOST_TEST_EQ(taken.size(), 12u);
  BOOST_TEST_EQ(count_edges(taken).open, 0u);
  BOOST_TEST_EQ(input.number_of_points, 37u);
  BOOST_TEST_EQ(input.number_of_polygons, 14u);
  BOOST_TEST_EQ(input.warnings.size(), 4u);
}

// Cubes with an edge in common get vertices of their own there; a face that only stands out does not.
void test_separate_bodies()
{
  Points points;
  Polygons polygons;
  add_cube(0, 0, 0, 1, points, polygons);
  add_cube(1, 1, 0, 1, points, polygons);
  const Points apart = points;
  for(auto& polygon : polygons) // the edge of the second cube becomes that of the first
    for(std::size_t& v : polygon)
      v = v == 8 ? 3 : v == 12 ? 7 : v;
  BOOST_TEST_EQ(count_edges(polygons).nonmanifold, 1u);
  Points separated = points;
  Polygons bodies = polygons;
  separate_bodies(separated, bodies);
  BOOST_TEST_EQ(count_edges(bodies).nonmanifold, 0u);
  BOOST_TEST_EQ(count_edges(bodies).open, 0u);
  BOOST_TEST_EQ(separated.size(), apart.size() + 2); // those of index 8 and 12 are not used any more
  for(std::size_t f = 0; f < bodies.size(); ++f)
    for(std::size_t i = 0; i < 3; ++i)
      BOOST_TEST(separated[bodies[f][i]] == points[polygons[f][i]]);

  polygons.resize(12);
  points.emplace_back(2, 2, 2);
  polygons.push_back({3, 7, points.size() - 1});
  const Polygons before = polygons;
  separate_bodies(points, polygons);
  BOOST_TEST(polygons == before);
}

// Pairs of faces of two random tetrahedra that cut each other, beside all pairs with exact constructions.
void test_crossings()
{
  using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
  std::size_t number = 0;
  for(int trial = 0; trial < 200; ++trial) {
    Points points;
    for(int i = 0; i < 8; ++i)
      points.emplace_back(random_coordinate(), random_coordinate(), random_coordinate());
    Polygons polygons;
    for(std::size_t first : {0u, 4u}) {
      if(CGAL::orientation(points[first], points[first + 1], points[first + 2], points[first + 3])
         == CGAL::COPLANAR)
        points[first + 3] = Surface::Point(2, 2, double(2 + first));
      for(const auto& t : std::vector<std::array<std::size_t, 3>>{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}})
        polygons.push_back({first + t[0], first + t[1], first + t[2]});
    }
    const Surface mesh = mesh_of(points, polygons);
    std::set<std::pair<std::size_t, std::size_t>> expected, found;
    const auto exact = [&](const std::vector<std::size_t>& t) {
      const auto point = [&](std::size_t v) {
        return Exact::Point_3(points[v].x(), points[v].y(), points[v].z());
      };
      return Exact::Triangle_3(point(t[0]), point(t[1]), point(t[2]));
    };
    for(std::size_t f = 0; f < 4; ++f)
      for(std::size_t g = 4; g < 8; ++g)
        if(CGAL::do_intersect(exact(polygons[f]), exact(polygons[g])))
          expected.insert({f, g});
    for(const Face_pair& pair : self_intersections(mesh))
      found.insert(std::minmax(std::size_t(pair.first), std::size_t(pair.second)));
    BOOST_TEST(found == expected);
    number += found.size();
  }
  BOOST_TEST_GT(number, 200u);
}

// Two wedges at a common edge: side by side, they touch; with one between the faces of the other, or with one
// face there, they go through each other at the edge.
void test_crossings_at_edges()
{
  const auto wedges = [](std::array<double, 4> angles) { // of the faces of both, around the axis z
    Points points;
    Polygons polygons;
    for(int w = 0; w < 2; ++w) {
      const std::size_t first = points.size();
      points.emplace_back(0, 0, 0);
      points.emplace_back(0, 0, 1);
      for(int i = 0; i < 2; ++i)
        points.emplace_back(std::cos(angles[2 * w + i]), std::sin(angles[2 * w + i]), w == 0 ? 0.5 : 0.25);
      for(const auto& t : std::vector<std::array<std::size_t, 3>>{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}})
        polygons.push_back({first + t[0], first + t[1], first + t[2]});
    }
    return crossings_at_edges(mesh_of(points, polygons)).size();
  };
  BOOST_TEST_EQ(wedges({0, 1, 2, 3}), 0u);
  BOOST_TEST_EQ(wedges({0, 2, 0.5, 1.5}), 0u); // one in the other
  BOOST_TEST_EQ(wedges({0, 1, 0.5, 2}), 1u);
  BOOST_TEST_EQ(wedges({0.5, 2, 0, 1}), 1u);
}

// Three cubes in each other, and one beside them, in all orientations: the second one is a cavity.
void test_orientation()
{
  for(int orientations = 0; orientations < 16; ++orientations) {
    Points points;
    Polygons polygons;
    const auto is_reversed = [orientations](int i) { return (orientations >> i & 1) != 0; };
    for(int i = 0; i < 3; ++i)
      add_cube(i, i, i, 9 - 2 * i, points, polygons, is_reversed(i));
    add_cube(20, 0, 0, 2, points, polygons, is_reversed(3));
    Surface mesh = mesh_of(points, polygons);
    const Component_counts counts = orient_components(mesh);
    BOOST_TEST_EQ(counts.all, 4u);
    BOOST_TEST_EQ(counts.cavities, 1u);
    std::size_t reversed = 0;
    for(int i = 0; i < 4; ++i)
      reversed += is_reversed(i) != (i == 1);
    BOOST_TEST_EQ(counts.reversed, reversed);
    BOOST_TEST_LE(std::abs(enclosed_volume(mesh) - (9. * 9 * 9 - 7 * 7 * 7 + 5 * 5 * 5 + 8)), 1e-9);
  }
}

int run(int, char*[])
{
  test_edges_and_parts();
  test_taken_faces();
  test_separate_bodies();
  test_crossings();
  test_crossings_at_edges();
  test_orientation();
  test_is_polygon_mesh();
  test_flat_fans();
  return boost::report_errors();
}

} // namespace test_io_surface_steps
