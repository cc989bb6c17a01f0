// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Wavefront OBJ: vertices and faces; materials, textures, normals and curves are skipped.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_READ_OBJ_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_READ_OBJ_H

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

inline Surface_soup read_OBJ(const std::string& path, const std::string& bytes)
{
  Surface_soup soup;
  Surface_text in(path, bytes);
  std::string joined; // joins lines that end with a backslash
  while(!in.rest().empty()) {
    const Surface_text at = in; // for messages
    std::string_view line = in.rest_of_line();
    joined.clear();
    const auto goes_on = [&line] {
      while(!line.empty() && is_space(line.back()))
        line.remove_suffix(1);
      return !line.empty() && line.back() == '\\';
    };
    while(goes_on() && !in.rest().empty()) {
      joined += line.substr(0, line.size() - 1);
      joined += ' ';
      line = in.rest_of_line();
    }
    if(!joined.empty())
      line = joined += line;

    if(line.substr(0, 1) == "#")
      soup.comments.append(line) += '\n';
    line = line.substr(0, line.find('#'));
    Text_input words(line);
    const std::string_view key = words.word();
    if(key == "v") {
      Vec3 p;
      for(double& x : p)
        x = at.finite_coordinate(at.parse_coordinate(words.word()), soup.points.size());
      soup.points.push_back(p);
    } else if(key == "f") {
      std::vector<std::size_t> polygon;
      for(std::string_view word = words.word(); !word.empty(); word = words.word()) {
        // The first of vertex, texture and normal counts; it is from 1 on, or counted from the last vertex
        // back.
        const auto v = at.parse_integer<std::int64_t>(word.substr(0, word.find('/')));
        polygon.push_back(vertex_index(v > 0 ? v - 1 : v < 0 ? std::int64_t(soup.points.size()) + v : -1));
      }
      soup.polygons.push_back(std::move(polygon));
    }
  }
  return soup;
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_READ_OBJ_H
