// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_READ_SURFACE_OPTIONS_H
#define CGAL_MIXED_MESH_3_IO_READ_SURFACE_OPTIONS_H

#include <CGAL/license/Mixed_mesh_3.h>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

/// \ingroup PkgMixedMesh3IO
/// The options for reading a surface file.
struct Read_surface_options
{
  /// Whether to refuse a surface that is not the surface of a solid as it is: that has holes, cuts itself, or
  /// is not manifold. By default, the surface is repaired.
  bool is_strict = false;

  /// The diameter with which the surface is wrapped if not 0, with defects or without, and not repaired:
  /// openings narrower than the diameter are closed, and details smaller than a thirtieth of it are lost.
  double wrap_diameter = 0;

  /// The largest distance of points that are welded where the surface is not closed: narrower cracks are
  /// closed. By default, 10^-6 of the diagonal of the bounding box, which equal points differ by if a
  /// program has rounded each for itself; nothing if `is_strict` is set.
  double weld_distance = 0;

  /// Whether to keep only the body of the largest volume, with its cavities.
  bool keep_largest = false;

  /// Components of less volume, bodies and cavities, are dropped; in the cube of the unit of the points.
  double least_volume = 0;
};

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_READ_SURFACE_OPTIONS_H
