// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Changes of topology between the voxels of labels and their surfaces: bridges, gaps, rings and cavities of
// one voxel are told, thick ones are not; for random labels, what is told is what the surfaces enclose.

#include "test_images.h"
#include "test_labels.h"

#include <CGAL/Mixed_mesh_image_3/make_label_surface.h>

#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <random>
#include <set>
#include <tuple>
#include <vector>

namespace test_label_changes {

using namespace CGAL::Mixed_meshes_3;
namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Simple_cartesian<double>;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Voxel = std::array<double, 3>;
using Kind = Label_change_kind;
using Told = std::tuple<std::size_t, Kind, std::size_t, std::size_t>; // label, kind, before, after

struct Result
{
  std::vector<Surface> surfaces;
  std::vector<Label_change_3> changes;
};

Result surfaces_of(const Voxel_image_3& image, int n, double smoothing)
{
  Result result;
  result.surfaces = surfaces_of_labels<Surface>(image, n, smoothing, 0, &result.changes);
  return result;
}

std::vector<Told> told(const std::vector<Label_change_3>& changes)
{
  std::vector<Told> result;
  for(const Label_change_3& c : changes)
    result.emplace_back(c.label, c.kind, c.number_before, c.number_after);
  return result;
}

bool is_in_box(const Voxel& p, const Voxel& low, const Voxel& high)
{
  return p[0] >= low[0] && p[1] >= low[1] && p[2] >= low[2] && p[0] <= high[0] && p[1] <= high[1]
         && p[2] <= high[2];
}

template <class IsIn>
Result changes_of(const IsIn& is_in, const Affine_map_3& map = identity)
{
  return surfaces_of(image_of({40, 24, 24}, map, [&](const Voxel& p) { return is_in(p) ? 1 : 0; }), 1,
                     voxel_spacing(Voxel_grid_3{{40, 24, 24}, map})[0]);
}

// Two cubes with a bridge of some width: one of a voxel is lost, a thick one is not.
void test_bridge()
{
  for(const Affine_map_3& map : {identity, oblique({2, 2, 2}, {10, -20, 300}, true)})
    for(int width : {1, 5}) {
      const auto [surfaces, changes] = changes_of(
        [width](const Voxel& p) {
          return is_in_box(p, {4, 4, 4}, {14, 18, 18}) || is_in_box(p, {25, 4, 4}, {35, 18, 18})
                 || is_in_box(p, {15, 11, 11}, {24, 10. + width, 10. + width});
        },
        map);
      if(width > 1) {
        BOOST_TEST(changes.empty());
        continue;
      }
      const std::vector<Told> expected{{0, Kind::BODIES_PARTED, 1, 2}, {1, Kind::BODIES_PARTED, 1, 2}};
      BOOST_TEST(told(changes) == expected);
      for(const Label_change_3& c : changes) {
        const std::array<double, 3> q = transform(inverse(map), c.point);
        BOOST_TEST_LE(std::hypot(q[0] - 19.5, q[1] - 11, q[2] - 11), 1);
      }
    }
}

// Bodies, of which one is joined to another one by smoothing, and one with a tail, which is shorter after.
void test_gap()
{
  for(double gap : {1., 4.}) {
    const auto [surfaces, changes] = changes_of([gap](const Voxel& p) {
      return is_in_box(p, {4, 4, 4}, {14, 18, 18}) || is_in_box(p, {15 + gap, 4, 4}, {30, 18, 18})
             || is_in_box(p, {31, 11, 11}, {35, 11, 11});
    });
    const std::vector<Told> expected{{0, Kind::BODIES_JOINED, 2, 1}, {1, Kind::BODIES_JOINED, 2, 1}};
    BOOST_TEST(gap == 1 ? told(changes) == expected : changes.empty());
    for(const Label_change_3& c : changes)
      BOOST_TEST_EQ(c.point[0], 15);
  }
}

// Labels that only together have a bridge.
void test_bridge_of_labels()
{
  const Voxel_image_3 image = image_of({40, 24, 24}, identity, [](const Voxel& p) {
    return is_in_box(p, {4, 4, 4}, {14, 18, 18}) || is_in_box(p, {15, 11, 11}, {19, 11, 11})    ? 1
           : is_in_box(p, {25, 4, 4}, {35, 18, 18}) || is_in_box(p, {20, 11, 11}, {24, 11, 11}) ? 2
                                                                                                : 0;
  });
  const std::vector<Told> expected{{0, Kind::BODIES_PARTED, 1, 2}};
  BOOST_TEST(told(surfaces_of(image, 2, 1).changes) == expected);
  BOOST_TEST(surfaces_of(image, 2, 0).changes.empty());
}

// A ring of some thickness, a part of which is one voxel thick, or as thick as the rest.
void test_ring()
{
  for(bool is_thin : {true, false}) {
    const auto [surfaces, changes] = changes_of([is_thin](const Voxel& p) {
      if(is_thin && is_in_box(p, {21, 9, 0}, {40, 14, 40}))
        return is_in_box(p, {26, 9, 11}, {26, 14, 11});
      return is_in_box(p, {12, 3, 8}, {29, 20, 14}) && !is_in_box(p, {19, 9, 0}, {22, 14, 40});
    });
    const std::vector<Told> expected{{0, Kind::HANDLES_LOST, 1, 0}, {1, Kind::HANDLES_LOST, 1, 0}};
    BOOST_TEST(is_thin ? told(changes) == expected : changes.empty());
    for(const Label_change_3& c : changes)
      BOOST_TEST_LE(std::hypot(c.point[0] - 26, c.point[1] - 11.5, c.point[2] - 11), 3);
  }
}

// Cavities of which one is filled, one stays, one is cut off, and one is open at a wall of one voxel.
void test_cavities()
{
  const auto changes = [](const Voxel& low, const Voxel& high) {
    return told(changes_of([&](const Voxel& p) {
                  return is_in_box(p, {3, 3, 3}, {36, 20, 20}) && !is_in_box(p, {8, 8, 8}, {14, 14, 14})
                         && !is_in_box(p, low, high);
                }).changes);
  };
  BOOST_TEST(changes({8, 8, 8}, {8, 8, 8}).empty());
  const std::vector<Told> filled{{0, Kind::CAVITIES_LOST, 1, 0}}, cut_off{{0, Kind::CAVITIES_PARTED, 1, 2}},
    joined{{0, Kind::CAVITIES_JOINED, 2, 1}};
  BOOST_TEST(changes({30, 12, 12}, {30, 12, 12}) == filled);
  BOOST_TEST(changes({11, 11, 0}, {11, 11, 8}) == cut_off);
  BOOST_TEST(changes({16, 8, 8}, {22, 14, 14}) == joined);
}

// Voxels that have a corner or an edge in common only may be one body or two.
void test_diagonal_contacts()
{
  for(double y : {15., 14.})
    for(double smoothing : {0., 1.}) {
      const Voxel_image_3 image = image_of({30, 30, 30}, identity, [y](const Voxel& p) {
        return is_in_box(p, {4, 4, 4}, {14, 14, 14}) || is_in_box(p, {15, y, 15}, {25, 25, 25}) ? 1 : 0;
      });
      BOOST_TEST(surfaces_of(image, 1, smoothing).changes.empty());
    }
}

// Voxels of a box in components, by flood filling; empty voxels have -1.
std::vector<int> components(const Voxel_image_3& image, const std::function<bool(float)>& is_in,
                            int most_axes)
{
  const auto& s = image.grid.size;
  std::vector<int> result(image.values.size(), -1);
  int number = 0;
  for(std::size_t first = 0; first < result.size(); ++first) {
    if(result[first] >= 0 || !is_in(image.values[first]))
      continue;
    std::vector<std::size_t> found{first};
    result[first] = number;
    while(!found.empty()) {
      const std::size_t v = found.back();
      found.pop_back();
      const int x = int(v % s[0]), y = int(v / s[0] % s[1]), z = int(v / (s[0] * s[1]));
      for(int dz = -1; dz <= 1; ++dz)
        for(int dy = -1; dy <= 1; ++dy)
          for(int dx = -1; dx <= 1; ++dx) {
            const int p = x + dx, q = y + dy, r = z + dz;
            if(std::abs(dx) + std::abs(dy) + std::abs(dz) > most_axes || p < 0 || q < 0 || r < 0
               || p >= int(s[0]) || q >= int(s[1]) || r >= int(s[2]))
              continue;
            const std::size_t w = image.grid.offset(std::size_t(p), std::size_t(q), std::size_t(r));
            if(result[w] < 0 && is_in(image.values[w])) {
              result[w] = number;
              found.push_back(w);
            }
          }
    }
    ++number;
  }
  return result;
}

struct Shells
{
  std::vector<Surface> bodies;
  std::ptrdiff_t handles = 0;
};

Shells shells_of(const Surface& surface)
{
  Shells result;
  std::vector<Surface> parts;
  PMP::split_connected_components(surface, parts);
  for(Surface& part : parts) {
    result.handles += 1
                      - (std::ptrdiff_t(part.number_of_vertices()) - std::ptrdiff_t(part.number_of_edges())
                         + std::ptrdiff_t(part.number_of_faces()))
                          / 2;
    if(PMP::volume(part) > 0)
      result.bodies.push_back(part);
  }
  return result;
}

// The handles of voxels as a complex of cubes, with a cell if all voxels at it are in, or any.
std::ptrdiff_t handles_of_cubes(const Voxel_image_3& image, const std::function<bool(float)>& is_in, bool all)
{
  const auto& s = image.grid.size;
  const auto count = [](const std::vector<int>& c) {
    return c.empty() ? 0 : *std::max_element(c.begin(), c.end()) + 1;
  };
  const std::ptrdiff_t bodies = count(components(image, is_in, all ? 1 : 3));
  const std::ptrdiff_t voids = count(components(
    image, [&](float value) { return !is_in(value); }, all ? 3 : 1));
  std::ptrdiff_t euler = 0;
  for(std::size_t k = 0; k + 1 < s[2]; ++k)
    for(std::size_t j = 0; j + 1 < s[1]; ++j)
      for(std::size_t i = 0; i + 1 < s[0]; ++i)
        for(std::size_t cell = 0; cell < 8; ++cell) { // axes along which the cell has two voxels
          int number = 0, in = 0;
          for(std::size_t d = 0; d < 8; ++d)
            if((d & cell) == d) {
              ++number;
              in += is_in(image.values[image.grid.offset(i + (d & 1), j + (d >> 1 & 1), k + (d >> 2))]);
            }
          // Cells of one voxel are vertices of the complex with all, and cubes of that with any.
          const int axes = int(cell & 1) + int(cell >> 1 & 1) + int(cell >> 2);
          if(all ? in == number : in > 0)
            euler += (all ? axes : 3 - axes) % 2 == 0 ? 1 : -1;
        }
  return bodies + voids - 1 - euler;
}

// Random labels of balls, beside each other and across each other: what is told of bodies follows from
// voxels' centers in the shells of the surfaces, and what is told of handles from the genus of the surfaces.
void test_random_labels()
{
  std::mt19937 random(11);
  std::map<Kind, int> number_of;
  int number_unchanged = 0;
  const auto up_to = [&random](double x) { return x * double(random()) / double(std::mt19937::max()); };
  for(int round = 0; round < 20; ++round) {
    const int n = 1 + round % 3;
    const bool is_smooth = round % 2 == 0;
    std::vector<std::array<double, 5>> balls; // center, radius, label
    for(int b = 0; b < (is_smooth ? 5 : 40); ++b)
      balls.push_back({4 + up_to(15), 4 + up_to(15), 4 + up_to(15),
                       is_smooth ? 2.5 + up_to(1.4) : 0.6 + up_to(2), 1. + double(b % n)});
    const Voxel_image_3 image = image_of({24, 24, 24}, identity, [&](const Voxel& p) {
      double label = 0;
      for(const auto& b : balls)
        if(std::hypot(p[0] - b[0], p[1] - b[1], p[2] - b[2]) < b[3])
          label = b[4];
      return label;
    });
    const Result result = surfaces_of(image, n, 1);
    for(int l = 0; l <= n; ++l) {
      const auto is_in = [l](float value) { return l == 0 ? value > 0 : value == float(l); };
      const std::vector<int> strict = components(image, is_in, 1), loose = components(image, is_in, 3);
      const Shells shells = shells_of(result.surfaces[std::size_t(l)]);
      std::deque<CGAL::Side_of_triangle_mesh<Surface, Kernel>> sides; // do not move
      std::vector<double> volumes;
      for(const Surface& s : shells.bodies) {
        sides.emplace_back(s);
        volumes.push_back(PMP::volume(s));
      }
      const CGAL::Side_of_triangle_mesh<Surface, Kernel> is_in_all(result.surfaces[std::size_t(l)]);
      std::map<int, std::set<int>> pieces, origins; // of strict components; of shells
      std::set<int> lost(loose.begin(), loose.end());
      lost.erase(-1);
      for(std::size_t v = 0; v < loose.size(); ++v) {
        const Kernel::Point_3 p(double(v % 24), double(v / 24 % 24), double(v / 576));
        if(loose[v] < 0 || sides.empty() || is_in_all(p) != CGAL::ON_BOUNDED_SIDE)
          continue;
        int shell = -1; // the innermost one
        for(std::size_t s = 0; s < sides.size(); ++s)
          if(sides[s](p) == CGAL::ON_BOUNDED_SIDE && (shell < 0 || volumes[s] < volumes[std::size_t(shell)]))
            shell = int(s);
        pieces[strict[v]].insert(shell);
        origins[shell].insert(loose[v]);
        lost.erase(loose[v]);
      }
      std::vector<Told> expected;
      const auto label = std::size_t(l);
      const auto expect_several = [&](Kind kind, const std::map<int, std::set<int>>& partners) {
        std::size_t number = 0;
        std::set<int> all;
        for(const auto& one : partners)
          if(one.second.size() > 1) {
            ++number;
            all.insert(one.second.begin(), one.second.end());
          }
        if(number > 0 && kind == Kind::BODIES_PARTED)
          expected.emplace_back(label, kind, number, all.size());
        else if(number > 0)
          expected.emplace_back(label, kind, all.size(), number);
      };
      if(!lost.empty())
        expected.emplace_back(label, Kind::BODIES_LOST, lost.size(), 0);
      expect_several(Kind::BODIES_PARTED, pieces);
      expect_several(Kind::BODIES_JOINED, origins);
      if(shells.bodies.size() > origins.size())
        expected.emplace_back(label, Kind::BODIES_ADDED, 0, shells.bodies.size() - origins.size());
      if(!shells.bodies.empty()) {
        Surface unsmoothed;
        make_label_surface(image, is_in, 0, unsmoothed);
        const std::array<std::ptrdiff_t, 3> handles{handles_of_cubes(image, is_in, true),
                                                    shells_of(unsmoothed).handles,
                                                    handles_of_cubes(image, is_in, false)};
        const auto [least, most] = std::minmax_element(handles.begin(), handles.end());
        if(shells.handles < *least)
          expected.emplace_back(label, Kind::HANDLES_LOST, *least, shells.handles);
        else if(shells.handles > *most)
          expected.emplace_back(label, Kind::HANDLES_ADDED, *most, shells.handles);
      }
      std::vector<Label_change_3> changes = result.changes;
      changes.erase(std::remove_if(changes.begin(), changes.end(),
                                   [label](const Label_change_3& c) {
                                     return c.label != label
                                            || (c.kind >= Kind::CAVITIES_LOST
                                                && c.kind <= Kind::CAVITIES_ADDED);
                                   }),
                    changes.end());
      BOOST_TEST(told(changes) == expected);
      for(const Told& one : expected)
        ++number_of[std::get<1>(one)];
      number_unchanged += expected.empty();
    }
  }
  for(const Kind kind : {Kind::BODIES_LOST, Kind::BODIES_PARTED, Kind::BODIES_JOINED, Kind::HANDLES_LOST})
    BOOST_TEST_GT(number_of[kind], 0); // the test is none of nothing
  BOOST_TEST_GT(number_unchanged, 5);
}

int run(int, char*[])
{
  test_bridge();
  test_gap();
  test_bridge_of_labels();
  test_ring();
  test_cavities();
  test_diagonal_contacts();
  test_random_labels();
  return boost::report_errors();
}

} // namespace test_label_changes
