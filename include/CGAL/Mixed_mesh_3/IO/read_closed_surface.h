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
#include <CGAL/Mixed_mesh_3/IO/internal/surface/Surface.h>
#include <CGAL/Mixed_mesh_3/IO/internal/surface/Surface_soup.h>
#include <CGAL/Mixed_mesh_3/IO/internal/errors.h>
#include <CGAL/Mixed_mesh_3/IO/internal/extension_of.h>

#include <CGAL/boost/graph/copy_face_graph.h>

#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

namespace internal {

/// The extensions of the files that `read_surface_file()` reads.
std::vector<std::string_view> surface_extensions();

/// The points and polygons of a file, or refuses.
Surface_soup read_surface_file(const std::string& path);

/// Mends a closed surface, or refuses; the name represents the surface in messages.
void make_surface(const std::string& name, const Read_surface_options& options, Surface_soup soup,
                  Surface& mesh, Surface_input& input);

/// Mends a sheet, or refuses.
void make_sheet(const std::string& name, const Read_surface_options& options, Surface_soup soup,
                Surface& mesh, Surface_input& input);

/// Makes a surface of what `soup()` returns, with one of the functions above.
template <class Soup, class Mesh>
bool make_surface_as(decltype(make_surface)& make, const Soup& soup, const std::string& name,
                     const Read_surface_options& options, Mesh& mesh, std::string* error,
                     Surface_input* input)
{
  Surface_input found;
  const bool is_success = is_read(name, error, [&] {
    Surface surface;
    make(name, options, soup(), surface, found);
    if constexpr(std::is_same_v<Mesh, Surface>) {
      mesh = std::move(surface);
    } else {
      clear(mesh);
      CGAL::copy_face_graph(surface, mesh);
    }
  });
  if(input != nullptr && is_success) {
    *input = std::move(found);
  } else if(input != nullptr) {
    input->wrap_diameter = found.wrap_diameter;
    input->weld_distance = found.weld_distance;
  }
  return is_success;
}

/// The points and polygons of arrays.
template <class Points, class Polygons>
Surface_soup soup_of(const Points& points, const Polygons& polygons)
{
  Surface_soup soup;
  for(const auto& p : points)
    soup.points.push_back({double(p[0]), double(p[1]), double(p[2])});
  for(const auto& polygon : polygons) {
    soup.polygons.emplace_back();
    for(const auto v : polygon)
      soup.polygons.back().push_back(vertex_index(v));
  }
  return soup;
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

Arrays compressed by zlib can be read if `CGAL_USE_ZLIB` is defined and zlib is linked. Coordinates are those
of the file; `read_anatomical_surface()` converts them to RAS, and reads formats of neuroimaging, too.

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
  return internal::make_surface_as(
    internal::make_surface, [&] { return internal::read_surface_file(path); }, path, options, mesh, error,
    input);
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
  return internal::make_surface_as(
    internal::make_surface, [&] { return internal::soup_of(points, polygons); }, name, options, mesh, error,
    input);
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
  return internal::make_surface_as(
    internal::make_sheet, [&] { return internal::read_surface_file(path); }, path, options, mesh, error,
    input);
}

/*!
\ingroup PkgMixedMesh3IO

Makes a sheet of arrays, as `read_sheet()` does of a file.

\param points,polygons,name,options,mesh,error,input parameters of `make_closed_surface()`
\return whether the sheet was made; if not, `mesh` is unchanged
*/
template <class Points, class Polygons, class Mesh>
[[nodiscard]] bool make_sheet(const Points& points, const Polygons& polygons, const std::string& name,
                              const Read_surface_options& options, Mesh& mesh, std::string* error = nullptr,
                              Surface_input* input = nullptr)
{
  return internal::make_surface_as(
    internal::make_sheet, [&] { return internal::soup_of(points, polygons); }, name, options, mesh, error,
    input);
}

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#ifndef CGAL_MIXED_MESH_3_COMPILED
#include <CGAL/Mixed_mesh_3/IO/internal/surface/read_surface_impl.h>
#endif

#endif // CGAL_MIXED_MESH_3_IO_READ_CLOSED_SURFACE_H
