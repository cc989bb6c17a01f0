// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The bytes of a file, and the words and numbers in them.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_TEXT_INPUT_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_TEXT_INPUT_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/internal/errors.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <ios>
#include <string>
#include <string_view>
#include <system_error>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

// Vertices and elements are counted in 32 bits, with one value to spare.
constexpr std::uint64_t largest_mesh_size = 0xfffffffe;

/// A part of a file for a message: short, and on one line.
inline std::string in_quotes(std::string_view text)
{
  // The length shows every number whole: a double has up to 24 characters, as in -2.2250738585072014e-308.
  constexpr std::size_t longest = 32;
  std::string result = "\"";
  for(char c : text.substr(0, longest))
    result += c >= ' ' && c <= '~' ? c : '?';
  return result + (text.size() > longest ? "...\"" : "\"");
}

/// The bytes of a file, or its first bytes.
inline std::string read_bytes(const std::string& path, std::uintmax_t largest = UINTMAX_MAX)
{
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if(fs::is_directory(status))
    refuse(path, "is a directory");
  if(fs::exists(status) && !fs::is_regular_file(status)) // a pipe or device may never end
    refuse(path, "is not a regular file");
  errno = 0;
  std::ifstream in(path, std::ios_base::binary);
  if(!in)
    refuse(path, std::string("cannot be opened: ") + std::strerror(errno));
  const std::uintmax_t size_of_file = fs::file_size(path, error), size = (std::min)(size_of_file, largest);
  if(error)
    refuse(path, "cannot be read: " + error.message());
  if(size == 0)
    refuse(path, "is empty");
  std::string bytes(std::size_t(size), '\0');
  in.read(bytes.data(), std::streamsize(size));
  if(std::uintmax_t(in.gcount()) != size)
    refuse(path, "cannot be read to its end");
  return bytes;
}

inline bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// Parses a number that is a whole word, in every locale, and not beyond the range of its type.
template <class Number>
bool parse_number(std::string_view word, Number& number)
{
  if(word.size() > 1 && word[0] == '+' && word[1] != '-')
    word.remove_prefix(1);
  const char* const end = word.data() + word.size();
  const std::from_chars_result result = std::from_chars(word.data(), end, number);
  return result.ec == std::errc() && result.ptr == end;
}

/// Takes words and binary values from the front of a text.
class Text_input
{
  std::string_view m_text;

public:
  explicit Text_input(std::string_view text) : m_text(text) {}

  /// The part of the text that has not been taken yet.
  std::string_view rest() const { return m_text; }

  void skip(std::size_t n) { m_text.remove_prefix(n); }

  void skip_space()
  {
    std::size_t n = 0;
    while(n < m_text.size() && is_space(m_text[n]))
      ++n;
    skip(n);
  }

  /// Skips the rest of a line; false if the rest is more than space.
  bool skip_end_of_line()
  {
    std::size_t n = 0;
    while(n < m_text.size() && is_space(m_text[n]) && m_text[n] != '\n')
      ++n;
    const bool is_end = n < m_text.size() && m_text[n] == '\n';
    skip(n + is_end);
    return is_end;
  }

  /// The next word, after space; empty at the end.
  std::string_view word()
  {
    skip_space();
    std::size_t n = 0;
    while(n < m_text.size() && !is_space(m_text[n]))
      ++n;
    const std::string_view result = m_text.substr(0, n);
    skip(n);
    return result;
  }

  /// Takes the next bytes as they are in memory; false if there are not enough bytes.
  template <class Value>
  bool binary(Value& value)
  {
    if(m_text.size() < sizeof(Value))
      return false;
    std::memcpy(&value, m_text.data(), sizeof(Value));
    skip(sizeof(Value));
    return true;
  }
};

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_TEXT_INPUT_H
