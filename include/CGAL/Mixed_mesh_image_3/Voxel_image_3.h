// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Images of voxels, and the positions of their voxels in space. File formats are in IO.

#ifndef CGAL_MIXED_MESH_IMAGE_3_VOXEL_IMAGE_3_H
#define CGAL_MIXED_MESH_IMAGE_3_VOXEL_IMAGE_3_H

#include <CGAL/assertions.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMeshImage3Ref
/// Rows of an affine map `x -> A x + b` of space: the last column is `b`.
using Affine_map_3 = std::array<std::array<double, 4>, 3>;

/// \ingroup PkgMixedMeshImage3Ref
/// The image of a point.
inline std::array<double, 3> transform(const Affine_map_3& map, const std::array<double, 3>& p)
{
  std::array<double, 3> q;
  for(int i = 0; i < 3; ++i)
    q[i] = map[i][0] * p[0] + map[i][1] * p[1] + map[i][2] * p[2] + map[i][3];
  return q;
}

/// \ingroup PkgMixedMeshImage3Ref
/// The determinant of the linear part: the volume of a voxel; negative if the map mirrors.
inline double determinant(const Affine_map_3& m)
{
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
         + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// \ingroup PkgMixedMeshImage3Ref
/// The inverse map. \pre `determinant(m) != 0`
inline Affine_map_3 inverse(const Affine_map_3& m)
{
  const double d = determinant(m);
  CGAL_precondition(d != 0);
  Affine_map_3 inverse{};
  for(int i = 0; i < 3; ++i) {
    for(int j = 0; j < 3; ++j) {
      const auto &a = m[(j + 1) % 3], &b = m[(j + 2) % 3];
      inverse[i][j] = (a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]) / d;
    }
    for(int j = 0; j < 3; ++j)
      inverse[i][3] -= inverse[i][j] * m[j][3];
  }
  return inverse;
}

/// \ingroup PkgMixedMeshImage3Ref
/// The voxels of an image: their numbers, and their positions.
struct Voxel_grid_3
{
  /// Voxels along each axis of the image.
  std::array<std::size_t, 3> size{};
  /// The map from indices to millimeters in the image's world: x to the right, y to the front, z upwards. The
  /// index of a voxel is its center.
  Affine_map_3 index_to_world{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
  /// The kind of the world, in NIfTI's numbers: 0 unknown, 1 the scanner's, 2 that of another image, 3
  /// Talairach's, 4 MNI's.
  int world = 1;

  /// The number of voxels.
  std::size_t number_of_voxels() const { return size[0] * size[1] * size[2]; }

  /// The position of voxel `(i,j,k)` in the array of voxels: `i` runs fastest.
  std::size_t offset(std::size_t i, std::size_t j, std::size_t k) const
  {
    return i + size[0] * (j + size[1] * k);
  }
};

/// \ingroup PkgMixedMeshImage3Ref
/// The distance between the centers of neighboring voxels, in millimeters, along each index.
inline std::array<double, 3> voxel_spacing(const Voxel_grid_3& grid)
{
  std::array<double, 3> spacing;
  for(int i = 0; i < 3; ++i) {
    const auto& m = grid.index_to_world;
    spacing[i] = std::hypot(m[0][i], m[1][i], m[2][i]);
  }
  return spacing;
}

/// \ingroup PkgMixedMeshImage3Ref
/// Types of numbers in image files; the values are NIfTI's.
enum class Voxel_type : std::int16_t {
  UINT8 = 2,    ///< unsigned integer of 8 bits
  INT16 = 4,    ///< integer of 16 bits
  INT32 = 8,    ///< integer of 32 bits
  FLOAT32 = 16, ///< floating-point number of 32 bits
  FLOAT64 = 64, ///< floating-point number of 64 bits
  INT8 = 256,   ///< integer of 8 bits
  UINT16 = 512, ///< unsigned integer of 16 bits
  UINT32 = 768, ///< unsigned integer of 32 bits
  INT64 = 1024, ///< integer of 64 bits
  UINT64 = 1280 ///< unsigned integer of 64 bits
};

/// \ingroup PkgMixedMeshImage3Ref
/// An image with a number in each voxel, and its representation in a file: as `type`, where the value of a
/// voxel is `slope` times the stored number plus `intercept`.
struct Voxel_image_3
{
  /// The voxels and their positions.
  Voxel_grid_3 grid;
  std::vector<float> values; ///< at `grid.offset(i, j, k)`
  /// The type of values in the file.
  Voxel_type type = Voxel_type::FLOAT32;
  double slope = 1;     ///< not 0
  double intercept = 0; ///< in the unit of the values
};

/// \ingroup PkgMixedMeshImage3Ref
/// A vector in each voxel, in millimeters: the point at the center `x` of the voxel has its counterpart at
/// `x` plus the vector.
struct Displacement_field_3
{
  /// The voxels and their positions.
  Voxel_grid_3 grid;
  std::vector<std::array<float, 3>> vectors; ///< at `grid.offset(i, j, k)`
  std::vector<std::uint8_t> is_in_mesh;      ///< whether the voxel's center is in the mesh
};

/*!
\ingroup PkgMixedMesh3Fields

The value of an image at a point, linear in each index between the centers of voxels; outside the image the
value at the nearest point of the image.

\param image image
\param p point, in indices
*/
inline float interpolate(const Voxel_image_3& image, const std::array<double, 3>& p)
{
  std::size_t lower[3], upper[3];
  float t[3];
  for(int i = 0; i < 3; ++i) {
    const double last = double(image.grid.size[i] - 1);
    const double x = p[i] > 0 ? (p[i] < last ? p[i] : last) : 0;
    lower[i] = std::size_t(x);
    upper[i] = lower[i] + (x < last);
    t[i] = float(x - double(lower[i]));
  }
  const float* const v = image.values.data();
  const auto row = [&](std::size_t j, std::size_t k) {
    const std::size_t start = image.grid.offset(0, j, k);
    const float a = v[start + lower[0]], b = v[start + upper[0]];
    return a + t[0] * (b - a);
  };
  const auto plane = [&](std::size_t k) {
    const float a = row(lower[1], k), b = row(upper[1], k);
    return a + t[1] * (b - a);
  };
  const float a = plane(lower[2]), b = plane(upper[2]);
  return a + t[2] * (b - a);
}

/// \ingroup PkgMixedMeshImage3Ref
/// The value of the voxel nearest to a point, in indices; of equally near voxels, that of larger index.
/// Outside the image the value of the nearest voxel.
inline float nearest_value(const Voxel_image_3& image, const std::array<double, 3>& p)
{
  std::size_t voxel[3];
  for(int i = 0; i < 3; ++i) {
    const double last = double(image.grid.size[i] - 1), x = std::floor(p[i] + 0.5);
    voxel[i] = std::size_t(x > 0 ? (x < last ? x : last) : 0);
  }
  return image.values[image.grid.offset(voxel[0], voxel[1], voxel[2])];
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_VOXEL_IMAGE_3_H
