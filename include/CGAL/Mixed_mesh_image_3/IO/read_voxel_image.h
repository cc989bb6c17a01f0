// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Images of each format that can be read.

#ifndef CGAL_MIXED_MESH_IMAGE_3_IO_READ_VOXEL_IMAGE_H
#define CGAL_MIXED_MESH_IMAGE_3_IO_READ_VOXEL_IMAGE_H

#include <CGAL/Mixed_mesh_3/IO/internal/errors.h>
#include <CGAL/Mixed_mesh_image_3/IO/MGH.h>
#include <CGAL/Mixed_mesh_image_3/IO/NIFTI.h>
#include <CGAL/Mixed_mesh_image_3/IO/internal/image_format_of.h>
#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>

#include <optional>
#include <string>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

/*!
\ingroup PkgMixedMeshImage3Ref

Reads an image by the ending of its name, in small or capital letters: by `read_NIFTI()` (`.nii`, `.nii.gz`)
or `read_MGH()` (`.mgh`, `.mgz`). The function must not be called by several threads at once.

\param path file name
\param image the result; unchanged if the file is refused
\param error if not null, receives then a line that names the file and the defect
\return whether the image was read
*/
[[nodiscard]] inline bool read_voxel_image(const std::string& path, Voxel_image_3& image,
                                           std::string* error = nullptr)
{
  const std::optional<internal::Image_format> format = internal::image_format_of(path);
  if(!format)
    return internal::is_success(internal::with_path(path, std::string("unknown format; expected ")
                                                            + internal::image_endings),
                                error);
  return *format == internal::Image_format::MGH ? read_MGH(path, image, error)
                                                : read_NIFTI(path, image, error);
}

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_IO_READ_VOXEL_IMAGE_H
