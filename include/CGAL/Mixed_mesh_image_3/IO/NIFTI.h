// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// NIfTI images. Headers are interpreted by nifti_clib (Debian: libnifti2-dev, zlib1g-dev; link nifti2, znz
// and z). Files are read and written here, because nifti_clib turns values that are no number into 0 without
// a message, prints, and does not tell when the disk is full.

#ifndef CGAL_MIXED_MESH_IMAGE_3_IO_NIFTI_H
#define CGAL_MIXED_MESH_IMAGE_3_IO_NIFTI_H

#include <CGAL/Mixed_mesh_3/IO/internal/errors.h>
#include <CGAL/Mixed_mesh_3/IO/internal/extension_of.h>
#include <CGAL/Mixed_mesh_3/IO/write_mixed_mesh.h>
#include <CGAL/Mixed_mesh_image_3/IO/internal/read_NIFTI.h>
#include <CGAL/Mixed_mesh_image_3/IO/internal/write_NIFTI.h>
#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>
#include <CGAL/Mixed_mesh_image_3/warp_image.h>

#include <nifti2_io.h>

#include <ostream>
#include <string>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

/*!
\ingroup PkgMixedMeshImage3Ref

Reads a NIfTI image (`.nii`, `.nii.gz`; NIfTI-1 and NIfTI-2, either byte order).

Positions are those of the sform, else of the qform, else the sizes of voxels times the indices; in
millimeters, whatever the unit of the file. The file's slope and intercept are applied. Values are floats:
integers beyond 2^24 lose digits. The function must not be called by several threads at once.

\param path file name
\param image the result; unchanged if the file cannot be read, is truncated or damaged, does not have three
dimensions, has a number in its header that is not finite or not possible (the line names the field), or has
voxels that are not finite real numbers
\param error if not null, receives then a line that names the file and the defect
\return whether the image was read
*/
[[nodiscard]] inline bool read_NIFTI(const std::string& path, Voxel_image_3& image,
                                     std::string* error = nullptr)
{
  return internal::is_read(path, error, [&] { image = internal::read_image(path); });
}

/*!
\ingroup PkgMixedMeshImage3Ref

Writes an image to one of several files that shall appear together.

The format is NIfTI-1, with the image's type: integers are rounded, and cut off at the ends of their range.
Positions are written as sform, and as qform if the axes are at right angles.

\param files files
\param path file name, once committed: `.nii` or `.nii.gz`
\param image image
\param error if not null, receives a line that names the file and the error
\return whether the image was written
*/
[[nodiscard]] inline bool write_NIFTI(Output_files& files, const std::string& path,
                                      const Voxel_image_3& image, std::string* error = nullptr)
{
  const std::string defect = internal::image_output_error(path, image.grid, image.values.size());
  if(!internal::is_success(internal::with_path(path, defect), error))
    return false;
  return files.write(
    path,
    [&](std::ostream& stream) {
      nifti_1_header header = internal::make_header(image.grid);
      const double slope = image.slope != 0 ? image.slope : 1;
      header.datatype = short(image.type);
      header.scl_slope = float(slope);
      header.scl_inter = float(image.intercept);
      internal::Compressed_output output(stream, internal::ends_with(path, ".gz"));
      const char no_extension[4] = {};
      const bool is_known = internal::with_voxel_type(header.datatype, [&](auto zero) {
        header.bitpix = short(8 * sizeof(zero));
        output.write(&header, sizeof(header));
        output.write(no_extension, sizeof(no_extension));
        internal::write_as<decltype(zero)>(output, image, slope);
      });
      return output.finish() && is_known;
    },
    error);
}

/// \ingroup PkgMixedMeshImage3Ref
/// Writes a field: a vector image (five dimensions, `NIFTI_INTENT_DISPVECT`) of floats in millimeters,
/// components in the directions of the image's world: right, front, up.
[[nodiscard]] inline bool write_NIFTI(Output_files& files, const std::string& path,
                                      const Displacement_field_3& field, std::string* error = nullptr)
{
  return internal::write_NIFTI_field(files, path, field, NIFTI_INTENT_DISPVECT, {1, 1, 1}, error);
}

/// \ingroup PkgMixedMeshImage3Ref
/// Writes an image or a field to a file, which appears when it is complete.
template <class Image>
[[nodiscard]] bool write_NIFTI(const std::string& path, const Image& image, std::string* error = nullptr)
{
  Output_files files;
  return write_NIFTI(files, path, image, error) && files.commit(error);
}

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_IO_NIFTI_H
