// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes of Medit (`.mesh`), as text: https://www.ljll.math.upmc.fr/frey/publications/RT-0253.pdf

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_READ_MEDIT_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_READ_MEDIT_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/internal/mesh/Mesh_words.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/element_names.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

/// Reads the vertices and elements of a `.mesh` file, and skips everything else. Positive references of
/// elements are their subdomains.
inline Mesh_input read_MEDIT(const std::string& path, const std::string& bytes)
{
  Mesh_words in(path, bytes);
  if(in.word() != "MeshVersionFormatted")
    in.refuse("cannot be read: not a text file of Medit");
  in.number<int>();
  Mesh_input mesh;
  bool has_vertices = false;
  for(std::string_view word = in.word(); word != "End"; word = in.word()) {
    const auto kind = std::find_if(std::begin(element_kinds), std::end(element_kinds),
                                   [word](Element_kind k) { return word == element_names[k].medit_keyword; });
    if(word == "Dimension") {
      if(in.number<int>() != 3)
        in.refuse("is not a mesh in space");
    } else if(word == "Vertices") {
      if(has_vertices)
        in.refuse("has two sections Vertices");
      has_vertices = true;
      for(std::size_t n = in.count(4); n != 0; --n) {
        mesh.points.push_back(in.point());
        in.attributes();
      }
    } else if(kind != std::end(element_kinds)) {
      if(!has_vertices)
        in.refuse("has elements before the vertices");
      const int size = reference_elements[*kind].number_of_vertices;
      for(std::size_t n = in.count(std::size_t(size) + 1); n != 0; --n) {
        mesh.elements.add(*kind, in.vertices(size, 1, mesh.points.size()).data());
        mesh.attributes.push_back(in.attributes());
      }
    } else {
      in.skip_numbers();
    }
  }
  return mesh;
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_READ_MEDIT_H
