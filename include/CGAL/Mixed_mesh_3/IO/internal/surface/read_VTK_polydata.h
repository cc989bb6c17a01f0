// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// VTK polygonal data in the legacy format, text and binary, versions up to 5.1: polygons and strips of
// triangles; vertices, lines and data are skipped.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_READ_VTK_POLYDATA_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_READ_VTK_POLYDATA_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/internal/surface/Surface_soup.h>

#include <cctype>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

class VTK_polydata_reader
{
  const std::string& m_path;
  Surface_text m_in;
  bool m_is_binary = false;
  Surface_soup m_soup;

  [[noreturn]] void refuse(const std::string& defect) const { internal::refuse(m_path, defect); }

  std::string upper_word()
  {
    std::string word(m_in.word_or_end());
    for(char& c : word)
      c = char(std::toupper(static_cast<unsigned char>(c)));
    return word;
  }

  // Calls `f(T())` with the C++ type of a name.
  template <class F>
  void with_type(std::string_view name, const F& f) const
  {
    if(name == "float")
      f(float());
    else if(name == "double")
      f(double());
    else if(name == "char" || name == "signed_char")
      f(std::int8_t());
    else if(name == "unsigned_char")
      f(std::uint8_t());
    else if(name == "short")
      f(std::int16_t());
    else if(name == "unsigned_short")
      f(std::uint16_t());
    else if(name == "int" || name == "vtkIdType" || name == "vtktypeint32")
      f(std::int32_t());
    else if(name == "unsigned_int")
      f(std::uint32_t());
    else if(name == "long" || name == "long_long" || name == "vtktypeint64")
      f(std::int64_t());
    else if(name == "unsigned_long" || name == "vtktypeuint64")
      f(std::uint64_t());
    else
      m_in.refuse("unknown type " + in_quotes(name));
  }

  // The values after the line that announces the values; `Value`: double or std::int64_t.
  template <class Value>
  std::vector<Value> values(std::string_view type, std::size_t count)
  {
    std::vector<Value> result;
    m_in.rest_of_line();
    with_type(type, [&](auto zero) {
      using T = decltype(zero);
      if(std::is_floating_point<T>::value && !std::is_floating_point<Value>::value)
        m_in.refuse("expected integers, not " + in_quotes(type));
      Surface_bytes bytes(m_path, m_in.rest(), Surface_bytes::BIG);
      if(m_is_binary)
        bytes.require(count, sizeof(T));
      result.resize(count);
      for(Value& value : result) {
        if(m_is_binary)
          value = Value(bytes.template value<T>());
        else if constexpr(std::is_floating_point<Value>::value)
          value = m_in.coordinate();
        else
          value = m_in.parse_integer<Value>(m_in.word("an integer"));
      }
      if(m_is_binary)
        m_in.skip(m_in.rest().size() - bytes.rest().size());
    });
    return result;
  }

  void read_points()
  {
    const std::size_t n = m_in.count("the number of points", 6);
    const std::string_view type = m_in.word("the type of points");
    if(!m_is_binary) { // for messages that name the line
      with_type(type, [](auto) {});
      m_in.rest_of_line();
      for(std::size_t v = 0; v < n; ++v)
        m_soup.points.push_back(m_in.point(v));
      return;
    }
    const std::vector<double> x = values<double>(type, 3 * n);
    for(std::size_t v = 0; v < n; ++v)
      m_soup.points.push_back({x[3 * v], x[3 * v + 1], x[3 * v + 2]});
  }

  // Calls `add(begin, size)` with the vertices of each cell.
  template <class Add>
  void read_cells(const Add& add)
  {
    const std::size_t n = m_in.count("the number of cells", 1), size = m_in.count("the size of cells", 1);
    Surface_text ahead = m_in;
    ahead.rest_of_line();
    if(ahead.rest().substr(0, 7) == "OFFSETS") // from version 5 on; n is one more than the number of cells
      read_cells_by_offsets(n, size, add);
    else
      read_cells_by_sizes(n, values<std::int64_t>("int", size), add);
  }

  template <class Add>
  void read_cells_by_offsets(std::size_t n, std::size_t size, const Add& add)
  {
    m_in.rest_of_line();
    m_in.word("OFFSETS");
    const std::vector<std::int64_t> offsets = values<std::int64_t>(m_in.word("the type of offsets"), n);
    if(m_in.word("CONNECTIVITY") != "CONNECTIVITY")
      m_in.refuse("expected CONNECTIVITY");
    const std::vector<std::int64_t> connectivity = values<std::int64_t>(m_in.word("the type of cells"), size);
    for(std::size_t i = 0; i + 1 < n; ++i) {
      if(offsets[i] < 0 || offsets[i] > offsets[i + 1] || offsets[i + 1] > std::int64_t(size))
        refuse("its offsets of cells are not increasing");
      add(connectivity.data() + offsets[i], std::size_t(offsets[i + 1] - offsets[i]));
    }
  }

  template <class Add>
  void read_cells_by_sizes(std::size_t n, const std::vector<std::int64_t>& cells, const Add& add) const
  {
    std::size_t begin = 0;
    for(std::size_t i = 0; i < n; ++i) {
      const std::int64_t m = begin < cells.size() ? cells[begin] : -1;
      if(m < 0 || std::uint64_t(m) >= cells.size() - begin)
        refuse("its cells do not have the size that it says");
      add(cells.data() + begin + 1, std::size_t(m));
      begin += std::size_t(m) + 1;
    }
  }

  // Skips arrays of data before the points.
  void skip_field()
  {
    m_in.word("the name of a field");
    for(std::size_t n = m_in.count("the number of arrays", 1); n > 0; --n) {
      std::string_view name = m_in.word("the name of an array");
      if(name == "METADATA") {
        skip_metadata();
        name = m_in.word("the name of an array");
      }
      const std::size_t components = m_in.count("the number of components", 1),
                        tuples = m_in.count("the number of tuples", 1);
      if(components != 0 && tuples > m_in.rest().size() / components + 1)
        m_in.refuse("the file is too short for an array of that size");
      const std::string_view type = m_in.word("the type of an array");
      if(type == "string" && !m_is_binary) {
        m_in.rest_of_line();
        for(std::size_t i = 0; i < components * tuples; ++i)
          m_in.rest_of_line();
      } else {
        values<double>(type, components * tuples);
      }
    }
  }

  // Skips lines up to an empty line.
  void skip_metadata()
  {
    m_in.rest_of_line();
    while(!m_in.rest().empty() && !Text_input(m_in.rest_of_line()).word().empty())
      ;
  }

public:
  VTK_polydata_reader(const std::string& path, const std::string& bytes) : m_path(path), m_in(path, bytes) {}

  Surface_soup read()
  {
    if(m_in.rest_of_line().substr(0, 14) != "# vtk DataFile")
      refuse("cannot be read: it does not start with # vtk DataFile");
    m_soup.comments = m_in.rest_of_line();
    const std::string coding = upper_word();
    m_is_binary = coding == "BINARY";
    if(!m_is_binary && coding != "ASCII")
      m_in.refuse("expected ASCII or BINARY");
    if(upper_word() != "DATASET")
      m_in.refuse("expected DATASET");
    const std::string type = upper_word();
    if(type != "POLYDATA")
      m_in.refuse("holds the data set " + in_quotes(type) + "; expected POLYDATA");
    for(std::string key = upper_word(); !key.empty() && key != "POINT_DATA" && key != "CELL_DATA";
        key = upper_word()) {
      if(key == "POINTS") {
        read_points();
      } else if(key == "POLYGONS") {
        read_cells([&](const std::int64_t* begin, std::size_t size) {
          m_soup.polygons.emplace_back();
          for(std::size_t i = 0; i < size; ++i)
            m_soup.polygons.back().push_back(vertex_index(begin[i]));
        });
      } else if(key == "TRIANGLE_STRIPS") {
        read_cells([&](const std::int64_t* begin, std::size_t size) { add_strip(begin, size, m_soup); });
      } else if(key == "VERTICES" || key == "LINES") {
        read_cells([](const std::int64_t*, std::size_t) {});
      } else if(key == "FIELD") {
        skip_field();
      } else if(key == "METADATA") {
        skip_metadata();
      } else {
        m_in.refuse("unknown keyword " + in_quotes(key));
      }
    }
    return std::move(m_soup);
  }
};

inline Surface_soup read_VTK_polydata(const std::string& path, const std::string& bytes)
{
  return VTK_polydata_reader(path, bytes).read();
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_READ_VTK_POLYDATA_H
