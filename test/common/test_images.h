// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Images, and a mesh in one of them, for the tests of images.

#ifndef MIXED_MESH_3_TEST_IMAGES_H
#define MIXED_MESH_3_TEST_IMAGES_H

#include "test_meshes.h"

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

using CGAL::Mixed_meshes_3::Affine_map_3;
using CGAL::Mixed_meshes_3::Vec3;
using CGAL::Mixed_meshes_3::Voxel_grid_3;
using CGAL::Mixed_meshes_3::Voxel_image_3;

using Mesh = CGAL::Mixed_mesh_3<CGAL::Mixed_meshes_3::Predicates_kernel>;

// A rotation about a general axis, times sizes; `mirror` flips the first axis.
inline Affine_map_3 oblique(const Vec3& sizes, const Vec3& origin, bool mirror)
{
  const double a = 0.3, b = -0.5, c = 0.2;
  const double r[3][3] = {{std::cos(b) * std::cos(c), -std::cos(b) * std::sin(c), std::sin(b)},
                          {std::cos(a) * std::sin(c) + std::sin(a) * std::sin(b) * std::cos(c),
                           std::cos(a) * std::cos(c) - std::sin(a) * std::sin(b) * std::sin(c),
                           -std::sin(a) * std::cos(b)},
                          {std::sin(a) * std::sin(c) - std::cos(a) * std::sin(b) * std::cos(c),
                           std::sin(a) * std::cos(c) + std::cos(a) * std::sin(b) * std::sin(c),
                           std::cos(a) * std::cos(b)}};
  Affine_map_3 map;
  for(int i = 0; i < 3; ++i) {
    for(int j = 0; j < 3; ++j)
      map[i][j] = r[i][j] * sizes[j] * (mirror && j == 0 ? -1 : 1);
    map[i][3] = origin[i];
  }
  return map;
}

inline double difference(const Affine_map_3& a, const Affine_map_3& b)
{
  double d = 0;
  for(int i = 0; i < 3; ++i)
    for(int j = 0; j < 4; ++j)
      d = (std::max)(d, std::abs(a[i][j] - b[i][j]));
  return d;
}

inline constexpr Affine_map_3 identity{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

// An image of a function of the indices.
template <class F>
Voxel_image_3 image_of(const std::array<std::size_t, 3>& size, const Affine_map_3& map, const F& value)
{
  Voxel_image_3 image;
  image.grid.size = size;
  image.grid.index_to_world = map;
  for(std::size_t k = 0; k < size[2]; ++k)
    for(std::size_t j = 0; j < size[1]; ++j)
      for(std::size_t i = 0; i < size[0]; ++i)
        image.values.push_back(float(value(std::array<double, 3>{double(i), double(j), double(k)})));
  return image;
}

// A linear function of the world, which linear interpolation reproduces exactly.
inline double ramp(const Vec3& x) { return 100 + 0.7 * x[0] - 0.4 * x[1] + 0.9 * x[2]; }

inline Voxel_image_3 ramp_image(const Affine_map_3& map, const std::array<std::size_t, 3>& size)
{
  Voxel_image_3 image;
  image.grid.size = size;
  image.grid.index_to_world = map;
  image.values.resize(image.grid.number_of_voxels());
  for(std::size_t k = 0; k < size[2]; ++k)
    for(std::size_t j = 0; j < size[1]; ++j)
      for(std::size_t i = 0; i < size[0]; ++i)
        image.values[image.grid.offset(i, j, k)] = float(
          ramp(CGAL::Mixed_meshes_3::transform(map, Vec3(double(i), double(j), double(k)))));
  return image;
}

template <class F>
void for_each_voxel_center(const Voxel_grid_3& grid, const F& f)
{
  for(std::size_t k = 0; k < grid.size[2]; ++k)
    for(std::size_t j = 0; j < grid.size[1]; ++j)
      for(std::size_t i = 0; i < grid.size[0]; ++i)
        f(grid.offset(i, j, k),
          CGAL::Mixed_meshes_3::transform(grid.index_to_world, Vec3(double(i), double(j), double(k))));
}

struct Scene
{
  Mesh mesh = four_kinds<Mesh>(20, {-15, -8, -18}, 0.1);
  Voxel_image_3 image;

  explicit Scene(bool mirror)
  {
    image = ramp_image(oblique({1.1, 0.9, 1.3}, {0, 0, 0}, mirror), {61, 57, 49});
    // The map takes the middle of the image to the origin.
    const Vec3 middle = CGAL::Mixed_meshes_3::transform(image.grid.index_to_world, Vec3(30, 28, 24));
    Affine_map_3 map = image.grid.index_to_world;
    for(int i = 0; i < 3; ++i)
      map[i][3] = -middle[i];
    image = ramp_image(map, image.grid.size);
  }

  std::vector<Vec3> displacements(const std::function<Vec3(const Vec3&)>& u) const
  {
    std::vector<Vec3> result;
    for(const auto& p : mesh.points())
      result.push_back(u({p.x(), p.y(), p.z()}));
    return result;
  }
};

inline Vec3 bend(const Vec3& x)
{
  return {2 * std::sin(x[1] / 15), 1.5 * std::cos(x[2] / 11) - 1, -3 * std::exp(-x[0] * x[0] / 200)};
}

#endif // MIXED_MESH_3_TEST_IMAGES_H
