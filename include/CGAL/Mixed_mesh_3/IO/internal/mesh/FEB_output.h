// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What meshes and models of FEBio have in common: the sections of the mesh, and who has which material.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_FEB_OUTPUT_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_FEB_OUTPUT_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_attributes.h>
#include <CGAL/Mixed_mesh_3/Face.h>
#include <CGAL/Mixed_mesh_3/IO/Data_array.h>
#include <CGAL/Mixed_mesh_3/IO/Facet_set.h>
#include <CGAL/Mixed_mesh_3/IO/Subdomain_names.h>
#include <CGAL/Mixed_mesh_3/IO/internal/Buffered_output.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/Element_blocks.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/Mesh_nodes.h>
#include <CGAL/Mixed_mesh_3/Index.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

struct FEB_node_set
{
  std::string name;
  std::vector<Vertex_index> vertices;
};

/// Values of the vertices of a node set, in its order.
struct FEB_node_data
{
  Data_array data;
  std::string node_set;
};

/// The sections that a mesh makes, in the order in which FEBio wants them.
template <class Mesh>
class FEB_output
{
  const Mesh& m_mesh;
  Mesh_nodes<Mesh> m_nodes;
  const Subdomain_names& m_names;
  Element_blocks m_blocks;

public:
  /// Keeps references.
  /// \param order of the elements
  FEB_output(const Mesh& mesh, const Subdomain_names& names, int order = 1)
    : m_mesh(mesh), m_nodes(mesh, order), m_names(names), m_blocks(mesh)
  {
  }

  const Element_blocks& blocks() const { return m_blocks; }
  const Mesh_nodes<Mesh>& nodes() const { return m_nodes; }

  Subdomain_index subdomain(const Element_block& block) const
  {
    return m_blocks.parts()[block.part].attributes.subdomain_index;
  }

  /// The part's, in FEBio's sense: it is also the name of an element set. The dot is in no name of a
  /// subdomain; so these names are different from those.
  std::string name(const Element_block& block) const
  {
    const Part& part = m_blocks.parts()[block.part];
    const char* const side = m_names.count(part.attributes.subdomain_index) == 0 ? ""
                             : part.attributes.is_in_region                      ? ".region"
                                                                                 : ".rest";
    return material_name(part) + side + '_' + m_nodes.names(block.kind).febio_type;
  }

  void write_head(Buffered_output& out) const
  {
    out << "<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>\n"
        << "<febio_spec version=\"4.0\">\n"
        << "  <Module type=\"solid\"/>\n";
  }

  void write_foot(Buffered_output& out) const { out << "</febio_spec>\n"; }

  /// \param write `void(Subdomain_index)`, writes type and parameters of a material
  template <class Write>
  void write_materials(Buffered_output& out, const Write& write) const
  {
    std::vector<std::pair<std::string, Subdomain_index>> materials;
    if(m_names.count(1) == 0) // there, even if nothing has them: FEBio wants some
      materials = {{"region", 1}, {"rest", 1}};
    for(const Part& part : m_blocks.parts()) {
      std::pair<std::string, Subdomain_index> material(material_name(part), part.attributes.subdomain_index);
      if(std::find(materials.begin(), materials.end(), material) == materials.end())
        materials.push_back(std::move(material));
    }
    if(materials.empty())
      materials = {{m_names.at(1), 1}};
    out << "  <Material>\n";
    int number = 0;
    for(const auto& [name, subdomain] : materials) {
      out << "    <material id=\"" << ++number << "\" name=\"" << name << "\" ";
      write(subdomain);
      out << "    </material>\n";
    }
    out << "  </Material>\n";
  }

  /// FEBio does not accept empty sections: sets without vertices or faces are not written.
  void write_mesh(Buffered_output& out, const std::vector<FEB_node_set>& node_sets,
                  const std::vector<Facet_set>& facet_sets) const
  {
    out << "  <Mesh>\n"
        << "    <Nodes name=\"all\">\n";
    for(std::size_t node = 0; node < m_nodes.size(); ++node) {
      out << "      <node id=\"" << node + 1 << "\">";
      write_point(out, m_nodes.point(node), ",");
      out << "</node>\n";
    }
    out << "    </Nodes>\n";
    for(const Element_block& block : m_blocks)
      write_block(out, block);
    for(const FEB_node_set& set : node_sets)
      if(!set.vertices.empty()) {
        out << "    <NodeSet name=\"" << set.name << "\">";
        write_vertices(out, set.vertices, ',');
        out << "</NodeSet>\n";
      }
    for(const auto& [name, parts] : m_blocks.named_parts(m_names))
      write_element_set(out, name, parts);
    write_surface(out, "boundary", boundary_faces(m_mesh));
    for(const Facet_set& set : facet_sets)
      write_surface(out, set.name, set.faces);
    out << "  </Mesh>\n"
        << "  <MeshDomains>\n";
    for(const Element_block& block : m_blocks)
      out << "    <SolidDomain name=\"" << name(block) << "\" mat=\""
          << material_name(m_blocks.parts()[block.part]) << "\"/>\n";
    out << "  </MeshDomains>\n";
  }

  /// Data without values are not written.
  void write_node_data(Buffered_output& out, const std::vector<FEB_node_data>& data) const
  {
    const auto has_values = [](const FEB_node_data& d) { return !d.data.values->empty(); };
    if(std::none_of(data.begin(), data.end(), has_values))
      return;
    out << "  <MeshData>\n";
    for(const FEB_node_data& d : data)
      if(has_values(d))
        write_values(out, d);
    out << "  </MeshData>\n";
  }

private:
  // One for all of a subdomain that has a name: it is what the material is called by.
  std::string material_name(const Part& part) const
  {
    const auto named = m_names.find(part.attributes.subdomain_index);
    return named == m_names.end() ? part.name() : named->second;
  }

  void write_block(Buffered_output& out, const Element_block& block) const
  {
    out << "    <Elements type=\"" << m_nodes.names(block.kind).febio_type << "\" name=\"" << name(block)
        << "\">\n";
    for(Element_index e : block) {
      out << "      <elem id=\"" << e + 1 << "\">";
      write_vertices(out, m_nodes.of(e, &Element_names::abaqus_edges), ',');
      out << "</elem>\n";
    }
    out << "    </Elements>\n";
  }

  void write_element_set(Buffered_output& out, const std::string& name,
                         const std::vector<std::size_t>& parts) const
  {
    out << "    <ElementSet name=\"" << name << "\">";
    bool is_first = true;
    for(const Element_block& block : m_blocks)
      if(std::count(parts.begin(), parts.end(), block.part) != 0)
        for(Element_index e : block) {
          out << (is_first ? "" : ",") << e + 1;
          is_first = false;
        }
    out << "</ElementSet>\n";
  }

  void write_surface(Buffered_output& out, const std::string& name, const std::vector<Face>& faces) const
  {
    if(faces.empty())
      return;
    out << "    <Surface name=\"" << name << "\">\n";
    std::size_t number = 0;
    for(const Face& face : faces) {
      const char* const type = febio_face_type(face.vertices().size(), m_nodes.order());
      out << "      <" << type << " id=\"" << ++number << "\">";
      write_vertices(out, m_nodes.of(face), ',');
      out << "</" << type << ">\n";
    }
    out << "    </Surface>\n";
  }

  static void write_values(Buffered_output& out, const FEB_node_data& d)
  {
    const std::vector<double>& values = *d.data.values;
    const std::size_t components = std::size_t(d.data.number_of_components);
    out << "    <NodeData name=\"" << escaped_for_XML(d.data.name) << "\" node_set=\"" << d.node_set
        << "\" data_type=\"" << (components == 3 ? "vec3" : "scalar") << "\">\n";
    for(std::size_t v = 0; v * components < values.size(); ++v) {
      out << "      <node lid=\"" << v + 1 << "\">";
      for(std::size_t i = 0; i < components; ++i)
        out << (i == 0 ? "" : ",") << values[v * components + i];
      out << "</node>\n";
    }
    out << "    </NodeData>\n";
  }
};

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_FEB_OUTPUT_H
