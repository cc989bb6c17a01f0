// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Defects of the boundary of a set of elements: the places where the boundary is not a closed 2-manifold.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_MANIFOLD_DEFECTS_H
#define CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_MANIFOLD_DEFECTS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Face.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The places where a set of oriented polygons is not a closed oriented 2-manifold.
struct Manifold_defects
{
  std::vector<std::array<Vertex_index, 2>> edges; ///< edges that are not once in each direction
  std::vector<Vertex_index> vertices;             ///< vertices with more than one fan of polygons
  bool empty() const { return edges.empty() && vertices.empty(); }
};

/// Whether the polygons around a vertex are connected by the edges at it.
/// \param links the vertices after and before the vertex, for each polygon
inline bool is_one_fan(std::vector<std::array<Vertex_index, 2>> links)
{
  std::vector<Vertex_index> reached{links.back()[0], links.back()[1]};
  links.pop_back();
  for(std::size_t i = 0; i < reached.size(); ++i) {
    const auto touches = [&](const auto& l) { return l[0] == reached[i] || l[1] == reached[i]; };
    const auto rest = std::stable_partition(links.begin(), links.end(),
                                            [&](const auto& l) { return !touches(l); });
    for(auto l = rest; l != links.end(); ++l)
      reached.push_back((*l)[0] == reached[i] ? (*l)[1] : (*l)[0]);
    links.erase(rest, links.end());
  }
  return links.empty();
}

/// Vertices with more than one fan of polygons, in a set of polygons that may have a border; ordered.
/// \par Complexity
/// O(n log n) for n polygons, if the number of polygons around each vertex is small
inline std::vector<Vertex_index> vertices_with_several_fans(const std::vector<Face_vertices>& polygons)
{
  std::map<Vertex_index, std::vector<std::array<Vertex_index, 2>>> links;
  for(const Face_vertices& p : polygons)
    for(int i = 0; i < p.size(); ++i)
      links[p[i]].push_back({p[(i + 1) % p.size()], p[(i + p.size() - 1) % p.size()]});
  std::vector<Vertex_index> result;
  for(const auto& [v, around] : links)
    if(!is_one_fan(around))
      result.push_back(v);
  return result;
}

/// \par Complexity
/// O(n log n) for n polygons
inline Manifold_defects manifold_defects(const std::vector<Face_vertices>& polygons)
{
  Manifold_defects defects;

  // Each edge must be present once in each direction.
  std::size_t number = 0; // of edges, and of links
  for(const Face_vertices& p : polygons)
    number += std::size_t(p.size());
  const auto pair = [](Vertex_index a, Vertex_index b) { return std::uint64_t(a) << 32 | b; };
  struct Edge
  {
    std::uint64_t ends; // the smaller one first; one number is sorted faster than two
    bool is_reversed;
    bool operator<(const Edge& e) const
    {
      return ends != e.ends ? ends < e.ends : is_reversed < e.is_reversed;
    }
  };
  std::vector<Edge> edges;
  edges.reserve(number);
  for(const Face_vertices& p : polygons)
    for(int i = 0; i < p.size(); ++i) {
      const Vertex_index a = p[i], b = p[i + 1 < p.size() ? i + 1 : 0];
      edges.push_back({pair((std::min)(a, b), (std::max)(a, b)), a > b});
    }
  std::sort(edges.begin(), edges.end());
  for(std::size_t i = 0, j; i < edges.size(); i = j) {
    for(j = i; j < edges.size() && edges[j].ends == edges[i].ends;)
      ++j;
    if(j - i != 2 || edges[i].is_reversed == edges[i + 1].is_reversed)
      defects.edges.push_back({Vertex_index(edges[i].ends >> 32), Vertex_index(edges[i].ends)});
  }

  // The links around each vertex (predecessor to successor in each polygon) must form one cycle.
  struct Link
  {
    std::uint64_t vertex_and_from;
    Vertex_index to;
    Vertex_index vertex() const { return Vertex_index(vertex_and_from >> 32); }
    Vertex_index from() const { return Vertex_index(vertex_and_from); }
    bool operator<(const Link& l) const
    {
      return vertex_and_from != l.vertex_and_from ? vertex_and_from < l.vertex_and_from : to < l.to;
    }
  };
  std::vector<Link> links;
  links.reserve(number);
  for(const Face_vertices& p : polygons)
    for(int i = 0, last = p.size() - 1; i <= last; ++i)
      links.push_back({pair(p[i], p[i < last ? i + 1 : 0]), p[i > 0 ? i - 1 : last]});
  std::sort(links.begin(), links.end());
  for(auto first = links.begin(), last = first; first != links.end(); first = last) {
    while(last != links.end() && last->vertex() == first->vertex())
      ++last;
    std::ptrdiff_t length = 0;
    Vertex_index v = first->from();
    do {
      const auto next = std::lower_bound(first, last, Link{pair(first->vertex(), v), 0});
      if(next == last || next->from() != v)
        break;
      v = next->to;
      ++length;
    } while(v != first->from() && length <= last - first);
    if(v != first->from() || length != last - first)
      defects.vertices.push_back(first->vertex());
  }
  return defects;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_MANIFOLD_DEFECTS_H
