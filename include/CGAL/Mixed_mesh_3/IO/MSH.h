// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_MSH_H
#define CGAL_MIXED_MESH_3_IO_MSH_H

#include <CGAL/Mixed_mesh_3/IO/internal/Buffered_output.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <ostream>
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
  const char* name;
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
  static constexpr std::uint8_t no_entity = 255;
  std::array<MSH_entity, 3> m_entities = {
    {{"boundary", 2, boundary_tag}, {"region", 3, region_tag}, {"rest", 3, rest_tag}}};
  std::vector<std::uint8_t> m_vertex_entity;

  // An entity's box has all its vertices, but each vertex is on the first entity only.
  template <class Mesh, class Vertices>
  void add(const Mesh& mesh, int entity, const Vertices& vertices)
  {
    MSH_entity& e = m_entities[std::size_t(entity)];
    for(Vertex_index v : vertices) {
      const auto p = Mixed_meshes_3::to_vec3(mesh.point(v));
      const bool is_first = e.number_of_elements == 0 && v == *vertices.begin();
      for(int i = 0; i < 3; ++i) {
        e.lower[i] = is_first ? p[i] : (std::min)(e.lower[i], p[i]);
        e.upper[i] = is_first ? p[i] : (std::max)(e.upper[i], p[i]);
      }
      m_vertex_entity[v] = (std::min)(m_vertex_entity[v], std::uint8_t(entity));
    }
    ++e.number_of_elements;
  }

public:
  template <class Mesh>
  explicit MSH_model(const Mesh& mesh) : m_vertex_entity(mesh.number_of_vertices(), no_entity)
  {
    for(const auto& face : mesh.boundary_faces()) {
      add(mesh, 0, Face_vertices(mesh, face));
      m_entities[mesh.is_in_region(face.element) ? 1 : 2].is_on_boundary = true;
    }
    for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
      add(mesh, mesh.is_in_region(e) ? 1 : 2, mesh.element(e));
    for(std::uint8_t entity : m_vertex_entity)
      if(entity != no_entity)
        ++m_entities[entity].number_of_vertices;
  }

  const std::array<MSH_entity, 3>& entities() const { return m_entities; }
  bool is_vertex_on(std::size_t v, int entity) const { return m_vertex_entity[v] == entity; }
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
  out << "$Entities\n0 0 " << int(has_boundary) << ' '
      << (entities[1].number_of_elements != 0) + (entities[2].number_of_elements != 0) << '\n';
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
  for(int i = 0; i < 3; ++i) {
    const MSH_entity& e = model.entities()[std::size_t(i)];
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
void write_MSH_4_1_elements(Buffered_output& out, const Mesh& mesh)
{
  const std::vector<Element_block> blocks = element_blocks(mesh);
  const std::size_t faces[] = {number_of_boundary_faces(mesh, 3), number_of_boundary_faces(mesh, 4)};
  const std::size_t m = mesh.number_of_elements(), total = m + faces[0] + faces[1];
  out << "$Elements\n"
      << blocks.size() + (faces[0] != 0) + (faces[1] != 0) << ' ' << total << " 1 " << total << '\n';
  for(const Element_block& block : blocks) {
    out << "3 " << (block.in_region ? region_tag : rest_tag) << ' '
        << block.reference().gmsh_type << ' ' << block.size << '\n';
    for(std::size_t e = 0; e < m; ++e)
      if(block.has(mesh, e)) {
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
    for(const auto& face : mesh.boundary_faces()) {
      const Face_vertices vertices(mesh, face);
      ++number;
      if(vertices.size() == size) {
        out << number << ' ';
        write_vertices(out, vertices, ' ');
        out << '\n';
      }
    }
  }
  out << "$EndElements\n";
}

template <class Mesh>
void write_MSH_2_2_nodes_and_elements(Buffered_output& out, const Mesh& mesh)
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
  out << "$EndNodes\n$Elements\n"
      << mesh.number_of_elements() + mesh.boundary_faces().size() << '\n';
  std::size_t number = 0;
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
    write_element(++number, mesh.element(e).reference().gmsh_type,
                  mesh.is_in_region(e) ? region_tag : rest_tag, mesh.element(e));
  for(const auto& face : mesh.boundary_faces()) {
    const Face_vertices vertices(mesh, face);
    write_element(++number, gmsh_face_type(vertices.size()), boundary_tag, vertices);
  }
  out << "$EndElements\n";
}

} // namespace internal

/*!
\brief Writes a mesh in the format of Gmsh, as text.

Physical groups: the volumes "region" (1) and "rest" (2) for the elements in the region and the
others, and the surface "boundary" (3) for the boundary faces, counter-clockwise seen from outside.
Vertices and elements keep their order: their numbers are the indices plus 1; boundary faces are
numbered after the elements.

\return whether the stream took everything.
*/
template <class Mesh>
bool write_MSH(std::ostream& stream, const Mesh& mesh, MSH_version version = MSH_version::V4_1)
{
  using namespace internal;
  const MSH_model model(mesh);
  Buffered_output out(stream);
  out << "$MeshFormat\n"
      << (version == MSH_version::V4_1 ? "4.1" : "2.2") << " 0 8\n$EndMeshFormat\n";
  write_MSH_physical_names(out, model);
  if(version == MSH_version::V4_1) {
    write_MSH_entities(out, model);
    write_MSH_4_1_nodes(out, mesh, model);
    write_MSH_4_1_elements(out, mesh);
  } else {
    write_MSH_2_2_nodes_and_elements(out, mesh);
  }
  return out.finish();
}

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_MSH_H
