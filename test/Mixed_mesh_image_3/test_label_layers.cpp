// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Labels that grow, and holes that get a label, compared with their definitions by brute force.

#include "test_images.h"

#include <CGAL/Mixed_mesh_image_3/fill_label_holes.h>
#include <CGAL/Mixed_mesh_image_3/grow_label.h>

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

int run(int, char*[])
{
  test_growth();
  test_holes();
  test_no_label();
  return boost::report_errors();
}

} // namespace test_label_layers
