// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Nodes of linear or quadratic elements, as files list them: the vertices, then the middles of edges.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_MESH_NODES_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_MESH_NODES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/Face.h>
#include <CGAL/Mixed_mesh_3/IO/Data_array.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/element_names.h>
#include <CGAL/Mixed_mesh_3/Index.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/Middle_nodes.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <iterator>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

using Mixed_meshes_3::internal::Middle_nodes;
using Mixed_meshes_3::internal::quadratic_connectivity;

/// The mean, rounded once: halves are exact, but where the sum overflows or two of them underflow.
inline double rounded_mean(double x, double y)
{
  const double sum = x + y;
  return std::isfinite(sum) ? sum / 2 : x / 2 + y / 2;
}

/// The nodes of an element or of a face.
class Node_list
{
  std::array<Vertex_index, 20> m_nodes;
  int m_size = 0;

public:
  void push_back(Vertex_index node) { m_nodes[std::size_t(m_size++)] = node; }
  int size() const { return m_size; }
  const Vertex_index* begin() const { return m_nodes.data(); }
  const Vertex_index* end() const { return m_nodes.data() + m_size; }
};

/// The order in which a format has the nodes in the middle of edges: a member of `Element_names`.
using Edge_order = std::uint8_t (Element_names::*)[12];

/// The nodes of a mesh as elements of order 1 or 2 have them. Keeps a reference to the mesh; takes no memory
/// with order 1.
template <class Mesh>
class Mesh_nodes
{
  const Mesh& m_mesh;
  int m_order;
  Middle_nodes m_middle;

  Vertex_index middle(Element_index e, int edge) const
  {
    return Vertex_index(m_mesh.number_of_vertices()
                        + m_middle.of_elements[m_middle.offsets[e] + std::size_t(edge)]);
  }

  Vertex_index middle(Element_index e, Vertex_index v, Vertex_index w) const
  {
    const Element_view element = m_mesh.element(e);
    int i = 0;
    for(; i + 1 < element.reference().number_of_edges; ++i) {
      const Vertex_index a = element[element.reference().edges[i][0]],
                         b = element[element.reference().edges[i][1]];
      if((a == v && b == w) || (a == w && b == v))
        break;
    }
    return middle(e, i);
  }

public:
  /// \pre the order is 1 or 2
  Mesh_nodes(const Mesh& mesh, int order) : m_mesh(mesh), m_order(order)
  {
    CGAL_precondition(order == 1 || order == 2);
    if(order == 2)
      m_middle = quadratic_connectivity(mesh.elements(), mesh.number_of_vertices());
  }

  int order() const { return m_order; }
  std::size_t size() const { return m_mesh.number_of_vertices() + m_middle.ends.size(); }

  /// Nodes of all elements, each counted once for each of its elements.
  std::size_t number_of_incidences() const
  {
    return m_mesh.elements().connectivity().size() + m_middle.of_elements.size();
  }

  /// Number of nodes of an element.
  int number_of_nodes(Element_index e) const
  {
    const Element_view element = m_mesh.element(e);
    return element.size() + (m_order == 2 ? element.reference().number_of_edges : 0);
  }

  const Element_names& names(Element_kind kind) const { return names_of(kind, m_order); }

  /// Both ends of the edge of a middle node; of a vertex, that twice: it is their mean, too.
  std::array<Vertex_index, 2> ends(std::size_t node) const
  {
    const std::size_t n = m_mesh.number_of_vertices();
    return node < n ? std::array<Vertex_index, 2>{Vertex_index(node), Vertex_index(node)}
                    : m_middle.ends[node - n];
  }

  Mixed_meshes_3::Vec3 point(std::size_t node) const
  {
    const auto [a, b] = ends(node);
    Mixed_meshes_3::Vec3 p = Mixed_meshes_3::to_vec3(m_mesh.points()[a]);
    const Mixed_meshes_3::Vec3 q = Mixed_meshes_3::to_vec3(m_mesh.points()[b]);
    for(std::size_t i = 0; i < 3; ++i)
      p[i] = rounded_mean(p[i], q[i]);
    return p;
  }

  /// Of an element: its vertices, then the middle nodes in the order of a format.
  Node_list of(Element_index e, Edge_order order) const
  {
    Node_list nodes;
    const Element_view element = m_mesh.element(e);
    for(Vertex_index v : element)
      nodes.push_back(v);
    for(int i = 0; m_order == 2 && i < element.reference().number_of_edges; ++i)
      nodes.push_back(middle(e, (names(element.kind()).*order)[i]));
    return nodes;
  }

  /// Of a face: its vertices, then the middle nodes from the first vertex on. All formats agree on that.
  Node_list of(const Face& face) const
  {
    Node_list nodes;
    const Face_vertices& vertices = face.vertices();
    for(Vertex_index v : vertices)
      nodes.push_back(v);
    for(int i = 0; m_order == 2 && i < vertices.size(); ++i)
      nodes.push_back(middle(face.element(), vertices[i], vertices[(i + 1) % vertices.size()]));
    return nodes;
  }

  /// The nodes of faces, ascending.
  std::vector<Vertex_index> of(const std::vector<Face>& faces) const
  {
    std::vector<Vertex_index> nodes;
    for(const Face& face : faces) {
      const Node_list some = of(face);
      nodes.insert(nodes.end(), some.begin(), some.end());
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
  }
};

/// Whether a format has a name for each kind of element that there is. \pre the order is 1 or 2
template <class Mesh>
bool has_all_kinds(const Mesh& mesh, int order, const char* Element_names::*name)
{
  const auto counts = mesh.elements().counts();
  return std::all_of(std::begin(element_kinds), std::end(element_kinds), [&](Element_kind kind) {
    return counts[kind] == 0 || names_of(kind, order).*name != nullptr;
  });
}

/// Values at the vertices, or at the nodes, as values at the nodes. Keeps references to those that are.
class Node_data
{
  std::deque<std::vector<double>> m_values;
  std::vector<Data_array> m_arrays;

public:
  template <class Mesh>
  Node_data(const Mesh_nodes<Mesh>& nodes, const std::vector<Data_array>& vertex_data) : m_arrays(vertex_data)
  {
    if(nodes.order() == 1)
      return;
    for(Data_array& array : m_arrays) {
      if(array.has_size(nodes.size()))
        continue;
      const std::size_t n = std::size_t(array.number_of_components);
      const std::vector<double>& of_vertices = *array.values;
      std::vector<double>& values = m_values.emplace_back();
      values.reserve(nodes.size() * n);
      for(std::size_t node = 0; node < nodes.size(); ++node)
        for(std::size_t i = 0; i < n; ++i)
          values.push_back(
            rounded_mean(of_vertices[nodes.ends(node)[0] * n + i], of_vertices[nodes.ends(node)[1] * n + i]));
      array.values = &values;
    }
  }

  Node_data(const Node_data&) = delete; // arrays refer to values
  Node_data& operator=(const Node_data&) = delete;

  const std::vector<Data_array>& arrays() const { return m_arrays; }
};

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_MESH_MESH_NODES_H
