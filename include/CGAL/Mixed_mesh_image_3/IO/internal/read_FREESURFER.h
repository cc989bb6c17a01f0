// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Binary triangle surfaces of FreeSurfer: lh.pial, rh.white, ...

#ifndef CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_READ_FREESURFER_H
#define CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_READ_FREESURFER_H

#include <CGAL/Mixed_mesh_3/IO/internal/surface/Surface_soup.h>
#include <CGAL/Mixed_mesh_image_3/IO/internal/Volume_geometry.h>

#include <algorithm>
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

/// The first bytes of a file of triangles.
constexpr std::string_view freesurfer_magic = "\xff\xff\xfe";

/// Reads the lines "key = value" after the faces; false if they are missing, or say that they are not valid.
inline bool read_volume_geometry(std::string_view tail, Volume_geometry& geometry)
{
  bool is_valid = false, has_center = false;
  tail.remove_prefix((std::min)(tail.find("valid"), tail.size())); // numbers before them tell the content
  while(!tail.empty()) {
    const std::size_t n = (std::min)(tail.find('\n'), tail.size() - 1);
    const std::string_view line = tail.substr(0, n);
    tail.remove_prefix(n + 1);
    const std::size_t equals = line.find('=');
    if(equals == line.npos)
      continue;
    const std::string_view key = Text_input(line.substr(0, equals)).word();
    Text_input values(line.substr(equals + 1));
    if(key == "valid")
      is_valid = values.word() == "1";
    for(const auto& [name, axis] :
        {std::make_pair("xras", &geometry.x_ras), std::make_pair("yras", &geometry.y_ras),
         std::make_pair("zras", &geometry.z_ras), std::make_pair("cras", &geometry.c_ras)})
      if(key == name) {
        for(double& x : *axis)
          if(!parse_number(values.word(), x))
            return false;
        has_center = has_center || axis == &geometry.c_ras;
      }
  }
  return is_valid && has_center && geometry.is_rigid();
}

inline Surface_soup read_FREESURFER(const std::string& path, const std::string& bytes)
{
  std::string_view text = bytes;
  text.remove_prefix(freesurfer_magic.size());
  const std::size_t end_of_comment = text.find("\n\n");
  if(end_of_comment == text.npos)
    refuse(path, "is damaged: the comment of the FreeSurfer surface does not end");
  Surface_bytes in(path, text.substr(end_of_comment + 2), Surface_bytes::BIG);
  Surface_soup soup;
  const auto points = in.value<std::uint32_t>(), triangles = in.value<std::uint32_t>();
  in.require(std::uint64_t(points) + triangles, 12);
  for(std::uint32_t i = 0; i < points; ++i)
    soup.points.push_back(in.point<float>());
  for(std::uint32_t i = 0; i < triangles; ++i) {
    std::vector<std::size_t> triangle(3);
    for(std::size_t& v : triangle)
      v = vertex_index(std::int64_t(in.value<std::int32_t>()));
    soup.polygons.push_back(std::move(triangle));
  }
  Volume_geometry geometry;
  if(read_volume_geometry(in.rest(), geometry))
    for(Vec3& p : soup.points)
      p = geometry.to_scanner(p);
  else
    soup.warnings.push_back(
      "does not say where its volume is: coordinates are FreeSurfer's surface RAS, which "
      "differ from those of the scanner by c_ras (mris_convert --to-scanner adds it)");
  return soup;
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_READ_FREESURFER_H
