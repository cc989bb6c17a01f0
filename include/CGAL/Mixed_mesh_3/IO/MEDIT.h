// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_MEDIT_H
#define CGAL_MIXED_MESH_3_IO_MEDIT_H

#include <CGAL/Mixed_mesh_3/IO/internal/Buffered_output.h>

#include <array>
#include <cstddef>
#include <ostream>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

/*!
\brief Writes a mesh in the format of Medit (`.mesh`), as text.

References: 1 for the elements in the region, 2 for the others, 3 for the boundary faces (which are
counter-clockwise seen from outside), 0 for the vertices.

\note Gmsh 4.8 drops prisms and pyramids when it reads this format.

\return whether the stream took everything.
*/
template <class Mesh>
bool write_MEDIT(std::ostream& stream, const Mesh& mesh)
{
  using namespace internal;
  Buffered_output out(stream);
  const auto write_line = [&out](const auto& vertices, int reference) {
    write_vertices(out, vertices, ' ');
    out << ' ' << reference << '\n';
  };

  // Version 2 means coordinates in double precision.
  out << "MeshVersionFormatted 2\n\nDimension\n3\n\nVertices\n" << mesh.number_of_vertices() << '\n';
  for(const auto& p : mesh.points()) {
    write_point(out, Mixed_meshes_3::to_vec3(p), " ");
    out << " 0\n";
  }

  for(int size : {3, 4}) {
    const std::size_t n = number_of_boundary_faces(mesh, size);
    if(n == 0)
      continue;
    out << (size == 3 ? "\nTriangles\n" : "\nQuadrilaterals\n") << n << '\n';
    for(const auto& face : mesh.boundary_faces()) {
      const Face_vertices vertices(mesh, face);
      if(vertices.size() == size)
        write_line(vertices, boundary_tag);
    }
  }

  const std::array<std::size_t, number_of_element_kinds> counts = mesh.elements().counts();
  for(Element_kind kind : element_kinds) {
    if(counts[kind] == 0)
      continue;
    out << '\n' << reference_elements[kind].medit_keyword << '\n' << counts[kind] << '\n';
    for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
      if(mesh.element(e).kind() == kind)
        write_line(mesh.element(e), mesh.is_in_region(e) ? region_tag : rest_tag);
  }
  out << "\nEnd\n";
  return out.finish();
}

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_MEDIT_H
