// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_MSH_H
#define CGAL_MIXED_MESH_3_IO_MSH_H

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

/// Version of the format of Gmsh.
enum class MSH_version { V2_2, V4_1 };

namespace internal {

// Gmsh wants each mesh vertex and element on an entity of a model, here also a physical group.
struct MSH_entity
{
  std::string name;
  int dimension;
  int tag;
  std::size_t number_of_elements = 0;
  std::size_t number_of_vertices = 0; // those on no entity listed before
  bool is_on_boundary = false;        // a volume with boundary faces
  Mixed_meshes_3::Vec3 lower{}, upper{};
};

inline int gmsh_face_type(int size) { return size == 3 ? 2 : 3; }

class MSH_model
{
  static constexpr std::size_t no_entity = std::size_t(-1);
  std::vector<MSH_entity> m_entities; // the boundary, then the parts
  std::vector<std::size_t> m_vertex_entity;
  Element_blocks m_blocks;
  std::vector<Face> m_boundary_faces;

  // An entity's box has all its vertices, but each vertex is on the first entity only.
  template <class Mesh, class Vertices>
  void add(const Mesh& mesh, std::size_t entity, const Vertices& vertices)
  {
    MSH_entity& e = m_entities[entity];
    for(Vertex_index v : vertices) {
      const auto p = Mixed_meshes_3::to_vec3(mesh.point(v));
      const bool is_first = e.number_of_elements == 0 && v == *vertices.begin();
      for(int i = 0; i < 3; ++i) {
        e.lower[i] = is_first ? p[i] : (std::min)(e.lower[i], p[i]);
        e.upper[i] = is_first ? p[i] : (std::max)(e.upper[i], p[i]);
      }
      m_vertex_entity[v] = (std::min)(m_vertex_entity[v], entity);
    }
    ++e.number_of_elements;
  }

public:
  template <class Mesh>
  explicit MSH_model(const Mesh& mesh)
    : m_vertex_entity(mesh.number_of_vertices(), no_entity), m_blocks(mesh),
      m_boundary_faces(Mixed_meshes_3::boundary_faces(mesh))
  {
    m_entities.push_back({"boundary", 2, boundary_tag});
    std::vector<std::size_t> entity_of(mesh.number_of_elements());
    for(std::size_t part = 0; part < m_blocks.parts().size(); ++part)
      m_entities.push_back({m_blocks.parts()[part].name(), 3, m_blocks.tag(part)});
    for(const Element_block& block : m_blocks)
      for(Element_index e : block)
        entity_of[e] = 1 + block.part;
    for(const Face& face : m_boundary_faces) {
      add(mesh, 0, face.vertices());
      m_entities[entity_of[face.element()]].is_on_boundary = true;
    }
    for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
      add(mesh, entity_of[e], mesh.element(e));
    for(std::size_t entity : m_vertex_entity)
      if(entity != no_entity)
        ++m_entities[entity].number_of_vertices;
  }

  const std::vector<MSH_entity>& entities() const { return m_entities; }
  bool is_vertex_on(std::size_t v, std::size_t entity) const { return m_vertex_entity[v] == entity; }
  const Element_blocks& blocks() const { return m_blocks; }
  int tag(const Element_block& block) const { return m_blocks.tag(block.part); }
  const std::vector<Face>& boundary_faces() const { return m_boundary_faces; }
};

inline void write_MSH_physical_names(Buffered_output& out, const MSH_model& model)
{
  int n = 0;
  for(const MSH_entity& e : model.entities())
    n += e.number_of_elements != 0;
  out << "$PhysicalNames\n" << n << '\n';
  for(const MSH_entity& e : model.entities())
    if(e.number_of_elements != 0)
      out << e.dimension << ' ' << e.tag << " \"" << e.name << "\"\n";
  out << "$EndPhysicalNames\n";
}

inline void write_MSH_entities(Buffered_output& out, const MSH_model& model)
{
  const auto& entities = model.entities();
  const bool has_boundary = entities[0].number_of_elements != 0;
  out << "$Entities\n0 0 " << int(has_boundary) << ' ' << entities.size() - 1 << '\n';
  for(const MSH_entity& e : entities)
    if(e.number_of_elements != 0) {
      out << e.tag << ' ';
      write_point(out, e.lower, " ");
      out << ' ';
      write_point(out, e.upper, " ");
      out << " 1 " << e.tag; // its physical group
      if(e.is_on_boundary)
        out << " 1 " << boundary_tag << '\n';
      else
        out << " 0\n";
    }
  out << "$EndEntities\n";
}

template <class Mesh>
void write_MSH_4_1_nodes(Buffered_output& out, const Mesh& mesh, const MSH_model& model)
{
  std::size_t blocks = 0, vertices = 0;
  for(const MSH_entity& e : model.entities()) {
    blocks += e.number_of_vertices != 0;
    vertices += e.number_of_vertices;
  }
  const std::size_t n = mesh.number_of_vertices();
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
        write_point(out, Mixed_meshes_3::to_vec3(mesh.points()[v]), " ");
        out << '\n';
      }
  }
  out << "$EndNodes\n";
}

template <class Mesh>
void write_MSH_4_1_elements(Buffered_output& out, const Mesh& mesh, const MSH_model& model)
{
  std::size_t faces[] = {0, 0}; // triangles, quadrilaterals
  for(const Face& face : model.boundary_faces())
    ++faces[face.vertices().size() - 3];
  const std::size_t m = mesh.number_of_elements(), total = m + faces[0] + faces[1];
  out << "$Elements\n"
      << model.blocks().blocks().size() + (faces[0] != 0) + (faces[1] != 0) << ' ' << total << " 1 " << total
      << '\n';
  for(const Element_block& block : model.blocks()) {
    out << "3 " << model.tag(block) << ' ' << block.names().gmsh_type << ' ' << block.size() << '\n';
    for(Element_index e : block) {
      out << e + 1 << ' ';
      write_vertices(out, mesh.element(e), ' ');
      out << '\n';
    }
  }
  for(int size : {3, 4}) {
    if(faces[size - 3] == 0)
      continue;
    out << "2 " << boundary_tag << ' ' << gmsh_face_type(size) << ' ' << faces[size - 3] << '\n';
    std::size_t number = m;
    for(const Face& face : model.boundary_faces()) {
      ++number;
      if(face.vertices().size() == size) {
        out << number << ' ';
        write_vertices(out, face.vertices(), ' ');
        out << '\n';
      }
    }
  }
  out << "$EndElements\n";
}

template <class Mesh>
void write_MSH_2_2_nodes_and_elements(Buffered_output& out, const Mesh& mesh, const MSH_model& model)
{
  const auto write_element = [&out](std::size_t number, int type, int tag, const auto& vertices) {
    out << number << ' ' << type << " 2 " << tag << ' ' << tag << ' ';
    write_vertices(out, vertices, ' ');
    out << '\n';
  };

  out << "$Nodes\n" << mesh.number_of_vertices() << '\n';
  for(std::size_t v = 0; v < mesh.number_of_vertices(); ++v) {
    out << v + 1 << ' ';
    write_point(out, Mixed_meshes_3::to_vec3(mesh.points()[v]), " ");
    out << '\n';
  }
  out << "$EndNodes\n$Elements\n" << mesh.number_of_elements() + model.boundary_faces().size() << '\n';
  for(const Element_block& block : model.blocks())
    for(Element_index e : block)
      write_element(e + 1, block.names().gmsh_type, model.tag(block), mesh.element(e));
  std::size_t number = mesh.number_of_elements();
  for(const Face& face : model.boundary_faces())
    write_element(++number, gmsh_face_type(face.vertices().size()), boundary_tag, face.vertices());
  out << "$EndElements\n";
}

} // namespace internal

/*!
\brief Writes a mesh in the format of Gmsh, as text.

Physical groups: the volumes "region" (1) and "rest" (2) for the elements of subdomain 1 in the region and the
others, the surface "boundary" (3) for the boundary faces, counter-clockwise seen from outside, and from 4 on
"subdomain_2_region", "subdomain_2_rest" and so on, as they occur. The numbers of vertices and elements are
the indices plus 1; boundary faces are numbered after the elements. Elements are written by group and kind.

\return whether the stream took everything.
*/
template <class Mesh>
bool write_MSH(std::ostream& stream, const Mesh& mesh, MSH_version version = MSH_version::V4_1)
{
  using namespace internal;
  const MSH_model model(mesh);
  Buffered_output out(stream);
  out << "$MeshFormat\n" << (version == MSH_version::V4_1 ? "4.1" : "2.2") << " 0 8\n$EndMeshFormat\n";
  write_MSH_physical_names(out, model);
  if(version == MSH_version::V4_1) {
    write_MSH_entities(out, model);
    write_MSH_4_1_nodes(out, mesh, model);
    write_MSH_4_1_elements(out, mesh, model);
  } else {
    write_MSH_2_2_nodes_and_elements(out, mesh, model);
  }
  return out.finish();
}

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_MSH_H
