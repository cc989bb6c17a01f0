// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What readers of images share: messages for the numbers of a header, positions of voxels, and voxels.

#ifndef CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_IMAGE_PARTS_H
#define CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_IMAGE_PARTS_H

#include <CGAL/Mixed_mesh_3/IO/internal/errors.h>
#include <CGAL/Mixed_mesh_image_3/IO/internal/Input_file.h>
#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <locale>
#include <sstream>
#include <string>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

// The message for a refused value of a header, with the name of its field.
template <class Number>
std::string field_defect(const std::string& field, Number value, const std::string& expected)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << "cannot be read: its " << field << " is " << value << "; expected " << expected;
  return text.str();
}

template <class Number>
std::string finite_field_defect(const std::string& field, const Number* values, int begin, int end)
{
  for(int i = begin; i < end; ++i)
    if(!std::isfinite(values[i]))
      return field_defect(field + (end == 1 ? std::string() : '[' + std::to_string(i) + ']'), values[i],
                          "a finite number");
  return std::string();
}

// Refuses positions of voxels that are too far away, or not those of a volume; `name` is what the positions
// come from.
inline void check_positions(const std::string& path, const Voxel_grid_3& grid, const std::string& name)
{
  double scale = 1; // determinants of rotations times sizes are as large as the product of the columns
  for(int j = 0; j < 4; ++j) {
    double length = 0;
    for(int i = 0; i < 3; ++i)
      length = std::hypot(length, grid.index_to_world[i][j]);
    if(!(length < 1e15))
      refuse(path, "its orientation has entries that are too large");
    scale *= j < 3 ? length : 1;
  }
  if(!(std::abs(Mixed_meshes_3::determinant(grid.index_to_world)) > 1e-6 * scale))
    refuse(path, "its " + name + " is singular");
}

// The numbers of voxels as stored in a file, from a position on.
inline std::vector<char> read_voxel_bytes(const std::string& path, Input_file& file, const Voxel_grid_3& grid,
                                          std::size_t size_of_number, std::int64_t position)
{
  const auto& n = grid.size;
  const std::string truncated = "is truncated: " + std::to_string(n[0]) + " x " + std::to_string(n[1]) + " x "
                                + std::to_string(n[2]) + " voxels expected";
  const double size = double(n[0]) * double(n[1]) * double(n[2]) * double(size_of_number);
  if(size > file.largest_size()) // before memory is allocated
    refuse(path, truncated);
  std::vector<char> bytes(grid.number_of_voxels() * size_of_number);
  if(!file.skip_to(position) || !file.read(bytes.data(), bytes.size()) || !file.has_end())
    refuse(path, truncated);
  return bytes;
}

// Sets the values of an image from the numbers of its file, of type `T`, by slope and intercept; `number_at`
// interprets the bytes of a number.
template <class T, class Number_at>
void set_voxels(const std::string& path, const std::vector<char>& bytes, Voxel_image_3& image,
                const Number_at& number_at)
{
  const std::size_t count = image.grid.number_of_voxels();
  image.values.resize(count);
  for(std::size_t i = 0; i < count; ++i) {
    const T x = number_at(bytes.data() + i * sizeof(T));
    image.values[i] = float(image.slope * double(x) + image.intercept);
    if(!std::isfinite(image.values[i])) {
      const auto& size = image.grid.size;
      refuse(path, "voxel (" + std::to_string(i % size[0]) + ", " + std::to_string(i / size[0] % size[1])
                     + ", " + std::to_string(i / size[0] / size[1]) + ") is not a finite number");
    }
  }
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_IMAGE_PARTS_H
