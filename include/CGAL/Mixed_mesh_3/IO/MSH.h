// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_MSH_H
#define CGAL_MIXED_MESH_3_IO_MSH_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/Data_array.h>
#include <CGAL/Mixed_mesh_3/IO/internal/Buffered_output.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/Element_blocks.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/Mesh_nodes.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/facet_sets.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

/// \ingroup PkgMixedMesh3IO
/// Version of the format of Gmsh.
enum class MSH_version {
  V2_2, ///< of Gmsh 2 and 3
  V4_1  ///< of Gmsh 4
};

namespace internal {

// A physical group: the boundary, a facet set or a subdomain.
struct MSH_group
{
  std::string name;
  int dimension;
  int tag;
  bool is_empty = true;
};

// Gmsh wants each mesh vertex and element on one entity of a model, which is in physical groups.
struct MSH_entity
{
  int dimension;
  int tag;
  std::vector<int> groups; // tags
  std::size_t number_of_elements = 0;
  std::size_t number_of_vertices = 0; // those on no entity listed before
  std::set<int> surfaces = {};        // of a volume: tags of those with boundary faces of its elements
  Mixed_meshes_3::Vec3 lower{}, upper{};
};

class MSH_model
{
  static constexpr std::size_t no_entity = std::size_t(-1);
  std::vector<MSH_group> m_groups;
  std::vector<MSH_entity> m_entities; // patches of faces, the boundary first, then the parts
  std::vector<std::size_t> m_vertex_entity;
  Element_blocks m_blocks;
  int m_boundary_tag;
  Face_patches m_patches;

  // The first of several numbers that no subdomain has: programs such as GetDP do not distinguish surfaces
  // and volumes by number.
  static int first_of_free_tags(const Element_blocks& blocks, std::size_t count)
  {
    std::int64_t first = boundary_tag;
    for(Subdomain_index s : blocks.subdomains())
      if(s < first + std::int64_t(count))
        first = (std::max)(first, std::int64_t(s) + 1);
    return int(first);
  }

  // An entity's box has all its vertices, but each vertex is on the first entity only.
  template <class Mesh>
  void add(const Mesh_nodes<Mesh>& nodes, std::size_t entity, const Node_list& of_element)
  {
    MSH_entity& e = m_entities[entity];
    for(Vertex_index v : of_element) {
      const auto p = nodes.point(v);
      const bool is_first = e.number_of_elements == 0 && v == *of_element.begin();
      for(int i = 0; i < 3; ++i) {
        e.lower[i] = is_first ? p[i] : (std::min)(e.lower[i], p[i]);
        e.upper[i] = is_first ? p[i] : (std::max)(e.upper[i], p[i]);
      }
      m_vertex_entity[v] = (std::min)(m_vertex_entity[v], entity);
    }
    ++e.number_of_elements;
  }

  void add_groups(const std::vector<Facet_set>& facet_sets, const Subdomain_names& subdomain_names)
  {
    m_groups.push_back({"boundary", 2, m_boundary_tag});
    for(Subdomain_index s : m_blocks.subdomains()) {
      const auto named = subdomain_names.find(s);
      m_groups.push_back(
        {named != subdomain_names.end() ? named->second : "subdomain_" + std::to_string(s), 3, s});
    }
    for(std::size_t set = 0; set < facet_sets.size(); ++set)
      m_groups.push_back({facet_sets[set].name, 2, m_patches.set_tag(set)});
    for(MSH_group& group : m_groups)
      for(const MSH_entity& e : m_entities)
        if(e.number_of_elements != 0 && std::count(e.groups.begin(), e.groups.end(), group.tag) != 0)
          group.is_empty = false;
  }

public:
  // \param has_one_number whether a face can be in one group only: Gmsh 2.2
  template <class Mesh>
  MSH_model(const Mesh& mesh, const Mesh_nodes<Mesh>& nodes, const std::vector<Facet_set>& facet_sets,
            bool has_one_number, const Subdomain_names& subdomain_names)
    : m_vertex_entity(nodes.size(), no_entity), m_blocks(mesh),
      m_boundary_tag(first_of_free_tags(m_blocks, 1 + facet_sets.size())),
      m_patches(mesh, facet_sets, m_boundary_tag, m_boundary_tag + 1)
  {
    const std::vector<Face_patch>& patches = m_patches.patches();
    for(std::size_t i = 0; i < patches.size(); ++i) {
      std::vector<int> groups;
      for(std::size_t set : patches[i].sets)
        groups.push_back(m_patches.set_tag(set));
      if(patches[i].is_on_boundary)
        groups.push_back(m_boundary_tag);
      if(has_one_number)
        groups.resize(1);
      m_entities.push_back({2, m_patches.tag(i), groups});
    }
    std::vector<std::size_t> entity_of(mesh.number_of_elements());
    for(const Part& part : m_blocks.parts())
      m_entities.push_back({3, MSH_entity_tag(part.attributes), {part.attributes.subdomain_index}});
    for(const Element_block& block : m_blocks)
      for(Element_index e : block)
        entity_of[e] = patches.size() + block.part;
    for(std::size_t i = 0; i < faces().size(); ++i) {
      const std::size_t patch = m_patches.patch_of(i);
      add(nodes, patch, nodes.of(faces()[i]));
      if(patches[patch].is_on_boundary)
        m_entities[entity_of[faces()[i].element()]].surfaces.insert(m_patches.tag(patch));
    }
    for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
      add(nodes, entity_of[e], nodes.of(e, &Element_names::gmsh_edges));
    add_groups(facet_sets, subdomain_names);
    for(std::size_t entity : m_vertex_entity)
      if(entity != no_entity)
        ++m_entities[entity].number_of_vertices;
  }

  const std::vector<MSH_group>& groups() const { return m_groups; }
  const std::vector<MSH_entity>& entities() const { return m_entities; }
  const MSH_entity& entity_of_face(std::size_t i) const { return m_entities[m_patches.patch_of(i)]; }
  bool is_vertex_used(std::size_t v) const { return m_vertex_entity[v] != no_entity; }
  bool is_vertex_on(std::size_t v, std::size_t entity) const { return m_vertex_entity[v] == entity; }
  const Element_blocks& blocks() const { return m_blocks; }
  const MSH_entity& entity_of(const Element_block& block) const
  {
    return m_entities[m_patches.patches().size() + block.part];
  }
  // The boundary faces, then others of facet sets.
  const std::vector<Face>& faces() const { return m_patches.faces(); }
};

inline void write_MSH_physical_names(Buffered_output& out, const MSH_model& model)
{
  int n = 0;
  for(const MSH_group& group : model.groups())
    n += !group.is_empty;
  out << "$PhysicalNames\n" << n << '\n';
  for(const MSH_group& group : model.groups())
    if(!group.is_empty)
      out << group.dimension << ' ' << group.tag << " \"" << group.name << "\"\n";
  out << "$EndPhysicalNames\n";
}

inline void write_MSH_entities(Buffered_output& out, const MSH_model& model)
{
  std::size_t counts[] = {0, 0}; // surfaces, volumes
  for(const MSH_entity& e : model.entities())
    counts[e.dimension - 2] += e.number_of_elements != 0;
  out << "$Entities\n0 0 " << counts[0] << ' ' << counts[1] << '\n';
  for(const MSH_entity& e : model.entities())
    if(e.number_of_elements != 0) {
      out << e.tag << ' ';
      write_point(out, e.lower, " ");
      out << ' ';
      write_point(out, e.upper, " ");
      out << ' ' << e.groups.size();
      for(int group : e.groups)
        out << ' ' << group;
      out << ' ' << e.surfaces.size();
      for(int surface : e.surfaces)
        out << ' ' << surface;
      out << '\n';
    }
  out << "$EndEntities\n";
}

template <class Mesh>
void write_MSH_4_1_nodes(Buffered_output& out, const Mesh_nodes<Mesh>& nodes, const MSH_model& model)
{
  std::size_t blocks = 0, vertices = 0;
  for(const MSH_entity& e : model.entities()) {
    blocks += e.number_of_vertices != 0;
    vertices += e.number_of_vertices;
  }
  const std::size_t n = nodes.size();
  out << "$Nodes\n" << blocks << ' ' << vertices << " 1 " << n << '\n';
  for(std::size_t i = 0; i < model.entities().size(); ++i) {
    const MSH_entity& e = model.entities()[i];
    if(e.number_of_vertices == 0)
      continue;
    out << e.dimension << ' ' << e.tag << " 0 " << e.number_of_vertices << '\n';
    for(std::size_t v = 0; v < n; ++v)
      if(model.is_vertex_on(v, i))
        out << v + 1 << '\n';
    for(std::size_t v = 0; v < n; ++v)
      if(model.is_vertex_on(v, i)) {
        write_point(out, nodes.point(v), " ");
        out << '\n';
      }
  }
  out << "$EndNodes\n";
}

template <class Mesh>
void write_MSH_4_1_elements(Buffered_output& out, const Mesh& mesh, const Mesh_nodes<Mesh>& nodes,
                            const MSH_model& model)
{
  std::map<std::pair<int, int>, std::vector<std::size_t>> faces; // by surface and size
  for(std::size_t i = 0; i < model.faces().size(); ++i)
    faces[{model.entity_of_face(i).tag, model.faces()[i].vertices().size()}].push_back(i);
  const std::size_t m = mesh.number_of_elements(), total = m + model.faces().size();
  out << "$Elements\n"
      << model.blocks().blocks().size() + faces.size() << ' ' << total << " 1 " << total << '\n';
  for(const Element_block& block : model.blocks()) {
    out << "3 " << model.entity_of(block).tag << ' ' << nodes.names(block.kind).gmsh_type << ' '
        << block.size() << '\n';
    for(Element_index e : block) {
      out << e + 1 << ' ';
      write_vertices(out, nodes.of(e, &Element_names::gmsh_edges), ' ');
      out << '\n';
    }
  }
  for(const auto& [key, of] : faces) {
    out << "2 " << key.first << ' ' << gmsh_face_type(key.second, nodes.order()) << ' ' << of.size() << '\n';
    for(std::size_t i : of) {
      out << m + 1 + i << ' ';
      write_vertices(out, nodes.of(model.faces()[i]), ' ');
      out << '\n';
    }
  }
  out << "$EndElements\n";
}

template <class Mesh>
void write_MSH_2_2_nodes_and_elements(Buffered_output& out, const Mesh& mesh, const Mesh_nodes<Mesh>& nodes,
                                      const MSH_model& model)
{
  const auto write_element = [&out](std::size_t number, int type, const MSH_entity& entity,
                                    const Node_list& of_element) {
    out << number << ' ' << type << " 2 " << entity.groups.front() << ' ' << entity.tag << ' ';
    write_vertices(out, of_element, ' ');
    out << '\n';
  };

  out << "$Nodes\n" << nodes.size() << '\n';
  for(std::size_t v = 0; v < nodes.size(); ++v) {
    out << v + 1 << ' ';
    write_point(out, nodes.point(v), " ");
    out << '\n';
  }
  out << "$EndNodes\n$Elements\n" << mesh.number_of_elements() + model.faces().size() << '\n';
  for(const Element_block& block : model.blocks())
    for(Element_index e : block)
      write_element(e + 1, nodes.names(block.kind).gmsh_type, model.entity_of(block),
                    nodes.of(e, &Element_names::gmsh_edges));
  for(std::size_t i = 0; i < model.faces().size(); ++i) {
    const Face& face = model.faces()[i];
    write_element(mesh.number_of_elements() + 1 + i, gmsh_face_type(face.vertices().size(), nodes.order()),
                  model.entity_of_face(i), nodes.of(face));
  }
  out << "$EndElements\n";
}

// A view of Gmsh, at time 0. Version 4.1 has no vertices without an element.
inline void write_MSH_node_data(Buffered_output& out, const Data_array& data, std::size_t number_of_nodes,
                                const MSH_model& model, MSH_version version)
{
  const auto is_written = [&](std::size_t v) {
    return version == MSH_version::V2_2 || model.is_vertex_used(v);
  };
  std::size_t n = 0;
  for(std::size_t v = 0; v < number_of_nodes; ++v)
    n += is_written(v);
  const std::size_t components = std::size_t(data.number_of_components);
  out << "$NodeData\n1\n\"" << data.name << "\"\n1\n0\n3\n0\n" << components << '\n' << n << '\n';
  for(std::size_t v = 0; v < number_of_nodes; ++v)
    if(is_written(v)) {
      out << v + 1;
      for(std::size_t i = 0; i < components; ++i)
        out << ' ' << (*data.values)[v * components + i];
      out << '\n';
    }
  out << "$EndNodeData\n";
}

} // namespace internal

/*!
\ingroup PkgMixedMesh3IO

\brief Writes a mesh in the format of Gmsh, as text.

Physical groups: a volume for each subdomain, with its index as number, and its name, or "subdomain_1" and so
on; and the surface "boundary" for the boundary faces, counter-clockwise seen from outside. Its number is 3,
or the next one that is free where that is a subdomain's. The volume of a subdomain has up to two elementary
entities, the elements in the region and the others: that of the others has the number of the subdomain, that
of the region 1,000,000,000 more, by which `read_mixed_mesh()` knows the region. The numbers of vertices and
elements are the indices plus 1; boundary faces are numbered after the elements. Elements are written by
entity and kind.

The surfaces of facet sets have their names, and the numbers after that of the boundary. Each face is written
once. In version 4.1 a boundary face of sets is in their groups and in "boundary"; in 2.2, where it can be in
one group only, it is in that of its first set, and "boundary" is what is left. The nodes of a set are those
of its faces.

Values at the vertices become views, at time 0.

Quadratic elements, of order 2, are Gmsh's serendipity ones: types 11, 19, 18 and 17, with 10, 13, 15 and 20
nodes, and faces 9 and 16. Those with 14, 18 and 27 nodes have some in faces and within, which FEBio's and
Abaqus's lack.

\param stream the stream
\param mesh the mesh
\param version of the format
\param facet_sets named faces
\param vertex_data of one or three components, as many as vertices; names without quotes
\param subdomain_names of those that have one
\param order of the elements, 1 or 2: see `Write_options::order`

\return whether the stream took everything.
*/
template <class Mesh>
bool write_MSH(std::ostream& stream, const Mesh& mesh, MSH_version version = MSH_version::V4_1,
               const std::vector<Facet_set>& facet_sets = {}, const std::vector<Data_array>& vertex_data = {},
               const Subdomain_names& subdomain_names = {}, int order = 1)
{
  using namespace internal;
  const Mesh_nodes<Mesh> nodes(mesh, order);
  const MSH_model model(mesh, nodes, facet_sets, version == MSH_version::V2_2, subdomain_names);
  Buffered_output out(stream);
  out << "$MeshFormat\n" << (version == MSH_version::V4_1 ? "4.1" : "2.2") << " 0 8\n$EndMeshFormat\n";
  write_MSH_physical_names(out, model);
  if(version == MSH_version::V4_1) {
    write_MSH_entities(out, model);
    write_MSH_4_1_nodes(out, nodes, model);
    write_MSH_4_1_elements(out, mesh, nodes, model);
  } else {
    write_MSH_2_2_nodes_and_elements(out, mesh, nodes, model);
  }
  const Node_data node_data(nodes, vertex_data);
  for(const Data_array& data : node_data.arrays())
    write_MSH_node_data(out, data, nodes.size(), model, version);
  return out.finish();
}

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_MSH_H
