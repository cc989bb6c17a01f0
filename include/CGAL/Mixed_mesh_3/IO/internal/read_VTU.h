// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// VTK unstructured grids in XML, as VTK and others write them: values as text, as base64, or appended, raw or
// as base64; compressed by zlib if CGAL_USE_ZLIB is defined (link zlib then).

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_READ_VTU_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_READ_VTU_H

#include <CGAL/Mixed_mesh_3/IO/internal/Mesh_input.h>
#include <CGAL/Mixed_mesh_3/IO/internal/element_names.h>

#include <CGAL/config.h>

#ifdef CGAL_USE_ZLIB
#include <zlib.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

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

// As much of XML as VTK uses. Characters written as entities are left as they are.
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

  // The text between the last tag and the next.
  std::string_view text() const
  {
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

// The bytes of binary values. VTK ends the base64 of a header and starts anew for the values, others go on:
// both can be read, as padding just makes four characters give fewer bytes.
class Encoded_bytes
{
  std::string_view m_text;
  bool m_is_base64;
  unsigned char m_decoded[3] = {};
  int m_begin = 0, m_end = 0; // of the decoded bytes not taken yet

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
  Encoded_bytes(std::string_view text, bool is_base64) : m_text(text), m_is_base64(is_base64) {}

  std::size_t encoded_size() const { return m_text.size(); }

  // There are not more bytes than that.
  std::size_t largest_size() const
  {
    return m_is_base64 ? m_text.size() / 4 * 3 + std::size_t(m_end - m_begin) : m_text.size();
  }

  // Whether there were so many bytes.
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

class VTU_reader
{
  struct Array
  {
    std::string_view name, type, format, text;
    std::uint64_t offset = 0, number_of_components = 1;
  };

  struct Piece
  {
    std::uint64_t number_of_points = 0, number_of_cells = 0;
    std::optional<Array> points, connectivity, offsets, types, in_region, subdomain;
  };

  // Deflate shrinks to no less than that.
  static constexpr std::size_t largest_compression = 1032;

  const std::string& m_path;
  const std::string& m_bytes;
  std::vector<Piece> m_pieces;
  std::size_t m_header_size = 4;
  bool m_is_native = true, m_is_compressed = false, m_is_base64 = false;
  std::string_view m_appended;
  bool m_has_appended = false;
  std::size_t m_bytes_read = 0;

  [[noreturn]] void refuse(const std::string& defect) const { internal::refuse(m_path, defect); }

  [[noreturn]] void refuse_array(const Array& array, const std::string& defect) const
  {
    refuse("its array " + in_quotes(array.name) + " " + defect);
  }

  // ---- structure ----------------------------------------------------------------------------

  std::uint64_t number(const XML_input& in, const XML_tag& tag, std::string_view name) const
  {
    const std::optional<std::string_view> text = in.attribute(tag, name);
    std::uint64_t n = 0;
    if(!text || !parse_number(Text_input(*text).word(), n))
      refuse("cannot be read: " + std::string(name) + " of <" + std::string(tag.name) + "> is "
             + (text ? in_quotes(*text) : "missing"));
    return n;
  }

  void read_root(const XML_input& in, const XML_tag& tag)
  {
    const auto attribute = [&](std::string_view name, std::string_view otherwise) {
      return in.attribute(tag, name).value_or(otherwise);
    };
    const std::string_view type = attribute("type", "");
    if(type != "UnstructuredGrid")
      refuse("holds VTK data of type " + in_quotes(type) + "; expected \"UnstructuredGrid\"");
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
    array.name = in.attribute(tag, "Name").value_or("");
    Piece& piece = m_pieces.back();
    if(section == "Points")
      array.name = "Points"; // whatever it is called
    std::optional<Array>* place = nullptr;
    for(const auto& [of, name, member] : {std::make_tuple("Points", "Points", &Piece::points),
                                          std::make_tuple("Cells", "connectivity", &Piece::connectivity),
                                          std::make_tuple("Cells", "offsets", &Piece::offsets),
                                          std::make_tuple("Cells", "types", &Piece::types),
                                          std::make_tuple("CellData", "in_region", &Piece::in_region),
                                          std::make_tuple("CellData", "subdomain", &Piece::subdomain)})
      if(section == of && array.name == name)
        place = &(piece.*member);
    if(place == nullptr || *place)
      return;
    array.type = in.attribute(tag, "type").value_or("");
    array.format = in.attribute(tag, "format").value_or("ascii");
    if(in.attribute(tag, "NumberOfComponents"))
      array.number_of_components = number(in, tag, "NumberOfComponents");
    if(array.format == "appended")
      array.offset = number(in, tag, "offset");
    else if(array.format != "ascii" && array.format != "binary")
      refuse_array(array, "has the format " + in_quotes(array.format));
    if(array.number_of_components != (section == "Points" ? 3 : 1))
      refuse_array(array, "has " + std::to_string(array.number_of_components) + " components");
    if(!tag.is_end)
      array.text = in.text();
    *place = array;
  }

  void read_appended(const XML_input& in, const XML_tag& tag)
  {
    const std::string_view encoding = in.attribute(tag, "encoding").value_or("base64");
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

  // Wherever a file was cut off, that is missing.
  void check_end() const
  {
    const std::string_view end = "</VTKFile>", bytes = m_bytes;
    const std::size_t size = bytes.find_last_not_of(" \t\r\n") + 1;
    if(size < end.size() || bytes.substr(size - end.size(), end.size()) != end)
      refuse("is truncated: it does not end with </VTKFile>");
  }

  void read_structure()
  {
    XML_input in(m_path, m_bytes);
    XML_tag tag;
    std::vector<std::string_view> open; // the names of the elements around
    bool has_root = false;
    while(!m_has_appended && in.next(tag)) {
      if(!has_root) {
        if(!tag.is_start || tag.name != "VTKFile")
          refuse("cannot be read: not an XML file of VTK");
        read_root(in, tag);
        has_root = true;
        check_end();
      } else if(open.empty() || (!tag.is_start && open.back() != tag.name)) {
        refuse("is damaged: no valid XML at the tag " + in_quotes(tag.name));
      } else if(tag.is_start && tag.name == "Piece") {
        m_pieces.push_back({});
        m_pieces.back().number_of_points = number(in, tag, "NumberOfPoints");
        m_pieces.back().number_of_cells = number(in, tag, "NumberOfCells");
      } else if(tag.is_start && tag.name == "DataArray" && !m_pieces.empty()) {
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
           || call_if("UInt8", std::uint8_t());
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
    std::vector<char> compressed;
    Bytef* to = reinterpret_cast<Bytef*>(values.data());
    for(std::size_t i = 0; i < sizes.size(); ++i) {
      if(sizes[i] > in.largest_size())
        refuse_array(array, "is truncated");
      compressed.resize(std::size_t(sizes[i]));
      const uLong size = uLong(i + 1 == sizes.size() ? last : block_size);
      uLongf found = size;
      const Bytef* const from = reinterpret_cast<const Bytef*>(compressed.data());
      if(!in.read(compressed.data(), compressed.size())
         || uncompress(to, &found, from, uLong(compressed.size())) != Z_OK || found != size)
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
    std::string_view text = array.text;
    if(array.format == "appended") {
      if(!m_has_appended || array.offset > m_appended.size())
        refuse_array(array, "is truncated");
      text = m_appended.substr(std::size_t(array.offset));
    }
    Encoded_bytes in(text, array.format == "binary" || m_is_base64);
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
    // So that many arrays cannot be made of the same bytes.
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
        refuse_array(array, "has " + in_quotes(word) + " where a number of type " + std::string(array.type)
                              + " is expected");
    }
    if(!in.word().empty())
      refuse_count();
    return values;
  }

  // `Value`: double, or std::int64_t for integers only; those beyond its range become negative.
  template <class Value>
  std::vector<Value> values(const std::optional<Array>& array, const char* name, std::uint64_t count)
  {
    if(count == 0)
      return {};
    if(!array)
      refuse("has no array \"" + std::string(name) + "\"");
    if(count > std::uint64_t(m_bytes.size()) * largest_compression)
      refuse_array(*array, "would have " + std::to_string(count) + " values, more than fit into the file");
    std::vector<Value> result;
    const bool is_known = with_type(array->type, [&](auto zero) {
      using T = decltype(zero);
      if constexpr(std::is_floating_point<T>::value && !std::is_floating_point<Value>::value) {
        refuse_array(*array, "has the type " + in_quotes(array->type) + "; expected integers");
      } else {
        std::vector<T> read = array->format == "ascii" ? read_text<T>(*array, std::size_t(count))
                                                       : read_binary<T>(*array, std::size_t(count));
        if constexpr(std::is_same<T, Value>::value)
          result = std::move(read);
        else
          result.assign(read.begin(), read.end());
      }
    });
    if(!is_known)
      refuse_array(*array, "has the unknown type " + in_quotes(array->type));
    return result;
  }

  // ---- cells --------------------------------------------------------------------------------

  // How VTK numbers a cell: `order` as `Element_names::vtk_order`.
  struct Cell_type
  {
    Element_kind kind;
    const std::uint8_t* order;
  };

  // Nothing for cells that are on the boundary or on edges.
  std::optional<Cell_type> cell_type(std::int64_t type, std::size_t cell) const
  {
    static constexpr std::uint8_t voxel_order[8] = {0, 1, 3, 2, 4, 5, 7, 6};
    constexpr int voxel = 11, last_of_low_dimension = 9;
    for(Element_kind kind : element_kinds)
      if(element_names[kind].vtk_type == type)
        return Cell_type{kind, element_names[kind].vtk_order};
    if(type == voxel)
      return Cell_type{HEXAHEDRON, voxel_order};
    if(type < 0 || type > last_of_low_dimension) {
      const bool is_of_higher_order = (type >= 21 && type <= 37) || (type >= 60 && type <= 81);
      refuse("cell " + std::to_string(cell) + (is_of_higher_order ? " is of higher order" : " cannot be read")
             + " (VTK's type " + std::to_string(type)
             + "); expected linear hexahedra, wedges, pyramids and tetrahedra");
    }
    return std::nullopt;
  }

  void read_piece(const Piece& piece, Mesh_input& mesh)
  {
    const std::uint64_t n = piece.number_of_points, m = piece.number_of_cells,
                        first = mesh.points.size(); // points of the pieces before
    if(n > largest_mesh_size - first || m > largest_mesh_size - mesh.elements.size())
      refuse("has more than 2^32 points or cells");
    const std::vector<double> coordinates = values<double>(piece.points, "Points", 3 * n);
    const std::vector<std::int64_t> offsets = values<std::int64_t>(piece.offsets, "offsets", m),
                                    types = values<std::int64_t>(piece.types, "types", m);
    const std::int64_t size = offsets.empty() ? 0 : offsets.back();
    if(size < 0)
      refuse("its array \"offsets\" is not increasing");
    const std::vector<std::int64_t> connectivity = values<std::int64_t>(piece.connectivity, "connectivity",
                                                                        std::uint64_t(size));
    const auto cell_data = [&](const std::optional<Array>& array, const char* name) {
      return array ? values<double>(array, name, m) : std::vector<double>();
    };
    const std::vector<double> in_region = cell_data(piece.in_region, "in_region"),
                              subdomain = cell_data(piece.subdomain, "subdomain");

    for(std::size_t v = 0; v < n; ++v)
      mesh.points.push_back({coordinates[3 * v], coordinates[3 * v + 1], coordinates[3 * v + 2]});
    std::int64_t begin = 0;
    for(std::size_t e = 0; e < m; ++e) {
      const std::int64_t end = offsets[e];
      if(end < begin || end > size)
        refuse("its array \"offsets\" is not increasing");
      for(std::int64_t i = begin; i < end; ++i) {
        const std::int64_t v = connectivity[std::size_t(i)];
        if(v < 0 || std::uint64_t(v) >= n)
          refuse("cell " + std::to_string(e) + " has the point " + std::to_string(v)
                 + ", which does not exist");
      }
      if(const std::optional<Cell_type> type = cell_type(types[e], e)) {
        const std::int64_t expected = reference_elements[type->kind].number_of_vertices;
        if(end - begin != expected)
          refuse("cell " + std::to_string(e) + " has " + std::to_string(end - begin) + " points; expected "
                 + std::to_string(expected));
        std::array<Vertex_index, 8> vertices{};
        for(std::int64_t i = 0; i < expected; ++i)
          vertices[type->order[i]] = Vertex_index(first
                                                  + std::uint64_t(connectivity[std::size_t(begin + i)]));
        mesh.elements.add(type->kind, vertices.data());
        Element_attributes attributes;
        attributes.is_in_region = !in_region.empty() && in_region[e] != 0;
        if(!subdomain.empty()) {
          constexpr double largest = (std::numeric_limits<Subdomain_index>::max)();
          if(!(subdomain[e] >= 1 && subdomain[e] <= largest && subdomain[e] == std::floor(subdomain[e])))
            refuse("cell " + std::to_string(e) + " has a \"subdomain\" that is not a positive integer");
          attributes.subdomain_index = Subdomain_index(subdomain[e]);
        }
        mesh.attributes.push_back(attributes);
      }
      begin = end;
    }
  }

public:
  VTU_reader(const std::string& path, const std::string& bytes) : m_path(path), m_bytes(bytes) {}

  Mesh_input read()
  {
    read_structure();
    Mesh_input mesh;
    for(const Piece& piece : m_pieces)
      read_piece(piece, mesh);
    return mesh;
  }
};

/// Reads what a `.vtu` file holds. Points and cells keep their order, cells of lower dimension are skipped.
inline Mesh_input read_VTU(const std::string& path, const std::string& bytes)
{
  return VTU_reader(path, bytes).read();
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_READ_VTU_H
