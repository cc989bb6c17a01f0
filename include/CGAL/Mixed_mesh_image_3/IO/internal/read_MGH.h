// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Input of images of FreeSurfer, https://surfer.nmr.mgh.harvard.edu/fswiki/FsTutorial/MghFormat: a header of
// 284 bytes, the last 194 of them unused; voxels; and parameters of the scan, which are skipped. Bytes of
// numbers are in big-endian order.

#ifndef CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_READ_MGH_H
#define CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_READ_MGH_H

#include <CGAL/Mixed_mesh_3/IO/internal/errors.h>
#include <CGAL/Mixed_mesh_image_3/IO/internal/Input_file.h>
#include <CGAL/Mixed_mesh_image_3/IO/internal/image_format_of.h>
#include <CGAL/Mixed_mesh_image_3/IO/internal/image_parts.h>
#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

// A number whose bytes are in big-endian order.
template <class T>
T big_endian_number(const char* bytes)
{
  using Bits = std::conditional_t<sizeof(T) == 1, std::uint8_t,
                                  std::conditional_t<sizeof(T) == 2, std::uint16_t, std::uint32_t>>;
  static_assert(sizeof(Bits) == sizeof(T));
  Bits bits = 0;
  for(std::size_t i = 0; i < sizeof(T); ++i)
    bits = Bits(std::uint32_t(bits) << 8 | static_cast<unsigned char>(bytes[i]));
  T number;
  std::memcpy(&number, &bits, sizeof(T));
  return number;
}

// The first 90 bytes of a file, which are used.
struct Mgh_header
{
  // FreeSurfer's MGH format: seven integers of four bytes, and 256 bytes (UNUSED_SPACE_SIZE in its sources),
  // of which the flag and the geometry take 62.
  static constexpr std::size_t size_in_file = 284;

  std::int32_t version, sizes[3], frames, type, degrees_of_freedom;
  std::int16_t has_positions; // the format's goodRASFlag
  float spacing[3];
  float axes[3][3]; // directions of columns, rows and slices
  float center[3];

  explicit Mgh_header(const std::array<char, size_in_file>& bytes)
  {
    const char* p = bytes.data();
    const auto take = [&p](auto& number) {
      number = big_endian_number<std::decay_t<decltype(number)>>(p);
      p += sizeof(number);
    };
    take(version);
    for(std::int32_t& n : sizes)
      take(n);
    take(frames);
    take(type);
    take(degrees_of_freedom);
    take(has_positions);
    for(float& x : spacing)
      take(x);
    for(auto& axis : axes)
      for(float& x : axis)
        take(x);
    for(float& x : center)
      take(x);
    if(has_positions > 0)
      return;
    // Values that the format defines for files without them: those of coronal slices.
    const float columns[] = {-1, 0, 0}, rows[] = {0, 0, -1}, slices[] = {0, 1, 0};
    for(int i = 0; i < 3; ++i) {
      spacing[i] = 1;
      axes[0][i] = columns[i];
      axes[1][i] = rows[i];
      axes[2][i] = slices[i];
      center[i] = 0;
    }
  }
};

// Calls `f(T())` with the C++ type of the numbers, and sets the type of the image; false for other types, as
// of bits, tensors, complex numbers and colors.
template <class F>
bool with_mgh_type(std::int32_t type, Voxel_image_3& image, const F& f)
{
  switch(type) {
  case 0:
    image.type = Voxel_type::UINT8;
    f(std::uint8_t());
    return true;
  case 1:
    image.type = Voxel_type::INT32;
    f(std::int32_t());
    return true;
  case 3:
    image.type = Voxel_type::FLOAT32;
    f(float());
    return true;
  case 4:
    image.type = Voxel_type::INT16;
    f(std::int16_t());
    return true;
  case 10:
    image.type = Voxel_type::UINT16;
    f(std::uint16_t());
    return true;
  }
  return false;
}

// The defect of a header, or nothing.
inline std::string header_defect(const Mgh_header& header)
{
  if(header.version != 1)
    return "cannot be read: not an image of FreeSurfer of version 1";
  const char* const sizes[] = {"width", "height", "depth"};
  for(int i = 0; i < 3; ++i)
    if(header.sizes[i] < 1 || header.sizes[i] > 1000000000)
      return field_defect(sizes[i], header.sizes[i], "a number of voxels from 1 to 1000000000");
  if(header.frames < 1)
    return field_defect("nframes", header.frames, "1");
  if(header.frames > 1)
    return "is a 4-D image of " + std::to_string(header.sizes[0]) + " x " + std::to_string(header.sizes[1])
           + " x " + std::to_string(header.sizes[2]) + " x " + std::to_string(header.frames)
           + " values; expected three dimensions";
  const char letters[] = {'x', 'y', 'z'}, directions[] = {'r', 'a', 's'};
  for(int i = 0; i < 3; ++i) {
    const std::string letter(1, letters[i]);
    if(!(std::isfinite(header.spacing[i]) && header.spacing[i] > 0))
      return field_defect("spacing " + letter, header.spacing[i], "a size greater than 0");
    for(int j = 0; j < 3; ++j) {
      const std::string defect = finite_field_defect(letter + '_' + directions[j], &header.axes[i][j], 0, 1);
      if(!defect.empty())
        return defect;
    }
  }
  for(int j = 0; j < 3; ++j) {
    const std::string defect = finite_field_defect(std::string("c_") + directions[j], &header.center[j], 0,
                                                   1);
    if(!defect.empty())
      return defect;
  }
  return std::string();
}

// The grid of an image: the center of the image, in indices half its sizes, is at the header's center.
inline Voxel_grid_3 read_grid(const std::string& path, const Mgh_header& header)
{
  Voxel_grid_3 grid;
  grid.world = header.has_positions > 0 ? 1 : 0;
  for(int i = 0; i < 3; ++i) {
    grid.size[i] = std::size_t(header.sizes[i]);
    double center = 0;
    for(int j = 0; j < 3; ++j) {
      const float entry = header.axes[j][i] * header.spacing[j];
      grid.index_to_world[i][j] = double(entry);
      center += double(entry) * header.sizes[j];
    }
    // Floats, as in the sform of the image converted to NIfTI: both files have the same mesh.
    grid.index_to_world[i][3] = double(float(double(header.center[i]) - center / 2));
  }
  check_positions(path, grid, "matrix of x_r to z_s");
  return grid;
}

inline Voxel_image_3 read_MGH_image(const std::string& path)
{
  if(image_format_of(path) != Image_format::MGH)
    refuse(path, "unknown format; expected .mgh or .mgz");
  Input_file input(path);
  std::array<char, Mgh_header::size_in_file> start;
  if(!input.read(start.data(), start.size()))
    refuse(path, "cannot be read: not an image of FreeSurfer, or truncated");
  const Mgh_header header(start);
  const std::string defect = header_defect(header);
  if(!defect.empty())
    refuse(path, defect);
  Voxel_image_3 image;
  image.grid = read_grid(path, header);
  const bool is_known = with_mgh_type(header.type, image, [&](auto zero) {
    using T = decltype(zero);
    const std::vector<char> bytes = read_voxel_bytes(path, input, image.grid, sizeof(T),
                                                     Mgh_header::size_in_file);
    set_voxels<T>(path, bytes, image, &big_endian_number<T>);
  });
  if(!is_known)
    refuse(path, "has voxels of type " + std::to_string(header.type)
                   + "; expected 0 (uchar), 1 (int), 3 (float), 4 (short) or 10 (ushort)");
  return image;
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_READ_MGH_H
