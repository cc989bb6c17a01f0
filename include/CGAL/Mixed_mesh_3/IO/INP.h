// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_INP_H
#define CGAL_MIXED_MESH_3_IO_INP_H

#include <CGAL/Mixed_mesh_3/IO/internal/Buffered_output.h>
#include <CGAL/Mixed_mesh_3/IO/internal/Element_blocks.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>

#include <cstddef>
#include <ostream>
#include <string>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

/*!
\brief Writes a mesh as input of Abaqus (`.inp`): nodes, elements and sets, no analysis.

Element sets: `REGION` and `REST` for the elements of subdomain 1 in the region and the others,
`SUBDOMAIN_2_REGION` and so on for those of other subdomains, each made of one set for each type, such as
`REGION_C3D8`. Node set: `BOUNDARY`, the vertices of the boundary faces. The
numbers of nodes and elements are the indices plus 1.

\note CalculiX has no pyramids, and Gmsh 4.8 drops them when it reads this format: see
`split_to_tetrahedra()`.

\return whether the stream took everything.
*/
template <class Mesh>
bool write_INP(std::ostream& stream, const Mesh& mesh)
{
  using namespace internal;
  const Element_blocks blocks(mesh);
  const auto set_name = [&blocks](std::size_t part) {
    std::string name = blocks.parts()[part].name();
    for(char& c : name)
      c = c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : c;
    return name;
  };

  Buffered_output out(stream);
  out << "*HEADING\nMixed-element mesh written by Mixed_mesh_3\n*NODE\n";
  for(std::size_t v = 0; v < mesh.number_of_vertices(); ++v) {
    out << v + 1 << ", ";
    write_point(out, Mixed_meshes_3::to_vec3(mesh.points()[v]), ", ");
    out << '\n';
  }

  for(const Element_block& block : blocks) {
    out << "*ELEMENT, TYPE=" << block.names().abaqus_type << ", ELSET=" << set_name(block.part) << '_'
        << block.names().abaqus_type << '\n';
    for(Element_index e : block) {
      out << e + 1 << ',';
      write_vertices(out, mesh.element(e), ',');
      out << '\n';
    }
  }

  // A set of sets: no second list of all elements.
  for(std::size_t part = 0; part < blocks.parts().size(); ++part) {
    out << "*ELSET, ELSET=" << set_name(part) << '\n';
    for(const Element_block& block : blocks)
      if(block.part == part)
        out << set_name(part) << '_' << block.names().abaqus_type << '\n';
  }

  int on_line = 0;
  for(Vertex_index v : boundary_vertices(mesh)) {
    // Abaqus allows 16 numbers on a line.
    out << (on_line == 0 ? "*NSET, NSET=BOUNDARY\n" : on_line % 16 == 0 ? ",\n" : ", ") << v + 1;
    ++on_line;
  }
  if(on_line != 0)
    out << '\n';
  return out.finish();
}

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INP_H
