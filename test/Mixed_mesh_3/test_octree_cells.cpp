// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the octree is made of besides itself: the cells of the lattice, against exact rationals; the leaves
// that are refined in a region, and balance, by all pairs; where the lattice is placed.

#include "test_lattice.h"

#include <CGAL/Mixed_mesh_3/internal/octree/balance.h>
#include <CGAL/Mixed_mesh_3/internal/octree/place_lattice.h>
#include <CGAL/Mixed_mesh_3/validation.h>

#include <CGAL/Exact_rational.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace {

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
  // Every lattice point is where it should be, without rounding.
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

  // Cells: center, box, length, and which triangles they meet; those through lattice points touch.
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
      // far more extent than digits left is needed to turn a box 1e-5 small at 1e8
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

// Against all pairs of leaves, on an octree that is not balanced and after.
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

// ---- the rim of the region ---------------------------------------------------------------------

// Few leaves at the rim of the region are left out: their centers are outside, but that of one of 26
// neighbors is inside. By all pairs.
void test_rim()
{
  const Aligned_traits traits({0, 0, 0, 1, 1, 1});
  const Analytic_domain domain([](const Point_3&) { return 9.; });
  std::size_t number_left_out = 0, number_kept_outside = 0;
  // the last one is smaller than a cell, and contains no center
  for(const auto& region :
      {CGAL::Ball_mixed_mesh_region_3({0.4, 0.5, 0.6}, 0.3), CGAL::Ball_mixed_mesh_region_3({0, 0, 0}, 0.5),
       CGAL::Ball_mixed_mesh_region_3({0.5, 0.5, 0.5}, 0.02)}) {
    Located_octree octree(domain, region, traits);
    for(int level = 0; level < 6; ++level) {
      std::vector<Octree::Node_index> all; // that meet the region
      for(Octree::Node_index n : octree.leaves_to_refine(level, false))
        if(octree.is_in_region(n))
          all.push_back(n);
      const auto corner = [&](Octree::Node_index n, int k) {
        return std::int64_t(octree.octree().corner(n)[k]);
      };
      const std::int64_t side = Octree::side_at(level);
      std::vector<std::uint8_t> is_core;
      for(Octree::Node_index n : all)
        is_core.push_back(
          region.depth(traits.cell(octree.octree().corner(n), Octree::side_at(level)).center()) >= 0);
      std::vector<Octree::Node_index> expected;
      for(std::size_t i = 0; i < all.size(); ++i) {
        bool is_at_rim = false;
        for(std::size_t j = 0; all.size() <= 4000 && !is_core[i] && j < all.size(); ++j)
          if(is_core[j]) {
            bool is_near = true;
            for(int k = 0; k < 3; ++k)
              is_near = is_near && std::abs(corner(all[i], k) - corner(all[j], k)) <= side;
            is_at_rim = is_at_rim || is_near;
          }
        number_left_out += is_at_rim;
        if(!is_at_rim) {
          expected.push_back(all[i]);
          number_kept_outside += !is_core[i];
        }
      }
      BOOST_TEST(octree.leaves_to_refine(level, true) == expected);
      BOOST_TEST_EQ(expected.empty(), all.empty());
      octree.refine(octree.leaves_to_refine(level, false));
    }
  }
  BOOST_TEST_GT(number_left_out, 500u);
  BOOST_TEST_GT(number_kept_outside, 500u); // where there are many
}

// ---- the lattice -------------------------------------------------------------------------------

// All roots contain the domain; the best ones come first.
void test_place_lattice()
{
  using internal::candidate_roots;
  using internal::best_roots;
  for(const Bbox_3& b : {Bbox_3(0, 0, 0, 1, 1, 1), Bbox_3(-3.9, -44, -65.8, 60.1, 55, 65.79),
                         Bbox_3(1e8, -1e8, 1e8, 1e8 + 100, -1e8 + 33, 1e8 + 7)}) {
    const std::vector<Bbox_3> roots = candidate_roots(b);
    BOOST_TEST(roots.front() == b);
    std::set<std::array<double, 4>> places;
    const double side = (std::max)({b.x_span(), b.y_span(), b.z_span()});
    for(const Bbox_3& r : roots) {
      BOOST_TEST(r.xmin() <= b.xmin() && r.ymin() <= b.ymin() && r.zmin() <= b.zmin());
      BOOST_TEST(r.xmax() >= b.xmax() && r.ymax() >= b.ymax() && r.zmax() >= b.zmax());
      BOOST_TEST_LE((std::max)({r.x_span(), r.y_span(), r.z_span()}), 1.26 * side);
      places.insert({r.xmin(), r.ymin(), r.zmin(), r.xmax()});
    }
    BOOST_TEST_EQ(places.size(), roots.size()); // no two are the same
  }

  std::vector<Bbox_3> roots;
  for(int i = 0; i < 5; ++i)
    roots.emplace_back(i, 0, 0, i + 1, 1, 1);
  constexpr std::size_t counts[] = {30, 50, 0, 50, 40};
  const auto choose = [&](std::size_t number) {
    std::vector<double> chosen;
    for(const Bbox_3& r :
        best_roots(roots, number, [&](const Bbox_3& b) { return counts[std::size_t(b.xmin())]; }))
      chosen.push_back(r.xmin());
    return chosen;
  };
  using Numbers = std::vector<double>;
  BOOST_TEST(choose(1) == Numbers({1}));
  BOOST_TEST(choose(3) == Numbers({1, 3, 4}));
  BOOST_TEST(choose(9) == Numbers({1, 3, 4, 0, 2}));
}

} // namespace

int main()
{
  test_cell_traits();
  test_is_balanced();
  test_rim();
  test_place_lattice();
  return boost::report_errors();
}
