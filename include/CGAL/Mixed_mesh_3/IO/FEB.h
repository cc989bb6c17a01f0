// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_FEB_H
#define CGAL_MIXED_MESH_3_IO_FEB_H

#include <CGAL/Mixed_mesh_3/IO/internal/Buffered_output.h>

#include <cstddef>
#include <ostream>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

/*!
\brief Writes a mesh as model of FEBio (`.feb`), version 4.0.

The mesh: node set `all`, element sets such as `region_hex8` and `rest_tet4`, surface `boundary`
(counter-clockwise seen from outside). FEBio takes no mesh without materials: there are two, `region`
and `rest`, with numbers to be replaced (neo-Hookean, Young's modulus 1, Poisson's ratio 0.45).
There are no boundary conditions, loads or steps. The numbers of nodes and elements are the indices
plus 1.

\return whether the stream took everything.
*/
template <class Mesh>
bool write_FEB(std::ostream& stream, const Mesh& mesh)
{
  using namespace internal;
  const std::vector<Element_block> blocks = element_blocks(mesh);
  Buffered_output out(stream);
  const auto write_name = [&out](const Element_block& block) {
    out << block.part() << '_' << block.reference().febio_type;
  };

  out << "<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>\n"
      << "<febio_spec version=\"4.0\">\n"
      << "  <Module type=\"solid\"/>\n"
      << "  <Material>\n";
  int material = 0;
  for(const char* name : {"region", "rest"})
    out << "    <material id=\"" << ++material << "\" name=\"" << name
        << "\" type=\"neo-Hookean\">\n"
        << "      <density>1</density>\n      <E>1</E>\n      <v>0.45</v>\n    </material>\n";
  out << "  </Material>\n"
      << "  <Mesh>\n"
      << "    <Nodes name=\"all\">\n";
  for(std::size_t v = 0; v < mesh.number_of_vertices(); ++v) {
    out << "      <node id=\"" << v + 1 << "\">";
    write_point(out, Mixed_meshes_3::to_vec3(mesh.points()[v]), ",");
    out << "</node>\n";
  }
  out << "    </Nodes>\n";

  for(const Element_block& block : blocks) {
    out << "    <Elements type=\"" << block.reference().febio_type << "\" name=\"";
    write_name(block);
    out << "\">\n";
    for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
      if(block.has(mesh, e)) {
        out << "      <elem id=\"" << e + 1 << "\">";
        write_vertices(out, mesh.element(e), ',');
        out << "</elem>\n";
      }
    out << "    </Elements>\n";
  }

  // FEBio does not accept empty sections.
  if(!mesh.boundary_faces().empty()) {
    out << "    <Surface name=\"boundary\">\n";
    std::size_t number = 0;
    for(const auto& face : mesh.boundary_faces()) {
      const Face_vertices vertices(mesh, face);
      const char* const type = vertices.size() == 3 ? "tri3" : "quad4";
      out << "      <" << type << " id=\"" << ++number << "\">";
      write_vertices(out, vertices, ',');
      out << "</" << type << ">\n";
    }
    out << "    </Surface>\n";
  }

  out << "  </Mesh>\n"
      << "  <MeshDomains>\n";
  for(const Element_block& block : blocks) {
    out << "    <SolidDomain name=\"";
    write_name(block);
    out << "\" mat=\"" << block.part() << "\"/>\n";
  }
  out << "  </MeshDomains>\n"
      << "</febio_spec>\n";
  return out.finish();
}

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_FEB_H
