// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_READ_MIXED_MESH_H
#define CGAL_MIXED_MESH_3_IO_READ_MIXED_MESH_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/Subdomain_names.h>
#include <CGAL/Mixed_mesh_3/IO/internal/errors.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/Mesh_input.h>

#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

namespace internal {

/// The mesh of a file, with finite points, at least one element, and names that can be written; or refuses.
Mesh_input read_mesh_input(const std::string& file);

} // namespace internal

/*!
\ingroup PkgMixedMesh3IO

Reads a mesh, as the function below does, and the names of its subdomains: from VTK's and Gmsh's (4.1)
formats, as `write_mixed_mesh()` writes them. Names that `write_mixed_mesh()` would not write are left out.

\param file file name
\param mesh the result; unchanged if the file cannot be read or has no element
\param subdomain_names names that the file has
\param error if not null, receives then a line that names the file and the defect
\return whether the mesh was read
*/
template <class Mesh>
[[nodiscard]] bool read_mixed_mesh(const std::string& file, Mesh& mesh, Subdomain_names& subdomain_names,
                                   std::string* error = nullptr)
{
  return internal::is_read(file, error, [&] {
    internal::Mesh_input input = internal::read_mesh_input(file);
    std::vector<typename Mesh::Point_3> points;
    points.reserve(input.points.size());
    for(const auto& p : input.points)
      points.emplace_back(p[0], p[1], p[2]);
    Mesh result;
    result.assign(std::move(points), std::move(input.elements), std::move(input.attributes),
                  std::move(input.vertex_data), std::move(input.element_data));
    mesh = std::move(result);
    subdomain_names = std::move(input.subdomain_names);
  });
}

/*!
\ingroup PkgMixedMesh3IO

Reads a mesh of linear hexahedra, prisms, pyramids and tetrahedra, in the format of the extension.

| extension       | format |
|-----------------|--------|
| `.vtu`          | VTK unstructured grid: text, base64 or raw, in one or several pieces |
| `.msh`, `.msh2` | Gmsh 2.2 and 4.1, text or binary |
| `.mesh`         | Medit, text; what CGAL's Mesh_3 writes |
| `.ele`, `.node` | TetGen: two files of the same name |
| `.vol`          | Netgen |

Data of VTK that are compressed by zlib can be read if `CGAL_USE_ZLIB` is defined and zlib is linked.

A mesh that `write_mixed_mesh()` writes in these formats is read back as it was, except vertices that are on
no element and no boundary face, which `write_mixed_mesh()` does not write to Gmsh 4.1. All vertices in the
file are kept, and none are merged: vertices and elements have the order of the file or, in Gmsh's formats, of
the numbers that the file gives them. Elements of lower dimension are skipped. An element is in the region if
the cell data `in_region` (VTK) are not 0, or if the number of its elementary entity says so (Gmsh, see
`write_MSH()`). The cell data `subdomain` (VTK) and the number of the physical volume (Gmsh) are the
subdomain, a positive integer; without them the subdomain is 1. Physical volumes with names such as "region"
and "subdomain_2_rest" are these parts of subdomains. The subdomain in the other formats is the reference
(Medit), the first attribute (TetGen) or the material (Netgen), and no element is in the region.
`write_mixed_mesh()` sorts the elements of a `.vtu` file by kind.

All other arrays of numbers at points and cells (VTK) become columns of `Mixed_mesh_3::vertex_data()` and
`Mixed_mesh_3::element_data()`, but those that `write_VTU()` makes of the mesh itself and of facet sets, and,
of a file of several pieces, those that some pieces do not have. Integers become doubles.

The file is checked, and coordinates are finite and at most 1e30, but the mesh is not checked: elements may be
inverted, or not fit together; see `find_defects()`.

\tparam Mesh a `Mixed_mesh_3`
\param file file name
\param mesh the result; unchanged if the file cannot be read or has no element
\param error if not null, receives then a line that names the file and the defect
\return whether the mesh was read
\par Complexity
O(n log n); memory for the file and twice the mesh
*/
template <class Mesh>
[[nodiscard]] bool read_mixed_mesh(const std::string& file, Mesh& mesh, std::string* error = nullptr)
{
  Subdomain_names names;
  return read_mixed_mesh(file, mesh, names, error);
}

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#ifndef CGAL_MIXED_MESH_3_COMPILED
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/read_mixed_mesh_impl.h>
#endif

#endif // CGAL_MIXED_MESH_3_IO_READ_MIXED_MESH_H
