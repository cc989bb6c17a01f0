// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surface files in RAS, those of neuroimaging among them.

#ifndef CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_ANATOMICAL_SOUP_H
#define CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_ANATOMICAL_SOUP_H

#include <CGAL/Mixed_mesh_3/IO/internal/extension_of.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/Surface_soup.h>
#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Mixed_mesh_image_3/IO/Read_anatomical_surface_options.h>
#include <CGAL/Mixed_mesh_image_3/IO/internal/read_FREESURFER.h>
#include <CGAL/Mixed_mesh_image_3/IO/internal/read_GIFTI.h>
#include <CGAL/Mixed_mesh_image_3/IO/internal/image_format_of.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

/// The space in headers and comments of 3D Slicer: SPACE=LPS, or SPACE=RAS.
inline std::optional<Anatomical_space> space_named_in(std::string_view comments)
{
  const std::size_t key = comments.find("SPACE=");
  const std::string_view name = key == comments.npos ? std::string_view() : comments.substr(key + 6, 3);
  if(name == "LPS")
    return Anatomical_space::LPS;
  if(name == "RAS")
    return Anatomical_space::RAS;
  return std::nullopt;
}

/// Converts points to RAS, the space of all other data.
inline Surface_soup in_RAS(Surface_soup soup, std::optional<Anatomical_space> space)
{
  if(space.value_or(space_named_in(soup.comments).value_or(Anatomical_space::RAS)) == Anatomical_space::RAS)
    return soup;
  for(Vec3& p : soup.points)
    p = {-p[0], -p[1], p[2]};
  soup.warnings.push_back(std::string(space ? "is read as LPS" : "says that it is in LPS")
                          + ": x and y are negated, the result is in RAS");
  return soup;
}

/// Refuses a file without the extension of a surface that is no binary surface of triangles of FreeSurfer.
[[noreturn]] inline void refuse_anatomical_format(const std::string& path, std::string_view start)
{
  if(start == "\xff\xff\xff" || start == "\xff\xff\xfd")
    refuse(path, "is a FreeSurfer surface of quadrangles; convert it: mris_convert " + printable(path)
                   + " surface.gii");
  std::vector<std::string_view> known = surface_extensions();
  known.push_back(".gii");
  if(image_format_of(path))
    refuse(path,
           "is an image; expected a surface, " + in_one_line(known) + " or a binary surface of FreeSurfer");
  refuse(path,
         "unknown format; expected " + in_one_line(known)
           + " or a binary surface of FreeSurfer; convert it, for example to .ply by ParaView or 3D Slicer");
}

/// The points, in RAS, and polygons of a file.
/// \param space the space of a file whose format does not define it
inline Surface_soup read_anatomical_file(const std::string& path, std::optional<Anatomical_space> space)
{
  const std::string extension = extension_of(path);
  if(extension == ".gii")
    return read_GIFTI(path, read_bytes(path));
  const std::vector<std::string_view> known = surface_extensions();
  if(std::find(known.begin(), known.end(), extension) != known.end())
    return in_RAS(read_surface_file(path), space);
  const std::string start = read_bytes(path, freesurfer_magic.size());
  if(start != freesurfer_magic)
    refuse_anatomical_format(path, start);
  return read_FREESURFER(path, read_bytes(path));
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_IO_INTERNAL_ANATOMICAL_SOUP_H
