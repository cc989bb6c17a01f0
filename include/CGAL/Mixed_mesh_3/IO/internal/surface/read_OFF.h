// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// OFF: https://segeval.cs.princeton.edu/public/off_format.html, with the variants of Geomview.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_READ_OFF_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_READ_OFF_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/internal/surface/Surface_soup.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

/// The header, whose first word tells the data of the vertices; normals, colors and texture come after
/// coordinates.
struct OFF_header
{
  bool has_texture = false, has_colors = false, has_normals = false, is_homogeneous = false;

  /// Whether the word is the header of a file of points in space.
  bool parse(std::string_view word)
  {
    const auto starts = [&word](std::string_view prefix) {
      const bool does = word.substr(0, prefix.size()) == prefix;
      word.remove_prefix(does ? prefix.size() : 0);
      return does;
    };
    has_texture = starts("ST");
    has_colors = starts("C");
    has_normals = starts("N");
    is_homogeneous = starts("4");
    return word == "OFF";
  }

  std::size_t number_of_values() const
  {
    return 3 + std::size_t(is_homogeneous) + 3 * std::size_t(has_normals) + 4 * std::size_t(has_colors)
           + 2 * std::size_t(has_texture);
  }
};

inline Vec3 divided(Vec3 p, double w)
{
  for(double& x : p)
    x /= w;
  return p;
}

inline Surface_soup read_binary_OFF(const std::string& path, std::string_view bytes, const OFF_header& header)
{
  Surface_bytes in(path, bytes, Surface_bytes::BIG);
  Surface_soup soup;
  const std::uint32_t points = in.value<std::uint32_t>(), polygons = in.value<std::uint32_t>();
  in.value<std::uint32_t>(); // edges
  in.require(points, 4 * header.number_of_values());
  for(std::uint32_t i = 0; i < points; ++i) {
    const Vec3 p = in.point<float>();
    soup.points.push_back(header.is_homogeneous ? divided(p, double(in.value<float>())) : p);
    in.skip(4 * (header.number_of_values() - 3 - std::size_t(header.is_homogeneous)));
  }
  in.require(polygons, 8);
  for(std::uint32_t i = 0; i < polygons; ++i) {
    const std::uint32_t n = in.value<std::uint32_t>();
    in.require(n, 4);
    std::vector<std::size_t> polygon(n);
    for(std::size_t& v : polygon)
      v = vertex_index(std::int64_t(in.value<std::int32_t>()));
    soup.polygons.push_back(std::move(polygon));
    const std::uint32_t colors = in.value<std::uint32_t>();
    in.require(colors, 4);
    in.skip(4 * std::size_t(colors));
  }
  return soup;
}

inline Surface_soup read_OFF(const std::string& path, const std::string& bytes)
{
  Surface_text in(path, bytes, '#');
  OFF_header header;
  if(!header.parse(in.word_or_end()))
    refuse(path, "cannot be read: it does not start with OFF");
  Surface_text ahead = in;
  if(ahead.word_or_end() == "BINARY") {
    ahead.rest_of_line();
    return read_binary_OFF(path, ahead.rest(), header);
  }
  Surface_soup soup;
  soup.comments = bytes.substr(0, 1000); // comments are at the start
  const std::size_t points = in.count("the number of vertices", 6),
                    polygons = in.count("the number of faces", 2);
  in.rest_of_line(); // edges
  soup.points.reserve(points);
  for(std::size_t i = 0; i < points; ++i) {
    const Vec3 p = in.point(i);
    soup.points.push_back(header.is_homogeneous ? divided(p, in.coordinate()) : p);
    in.rest_of_line(); // normals, colors, texture
  }
  soup.polygons.reserve(polygons);
  for(std::size_t i = 0; i < polygons; ++i) {
    std::vector<std::size_t> polygon(in.count("the number of vertices of a face", 2));
    for(std::size_t& v : polygon)
      v = in.index();
    soup.polygons.push_back(std::move(polygon));
    in.rest_of_line(); // color
  }
  return soup;
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_READ_OFF_H
