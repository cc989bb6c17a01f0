// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The solid that triangles enclose: boxes and others that overlap, touch and cut each other, of known
// volumes; holes that are filled.

#include <CGAL/Mixed_mesh_3/internal/repair/Solid_reading.h>
#include <CGAL/Mixed_mesh_3/internal/repair/fill_holes.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <boost/core/lightweight_test.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace test_repair {

using namespace CGAL::Mixed_meshes_3::internal;
using CGAL::Mixed_meshes_3::Vec3;
using Point = Solid_reading::Point;
using Triangle = std::array<std::size_t, 3>;

struct Soup
{
  std::vector<Point> points;
  std::vector<Triangle> triangles;

  Soup& add(const Soup& other)
  {
    for(Triangle t : other.triangles) {
      for(std::size_t& v : t)
        v += points.size();
      triangles.push_back(t);
    }
    points.insert(points.end(), other.points.begin(), other.points.end());
    return *this;
  }
};

// A box from one corner to the opposite one.
Soup box(const Vec3& low, const Vec3& high)
{
  Soup soup;
  for(int v = 0; v < 8; ++v)
    soup.points.emplace_back(v & 1 ? high[0] : low[0], v & 2 ? high[1] : low[1], v & 4 ? high[2] : low[2]);
  for(const auto& q : std::vector<std::array<std::size_t, 4>>{
        {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    soup.triangles.push_back({q[0], q[1], q[2]});
    soup.triangles.push_back({q[0], q[2], q[3]});
  }
  return soup;
}

Soup cube(double x = 0, double y = 0, double z = 0) { return box({x, y, z}, {x + 1, y + 1, z + 1}); }

Soup reversed(Soup soup)
{
  for(Triangle& t : soup.triangles)
    std::swap(t[1], t[2]);
  return soup;
}

// The soup turned, such that nothing is parallel to an axis.
Soup turned(Soup soup, double angle = 0.3)
{
  for(Point& p : soup.points) {
    double x[3] = {p.x(), p.y(), p.z()};
    for(int k = 0; k < 3; ++k) {
      const double a = x[k], b = x[(k + 1) % 3], c = std::cos(angle + k), s = std::sin(angle + k);
      x[k] = c * a - s * b;
      x[(k + 1) % 3] = s * a + c * b;
    }
    p = Point(x[0], x[1], x[2]);
  }
  return soup;
}

Vec3 vec(const Point& p) { return {p.x(), p.y(), p.z()}; }

double volume(const std::vector<Point>& points, const std::vector<Triangle>& triangles)
{
  double sum = 0;
  for(const Triangle& t : triangles)
    sum += determinant(vec(points[t[0]]), vec(points[t[1]]), vec(points[t[2]])) / 6;
  return sum;
}

// Whether each edge is there once in each direction: closed, oriented, and a manifold at edges.
bool is_closed(const std::vector<Triangle>& triangles)
{
  std::set<std::pair<std::size_t, std::size_t>> edges;
  for(const Triangle& t : triangles)
    for(std::size_t i = 0; i < 3; ++i)
      if(!edges.insert({t[i], t[(i + 1) % 3]}).second)
        return false;
  for(const auto& [a, b] : edges)
    if(edges.count({b, a}) == 0)
      return false;
  return true;
}

Solid_reading encloses(const Soup& soup, double expected, Solid_rule rule = Solid_rule::WINDING)
{
  const Solid_reading r = read_solid(soup.points, soup.triangles);
  BOOST_TEST(r.is_complete);
  BOOST_TEST(is_closed(r.triangles));
  BOOST_TEST(r.rule == rule);
  BOOST_TEST_LE(std::abs(volume(r.points, r.triangles) - expected), 1e-13 * (1 + std::abs(expected)));
  return r;
}

void test_unions()
{
  encloses(cube(), 1);
  encloses(cube().add(cube(3)), 2);
  encloses(cube().add(cube(0.5, 0.25, 0.125)), 2 - 0.5 * 0.75 * 0.875);
  encloses(turned(cube().add(cube(0.5, 0.25, 0.125))), 2 - 0.5 * 0.75 * 0.875);
  // The boxes have faces in one plane; all of a face; the same box twice.
  encloses(cube().add(cube(0.5)), 1.5);
  encloses(turned(cube().add(cube(0.5, 0.5))), 2 - 0.25);
  encloses(cube().add(cube(1)), 2);
  encloses(cube().add(cube()), 1);
  encloses(box({0, 0, 0}, {2, 2, 2}).add(cube(0, 0, 2)), 9);
  // There are three cubes, of which no two are sufficient.
  encloses(cube().add(cube(0.5)).add(cube(0.75, 0.5, 0.5)), 1.5 + 1 - 0.75 * 0.5 * 0.5);
  // The cubes are a row of twelve.
  Soup row;
  for(int i = 0; i < 12; ++i)
    row.add(cube(0.75 * i, 0.0625 * i, 0));
  encloses(row, 1 + 11 * (1 - 0.25 * 0.9375));
}

// A box with each face split by either of its diagonals; bit k of `diagonals` is for face k.
Soup box_by_diagonals(const Vec3& low, const Vec3& high, int diagonals)
{
  Soup soup = box(low, high);
  for(std::size_t k = 0; k < 6; ++k)
    if(diagonals >> k & 1) {
      const Triangle s = soup.triangles[2 * k], t = soup.triangles[2 * k + 1];
      soup.triangles[2 * k] = {s[0], s[1], t[2]};
      soup.triangles[2 * k + 1] = {s[1], s[2], t[2]};
    }
  return soup;
}

// The soup with the point (x, y, z) mapped to (y, z, x), several times.
Soup cycled(Soup soup, int times)
{
  for(; times > 0; --times)
    for(Point& p : soup.points)
      p = Point(p.y(), p.z(), p.x());
  return soup;
}

// Overlapping faces in one plane are both cut in the same way, even into pieces with corners on a circle.
void test_overlapping_faces()
{
  const int none = 0, all = 63;
  for(int axis = 0; axis < 3; ++axis)
    for(int of_a : {none, all})
      for(int of_b : {none, all}) {
        const auto touching = [&](const Vec3& low, const Vec3& high, bool is_reversed) {
          const Soup a = box_by_diagonals({0, 0, 0}, {1, 1, 1}, of_a), b = box_by_diagonals(low, high, of_b);
          return cycled(is_reversed ? Soup(b).add(a) : Soup(a).add(b), axis);
        };
        for(bool is_reversed : {false, true}) {
          // The numbers 0.3 and 0.7 do not sum to 1: a sliver of 1e-17, an isosceles trapezoid.
          encloses(touching({1, 0.3, 0.3}, {2, 0.7, 0.7}, is_reversed), 1.16);
          encloses(touching({-1, 0.3, 0.3}, {0, 0.7, 0.7}, is_reversed), 1.16);
          // The faces are rectangles.
          encloses(touching({1, -0.5, -0.5}, {2, 0.25, 0.25}, is_reversed), 1 + 0.75 * 0.75);
          encloses(touching({1, 0.5, 0.25}, {2, 1.5, 1.25}, is_reversed), 2);
          encloses(touching({0.5, 0.5, 0}, {2, 1.5, 1}, is_reversed), 1 + 1.5 - 0.25);
          encloses(turned(touching({1, 0.5, 0.25}, {2, 1.5, 1.25}, is_reversed)), 2);
        }
      }
}

void test_cavities()
{
  // The inner box is a cavity if inwards; solid in solid if outwards.
  const Soup large = box({0, 0, 0}, {4, 4, 4});
  encloses(Soup(large).add(reversed(cube(1, 1, 1))), 63);
  encloses(Soup(large).add(cube(1, 1, 1)), 64);
  // Two cavities overlap, and another body covers one.
  encloses(Soup(large).add(reversed(cube(1, 1, 1))).add(reversed(cube(1.5, 1, 1))), 64 - 1.5);
  encloses(Soup(large).add(reversed(cube(1, 1, 1))).add(box({1, 1, 1}, {1.5, 2, 9})), 63.5 + 5 * 0.5);
  // A body that is only inside out is nothing.
  const Solid_reading r = encloses(Soup(large).add(reversed(cube(7, 7, 7))), 64);
  BOOST_TEST_LE(std::abs(r.inverted_volume - 1), 1e-14);
}

void test_nonmanifold()
{
  // The cubes have an edge and a corner in common: each cube has its own.
  for(const Soup& two : {cube().add(cube(1, 1, 0)), cube().add(cube(1, 1, 1))}) {
    const Solid_reading r = encloses(two, 2);
    BOOST_TEST_EQ(r.points.size(), 16u);
  }
  // There is a wall inside, and a fin outside.
  const Soup walled = cube().add(cube(1));
  Soup shared;
  {
    std::map<Point, std::size_t> index;
    std::set<std::set<std::size_t>> met;
    for(const Triangle& t : walled.triangles) {
      Triangle u;
      for(int i = 0; i < 3; ++i)
        u[std::size_t(i)] = index.emplace(walled.points[t[std::size_t(i)]], index.size()).first->second;
      if(met.insert({u[0], u[1], u[2]}).second)
        shared.triangles.push_back(u);
    }
    shared.points.resize(index.size());
    for(const auto& [p, i] : index)
      shared.points[i] = p;
  }
  BOOST_TEST_LE(shared.triangles.size(), 22u);
  encloses(shared, 2, Solid_rule::ENCLOSED);
  Soup fin = cube();
  fin.points.emplace_back(2, 2, 2);
  fin.triangles.push_back({0, 1, 8});
  encloses(fin, 1, Solid_rule::ENCLOSED);
  // The faces have any orientation.
  Soup mixed = cube();
  for(std::size_t t : {0, 3, 7})
    std::swap(mixed.triangles[t][0], mixed.triangles[t][1]);
  encloses(mixed, 1, Solid_rule::PARITY);
  // Nothing is enclosed.
  Soup open = cube();
  open.triangles.pop_back();
  BOOST_TEST(read_solid(open.points, open.triangles).triangles.empty());
  BOOST_TEST(read_solid({}, {}).triangles.empty());
}

// A vertex pulled through the opposite side: the part that is turned inside out does not count.
void test_fold()
{
  Soup soup = cube();
  soup.points[7] = Point(-0.5, -0.5, -0.5);
  const Solid_reading r = read_solid(soup.points, soup.triangles);
  BOOST_TEST(is_closed(r.triangles));
  BOOST_TEST_GT(r.inverted_volume, 0.01);
  // All windings together have the volume of the integral.
  BOOST_TEST_LE(std::abs(volume(r.points, r.triangles) - r.inverted_volume
                         - volume(soup.points, soup.triangles)),
                1e-13);
}

// A vertex on the edge of a neighbor that does not have the vertex; a face without area.
void test_cracks()
{
  Soup soup = cube();
  soup.points.emplace_back(0.5, 0, 0);
  soup.triangles[0] = {0, 2, 3};
  soup.triangles[1] = {0, 3, 8};
  soup.triangles.push_back({8, 3, 1});
  encloses(soup, 1, Solid_rule::WINDING);
  soup.triangles.push_back({0, 8, 1});
  encloses(soup, 1, Solid_rule::WINDING);
}

// A body that has an edge with itself in common, and is joined around both ends of the edge.
void test_edge_with_itself()
{
  // The soup has blocks of 3 x 3 x 1, without two at opposite corners of an edge in the middle.
  Soup soup;
  for(int x = 0; x < 4; ++x)
    for(int y = 0; y < 4; ++y)
      for(int z = 0; z < 3; ++z)
        if(z != 1 || !((x == 1 && y == 1) || (x == 2 && y == 2)))
          soup.add(cube(x, y, z));
  encloses(soup, 48 - 2);
}

void test_limit()
{
  const Soup soup = cube().add(cube(0.5, 0.25, 0.125));
  const Solid_reading r = read_solid(soup.points, soup.triangles, 3);
  BOOST_TEST(!r.is_complete);
  BOOST_TEST(r.triangles.empty());
}

void test_holes()
{
  // A face of a cube has others besides.
  Soup soup = box({0, 0, 0}, {1, 1, 2});
  soup.triangles.erase(soup.triangles.begin(), soup.triangles.begin() + 2);
  Hole_filling holes = fill_holes(soup.points, soup.triangles, 0.2);
  BOOST_TEST_EQ(holes.filled.size(), 1u);
  BOOST_TEST(holes.left.empty());
  BOOST_TEST_LE(std::abs(holes.filled[0].length - 4), 1e-14);
  BOOST_TEST_LE(std::abs(holes.filled[0].area - 1), 1e-14);
  encloses(soup, 2);
  // The two holes are too large together; a sheet is beside.
  soup = cube();
  soup.triangles.resize(8);
  soup.add(cube(5));
  holes = fill_holes(soup.points, soup.triangles, 0.2);
  BOOST_TEST_EQ(holes.left.size(), 2u);
  BOOST_TEST(holes.filled.empty());
  BOOST_TEST_LE(std::abs(holes.left[0].length - 4), 1e-14);
  soup = cube();
  soup.points.insert(soup.points.end(), {Point(3, 0, 0), Point(4, 0, 0), Point(3, 1, 0)});
  soup.triangles.push_back({8, 9, 10});
  holes = fill_holes(soup.points, soup.triangles, 0.2);
  BOOST_TEST(holes.left.empty() && holes.filled.empty());
  BOOST_TEST_EQ(holes.number_of_dropped_faces, 1u);
  encloses(soup, 1);
}

int run(int, char*[])
{
  test_unions();
  test_overlapping_faces();
  test_cavities();
  test_nonmanifold();
  test_fold();
  test_cracks();
  test_edge_with_itself();
  test_limit();
  test_holes();
  return boost::report_errors();
}

} // namespace test_repair
