// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Endings of file names.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_EXTENSION_OF_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_EXTENSION_OF_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

/// The extension of a file name, with its dot, in lower case.
inline std::string extension_of(const std::string& path)
{
  std::string extension = std::filesystem::path(path).extension().string();
  for(char& c : extension)
    if(c >= 'A' && c <= 'Z')
      c = char(c - 'A' + 'a');
  return extension;
}

/// Whether a file name ends with some characters.
inline bool ends_with(const std::string& text, const std::string& end)
{
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// Extensions in a sentence: ".off, .obj, .stl", or ".off, .obj and .stl".
inline std::string in_one_line(const std::vector<std::string_view>& extensions,
                               const std::string& conjunction = "")
{
  std::string line;
  for(std::size_t i = 0; i < extensions.size(); ++i) {
    const bool is_last = i + 1 == extensions.size();
    line += i == 0 ? "" : is_last && !conjunction.empty() ? " " + conjunction + " " : ", ";
    line += extensions[i];
  }
  return line;
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_EXTENSION_OF_H
