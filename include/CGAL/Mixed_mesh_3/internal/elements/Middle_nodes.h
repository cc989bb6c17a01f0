// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers of the edges of a mesh: files of order 2, and quadratic displacements, have a node in the middle of
// each.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_MIDDLE_NODES_H
#define CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_MIDDLE_NODES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/Face.h>
#include <CGAL/Mixed_mesh_3/Index.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The middle nodes of quadratic elements: one an edge, whatever elements have it.
struct Middle_nodes
{
  std::vector<std::array<Vertex_index, 2>> ends; ///< of the edge of each middle node, the smaller one first
  std::vector<std::size_t> offsets;              ///< where each element begins in `of_elements`
  std::vector<Vertex_index> of_elements; ///< in the order of `Reference_element::edges`; numbers from 0
};

/// Numbers edges as elements have them first. Edges that begin in a vertex are in a list, so that the order
/// takes neither sorting nor hashing.
/// \par Complexity
/// Linear in the number of elements, if vertices have boundedly many
inline Middle_nodes quadratic_connectivity(const Element_list& elements, std::size_t number_of_vertices)
{
  constexpr Vertex_index none = no_vertex;
  Middle_nodes result;
  std::vector<Vertex_index> last(number_of_vertices, none), before; // edges by smaller end
  for(Element_index e = 0; e < elements.size(); ++e) {
    const Element_view element = elements[e];
    result.offsets.push_back(result.of_elements.size());
    for(int i = 0; i < element.reference().number_of_edges; ++i) {
      const auto& edge = element.reference().edges[i];
      const auto [a, b] = std::minmax({element[edge[0]], element[edge[1]]});
      Vertex_index number = last[a];
      while(number != none && result.ends[number][1] != b)
        number = before[number];
      if(number == none) {
        if(result.ends.size() >= none - number_of_vertices)
          throw std::length_error("Mixed_mesh_3: more than 2^32 nodes");
        number = Vertex_index(result.ends.size());
        result.ends.push_back({a, b});
        before.push_back(std::exchange(last[a], number));
      }
      result.of_elements.push_back(number);
    }
  }
  return result;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_MIDDLE_NODES_H
