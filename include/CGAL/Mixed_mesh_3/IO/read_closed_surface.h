// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_READ_CLOSED_SURFACE_H
#define CGAL_MIXED_MESH_3_IO_READ_CLOSED_SURFACE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/Read_surface_options.h>
#include <CGAL/Mixed_mesh_3/IO/Surface_input.h>
#include <CGAL/Mixed_mesh_3/IO/internal/Surface_soup.h>
#include <CGAL/Mixed_mesh_3/IO/internal/errors.h>
#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <string>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

namespace internal {

/// The surface that is read: predicates on it are exact.
using Surface = CGAL::Surface_mesh<Predicates_kernel::Point_3>;

/// Reads a surface and mends it, or refuses.
void read_surface(const std::string& path, const Read_surface_options& options, Surface& mesh,
                  Surface_input& input);

/// Mends a surface, or refuses; the name represents the surface in messages.
void make_surface(const std::string& name, const Read_surface_options& options, Surface_soup soup,
                  Surface& mesh, Surface_input& input);

/// Reads a sheet, or refuses.
void read_sheet(const std::string& path, const Read_surface_options& options, Surface& mesh,
                Surface_input& input);

/// Implementation of the two functions below, with one of the functions above.
template <class Read, class Mesh>
bool read_surface_as(const Read& read, const std::string& path, const Read_surface_options& options,
                     Mesh& mesh, std::string* error, Surface_input* input)
{
  Surface_input found;
  const bool is_success = is_read(path, error, [&] {
    Surface surface;
    read(path, options, surface, found);
    if constexpr(std::is_same_v<Mesh, Surface>) {
      mesh = std::move(surface);
    } else {
      clear(mesh);
      CGAL::copy_face_graph(surface, mesh);
    }
  });
  if(input != nullptr && is_success)
    *input = std::move(found);
  else if(input != nullptr)
    input->wrap_diameter = found.wrap_diameter;
  return is_success;
}

} // namespace internal

/*!
\ingroup PkgMixedMesh3IO

Reads a closed surface, and mends harmless defects: faces that do not have the same points where they meet,
inward orientation. A surface may touch itself in points and edges: it gets a vertex for each sheet there.
Points are merged only where the surface is not closed as given. Coordinates below 2^-60 of the extent
become zero.

Then, unless `is_strict` is set, the function repairs other defects: holes that are a small part of the
surface are filled, and faces that cut each other, or have edges in common with more than one other, become
the boundary of the solid that they enclose, around which they wind outwards. A surface that cannot be
repaired is refused, or wrapped.

| file | format |
|------|--------|
| `.off`, `.obj`, `.stl`, `.ply` | the usual ones, text and binary |
| `.vtp`, `.vtk` | VTK polygonal data in XML, and in the legacy format: polygons and strips |
| `.gii` | GIFTI, in the coordinates of the scanner where the file leads there |
| others | binary triangles of FreeSurfer (`lh.pial`), in the scanner's coordinates if they name the volume |

Arrays compressed by zlib can be read if `CGAL_USE_ZLIB` is defined and zlib is linked. A header or comment
with `SPACE=LPS`, as 3D Slicer writes it, is obeyed: x and y are negated, so that the result is in RAS.

\tparam Mesh a model of `MutableFaceGraph` and `FaceListGraph` with an internal vertex point map, for
        example `Surface_mesh` or `Polyhedron_3`
\param path file; its format follows from the extension
\param options information that the file lacks
\param mesh the result: triangulated, closed, not self-intersecting, oriented outwards
\param error if not null, receives a line that names the file and the defect, if the file cannot be read or is
not the surface of a solid
\param input if not null, receives a description of the input, with a warning for every repair
\return whether the surface was read; if not, `mesh` is unchanged
\par Complexity
O((n + k) log(n + k)) for n faces, of which k pairs cut each other
*/
template <class Mesh>
[[nodiscard]] bool read_closed_surface(const std::string& path, const Read_surface_options& options,
                                       Mesh& mesh, std::string* error = nullptr,
                                       Surface_input* input = nullptr)
{
  return internal::read_surface_as(internal::read_surface, path, options, mesh, error, input);
}

/// \ingroup PkgMixedMesh3IO
/// Overload with default options.
template <class Mesh>
[[nodiscard]] bool read_closed_surface(const std::string& path, Mesh& mesh, std::string* error = nullptr,
                                       Surface_input* input = nullptr)
{
  return read_closed_surface(path, Read_surface_options(), mesh, error, input);
}

/*!
\ingroup PkgMixedMesh3IO

Makes a closed surface of arrays, as `read_closed_surface()` does of a file.

\param points range of ranges of three coordinates
\param polygons range of ranges of indices of points
\param name name of the surface in `error`
\param options,mesh,error,input parameters of `read_closed_surface()`
\return whether the surface was made; if not, `mesh` is unchanged
\par Complexity
Complexity of `read_closed_surface()`
*/
template <class Points, class Polygons, class Mesh>
[[nodiscard]] bool make_closed_surface(const Points& points, const Polygons& polygons,
                                       const std::string& name, const Read_surface_options& options,
                                       Mesh& mesh, std::string* error = nullptr,
                                       Surface_input* input = nullptr)
{
  const auto make = [&](const std::string&, const Read_surface_options&, internal::Surface& surface,
                        Surface_input& found) {
    internal::Surface_soup soup;
    for(const auto& p : points)
      soup.points.push_back({double(p[0]), double(p[1]), double(p[2])});
    for(const auto& polygon : polygons) {
      soup.polygons.emplace_back();
      for(const auto v : polygon)
        soup.polygons.back().push_back(internal::vertex_index(v));
    }
    internal::make_surface(name, options, std::move(soup), surface, found);
  };
  return internal::read_surface_as(make, name, options, mesh, error, input);
}

/*!
\ingroup PkgMixedMesh3IO

Reads a sheet for `Mixed_mesh_sheet_3`: a surface with or without a border, an oriented 2-manifold that does
not cut itself. Formats, parameters and repairs are those of `read_closed_surface()`; the orientation is that
of the file, where its faces agree. No volume is given.

\par Complexity
O(n log n)
*/
template <class Mesh>
[[nodiscard]] bool read_sheet(const std::string& path, const Read_surface_options& options, Mesh& mesh,
                              std::string* error = nullptr, Surface_input* input = nullptr)
{
  return internal::read_surface_as(internal::read_sheet, path, options, mesh, error, input);
}

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#ifndef CGAL_MIXED_MESH_3_COMPILED
#include <CGAL/Mixed_mesh_3/IO/internal/read_surface_impl.h>
#endif

#endif // CGAL_MIXED_MESH_3_IO_READ_CLOSED_SURFACE_H
