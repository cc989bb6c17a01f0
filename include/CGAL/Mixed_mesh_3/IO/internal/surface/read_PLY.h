// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// PLY, text and binary, with properties of any type; elements other than vertices and faces are skipped.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_READ_PLY_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_READ_PLY_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/internal/surface/Surface_soup.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

enum class PLY_type { INT8, UINT8, INT16, UINT16, INT32, UINT32, FLOAT32, FLOAT64 };

inline std::optional<PLY_type> ply_type(std::string_view name)
{
  using T = PLY_type;
  static constexpr std::pair<std::string_view, PLY_type> names[] = {
    {"char", T::INT8},   {"uchar", T::UINT8},   {"short", T::INT16},     {"ushort", T::UINT16},
    {"int", T::INT32},   {"uint", T::UINT32},   {"float", T::FLOAT32},   {"double", T::FLOAT64},
    {"int8", T::INT8},   {"uint8", T::UINT8},   {"int16", T::INT16},     {"uint16", T::UINT16},
    {"int32", T::INT32}, {"uint32", T::UINT32}, {"float32", T::FLOAT32}, {"float64", T::FLOAT64}};
  for(const auto& [of, type] : names)
    if(of == name)
      return type;
  return std::nullopt;
}

inline std::size_t size_of(PLY_type type)
{
  static constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[std::size_t(type)];
}

struct PLY_property
{
  std::string_view name;
  PLY_type type;
  std::optional<PLY_type> count_type; // type of the length of a list
};

struct PLY_element
{
  std::string_view name;
  std::size_t count;
  std::vector<PLY_property> properties;
};

/// Values one after another; the values of all types are doubles, too.
class PLY_text_input
{
  Surface_text& m_in;

public:
  explicit PLY_text_input(Surface_text& in) : m_in(in) {}
  double value(PLY_type) { return m_in.parse_coordinate(m_in.word("a value")); }
  double coordinate(PLY_type type, std::size_t vertex) { return m_in.finite_coordinate(value(type), vertex); }
  std::size_t largest_count(PLY_type) const { return m_in.rest().size() / 2 + 1; }
};

class PLY_binary_input
{
  Surface_bytes m_in;

public:
  explicit PLY_binary_input(const Surface_bytes& in) : m_in(in) {}

  double value(PLY_type type)
  {
    switch(type) {
    case PLY_type::INT8: return m_in.value<std::int8_t>();
    case PLY_type::UINT8: return m_in.value<std::uint8_t>();
    case PLY_type::INT16: return m_in.value<std::int16_t>();
    case PLY_type::UINT16: return m_in.value<std::uint16_t>();
    case PLY_type::INT32: return m_in.value<std::int32_t>();
    case PLY_type::UINT32: return m_in.value<std::uint32_t>();
    case PLY_type::FLOAT32: return double(m_in.value<float>());
    case PLY_type::FLOAT64: return m_in.value<double>();
    }
    return 0;
  }

  double coordinate(PLY_type type, std::size_t) { return value(type); } // there are no lines to name
  std::size_t largest_count(PLY_type type) const { return m_in.rest().size() / size_of(type); }
};

class PLY_reader
{
  const std::string& m_path;
  const std::string& m_bytes;
  std::string_view m_format;
  std::vector<PLY_element> m_elements;
  Surface_soup m_soup;

  [[noreturn]] void refuse(const std::string& defect) const { internal::refuse(m_path, defect); }

  static PLY_type type_of(std::string_view name, const Surface_text& in)
  {
    const std::optional<PLY_type> type = ply_type(name);
    if(!type)
      in.refuse("unknown type " + in_quotes(name));
    return *type;
  }

  void read_property(Surface_text& in)
  {
    if(m_elements.empty())
      in.refuse("a property is of no element");
    const char* const expected = "the type of a property";
    PLY_property property;
    std::string_view type = in.word(expected);
    if(type == "list") {
      property.count_type = type_of(in.word(expected), in);
      type = in.word(expected);
    }
    property.type = type_of(type, in);
    property.name = in.word("the name of a property");
    m_elements.back().properties.push_back(property);
  }

  void read_header(Surface_text& in)
  {
    if(in.word_or_end() != "ply")
      refuse("cannot be read: it does not start with ply");
    in.rest_of_line();
    while(true) {
      const std::string_view key = in.word("end_header");
      if(key == "end_header")
        break;
      if(key == "format") {
        m_format = in.word("the format");
      } else if(key == "element") {
        const std::string_view name = in.word("the name of an element");
        m_elements.push_back({name, in.count("the number of elements", 1), {}});
      } else if(key == "property") {
        read_property(in);
      } else if(key == "comment" || key == "obj_info") {
        m_soup.comments.append(Surface_text(in).rest_of_line()) += '\n';
      } else {
        in.refuse("unknown keyword " + in_quotes(key));
      }
      in.rest_of_line();
    }
    in.rest_of_line();
  }

  template <class Input>
  std::size_t count(Input& in, const PLY_property& property) const
  {
    const double n = in.value(*property.count_type);
    if(!(n >= 0 && n <= double(in.largest_count(property.type)) && n == std::floor(n)))
      refuse("a list " + in_quotes(property.name) + " has a size that does not fit into the file");
    return std::size_t(n);
  }

  template <class Input>
  void skip(Input& in, const PLY_property& property) const
  {
    for(std::size_t n = property.count_type ? count(in, property) : 1; n > 0; --n)
      in.value(property.type);
  }

  template <class Input>
  void read_vertices(Input& in, const PLY_element& element)
  {
    bool has[3] = {false, false, false};
    for(std::size_t i = 0; i < element.count; ++i) {
      Vec3 p{};
      for(const PLY_property& property : element.properties) {
        const std::size_t k = property.name.size() == 1 ? std::string_view("xyz").find(property.name) : 3;
        if(k >= 3 || property.count_type) {
          skip(in, property);
        } else {
          p[k] = in.coordinate(property.type, i);
          has[k] = true;
        }
      }
      if(!(has[0] && has[1] && has[2]))
        refuse("its vertices have no properties x, y and z");
      m_soup.points.push_back(p);
    }
  }

  template <class Input>
  void read_faces(Input& in, const PLY_element& element)
  {
    for(std::size_t i = 0; i < element.count; ++i) {
      bool has_vertices = false;
      for(const PLY_property& property : element.properties) {
        if(!property.count_type || (property.name != "vertex_indices" && property.name != "vertex_index")) {
          skip(in, property);
          continue;
        }
        std::vector<std::size_t> polygon(count(in, property));
        for(std::size_t& v : polygon) {
          const double x = in.value(property.type);
          v = x == std::floor(x) ? vertex_index(x) : no_vertex;
        }
        m_soup.polygons.push_back(std::move(polygon));
        has_vertices = true;
      }
      if(!has_vertices)
        refuse("its faces have no list vertex_indices");
    }
  }

  template <class Input>
  void read_elements(Input in)
  {
    for(const PLY_element& element : m_elements) {
      if(element.properties.empty())
        continue;
      if(element.name == "vertex")
        read_vertices(in, element);
      else if(element.name == "face")
        read_faces(in, element);
      else
        for(std::size_t i = 0; i < element.count; ++i)
          for(const PLY_property& property : element.properties)
            skip(in, property);
    }
  }

public:
  PLY_reader(const std::string& path, const std::string& bytes) : m_path(path), m_bytes(bytes) {}

  Surface_soup read()
  {
    Surface_text in(m_path, m_bytes);
    read_header(in);
    if(m_format == "ascii")
      read_elements(PLY_text_input(in));
    else if(m_format == "binary_little_endian")
      read_elements(PLY_binary_input({m_path, in.rest(), Surface_bytes::LITTLE}));
    else if(m_format == "binary_big_endian")
      read_elements(PLY_binary_input({m_path, in.rest(), Surface_bytes::BIG}));
    else
      refuse("has the unknown format " + in_quotes(m_format));
    return std::move(m_soup);
  }
};

inline Surface_soup read_PLY(const std::string& path, const std::string& bytes)
{
  return PLY_reader(path, bytes).read();
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_READ_PLY_H
