// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Output of the result of warp_image() to files that other programs read.

#ifndef CGAL_MIXED_MESH_IMAGE_3_IO_WRITE_WARPED_IMAGE_H
#define CGAL_MIXED_MESH_IMAGE_3_IO_WRITE_WARPED_IMAGE_H

#include <CGAL/Mixed_mesh_3/IO/internal/extension_of.h>
#include <CGAL/Mixed_mesh_image_3/IO/Field_format.h>
#include <CGAL/Mixed_mesh_image_3/IO/NIFTI.h>
#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>
#include <CGAL/Mixed_mesh_image_3/warp_image.h>

#include <CGAL/config.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <locale>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

namespace internal {

/// The signs that convert right and front to left and back.
inline constexpr std::array<float, 3> signs_of_LPS = {-1, -1, 1};

/// The header of a field as NRRD: text, up to and with the empty line.
inline std::string NRRD_header(const Voxel_grid_3& grid, bool is_compressed)
{
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(17);
  const auto write_column = [&](int j) {
    for(int i = 0; i < 3; ++i)
      out << (i == 0 ? '(' : ',') << double(signs_of_LPS[i]) * grid.index_to_world[i][j];
    out << ')';
  };
#ifdef CGAL_BIG_ENDIAN
  const char* const byte_order = "big";
#else
  const char* const byte_order = "little";
#endif
  out << "NRRD0004\ntype: float\ndimension: 4\nspace: left-posterior-superior\nsizes: 3";
  for(std::size_t n : grid.size)
    out << ' ' << n;
  out << "\nspace directions: none";
  for(int j = 0; j < 3; ++j) {
    out << ' ';
    write_column(j);
  }
  out << "\nkinds: vector domain domain domain\nendian: " << byte_order
      << "\nencoding: " << (is_compressed ? "gzip" : "raw")
      << "\nspace units: \"mm\" \"mm\" \"mm\"\nspace origin: ";
  write_column(3);
  out << "\n\n";
  return out.str();
}

} // namespace internal

/*!
\ingroup PkgMixedMeshImage3Ref

Writes a field as NRRD to one of several files that shall appear together.

The file has floats in millimeters, the components of a voxel side by side, space and components
left-posterior-superior: the transform of 3D Slicer and ITK.

\param files files
\param path file name, once committed: `.nrrd`
\param field field
\param is_compressed whether to compress by gzip
\param error if not null, receives a line that names the file and the error
\return whether the field was written
*/
[[nodiscard]] inline bool write_NRRD(Output_files& files, const std::string& path,
                                     const Displacement_field_3& field, bool is_compressed = true,
                                     std::string* error = nullptr)
{
  std::string defect;
  if(!internal::ends_with(path, ".nrrd"))
    defect = "unknown extension, known is .nrrd";
  else if(field.vectors.size() != field.grid.number_of_voxels())
    defect = "the field does not have the size of its grid";
  if(!internal::is_success(internal::with_path(path, defect), error))
    return false;
  return files.write(
    path,
    [&](std::ostream& stream) {
      stream << internal::NRRD_header(field.grid, is_compressed);
      internal::Compressed_output output(stream, is_compressed);
      std::vector<std::array<float, 3>> block;
      for(std::size_t i = 0; i < field.vectors.size(); i += block.size()) {
        block.resize((std::min)(field.vectors.size() - i, std::size_t(1) << 14));
        for(std::size_t k = 0; k < block.size(); ++k)
          for(std::size_t c = 0; c < 3; ++c)
            block[k][c] = internal::signs_of_LPS[c] * field.vectors[i + k][c];
        output.write(block.data(), block.size() * sizeof(block[0]));
      }
      return output.finish();
    },
    error);
}

/// \ingroup PkgMixedMeshImage3Ref
/// Writes a field in one of the formats that other programs read; parameters as above, with `.nii` or
/// `.nii.gz` for NIfTI.
[[nodiscard]] inline bool write_displacement_field(Output_files& files, const std::string& path,
                                                   const Displacement_field_3& field, Field_format format,
                                                   std::string* error = nullptr)
{
  switch(format) {
  case Field_format::NIFTI: return write_NIFTI(files, path, field, error);
  case Field_format::ITK:
    return internal::write_NIFTI_field(files, path, field, NIFTI_INTENT_VECTOR, internal::signs_of_LPS,
                                       error);
  case Field_format::NRRD: return write_NRRD(files, path, field, true, error);
  }
  return false;
}

/*!
\ingroup PkgMixedMeshImage3Ref

Writes the result of `warp_image()` to files beside each other: for `brain.nii.gz`

| file | content |
|------|------------|
| `brain.nii.gz` | the warped image |
| `brain_mask.nii.gz` | 0 outside, 1 tissue, 2 resected: after the deformation |

and for each format of fields, with `.nii.gz` (`Field_format::NIFTI`), `_itk.nii.gz` (`ITK`) or `.nrrd`
(`NRRD`),

| file | what it is |
|------|------------|
| `brain_forward.nii.gz` | the field at points before the deformation: vectors to their new places |
| `brain_backward.nii.gz` | the field at points after the deformation: vectors to their former places |

Programs that resample an image by a field need the backward field; the forward field moves points.

\param files files
\param path name of the file of the image, once committed: `.nii` or `.nii.gz`
\param warped the result of `warp_image()`
\param field_formats formats of the fields, which are large: twelve bytes for each voxel before compression
\param error if not null, receives a line that names the file and the error
\return whether the files were written
*/
[[nodiscard]] inline bool write_warped_image(Output_files& files, const std::string& path,
                                             const Warped_image_3& warped,
                                             const std::vector<Field_format>& field_formats = {},
                                             std::string* error = nullptr)
{
  const std::string extension = internal::ends_with(path, ".gz") ? ".nii.gz" : ".nii";
  const std::string stem = path.substr(0, path.size() - (std::min)(path.size(), extension.size()));
  bool is_written = write_NIFTI(files, path, warped.image, error)
                    && write_NIFTI(files, stem + "_mask" + extension, warped.mask, error);
  for(Field_format format : field_formats) {
    const std::string end = end_of_field_name(format, extension);
    is_written = is_written
                 && write_displacement_field(files, stem + "_forward" + end, warped.forward, format, error)
                 && write_displacement_field(files, stem + "_backward" + end, warped.backward, format, error);
  }
  return is_written;
}

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_IO_WRITE_WARPED_IMAGE_H
