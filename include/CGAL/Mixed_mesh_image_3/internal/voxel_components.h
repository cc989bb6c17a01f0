// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_IMAGE_3_INTERNAL_VOXEL_COMPONENTS_H
#define CGAL_MIXED_MESH_IMAGE_3_INTERNAL_VOXEL_COMPONENTS_H

#include <CGAL/Mixed_mesh_image_3/internal/Voxel_box.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The connected components of the voxels of a box, with label and without.
struct Voxel_components
{
  std::vector<std::uint32_t> numbers; ///< component of each voxel; 0 is outside
  std::vector<std::size_t> sizes;     ///< size of each component, in voxels
  std::vector<std::uint8_t> has_label;
};

/// The connected components. Voxels are neighbors if an edge of Kuhn's tetrahedra connects their centers, as
/// in the surface of marching tetrahedra: without smoothing, the components of the surface are the borders of
/// these components.
/// \pre no voxel at the border of the box has the label
inline Voxel_components voxel_components(const Labeled_box& box)
{
  constexpr std::uint32_t none = std::uint32_t(-1);
  const std::array<std::size_t, 3> strides = box.strides();
  const std::size_t n = box.has_label.size();
  Voxel_components components{std::vector<std::uint32_t>(n, none), {}, {}};
  std::vector<std::size_t> found;
  const auto add = [&](std::size_t voxel, std::uint32_t number) {
    components.numbers[voxel] = number;
    ++components.sizes[number];
    found.push_back(voxel);
  };
  const auto begin = [&](std::uint8_t has_label) {
    components.sizes.push_back(0);
    components.has_label.push_back(has_label);
    return std::uint32_t(components.sizes.size() - 1);
  };
  // A step over the border leads to another voxel of the border, or beyond the box: no voxel is found there.
  const auto grow = [&](std::uint32_t number) {
    while(!found.empty()) {
      const std::size_t voxel = found.back();
      found.pop_back();
      for(std::size_t direction = 1; direction < 8; ++direction) {
        std::size_t step = 0;
        for(int axis = 0; axis < 3; ++axis)
          step += (direction >> axis & 1) * strides[axis];
        for(const std::size_t neighbor : {voxel - step, voxel + step})
          if(neighbor < n && components.numbers[neighbor] == none
             && box.has_label[neighbor] == components.has_label[number])
            add(neighbor, number);
      }
    }
  };
  const auto is_at_border = [&](std::size_t voxel) {
    for(int axis = 0; axis < 3; ++axis) {
      const std::size_t i = voxel / strides[axis] % box.size[axis];
      if(i == 0 || i + 1 == box.size[axis])
        return true;
    }
    return false;
  };
  const std::uint32_t outside = begin(0);
  for(std::size_t voxel = 0; voxel < n; ++voxel)
    if(is_at_border(voxel))
      add(voxel, outside);
  grow(outside);
  for(std::size_t voxel = 0; voxel < n; ++voxel)
    if(components.numbers[voxel] == none) {
      const std::uint32_t number = begin(box.has_label[voxel]);
      add(voxel, number);
      grow(number);
    }
  return components;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_INTERNAL_VOXEL_COMPONENTS_H
