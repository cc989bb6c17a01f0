// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_FEB_H
#define CGAL_MIXED_MESH_3_IO_FEB_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/Data_array.h>
#include <CGAL/Mixed_mesh_3/IO/Facet_set.h>
#include <CGAL/Mixed_mesh_3/IO/internal/Buffered_output.h>
#include <CGAL/Mixed_mesh_3/IO/internal/Element_blocks.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>

#include <algorithm>
#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

namespace internal {

// FEBio does not accept empty sections.
inline void write_FEB_surface(Buffered_output& out, const std::string& name, const std::vector<Face>& faces)
{
  if(faces.empty())
    return;
  out << "    <Surface name=\"" << name << "\">\n";
  std::size_t number = 0;
  for(const Face& face : faces) {
    const char* const type = face.vertices().size() == 3 ? "tri3" : "quad4";
    out << "      <" << type << " id=\"" << ++number << "\">";
    write_vertices(out, face.vertices(), ',');
    out << "</" << type << ">\n";
  }
  out << "    </Surface>\n";
}

inline void write_FEB_node_data(Buffered_output& out, const Data_array& data, std::size_t n)
{
  const std::size_t components = std::size_t(data.number_of_components);
  out << "    <NodeData name=\"" << escaped_for_XML(data.name) << "\" node_set=\"all\" data_type=\""
      << (components == 3 ? "vec3" : "scalar") << "\">\n";
  for(std::size_t v = 0; v < n; ++v) {
    out << "      <node lid=\"" << v + 1 << "\">";
    for(std::size_t i = 0; i < components; ++i)
      out << (i == 0 ? "" : ",") << (*data.values)[v * components + i];
    out << "</node>\n";
  }
  out << "    </NodeData>\n";
}

} // namespace internal

/*!
\ingroup PkgMixedMesh3IO

\brief Writes a mesh as model of FEBio (`.feb`), version 4.0.

The mesh: node set `all`, element sets such as `region_hex8` and `rest_tet4` (of other subdomains than 1
`subdomain_2_rest_tet4` and so on), surface `boundary` (counter-clockwise seen from outside) and a surface for
each facet set, and an element set for each subdomain with a name, with these names. FEBio takes no
mesh without materials: there are `region` and `rest`, and those of other subdomains, with numbers to be
replaced (neo-Hookean, Young's modulus 1, Poisson's ratio 0.45). There are no boundary conditions, loads or
steps. The numbers of nodes and elements are the indices plus 1.

Values at the vertices become mesh data, `NodeData` on the set `all`, which a prescribed displacement of the
model can refer to, for example.

\param stream the stream
\param mesh the mesh
\param facet_sets named faces
\param vertex_data of one or three components, as many as vertices
\param subdomain_names of those that have one

\return whether the stream took everything.
*/
template <class Mesh>
bool write_FEB(std::ostream& stream, const Mesh& mesh, const std::vector<Facet_set>& facet_sets = {},
               const std::vector<Data_array>& vertex_data = {}, const Subdomain_names& subdomain_names = {})
{
  using namespace internal;
  const Element_blocks blocks(mesh);
  Buffered_output out(stream);
  const auto name = [&blocks](const Element_block& block) {
    return blocks.parts()[block.part].name() + '_' + block.names().febio_type;
  };

  out << "<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>\n"
      << "<febio_spec version=\"4.0\">\n"
      << "  <Module type=\"solid\"/>\n"
      << "  <Material>\n";
  int material = 0;
  std::vector<std::string> materials{"region", "rest"};
  for(const Part& part : blocks.parts())
    if(part.attributes.subdomain_index != 1)
      materials.push_back(part.name());
  for(const std::string& name : materials)
    out << "    <material id=\"" << ++material << "\" name=\"" << name << "\" type=\"neo-Hookean\">\n"
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
    out << "    <Elements type=\"" << block.names().febio_type << "\" name=\"" << name(block) << "\">\n";
    for(Element_index e : block) {
      out << "      <elem id=\"" << e + 1 << "\">";
      write_vertices(out, mesh.element(e), ',');
      out << "</elem>\n";
    }
    out << "    </Elements>\n";
  }

  for(const auto& [name, parts] : blocks.named_parts(subdomain_names)) {
    out << "    <ElementSet name=\"" << name << "\">";
    bool is_first = true;
    for(const Element_block& block : blocks)
      if(std::count(parts.begin(), parts.end(), block.part) != 0)
        for(Element_index e : block) {
          out << (is_first ? "" : ",") << e + 1;
          is_first = false;
        }
    out << "</ElementSet>\n";
  }
  write_FEB_surface(out, "boundary", boundary_faces(mesh));
  for(const Facet_set& set : facet_sets)
    write_FEB_surface(out, set.name, set.faces);

  out << "  </Mesh>\n"
      << "  <MeshDomains>\n";
  for(const Element_block& block : blocks) {
    out << "    <SolidDomain name=\"" << name(block) << "\" mat=\"" << blocks.parts()[block.part].name()
        << "\"/>\n";
  }
  out << "  </MeshDomains>\n";
  if(!mesh.is_empty() && !vertex_data.empty()) {
    out << "  <MeshData>\n";
    for(const Data_array& data : vertex_data)
      write_FEB_node_data(out, data, mesh.number_of_vertices());
    out << "  </MeshData>\n";
  }
  out << "</febio_spec>\n";
  return out.finish();
}

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_FEB_H
