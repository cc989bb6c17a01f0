// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_IMAGE_3_IO_READ_ANATOMICAL_SURFACE_H
#define CGAL_MIXED_MESH_IMAGE_3_IO_READ_ANATOMICAL_SURFACE_H

#include <CGAL/Mixed_mesh_3/IO/Surface_input.h>
#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Mixed_mesh_image_3/IO/Read_anatomical_surface_options.h>
#include <CGAL/Mixed_mesh_image_3/IO/internal/anatomical_soup.h>

#include <string>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

/*!
\ingroup PkgMixedMeshImage3Ref

Reads a closed surface of a patient, as `read_closed_surface()` does, in RAS: the space of images and of all
other data. In addition, it reads formats of neuroimaging, and obeys the space that a file names.

| file | format |
|------|--------|
| those of `read_closed_surface()` | x and y are negated if a header or comment has 3D Slicer's `SPACE=LPS` |
| `.gii` | GIFTI, in the coordinates of the scanner where the file leads there |
| others | binary triangles of FreeSurfer (`lh.pial`), in the scanner's coordinates if they name the volume |

\param options information that the file lacks
\param path,mesh,error,input parameters of `read_closed_surface()`
\return whether the surface was read; if not, `mesh` is unchanged
\par Complexity
Complexity of `read_closed_surface()`
*/
template <class Mesh>
[[nodiscard]] bool read_anatomical_surface(const std::string& path,
                                           const Read_anatomical_surface_options& options, Mesh& mesh,
                                           std::string* error = nullptr, Surface_input* input = nullptr)
{
  return internal::make_surface_as(
    internal::make_surface, [&] { return internal::read_anatomical_file(path, options.space); }, path,
    options, mesh, error, input);
}

/*!
\ingroup PkgMixedMeshImage3Ref

Reads a sheet of a patient, as `read_sheet()` does, in RAS. Formats and parameters are those of
`read_anatomical_surface()`.
*/
template <class Mesh>
[[nodiscard]] bool read_anatomical_sheet(const std::string& path,
                                         const Read_anatomical_surface_options& options, Mesh& mesh,
                                         std::string* error = nullptr, Surface_input* input = nullptr)
{
  return internal::make_surface_as(
    internal::make_sheet, [&] { return internal::read_anatomical_file(path, options.space); }, path, options,
    mesh, error, input);
}

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_IO_READ_ANATOMICAL_SURFACE_H
