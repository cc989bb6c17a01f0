// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Labels that grow, holes that get a label, and how thin labels are, compared with their definitions by brute
// force; the thickness of layers around a ball.

#include "test_images.h"

#include <CGAL/Mixed_mesh_image_3/fill_label_holes.h>
#include <CGAL/Mixed_mesh_image_3/grow_label.h>
#include <CGAL/Mixed_mesh_image_3/label_thickness.h>

#include <boost/core/lightweight_test.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace test_label_layers {

using namespace CGAL::Mixed_meshes_3;
using Voxel = std::array<int, 3>;

constexpr float LABEL = 3, OTHER = 1, BACKGROUND = 0, NEW = -1;
const auto is_label = [](float value) { return value == LABEL; };
const auto is_background = [](float value) { return value == BACKGROUND; };

// \param least the least size along each axis
// \param share of the voxels that have the label, in twelfths; one twelfth has another label
Voxel_image_3 random_image(std::mt19937& random, unsigned least, unsigned share)
{
  Voxel_image_3 image;
  image.grid.size = {least + random() % 9, least + random() % 8, least + random() % 6};
  image.grid.index_to_world = oblique({0.7, 1.1, 2.3}, {-100, 20, 3000}, random() % 2 == 0);
  for(std::size_t v = 0; v < image.grid.number_of_voxels(); ++v) {
    const unsigned twelfth = random() % 12;
    image.values.push_back(twelfth < share ? LABEL : twelfth == 11 ? OTHER : BACKGROUND);
  }
  return image;
}

std::vector<Voxel> voxels_of(const Voxel_grid_3& grid)
{
  std::vector<Voxel> voxels; // in the order of values
  for(int k = 0; k < int(grid.size[2]); ++k)
    for(int j = 0; j < int(grid.size[1]); ++j)
      for(int i = 0; i < int(grid.size[0]); ++i)
        voxels.push_back({i, j, k});
  return voxels;
}

double distance(const Voxel& a, const Voxel& b, const Affine_map_3& map)
{
  double squared = 0;
  for(int r = 0; r < 3; ++r) {
    double x = 0;
    for(int i = 0; i < 3; ++i)
      x += map[r][i] * (a[i] - b[i]);
    squared += x * x;
  }
  return std::sqrt(squared);
}

void test_growth()
{
  std::mt19937 random(21);
  std::size_t number_grown = 0;
  for(int n = 0; n < 60; ++n) {
    const Voxel_image_3 image = random_image(random, 1, unsigned(n % 4));
    const std::vector<Voxel> voxels = voxels_of(image.grid);
    for(double reach : {0., 0.5, 0.7, 1.5, 3.3, 50.})
      for(float value : {LABEL, NEW}) {
        Voxel_image_3 grown = image;
        const std::size_t number = grow_label(grown, is_label, is_background, reach, value);
        std::size_t expected_number = 0;
        bool is_right = grown.grid.size == image.grid.size;
        for(std::size_t v = 0; v < voxels.size(); ++v) {
          bool is_near = false;
          for(std::size_t w = 0; w < voxels.size(); ++w)
            is_near = is_near
                      || (is_label(image.values[w])
                          && distance(voxels[v], voxels[w], image.grid.index_to_world) <= reach * (1 + 1e-7));
          const bool becomes_label = is_near && is_background(image.values[v]);
          is_right = is_right && grown.values[v] == (becomes_label ? value : image.values[v]);
          expected_number += becomes_label;
        }
        BOOST_TEST(is_right);
        BOOST_TEST_EQ(number, expected_number);
        BOOST_TEST(reach > 0.69 || number == 0); // no neighbor is that near
        number_grown += number;
      }
  }
  BOOST_TEST_GT(number_grown, 1000u);
}

bool are_neighbors(const Voxel& a, const Voxel& b)
{
  bool is_up = true, is_down = true; // an edge of Kuhn's tetrahedra goes up along each axis, or not at all
  for(int i = 0; i < 3; ++i) {
    is_up = is_up && (b[i] - a[i] == 0 || b[i] - a[i] == 1);
    is_down = is_down && (a[i] - b[i] == 0 || a[i] - b[i] == 1);
  }
  return is_up || is_down;
}

void test_holes()
{
  std::mt19937 random(22);
  std::size_t number_filled = 0, number_kept = 0;
  for(int n = 0; n < 100; ++n) {
    const Voxel_image_3 image = random_image(random, 3, 8 + unsigned(n % 4));
    const std::vector<Voxel> voxels = voxels_of(image.grid);
    // Voxels that are not enclosed: those at the border, then their neighbors until there are no more.
    std::vector<bool> is_outside(voxels.size(), false);
    for(bool has_grown = true; has_grown;) {
      has_grown = false;
      for(std::size_t v = 0; v < voxels.size(); ++v) {
        bool is_reached = false;
        for(int i = 0; i < 3; ++i)
          is_reached = is_reached || voxels[v][i] == 0 || voxels[v][i] + 1 == int(image.grid.size[i]);
        for(std::size_t w = 0; w < voxels.size(); ++w)
          is_reached = is_reached || (is_outside[w] && are_neighbors(voxels[v], voxels[w]));
        if(is_reached && !is_label(image.values[v]) && !is_outside[v])
          is_outside[v] = has_grown = true;
      }
    }
    Voxel_image_3 filled = image;
    const std::size_t number = fill_label_holes(filled, is_label, is_background, NEW);
    std::size_t expected_number = 0;
    bool is_right = true;
    for(std::size_t v = 0; v < voxels.size(); ++v) {
      const bool is_enclosed = !is_label(image.values[v]) && !is_outside[v];
      const bool is_filled = is_enclosed && is_background(image.values[v]);
      is_right = is_right && filled.values[v] == (is_filled ? NEW : image.values[v]);
      expected_number += is_filled;
      number_kept += is_enclosed && !is_filled;
    }
    BOOST_TEST(is_right);
    BOOST_TEST_EQ(number, expected_number);
    number_filled += number;
  }
  BOOST_TEST_GT(number_filled, 30u);
  BOOST_TEST_GT(number_kept, 30u);
}

void test_no_label()
{
  Voxel_image_3 image;
  image.grid.size = {3, 4, 5};
  image.values.assign(60, BACKGROUND);
  const std::vector<float> before = image.values;
  BOOST_TEST_EQ(grow_label(image, is_label, is_background, 2, NEW), 0u);
  BOOST_TEST_EQ(fill_label_holes(image, is_label, is_background, NEW), 0u);
  BOOST_TEST(image.values == before);
}

// Each voxel of a row has its part of what the row counts.
void test_thickness()
{
  std::mt19937 random(8);
  for(int i = 0; i < 40; ++i) {
    const Voxel_image_3 image = random_image(random, 1, unsigned(i % 8));
    const std::array<std::size_t, 3>& size = image.grid.size;
    const std::array<double, 3> spacing = voxel_spacing(image.grid);
    const double volume = std::abs(determinant(image.grid.index_to_world));
    std::array<Label_thickness_3, 3> expected;
    const auto label_of = [](float value) {
      return std::size_t(is_label(value) ? 2 : value == OTHER ? 1 : 0);
    };
    const auto label_at = [&](const Voxel& v) {
      return label_of(
        image.values[image.grid.offset(std::size_t(v[0]), std::size_t(v[1]), std::size_t(v[2]))]);
    };
    for(const Voxel& v : voxels_of(image.grid)) {
      const std::size_t l = label_at(v);
      for(std::size_t axis = 0; axis < 3; ++axis) {
        int n = 1;
        bool is_between = true;
        for(int step : {-1, 1}) {
          Voxel w = v;
          w[axis] += step;
          const auto is_in_image = [&] { return w[axis] >= 0 && w[axis] < int(size[axis]); };
          for(; is_in_image() && label_at(w) == l; w[axis] += step)
            ++n;
          is_between = is_between && is_in_image();
        }
        const double area = volume / spacing[axis] / n;
        if(l > 0 || is_between)
          expected[l].thinness += 8. / 3 * area / std::pow(n * spacing[axis], 2);
        expected[l].area += l > 0 ? 4. / 3 * area : 0;
      }
      expected[l].volume += l > 0 ? volume : 0;
    }
    const std::vector<Label_thickness_3> thickness = label_thickness(image, 2, label_of);
    BOOST_TEST_EQ(thickness.size(), 3u);
    const auto is_near = [](double x, double y) {
      return std::abs(x - y) <= 1e-9 * (std::abs(x) + std::abs(y));
    };
    for(std::size_t l = 0; l < 3; ++l)
      BOOST_TEST(is_near(thickness[l].thinness, expected[l].thinness)
                 && is_near(thickness[l].area, expected[l].area)
                 && is_near(thickness[l].volume, expected[l].volume));
  }
}

// Two layers around a ball, and a gap between them.
void test_thickness_of_layers()
{
  Voxel_image_3 image;
  image.grid.size = {90, 70, 60};
  image.grid.index_to_world = oblique({1, 1.25, 1.5}, {-100, 20, 3000}, false);
  const std::array<double, 3> spacing = voxel_spacing(image.grid);
  for(const Voxel& v : voxels_of(image.grid)) {
    const double r = std::hypot(spacing[0] * v[0] - 44, spacing[1] * v[1] - 43, spacing[2] * v[2] - 44);
    image.values.push_back(r < 26 ? 0.f : r < 31 ? 1.f : r < 35 ? 0.f : r < 42 ? 2.f : 0.f);
  }
  const auto thickness = label_thickness(image, 2, [](float value) { return std::size_t(value); });
  const auto area = [](double radius) { return 4 * CGAL_PI * radius * radius; };
  const auto is_about = [](double x, double y) { return std::abs(x / y - 1) < 0.1; };
  BOOST_TEST(is_about(thickness[1].thickness(), 5) && is_about(thickness[2].thickness(), 7));
  BOOST_TEST(is_about(thickness[1].area, area(26) + area(31)));
  BOOST_TEST(std::abs(thickness[1].thinness / (2 * area(28.5) / 25) - 1) < 0.25);
  BOOST_TEST(std::abs(thickness[2].thinness / (2 * area(38.5) / 49) - 1) < 0.25);
  BOOST_TEST(std::abs(thickness[0].thinness / (2 * area(33) / 16) - 1) < 0.3); // the inner ball is thick
}

int run(int, char*[])
{
  test_growth();
  test_holes();
  test_no_label();
  test_thickness();
  test_thickness_of_layers();
  return boost::report_errors();
}

} // namespace test_label_layers
