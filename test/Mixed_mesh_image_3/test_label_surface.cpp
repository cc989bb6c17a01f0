// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces of labels: closed, manifold and without self-intersections for all patterns of a cube and for
// random images; round where the label is round; in the right place of the world.

#include "test_images.h"

#include <CGAL/Mixed_mesh_image_3/complete_label.h>
#include <CGAL/Mixed_mesh_image_3/label_extents.h>
#include <CGAL/Mixed_mesh_image_3/make_label_surface.h>
#include <CGAL/Mixed_mesh_image_3/simplify_closed_surface.h>

#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <random>
#include <vector>

namespace test_label_surface {

using namespace CGAL::Mixed_meshes_3;
using Point_3 = Predicates_kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point_3>;

const auto is_label = [](float value) { return value == 1; };

Surface surface_of(const Voxel_image_3& image, double smoothing)
{
  Surface surface;
  make_label_surface(image, is_label, smoothing, surface);
  return surface;
}

double volume(const Surface& s)
{
  double sum = 0;
  for(auto f : s.faces()) {
    const auto h = s.halfedge(f);
    const Vec3 a = to_vec3(s.point(s.target(h))), b = to_vec3(s.point(s.target(s.next(h)))),
               c = to_vec3(s.point(s.target(s.next(s.next(h)))));
    sum += dot(a, cross(b, c)) / 6;
  }
  return sum;
}

// Whether a surface is closed, each vertex has one fan of faces, and no two faces meet where they should not.
bool is_clean(const Surface& s)
{
  for(auto h : s.halfedges())
    if(s.is_border(h))
      return false;
  std::vector<std::size_t> number_of_faces(s.number_of_vertices());
  for(auto f : s.faces())
    for(auto v : s.vertices_around_face(s.halfedge(f)))
      ++number_of_faces[v];
  for(auto v : s.vertices()) // a fan is all there is
    if(number_of_faces[v] < 3 || s.degree(v) != number_of_faces[v])
      return false;
  return !CGAL::Polygon_mesh_processing::does_self_intersect(s);
}

// All patterns of a cube, alone and beside each other, with no smoothing.
void test_all_patterns()
{
  for(int pattern = 0; pattern < 256; ++pattern) {
    const Voxel_image_3 image = image_of({2, 2, 2}, identity, [&](const std::array<double, 3>& p) {
      return (pattern >> int(p[0] + 2 * p[1] + 4 * p[2]) & 1) != 0;
    });
    const Surface s = surface_of(image, 0);
    BOOST_TEST(is_clean(s));
    BOOST_TEST_EQ(s.number_of_faces() > 0, pattern != 0);
    BOOST_TEST(pattern == 0 || volume(s) > 0);
  }
}

void test_random_images()
{
  std::mt19937 random(7);
  std::size_t number_lost = 0;
  for(int i = 0; i < 200; ++i) {
    const unsigned rarity = 2 + unsigned(i % 7);
    const std::array<std::size_t, 3> size{3 + random() % 8, 3 + random() % 8, 1 + random() % 8};
    const Voxel_image_3 image = image_of(size, oblique({0.7, 1.1, 2.3}, {-100, 20, 3000}, i % 2 == 0),
                                         [&](const std::array<double, 3>& p) {
                                           return i % 10 == 0
                                                    ? int(p[0] + p[1] + p[2]) % 2 == 0 // checkerboard
                                                    : random() % rarity == 0;
                                         });
    const Surface s = surface_of(image, i % 3 == 0 ? 0 : 0.4 * (i % 3));
    BOOST_TEST(is_clean(s));
    number_lost += s.is_empty();
    BOOST_TEST(s.is_empty() || volume(s) > 0);
  }
  BOOST_TEST_LT(number_lost, 10u);
}

// Voxels of a ball: no steps, and the ball's place, size and side in the world.
void test_ball()
{
  for(bool mirror : {false, true}) {
    const Vec3 spacing{1, 1.2, 0.8};
    const Affine_map_3 map = oblique(spacing, {10, -20, 30}, mirror);
    const std::array<double, 3> middle{16.3, 14.8, 19.1};
    const Vec3 center = transform(map, middle);
    const double radius = 10;
    const Voxel_image_3 image = image_of({34, 30, 40}, map, [&](const std::array<double, 3>& p) {
      return norm(Vec3(transform(map, p)) - center) < radius;
    });
    double error[2];
    for(bool is_smooth : {false, true}) {
      const Surface s = surface_of(image, is_smooth ? 1.2 : 0);
      BOOST_TEST(is_clean(s));
      double sum = 0;
      for(auto v : s.vertices())
        sum += std::pow(norm(to_vec3(s.point(v)) - center) - radius, 2);
      error[is_smooth] = std::sqrt(sum / double(s.number_of_vertices()));
      const double ball = 4. / 3 * M_PI * radius * radius * radius;
      BOOST_TEST(0.95 * ball < volume(s) && volume(s) < 1.02 * ball);
    }
    std::cout << "ball: radius off by " << error[0] << ", smoothed " << error[1] << " (RMS)\n";
    BOOST_TEST_LE(error[1], 0.1);
    BOOST_TEST_LT(2.5 * error[1], error[0]);
  }
}

// The label ends at the border of an image; a label without voxels has no surface.
void test_borders()
{
  const Voxel_image_3 full = image_of({6, 5, 4}, identity, [](const auto&) { return true; });
  const Surface box = surface_of(full, 0);
  BOOST_TEST(is_clean(box));
  BOOST_TEST(100 < volume(box) && volume(box) < 120); // edges are cut off
  const Voxel_image_3 none = image_of({6, 5, 4}, identity, [](const auto&) { return false; });
  BOOST_TEST(surface_of(none, 1).is_empty());
  const Voxel_image_3 single = image_of({9, 9, 9}, identity, [](const std::array<double, 3>& p) {
    return p[0] == 4 && p[1] == 4 && p[2] == 4;
  });
  BOOST_TEST(!surface_of(single, 0).is_empty());
  const Surface ball = surface_of(single, 1);
  BOOST_TEST(is_clean(ball) && 0.2 < volume(ball) && volume(ball) < 2);
}

// Fewer vertices give the same body; a surface that is small already does not change.
void test_simplification()
{
  std::mt19937 random(11);
  for(int i = 0; i < 10; ++i) {
    const Voxel_image_3 image = image_of({20, 20, 20}, identity, [&](const std::array<double, 3>& p) {
      return norm(Vec3(p) - Vec3{10, 9, 8}) < 7 && (i < 5 || random() % 4 != 0); // in the end with holes
    });
    const Surface full = surface_of(image, 1);
    Surface s = full;
    simplify_closed_surface(s, 150);
    BOOST_TEST(is_clean(s));
    BOOST_TEST_LT(s.number_of_vertices(), i < 5 ? 160 : full.number_of_vertices());
    BOOST_TEST(std::abs(volume(s) - volume(full)) < 0.02 * volume(full));
    BOOST_TEST_EQ(s.number_of_vertices() + s.number_of_faces() - s.number_of_edges(),
                  full.number_of_vertices() + full.number_of_faces() - full.number_of_edges());
    const std::size_t n = s.number_of_vertices();
    simplify_closed_surface(s, n + 1);
    BOOST_TEST_EQ(s.number_of_vertices(), n);
  }
}

// The kernel keeps volumes: values that it takes from a voxel go to others.
void test_smoothing()
{
  for(double deviation : {0., 0.3, 1., 2.5}) {
    const std::vector<float> kernel = internal::gaussian_kernel(deviation);
    double sum = kernel[0];
    for(std::size_t i = 1; i < kernel.size(); ++i) {
      sum += 2 * double(kernel[i]);
      BOOST_TEST_LT(kernel[i], kernel[i - 1]);
    }
    BOOST_TEST(std::abs(sum - 1) < 1e-6);
  }
  const Voxel_image_3 image = image_of({5, 6, 7}, identity,
                                       [](const std::array<double, 3>& p) { return p[0] == 2 || p[1] == 3; });
  const auto raw = internal::smooth_indicator(image, is_label, {0, 0, 0}, whole_extent(image.grid)),
             smooth = internal::smooth_indicator(image, is_label, {0.5, 1, 1.5}, whole_extent(image.grid));
  const auto sum = [](const std::vector<float>& values) {
    double sum = 0;
    for(float v : values)
      sum += double(v);
    return sum;
  };
  BOOST_TEST(std::abs(sum(raw.values) - sum(smooth.values)) < 1e-3 * sum(raw.values));
}

// Convolution along each axis equals the sum by its definition; the same in several threads.
void test_convolution()
{
  std::mt19937 random(3);
  internal::Indicator start{{{}, {7, 70, 9}}, {}};
  for(std::size_t i = 0; i < 7 * 70 * 9; ++i)
    start.values.push_back(float(random() % 100));
  const std::vector<float> kernel = internal::gaussian_kernel(1.3);
  for(int axis = 0; axis < 3; ++axis) {
    internal::Indicator once = start, again = start;
    internal::convolve(once, axis, kernel, 1);
    internal::convolve(again, axis, kernel, 4);
    BOOST_TEST(once.values == again.values);
    std::array<std::size_t, 3> p;
    for(p[0] = 0; p[0] < start.size[0]; ++p[0])
      for(p[1] = 0; p[1] < start.size[1]; ++p[1])
        for(p[2] = 0; p[2] < start.size[2]; ++p[2]) {
          double sum = 0;
          std::array<std::size_t, 3> q = p;
          for(q[axis] = 0; q[axis] < start.size[axis]; ++q[axis]) {
            const auto distance = std::size_t(std::abs(std::ptrdiff_t(p[axis]) - std::ptrdiff_t(q[axis])));
            if(distance < kernel.size())
              sum += double(kernel[distance]) * double(start.values[start.offset(q)]);
          }
          BOOST_TEST_LT(std::abs(double(once.values[once.offset(p)]) - sum), 1e-3);
        }
  }
}

// The level equals that by sorting all values, with few candidates at first, and with many.
void test_level()
{
  std::mt19937 random(5);
  for(const double largest : {0.1, 1.}) {
    std::vector<float> values;
    for(int i = 0; i < 1000; ++i)
      values.push_back(float(largest * double(random() % 10000) / 10000));
    std::vector<float> sorted = values;
    std::sort(sorted.begin(), sorted.end(), std::greater<float>());
    for(const std::size_t n : {1u, 10u, 500u, 900u})
      BOOST_TEST_EQ(internal::level_above(values, n), (sorted[n - 1] + sorted[n]) / 2);
  }
}

// The extents of all values equal those of a pass for each value; a surface made with its extent is the same
// as without, in one thread and in several.
void test_extents()
{
  std::mt19937 random(13);
  Voxel_image_3 image = image_of({30, 25, 20}, identity, [](const auto&) { return false; });
  for(int value = 1; value <= 6; ++value) {
    const Vec3 center{double(random() % 30), double(random() % 25), double(random() % 20)};
    for(std::size_t i = 0; i < image.values.size(); ++i) {
      const Vec3 p{double(i % 30), double(i / 30 % 25), double(i / 750)};
      if(norm(p - center) < 2 + value)
        image.values[i] = value == 6 ? std::numeric_limits<float>::quiet_NaN() : float(value);
    }
  }
  const std::map<float, Label_extent_3> extents = label_extents(image);
  std::size_t number = 0;
  for(const auto& [value, extent] : extents) {
    const float label = value;
    const auto has_label = [label](float v) { return v == label; };
    const auto box = internal::box_of_label(image, has_label, {0, 0, 0}, whole_extent(image.grid));
    for(int i = 0; i < 3; ++i) {
      BOOST_TEST_EQ(extent.first[i], std::size_t(box.first[i]));
      BOOST_TEST_EQ(extent.last[i], std::size_t(box.first[i]) + box.size[i]);
    }
    BOOST_TEST_EQ(extent.number_of_voxels, internal::number_with_label(box));
    number += extent.number_of_voxels;
    Surface whole, within;
    make_label_surface(image, has_label, 1, whole);
    make_label_surface<CGAL::Parallel_if_available_tag>(image, has_label, 1, within, 0, extent);
    BOOST_TEST(std::equal(whole.points().begin(), whole.points().end(), within.points().begin(),
                          within.points().end()));
  }
  BOOST_TEST_LT(number, image.values.size()); // without those that are no number
}

// A torus of many vertices keeps its handle, and each vertex stays near to it, nearer than with half as many
// vertices.
void test_far_simplification()
{
  constexpr double large = 20, small = 7;
  const auto off = [](const Surface& s) {
    double largest = 0;
    for(auto v : s.vertices()) {
      const Vec3 p = to_vec3(s.point(v)) - Vec3{30, 30, 12};
      largest = (std::max)(largest, std::abs(std::hypot(std::hypot(p[0], p[1]) - large, p[2]) - small));
    }
    return largest;
  };
  const Voxel_image_3 image = image_of({61, 61, 25}, identity, [](const std::array<double, 3>& p) {
    return std::hypot(std::hypot(p[0] - 30, p[1] - 30) - large, p[2] - 12) < small;
  });
  const Surface full = surface_of(image, 1);
  for(const std::size_t n : {1000u, 500u, 250u}) {
    Surface s = full;
    simplify_closed_surface(s, n);
    std::cout << "torus: " << full.number_of_vertices() << " vertices off by up to " << off(full) << ", "
              << s.number_of_vertices() << " by up to " << off(s) << '\n';
    BOOST_TEST(is_clean(s));
    BOOST_TEST(0.95 * double(n) < double(s.number_of_vertices())
               && double(s.number_of_vertices()) < 1.1 * double(n));
    BOOST_TEST_EQ(s.number_of_vertices() + s.number_of_faces(), s.number_of_edges());
    BOOST_TEST(std::abs(volume(s) / volume(full) - 1) < 0.005);
    BOOST_TEST_LT(off(s), off(full) + 50. / double(n));
  }
}

int run(int, char*[])
{
  test_convolution();
  test_level();
  test_extents();
  test_far_simplification();
  test_all_patterns();
  test_random_images();
  test_ball();
  test_borders();
  test_simplification();
  test_smoothing();
  return boost::report_errors();
}

} // namespace test_label_surface
