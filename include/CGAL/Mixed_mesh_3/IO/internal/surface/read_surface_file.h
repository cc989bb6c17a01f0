// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surface files of all formats.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_READ_SURFACE_FILE_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_READ_SURFACE_FILE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/internal/extension_of.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/Surface_soup.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/read_OBJ.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/read_OFF.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/read_PLY.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/read_STL.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/read_VTK_polydata.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/read_VTP.h>
#include <CGAL/Mixed_mesh_3/internal/base/compiled.h>

#include <string>
#include <string_view>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

/// A format of surface files: to add one, add a row to `surface_formats`.
struct Surface_format
{
  std::string_view extension;
  Surface_soup (*read)(const std::string& path, const std::string& bytes);
};

constexpr Surface_format surface_formats[] = {{".off", read_OFF}, {".obj", read_OBJ},
                                              {".stl", read_STL}, {".ply", read_PLY},
                                              {".vtp", read_VTP}, {".vtk", read_VTK_polydata}};

CGAL_MIXED_MESH_3_INLINE std::vector<std::string_view> surface_extensions()
{
  std::vector<std::string_view> extensions;
  for(const Surface_format& format : surface_formats)
    extensions.push_back(format.extension);
  return extensions;
}

CGAL_MIXED_MESH_3_INLINE Surface_soup read_surface_file(const std::string& path)
{
  const std::string extension = extension_of(path);
  for(const Surface_format& format : surface_formats)
    if(extension == format.extension)
      return format.read(path, read_bytes(path));
  read_bytes(path, 1); // the defect of a file that cannot be read comes first
  refuse(path, "unknown format; expected " + in_one_line(surface_extensions())
                 + "; convert it, for example to .ply by ParaView");
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_READ_SURFACE_FILE_H
