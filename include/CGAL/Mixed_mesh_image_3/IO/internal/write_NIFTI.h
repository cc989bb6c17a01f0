// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Output of NIfTI images and fields, compressed or not.

#ifndef CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_WRITE_NIFTI_H
#define CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_WRITE_NIFTI_H

#include <CGAL/Mixed_mesh_3/IO/internal/errors.h>
#include <CGAL/Mixed_mesh_3/IO/internal/extension_of.h>
#include <CGAL/Mixed_mesh_3/IO/write_mixed_mesh.h>
#include <CGAL/Mixed_mesh_image_3/IO/internal/voxel_types.h>
#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>
#include <CGAL/Mixed_mesh_image_3/warp_image.h>

#include <nifti2_io.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <ostream>
#include <string>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

// Output to a stream, compressed or not; without a time, so that the same data give the same bytes.
class Compressed_output
{
  std::ostream& m_stream;
  z_stream m_state{};
  bool m_is_compressed, m_is_good = true;

  void run(int flush)
  {
    char buffer[1 << 15];
    do {
      m_state.next_out = reinterpret_cast<Bytef*>(buffer);
      m_state.avail_out = sizeof(buffer);
      m_is_good = m_is_good && deflate(&m_state, flush) != Z_STREAM_ERROR;
      m_stream.write(buffer, std::streamsize(sizeof(buffer) - m_state.avail_out));
    } while(m_is_good && m_state.avail_out == 0);
  }

public:
  Compressed_output(std::ostream& stream, bool is_compressed)
    : m_stream(stream), m_is_compressed(is_compressed)
  {
    // The level is the fastest one: fields of floats are hardly compressed better by others. 16 + 15: gzip.
    if(m_is_compressed)
      m_is_good = deflateInit2(&m_state, Z_BEST_SPEED, Z_DEFLATED, 16 + 15, 9, Z_DEFAULT_STRATEGY) == Z_OK;
  }
  Compressed_output(const Compressed_output&) = delete;
  Compressed_output& operator=(const Compressed_output&) = delete;
  ~Compressed_output()
  {
    if(m_is_compressed)
      deflateEnd(&m_state);
  }

  void write(const void* bytes, std::size_t size)
  {
    const char* p = static_cast<const char*>(bytes);
    while(size != 0 && m_is_good) {
      const std::size_t n = (std::min)(size, std::size_t(1) << 30);
      if(m_is_compressed) {
        m_state.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(p));
        m_state.avail_in = uInt(n);
        run(Z_NO_FLUSH);
      } else {
        m_stream.write(p, std::streamsize(n));
      }
      p += n;
      size -= n;
    }
  }

  bool finish()
  {
    if(m_is_compressed && m_is_good)
      run(Z_FINISH);
    return m_is_good && m_stream.good();
  }
};

// Makes a header without dimensions beyond the third, and without type.
inline nifti_1_header make_header(const Voxel_grid_3& grid)
{
  nifti_1_header h{};
  h.sizeof_hdr = 348;
  h.regular = 'r';
  h.dim[0] = 3;
  for(int i = 1; i < 8; ++i)
    h.dim[i] = i <= 3 ? short(grid.size[i - 1]) : short(1);
  h.vox_offset = 352;
  h.scl_slope = 1;
  h.xyzt_units = NIFTI_UNITS_MM;
  std::memcpy(h.magic, "n+1", 4);

  nifti_dmat44 map{};
  float* const rows[] = {h.srow_x, h.srow_y, h.srow_z};
  for(int i = 0; i < 3; ++i)
    for(int j = 0; j < 4; ++j) {
      map.m[i][j] = grid.index_to_world[i][j];
      rows[i][j] = float(map.m[i][j]);
    }
  map.m[3][3] = 1;
  h.sform_code = short(grid.world);

  // The qform is written as well, for readers that use only the qform, if it can represent the map: axes at
  // right angles.
  double b, c, d, x, y, z, dx, dy, dz, factor;
  nifti_dmat44_to_quatern(map, &b, &c, &d, &x, &y, &z, &dx, &dy, &dz, &factor);
  const nifti_dmat44 same = nifti_quatern_to_dmat44(b, c, d, x, y, z, dx, dy, dz, factor);
  double difference = 0;
  for(int i = 0; i < 3; ++i)
    for(int j = 0; j < 3; ++j)
      difference = (std::max)(difference, std::abs(same.m[i][j] - map.m[i][j]) / (std::min)({dx, dy, dz}));
  h.qform_code = difference < 1e-5 ? h.sform_code : short(0);
  h.quatern_b = float(b);
  h.quatern_c = float(c);
  h.quatern_d = float(d);
  h.qoffset_x = float(x);
  h.qoffset_y = float(y);
  h.qoffset_z = float(z);
  h.pixdim[0] = float(factor);
  h.pixdim[1] = float(dx);
  h.pixdim[2] = float(dy);
  h.pixdim[3] = float(dz);
  for(int i = 4; i < 8; ++i)
    h.pixdim[i] = 1;
  return h;
}

// The reason why nothing can be written, or empty.
inline std::string image_output_error(const std::string& path, const Voxel_grid_3& grid, std::size_t count)
{
  if(!ends_with(path, ".nii") && !ends_with(path, ".nii.gz"))
    return "unknown extension, known are .nii .nii.gz";
  for(std::size_t n : grid.size)
    if(n < 1 || n > 32767)
      return "a NIfTI-1 image cannot have " + std::to_string(n) + " voxels in a row";
  if(count != grid.number_of_voxels())
    return "the image does not have the size of its grid";
  return std::string();
}

// Writes numbers, which are converted in blocks on their way to the file.
template <class T>
void write_as(Compressed_output& output, const Voxel_image_3& image, double slope)
{
  std::vector<T> block;
  for(std::size_t i = 0; i < image.values.size(); i += block.size()) {
    block.resize((std::min)(image.values.size() - i, std::size_t(1) << 16));
    for(std::size_t k = 0; k < block.size(); ++k) {
      double x = (double(image.values[i + k]) - image.intercept) / slope;
      if constexpr(std::is_integral<T>::value) {
        using Limits = std::numeric_limits<T>;
        x = std::nearbyint(x);
        block[k] = x >= double((Limits::max)())  ? (Limits::max)()
                   : x > double((Limits::min)()) ? T(x)
                                                 : (Limits::min)();
      } else {
        block[k] = T(x);
      }
    }
    output.write(block.data(), block.size() * sizeof(T));
  }
}

/// Writes a vector image of five dimensions.
/// \param intent meaning of the vectors, and by that their coordinate system
/// \param signs signs of the components, relative to the directions of the image's world
[[nodiscard]] inline bool write_NIFTI_field(Output_files& files, const std::string& path,
                                            const Displacement_field_3& field, int intent,
                                            const std::array<float, 3>& signs, std::string* error)
{
  const std::string defect = image_output_error(path, field.grid, field.vectors.size());
  if(!is_success(with_path(path, defect), error))
    return false;
  return files.write(
    path,
    [&](std::ostream& stream) {
      nifti_1_header header = make_header(field.grid);
      header.dim[0] = 5;
      header.dim[5] = 3;
      header.datatype = NIFTI_TYPE_FLOAT32;
      header.bitpix = 32;
      header.intent_code = short(intent);
      Compressed_output output(stream, ends_with(path, ".gz"));
      const char no_extension[4] = {};
      output.write(&header, sizeof(header));
      output.write(no_extension, sizeof(no_extension));
      std::vector<float> block;
      for(std::size_t component = 0; component < 3; ++component)
        for(std::size_t i = 0; i < field.vectors.size(); i += block.size()) {
          block.resize((std::min)(field.vectors.size() - i, std::size_t(1) << 16));
          for(std::size_t k = 0; k < block.size(); ++k)
            block[k] = signs[component] * field.vectors[i + k][component];
          output.write(block.data(), block.size() * sizeof(float));
        }
      return output.finish();
    },
    error);
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_WRITE_NIFTI_H
