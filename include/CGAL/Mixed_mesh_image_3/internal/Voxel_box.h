// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_IMAGE_3_INTERNAL_VOXEL_BOX_H
#define CGAL_MIXED_MESH_IMAGE_3_INTERNAL_VOXEL_BOX_H

#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>
#include <CGAL/Mixed_mesh_image_3/label_extents.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// A box of voxels, which may reach beyond the image. The first index runs fastest.
struct Voxel_box
{
  std::array<std::int64_t, 3> first{}; // index in the image of the box's first voxel
  std::array<std::size_t, 3> size{};

  std::array<std::size_t, 3> strides() const { return {1, size[0], size[0] * size[1]}; }
  std::size_t offset(const std::array<std::size_t, 3>& p) const
  {
    return p[0] + size[0] * (p[1] + size[1] * p[2]);
  }
};

/// Calls `f(v, w)` for each voxel of the box that is in the image: `v` is its offset in the box, `w` that in
/// the image.
template <class F>
void for_each_in_image(const Voxel_box& box, const Voxel_grid_3& grid, const F& f)
{
  std::array<std::size_t, 3> low, high; // indices in the box
  for(int i = 0; i < 3; ++i) {
    low[i] = std::size_t((std::max)(std::int64_t(0), -box.first[i]));
    high[i] = std::size_t(
      std::clamp(std::int64_t(grid.size[i]) - box.first[i], std::int64_t(0), std::int64_t(box.size[i])));
  }
  const auto in_image = [&box](std::size_t p, int i) { return std::size_t(std::int64_t(p) + box.first[i]); };
  for(std::size_t k = low[2]; k < high[2]; ++k)
    for(std::size_t j = low[1]; j < high[1]; ++j)
      for(std::size_t i = low[0]; i < high[0]; ++i)
        f(box.offset({i, j, k}), grid.offset(in_image(i, 0), in_image(j, 1), in_image(k, 2)));
}

/// Gives a value to those voxels of the background for which `is_chosen(v)`, where `v` is the offset in the
/// box.
/// \return their number
template <class IsChosen, class IsBackground>
std::size_t set_background(Voxel_image_3& image, const Voxel_box& box, const IsChosen& is_chosen,
                           const IsBackground& is_background, float value)
{
  std::size_t number = 0;
  for_each_in_image(box, image.grid, [&](std::size_t in_box, std::size_t in_image) {
    float& voxel = image.values[in_image];
    if(!is_chosen(in_box) || !is_background(voxel))
      return;
    voxel = value;
    ++number;
  });
  return number;
}

/// Voxels of a label in the box around the label; empty if no voxel has the label.
struct Labeled_box : Voxel_box
{
  std::vector<std::uint8_t> has_label;
};

/// \param margin number of voxels without label on each side of the label, along each axis
/// \param extent box that is examined
template <class HasLabel>
Labeled_box box_of_label(const Voxel_image_3& image, const HasLabel& has_label,
                         const std::array<std::size_t, 3>& margin, const Label_extent_3& extent)
{
  const Voxel_grid_3& grid = image.grid;
  std::array<std::size_t, 3> low = grid.size, high{};
  const auto for_each_voxel = [&](const auto& f) {
    for(std::size_t k = extent.first[2]; k < extent.last[2]; ++k)
      for(std::size_t j = extent.first[1]; j < extent.last[1]; ++j)
        for(std::size_t i = extent.first[0]; i < extent.last[0]; ++i)
          if(has_label(image.values[grid.offset(i, j, k)]))
            f(std::array<std::size_t, 3>{i, j, k});
  };
  for_each_voxel([&](const std::array<std::size_t, 3>& voxel) {
    for(int i = 0; i < 3; ++i) {
      low[i] = (std::min)(low[i], voxel[i]);
      high[i] = (std::max)(high[i], voxel[i] + 1);
    }
  });
  Labeled_box box;
  if(high[0] == 0)
    return box;
  for(int i = 0; i < 3; ++i) {
    box.first[i] = std::int64_t(low[i]) - std::int64_t(margin[i]);
    box.size[i] = high[i] - low[i] + 2 * margin[i];
  }
  box.has_label.assign(box.size[0] * box.size[1] * box.size[2], 0);
  for_each_voxel([&](const std::array<std::size_t, 3>& voxel) {
    std::array<std::size_t, 3> p;
    for(int i = 0; i < 3; ++i)
      p[i] = std::size_t(std::int64_t(voxel[i]) - box.first[i]);
    box.has_label[box.offset(p)] = 1;
  });
  return box;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_INTERNAL_VOXEL_BOX_H
