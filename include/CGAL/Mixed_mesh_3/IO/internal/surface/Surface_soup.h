// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Input that the readers of surfaces share: points and polygons of a file, its words and bytes. A file may
// have any content: memory is allocated only after its size is found to fit the size of the file.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_SURFACE_SOUP_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_SURFACE_SOUP_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/internal/Text_input.h>
#include <CGAL/Mixed_mesh_3/IO/internal/errors.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <CGAL/config.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

/// A surface as given in a file. Indices may be out of range: `no_vertex` if they were negative.
struct Surface_soup
{
  std::vector<Mixed_meshes_3::Vec3> points;
  std::vector<std::vector<std::size_t>> polygons;
  std::string comments;        // header or comments of the file, where another program may have its own facts
  bool repeats_points = false; // each polygon has its own
  std::vector<std::string> warnings;
};

constexpr std::size_t no_vertex = (std::numeric_limits<std::size_t>::max)();

inline std::string not_finite(std::size_t vertex)
{
  return "vertex " + std::to_string(vertex) + " has a coordinate that is not a finite number";
}

/// An index of any type; an invalid one becomes `no_vertex`.
template <class Number>
std::size_t vertex_index(Number index)
{
  return index >= 0 && index < Number(1e18) ? std::size_t(index) : no_vertex;
}

/// Adds the triangles of a strip, all oriented like the first triangle.
template <class Index>
void add_strip(const Index* strip, std::size_t size, Surface_soup& soup)
{
  for(std::size_t i = 0; i + 2 < size; ++i)
    soup.polygons.push_back(
      {vertex_index(strip[i + i % 2]), vertex_index(strip[i + 1 - i % 2]), vertex_index(strip[i + 2])});
}

/// Words and numbers of a text, in every locale; messages name the line.
class Surface_text
{
  const std::string& m_path;
  std::string_view m_text;
  Text_input m_in;
  char m_comment;

  std::size_t line_at(std::size_t position) const
  {
    return std::size_t(std::count(m_text.begin(), m_text.begin() + std::ptrdiff_t(position), '\n')) + 1;
  }

public:
  /// \param comment character after which the rest of the line is skipped; 0: there are no comments
  Surface_text(const std::string& path, std::string_view text, char comment = 0)
    : m_path(path), m_text(text), m_in(text), m_comment(comment)
  {
  }

  std::string_view rest() const { return m_in.rest(); }
  void skip(std::size_t n) { m_in.skip(n); }
  std::size_t line() const { return line_at(m_text.size() - rest().size()); }

  [[noreturn]] void refuse(const std::string& defect) const
  {
    internal::refuse(m_path, "line " + std::to_string(line()) + ": " + defect);
  }

  /// Skips the rest of a line, with its end.
  std::string_view rest_of_line()
  {
    const std::size_t n = (std::min)(rest().find('\n'), rest().size());
    const std::string_view line = rest().substr(0, n);
    skip((std::min)(n + 1, rest().size()));
    return line;
  }

  void skip_space()
  {
    for(m_in.skip_space(); m_comment != 0 && !rest().empty() && rest()[0] == m_comment; m_in.skip_space())
      rest_of_line();
  }

  /// The next word; empty at the end.
  std::string_view word_or_end()
  {
    skip_space();
    std::size_t n = 0;
    while(n < rest().size() && !is_space(rest()[n]) && (m_comment == 0 || rest()[n] != m_comment))
      ++n;
    const std::string_view result = rest().substr(0, n);
    skip(n);
    return result;
  }

  std::string_view word(const char* expected)
  {
    const std::string_view result = word_or_end();
    if(result.empty())
      internal::refuse(m_path, "is truncated: " + std::string(expected) + " is missing");
    return result;
  }

  /// Parses a number that may be infinite or no number: the caller, who knows the vertex, has to check it.
  double parse_coordinate(std::string_view word) const
  {
    double x = 0;
    std::string_view digits = word;
    if(digits.size() > 1 && digits[0] == '+' && digits[1] != '-')
      digits.remove_prefix(1);
    const char* const end = digits.data() + digits.size();
    const std::from_chars_result result = std::from_chars(digits.data(), end, x);
    if(result.ptr != end || result.ec == std::errc::invalid_argument)
      refuse("expected a number, not " + in_quotes(word));
    if(result.ec == std::errc::result_out_of_range) {
      if(word.find("e-") == word.npos && word.find("E-") == word.npos)
        refuse("the number " + in_quotes(word) + " is too large");
      return 0;
    }
    return x;
  }

  double coordinate() { return parse_coordinate(word("a coordinate")); }

  /// Checks the number that was just read, while its line is known.
  double finite_coordinate(double x, std::size_t vertex) const
  {
    if(!std::isfinite(x))
      refuse(not_finite(vertex));
    return x;
  }

  Vec3 point(std::size_t vertex)
  {
    Vec3 p;
    for(double& x : p)
      x = finite_coordinate(coordinate(), vertex);
    return p;
  }

  template <class Integer>
  Integer parse_integer(std::string_view word) const
  {
    Integer n = 0;
    if(!parse_number(word, n))
      refuse("expected an integer, not " + in_quotes(word));
    return n;
  }

  std::size_t index() { return vertex_index(parse_integer<std::int64_t>(word("a vertex of a face"))); }

  /// The number of items that take at least `bytes_each` bytes each.
  std::size_t count(const char* what, std::size_t bytes_each)
  {
    const std::string_view text = word(what);
    const auto n = parse_integer<std::int64_t>(text);
    if(n < 0 || std::uint64_t(n) > rest().size() / bytes_each + 1)
      refuse(std::string(what) + " is " + in_quotes(text)
             + (n < 0 ? "" : ", but the file is too short for so many"));
    return std::size_t(n);
  }
};

/// Takes binary values of any byte order from the front of some bytes.
class Surface_bytes
{
  const std::string& m_path;
  Text_input m_in;
  bool m_is_swapped;

public:
  enum Byte_order { LITTLE, BIG };

  Surface_bytes(const std::string& path, std::string_view bytes, Byte_order order)
    : m_path(path), m_in(bytes),
#ifdef CGAL_BIG_ENDIAN
      m_is_swapped(order != BIG)
#else
      m_is_swapped(order != LITTLE)
#endif
  {
  }

  std::string_view rest() const { return m_in.rest(); }

  [[noreturn]] void refuse_end() const { internal::refuse(m_path, "is truncated"); }

  void skip(std::size_t n)
  {
    if(n > rest().size())
      refuse_end();
    m_in.skip(n);
  }

  template <class Number>
  Number value()
  {
    char bytes[sizeof(Number)];
    if(rest().size() < sizeof(Number))
      refuse_end();
    std::copy_n(rest().data(), sizeof(Number), bytes);
    m_in.skip(sizeof(Number));
    if(m_is_swapped)
      std::reverse(bytes, bytes + sizeof(Number));
    Number x;
    std::memcpy(&x, bytes, sizeof(Number));
    return x;
  }

  template <class Number>
  Vec3 point()
  {
    Vec3 p;
    for(double& x : p)
      x = double(value<Number>());
    return p;
  }

  /// Refuses the file if there are fewer values of that size.
  void require(std::uint64_t count, std::size_t bytes_each) const
  {
    if(count > rest().size() / bytes_each)
      refuse_end();
  }
};

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_SURFACE_SOUP_H
