// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Parts of the octree: the cells of the lattice, compared with exact rationals; balance, by all pairs; the
// locations of cells of a located octree, by their boxes.

#include "test_lattice.h"

#include <CGAL/Mixed_mesh_3/internal/octree/balance.h>
#include <CGAL/Mixed_mesh_3/validation.h>

#include <CGAL/Exact_rational.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace test_octree_cells {

using namespace CGAL::Mixed_meshes_3;
using CGAL::Bbox_3;

using Kernel = Predicates_kernel;
using Point_3 = Kernel::Point_3;
using Triangle_3 = Kernel::Triangle_3;
using Rotated_traits = Rotated_octree_cell_traits_3;

// ---- cell traits -------------------------------------------------------------------------------

using Exact = CGAL::Exact_rational;
using Exact_vector = std::array<Exact, 3>;

Exact_vector exact(const Point_3& p) { return {Exact(p.x()), Exact(p.y()), Exact(p.z())}; }
Exact_vector operator-(const Exact_vector& a, const Exact_vector& b)
{
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Exact dot(const Exact_vector& a, const Exact_vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// The lattice as an affine frame, in rationals: an origin and the images of the unit vectors.
struct Frame
{
  Exact_vector origin;
  std::array<Exact_vector, 3> units;

  template <class Traits>
  explicit Frame(const Traits& traits) : origin(exact(traits.point({0, 0, 0})))
  {
    units[0] = exact(traits.point({1, 0, 0})) - origin;
    units[1] = exact(traits.point({0, 1, 0})) - origin;
    units[2] = exact(traits.point({0, 0, 1})) - origin;
  }

  // Lattice coordinates of any point; the frame is orthogonal.
  Exact_vector coordinates(const Exact_vector& p) const
  {
    Exact_vector c;
    for(int k = 0; k < 3; ++k)
      c[k] = dot(p - origin, units[k]) / dot(units[k], units[k]);
    return c;
  }
};

// Whether the closed triangle meets the closed cell: clips it, in rationals.
bool exactly_intersect(const Frame& frame, const Lattice_point& corner, std::uint32_t side,
                       const Triangle_3& t)
{
  std::vector<Exact_vector> polygon;
  for(int i = 0; i < 3; ++i)
    polygon.push_back(frame.coordinates(exact(t[i])));
  for(int k = 0; k < 3; ++k)
    for(int sign : {1, -1}) {
      const Exact bound = sign > 0 ? Exact(corner[k]) : Exact(corner[k] + side);
      std::vector<Exact_vector> clipped;
      for(std::size_t i = 0; i < polygon.size(); ++i) {
        const Exact_vector &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const Exact da = sign * (a[k] - bound), db = sign * (b[k] - bound);
        if(da >= 0)
          clipped.push_back(a);
        if((da > 0 && db < 0) || (da < 0 && db > 0)) {
          const Exact s = da / (da - db);
          clipped.push_back({a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]), a[2] + s * (b[2] - a[2])});
        }
      }
      polygon = std::move(clipped);
    }
  return !polygon.empty();
}

template <class Traits>
void test_lattice(const Traits& traits)
{
  std::mt19937 random(17);
  const Frame frame(traits);
  // Every lattice point is at its right place, without rounding.
  for(int repeat = 0; repeat < 300; ++repeat) {
    Lattice_point p;
    for(std::uint32_t& c : p)
      c = std::uint32_t(repeat < 8 ? Octree::root_side * (random() % 2) : random() % (Octree::root_side + 1));
    const Exact_vector q = exact(traits.point(p));
    for(int k = 0; k < 3; ++k)
      BOOST_TEST(q[k]
                 == frame.origin[k] + p[0] * frame.units[0][k] + p[1] * frame.units[1][k]
                      + p[2] * frame.units[2][k]);
  }
  // Orthogonal and right-handed, so that positive elements of the lattice are positive in space.
  for(int k = 0; k < 3; ++k)
    BOOST_TEST(dot(frame.units[k], frame.units[(k + 1) % 3]) == 0);
  const auto& u = frame.units;
  BOOST_TEST(u[0][0] * (u[1][1] * u[2][2] - u[1][2] * u[2][1])
               - u[0][1] * (u[1][0] * u[2][2] - u[1][2] * u[2][0])
               + u[0][2] * (u[1][0] * u[2][1] - u[1][1] * u[2][0])
             > 0);

  // Cells have the right center, box, length, and triangles that they meet; triangles through lattice points
  // touch.
  for(int repeat = 0; repeat < 60; ++repeat) {
    const int level = int(random() % 6);
    const std::uint32_t side = Octree::side_at(level);
    const auto multiple = [&](std::uint32_t step) {
      return step * std::uint32_t(random() % (Octree::root_side / step));
    };
    const Lattice_point corner{multiple(side), multiple(side), multiple(side)};
    const auto cell = traits.cell(corner, side);
    BOOST_TEST(cell.center()
               == traits.point({corner[0] + side / 2, corner[1] + side / 2, corner[2] + side / 2}));
    Bbox_3 box;
    double shortest = std::numeric_limits<double>::infinity();
    const Point_3 first = traits.point(corner);
    for(std::uint32_t i = 0; i < 8; ++i) {
      const Point_3 p = traits.point(
        {corner[0] + (i & 1) * side, corner[1] + (i >> 1 & 1) * side, corner[2] + (i >> 2) * side});
      box += p.bbox();
      if(i == 1 || i == 2 || i == 4)
        shortest = (std::min)(shortest, std::sqrt(CGAL::squared_distance(p, first)));
    }
    BOOST_TEST(cell.bbox() == box);
    BOOST_TEST_LE(std::abs(traits.length(side) - shortest), 1e-6 * shortest);
    for(int i = 0; i < 10; ++i) {
      const auto near = [&](int k) {
        const std::int64_t x = std::int64_t(corner[k]) + (std::int64_t(random() % 7) - 2) * (side / 2);
        return std::uint32_t((std::min)((std::max)(x, std::int64_t(0)), std::int64_t(Octree::root_side)));
      };
      const auto vertex = [&] {
        return i % 2 == 0 ? traits.point({near(0), near(1), near(2)})
                          : traits.point({multiple(side / 2), multiple(side / 2), multiple(side / 2)});
      };
      const Triangle_3 t(vertex(), vertex(), vertex());
      if(!t.is_degenerate())
        BOOST_TEST_EQ(cell.do_intersect(t), exactly_intersect(frame, corner, side, t));
    }
  }
}

// The root contains the points.
template <class Traits>
void test_cover(const Traits& traits, const std::vector<Point_3>& points)
{
  const Frame frame(traits);
  for(const Point_3& p : points)
    for(const Exact& c : frame.coordinates(exact(p)))
      BOOST_TEST(c >= 0 && c <= Exact(Octree::root_side));
}

void test_cell_traits()
{
  std::mt19937 random(23);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Bbox_3> boxes = {{0, 0, 0, 1, 1, 1},
                               {0.1, -0.7, 1. / 3, 1.1, 0.9, 0.7},
                               {-3.9, -44, -65.8, 60.1, 55, 65.79},
                               {1e8, -1e8, 1e8, 1e8 + 100, -1e8 + 33, 1e8 + 7},
                               {1e8, 1e8, 1e8, 1e8 + 1e-5, 1e8 + 1e-6, 1e8 + 1e-6}};
  for(int i = 0; i < 30; ++i) {
    const double offset = std::array<double, 3>{0, 1, 1e8}[i % 3];
    const double x = offset * uniform(random), y = -offset * uniform(random), z = uniform(random);
    boxes.push_back({x, y, z, x + uniform(random), y + uniform(random), z + 1});
  }
  std::size_t n = 0;
  for(const Bbox_3& b : boxes)
    for(double scale : {1., 1e-6, 1e6}) {
      const std::vector<Point_3> points = {{scale * b.xmin(), scale * b.ymin(), scale * b.zmin()},
                                           {scale * b.xmax(), scale * b.ymax(), scale * b.zmax()},
                                           {scale * b.xmax(), scale * b.ymin(), scale * b.zmax()},
                                           {scale * b.xmin(), scale * b.ymax(), scale * b.zmax()}};
      const Bbox_3 box = CGAL::bbox_3(points.begin(), points.end());
      for(Root_cell root : {Root_cell::CUBE, Root_cell::BOX}) {
        const Aligned_traits traits(box, root);
        test_cover(traits, points);
        if(n < 30)
          test_lattice(traits);
        if(root == Root_cell::CUBE) {
          const Frame frame(traits);
          for(int k = 1; k < 3; ++k)
            BOOST_TEST(dot(frame.units[0], frame.units[0]) == dot(frame.units[k], frame.units[k]));
        }
      }
      // The extent needed for a box 1e-5 small at 1e8 is far more than the digits left.
      const Kernel::Vector_3 axis = n % 7 == 0
                                      ? Kernel::Vector_3(0, 0, -1)
                                      : Kernel::Vector_3(uniform(random) - 0.5, uniform(random) - 0.5,
                                                         uniform(random) - 0.5);
      const Rotated_traits traits(points, axis);
      test_cover(traits, points);
      if(n < 30)
        test_lattice(traits);
      const Frame frame(traits);
      for(int k = 1; k < 3; ++k)
        BOOST_TEST(dot(frame.units[0], frame.units[0]) == dot(frame.units[k], frame.units[k]));
      const Kernel::Vector_3 third = traits.point({0, 0, Octree::root_side}) - traits.point({0, 0, 0});
      BOOST_TEST_GT(axis * third / std::sqrt(axis.squared_length() * third.squared_length()),
                    std::cos(3 * CGAL_PI / 180));
      ++n;
    }
}

// ---- balance -----------------------------------------------------------------------------------

// Balance compared with all pairs of leaves, on an octree that is not balanced and after.
void test_is_balanced()
{
  std::mt19937 random(31);
  for(int repeat = 0; repeat < 20; ++repeat) {
    Octree octree;
    for(int i = 0; i < 4 + repeat; ++i) {
      Octree::Node_index n = Octree::root();
      while(!octree.is_leaf(n))
        n = octree.child(n, int(random() % (repeat % 2 == 0 ? 8 : 2)));
      if(octree.level(n) < 8)
        octree.split(n);
    }
    for(int step = 0; step < 4; ++step) {
      for(int rank = 1; rank <= 3; ++rank) {
        bool expected = true;
        for(Octree::Node_index a = 0; a < octree.size(); ++a)
          for(Octree::Node_index b = 0; b < octree.size(); ++b)
            if(octree.is_leaf(a) && octree.is_leaf(b) && octree.level(a) + 1 < octree.level(b)
               && touch(octree, a, b)) {
              int contact = 0;
              for(int k = 0; k < 3; ++k)
                contact += octree.corner(a)[k] + octree.side(a) == octree.corner(b)[k]
                           || octree.corner(b)[k] + octree.side(b) == octree.corner(a)[k];
              expected = expected && contact > rank;
            }
        BOOST_TEST_EQ(is_balanced(octree, Adjacency(rank)), expected);
      }
      if(step < 3) {
        std::vector<Octree::Node_index> refined;
        for(Octree::Node_index n = 0; n < octree.size(); ++n)
          if(!octree.is_leaf(n))
            refined.push_back(n);
        internal::balance(octree, refined, Adjacency(step + 1),
                          [&](Octree::Node_index n) { octree.split(n); });
        BOOST_TEST(is_balanced(octree, Adjacency(step + 1)));
      }
    }
  }
}

// ---- located cells -----------------------------------------------------------------------------

// A box as region, so that comparisons decide whether a cell meets it.
struct Box_region
{
  struct Surface_part
  {
  };
  Bbox_3 box;

  Surface_part surface_part() const { return {}; }
  template <class Cell>
  CGAL::Bounded_side locate(const Cell& cell, const Surface_part&, Surface_part&) const
  {
    const Bbox_3 c = cell.bbox();
    bool meets = true, is_inside = true;
    for(int k = 0; k < 3; ++k) {
      meets = meets && c.min(k) <= box.max(k) && box.min(k) <= c.max(k);
      is_inside = is_inside && box.min(k) < c.min(k) && c.max(k) < box.max(k);
    }
    return is_inside ? CGAL::ON_BOUNDED_SIDE : meets ? CGAL::ON_BOUNDARY : CGAL::ON_UNBOUNDED_SIDE;
  }
  double depth(const Point_3& p) const
  {
    double least = std::numeric_limits<double>::infinity();
    for(int k = 0; k < 3; ++k)
      least = (std::min)({least, p[k] - box.min(k), box.max(k) - p[k]});
    return least;
  }
};

// Choice for refinement, and locations of cells, by the boxes of all nodes.
void test_located_cells()
{
  const Analytic_domain domain(ball({0.5, 0.5, 0.5}, 0.3));
  const double volume_of_ball = 4 * CGAL_PI / 3 * 0.027;
  for(const Bbox_3& root : {Bbox_3(0, 0, 0, 1, 1, 1), Bbox_3(0, 0.2, 0.1, 1, 0.8, 0.9)}) {
    const Aligned_traits traits(root, Root_cell::BOX);
    for(const Bbox_3& b :
        {Bbox_3(0.4, 0.3, 0.2, 0.7, 0.6, 0.55), Bbox_3(0.51, 0.51, 0.51, 0.52, 0.52, 0.52)}) {
      const Box_region region{b};
      Located_octree octree(domain, region, traits);
      const double whole = octree.cell_volume(0);
      BOOST_TEST_LE(std::abs(whole - root.x_span() * root.y_span() * root.z_span()), 1e-5 * whole);
      const double volume = volume_of_domain(octree);
      BOOST_TEST(volume > 0.85 * volume_of_ball && volume < 1.25 * volume_of_ball);
      std::size_t number_in_region = 0, number_beside = 0;
      for(int level = 0; level < 5; ++level) {
        std::vector<Octree::Node_index> all, in_region;
        std::size_t inside = 0, in_domain = 0;
        for(Octree::Node_index n = 0; n < octree.octree().size(); ++n) {
          const auto cell = traits.cell(octree.octree().corner(n), octree.octree().side(n));
          Box_region::Surface_part part;
          BOOST_TEST_EQ(octree.is_in_region(n), region.locate(cell, part, part) != CGAL::ON_UNBOUNDED_SIDE);
          BOOST_TEST_EQ(octree.depth_in_region(n), region.depth(cell.center()));
          BOOST_TEST_LE(std::abs(octree.rounded(octree.depth_in_region(n)) - octree.depth_in_region(n)),
                        1e-6);
          Analytic_domain::Surface_part none;
          const CGAL::Bounded_side side = domain.locate(cell, none, none);
          if(!octree.octree().is_leaf(n))
            continue;
          BOOST_TEST_EQ(octree.leaf_at(cell.center()), n);
          inside += octree.side(n) == CGAL::ON_BOUNDED_SIDE;
          in_domain += octree.meets_domain(n);
          BOOST_TEST(octree.side(n) == side || side == CGAL::ON_BOUNDARY); // children inherit a side
          if(octree.octree().level(n) == level && octree.meets_domain(n)) {
            all.push_back(n);
            if(octree.is_in_region(n))
              in_region.push_back(n);
          }
        }
        BOOST_TEST_EQ(octree.number_of_cells(), in_domain);
        BOOST_TEST_EQ(octree.number_of_cells_inside(), inside);
        BOOST_TEST(octree.leaves_to_refine(level, false) == all);
        BOOST_TEST(octree.leaves_to_refine(level, true) == in_region);
        number_in_region += in_region.size();
        number_beside += all.size() - in_region.size();
        octree.refine(all);
      }
      BOOST_TEST(number_in_region >= 5 && number_beside > 100);
    }
  }
}

int run(int, char*[])
{
  test_cell_traits();
  test_is_balanced();
  test_located_cells();
  return boost::report_errors();
}

} // namespace test_octree_cells
