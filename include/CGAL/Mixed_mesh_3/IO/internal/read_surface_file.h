// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surface files of all formats.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_READ_SURFACE_FILE_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_READ_SURFACE_FILE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/internal/Surface_soup.h>
#include <CGAL/Mixed_mesh_3/IO/internal/read_FREESURFER.h>
#include <CGAL/Mixed_mesh_3/IO/internal/read_GIFTI.h>
#include <CGAL/Mixed_mesh_3/IO/internal/read_OBJ.h>
#include <CGAL/Mixed_mesh_3/IO/internal/read_OFF.h>
#include <CGAL/Mixed_mesh_3/IO/internal/read_PLY.h>
#include <CGAL/Mixed_mesh_3/IO/internal/read_STL.h>
#include <CGAL/Mixed_mesh_3/IO/internal/read_VTK_polydata.h>
#include <CGAL/Mixed_mesh_3/IO/internal/read_VTP.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

struct Surface_format
{
  std::string_view extension;
  Surface_soup (*read)(const std::string& path, const std::string& bytes);
};

constexpr Surface_format surface_formats[] = {{".off", read_OFF},  {".obj", read_OBJ},
                                              {".stl", read_STL},  {".ply", read_PLY},
                                              {".vtp", read_VTP},  {".vtk", read_VTK_polydata},
                                              {".gii", read_GIFTI}};

/// Refuses a file without a known extension: a surface of FreeSurfer, or a file that cannot be read.
[[noreturn]] inline void refuse_format(const std::string& path, std::string_view extension,
                                       std::string_view start)
{
  if(extension == ".mgz" || extension == ".mgh")
    refuse(path, "is an image of FreeSurfer; convert it: mri_convert " + printable(path) + " image.nii.gz");
  if(start == "\xff\xff\xff" || start == "\xff\xff\xfd")
    refuse(path, "is a FreeSurfer surface of quadrangles; convert it: mris_convert " + printable(path)
                   + " surface.gii");
  std::string known;
  for(const Surface_format& format : surface_formats)
    known += (known.empty() ? "" : ", ") + std::string(format.extension);
  refuse(path,
         "unknown format; expected " + known
           + " or a binary surface of FreeSurfer; convert it, for example to .ply by ParaView or 3D Slicer");
}

inline Surface_soup read_surface_file(const std::string& path)
{
  std::string extension = std::filesystem::path(path).extension().string();
  for(char& c : extension)
    if(c >= 'A' && c <= 'Z')
      c = char(c - 'A' + 'a');
  for(const Surface_format& format : surface_formats)
    if(extension == format.extension)
      return format.read(path, read_mesh_file(path));
  const std::string start = read_mesh_file(path, freesurfer_magic.size());
  if(start != freesurfer_magic)
    refuse_format(path, extension, start);
  return read_FREESURFER(path, read_mesh_file(path));
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_READ_SURFACE_FILE_H
