// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_IMAGE_3_INTERNAL_SMOOTH_INDICATOR_H
#define CGAL_MIXED_MESH_IMAGE_3_INTERNAL_SMOOTH_INDICATOR_H

#include <CGAL/Mixed_mesh_3/internal/base/parallel_for.h>
#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>
#include <CGAL/Mixed_mesh_image_3/label_extents.h>
#include <CGAL/Mixed_mesh_image_3/internal/Voxel_box.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Values on a box of voxels: 0 at its border.
struct Indicator : Voxel_box
{
  std::vector<float> values; // none if no voxel has the label
  float level = 0.5f;        // number of values above: that of voxels with the label, except for equal ones
  std::size_t step = 1;      // step of the box, in voxels of the image
};

/// The number of edges of the grid that cross the level.
inline std::size_t number_of_crossings(const Indicator& indicator)
{
  const std::array<std::size_t, 3> strides = indicator.strides();
  std::size_t sum = 0;
  for(std::size_t i = 0; i < indicator.values.size(); ++i)
    for(int axis = 0; axis < 3; ++axis) // beyond a border, there are zeros as on the border
      sum += i + strides[axis] < indicator.values.size()
             && (indicator.values[i] > indicator.level)
                  != (indicator.values[i + strides[axis]] > indicator.level);
  return sum;
}

/// Every second value along each axis.
inline Indicator every_second(const Indicator& fine)
{
  Indicator coarse{{fine.first, {}}, {}, fine.level, 2 * fine.step};
  std::size_t number = 1;
  for(int i = 0; i < 3; ++i) {
    coarse.size[i] = (fine.size[i] + 1) / 2 + 1; // the last value is beyond
    number *= coarse.size[i];
  }
  coarse.values.assign(number, 0.f);
  for(std::size_t k = 0; 2 * k < fine.size[2]; ++k)
    for(std::size_t j = 0; 2 * j < fine.size[1]; ++j)
      for(std::size_t i = 0; 2 * i < fine.size[0]; ++i)
        coarse.values[coarse.offset({i, j, k})] = fine.values[fine.offset({2 * i, 2 * j, 2 * k})];
  return coarse;
}

/// Half of the kernel of a Gaussian, from the middle on; its sum over both sides is 1.
inline std::vector<float> gaussian_kernel(double deviation)
{
  constexpr double width = 3; // values beyond that many deviations are negligible: 0.3 %
  std::vector<double> kernel{1};
  for(int i = 1; i <= int(std::ceil(width * deviation)); ++i)
    kernel.push_back(std::exp(-0.5 * (i / deviation) * (i / deviation)));
  double sum = -kernel[0];
  for(double k : kernel)
    sum += 2 * k;
  std::vector<float> result;
  for(double k : kernel)
    result.push_back(float(k / sum));
  return result;
}

/// Convolution along an axis, with 0 outside. The order of the sums depends neither on the threads nor on the
/// blocks.
inline void convolve(Indicator& indicator, int axis, const std::vector<float>& kernel, unsigned threads)
{
  const std::size_t last = kernel.size() - 1;
  if(last == 0)
    return; // the kernel is 1
  // A block is a bundle of lines beside each other: a loop over all its values is a loop over contiguous
  // memory.
  const std::array<std::size_t, 3> strides = indicator.strides();
  const std::size_t n = indicator.size[axis], stride = strides[axis],
                    width = axis == 0 ? 1 : indicator.size[0], padding = last * width;
  const auto convolve_block = [&](float* const values, std::vector<float>& padded, std::vector<float>& sums) {
    for(std::size_t i = 0; i < n; ++i)
      std::copy_n(values + i * stride, width, padded.data() + padding + i * width);
    const float* const middle = padded.data() + padding;
    for(std::size_t i = 0; i < n * width; ++i)
      sums[i] = kernel[0] * middle[i];
    for(std::size_t k = 1; k <= last; ++k) {
      const float *const before = middle - k * width, *const behind = middle + k * width;
      for(std::size_t i = 0; i < n * width; ++i)
        sums[i] += kernel[k] * (before[i] + behind[i]);
    }
    for(std::size_t i = 0; i < n; ++i)
      std::copy_n(sums.data() + i * width, width, values + i * stride);
  };
  // A task is a slice of rows; or, for lines along another axis, the lines that start in one row.
  const int other = axis == 2 ? 1 : 2;
  const std::size_t rows = axis == 0 ? indicator.size[1] : 1;
  parallel_for(
    indicator.size[other], threads,
    [&](std::size_t task) {
      std::vector<float> padded(n * width + 2 * padding, 0.f), sums(n * width);
      for(std::size_t row = 0; row < rows; ++row)
        convolve_block(indicator.values.data() + task * strides[other] + row * strides[1], padded, sums);
    },
    1);
}

/// A level with the given number of values above it, or fewer if there are equal values. \pre there are more
/// values
inline float level_above(const std::vector<float>& values, std::size_t number)
{
  // Most values are 0, or nearly: candidates are found among the other values, if there are enough.
  constexpr float low = 0.2f;
  std::vector<float> candidates;
  std::copy_if(values.begin(), values.end(), std::back_inserter(candidates),
               [](float value) { return value > low; });
  if(candidates.size() <= number)
    candidates = values;
  const auto next = candidates.begin() + std::ptrdiff_t(number);
  std::nth_element(candidates.begin(), next, candidates.end(), std::greater<float>());
  return (*next + *std::min_element(candidates.begin(), next)) / 2;
}

/// The indicator of a label in the box around it, smoothed.
/// \param deviations deviations of the Gaussian, in voxels along each axis
/// \param extent box around all voxels that have the label
template <class HasLabel>
Indicator smooth_indicator(const Voxel_image_3& image, const HasLabel& has_label,
                           const std::array<double, 3>& deviations, const Label_extent_3& extent,
                           unsigned threads = 1)
{
  std::array<std::vector<float>, 3> kernels;
  std::array<std::size_t, 3> margin;
  for(int i = 0; i < 3; ++i) {
    kernels[i] = gaussian_kernel(deviations[i]);
    margin[i] = kernels[i].size(); // one more than the reach of the kernel
  }
  const Labeled_box box = box_of_label(image, has_label, margin, extent);
  Indicator indicator{box, {box.has_label.begin(), box.has_label.end()}};
  if(indicator.values.empty())
    return indicator;
  const auto number_with_label = std::size_t(std::count(box.has_label.begin(), box.has_label.end(), 1));
  for(int axis = 0; axis < 3; ++axis)
    convolve(indicator, axis, kernels[axis], threads);
  indicator.level = level_above(indicator.values, number_with_label);
  return indicator;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_INTERNAL_SMOOTH_INDICATOR_H
