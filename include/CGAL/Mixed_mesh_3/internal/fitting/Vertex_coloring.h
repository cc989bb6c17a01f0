// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Coloring of the vertices of a mesh: vertices of one color may move at the same time.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_VERTEX_COLORING_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_VERTEX_COLORING_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/moves/Working_mesh.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Colors of vertices, such that the vertices of an element differ: the first free color, in the order of the
/// elements, so that the colors depend on the mesh only. Only new elements are examined.
class Vertex_coloring
{
  using Color = std::uint32_t;

  std::vector<Color> m_colors;                       // color of each vertex
  std::vector<std::vector<Vertex_index>> m_vertices; // vertices of each color, ascending
  std::vector<std::size_t> m_last_seen;              // last search in which each color was taken
  std::size_t m_number_of_elements = 0, m_number_of_searches = 0;

  static constexpr Color none = Color(-1);

public:
  /// \par Complexity
  /// Proportional to the number of vertices, and of neighbors of the vertices that get a color
  void update(const Working_mesh& mesh)
  {
    if(m_number_of_elements == mesh.elements.size())
      return;
    m_colors.resize(mesh.points.size(), none);
    for(; m_number_of_elements < mesh.elements.size(); ++m_number_of_elements) {
      const Working_mesh::Element& element = mesh.elements[m_number_of_elements];
      if(!element.is_removed)
        for(const Vertex_index* v = element.begin(); v != element.end(); ++v)
          if(m_colors[*v] == none
             || std::any_of(element.begin(), v, [&](Vertex_index u) { return m_colors[u] == m_colors[*v]; }))
            m_colors[*v] = free_color(mesh, *v);
    }
    m_vertices.assign(m_last_seen.size(), {});
    for(Vertex_index v = 0; v < mesh.points.size(); ++v)
      if(m_colors[v] != none)
        m_vertices[m_colors[v]].push_back(v);
  }

  /// The vertices of each color, ascending. Vertices without elements have no color.
  const std::vector<std::vector<Vertex_index>>& vertices() const { return m_vertices; }

private:
  Color free_color(const Working_mesh& mesh, Vertex_index v)
  {
    ++m_number_of_searches;
    for(Element_index e : mesh.incident[v])
      for(Vertex_index u : mesh.elements[e])
        if(u != v && m_colors[u] != none)
          m_last_seen[m_colors[u]] = m_number_of_searches;
    const auto found = std::find_if(m_last_seen.begin(), m_last_seen.end(),
                                    [&](std::size_t search) { return search != m_number_of_searches; });
    const Color color = Color(found - m_last_seen.begin());
    if(found == m_last_seen.end())
      m_last_seen.push_back(0);
    return color;
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_VERTEX_COLORING_H
