// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The format of an image, by the name of its file. No library of images is needed.

#ifndef CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_IMAGE_FORMAT_OF_H
#define CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_IMAGE_FORMAT_OF_H

#include <CGAL/Mixed_mesh_3/IO/internal/extension_of.h>

#include <optional>
#include <string>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

enum class Image_format { NIFTI, MGH };

// Endings of images in messages.
constexpr const char* image_endings = ".nii, .nii.gz, .mgh or .mgz";

// The format of an image; none if the name has another ending. Capital letters do not count.
inline std::optional<Image_format> image_format_of(const std::string& path)
{
  std::string extension = extension_of(path);
  const bool is_compressed = extension == ".gz";
  if(is_compressed)
    extension = extension_of(path.substr(0, path.size() - extension.size()));
  if(extension == ".nii")
    return Image_format::NIFTI;
  if(extension == ".mgh" || (extension == ".mgz" && !is_compressed))
    return Image_format::MGH;
  return std::nullopt;
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_IMAGE_FORMAT_OF_H
