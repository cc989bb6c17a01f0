// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Queries on a surface, compared with brute force over its triangles.

#include "test_surfaces.h"

#include <CGAL/Mixed_mesh_3/Octree_cell_traits_3.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Octree.h>
#include <CGAL/Mixed_mesh_3/internal/surface/Triangle_tree.h>
#include <CGAL/Mixed_mesh_regions_3.h>
#include <CGAL/Polyhedral_mixed_mesh_region_3.h>
#include <CGAL/Polyhedral_mixed_mesh_domain_3.h>

#include <CGAL/Exact_rational.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Simple_cartesian.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <type_traits>
#include <utility>
#include <vector>

namespace test_surface {

using namespace CGAL::Mixed_meshes_3;
using CGAL::Bbox_3;
using CGAL::Bounded_side;
using CGAL::Polyhedral_mixed_mesh_domain_3;
using CGAL::Mixed_meshes_3::internal::Octree;

using Kernel = Predicates_kernel;
using Point_3 = Kernel::Point_3;
using Triangle_3 = Kernel::Triangle_3;
using Surface = CGAL::Surface_mesh<Point_3>;
using Aligned_traits = Axis_aligned_octree_cell_traits_3;
using Rotated_traits = Rotated_octree_cell_traits_3;

void add_box(Surface& s, const Bbox_3& b)
{
  ::add_box(s, {b.xmin(), b.ymin(), b.zmin()}, {b.xmax(), b.ymax(), b.zmax()});
}

Bbox_3 bbox_of(const Surface& s) { return CGAL::bbox_3(s.points().begin(), s.points().end()); }

// ---- closest points of triangles ----------------------------------------------------------------

// The exact distance from a triangle that may have no area, rounded.
double distance_of(const Vec3& p, const std::array<Vec3, 3>& t)
{
  using Exact = CGAL::Simple_cartesian<CGAL::Exact_rational>;
  const auto exact = [](const Vec3& v) { return Exact::Point_3(v[0], v[1], v[2]); };
  const Exact::Point_3 x = exact(p), q[3] = {exact(t[0]), exact(t[1]), exact(t[2])};
  if(!CGAL::collinear(q[0], q[1], q[2]))
    return std::sqrt(CGAL::to_double(CGAL::squared_distance(x, Exact::Triangle_3(q[0], q[1], q[2]))));
  CGAL::Exact_rational least = CGAL::squared_distance(x, q[0]);
  for(std::size_t i = 0; i < 3; ++i)
    if(q[i] != q[(i + 1) % 3])
      least = (std::min)(least, CGAL::Exact_rational(
                                  CGAL::squared_distance(x, Exact::Segment_3(q[i], q[(i + 1) % 3]))));
  return std::sqrt(CGAL::to_double(least));
}

// Random triangles of all sizes, some without area, near the origin and far from it: the closest point of all
// is on the named triangle, and at the least distance, from anywhere, with any hint.
void test_triangle_tree()
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto vector = [&](double scale) {
    return scale * Vec3(uniform(random), uniform(random), uniform(random));
  };
  for(std::size_t number : {1, 3, 4, 5, 16, 17, 70})
    for(double offset : {0., 1000.}) {
      std::vector<std::array<Vec3, 3>> triangles;
      for(std::size_t i = 0; i < number; ++i) {
        const Vec3 center = Vec3(offset, -offset, offset) + vector(1);
        const double size = std::pow(10, -2 * (1 + uniform(random)));
        triangles.push_back({center, center + vector(size), center + vector(size)});
        if(i % 7 == 5)
          triangles.back()[2] = triangles.back()[i % 2];
        if(i % 7 == 6)
          triangles.back()[2] = 0.5 * (triangles.back()[0] + triangles.back()[1]);
      }
      const internal::Triangle_tree tree(triangles);
      const double accuracy = 1e-14 * (1 + offset);
      internal::Triangle_tree::Closest hint{triangles[0][0], 0};
      for(int i = 0; i < 60; ++i) {
        const Vec3 p = Vec3(offset, -offset, offset) + vector(i % 2 == 0 ? 1 : 4);
        double least = std::numeric_limits<double>::infinity();
        for(const auto& t : triangles)
          least = (std::min)(least, distance_of(p, t));
        for(const auto& found : {tree.closest(p), tree.closest(p, hint)}) {
          BOOST_TEST_LE(std::abs(norm(found.point - p) - least), accuracy);
          BOOST_TEST_LE(distance_of(found.point, triangles[found.triangle]), accuracy);
          BOOST_TEST(tree.closest(p, found.triangle).point == found.point
                     || norm(found.point - p) <= norm(tree.closest(p, found.triangle).point - p));
          hint = found;
        }
      }
    }
}

// ---- domain oracle -----------------------------------------------------------------------------

using Side_function = std::function<Bounded_side(const Point_3&)>;

std::size_t number_on_surface = 0, number_of_boundary_cells = 0;

template <class Traits>
void walk(const Polyhedral_mixed_mesh_domain_3& domain, const Surface& surface, const Traits& traits,
          const Side_function& side_of, int depth, const Lattice_point& corner, std::uint32_t side,
          const Polyhedral_mixed_mesh_domain_3::Surface_part& parent)
{
  const auto cell = traits.cell(corner, side);
  Polyhedral_mixed_mesh_domain_3::Surface_part part;
  const Bounded_side located = domain.locate(cell, parent, part);
  std::vector<std::uint32_t> met;
  for(auto f : faces(surface)) {
    const auto h = surface.halfedge(f);
    const Triangle_3 t(surface.point(surface.source(h)), surface.point(surface.target(h)),
                       surface.point(surface.target(surface.next(h))));
    if(cell.do_intersect(t))
      met.push_back(std::uint32_t(f));
  }
  BOOST_TEST_EQ(located, met.empty() ? side_of(cell.center()) : CGAL::ON_BOUNDARY);
  BOOST_TEST(part.facets == met);

  // The points are all that the stages ask for: corners, midpoints, centers, and some others.
  const std::uint32_t half = side / 2;
  for(std::uint32_t i = 0; i < 27; ++i) {
    const Point_3 p = traits.point(
      {corner[0] + i % 3 * half, corner[1] + i / 3 % 3 * half, corner[2] + i / 9 * half});
    const Bounded_side expected = side_of(p);
    number_on_surface += expected == CGAL::ON_BOUNDARY;
    BOOST_TEST_EQ(domain.bounded_side(p, part), expected);
    BOOST_TEST_EQ(domain.bounded_side(p), expected);
    if(i % 13 == 0) {
      const Point_3 q = domain.closest_point(p, part);
      double nearest = std::numeric_limits<double>::infinity();
      for(auto f : faces(surface)) {
        const auto h = surface.halfedge(f);
        const Triangle_3 t(surface.point(surface.source(h)), surface.point(surface.target(h)),
                           surface.point(surface.target(surface.next(h))));
        nearest = (std::min)(nearest, std::sqrt(CGAL::squared_distance(p, t)));
      }
      const double tolerance = 1e-12 * nearest + 1e-15 * std::sqrt((p - CGAL::ORIGIN).squared_length());
      BOOST_TEST_LE(std::abs(std::sqrt(CGAL::squared_distance(p, q)) - nearest), tolerance);
      const Point_3 without_hint = domain.closest_point(p, Polyhedral_mixed_mesh_domain_3::Surface_part());
      BOOST_TEST_LE(std::abs(std::sqrt(CGAL::squared_distance(p, without_hint)) - nearest), tolerance);
      // The hint is from elsewhere, or there is none.
      for(const Point_3& r :
          {domain.closest_point(p, surface.point(Surface::Vertex_index(i % 6))), domain.closest_point(p)})
        BOOST_TEST_LE(std::abs(std::sqrt(CGAL::squared_distance(p, r)) - nearest), tolerance);
    }
  }
  if(located != CGAL::ON_BOUNDARY)
    return;
  ++number_of_boundary_cells;
  if(depth > 0)
    for(std::uint32_t i = 0; i < 8; ++i)
      walk(domain, surface, traits, side_of, depth - 1,
           {corner[0] + (i & 1) * half, corner[1] + (i >> 1 & 1) * half, corner[2] + (i >> 2) * half}, half,
           part);
}

template <class Traits>
void test_oracle(const Surface& surface, const Traits& traits, const Side_function& side_of, int depth)
{
  const Polyhedral_mixed_mesh_domain_3 domain(surface);
  BOOST_TEST_EQ(domain.number_of_facets(), num_faces(surface));
  walk(domain, surface, traits, side_of, depth, {0, 0, 0}, Octree::root_side, domain.surface_part());
}

Bounded_side side_of_box(const Bbox_3& b, const Point_3& p)
{
  if(p.x() < b.xmin() || p.x() > b.xmax() || p.y() < b.ymin() || p.y() > b.ymax() || p.z() < b.zmin()
     || p.z() > b.zmax())
    return CGAL::ON_UNBOUNDED_SIDE;
  return p.x() == b.xmin() || p.x() == b.xmax() || p.y() == b.ymin() || p.y() == b.ymax() || p.z() == b.zmin()
             || p.z() == b.zmax()
           ? CGAL::ON_BOUNDARY
           : CGAL::ON_BOUNDED_SIDE;
}

void test_domain_oracle()
{
  // A box with a cavity, all facets on faces of cells: every query is degenerate. The sides are known without
  // CGAL.
  const Bbox_3 outer(0, 0, 0, 8, 8, 8), cavity(2, 2, 4, 6, 4, 6);
  Surface box;
  add_box(box, outer);
  add_box(box, cavity);
  const Side_function side_of_box_with_cavity = [&](const Point_3& p) {
    const Bounded_side a = side_of_box(outer, p), b = side_of_box(cavity, p);
    return a != CGAL::ON_BOUNDED_SIDE ? a : Bounded_side(-int(b));
  };
  test_oracle(box, Aligned_traits(bbox_of(box), Root_cell::BOX), side_of_box_with_cavity, 2);
  BOOST_TEST_GT(number_on_surface, 1000u);
  test_oracle(box, Aligned_traits(bbox_of(box), Root_cell::CUBE), side_of_box_with_cavity, 2);

  // An octahedron: its edges and vertices and the inside of its facets meet lattice points.
  Surface octahedron;
  add_sphere(octahedron, {1, 2, 3}, 2, 2);
  const std::size_t before = number_on_surface;
  test_oracle(
    octahedron, Aligned_traits(bbox_of(octahedron), Root_cell::BOX),
    [](const Point_3& p) {
      const double d = std::abs(p.x() - 1) + std::abs(p.y() - 2) + std::abs(p.z() - 3);
      return d < 2 ? CGAL::ON_BOUNDED_SIDE : d > 2 ? CGAL::ON_UNBOUNDED_SIDE : CGAL::ON_BOUNDARY;
    },
    3);
  BOOST_TEST_GT(number_on_surface, before + 1000);

  // A round surface, two components, rotated cells, far away and large: compared with CGAL.
  for(double offset : {0., 1e8}) {
    Surface spheres;
    add_sphere(spheres, {offset, 0, -offset}, 1000, 6);
    add_sphere(spheres, {offset + 2200, 100, -offset}, 900, 5);
    const CGAL::Side_of_triangle_mesh<Surface, Kernel> side_of(spheres);
    const auto ask = [&](const Point_3& p) { return side_of(p); };
    test_oracle(spheres, Aligned_traits(bbox_of(spheres)), ask, 2);
    test_oracle(spheres, Rotated_traits(spheres.points(), Kernel::Vector_3(1, -2, 0.5)), ask, 2);
  }
  BOOST_TEST_GT(number_of_boundary_cells, 300u);
}

// No point of the surface is far from all samples, and samples are on the surface.
void test_surface_samples()
{
  Surface thin; // long triangles
  add_box(thin, Bbox_3(0, 0, 0, 100, 1, 7));
  Surface sphere;
  add_sphere(sphere, {1, 2, 3}, 2, 12);
  std::mt19937 random(41);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::size_t last = 0;
  for(const Surface& surface : {thin, sphere}) {
    const Polyhedral_mixed_mesh_domain_3 domain(surface);
    for(double spacing : {1000., 3., 0.7}) {
      const std::vector<Point_3> samples = domain.surface_samples(spacing);
      for(const Point_3& p : samples)
        BOOST_TEST_LE(CGAL::squared_distance(p, domain.closest_point(p)), 1e-20);
      for(auto v : surface.vertices())
        BOOST_TEST(std::count(samples.begin(), samples.end(), surface.point(v)) == 1);
      double farthest = 0; // of all points, squared
      for(auto f : faces(surface))
        for(int i = 0; i < 40; ++i) {
          const auto h = surface.halfedge(f);
          const Point_3 a = surface.point(surface.source(h)), b = surface.point(surface.target(h)),
                        c = surface.point(surface.target(surface.next(h)));
          const double u = uniform(random), v = uniform(random) * (1 - u);
          const Point_3 p = a + u * (b - a) + v * (c - a);
          double nearest = std::numeric_limits<double>::infinity();
          for(const Point_3& q : samples)
            nearest = (std::min)(nearest, CGAL::squared_distance(p, q));
          farthest = (std::max)(farthest, nearest);
        }
      BOOST_TEST_LE(farthest, spacing * spacing);
      BOOST_TEST(spacing > 100 ? samples.size() == surface.number_of_vertices() : samples.size() >= last);
      BOOST_TEST(spacing > 1 || samples.size() > surface.number_of_vertices());
      last = samples.size();
    }
  }
}

// ---- moved domains -----------------------------------------------------------------------------

// The tree keeps the address of the surface: a move moves the owner of both.
template <class Oracle>
void test_moved()
{
  static_assert(std::is_nothrow_move_constructible_v<Oracle> && std::is_nothrow_move_assignable_v<Oracle>);
  static_assert(!std::is_copy_constructible_v<Oracle> && !std::is_copy_assignable_v<Oracle>);
  std::vector<Oracle> oracles;
  for(int i = 0; i < 5; ++i) { // the vector moves what it has; surfaces are copied
    const Surface surface = box({double(i), 0, 0}, {i + 1., 1, 1});
    oracles.push_back(Oracle(surface));
  }
  std::swap(oracles.front(), oracles.back());
  Oracle last = std::move(oracles.back());
  oracles.back() = std::move(last);
  for(std::size_t i = 0; i < 5; ++i) {
    const double x = i == 0 ? 4 : i == 4 ? 0 : double(i);
    BOOST_TEST(oracles[i].bbox() == Bbox_3(x, 0, 0, x + 1, 1, 1));
    BOOST_TEST_EQ(oracles[i].bounded_side(Point_3(x + 0.5, 0.5, 0.5)), CGAL::ON_BOUNDED_SIDE);
    BOOST_TEST_EQ(oracles[i].bounded_side(Point_3(x + 1.5, 0.5, 0.5)), CGAL::ON_UNBOUNDED_SIDE);
    BOOST_TEST(oracles[i].closest_point(Point_3(x + 0.5, 0.25, -1)) == Point_3(x + 0.5, 0.25, 0));
  }
}

// A union takes regions over, and can be moved itself.
void test_moved_union()
{
  using CGAL::Ball_mixed_mesh_region_3;
  using CGAL::Polyhedral_mixed_mesh_region_3;
  using Union = CGAL::Union_mixed_mesh_region_3<Polyhedral_mixed_mesh_region_3, Ball_mixed_mesh_region_3>;
  Polyhedral_mixed_mesh_region_3 cube(box({0, 0, 0}, {1, 1, 1}));
  Union first(std::move(cube), Ball_mixed_mesh_region_3({3, 0, 0}, 1));
  const Union second(std::move(first));
  BOOST_TEST_EQ(second.depth({0.5, 0.5, 0.5}), 0.5);
  BOOST_TEST_EQ(second.depth({3, 0, 0}), 1.);
  BOOST_TEST_LT(second.depth({1.5, 0, 0}), 0.);
}

// The region around a point, or near it, counts in which an error counts most; compared with brute force.
void test_weights_in_unions()
{
  using CGAL::Ball_mixed_mesh_region_3;
  using CGAL::Polyhedral_mixed_mesh_region_3;
  using CGAL::Weighted_mixed_mesh_region_3;
  const std::vector<std::pair<Surface, double>> boxes{{box({0, 0, 0}, {1, 1, 1}), 1},
                                                      {box({0.5, 0, 0}, {3, 1, 1}), 8},
                                                      {box({5, 0, 0}, {6, 1, 1}), 0.01}};
  CGAL::Polyhedral_mixed_mesh_regions_3 regions, equal;
  std::vector<std::shared_ptr<const Polyhedral_mixed_mesh_region_3>> parts;
  for(const auto& [surface, weight] : boxes) {
    parts.push_back(std::make_shared<const Polyhedral_mixed_mesh_region_3>(surface));
    regions.add(parts.back(), weight);
    equal.add(parts.back(), 3);
  }
  BOOST_TEST_EQ(regions.size(), 3u);
  // The union of three types is the same.
  const CGAL::Union_mixed_mesh_region_3 united(
    Polyhedral_mixed_mesh_region_3(boxes[0].first),
    Weighted_mixed_mesh_region_3(Polyhedral_mixed_mesh_region_3(boxes[1].first), 8),
    Weighted_mixed_mesh_region_3(Polyhedral_mixed_mesh_region_3(boxes[2].first),
                                 [](const Point_3&) { return 0.01; }));
  const auto falling = [](double depth, double reach) {
    return depth >= 0 ? 1 : reach == 0 ? 0 : std::pow(1 - depth / reach, -6);
  };
  std::size_t number_by_farther = 0;
  for(double reach : {0., 0.2, 5.})
    for(double x = -2; x < 8; x += 0.0703)
      for(double y : {0.5, 1.7}) {
        const Point_3 p(x, y, 0.4);
        double depth = -1e9, largest = 0, nearest = 0;
        for(std::size_t i = 0; i < parts.size(); ++i) {
          const double d = parts[i]->depth(p), w = boxes[i].second * falling(d, reach);
          nearest = d > depth ? w : nearest;
          depth = (std::max)(depth, d);
          largest = (std::max)(largest, w);
        }
        number_by_farther += largest > nearest;
        BOOST_TEST_EQ(regions.depth(p), depth);
        BOOST_TEST_EQ(united.depth(p), depth);
        for(double weight : {regions.weight(p, reach), united.weight(p, reach)})
          BOOST_TEST_LE(std::abs(weight * falling(depth, reach) - largest), 1e-12 * largest);
        BOOST_TEST_EQ(equal.weight(p, reach), 3.);
      }
  BOOST_TEST_GT(number_by_farther, 50u);
  BOOST_TEST_EQ(CGAL::Polyhedral_mixed_mesh_regions_3().depth({1, 2, 3}), 0.);
  BOOST_TEST_EQ(CGAL::Polyhedral_mixed_mesh_regions_3().weight({1, 2, 3}, 1), 1.);
}

int run(int, char*[])
{
  test_triangle_tree();
  test_domain_oracle();
  test_surface_samples();
  test_moved<Polyhedral_mixed_mesh_domain_3>();
  test_moved<CGAL::Polyhedral_mixed_mesh_region_3>();
  test_moved_union();
  test_weights_in_unions();
  return boost::report_errors();
}

} // namespace test_surface
