// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shares of the vertices in the boundary of a mesh: a normal, an area.

#ifndef CGAL_LINEAR_ELASTICITY_3_INTERNAL_BOUNDARY_MEASURES_H
#define CGAL_LINEAR_ELASTICITY_3_INTERNAL_BOUNDARY_MEASURES_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Elements and the number of their vertices: the part of a mesh that `boundary_faces()` needs.
class Elements_of_vertices
{
  const Element_list& m_elements;
  std::size_t m_number_of_vertices;

public:
  Elements_of_vertices(const Element_list& elements, std::size_t number_of_vertices)
    : m_elements(elements), m_number_of_vertices(number_of_vertices)
  {
  }
  const Element_list& elements() const { return m_elements; }
  std::size_t number_of_vertices() const { return m_number_of_vertices; }
};

/// The integral of the normal times the vertex's shape function, zero inside: a flow orthogonal to these
/// vectors keeps the volume.
inline std::vector<Vec3> boundary_vertex_normals(const Element_list& elements,
                                                 const std::vector<Vec3>& points)
{
  std::vector<Vec3> normals(points.size(), Vec3{});
  for(const Face& face : boundary_faces(Elements_of_vertices(elements, points.size()))) {
    const Face_vertices& v = face.vertices();
    const int n = v.size();
    const auto corner = [&](int i) {
      const Vec3& p = points[v[i]];
      return cross(points[v[(i + 1) % n]] - p, points[v[(i + n - 1) % n]] - p);
    };
    for(int i = 0; i < n; ++i)
      normals[v[i]] = normals[v[i]]
                      + (n == 3 ? (1. / 6) * corner(i) : (1. / 12) * (corner(i) + (corner(1) + corner(3))));
  }
  return normals;
}

/// The sum of the equal shares of the areas of the faces around each vertex, zero inside.
template <class Mesh>
std::vector<double> boundary_vertex_areas(const Mesh& mesh)
{
  std::vector<double> areas(mesh.number_of_vertices(), 0);
  for(const Face& face : boundary_faces(mesh)) {
    const double share = area(mesh, face) / face.vertices().size();
    for(Vertex_index v : face.vertices())
      areas[v] += share;
  }
  return areas;
}

/// The integral of the function of each edge over the boundary: a third of the areas of the faces with the
/// edge, both for triangles and quadrilaterals.
/// \param ends both ends of each edge, the smaller one first
template <class Mesh>
std::vector<double> boundary_edge_integrals(const Mesh& mesh,
                                            const std::vector<std::array<Vertex_index, 2>>& ends)
{
  std::map<std::array<Vertex_index, 2>, double> of_ends;
  for(const Face& face : boundary_faces(mesh)) {
    const double share = area(mesh, face) / 3;
    const Face_vertices& v = face.vertices();
    for(int i = 0; i < v.size(); ++i) {
      const auto [a, b] = std::minmax({v[i], v[(i + 1) % v.size()]});
      of_ends[{a, b}] += share;
    }
  }
  std::vector<double> integrals;
  for(const auto& edge : ends) {
    const auto place = of_ends.find(edge);
    integrals.push_back(place == of_ends.end() ? 0 : place->second);
  }
  return integrals;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_INTERNAL_BOUNDARY_MEASURES_H
