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

#include <CGAL/Mixed_mesh_3/IO/write_mixed_mesh.h>
#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>
#include <CGAL/Mixed_mesh_image_3/warp_image.h>

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
#include <limits>
#include <locale>
#include <memory>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
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

// Reads plain and compressed files.
class Input_file
{
  struct Close
  {
    void operator()(gzFile_s* file) const { gzclose(file); }
  };
  const std::string& m_path;
  std::unique_ptr<gzFile_s, Close> m_file;

  int check_compression()
  {
    int error = Z_OK;
    gzerror(m_file.get(), &error);
    if(error != Z_OK && error != Z_BUF_ERROR) // not the end of the file
      refuse(m_path, "is damaged: its compressed data are not valid");
    return error;
  }

public:
  explicit Input_file(const std::string& path) : m_path(path)
  {
    if(std::filesystem::is_directory(path))
      refuse(path, "is a directory");
    errno = 0;
    m_file.reset(gzopen(path.c_str(), "rb"));
    if(!m_file)
      refuse(path, std::string("cannot be opened: ") + std::strerror(errno));
    gzbuffer(m_file.get(), 1 << 17);
  }

  // Reads bytes. Returns whether there were enough bytes.
  bool read(void* bytes, std::size_t size)
  {
    for(char* p = static_cast<char*>(bytes); size != 0;) {
      const int n = gzread(m_file.get(), p, unsigned((std::min)(size, std::size_t(1) << 30)));
      check_compression();
      if(n <= 0)
        return false;
      p += n;
      size -= std::size_t(n);
    }
    return true;
  }

  // Whether the file has the right end after the bytes that were read: compressed data end with a checksum.
  bool has_end()
  {
    char next;
    gzread(m_file.get(), &next, 1);
    return check_compression() != Z_BUF_ERROR;
  }

  bool skip_to(std::int64_t position)
  {
    return position >= 0 && gzseek(m_file.get(), z_off_t(position), SEEK_SET) == z_off_t(position);
  }

  // An upper bound of the bytes in the file: deflate compresses to no less than 1/1032.
  double largest_size() const
  {
    std::error_code error;
    const auto size = std::filesystem::file_size(m_path, error);
    return error ? std::numeric_limits<double>::infinity() : 1032. * double(size);
  }
};

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
  double scale = 1; // determinants of rotations times sizes are as large as the product of the columns
  for(int j = 0; j < 4; ++j) {
    double length = 0;
    for(int i = 0; i < 3; ++i) {
      grid.index_to_world[i][j] = unit * map.m[i][j];
      length = std::hypot(length, grid.index_to_world[i][j]);
    }
    if(!(length < 1e15))
      refuse(path, "its orientation has entries that are too large");
    scale *= j < 3 ? length : 1;
  }
  if(!(std::abs(Mixed_meshes_3::determinant(grid.index_to_world)) > 1e-6 * scale))
    refuse(path, std::string("its ") + (has_sform ? "sform" : "qform") + " is singular");
  return grid;
}

// The numbers as stored in the file, in this machine's byte order.
inline std::vector<char> read_voxel_bytes(const std::string& path, Input_file& file,
                                          const nifti_image& header)
{
  const double count = double(header.nx) * double(header.ny) * double(header.nz);
  const std::string truncated = "is truncated: " + std::to_string(header.nx) + " x "
                                + std::to_string(header.ny) + " x " + std::to_string(header.nz)
                                + " voxels expected";
  if(count * header.nbyper > file.largest_size()) // before memory is allocated
    refuse(path, truncated);
  std::vector<char> bytes(std::size_t(count) * std::size_t(header.nbyper));
  if(!file.skip_to(header.iname_offset) || !file.read(bytes.data(), bytes.size()) || !file.has_end())
    refuse(path, truncated);
  if(header.byteorder != nifti_short_order() && header.nbyper > 1)
    nifti_swap_Nbytes(std::int64_t(count), header.nbyper, bytes.data());
  return bytes;
}

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

inline Voxel_image_3 read_image(const std::string& path)
{
  if(!ends_with(path, ".nii") && !ends_with(path, ".nii.gz"))
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

  const std::size_t count = image.grid.number_of_voxels();
  with_voxel_type(header.datatype, [&](auto zero) {
    using T = decltype(zero);
    const std::vector<char> bytes = read_voxel_bytes(path, input, header);
    image.values.resize(count);
    for(std::size_t i = 0; i < count; ++i) {
      T x;
      std::memcpy(&x, bytes.data() + i * sizeof(T), sizeof(T));
      image.values[i] = float(image.slope * double(x) + image.intercept);
      if(!std::isfinite(image.values[i])) {
        const auto& size = image.grid.size;
        refuse(path, "voxel (" + std::to_string(i % size[0]) + ", " + std::to_string(i / size[0] % size[1])
                       + ", " + std::to_string(i / size[0] / size[1]) + ") is not a finite number");
      }
    }
  });
  return image;
}

} // namespace internal

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
