// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The curves along which three or more interfaces of subdomains meet, while edges are collapsed.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_INTERFACE_CURVES_H
#define CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_INTERFACE_CURVES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Face.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The vertices of each face.
inline std::vector<Face_vertices> vertices_of_faces(const std::vector<Face>& faces)
{
  std::vector<Face_vertices> result;
  for(const Face& face : faces)
    result.push_back(face.vertices());
  return result;
}

/*!
The edges at which not two triangles of the boundary and of interfaces meet, but more.

A vertex is regular if the triangles around it are one disc, or discs with a common diameter, the curve: seen
from the vertex, they are a circle, or arcs that have both ends in common. All others are corners.
*/
class Interface_curves
{
  using Ends = std::vector<Vertex_index>;
  using Link = std::vector<std::pair<Vertex_index, Vertex_index>>; // edges opposite to a vertex

  std::vector<Ends> m_neighbors; // along curves
  std::vector<std::uint8_t> m_is_corner;

public:
  /// \param triangles all of the boundary and of interfaces
  Interface_curves(const std::vector<Face_vertices>& triangles, std::size_t number_of_vertices)
    : m_neighbors(number_of_vertices), m_is_corner(number_of_vertices, 0)
  {
    // The corners of a vertex are a list of links: corner i of triangle t has the number 3 t + i.
    const std::size_t none = 3 * triangles.size();
    std::vector<std::size_t> first(number_of_vertices, none), next(none);
    for(std::size_t c = none; c-- > 0;)
      next[c] = std::exchange(first[triangles[c / 3][int(c % 3)]], c);
    Link link;
    Ends ends;
    for(Vertex_index v = 0; v < number_of_vertices; ++v) {
      link.clear();
      for(std::size_t c = first[v]; c != none; c = next[c]) {
        const Face_vertices& t = triangles[c / 3];
        link.emplace_back(t[int((c + 1) % 3)], t[int((c + 2) % 3)]);
      }
      examine(v, link, ends);
    }
  }

  Interface_curves(const std::vector<Face>& triangles, std::size_t number_of_vertices)
    : Interface_curves(vertices_of_faces(triangles), number_of_vertices)
  {
  }

  bool is_on_curve(Vertex_index v) const { return !m_neighbors[v].empty(); }
  /// Whether a vertex has to stay, so that the topology of interfaces does.
  bool is_corner(Vertex_index v) const { return m_is_corner[v]; }
  /// The other ends of the edges of a curve.
  const std::vector<Vertex_index>& neighbors(Vertex_index v) const { return m_neighbors[v]; }

  /// The link condition for the curves: none of three edges is closed by a collapse.
  bool is_link(Vertex_index v, Vertex_index w) const
  {
    return std::all_of(m_neighbors[v].begin(), m_neighbors[v].end(), [&](Vertex_index u) {
      return u == w || std::find(m_neighbors[w].begin(), m_neighbors[w].end(), u) == m_neighbors[w].end();
    });
  }

  /// Lets w take the place of v. \pre if v is on a curve, w is one of its neighbors
  void collapse(Vertex_index v, Vertex_index w)
  {
    for(Vertex_index u : m_neighbors[v]) {
      Ends& ends = m_neighbors[u];
      if(u == w) {
        ends.erase(std::find(ends.begin(), ends.end(), v));
      } else {
        std::replace(ends.begin(), ends.end(), v, w);
        m_neighbors[w].push_back(u);
      }
    }
    m_neighbors[v].clear();
  }

private:
  // \param ends memory for the ends of the link
  void examine(Vertex_index v, const Link& link, Ends& ends)
  {
    ends.clear();
    for(const auto& [a, b] : link) {
      ends.push_back(a);
      ends.push_back(b);
    }
    std::sort(ends.begin(), ends.end());
    std::vector<std::ptrdiff_t> degrees; // of those that are not 2
    for(auto i = ends.begin(); i != ends.end();) {
      const auto next = std::upper_bound(i, ends.end(), *i);
      if(next - i != 2) {
        m_neighbors[v].push_back(*i);
        degrees.push_back(next - i);
      }
      i = next;
    }
    const bool is_disc = degrees.empty(), is_book = degrees.size() == 2 && degrees[0] == degrees[1];
    m_is_corner[v] = !(is_disc || is_book) || !is_connected(link, ends);
  }

  // Whether edges are connected. \param ends their ends, sorted
  static bool is_connected(const std::vector<std::pair<Vertex_index, Vertex_index>>& edges, const Ends& ends)
  {
    if(edges.empty())
      return true;
    Ends reached = {edges.front().first};
    for(std::size_t i = 0; i < reached.size(); ++i)
      for(const auto& [a, b] : edges)
        for(Vertex_index u : {a, b})
          if((a == reached[i] || b == reached[i])
             && std::find(reached.begin(), reached.end(), u) == reached.end())
            reached.push_back(u);
    std::size_t number = 0;
    for(auto i = ends.begin(); i != ends.end(); i = std::upper_bound(i, ends.end(), *i))
      ++number;
    return reached.size() == number;
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_INTERFACE_CURVES_H
