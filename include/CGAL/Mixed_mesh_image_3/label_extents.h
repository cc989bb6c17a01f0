// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// All labels of an image, found in one pass: the number of voxels of each label, and their box.

#ifndef CGAL_MIXED_MESH_IMAGE_3_LABEL_EXTENTS_H
#define CGAL_MIXED_MESH_IMAGE_3_LABEL_EXTENTS_H

#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMeshImage3Ref
/// The box of voxels around some voxels: `first[i] <= index < last[i]` along each axis. By default, the box
/// is empty.
struct Label_extent_3
{
  std::size_t number_of_voxels = 0; ///< voxels that have the label
  /// The smallest indices.
  std::array<std::size_t, 3> first{std::numeric_limits<std::size_t>::max(),
                                   std::numeric_limits<std::size_t>::max(),
                                   std::numeric_limits<std::size_t>::max()};
  std::array<std::size_t, 3> last{}; ///< the largest indices plus one

  /// Extends the box by another one, of other voxels.
  void add(const Label_extent_3& other)
  {
    number_of_voxels += other.number_of_voxels;
    for(int i = 0; i < 3; ++i) {
      first[i] = (std::min)(first[i], other.first[i]);
      last[i] = (std::max)(last[i], other.last[i]);
    }
  }
};

/// \ingroup PkgMixedMeshImage3Ref
/// All voxels of a grid.
inline Label_extent_3 whole_extent(const Voxel_grid_3& grid)
{
  return {grid.number_of_voxels(), {0, 0, 0}, grid.size};
}

/// \ingroup PkgMixedMeshImage3Ref
/// \brief The extents of all values of an image, except values that are no number: one pass for all labels.
/// \par Complexity
/// Linear in the number of voxels, if there are few values, or neighbors are often equal
inline std::map<float, Label_extent_3> label_extents(const Voxel_image_3& image)
{
  using Extents = std::map<float, Label_extent_3>;
  Extents extents;
  // The last value of each hash, whose extent is not searched for again: images have some hundreds of values.
  std::vector<Extents::value_type*> recent(1 << 12, nullptr);
  const auto extent_of = [&](float value) -> Label_extent_3& {
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof(bits));
    constexpr std::uint32_t golden_ratio = 2654435769u; // share of 2^32: Knuth's multiplicative hash
    Extents::value_type*& entry = recent[bits * golden_ratio >> 20];
    if(entry == nullptr || entry->first != value)
      entry = &*extents.try_emplace(value).first;
    return entry->second;
  };
  const std::array<std::size_t, 3>& size = image.grid.size;
  for(std::size_t k = 0; k < size[2]; ++k)
    for(std::size_t j = 0; j < size[1]; ++j) {
      const float* const row = image.values.data() + image.grid.offset(0, j, k);
      for(std::size_t i = 0, end; i < size[0]; i = end) {
        for(end = i + 1; end < size[0] && row[end] == row[i];)
          ++end;
        if(row[i] == row[i])
          extent_of(row[i]).add({end - i, {i, j, k}, {end, j + 1, k + 1}});
      }
    }
  return extents;
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_LABEL_EXTENTS_H
