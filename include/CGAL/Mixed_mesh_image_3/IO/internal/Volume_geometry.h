// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Position of a volume of FreeSurfer in the scanner. Coordinates of its surfaces ("surface RAS",
// "tkregister") have their origin in the middle of the volume, and axes along its edges.

#ifndef CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_VOLUME_GEOMETRY_H
#define CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_VOLUME_GEOMETRY_H

#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <cmath>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

struct Volume_geometry
{
  // Axes of columns, rows and slices, in the scanner, and the center; those of FreeSurfer's own volumes
  // unless a file says otherwise.
  Mixed_meshes_3::Vec3 x_ras{-1, 0, 0}, y_ras{0, 0, -1}, z_ras{0, 1, 0}, c_ras{0, 0, 0};

  /// Whether the axes are orthogonal, of unit length, and all values are finite.
  bool is_rigid() const
  {
    const Mixed_meshes_3::Vec3* const axes[] = {&x_ras, &y_ras, &z_ras};
    bool is = std::isfinite(c_ras[0] + c_ras[1] + c_ras[2]);
    for(int i = 0; i < 3; ++i)
      for(int j = 0; j <= i; ++j) {
        // Axes with four decimals have products that are off by up to 2 * sqrt(3) * 0.00005 = 0.00017.
        // FreeSurfer writes 6 decimals in GIFTI, and 16 digits in its own files.
        constexpr double tolerance = 1e-3;
        is = is && std::abs(dot(*axes[i], *axes[j]) - double(i == j)) < tolerance;
      }
    return is;
  }

  /// Conversion from surface RAS, whose axes are those of columns, reversed, of slices, and of rows,
  /// reversed.
  Mixed_meshes_3::Vec3 to_scanner(const Mixed_meshes_3::Vec3& p) const
  {
    return c_ras - p[0] * x_ras + p[1] * z_ras - p[2] * y_ras;
  }
};

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_VOLUME_GEOMETRY_H
