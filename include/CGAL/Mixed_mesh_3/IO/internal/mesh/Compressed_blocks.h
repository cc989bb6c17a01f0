// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_COMPRESSED_BLOCKS_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_COMPRESSED_BLOCKS_H

#include <CGAL/license/Mixed_mesh_3.h>

#ifdef CGAL_USE_ZLIB

#include <zlib.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <streambuf>
#include <string>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

/// A stream buffer whose content becomes an array as VTK's `vtkZLibDataCompressor` makes it: blocks, each
/// compressed by zlib, after a header of words of 64 bits: the number of blocks, the size of a block, the
/// size of the last block if that is smaller, or 0, and the compressed size of each block.
class Compressed_blocks : public std::streambuf
{
  // A larger block makes files hardly smaller: of a mesh with 20,000 vertices, by 0.2 % if each array is one
  // block; VTK's 2^15 bytes make it 0.1 % larger.
  static constexpr std::size_t block_size = 1 << 16;

  std::string m_block, m_compressed;
  std::vector<std::uint64_t> m_sizes;

public:
  /// Returns the whole array. \pre called once, after the last byte was written
  std::string take()
  {
    const std::uint64_t last_size = m_block.size();
    if(last_size > 0)
      compress_block();
    std::vector<std::uint64_t> header{m_sizes.size(), m_sizes.empty() ? 0 : block_size, last_size};
    header.insert(header.end(), m_sizes.begin(), m_sizes.end());
    return std::string(reinterpret_cast<const char*>(header.data()), header.size() * sizeof(header[0]))
           + m_compressed;
  }

protected:
  std::streamsize xsputn(const char* bytes, std::streamsize n) override
  {
    for(std::size_t done = 0, size = std::size_t(n); done < size;) {
      const std::size_t taken = (std::min)(size - done, block_size - m_block.size());
      m_block.append(bytes + done, taken);
      done += taken;
      if(m_block.size() == block_size)
        compress_block();
    }
    return n;
  }

  int_type overflow(int_type c) override
  {
    const char byte = traits_type::to_char_type(c);
    xsputn(&byte, 1);
    return c;
  }

private:
  void compress_block()
  {
    uLongf size = compressBound(uLong(m_block.size()));
    const std::size_t begin = m_compressed.size();
    m_compressed.resize(begin + size);
    // The level is the fastest one: higher levels hardly compress coordinates and measures better.
    if(compress2(reinterpret_cast<Bytef*>(&m_compressed[begin]), &size,
                 reinterpret_cast<const Bytef*>(m_block.data()), uLong(m_block.size()), Z_BEST_SPEED)
       != Z_OK)
      throw std::bad_alloc(); // the only possible failure with enough room
    m_compressed.resize(begin + size);
    m_sizes.push_back(size);
    m_block.clear();
  }
};

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_USE_ZLIB

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_COMPRESSED_BLOCKS_H
