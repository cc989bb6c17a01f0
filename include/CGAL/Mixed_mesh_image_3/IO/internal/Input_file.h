// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files of images, plain or compressed by gzip.

#ifndef CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_INPUT_FILE_H
#define CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_INPUT_FILE_H

#include <CGAL/Mixed_mesh_3/IO/internal/errors.h>

#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

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

  // Whether the file has the right end after the bytes that were read, and others: compressed data end with a
  // checksum.
  bool has_end()
  {
    std::vector<char> rest(1 << 16);
    while(gzread(m_file.get(), rest.data(), unsigned(rest.size())) > 0) {
    }
    return check_compression() != Z_BUF_ERROR;
  }

  bool skip_to(std::int64_t position)
  {
    return position >= 0 && gzseek(m_file.get(), z_off_t(position), SEEK_SET) == z_off_t(position);
  }

  // An upper bound of the bytes in the file, once some were read: deflate compresses to no less than 1/1032.
  double largest_size() const
  {
    std::error_code error;
    const auto size = std::filesystem::file_size(m_path, error);
    const double factor = gzdirect(m_file.get()) != 0 ? 1 : 1032;
    return error ? std::numeric_limits<double>::infinity() : factor * double(size);
  }
};

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_INPUT_FILE_H
