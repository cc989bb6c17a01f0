// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes of TetGen, as a pair of files: https://wias-berlin.de/software/tetgen/fformats.html

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_READ_TETGEN_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_READ_TETGEN_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/internal/mesh/Mesh_words.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

/// Reads an `.ele` file, and the `.node` file of the same name. The first positive attribute of an element is
/// its subdomain.
inline Mesh_input read_TETGEN(const std::string& path)
{
  const auto beside = [&path](const char* extension) {
    return std::filesystem::path(path).replace_extension(extension).string();
  };
  Mesh_input mesh;
  std::int64_t first = 0;
  {
    const std::string file = beside(".node"), bytes = read_bytes(file);
    Mesh_words in(file, bytes);
    const std::size_t vertices = in.count(4);
    if(in.number<int>() != 3)
      in.refuse("is not a mesh in space");
    std::size_t others = in.count(1); // attributes
    others += in.count(1);            // markers
    for(std::size_t v = 0; v < vertices; ++v) {
      const auto tag = in.number<std::int64_t>();
      if(v == 0)
        first = tag;
      if((first != 0 && first != 1) || tag - first != std::int64_t(v))
        in.refuse("is damaged: the vertex " + std::to_string(tag) + " is out of order");
      mesh.points.push_back(in.point());
      for(std::size_t i = 0; i < others; ++i)
        in.number<double>();
    }
  }
  const std::string file = beside(".ele"), bytes = read_bytes(file);
  Mesh_words in(file, bytes);
  const std::size_t elements = in.count(5), size = in.count(1), attributes = in.count(1);
  if(size != 4)
    in.refuse("has tetrahedra of " + std::to_string(size) + " vertices; expected linear ones, of 4");
  for(std::size_t e = 0; e < elements; ++e) {
    in.number<std::int64_t>();
    mesh.elements.add(TETRAHEDRON, in.vertices(4, first, mesh.points.size()).data());
    mesh.attributes.push_back(attributes > 0 ? in.attributes() : Element_attributes());
    for(std::size_t i = 1; i < attributes; ++i)
      in.number<double>();
  }
  return mesh;
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_READ_TETGEN_H
