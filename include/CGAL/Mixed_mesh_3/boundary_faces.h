// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The boundary of a mesh: faces, vertices, areas and normals.

#ifndef CGAL_MIXED_MESH_3_BOUNDARY_FACES_H
#define CGAL_MIXED_MESH_3_BOUNDARY_FACES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Face.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/for_each_face.h>

#include <algorithm>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMesh3Validity
/// The faces that belong to one element only, in the order of the elements.
/// \param mesh the mesh
/// \param is_candidate `bool(Vertex_index)`: looks only at faces all of whose vertices are candidates; faster
/// if few vertices are
/// \par Complexity
/// Linear in the number of elements, if the number of elements at a vertex is bounded
template <class Mesh, class Is_candidate>
std::vector<Face> boundary_faces(const Mesh& mesh, const Is_candidate& is_candidate)
{
  std::vector<Face> faces;
  internal::for_each_face(mesh.elements(), mesh.number_of_vertices(), is_candidate, [&](const auto& group) {
    if(group.size() == 1)
      faces.push_back(group[0]);
  });
  std::sort(faces.begin(), faces.end());
  return faces;
}

/// \ingroup PkgMixedMesh3Validity
/// Overload for all faces.
template <class Mesh>
std::vector<Face> boundary_faces(const Mesh& mesh)
{
  return boundary_faces(mesh, [](Vertex_index) { return true; });
}

/// \ingroup PkgMixedMesh3Validity
/// The vertices of faces, ascending.
inline std::vector<Vertex_index> vertices_of(const std::vector<Face>& faces)
{
  std::vector<Vertex_index> vertices;
  for(const Face& face : faces)
    vertices.insert(vertices.end(), face.vertices().begin(), face.vertices().end());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

/// \ingroup PkgMixedMesh3Validity
/// The vertices of the boundary faces, ascending.
template <class Mesh>
std::vector<Vertex_index> boundary_vertices(const Mesh& mesh)
{
  return vertices_of(boundary_faces(mesh));
}

/// \ingroup PkgMixedMesh3Validity
/// The integral of the unit normal over a face, outwards: its length is the area of a planar face.
template <class Mesh>
Vec3 vector_area(const Mesh& mesh, const Face& face)
{
  const auto edge = [&](int i, int j) {
    return to_vec3(mesh.point(face.vertices()[j])) - to_vec3(mesh.point(face.vertices()[i]));
  };
  return 0.5 * (face.vertices().size() == 3 ? cross(edge(0, 1), edge(0, 2)) : cross(edge(0, 2), edge(1, 3)));
}

/// \ingroup PkgMixedMesh3Validity
/// The area of a face; for a quadrilateral, the mean of its two triangulations.
template <class Mesh>
double area(const Mesh& mesh, const Face& face)
{
  const auto triangle = [&](int i, int j, int k) {
    const Vec3 p = to_vec3(mesh.point(face.vertices()[i]));
    return norm(
             cross(to_vec3(mesh.point(face.vertices()[j])) - p, to_vec3(mesh.point(face.vertices()[k])) - p))
           / 2;
  };
  return face.vertices().size() == 3
           ? triangle(0, 1, 2)
           : (triangle(0, 1, 2) + triangle(0, 2, 3) + triangle(1, 2, 3) + triangle(1, 3, 0)) / 2;
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_BOUNDARY_FACES_H
