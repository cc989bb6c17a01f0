// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// VTK polygonal data in XML: polygons and strips of triangles; vertices and lines are skipped.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_READ_VTP_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_READ_VTP_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/internal/surface/Surface_soup.h>
#include <CGAL/Mixed_mesh_3/IO/internal/VTK_XML_reader.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

class VTP_reader : VTK_XML_reader
{
  // Calls `add(begin, size)` with the vertices of each cell.
  template <class Add>
  void read_cells(const Piece& piece, const char* section, const char* count, std::size_t first,
                  const Add& add)
  {
    const std::uint64_t m = has_attribute(piece.tag, count) ? number(piece.tag, count) : 0;
    const std::vector<std::int64_t> offsets = values<std::int64_t>(piece, section, "offsets", m);
    const std::int64_t size = offsets.empty() ? 0 : offsets.back();
    if(size < 0)
      refuse("its array \"offsets\" is not increasing");
    std::vector<std::int64_t> connectivity = values<std::int64_t>(piece, section, "connectivity",
                                                                  std::uint64_t(size));
    for(std::int64_t& v : connectivity)
      v = v < 0 ? v : v + std::int64_t(first);
    std::int64_t begin = 0;
    for(std::int64_t end : offsets) {
      if(end < begin || end > size)
        refuse("its array \"offsets\" is not increasing");
      add(connectivity.data() + begin, std::size_t(end - begin));
      begin = end;
    }
  }

  void read_piece(const Piece& piece, Surface_soup& soup)
  {
    const std::size_t first = soup.points.size(); // number of points of the pieces before
    const std::uint64_t n = number(piece.tag, "NumberOfPoints");
    if(n > largest_mesh_size)
      refuse("has more than 2^32 points");
    const std::vector<double> coordinates = values<double>(piece, "Points", "Points", 3 * n);
    for(std::size_t v = 0; v < n; ++v)
      soup.points.push_back({coordinates[3 * v], coordinates[3 * v + 1], coordinates[3 * v + 2]});
    read_cells(piece, "Polys", "NumberOfPolys", first, [&](const std::int64_t* begin, std::size_t size) {
      soup.polygons.emplace_back();
      for(std::size_t i = 0; i < size; ++i)
        soup.polygons.back().push_back(vertex_index(begin[i]));
    });
    read_cells(piece, "Strips", "NumberOfStrips", first,
               [&](const std::int64_t* begin, std::size_t size) { add_strip(begin, size, soup); });
  }

public:
  VTP_reader(const std::string& path, const std::string& bytes) : VTK_XML_reader(path, bytes, "PolyData") {}

  Surface_soup read()
  {
    Surface_soup soup;
    if(file().array("FieldData", "SPACE") != nullptr) { // three letters, and the end of the text
      soup.comments = "SPACE=";
      for(std::int64_t c : values<std::int64_t>(file(), "FieldData", "SPACE", 4))
        soup.comments += char(c);
    }
    for(const Piece& piece : pieces())
      read_piece(piece, soup);
    return soup;
  }
};

inline Surface_soup read_VTP(const std::string& path, const std::string& bytes)
{
  return VTP_reader(path, bytes).read();
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_READ_VTP_H
