// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// GIFTI surfaces: text, base64, and base64 compressed by zlib if CGAL_USE_ZLIB is defined (link zlib then).

#ifndef CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_READ_GIFTI_H
#define CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_READ_GIFTI_H

#include <CGAL/Mixed_mesh_3/IO/internal/surface/Surface_soup.h>
#include <CGAL/Mixed_mesh_image_3/IO/internal/Volume_geometry.h>
#include <CGAL/Mixed_mesh_3/IO/internal/XML_input.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

class GIFTI_reader
{
  struct Coordinate_system
  {
    std::string_view from, to, matrix;
  };

  struct Array
  {
    XML_tag tag;
    std::string_view data;
    std::vector<Coordinate_system> systems;
    std::map<std::string_view, std::string_view> metadata;
  };

  const std::string& m_path;
  const std::string& m_bytes;
  std::vector<Array> m_arrays;

  [[noreturn]] void refuse(const std::string& defect) const { internal::refuse(m_path, defect); }

  static std::string_view trimmed(std::string_view text)
  {
    while(!text.empty() && is_space(text.front()))
      text.remove_prefix(1);
    while(!text.empty() && is_space(text.back()))
      text.remove_suffix(1);
    return text;
  }

  void read_structure()
  {
    XML_input in(m_path, m_bytes);
    XML_tag tag;
    std::vector<std::string_view> open; // the names of the elements around
    std::string_view name;              // name of metadata
    bool has_root = false;
    while(in.next(tag)) {
      if(!has_root && (!tag.is_start || tag.name != "GIFTI"))
        refuse("cannot be read: not a GIFTI file");
      if(has_root && (open.empty() || (!tag.is_start && open.back() != tag.name)))
        refuse("is damaged: no valid XML at the tag " + in_quotes(tag.name));
      has_root = true;
      if(tag.is_start && tag.name == "DataArray") {
        m_arrays.emplace_back();
        m_arrays.back().tag = tag;
      } else if(tag.is_start && !m_arrays.empty()) {
        Array& array = m_arrays.back();
        if(tag.name == "CoordinateSystemTransformMatrix")
          array.systems.emplace_back();
        const std::string_view text = tag.is_end ? std::string_view() : trimmed(in.text());
        if(tag.name == "Data")
          array.data = text;
        else if(tag.name == "Name")
          name = text;
        else if(tag.name == "Value")
          array.metadata.emplace(name, text);
        else if(!array.systems.empty() && tag.name == "DataSpace")
          array.systems.back().from = text;
        else if(!array.systems.empty() && tag.name == "TransformedSpace")
          array.systems.back().to = text;
        else if(!array.systems.empty() && tag.name == "MatrixData")
          array.systems.back().matrix = text;
      }
      if(tag.is_start && !tag.is_end)
        open.push_back(tag.name);
      else if(!tag.is_start)
        open.pop_back();
    }
    if(!has_root)
      refuse("cannot be read: not a GIFTI file");
    if(!open.empty())
      refuse("is truncated: " + in_quotes(open.back()) + " does not end");
  }

  std::string_view attribute(const Array& array, std::string_view name) const
  {
    return XML_input(m_path, m_bytes).attribute(array.tag, name).value_or("");
  }

  // The only array of an intent.
  const Array& array(std::string_view intent) const
  {
    const Array* found = nullptr;
    for(const Array& a : m_arrays)
      if(attribute(a, "Intent") == intent) {
        if(found != nullptr)
          refuse("has several arrays of the intent " + std::string(intent));
        found = &a;
      }
    if(found == nullptr)
      refuse("is no surface: it has no array of the intent " + std::string(intent));
    return *found;
  }

  [[noreturn]] void refuse_array(const Array& array, const std::string& defect) const
  {
    refuse("its array " + in_quotes(attribute(array, "Intent")) + " " + defect);
  }

  // Each row has three values.
  std::size_t number_of_rows(const Array& array) const
  {
    std::uint64_t n = 0;
    const auto is = [&](std::string_view name, std::string_view value) {
      return attribute(array, name) == value;
    };
    if(!parse_number(attribute(array, "Dim0"), n) || !is("Dimensionality", "2") || !is("Dim1", "3"))
      refuse_array(array, "does not have 3 columns");
    if(n > m_bytes.size() * Encoded_bytes::largest_compression)
      refuse_array(array, "would have " + std::to_string(n) + " rows, more than fit into the file");
    return std::size_t(n);
  }

  template <class Value>
  std::vector<Value> text_values(const Array& array, std::size_t count) const
  {
    if(count > array.data.size() / 2 + 1)
      refuse_array(array, "is truncated");
    std::vector<Value> values(count);
    Text_input in(array.data);
    for(Value& value : values) {
      const std::string_view word = in.word();
      if(word.empty())
        refuse_array(array, "is truncated");
      if(!parse_number(word, value))
        refuse_array(array, "has " + in_quotes(word) + " where a number is expected");
    }
    return values;
  }

  std::string inflated(const Array& array, const std::string& compressed, std::size_t size) const
  {
#ifdef CGAL_USE_ZLIB
    if(size / Encoded_bytes::largest_compression > compressed.size())
      refuse_array(array, "is truncated");
    std::string bytes(size, '\0');
    if(!decompress(compressed, bytes.data(), size))
      refuse_array(array, "is damaged: its compressed data are not valid");
    return bytes;
#else
    static_cast<void>(compressed);
    static_cast<void>(size);
    refuse_array(array, "is compressed, and cannot be read by a program built without zlib");
#endif
  }

  template <class Value>
  std::vector<Value> values(const Array& array, std::size_t count) const
  {
    const std::string_view encoding = attribute(array, "Encoding");
    if(encoding == "ASCII")
      return text_values<Value>(array, count);
    const bool is_compressed = encoding == "GZipBase64Binary";
    if(!is_compressed && encoding != "Base64Binary")
      refuse_array(array, "has the encoding " + in_quotes(encoding)
                            + "; expected ASCII, Base64Binary or GZipBase64Binary");
    const std::optional<std::string> decoded = Encoded_bytes(array.data, true).rest();
    if(!decoded)
      refuse_array(array, "is damaged: it is no valid base64");
    const std::string bytes = is_compressed ? inflated(array, *decoded, count * sizeof(Value)) : *decoded;
    if(bytes.size() != count * sizeof(Value))
      refuse_array(array, "has " + std::to_string(bytes.size()) + " bytes; expected "
                            + std::to_string(count * sizeof(Value)));
    Surface_bytes in(m_path, bytes,
                     attribute(array, "Endian") == "BigEndian" ? Surface_bytes::BIG : Surface_bytes::LITTLE);
    std::vector<Value> values(count);
    for(Value& value : values)
      value = in.value<Value>();
    return values;
  }

  // Calls `add(a, b, c)` with each row.
  template <class Value, class Add>
  void read_rows(const Array& array, const Add& add) const
  {
    const std::size_t n = number_of_rows(array);
    const std::vector<Value> x = values<Value>(array, 3 * n);
    const bool is_by_columns = attribute(array, "ArrayIndexingOrder") == "ColumnMajorOrder";
    const std::size_t row = is_by_columns ? 1 : 3, column = is_by_columns ? n : 1;
    for(std::size_t i = 0; i < n; ++i)
      add(x[row * i], x[row * i + column], x[row * i + 2 * column]);
  }

  // Reads the entries VolGeomX_R, ... that FreeSurfer writes.
  static bool read_volume_geometry(const Array& array, Volume_geometry& geometry)
  {
    for(const auto& [axis, name] :
        {std::make_pair(&geometry.x_ras, "X"), std::make_pair(&geometry.y_ras, "Y"),
         std::make_pair(&geometry.z_ras, "Z"), std::make_pair(&geometry.c_ras, "C")})
      for(std::size_t k = 0; k < 3; ++k) {
        const auto found = array.metadata.find(std::string("VolGeom") + name + "_" + "RAS"[k]);
        if(found == array.metadata.end() || !parse_number(found->second, (*axis)[k]))
          return false;
      }
    return geometry.is_rigid();
  }

  void apply_matrix(const Array& array, std::string_view text, std::vector<Vec3>& points) const
  {
    std::array<double, 16> m;
    Text_input in(text);
    for(double& x : m)
      if(!parse_number(in.word(), x))
        refuse_array(array, "has no valid matrix");
    for(Vec3& p : points) {
      const Vec3 q = p;
      for(std::size_t k = 0; k < 3; ++k)
        p[k] = m[4 * k] * q[0] + m[4 * k + 1] * q[1] + m[4 * k + 2] * q[2] + m[4 * k + 3];
    }
  }

  // Moves points to the space of the scanner, if they are not there: by a matrix, or by FreeSurfer's
  // description of the volume.
  void move_to_scanner(const Array& array, std::vector<Vec3>& points) const
  {
    constexpr std::string_view scanner = "NIFTI_XFORM_SCANNER_ANAT";
    for(const Coordinate_system& system : array.systems)
      if(system.from == scanner)
        return;
    for(const Coordinate_system& system : array.systems)
      if(system.to == scanner)
        return apply_matrix(array, system.matrix, points);
    Volume_geometry geometry;
    if(read_volume_geometry(array, geometry))
      for(Vec3& p : points)
        p = geometry.to_scanner(p);
  }

public:
  GIFTI_reader(const std::string& path, const std::string& bytes) : m_path(path), m_bytes(bytes) {}

  Surface_soup read()
  {
    read_structure();
    Surface_soup soup;
    const Array& points = array("NIFTI_INTENT_POINTSET");
    const auto add_point = [&](double x, double y, double z) { soup.points.push_back({x, y, z}); };
    const std::string_view type = attribute(points, "DataType");
    if(type == "NIFTI_TYPE_FLOAT32")
      read_rows<float>(points, add_point);
    else if(type == "NIFTI_TYPE_FLOAT64")
      read_rows<double>(points, add_point);
    else
      refuse_array(points, "has the type " + in_quotes(type) + "; expected NIFTI_TYPE_FLOAT32");
    move_to_scanner(points, soup.points);
    const Array& triangles = array("NIFTI_INTENT_TRIANGLE");
    if(attribute(triangles, "DataType") != "NIFTI_TYPE_INT32")
      refuse_array(triangles, "has the type " + in_quotes(attribute(triangles, "DataType"))
                                + "; expected NIFTI_TYPE_INT32");
    read_rows<std::int32_t>(triangles, [&](std::int64_t a, std::int64_t b, std::int64_t c) {
      soup.polygons.push_back({vertex_index(a), vertex_index(b), vertex_index(c)});
    });
    return soup;
  }
};

inline Surface_soup read_GIFTI(const std::string& path, const std::string& bytes)
{
  return GIFTI_reader(path, bytes).read();
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_READ_GIFTI_H
