// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_MEDIT_H
#define CGAL_MIXED_MESH_3_IO_MEDIT_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/internal/Buffered_output.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/Element_blocks.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/facet_sets.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <ostream>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

/*!
\ingroup PkgMixedMesh3IO

\brief Writes a mesh in the format of Medit (`.mesh`), as text.

References: of subdomain 1, 1 for the elements in the region and 2 for the others; 3 for the boundary faces
(which are counter-clockwise seen from outside); from 4 on the references of other subdomains, as they occur;
0 for the vertices. The numbers of facet sets follow, in their order; a face of several sets has the number of
the first one.

\note Gmsh 4.8 drops prisms and pyramids when it reads this format.

\return whether the stream took everything.
*/
template <class Mesh>
bool write_MEDIT(std::ostream& stream, const Mesh& mesh, const std::vector<Facet_set>& facet_sets = {})
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

  const Element_blocks blocks(mesh);
  const Face_patches patches(mesh, facet_sets, boundary_tag, blocks.first_free_tag());
  const std::vector<Face>& faces = patches.faces();
  for(int size : {3, 4}) {
    const auto has_size = [size](const Face& face) { return face.vertices().size() == size; };
    const std::ptrdiff_t n = std::count_if(faces.begin(), faces.end(), has_size);
    if(n == 0)
      continue;
    out << (size == 3 ? "\nTriangles\n" : "\nQuadrilaterals\n") << n << '\n';
    for(std::size_t i = 0; i < faces.size(); ++i)
      if(has_size(faces[i]))
        write_line(faces[i].vertices(), patches.only_tag(i));
  }

  std::vector<int> tags(mesh.number_of_elements());
  for(const Element_block& block : blocks)
    for(Element_index e : block)
      tags[e] = blocks.tag(block.part);
  const std::array<std::size_t, number_of_element_kinds> counts = mesh.elements().counts();
  for(Element_kind kind : element_kinds) {
    if(counts[kind] == 0)
      continue;
    out << '\n' << element_names[kind].medit_keyword << '\n' << counts[kind] << '\n';
    for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
      if(mesh.element(e).kind() == kind)
        write_line(mesh.element(e), tags[e]);
  }
  out << "\nEnd\n";
  return out.finish();
}

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_MEDIT_H
