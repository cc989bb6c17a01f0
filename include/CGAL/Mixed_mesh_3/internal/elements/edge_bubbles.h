// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vectors at edges, and the field of elements of order 2 as a `Quadratic_field`.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_EDGE_BUBBLES_H
#define CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_EDGE_BUBBLES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/Index.h>
#include <CGAL/Mixed_mesh_3/Mixed_element_traits_3.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/Quadratic_field.h>
#include <CGAL/Mixed_mesh_3/internal/elements/edge_functions.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Both ends of an edge, the smaller one first.
using Edge_ends = std::array<Vertex_index, 2>;

/// A vector for each of some edges, found by the ends; zero for other edges.
class Edge_vectors
{
  std::vector<std::size_t> m_starts;                    // by the smaller end, where edges begin
  std::vector<std::pair<Vertex_index, Vec3>> m_vectors; // by the larger end

public:
  Edge_vectors() = default;

  /// \pre there is a vector for each edge
  Edge_vectors(std::size_t number_of_vertices, const std::vector<Edge_ends>& edges,
               const std::vector<Vec3>& vectors)
    : m_starts(number_of_vertices + 2, 0), m_vectors(edges.size())
  {
    CGAL_precondition(edges.size() == vectors.size());
    for(const Edge_ends& ends : edges)
      ++m_starts[ends[0] + 2];
    for(std::size_t v = 2; v < m_starts.size(); ++v)
      m_starts[v] += m_starts[v - 1];
    for(std::size_t i = 0; i < edges.size(); ++i)
      m_vectors[m_starts[edges[i][0] + 1]++] = {edges[i][1], vectors[i]};
  }

  bool empty() const { return m_vectors.empty(); }

  /// \par Complexity
  /// Linear in the number of edges at a vertex
  Vec3 operator()(Vertex_index v, Vertex_index w) const
  {
    if(empty())
      return {};
    const auto [smaller, larger] = std::minmax(v, w);
    for(std::size_t i = m_starts[smaller]; i < m_starts[smaller + 1]; ++i)
      if(m_vectors[i].first == larger)
        return m_vectors[i].second;
    return {};
  }
};

/// The factors of edge functions as sums of products of two vertex functions, by pair and edge.
using Bubble_factors = std::array<std::array<double, largest_number_of_edges>, 28>;

/*!
The functions of edges as sums over pairs of vertices, phi_e = sum of c_e,ij N_i N_j.

An edge along x of the unit square has phi = 4 x (1 - x) y = 4 x (1 - x) (y^2 + y (1 - y)): 4 times the
product of its own ends, and, as both diagonals have the product x (1 - x) y (1 - y), twice that of each. In
the same way, each of the four diagonals of a hexahedron takes 1 from each edge. In general, the factor is 4,
2 or 1 if the smallest face of the element with both vertices is an edge, a quadrilateral or the hexahedron
itself, and this face has the edge; else it is 0. On triangles there are edges only, with phi = 4 N_i N_j.
*/
inline Bubble_factors make_bubble_factors(Element_kind kind)
{
  const Reference_element& reference = reference_elements[kind];
  Bubble_factors factors{};
  // Of the larger faces first: the smallest face of a pair counts.
  const auto set = [&](const auto& vertices, int size, double factor) {
    const auto has = [&](int v) { return std::find(vertices, vertices + size, v) != vertices + size; };
    for(int j = 1; j < reference.number_of_vertices; ++j)
      for(int i = 0; i < j; ++i)
        if(has(i) && has(j))
          for(int e = 0; e < reference.number_of_edges; ++e)
            factors[std::size_t(pair_index(i, j))][std::size_t(e)] = has(reference.edges[e][0])
                                                                         && has(reference.edges[e][1])
                                                                       ? factor
                                                                       : 0;
  };
  constexpr int all[] = {0, 1, 2, 3, 4, 5, 6, 7};
  set(all, reference.number_of_vertices, 1);
  for(int f = 0; f < reference.number_of_faces; ++f)
    set(reference.faces[f].vertices, reference.faces[f].size, 2);
  for(int e = 0; e < reference.number_of_edges; ++e)
    set(reference.edges[e], 2, 4);
  return factors;
}

/// The bubbles of a field with a coefficient for each edge of an element, in the order of
/// `Reference_element::edges`.
inline Bubbles bubbles_of_edges(Element_kind kind,
                                const std::array<Vec3, largest_number_of_edges>& coefficients)
{
  static const std::array<Bubble_factors, number_of_element_kinds> all = [] {
    std::array<Bubble_factors, number_of_element_kinds> result;
    for(int k = 0; k < number_of_element_kinds; ++k)
      result[std::size_t(k)] = make_bubble_factors(Element_kind(k));
    return result;
  }();
  Bubbles bubbles{};
  for(int i = 0; i < number_of_pairs(kind); ++i)
    for(int e = 0; e < reference_elements[kind].number_of_edges; ++e)
      if(const double factor = all[kind][std::size_t(i)][std::size_t(e)]; factor != 0)
        bubbles[std::size_t(i)] = bubbles[std::size_t(i)] + factor * coefficients[std::size_t(e)];
  return bubbles;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_EDGE_BUBBLES_H
