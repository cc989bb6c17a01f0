// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Integrals over the boundary of a mesh: shares of vertices and edges in normals and areas.

#ifndef CGAL_LINEAR_ELASTICITY_3_INTERNAL_BOUNDARY_MEASURES_H
#define CGAL_LINEAR_ELASTICITY_3_INTERNAL_BOUNDARY_MEASURES_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/Face.h>
#include <CGAL/Mixed_mesh_3/Index.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <utility>
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

/// The nodes of edges by both ends, the smaller one first.
using Nodes_of_edges = std::map<std::array<Vertex_index, 2>, Vertex_index>;

/// The boundary faces and their areas, to integrate fields over a part of the boundary.
class Boundary_integrals
{
  std::vector<std::pair<Face, double>> m_faces; // with areas

public:
  template <class Mesh>
  explicit Boundary_integrals(const Mesh& mesh)
  {
    for(const Face& face : boundary_faces(mesh))
      m_faces.emplace_back(face, area(mesh, face));
  }

  /*!
  The integrals of the functions of nodes, other than zero, over the part of the boundary around some
  vertices.

  Each face counts by the share of its vertices that are in the part, so that edges count less toward the rim.
  An edge's function has a third of the area of each face with the edge, of triangles and quadrilaterals. Of
  vertices' functions, those of vertices in the part have equal shares of the areas of the faces around them.

  \param is_in_part `bool(Vertex_index)`
  \param edges edges that are nodes
  */
  template <class Is_in_part>
  std::map<Vertex_index, double> operator()(const Is_in_part& is_in_part, const Nodes_of_edges& edges) const
  {
    std::map<Vertex_index, double> integrals;
    for(const auto& [face, area] : m_faces) {
      const Face_vertices& v = face.vertices();
      const double share = area / v.size();
      int inside = 0;
      for(Vertex_index w : v)
        if(is_in_part(w)) {
          integrals[w] += share;
          ++inside;
        }
      for(int i = 0; inside > 0 && i < v.size(); ++i) {
        const auto [a, b] = std::minmax({v[i], v[(i + 1) % v.size()]});
        if(const auto edge = edges.find({a, b}); edge != edges.end())
          integrals[edge->second] += inside * share / 3;
      }
    }
    return integrals;
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_INTERNAL_BOUNDARY_MEASURES_H
