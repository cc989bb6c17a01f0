// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_IMAGE_3_IO_READ_ANATOMICAL_SURFACE_OPTIONS_H
#define CGAL_MIXED_MESH_IMAGE_3_IO_READ_ANATOMICAL_SURFACE_OPTIONS_H

#include <CGAL/Mixed_mesh_3/IO/Read_surface_options.h>

#include <optional>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

/// \ingroup PkgMixedMeshImage3Ref
/// The directions of the axes x, y and z in a patient: to the right, anterior and superior (RAS: images,
/// FreeSurfer, GIFTI), or to the left, posterior and superior (LPS: DICOM, ITK, and 3D Slicer's files).
enum class Anatomical_space {
  RAS, ///< x to the right, y to the front, z up
  LPS  ///< x to the left, y to the back, z up
};

/// \ingroup PkgMixedMeshImage3Ref
/// The options for reading a surface file of a patient.
struct Read_anatomical_surface_options : Read_surface_options
{
  /// The space of the coordinates in the file. By default, the space that its header names, or RAS. Formats
  /// that define the space (FreeSurfer, GIFTI) ignore this option.
  std::optional<Anatomical_space> space;
};

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_IO_READ_ANATOMICAL_SURFACE_OPTIONS_H
