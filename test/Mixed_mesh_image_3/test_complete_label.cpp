// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Completion of labels: each step compared with its definition by brute force, and with the surface of the
// label.

#include "test_images.h"

#include <CGAL/Mixed_mesh_image_3/complete_label.h>
#include <CGAL/Mixed_mesh_image_3/make_label_surface.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Surface_mesh.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

namespace test_complete_label {

using namespace CGAL::Mixed_meshes_3;
using Surface = CGAL::Surface_mesh<Predicates_kernel::Point_3>;
using Voxel = std::array<int, 3>;

const auto is_label = [](float value) { return value == 3; };
const auto is_one = [](float value) { return value == 1; };

// The label is 3, and there are others.
Voxel_image_3 image_of(const std::array<std::size_t, 3>& size, const Affine_map_3& map,
                       const std::function<bool(const Voxel&)>& has_label)
{
  Voxel_image_3 image;
  image.grid.size = size;
  image.grid.index_to_world = map;
  for(int k = 0; k < int(size[2]); ++k)
    for(int j = 0; j < int(size[1]); ++j)
      for(int i = 0; i < int(size[0]); ++i)
        image.values.push_back(has_label({i, j, k}) ? 3.f : float((i + j + k) % 3));
  return image;
}

// \param share of the voxels that have the label, in twelfths
Voxel_image_3 random_image(std::mt19937& random, unsigned share)
{
  const std::array<std::size_t, 3> size{2 + random() % 8, 2 + random() % 8, 1 + random() % 6};
  return image_of(size, oblique({0.7, 1.1, 2.3}, {-100, 20, 3000}, random() % 2 == 0),
                  [&](const Voxel&) { return random() % 12 < share; });
}

// A mask of voxels with the label; no voxel beyond the image has the label.
class Mask
{
  std::array<int, 3> m_size;
  std::vector<std::uint8_t> m_voxels;

public:
  template <class HasLabel>
  Mask(const Voxel_image_3& image, const HasLabel& has_label)
  {
    for(int i = 0; i < 3; ++i)
      m_size[i] = int(image.grid.size[i]);
    for(float value : image.values)
      m_voxels.push_back(has_label(value));
  }

  const std::array<int, 3>& size() const { return m_size; }
  std::size_t number() const { return std::size_t(std::count(m_voxels.begin(), m_voxels.end(), 1)); }
  friend bool operator==(const Mask& a, const Mask& b) { return a.m_voxels == b.m_voxels; }
  bool contains(const Mask& other) const
  {
    for(std::size_t v = 0; v < m_voxels.size(); ++v)
      if(other.m_voxels[v] && !m_voxels[v])
        return false;
    return true;
  }
  bool operator()(const Voxel& p) const
  {
    for(int i = 0; i < 3; ++i)
      if(p[i] < 0 || p[i] >= m_size[i])
        return false;
    return m_voxels[std::size_t(p[0] + m_size[0] * (p[1] + m_size[1] * p[2]))];
  }
  template <class F>
  void for_each(int margin, const F& f) const
  {
    for(int k = -margin; k < m_size[2] + margin; ++k)
      for(int j = -margin; j < m_size[1] + margin; ++j)
        for(int i = -margin; i < m_size[0] + margin; ++i)
          f(Voxel{i, j, k});
  }
};

// Whether a voxel is not covered by any ball that avoids the label, by that definition.
bool is_closed_voxel(const Mask& mask, const Voxel& p, double radius, const std::array<double, 3>& spacing)
{
  const auto is_near = [&](const Voxel& a, const Voxel& b) {
    double sum = 0;
    for(int i = 0; i < 3; ++i)
      sum += (a[i] - b[i]) * spacing[i] * (a[i] - b[i]) * spacing[i];
    return sum <= radius * radius * (1 + 1e-6);
  };
  bool is_free = false; // a ball covers the voxel, and avoids the label
  mask.for_each(int(radius / 0.7) + 1, [&](const Voxel& center) {
    if(is_free || !is_near(center, p))
      return;
    bool meets_label = false;
    mask.for_each(0, [&](const Voxel& q) { meets_label = meets_label || (mask(q) && is_near(center, q)); });
    is_free = !meets_label;
  });
  return !is_free;
}

void test_closing()
{
  std::mt19937 random(11);
  std::size_t number_closed = 0;
  for(int n = 0; n < 40; ++n) {
    const Voxel_image_3 image = random_image(random, 1 + unsigned(n % 7));
    const std::array<double, 3> spacing = voxel_spacing(image.grid);
    for(double radius : {0.5, 1.5, 3.3}) {
      Label_completion_options options;
      options.closing_radius = radius;
      Label_completion_result result;
      const Voxel_image_3 closed = complete_label(image, is_label, options, &result);
      const Mask before(image, is_label), after(closed, is_one);
      bool is_right = true;
      before.for_each(0, [&](const Voxel& p) {
        is_right = is_right && after(p) == is_closed_voxel(before, p, radius, spacing);
      });
      BOOST_TEST(is_right);
      BOOST_TEST(after.contains(before));
      BOOST_TEST(radius > 0.69 || after == before);                               // no neighbor is that near
      BOOST_TEST(Mask(complete_label(closed, is_one, options), is_one) == after); // once is enough
      BOOST_TEST_EQ(result.number_of_voxels, before.number());
      BOOST_TEST_EQ(result.number_of_voxels + result.number_of_closed_voxels, after.number());
      number_closed += result.number_of_closed_voxels;
    }
  }
  BOOST_TEST_GT(number_closed, 1000u);
}

// The number of components of the surface without smoothing.
std::size_t number_of_components(const Voxel_image_3& image)
{
  Surface surface;
  make_label_surface(image, is_one, 0, surface);
  auto component = surface.add_property_map<Surface::Face_index, std::size_t>("f:component", 0).first;
  return CGAL::Polygon_mesh_processing::connected_components(surface, component);
}

// Components of the surface: one around each component of the label, and one around each hole.
void test_components()
{
  std::mt19937 random(12);
  std::size_t number_of_holes = 0, number_removed = 0;
  for(int n = 0; n < 200; ++n) {
    const Voxel_image_3 image = random_image(random, n % 2 == 0 ? 9 : 3);
    const Mask before(image, is_label);
    Label_completion_options options;
    const Voxel_image_3 same = complete_label(image, is_label, options);
    BOOST_TEST(Mask(same, is_one) == before);
    BOOST_TEST(same.grid.size == image.grid.size && same.grid.index_to_world == image.grid.index_to_world);
    if(before.number() == 0)
      continue;

    options.fill_holes = true;
    Label_completion_result filled_result;
    const Voxel_image_3 filled = complete_label(image, is_label, options, &filled_result);
    const Mask after_filling(filled, is_one);
    BOOST_TEST(after_filling.contains(before));
    BOOST_TEST_EQ(before.number() + filled_result.number_of_filled_voxels, after_filling.number());
    BOOST_TEST(Mask(complete_label(filled, is_one, options), is_one) == after_filling);
    number_of_holes += number_of_components(same) > number_of_components(filled);

    // Without holes, each component of the surface is around one component of the label.
    Label_completion_result result;
    options.keep_largest = true;
    const Voxel_image_3 largest = complete_label(image, is_label, options, &result);
    BOOST_TEST_EQ(number_of_components(largest), 1u);
    BOOST_TEST_EQ(number_of_components(filled), 1 + result.number_of_removed_components);
    BOOST_TEST_EQ(Mask(largest, is_one).number() + result.number_of_removed_voxels, after_filling.number());
    number_removed += result.number_of_removed_components;

    // With the volume of the largest component as the least volume, the largest is kept, and no smaller one.
    options.keep_largest = false;
    options.least_volume = double(Mask(largest, is_one).number()) * 0.7 * 1.1 * 2.3 * (1 - 1e-9);
    const Mask large(complete_label(image, is_label, options), is_one);
    BOOST_TEST(large.contains(Mask(largest, is_one)));
    BOOST_TEST_EQ(large.number() % Mask(largest, is_one).number(), 0u);
    options.least_volume *= 1.01;
    BOOST_TEST_EQ(Mask(complete_label(image, is_label, options), is_one).number(), 0u);
  }
  BOOST_TEST_GT(number_of_holes, 5u);
  BOOST_TEST_GT(number_removed, 100u);
}

// A thick shell with a hole in it, and a speck: a hull is the ball.
void test_hull()
{
  const auto distance = [](const Voxel& p) { return std::hypot(p[0] - 20., p[1] - 20., (p[2] - 10.) * 2); };
  const Voxel_image_3 image = image_of({45, 41, 21}, {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 2, 0}}},
                                       [&](const Voxel& p) {
                                         const bool is_in_hole = p[0] > 20 && std::abs(p[1] - 20) < 3
                                                                 && std::abs(p[2] - 10) < 2;
                                         return (distance(p) <= 18 && distance(p) > 9 && !is_in_hole)
                                                || (p[0] == 44 && p[1] == 0);
                                       });
  Label_completion_options options;
  options.fill_holes = true;
  options.keep_largest = true;
  const Mask open(complete_label(image, is_label, options), is_one);
  BOOST_TEST(!open({20, 20, 10})); // through the hole, the inside is outside
  options.closing_radius = 4;
  Label_completion_result result;
  const Mask hull(complete_label(image, is_label, options, &result), is_one);
  std::size_t number_missing = 0;
  hull.for_each(0, [&](const Voxel& p) {
    BOOST_TEST(!hull(p) || distance(p) <= 18);
    number_missing += !hull(p) && distance(p) <= 18;
  });
  BOOST_TEST(hull({20, 20, 10}));
  BOOST_TEST_LT(number_missing, 20u); // where the hole was, a ball that rolls over it is a little below
  BOOST_TEST_EQ(result.number_of_removed_components, 1u);
  BOOST_TEST_EQ(result.number_of_removed_voxels, 21u);
  BOOST_TEST(result.number_of_closed_voxels > 100 && result.number_of_filled_voxels > 100);

  const Voxel_image_3 empty = image_of({3, 3, 3}, image.grid.index_to_world,
                                       [](const Voxel&) { return false; });
  BOOST_TEST_EQ(Mask(complete_label(empty, is_label, options), is_one).number(), 0u);
}

int run(int, char*[])
{
  test_closing();
  test_components();
  test_hull();
  return boost::report_errors();
}

} // namespace test_complete_label
