// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes of Netgen (`.vol`).

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_READ_NETGEN_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_READ_NETGEN_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/internal/mesh/Mesh_words.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

/// Swaps vertices of an element, because Netgen's elements are mirror images of ours.
inline void mirror(Element_kind kind, std::array<Vertex_index, 8>& v)
{
  switch(kind) {
  case TETRAHEDRON: std::swap(v[1], v[2]); break;
  case PYRAMID: std::swap(v[1], v[3]); break;
  case PRISM:
    std::swap(v[1], v[2]);
    std::swap(v[4], v[5]);
    break;
  case HEXAHEDRON:
    std::swap(v[1], v[3]);
    std::swap(v[5], v[7]);
    break;
  }
}

/// Reads a `.vol` file, materials as subdomains. Vertices come after the elements in the file.
inline Mesh_input read_NETGEN(const std::string& path, const std::string& bytes)
{
  Mesh_words in(path, bytes);
  if(in.word() != "mesh3d")
    in.refuse("cannot be read: not a mesh of Netgen");
  Mesh_input mesh;
  bool has_points = false;
  for(std::string_view word = in.word(); word != "endmesh"; word = in.word()) {
    if(word == "dimension") {
      if(in.number<int>() != 3)
        in.refuse("is not a mesh in space");
    } else if(word == "points") {
      if(has_points)
        in.refuse("has two sections points");
      has_points = true;
      for(std::size_t n = in.count(3); n != 0; --n)
        mesh.points.push_back(in.point());
    } else if(word == "volumeelements") {
      for(std::size_t n = in.count(6); n != 0; --n) {
        const Element_attributes attributes = in.attributes();
        const int size = in.number<int>();
        const auto kind = std::find_if(std::begin(element_kinds), std::end(element_kinds),
                                       [size](Element_kind k) {
                                         return reference_elements[k].number_of_vertices == size;
                                       });
        if(kind == std::end(element_kinds))
          in.refuse("has elements of " + std::to_string(size) + " vertices; expected linear ones");
        std::array<Vertex_index, 8> vertices = in.vertices(size, 1, largest_mesh_size);
        mirror(*kind, vertices);
        mesh.elements.add(*kind, vertices.data());
        mesh.attributes.push_back(attributes);
      }
    } else {
      in.skip_numbers();
    }
  }
  for(Vertex_index v : mesh.elements.connectivity())
    if(v >= mesh.points.size())
      in.refuse("an element has the vertex " + std::to_string(std::size_t(v) + 1) + ", which does not exist");
  return mesh;
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_READ_NETGEN_H
