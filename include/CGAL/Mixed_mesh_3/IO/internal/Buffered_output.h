// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Buffered text and binary output, which all writers share.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_BUFFERED_OUTPUT_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_BUFFERED_OUTPUT_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Index.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <ostream>
#include <string>
#include <string_view>
#include <type_traits>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

namespace internal {

// Collects small pieces and passes them to the stream in blocks. Numbers do not depend on the locale, and
// doubles have as many digits as needed to read the same double back.
class Buffered_output
{
  std::ostream& m_stream;
  std::size_t m_size = 0;
  char m_buffer[1 << 16];

  char* room_for(std::size_t n)
  {
    if(m_size + n > sizeof(m_buffer))
      empty_buffer();
    return m_buffer + m_size;
  }

  void empty_buffer()
  {
    m_stream.write(m_buffer, std::streamsize(m_size));
    m_size = 0;
  }

public:
  explicit Buffered_output(std::ostream& stream) : m_stream(stream) {}
  Buffered_output(const Buffered_output&) = delete;
  Buffered_output& operator=(const Buffered_output&) = delete;

  void write_bytes(const char* bytes, std::size_t n)
  {
    if(n > sizeof(m_buffer)) {
      empty_buffer();
      m_stream.write(bytes, std::streamsize(n));
    } else {
      std::memcpy(room_for(n), bytes, n);
      m_size += n;
    }
  }

  template <class Value>
  void write_binary(const Value& value)
  {
    static_assert(std::is_trivially_copyable<Value>::value, "bytes of a class mean nothing");
    write_bytes(reinterpret_cast<const char*>(&value), sizeof(value));
  }

  Buffered_output& operator<<(std::string_view text)
  {
    write_bytes(text.data(), text.size());
    return *this;
  }

  Buffered_output& operator<<(char c)
  {
    *room_for(1) = c;
    ++m_size;
    return *this;
  }

  template <class Number, class = std::enable_if_t<std::is_arithmetic<Number>::value>>
  Buffered_output& operator<<(Number number)
  {
    char* const begin = room_for(32);
    m_size += std::size_t(std::to_chars(begin, begin + 32, number).ptr - begin);
    return *this;
  }

  // Returns whether the stream took everything.
  bool finish()
  {
    empty_buffer();
    m_stream.flush();
    return m_stream.good();
  }
};

inline void write_point(Buffered_output& out, const Mixed_meshes_3::Vec3& p, std::string_view separator)
{
  out << p[0] << separator << p[1] << separator << p[2];
}

inline std::string escaped_for_XML(const std::string& text)
{
  std::string result;
  for(char c : text)
    switch(c) {
    case '&': result += "&amp;"; break;
    case '<': result += "&lt;"; break;
    case '>': result += "&gt;"; break;
    case '"': result += "&quot;"; break;
    default: result += c;
    }
  return result;
}

// Writes vertices, numbered from 1 as in all text formats.
template <class Vertices>
void write_vertices(Buffered_output& out, const Vertices& vertices, char separator)
{
  bool first = true;
  for(Vertex_index v : vertices) {
    if(!first)
      out << separator;
    out << std::uint64_t(v) + 1;
    first = false;
  }
}

} // namespace internal

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_BUFFERED_OUTPUT_H
