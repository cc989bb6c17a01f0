// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A mesh as words, for the readers of plain text formats.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_MESH_WORDS_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_MESH_WORDS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/internal/mesh/Mesh_input.h>
#include <CGAL/Mixed_mesh_3/IO/internal/Text_input.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

/// The words of a text, without comments, which go from `#` to the end of the line.
class Mesh_words
{
  const std::string& m_path;
  Text_input m_in;

public:
  Mesh_words(const std::string& path, std::string_view text) : m_path(path), m_in(text) {}

  [[noreturn]] void refuse(const std::string& defect) const { internal::refuse(m_path, defect); }

  /// The next word.
  std::string_view word()
  {
    m_in.skip_space();
    while(m_in.rest().substr(0, 1) == "#") {
      m_in.skip((std::min)(m_in.rest().find('\n'), m_in.rest().size()));
      m_in.skip_space();
    }
    const std::string_view found = m_in.word();
    if(found.empty())
      refuse("is truncated");
    return found;
  }

  /// Skips words up to one that begins with a letter.
  void skip_numbers()
  {
    const auto is_letter = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); };
    for(Text_input next = m_in; !next.rest().empty(); m_in = next) {
      const std::string_view found = next.word();
      if(!found.empty() && is_letter(found[0]))
        return;
    }
  }

  template <class Number>
  Number number()
  {
    const std::string_view found = word();
    Number result{};
    if(parse_number(found, result))
      return result;
    refuse("is damaged: " + in_quotes(found) + " where "
           + (std::is_integral_v<Number> ? "an integer" : "a number") + " is expected");
  }

  /// A number of items that consist of several numbers each.
  std::size_t count(std::size_t numbers)
  {
    const auto n = number<std::int64_t>();
    if(n < 0 || std::uint64_t(n) > m_in.rest().size() / (2 * numbers) + 1
       || std::uint64_t(n) > largest_mesh_size)
      refuse("is damaged or truncated: a count of " + std::to_string(n));
    return std::size_t(n);
  }

  Mixed_meshes_3::Vec3 point()
  {
    Mixed_meshes_3::Vec3 p{};
    for(double& x : p)
      x = number<double>();
    return p;
  }

  /// The vertices of an element, whose numbers begin with `first`.
  std::array<Vertex_index, 8> vertices(int size, std::int64_t first, std::size_t number_of_vertices)
  {
    std::array<Vertex_index, 8> result{};
    for(int i = 0; i < size; ++i) {
      const auto tag = number<std::int64_t>();
      if(tag < first || std::uint64_t(tag) - std::uint64_t(first) >= number_of_vertices)
        refuse("an element has the vertex " + std::to_string(tag) + ", which does not exist");
      result[std::size_t(i)] = Vertex_index(tag - first);
    }
    return result;
  }

  /// The label of an element: the label of the file, or 1 if that is not a positive integer.
  Element_attributes attributes()
  {
    constexpr double largest = (std::numeric_limits<Subdomain_index>::max)();
    const double label = number<double>();
    Element_attributes result;
    if(label >= 1 && label <= largest && label == double(Subdomain_index(label)))
      result.subdomain_index = Subdomain_index(label);
    return result;
  }
};

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_MESH_WORDS_H
