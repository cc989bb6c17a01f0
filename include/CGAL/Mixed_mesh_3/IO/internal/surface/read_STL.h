// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// STL, text and binary.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_READ_STL_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_READ_STL_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/internal/surface/Surface_soup.h>

#include <cctype>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <string_view>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

/// Whether two words are the same except for upper and lower case.
inline bool is_word(std::string_view word, std::string_view lower)
{
  if(word.size() != lower.size())
    return false;
  for(std::size_t i = 0; i < word.size(); ++i)
    if(std::tolower(static_cast<unsigned char>(word[i])) != lower[i])
      return false;
  return true;
}

/// Adds a polygon of the last `n` points.
inline void add_polygon_of_last(std::size_t n, Surface_soup& soup)
{
  soup.polygons.emplace_back(n);
  std::iota(soup.polygons.back().begin(), soup.polygons.back().end(), soup.points.size() - n);
}

inline void read_text_STL(const std::string& path, std::string_view bytes, Surface_soup& soup)
{
  Surface_text in(path, bytes);
  std::size_t vertices = 0; // vertices of the facet
  bool is_in_facet = false, is_ended = false;
  for(std::string_view word = in.word_or_end(); !word.empty(); word = in.word_or_end()) {
    const bool is_end_of_solid = is_word(word, "endsolid");
    if(is_word(word, "solid") || is_end_of_solid) { // the name that follows may have any words
      const std::string_view name = in.rest_of_line();
      soup.comments.append(name) += '\n';
      is_ended = is_end_of_solid;
      if(is_in_facet)
        in.refuse("the facet before does not end");
    } else if(is_word(word, "facet")) {
      if(is_in_facet)
        in.refuse("the facet before does not end");
      is_in_facet = true;
      vertices = 0;
    } else if(is_word(word, "vertex")) {
      if(!is_in_facet)
        in.refuse("a vertex is in no facet");
      soup.points.push_back(in.point(soup.points.size()));
      ++vertices;
    } else if(is_word(word, "endfacet")) {
      if(!is_in_facet)
        in.refuse("a facet ends that does not begin");
      add_polygon_of_last(vertices, soup);
      is_in_facet = false;
    }
  }
  if(is_in_facet || !is_ended)
    refuse(path, "is truncated: it does not end with endsolid");
}

inline void read_binary_STL(const std::string& path, std::string_view bytes, Surface_soup& soup)
{
  Surface_bytes in(path, bytes, Surface_bytes::LITTLE);
  soup.comments = bytes.substr(0, 80);
  in.skip(80);
  const std::uint32_t facets = in.value<std::uint32_t>();
  in.require(facets, 50);
  soup.points.reserve(3 * std::size_t(facets));
  soup.polygons.reserve(facets);
  for(std::uint32_t i = 0; i < facets; ++i) {
    in.skip(12); // normal
    for(int k = 0; k < 3; ++k)
      soup.points.push_back(in.point<float>());
    add_polygon_of_last(3, soup);
    in.skip(2);
  }
}

inline Surface_soup read_STL(const std::string& path, const std::string& bytes)
{
  Surface_soup soup;
  soup.repeats_points = true;
  // Headers of binary files may start with "solid", too: the size of the file tells.
  const std::string_view all = bytes;
  const bool starts_like_text = is_word(Text_input(all).word(), "solid");
  bool has_binary_size = false;
  if(bytes.size() >= 84) {
    const std::uint64_t facets = Surface_bytes(path, all.substr(80), Surface_bytes::LITTLE)
                                   .value<std::uint32_t>();
    has_binary_size = bytes.size() == 84 + 50 * facets;
  }
  if(starts_like_text && !has_binary_size)
    read_text_STL(path, bytes, soup);
  else if(bytes.size() >= 84)
    read_binary_STL(path, bytes, soup);
  else
    refuse(path, "cannot be read: not a complete STL file");
  return soup;
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_READ_STL_H
