// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_READ_SURFACE_OPTIONS_H
#define CGAL_MIXED_MESH_3_IO_READ_SURFACE_OPTIONS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <optional>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

/// \ingroup PkgMixedMesh3IO
/// The directions of the axes x, y and z in a patient: to the right, anterior and superior (RAS: images,
/// FreeSurfer, GIFTI), or to the left, posterior and superior (LPS: DICOM, ITK, and 3D Slicer's files).
enum class Anatomical_space {
  RAS, ///< x to the right, y to the front, z up
  LPS  ///< x to the left, y to the back, z up
};

/// \ingroup PkgMixedMesh3IO
/// The options for reading a surface file.
struct Read_surface_options
{
  /// The space of the coordinates in the file. By default, the space that its header names, or RAS. Formats
  /// that define the space (FreeSurfer, GIFTI) ignore this option.
  std::optional<Anatomical_space> space;

  /// Whether to refuse a surface that is not the surface of a solid as it is: that has holes, cuts itself, or
  /// is not manifold. By default, the surface is repaired.
  bool is_strict = false;

  /// The diameter with which the surface is wrapped if not 0, with defects or without, and not repaired:
  /// openings narrower than the diameter are closed, and details smaller than a thirtieth of it are lost.
  double wrap_diameter = 0;
};

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_READ_SURFACE_OPTIONS_H
