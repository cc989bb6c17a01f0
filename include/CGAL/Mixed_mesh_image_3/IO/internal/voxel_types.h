// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Types of the numbers in NIfTI files.

#ifndef CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_VOXEL_TYPES_H
#define CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_VOXEL_TYPES_H

#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>

#include <nifti2_io.h>

#include <cstdint>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

/// Calls `f(T())` with the C++ type of the numbers; false if the type is none of `Voxel_type`.
template <class F>
bool with_voxel_type(int type, const F& f)
{
  switch(Voxel_type(type)) {
  case Voxel_type::UINT8: f(std::uint8_t()); return true;
  case Voxel_type::INT8: f(std::int8_t()); return true;
  case Voxel_type::UINT16: f(std::uint16_t()); return true;
  case Voxel_type::INT16: f(std::int16_t()); return true;
  case Voxel_type::UINT32: f(std::uint32_t()); return true;
  case Voxel_type::INT32: f(std::int32_t()); return true;
  case Voxel_type::UINT64: f(std::uint64_t()); return true;
  case Voxel_type::INT64: f(std::int64_t()); return true;
  case Voxel_type::FLOAT32: f(float()); return true;
  case Voxel_type::FLOAT64: f(double()); return true;
  }
  return false;
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_VOXEL_TYPES_H
