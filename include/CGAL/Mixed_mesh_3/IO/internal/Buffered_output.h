// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What all writers share: buffered text and binary output, faces and blocks of elements.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_BUFFERED_OUTPUT_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_BUFFERED_OUTPUT_H

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/quality.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <ostream>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

namespace internal {

//----------------------------------------------------------------------------------------------
// Shared by all writers.

// Collects small pieces and hands them to the stream in blocks. Numbers do not depend on the
// locale, and doubles have as many digits as it takes to read the same double back.
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

  // Returns whether everything arrived.
  bool finish()
  {
    empty_buffer();
    m_stream.flush();
    return m_stream.good();
  }
};

inline void write_point(Buffered_output& out, const Mixed_meshes_3::Vec3& p,
                        std::string_view separator)
{
  out << p[0] << separator << p[1] << separator << p[2];
}

// Vertices numbered from 1, as all text formats want them.
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

// The vertices of a boundary face in the numbering of the mesh.
class Face_vertices
{
  int m_size;
  Vertex_index m_vertices[4];

public:
  template <class Mesh>
  Face_vertices(const Mesh& mesh, const typename Mesh::Boundary_face& boundary_face)
  {
    const Element_view element = mesh.element(boundary_face.element);
    const Element_face& face = element.reference().faces[boundary_face.local_face];
    m_size = face.size;
    for(int i = 0; i < face.size; ++i)
      m_vertices[i] = element[face.vertices[i]];
  }

  int size() const { return m_size; }
  const Vertex_index* begin() const { return m_vertices; }
  const Vertex_index* end() const { return m_vertices + m_size; }
};

template <class Mesh>
std::size_t number_of_boundary_faces(const Mesh& mesh, int size)
{
  std::size_t n = 0;
  for(const auto& face : mesh.boundary_faces())
    n += Face_vertices(mesh, face).size() == size;
  return n;
}

// Elements of one kind, in the region or not: what formats write as a block.
struct Element_block
{
  bool in_region;
  Element_kind kind;
  std::size_t size;

  const Reference_element& reference() const { return reference_elements[kind]; }
  const char* part() const { return in_region ? "region" : "rest"; }

  template <class Mesh>
  bool has(const Mesh& mesh, std::size_t e) const
  {
    return mesh.elements().kinds()[e] == kind && mesh.is_in_region(e) == in_region;
  }
};

// The blocks that are not empty, those of the region first.
template <class Mesh>
std::vector<Element_block> element_blocks(const Mesh& mesh)
{
  std::size_t sizes[2][number_of_element_kinds] = {};
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
    ++sizes[mesh.is_in_region(e)][mesh.elements().kinds()[e]];
  std::vector<Element_block> blocks;
  for(bool in_region : {true, false})
    for(Element_kind kind : element_kinds)
      if(sizes[in_region][kind] != 0)
        blocks.push_back({in_region, kind, sizes[in_region][kind]});
  return blocks;
}

// References of the parts in formats where they are numbers.
constexpr int region_tag = 1, rest_tag = 2, boundary_tag = 3;

} // namespace internal

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_BUFFERED_OUTPUT_H
