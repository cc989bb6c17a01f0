// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Euclidean distance transform of Felzenszwalb and Huttenlocher (2012): one axis after the other, in
// linear time, the lower envelope of parabolas.

#ifndef CGAL_MIXED_MESH_IMAGE_3_INTERNAL_DISTANCE_TRANSFORM_H
#define CGAL_MIXED_MESH_IMAGE_3_INTERNAL_DISTANCE_TRANSFORM_H

#include <CGAL/Mixed_mesh_image_3/internal/Lower_envelope.h>
#include <CGAL/Mixed_mesh_image_3/internal/Voxel_box.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The largest squared distance, between centers, of voxels up to a distance from each other: spacings have
/// the relative rounding of an affine map in single precision.
inline double squared_reach(double distance)
{
  // Squares of spacings differ by up to 2^-22 = 2.4e-7 by rounding. Squared distances between cubes
  // are whole numbers of them, and differ by 1e-6 at least up to a distance of 1,000 voxels.
  constexpr double rounding = 1e-6;
  return distance * distance * (1 + rounding);
}

/// The squared distance of each voxel of a box to the nearest voxel of a value, between centers; infinite if
/// no voxel has the value.
inline std::vector<float> squared_distances(const Labeled_box& box, std::uint8_t value,
                                            const std::array<double, 3>& spacing)
{
  constexpr float none = std::numeric_limits<float>::infinity();
  std::vector<float> distances;
  distances.reserve(box.has_label.size());
  for(std::uint8_t has_label : box.has_label)
    distances.push_back(has_label == value ? 0 : none);
  const std::array<std::size_t, 3> strides = box.strides();
  for(int axis = 0; axis < 3; ++axis) {
    Lower_envelope envelope(spacing[axis]);
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    for(std::size_t j = 0; j < box.size[b]; ++j)
      for(std::size_t k = 0; k < box.size[c]; ++k) {
        float* const line = distances.data() + j * strides[b] + k * strides[c];
        const std::size_t stride = strides[axis];
        envelope.clear();
        for(std::size_t i = 0; i < box.size[axis]; ++i)
          if(line[i * stride] < none)
            envelope.add(std::ptrdiff_t(i), line[i * stride]);
        if(!envelope.is_empty())
          envelope.for_each(0, std::ptrdiff_t(box.size[axis]),
                            [line, stride](std::ptrdiff_t i, std::ptrdiff_t, double d) {
                              line[std::size_t(i) * stride] = float(d);
                            });
      }
  }
  return distances;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_INTERNAL_DISTANCE_TRANSFORM_H
