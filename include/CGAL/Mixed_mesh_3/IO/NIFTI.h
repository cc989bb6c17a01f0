// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// NIfTI images. Headers are read by nifti_clib (Debian: libnifti2-dev, zlib1g-dev; link nifti2, znz and z).
// Voxels are read and written here: nifti_clib turns what is not a number into 0 without a word, and does
// not tell when the disk is full.

#ifndef CGAL_MIXED_MESH_3_IO_NIFTI_H
#define CGAL_MIXED_MESH_3_IO_NIFTI_H

#include <CGAL/Mixed_mesh_3/IO/write_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/Voxel_image_3.h>
#include <CGAL/Mixed_mesh_3/warp_image.h>

#include <nifti2_io.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <ostream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

namespace internal {

inline bool ends_with(const std::string& text, const std::string& end)
{
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

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

[[noreturn]] inline void refuse_image(const std::string& path, const std::string& defect)
{
  throw std::runtime_error(path + ": " + defect);
}

// The grid of an image: sform, else qform, else the voxels' sizes. Lengths become millimetres.
inline Voxel_grid_3 read_grid(const std::string& path, const nifti_image& header)
{
  Voxel_grid_3 grid;
  const char* const names[] = {"first", "second", "third"};
  const std::int64_t size[] = {header.nx, header.ny, header.nz};
  for(int i = 0; i < 3; ++i) {
    if(size[i] < 1 || size[i] > 1000000)
      refuse_image(path, std::string("its ") + names[i] + " dimension is " + std::to_string(size[i]));
    grid.size[i] = std::size_t(size[i]);
  }
  const bool has_sform = header.sform_code > 0;
  grid.world = has_sform ? header.sform_code : header.qform_code > 0 ? header.qform_code : 0;
  const double unit = header.xyz_units == NIFTI_UNITS_METER ? 1000
                      : header.xyz_units == NIFTI_UNITS_MICRON ? 0.001 : 1;
  const nifti_dmat44& map = has_sform ? header.sto_xyz : header.qto_xyz;
  for(int i = 0; i < 3; ++i)
    for(int j = 0; j < 4; ++j) {
      grid.index_to_world[i][j] = unit * map.m[i][j];
      if(!(std::abs(grid.index_to_world[i][j]) < 1e15))
        refuse_image(path, "its orientation has entries that are not finite numbers");
    }
  double scale = 1; // determinants of rotations times sizes are as large as the product of the columns
  for(int j = 0; j < 3; ++j)
    scale *= std::hypot(grid.index_to_world[0][j], grid.index_to_world[1][j], grid.index_to_world[2][j]);
  if(!(std::abs(Mixed_meshes_3::determinant(grid.index_to_world)) > 1e-6 * scale))
    refuse_image(path, std::string("its ") + (has_sform ? "sform" : "qform") + " is singular");
  return grid;
}

// The numbers as they are in the file, in this machine's byte order.
inline std::vector<char> read_voxel_bytes(const std::string& path, const nifti_image& header,
                                          std::size_t count)
{
  const std::size_t width = std::size_t(header.nbyper), size = count * width;
  const std::string truncated = "is truncated: " + std::to_string(count) + " voxels expected";
  // Before memory is asked for: deflate shrinks to no less than 1/1032.
  std::error_code ignored;
  const auto file_size = std::filesystem::file_size(path, ignored);
  if(!ignored && std::filesystem::is_regular_file(path, ignored)
     && size / (ends_with(path, ".gz") ? 1032 : 1) > file_size)
    refuse_image(path, truncated);
  struct Close
  {
    void operator()(gzFile_s* file) const { gzclose(file); }
  };
  const std::unique_ptr<gzFile_s, Close> file(gzopen(path.c_str(), "rb")); // reads plain files, too
  if(!file)
    refuse_image(path, std::string("cannot be opened: ") + std::strerror(errno));
  gzbuffer(file.get(), 1 << 17);
  if(header.iname_offset < 0
     || gzseek(file.get(), z_off_t(header.iname_offset), SEEK_SET) != z_off_t(header.iname_offset))
    refuse_image(path, truncated);
  std::vector<char> bytes(size);
  for(std::size_t done = 0; done < size;) {
    const int n = gzread(file.get(), bytes.data() + done, unsigned((std::min)(size - done, std::size_t(1) << 30)));
    if(n <= 0)
      refuse_image(path, truncated);
    done += std::size_t(n);
  }
  char end; // the checksum comes after the last byte
  if(gzread(file.get(), &end, 1) < 0)
    refuse_image(path, "is damaged: its compressed data do not have the checksum that the file says");
  if(header.byteorder != nifti_short_order() && width > 1)
    nifti_swap_Nbytes(std::int64_t(count), int(width), bytes.data());
  return bytes;
}

// Compressed, or not, on the way to a stream. Without a time, so that the same data give the same bytes.
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
    // The fastest level: fields of floats hardly become smaller by more. 16 + 15: gzip.
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

// Without dimensions beyond the third, and without type.
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

  // The qform is written as well, for readers that look at it only, if it can say the same: axes at
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

// Why nothing can be written, or empty.
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

// Numbers are converted in blocks on their way to the file.
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
        block[k] = x >= double((Limits::max)()) ? (Limits::max)()
                   : x > double((Limits::min)()) ? T(x) : (Limits::min)();
      } else {
        block[k] = T(x);
      }
    }
    output.write(block.data(), block.size() * sizeof(T));
  }
}

} // namespace internal

/*!
Reads a NIfTI image (`.nii`, `.nii.gz`; NIfTI-1 and NIfTI-2, either byte order).

Positions are those of the sform, else of the qform, else the voxels' sizes times the indices; in
millimetres, whatever the unit of the file. The file's slope and intercept are applied. Values are floats:
integers beyond 2^24 lose digits. Not for several threads at once.

\param path the file
\return the image
\throw std::runtime_error a line naming the file and the defect, if it cannot be read, is truncated or
       damaged, does not have three dimensions, or has voxels that are not finite real numbers
*/
inline Voxel_image_3 read_NIFTI(const std::string& path)
{
  using internal::refuse_image;
  if(!internal::ends_with(path, ".nii") && !internal::ends_with(path, ".nii.gz"))
    refuse_image(path, "unknown format; expected .nii or .nii.gz");
  if(std::filesystem::is_directory(path))
    refuse_image(path, "is a directory");
  errno = 0;
  if(!std::ifstream(path))
    refuse_image(path, std::string("cannot be opened: ") + std::strerror(errno));

  struct Free
  {
    void operator()(nifti_image* header) const { nifti_image_free(header); }
  };
  nifti_set_debug_level(0); // or it prints
  const std::unique_ptr<nifti_image, Free> owner(nifti_image_read(path.c_str(), 0));
  if(!owner || owner->nifti_type == NIFTI_FTYPE_ANALYZE) // which does not know left from right
    refuse_image(path, "cannot be read: not a NIfTI image");
  const nifti_image& header = *owner;
  if(header.nifti_type != NIFTI_FTYPE_NIFTI1_1 && header.nifti_type != NIFTI_FTYPE_NIFTI2_1)
    refuse_image(path, "cannot be read: its voxels are in another file");

  std::int64_t volumes = 1;
  const std::int64_t further[] = {header.nt, header.nu, header.nv, header.nw};
  for(std::int64_t n : further)
    if(n > 1)
      volumes = n < 1000000 && volumes < 1000000 ? volumes * n : 1000000;
  if(volumes != 1)
    refuse_image(path, "is a " + std::to_string(header.ndim) + "-D image with " + std::to_string(volumes)
                         + " values in a voxel; expected a 3-D image with one");
  Voxel_image_3 image;
  image.grid = internal::read_grid(path, header);
  image.type = Voxel_type(header.datatype);
  if(header.scl_slope != 0) {
    image.slope = header.scl_slope;
    image.intercept = header.scl_inter;
  }
  if(!std::isfinite(image.slope) || !std::isfinite(image.intercept))
    refuse_image(path, "its slope or intercept is not a finite number");

  const std::size_t count = image.grid.number_of_voxels();
  const bool is_known = internal::with_voxel_type(header.datatype, [&](auto zero) {
    using T = decltype(zero);
    const std::vector<char> bytes = internal::read_voxel_bytes(path, header, count);
    image.values.resize(count);
    for(std::size_t i = 0; i < count; ++i) {
      T x;
      std::memcpy(&x, bytes.data() + i * sizeof(T), sizeof(T));
      image.values[i] = float(image.slope * double(x) + image.intercept);
      if(!std::isfinite(image.values[i])) {
        const auto& size = image.grid.size;
        refuse_image(path, "voxel (" + std::to_string(i % size[0]) + ", "
                             + std::to_string(i / size[0] % size[1]) + ", "
                             + std::to_string(i / size[0] / size[1]) + ") is not a finite number");
      }
    }
  });
  if(!is_known)
    refuse_image(path, std::string("has voxels of type ") + nifti_datatype_to_string(header.datatype)
                         + "; expected one real number in a voxel");
  return image;
}

/*!
Writes an image to one of several files that shall appear together.

As NIfTI-1, in the image's type: integers are rounded, and cut off at the ends of their range. Positions
are written as sform, and as qform if the axes are at right angles.

\param files the files
\param path the file, once committed: `.nii` or `.nii.gz`
\param image the image
\return the error, or `std::nullopt`
*/
[[nodiscard]] inline Write_error write_NIFTI(Output_files& files, const std::string& path,
                                             const Voxel_image_3& image)
{
  const std::string error = internal::image_output_error(path, image.grid, image.values.size());
  if(!error.empty())
    return path + ": " + error;
  return files.write(path, [&](std::ostream& stream) {
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
  });
}

/// As above, a field: a vector image (five dimensions, `NIFTI_INTENT_DISPVECT`) of floats in millimetres,
/// components in the directions of the image's world: right, front, up.
[[nodiscard]] inline Write_error write_NIFTI(Output_files& files, const std::string& path,
                                             const Displacement_field_3& field)
{
  const std::string error = internal::image_output_error(path, field.grid, field.vectors.size());
  if(!error.empty())
    return path + ": " + error;
  return files.write(path, [&](std::ostream& stream) {
    nifti_1_header header = internal::make_header(field.grid);
    header.dim[0] = 5;
    header.dim[5] = 3;
    header.datatype = NIFTI_TYPE_FLOAT32;
    header.bitpix = 32;
    header.intent_code = NIFTI_INTENT_DISPVECT;
    internal::Compressed_output output(stream, internal::ends_with(path, ".gz"));
    const char no_extension[4] = {};
    output.write(&header, sizeof(header));
    output.write(no_extension, sizeof(no_extension));
    std::vector<float> block;
    for(std::size_t component = 0; component < 3; ++component)
      for(std::size_t i = 0; i < field.vectors.size(); i += block.size()) {
        block.resize((std::min)(field.vectors.size() - i, std::size_t(1) << 16));
        for(std::size_t k = 0; k < block.size(); ++k)
          block[k] = field.vectors[i + k][component];
        output.write(block.data(), block.size() * sizeof(float));
      }
    return output.finish();
  });
}

/// Writes an image or a field to a file, which appears when it is complete.
template <class Image>
[[nodiscard]] Write_error write_NIFTI(const std::string& path, const Image& image)
{
  Output_files files;
  if(auto error = write_NIFTI(files, path, image))
    return error;
  return files.commit();
}

/*!
Writes what `warp_image()` returns, beside each other: for `brain.nii.gz`

| file | what it is |
|------|------------|
| `brain.nii.gz` | the warped image |
| `brain_forward.nii.gz` | the field at points before the deformation: where they go |
| `brain_backward.nii.gz` | the field at points after it: where they come from |
| `brain_mask.nii.gz` | 0 outside, 1 tissue, 2 resected: after the deformation |

\return the error, or `std::nullopt`
*/
[[nodiscard]] inline Write_error write_warped_image(Output_files& files, const std::string& path,
                                                    const Warped_image_3& warped)
{
  const std::string extension = internal::ends_with(path, ".gz") ? ".nii.gz" : ".nii";
  const std::string stem = path.substr(0, path.size() - (std::min)(path.size(), extension.size()));
  if(auto error = write_NIFTI(files, path, warped.image))
    return error;
  if(auto error = write_NIFTI(files, stem + "_forward" + extension, warped.forward))
    return error;
  if(auto error = write_NIFTI(files, stem + "_backward" + extension, warped.backward))
    return error;
  return write_NIFTI(files, stem + "_mask" + extension, warped.mask);
}

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_NIFTI_H
