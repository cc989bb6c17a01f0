// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_VERTEX_LEVELS_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_VERTEX_LEVELS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/moves/Working_mesh.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Levels of vertices, as in level scheduling of triangular solvers: a vertex is one level above the highest
/// of the vertices of smaller number that share an element with it. Vertices of a level share no element, and
/// moves level after level have the same outcome as moves in the order of the numbers.
class Vertex_levels
{
  std::vector<std::uint32_t> m_levels;               // level of each vertex
  std::vector<std::vector<Vertex_index>> m_vertices; // vertices of each level, ascending
  std::size_t m_number_of_elements = 0;

public:
  /// \par Complexity
  /// Proportional to the number of vertices of all elements, times their number around a vertex, if there are
  /// elements that the mesh had not before
  void update(const Working_mesh& mesh)
  {
    if(m_number_of_elements == mesh.elements.size())
      return;
    m_number_of_elements = mesh.elements.size();
    m_levels.assign(mesh.points.size(), 0);
    for(std::vector<Vertex_index>& vertices : m_vertices)
      vertices.clear();
    for(Vertex_index v = 0; v < mesh.points.size(); ++v) {
      std::uint32_t level = 0;
      for(Element_index e : mesh.incident[v])
        for(Vertex_index u : mesh.elements[e])
          if(u < v)
            level = (std::max)(level, m_levels[u] + 1);
      m_levels[v] = level;
      if(level >= m_vertices.size())
        m_vertices.resize(level + 1);
      m_vertices[level].push_back(v);
    }
  }

  /// The vertices of each level, ascending.
  const std::vector<std::vector<Vertex_index>>& vertices() const { return m_vertices; }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_VERTEX_LEVELS_H
