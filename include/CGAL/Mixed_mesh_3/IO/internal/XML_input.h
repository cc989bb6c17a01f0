// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Parser that readers of XML share: tags, text, and bytes as base64, also
// compressed by zlib if CGAL_USE_ZLIB is defined (link zlib then).

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_XML_INPUT_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_XML_INPUT_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/internal/Text_input.h>

#include <CGAL/config.h>

#ifdef CGAL_USE_ZLIB
#include <zlib.h>
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

struct XML_tag
{
  std::string_view name;
  std::string_view attributes;
  bool is_start = false, is_end = false; // both for <name/>
};

// The text of an attribute: the inverse of `escaped_for_XML()`.
inline std::string unescaped_from_XML(std::string_view text)
{
  constexpr std::pair<std::string_view, char> entities[] = {
    {"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}};
  std::string result;
  while(!text.empty()) {
    const auto entity = std::find_if(std::begin(entities), std::end(entities), [text](const auto& e) {
      return text.substr(0, e.first.size()) == e.first;
    });
    const bool is_entity = entity != std::end(entities);
    result += is_entity ? entity->second : text.front();
    text.remove_prefix(is_entity ? entity->first.size() : 1);
  }
  return result;
}

// Reader of the part of XML that VTK and GIFTI use. Characters written as entities are left as they are.
class XML_input
{
  const std::string& m_path;
  std::string_view m_text;
  std::size_t m_position = 0;

  [[noreturn]] void refuse_tag(std::size_t begin) const
  {
    internal::refuse(m_path, "is damaged: no valid XML at " + in_quotes(m_text.substr(begin)));
  }

  // The position after `end`.
  std::size_t after(std::string_view end, std::size_t begin) const
  {
    const std::size_t position = m_text.find(end, begin);
    if(position == std::string_view::npos)
      refuse_tag(begin);
    return position + end.size();
  }

public:
  XML_input(const std::string& path, std::string_view text) : m_path(path), m_text(text) {}

  std::size_t position() const { return m_position; } // after the last tag

  // The text between the last tag and the next one, or the text of a section CDATA in between.
  std::string_view text() const
  {
    const std::string_view cdata = "<![CDATA[";
    const std::size_t begin = (std::min)(m_text.find_first_not_of(" \t\r\n", m_position), m_text.size());
    if(m_text.compare(begin, cdata.size(), cdata) == 0) {
      const std::size_t from = begin + cdata.size();
      return m_text.substr(from, after("]]>", from) - 3 - from);
    }
    return m_text.substr(m_position, (std::min)(m_text.find('<', m_position), m_text.size()) - m_position);
  }

  // Whether there is another tag.
  bool next(XML_tag& tag)
  {
    while(true) {
      const std::size_t begin = m_text.find('<', m_position);
      if(begin == std::string_view::npos)
        return false;
      if(m_text.compare(begin, 4, "<!--") == 0) {
        m_position = after("-->", begin + 4);
      } else if(m_text.compare(begin, 9, "<![CDATA[") == 0) {
        m_position = after("]]>", begin + 9);
      } else if(m_text.compare(begin, 2, "<?") == 0) {
        m_position = after("?>", begin + 2);
      } else if(m_text.compare(begin, 2, "<!") == 0) {
        m_position = after(">", begin + 2);
      } else {
        std::size_t i = begin + 1;
        char quote = 0;
        while(i < m_text.size() && (quote != 0 || m_text[i] != '>')) {
          if(quote == 0 && (m_text[i] == '"' || m_text[i] == '\''))
            quote = m_text[i];
          else if(quote == m_text[i])
            quote = 0;
          ++i;
        }
        if(i == m_text.size())
          refuse_tag(begin);
        std::string_view inside = m_text.substr(begin + 1, i - begin - 1);
        m_position = i + 1;
        tag.is_start = inside.empty() || inside.front() != '/';
        tag.is_end = !tag.is_start || inside.back() == '/';
        if(tag.is_end && !inside.empty())
          tag.is_start ? inside.remove_suffix(1) : inside.remove_prefix(1);
        std::size_t n = 0;
        while(n < inside.size() && !is_space(inside[n]))
          ++n;
        if(n == 0)
          refuse_tag(begin);
        tag.name = inside.substr(0, n);
        tag.attributes = inside.substr(n);
        return true;
      }
    }
  }

  // The value of an attribute.
  std::optional<std::string_view> attribute(const XML_tag& tag, std::string_view name) const
  {
    Text_input in(tag.attributes);
    for(in.skip_space(); !in.rest().empty(); in.skip_space()) {
      std::string_view rest = in.rest();
      const std::size_t equals = rest.find('=');
      std::string_view found = rest.substr(0, equals);
      while(!found.empty() && is_space(found.back()))
        found.remove_suffix(1);
      in.skip(equals == std::string_view::npos ? rest.size() : equals + 1);
      in.skip_space();
      rest = in.rest();
      const std::size_t end = rest.empty() || (rest[0] != '"' && rest[0] != '\'') ? std::string_view::npos
                                                                                  : rest.find(rest[0], 1);
      if(end == std::string_view::npos)
        internal::refuse(m_path, "is damaged: no valid attributes of " + in_quotes(tag.name));
      if(found == name)
        return rest.substr(1, end - 1);
      in.skip(end + 1);
    }
    return std::nullopt;
  }
};

// The bytes of binary values. VTK ends the base64 of a header and starts anew for the values, other programs
// do not: both can be read, as four characters with padding just give fewer bytes.
class Encoded_bytes
{
  std::string_view m_text;
  bool m_is_base64;
  unsigned char m_decoded[3] = {};
  int m_begin = 0, m_end = 0; // range of the decoded bytes not taken yet

  static int base64_digit(char c)
  {
    return c >= 'A' && c <= 'Z'   ? c - 'A'
           : c >= 'a' && c <= 'z' ? c - 'a' + 26
           : c >= '0' && c <= '9' ? c - '0' + 52
           : c == '+'             ? 62
           : c == '/'             ? 63
                                  : -1;
  }

  bool decode()
  {
    std::uint32_t bits = 0;
    int padding = 0;
    std::size_t i = 0;
    for(int digits = 0; digits < 4; ++i) {
      if(i == m_text.size())
        return false;
      if(is_space(m_text[i]))
        continue;
      const bool is_padding = m_text[i] == '=' && digits >= 2;
      const int digit = is_padding ? 0 : base64_digit(m_text[i]);
      if(digit < 0 || (padding != 0 && !is_padding))
        return false;
      padding += is_padding;
      bits = bits << 6 | std::uint32_t(digit);
      ++digits;
    }
    m_text.remove_prefix(i);
    for(int k = 0; k < 3; ++k)
      m_decoded[k] = static_cast<unsigned char>(bits >> (16 - 8 * k));
    m_begin = 0;
    m_end = 3 - padding;
    return true;
  }

public:
  // The largest compression of deflate (RFC 1951): a match has up to 258 bytes, and takes two bits at least,
  // one for its length and one for its distance; 258 * 8 / 2 = 1032.
  static constexpr std::size_t largest_compression = 1032;

  Encoded_bytes(std::string_view text, bool is_base64) : m_text(text), m_is_base64(is_base64) {}

  std::size_t encoded_size() const { return m_text.size(); }

  // An upper bound of the number of bytes.
  std::size_t largest_size() const
  {
    return m_is_base64 ? m_text.size() / 4 * 3 + std::size_t(m_end - m_begin) : m_text.size();
  }

  // The rest of the bytes; nothing if they are not valid.
  std::optional<std::string> rest()
  {
    std::string bytes;
    bytes.reserve(largest_size());
    while(!Text_input(m_text).word().empty()) {
      if(!decode())
        return std::nullopt;
      bytes.append(reinterpret_cast<const char*>(m_decoded), std::size_t(m_end));
      m_begin = m_end;
    }
    return bytes;
  }

  // Reads bytes. Returns whether there were enough bytes.
  bool read(void* bytes, std::size_t size)
  {
    if(size > largest_size())
      return false;
    if(!m_is_base64) {
      if(size != 0)
        std::memcpy(bytes, m_text.data(), size);
      m_text.remove_prefix(size);
      return true;
    }
    for(char* p = static_cast<char*>(bytes); size != 0; --size) {
      if(m_begin == m_end && !decode())
        return false;
      *p++ = char(m_decoded[m_begin++]);
    }
    return true;
  }
};

#ifdef CGAL_USE_ZLIB
/// Decompresses data of zlib that have a known size. \return whether they are valid, and have the size
inline bool decompress(std::string_view compressed, void* bytes, std::size_t size)
{
  uLongf found = uLongf(size);
  return uncompress(static_cast<Bytef*>(bytes), &found, reinterpret_cast<const Bytef*>(compressed.data()),
                    uLong(compressed.size()))
           == Z_OK
         && found == size;
}
#endif

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_XML_INPUT_H
