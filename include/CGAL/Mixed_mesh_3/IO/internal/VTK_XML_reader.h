// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// VTK's files in XML, as VTK and others write them: values as text, as base64, or appended, raw or
// as base64; compressed by zlib if CGAL_USE_ZLIB is defined (link zlib then).

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_VTK_XML_READER_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_VTK_XML_READER_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/internal/Text_input.h>
#include <CGAL/Mixed_mesh_3/IO/internal/XML_input.h>

#include <CGAL/config.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

/// Reads the arrays of a file of VTK in XML; the readers of the types of data interpret the arrays.
class VTK_XML_reader
{
protected:
  struct Array
  {
    std::string_view section, name; // the name of the element around; all arrays of "Points" have that name
    XML_tag tag;
    std::string_view text;
  };

  struct Piece
  {
    XML_tag tag;
    std::vector<Array> arrays;

    // The first array of a name; null if there is none.
    const Array* array(std::string_view section, std::string_view name) const
    {
      const auto found = std::find_if(arrays.begin(), arrays.end(),
                                      [&](const Array& a) { return a.section == section && a.name == name; });
      return found == arrays.end() ? nullptr : &*found;
    }
  };

private:
  static constexpr std::size_t largest_compression = Encoded_bytes::largest_compression;

  const std::string& m_path;
  const std::string& m_bytes;
  Piece m_file; // arrays that are in no piece
  std::vector<Piece> m_pieces;
  std::size_t m_header_size = 4;
  bool m_is_native = true, m_is_compressed = false, m_is_base64 = false;
  std::string_view m_appended;
  bool m_has_appended = false;
  std::size_t m_bytes_read = 0;

  [[noreturn]] void refuse_array(const Array& array, const std::string& defect) const
  {
    refuse("its array " + in_quotes(array.name) + " " + defect);
  }

  // ---- structure ----------------------------------------------------------------------------

  std::optional<std::string_view> attribute(const XML_tag& tag, std::string_view name) const
  {
    return XML_input(m_path, m_bytes).attribute(tag, name);
  }

  void read_root(const XML_tag& tag, std::string_view expected_type)
  {
    const auto attribute = [&](std::string_view name, std::string_view otherwise) {
      return this->attribute(tag, name).value_or(otherwise);
    };
    const std::string_view type = attribute("type", "");
    if(type != expected_type)
      refuse("holds VTK data of type " + in_quotes(type) + "; expected " + in_quotes(expected_type));
#ifdef CGAL_BIG_ENDIAN
    const std::string_view native = "BigEndian";
#else
    const std::string_view native = "LittleEndian";
#endif
    m_is_native = attribute("byte_order", native) == native;
    const std::string_view header_type = attribute("header_type", "UInt32");
    if(header_type != "UInt32" && header_type != "UInt64")
      refuse("has headers of type " + in_quotes(header_type) + "; expected \"UInt32\" or \"UInt64\"");
    m_header_size = header_type == "UInt32" ? 4 : 8;
    const std::string_view compressor = attribute("compressor", "");
    m_is_compressed = !compressor.empty();
    if(m_is_compressed && compressor != "vtkZLibDataCompressor")
      refuse("is compressed by " + in_quotes(compressor) + "; only \"vtkZLibDataCompressor\" can be read");
#ifndef CGAL_USE_ZLIB
    if(m_is_compressed)
      refuse("is compressed, and cannot be read by a program built without zlib");
#endif
  }

  void read_array(const XML_input& in, const XML_tag& tag, std::string_view section)
  {
    Array array;
    array.section = section;
    array.name = section == "Points" ? section : attribute(tag, "Name").value_or("");
    array.tag = tag;
    if(!tag.is_end)
      array.text = in.text();
    Piece& piece = m_pieces.empty() ? m_file : m_pieces.back();
    piece.arrays.push_back(array);
  }

  void read_appended(const XML_input& in, const XML_tag& tag)
  {
    const std::string_view encoding = attribute(tag, "encoding").value_or("base64");
    if(encoding != "raw" && encoding != "base64")
      refuse("has appended data of the encoding " + in_quotes(encoding));
    m_is_base64 = encoding == "base64";
    const std::string_view bytes = m_bytes;
    const std::size_t begin = bytes.find('_', in.position()), end = bytes.rfind("</AppendedData");
    if(begin == std::string_view::npos || end == std::string_view::npos || end <= begin)
      refuse("is damaged: it has no valid appended data");
    m_appended = bytes.substr(begin + 1, end - begin - 1);
    m_has_appended = true;
  }

  // Checks the end of the file, which is missing wherever the file was cut off.
  void check_end() const
  {
    const std::string_view end = "</VTKFile>", bytes = m_bytes;
    const std::size_t size = bytes.find_last_not_of(" \t\r\n") + 1;
    if(size < end.size() || bytes.substr(size - end.size(), end.size()) != end)
      refuse("is truncated: it does not end with </VTKFile>");
  }

  void read_structure(std::string_view type)
  {
    XML_input in(m_path, m_bytes);
    XML_tag tag;
    std::vector<std::string_view> open; // the names of the elements around
    bool has_root = false;
    while(!m_has_appended && in.next(tag)) {
      if(!has_root) {
        if(!tag.is_start || tag.name != "VTKFile")
          refuse("cannot be read: not an XML file of VTK");
        read_root(tag, type);
        has_root = true;
        check_end();
      } else if(open.empty() || (!tag.is_start && open.back() != tag.name)) {
        refuse("is damaged: no valid XML at the tag " + in_quotes(tag.name));
      } else if(tag.is_start && tag.name == "Piece") {
        number(tag, "NumberOfPoints"); // in every type of data
        m_pieces.push_back({tag, {}});
      } else if(tag.is_start && (tag.name == "DataArray" || tag.name == "Array")) {
        read_array(in, tag, open.back());
      } else if(tag.is_start && tag.name == "AppendedData") {
        read_appended(in, tag);
      }
      if(tag.is_start && !tag.is_end)
        open.push_back(tag.name);
      else if(!tag.is_start)
        open.pop_back();
    }
    if(!has_root)
      refuse("cannot be read: not an XML file of VTK");
    if(!m_has_appended && !open.empty())
      refuse("is truncated: " + in_quotes(open.back()) + " does not end");
  }

  // ---- values -------------------------------------------------------------------------------

  // Calls `f(T())` with the C++ type of an array; false if the type is unknown.
  template <class F>
  static bool with_type(std::string_view type, const F& f)
  {
    const auto call_if = [&](const char* name, auto zero) {
      if(type == name)
        f(zero);
      return type == name;
    };
    return call_if("Float64", double()) || call_if("Float32", float()) || call_if("Int64", std::int64_t())
           || call_if("UInt64", std::uint64_t()) || call_if("Int32", std::int32_t())
           || call_if("UInt32", std::uint32_t()) || call_if("Int16", std::int16_t())
           || call_if("UInt16", std::uint16_t()) || call_if("Int8", std::int8_t())
           || call_if("UInt8", std::uint8_t()) || call_if("String", std::uint8_t());
  }

  std::string_view type_of(const Array& array) const { return attribute(array.tag, "type").value_or(""); }

  std::string_view format_of(const Array& array) const
  {
    const std::string_view format = attribute(array.tag, "format").value_or("ascii");
    if(format != "ascii" && format != "binary" && format != "appended")
      refuse_array(array, "has the format " + in_quotes(format));
    return format;
  }

  std::uint64_t header_word(const Array& array, Encoded_bytes& in) const
  {
    std::uint64_t large = 0;
    std::uint32_t small = 0;
    if(!(m_header_size == 8 ? in.read(&large, 8) : in.read(&small, 4)))
      refuse_array(array, "is truncated");
    return m_header_size == 8 ? large : small;
  }

  void check_size(const Array& array, std::uint64_t size, std::uint64_t expected) const
  {
    if(size != expected)
      refuse_array(array, "has " + std::to_string(size) + " bytes; expected " + std::to_string(expected));
  }

#ifdef CGAL_USE_ZLIB
  template <class T>
  void read_compressed(const Array& array, Encoded_bytes& in, std::size_t count, std::vector<T>& values) const
  {
    const std::uint64_t blocks = header_word(array, in), block_size = header_word(array, in),
                        last_size = header_word(array, in), expected = count * sizeof(T);
    if(blocks > in.largest_size() / m_header_size)
      refuse_array(array, "is truncated");
    if(blocks > 1 && block_size > expected / (blocks - 1))
      refuse_array(array, "has compressed blocks of a wrong size");
    const std::uint64_t last = last_size != 0 ? last_size : block_size;
    check_size(array, blocks == 0 ? 0 : (blocks - 1) * block_size + last, expected);
    std::vector<std::uint64_t> sizes(static_cast<std::size_t>(blocks));
    for(std::uint64_t& size : sizes)
      size = header_word(array, in);
    if(expected / largest_compression > in.largest_size())
      refuse_array(array, "is truncated");
    values.resize(count);
    std::string compressed;
    char* to = reinterpret_cast<char*>(values.data());
    for(std::size_t i = 0; i < sizes.size(); ++i) {
      if(sizes[i] > in.largest_size())
        refuse_array(array, "is truncated");
      compressed.resize(std::size_t(sizes[i]));
      const std::size_t size = std::size_t(i + 1 == sizes.size() ? last : block_size);
      if(!in.read(compressed.data(), compressed.size()) || !decompress(compressed, to, size))
        refuse_array(array, "is damaged: its compressed data are not valid");
      to += size;
    }
  }
#endif

  template <class T>
  std::vector<T> read_binary(const Array& array, std::size_t count)
  {
    if(!m_is_native)
      refuse("is in the byte order of another machine; expected this one's, or text");
    const std::string_view format = format_of(array);
    std::string_view text = array.text;
    if(format == "appended") {
      const std::uint64_t offset = number(array.tag, "offset");
      if(!m_has_appended || offset > m_appended.size())
        refuse_array(array, "is truncated");
      text = m_appended.substr(std::size_t(offset));
    }
    Encoded_bytes in(text, format == "binary" || m_is_base64);
    std::vector<T> values;
#ifdef CGAL_USE_ZLIB
    if(m_is_compressed)
      read_compressed(array, in, count, values);
#endif
    if(!m_is_compressed) {
      check_size(array, header_word(array, in), count * sizeof(T));
      if(count * sizeof(T) > in.largest_size())
        refuse_array(array, "is truncated");
      values.resize(count);
      if(!in.read(values.data(), count * sizeof(T)))
        refuse_array(array, "is damaged: it is no valid base64");
    }
    // The check prevents many arrays from being made of the same bytes.
    m_bytes_read += text.size() - in.encoded_size();
    if(m_bytes_read > m_bytes.size())
      refuse("is damaged: its arrays overlap");
    return values;
  }

  template <class T>
  std::vector<T> read_text(const Array& array, std::size_t count) const
  {
    const auto refuse_count = [&] {
      refuse_array(array, "does not have the " + std::to_string(count) + " values expected");
    };
    if(count > array.text.size() / 2 + 1)
      refuse_count();
    std::vector<T> values(count);
    Text_input in(array.text);
    for(T& value : values) {
      const std::string_view word = in.word();
      if(word.empty())
        refuse_count();
      if(!parse_number(word, value))
        refuse_array(array, "has " + in_quotes(word) + " where a number of type "
                              + std::string(type_of(array)) + " is expected");
    }
    if(!in.word().empty())
      refuse_count();
    return values;
  }

protected:
  VTK_XML_reader(const std::string& path, const std::string& bytes, std::string_view type)
    : m_path(path), m_bytes(bytes)
  {
    read_structure(type);
  }

  [[noreturn]] void refuse(const std::string& defect) const { internal::refuse(m_path, defect); }

  bool has_attribute(const XML_tag& tag, std::string_view name) const
  {
    return attribute(tag, name).has_value();
  }

  const Piece& file() const { return m_file; }
  const std::vector<Piece>& pieces() const { return m_pieces; }

  std::uint64_t number(const XML_tag& tag, std::string_view name) const
  {
    const std::optional<std::string_view> text = attribute(tag, name);
    std::uint64_t n = 0;
    if(!text || !parse_number(Text_input(*text).word(), n))
      refuse("cannot be read: " + std::string(name) + " of <" + std::string(tag.name) + "> is "
             + (text ? in_quotes(*text) : "missing"));
    return n;
  }

  bool has_strings(const Array& array) const { return type_of(array) == "String"; }

  bool has_numbers(const Array& array) const
  {
    return !has_strings(array) && with_type(type_of(array), [](auto) {});
  }

  std::uint64_t number_of_components(const Array& array) const
  {
    return has_attribute(array.tag, "NumberOfComponents") ? number(array.tag, "NumberOfComponents") : 1;
  }

  // The number of bytes of an array of strings; 0 if the strings are compressed, which is not supported.
  std::uint64_t size_of_text(const Array& array) const
  {
    std::uint64_t size = 0;
    if(format_of(array) == "ascii") {
      for(Text_input in(array.text); !in.word().empty();)
        ++size;
      return size;
    }
    if(m_is_compressed)
      return 0;
    std::string_view text = array.text;
    if(format_of(array) == "appended") {
      const std::uint64_t offset = number(array.tag, "offset");
      if(!m_has_appended || offset > m_appended.size())
        refuse_array(array, "is truncated");
      text = m_appended.substr(std::size_t(offset));
    }
    Encoded_bytes in(text, format_of(array) == "binary" || m_is_base64);
    return header_word(array, in);
  }

  // Reads the values of an array. `Value`: double, or std::int64_t for integers only; integers beyond its
  // range become negative.
  template <class Value>
  std::vector<Value> values(const Piece& piece, const char* section, const char* name, std::uint64_t count)
  {
    if(count == 0)
      return {};
    const Array* const array = piece.array(section, name);
    if(array == nullptr)
      refuse("has no array \"" + std::string(name) + "\"");
    const std::uint64_t components = number_of_components(*array);
    if(components != (std::string_view(section) == "Points" ? 3 : 1))
      refuse_array(*array, "has " + std::to_string(components) + " components");
    return values<Value>(*array, count);
  }

  template <class Value>
  std::vector<Value> values(const Array& array, std::uint64_t count)
  {
    if(count > std::uint64_t(m_bytes.size()) * largest_compression)
      refuse_array(array, "would have " + std::to_string(count) + " values, more than fit into the file");
    std::vector<Value> result;
    const bool is_known = with_type(type_of(array), [&](auto zero) {
      using T = decltype(zero);
      if constexpr(std::is_floating_point<T>::value && !std::is_floating_point<Value>::value) {
        refuse_array(array, "has the type " + in_quotes(type_of(array)) + "; expected integers");
      } else {
        std::vector<T> read = format_of(array) == "ascii" ? read_text<T>(array, std::size_t(count))
                                                          : read_binary<T>(array, std::size_t(count));
        if constexpr(std::is_same<T, Value>::value)
          result = std::move(read);
        else
          result.assign(read.begin(), read.end());
      }
    });
    if(!is_known)
      refuse_array(array, "has the unknown type " + in_quotes(type_of(array)));
    return result;
  }
};

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_VTK_XML_READER_H
