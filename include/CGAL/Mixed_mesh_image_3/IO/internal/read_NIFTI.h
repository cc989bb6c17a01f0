// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Input of NIfTI images: the header by nifti_clib, and the numbers.

#ifndef CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_READ_NIFTI_H
#define CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_READ_NIFTI_H

#include <CGAL/Mixed_mesh_3/IO/internal/errors.h>
#include <CGAL/Mixed_mesh_image_3/IO/internal/Input_file.h>
#include <CGAL/Mixed_mesh_image_3/IO/internal/image_format_of.h>
#include <CGAL/Mixed_mesh_image_3/IO/internal/image_parts.h>
#include <CGAL/Mixed_mesh_image_3/IO/internal/voxel_types.h>
#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>

#include <nifti2_io.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

struct Free_nifti_image
{
  void operator()(nifti_image* header) const { nifti_image_free(header); }
};
using Nifti_header = std::unique_ptr<nifti_image, Free_nifti_image>;

// The defect of a header, after bytes have been swapped if necessary; or empty. For a header without a
// defect, nifti_clib neither prints nor overflows.
template <class Header>
std::string header_defect(const Header& header)
{
  if(header.dim[0] < 1 || header.dim[0] > 7)
    return "cannot be read: it says that it has " + std::to_string(header.dim[0]) + " dimensions";
  double values = 1;
  for(int i = 1; i <= header.dim[0]; ++i) {
    if(header.dim[i] < 1 || header.dim[i] > 1000000000)
      return "cannot be read: its dimension " + std::to_string(i) + " is " + std::to_string(header.dim[i]);
    values *= i > 3 ? double(header.dim[i]) : 1;
  }
  if(values != 1) {
    std::string sizes = std::to_string(header.dim[1]);
    for(int i = 2; i <= header.dim[0]; ++i)
      sizes += " x " + std::to_string(header.dim[i]);
    return "is a " + std::to_string(header.dim[0]) + "-D image of " + sizes
           + " values; expected three dimensions";
  }
  if(!with_voxel_type(header.datatype, [](auto) {}))
    return std::string("has voxels of type ") + nifti_datatype_to_string(header.datatype)
           + "; expected one real number in a voxel";
  return std::string();
}

// The defect of the numbers for the positions of voxels, in the file and in the world, and for their meaning:
// nifti_clib replaces numbers that are not finite or not possible by others. The file has at most
// `largest_size` bytes.
template <class Header>
std::string header_number_defect(const Header& header, double largest_size)
{
  const double offset = double(header.vox_offset), first = double(sizeof(Header) + 4);
  if(!(offset >= first && offset <= largest_size && offset == std::floor(offset)))
    return field_defect("vox_offset", header.vox_offset,
                        "an integer from " + std::to_string(sizeof(Header) + 4) + " to the size of the file");
  std::string defect = finite_field_defect("scl_slope", &header.scl_slope, 0, 1);
  const auto check = [&](const char* field, const auto* values, int begin, int end) {
    if(defect.empty())
      defect = finite_field_defect(field, values, begin, end);
  };
  if(header.scl_slope != 0)
    check("scl_inter", &header.scl_inter, 0, 1);
  check("pixdim", header.pixdim, 0, 4);
  if(header.qform_code > 0) {
    check("quatern_b", &header.quatern_b, 0, 1);
    check("quatern_c", &header.quatern_c, 0, 1);
    check("quatern_d", &header.quatern_d, 0, 1);
    check("qoffset_x", &header.qoffset_x, 0, 1);
    check("qoffset_y", &header.qoffset_y, 0, 1);
    check("qoffset_z", &header.qoffset_z, 0, 1);
  }
  if(header.sform_code > 0) {
    check("srow_x", header.srow_x, 0, 4);
    check("srow_y", header.srow_y, 0, 4);
    check("srow_z", header.srow_z, 0, 4);
  }
  if(!defect.empty() || header.sform_code > 0)
    return defect;
  // The sizes of voxels count; and a rotation, whose quaternion is rounded to floats, within a tolerance.
  for(int i = 1; i <= (std::min)(int(header.dim[0]), 3); ++i)
    if(!(header.pixdim[i] > 0))
      return field_defect("pixdim[" + std::to_string(i) + ']', header.pixdim[i], "a size greater than 0");
  const double length = std::hypot(double(header.quatern_b), double(header.quatern_c),
                                   double(header.quatern_d));
  return header.qform_code > 0 && length > 1.001
           ? field_defect("quaternion (quatern_b, quatern_c, quatern_d)", length, "at most 1, its length")
           : std::string();
}

template <class Header, class Convert>
Nifti_header read_header(const std::string& path, Input_file& file, std::int32_t first, int version,
                         const char* magic, const Convert& convert)
{
  const char* const unknown = "cannot be read: not a NIfTI image";
  Header header;
  std::memcpy(&header, &first, sizeof(first));
  if(!file.read(reinterpret_cast<char*>(&header) + sizeof(first), sizeof(header) - sizeof(first)))
    refuse(path, unknown);
  if(std::memcmp(header.magic, magic, 4) != 0)
    refuse(path, std::memcmp(header.magic, "ni", 2) == 0 ? "cannot be read: its voxels are in another file"
                                                         : unknown);
  Header native = header;
  if(native.sizeof_hdr != int(sizeof(Header)))
    swap_nifti_header(&native, version);
  std::string defect = header_defect(native);
  if(defect.empty())
    defect = header_number_defect(native, file.largest_size());
  if(!defect.empty())
    refuse(path, defect);
  nifti_set_debug_level(0); // or it prints
  Nifti_header result(convert(header));
  if(!result)
    refuse(path, unknown);
  return result;
}

inline Nifti_header read_header(const std::string& path, Input_file& file)
{
  std::int32_t size = 0, swapped_size = 0;
  if(file.read(&size, sizeof(size))) {
    swapped_size = size;
    nifti_swap_4bytes(1, &swapped_size);
  }
  if(size == 540 || swapped_size == 540)
    return read_header<nifti_2_header>(path, file, size, 2, "n+2", [](const nifti_2_header& header) {
      return nifti_convert_n2hdr2nim(header, nullptr);
    });
  if(size != 348 && swapped_size != 348)
    refuse(path, "cannot be read: not a NIfTI image");
  return read_header<nifti_1_header>(path, file, size, 1, "n+1", [](const nifti_1_header& header) {
    return nifti_convert_n1hdr2nim(header, nullptr);
  });
}

// The grid of an image: sform, else qform, else the sizes of voxels. Lengths become millimeters.
inline Voxel_grid_3 read_grid(const std::string& path, const nifti_image& header)
{
  Voxel_grid_3 grid;
  grid.size = {std::size_t(header.nx), std::size_t(header.ny), std::size_t(header.nz)};
  const bool has_sform = header.sform_code > 0;
  grid.world = has_sform ? header.sform_code : header.qform_code > 0 ? header.qform_code : 0;
  const double unit = header.xyz_units == NIFTI_UNITS_METER    ? 1000
                      : header.xyz_units == NIFTI_UNITS_MICRON ? 0.001
                                                               : 1;
  const nifti_dmat44& map = has_sform ? header.sto_xyz : header.qto_xyz;
  for(int i = 0; i < 3; ++i)
    for(int j = 0; j < 4; ++j)
      grid.index_to_world[i][j] = unit * map.m[i][j];
  check_positions(path, grid, has_sform ? "sform" : "qform");
  return grid;
}

inline Voxel_image_3 read_image(const std::string& path)
{
  if(image_format_of(path) != Image_format::NIFTI)
    refuse(path, "unknown format; expected .nii or .nii.gz");
  Input_file input(path);
  const Nifti_header owner = read_header(path, input);
  const nifti_image& header = *owner;
  Voxel_image_3 image;
  image.grid = read_grid(path, header);
  image.type = Voxel_type(header.datatype);
  if(header.scl_slope != 0) {
    image.slope = header.scl_slope;
    image.intercept = header.scl_inter;
  }

  with_voxel_type(header.datatype, [&](auto zero) {
    using T = decltype(zero);
    std::vector<char> bytes = read_voxel_bytes(path, input, image.grid, sizeof(T), header.iname_offset);
    if(header.byteorder != nifti_short_order() && sizeof(T) > 1)
      nifti_swap_Nbytes(std::int64_t(image.grid.number_of_voxels()), sizeof(T), bytes.data());
    set_voxels<T>(path, bytes, image, [](const char* p) {
      T x;
      std::memcpy(&x, p, sizeof(T));
      return x;
    });
  });
  return image;
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_READ_NIFTI_H
