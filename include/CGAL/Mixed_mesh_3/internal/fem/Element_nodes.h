// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The nodes of elements: vertices, and edges where displacements are quadratic.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FEM_ELEMENT_NODES_H
#define CGAL_MIXED_MESH_3_INTERNAL_FEM_ELEMENT_NODES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/Face.h>
#include <CGAL/Mixed_mesh_3/internal/elements/Middle_nodes.h>
#include <CGAL/Mixed_mesh_3/internal/elements/edge_functions.h>
#include <CGAL/Mixed_mesh_3/internal/fem/quadrature.h>

#include <CGAL/assertions.h>

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The nodes of an element, each with the number of its shape function in the quadrature rule of the element.
class Nodes_of_element
{
public:
  /// An edge whose value is the displacement of its middle: the functions of the edge and of its ends.
  struct Middle
  {
    int edge;
    std::array<int, 2> ends;
  };

private:
  std::array<Vertex_index, largest_number_of_functions> m_nodes;
  std::array<int, largest_number_of_functions> m_functions;
  std::array<Middle, largest_number_of_edges> m_middles;
  int m_size = 0, m_number_of_middles = 0;
  int m_order = 1;

public:
  explicit Nodes_of_element(const Element_view& vertices)
  {
    for(Vertex_index v : vertices)
      push_back(v, m_size);
  }
  void add_edge(Vertex_index node, int function)
  {
    push_back(node, function);
    m_order = 2;
  }
  void add_middle(const Middle& middle) { m_middles[std::size_t(m_number_of_middles++)] = middle; }
  int number_of_middles() const { return m_number_of_middles; }
  const Middle& middle(int i) const { return m_middles[std::size_t(i)]; }
  int size() const { return m_size; }
  /// The order of the quadrature rule: 2 if a node is that of an edge.
  int order() const { return m_order; }
  Vertex_index operator[](int i) const { return m_nodes[std::size_t(i)]; }
  int function(int i) const { return m_functions[std::size_t(i)]; }
  const Vertex_index* begin() const { return m_nodes.data(); }
  const Vertex_index* end() const { return m_nodes.data() + m_size; }

private:
  void push_back(Vertex_index node, int function)
  {
    m_nodes[std::size_t(m_size)] = node;
    m_functions[std::size_t(m_size++)] = function;
  }
};

/*!
A numbering of nodes: the vertices, then the edges of those elements that are quadratic, in the order of
`quadratic_connectivity()`. The displacement of an element is

    u = sum of N_v u_v over vertices + sum of phi_e a_e over edges that are nodes

with N_v the shape functions of order 1 and phi_e those of `edge_functions()`. An edge that is no node has
a_e = 0: the field is continuous at the border of the quadratic elements, too. Elements there have some edges
as nodes.

Linear elements are the case without edges; the numbering takes no memory then.

The value of an edge can be the displacement of its middle instead, a_e + (u_v + u_w) / 2, so that the
displacement of the middle can be prescribed though an end is free. That is another basis of the same fields:
the functions of the ends lose half of the edge's function.
*/
class Element_nodes
{
  struct Edge
  {
    Vertex_index node;
    int local; // number among the edges of the element
  };

  const Element_list* m_elements;
  std::size_t m_number_of_vertices;
  std::vector<std::array<Vertex_index, 2>> m_ends; // of each edge that is a node
  std::vector<std::size_t> m_starts;               // where each element begins in `m_edges`
  std::vector<Edge> m_edges;
  std::vector<bool> m_is_middle; // whether the value of each edge is a displacement; empty: none is

public:
  /// Numbers vertices. \param elements kept by reference: must outlive the object
  Element_nodes(const Element_list& elements, std::size_t number_of_vertices)
    : m_elements(&elements), m_number_of_vertices(number_of_vertices)
  {
  }

  /// Numbers vertices, and the edges of some elements.
  Element_nodes(const Element_list& elements, std::size_t number_of_vertices,
                const std::vector<bool>& is_quadratic)
    : Element_nodes(elements, number_of_vertices)
  {
    CGAL_precondition(is_quadratic.size() == elements.size());
    const Middle_nodes all = quadratic_connectivity(elements, number_of_vertices);
    std::vector<Vertex_index> nodes(all.ends.size(), no_vertex);
    const auto for_each_edge = [&](Element_index e, const auto& f) {
      for(int i = 0; i < elements[e].reference().number_of_edges; ++i)
        f(all.of_elements[all.offsets[e] + std::size_t(i)], i);
    };
    for(Element_index e = 0; e < elements.size(); ++e)
      if(is_quadratic[e])
        for_each_edge(e, [&](Vertex_index edge, int) { nodes[edge] = 0; });
    for(std::size_t edge = 0; edge < nodes.size(); ++edge)
      if(nodes[edge] != no_vertex) {
        nodes[edge] = Vertex_index(number_of_nodes());
        m_ends.push_back(all.ends[edge]);
      }
    for(Element_index e = 0; e < elements.size(); ++e) {
      m_starts.push_back(m_edges.size());
      for_each_edge(e, [&](Vertex_index edge, int i) {
        if(nodes[edge] != no_vertex)
          m_edges.push_back({nodes[edge], i});
      });
    }
    m_starts.push_back(m_edges.size());
  }

  const Element_list& elements() const { return *m_elements; }
  std::size_t number_of_vertices() const { return m_number_of_vertices; }
  std::size_t number_of_nodes() const { return m_number_of_vertices + m_ends.size(); }

  bool has_edges() const { return !m_ends.empty(); }
  /// Whether an edge of an element is a node.
  bool has_edges(Element_index e) const { return has_edges() && m_starts[e] != m_starts[e + 1]; }
  /// Both ends of each edge that is a node, the smaller one first.
  const std::vector<std::array<Vertex_index, 2>>& ends() const { return m_ends; }

  /// Sets the edges whose values are the displacements of their middles, one value for each of `ends()`.
  void set_middles(std::vector<bool> is_middle) { m_is_middle = std::move(is_middle); }
  bool has_middles() const { return !m_is_middle.empty(); }
  bool is_middle(Vertex_index node) const
  {
    return has_middles() && node >= m_number_of_vertices && m_is_middle[node - m_number_of_vertices];
  }

  Nodes_of_element operator[](Element_index e) const
  {
    Nodes_of_element nodes((*m_elements)[e]);
    if(has_edges()) {
      const int vertices = nodes.size();
      const auto& edges = (*m_elements)[e].reference().edges;
      for(std::size_t i = m_starts[e]; i < m_starts[e + 1]; ++i) {
        const auto& [node, local] = m_edges[i];
        nodes.add_edge(node, vertices + local);
        if(is_middle(node))
          nodes.add_middle({vertices + local, {edges[local][0], edges[local][1]}});
      }
    }
    return nodes;
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FEM_ELEMENT_NODES_H
