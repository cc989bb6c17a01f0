// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_ELEMENT_LIST_H
#define CGAL_MIXED_MESH_3_ELEMENT_LIST_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Index.h>
#include <CGAL/Mixed_mesh_3/Mixed_element_traits_3.h>

#include <CGAL/assertions.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <stdexcept>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMesh3Mesh
/// An element as seen in a list: a kind and its vertices. The view is valid as long as the list is not
/// changed.
class Element_view
{
  const Vertex_index* m_vertices;
  Element_kind m_kind;

public:
  /// Constructs an element of a kind from a pointer to its vertices.
  Element_view(Element_kind kind, const Vertex_index* vertices) : m_vertices(vertices), m_kind(kind) {}

  /// The kind.
  Element_kind kind() const { return m_kind; }
  /// The row of the element's kind in the table: faces, edges, corners.
  const Reference_element& reference() const { return reference_elements[m_kind]; }
  /// The number of vertices.
  int size() const { return reference().number_of_vertices; }
  /// Vertex `i`. \pre `0 <= i < size()`, not checked
  Vertex_index operator[](int i) const { return m_vertices[i]; }
  /// The first vertex.
  const Vertex_index* begin() const { return m_vertices; }
  /// The end of the vertices.
  const Vertex_index* end() const { return m_vertices + size(); }
};

/*!
\ingroup PkgMixedMesh3Mesh

\brief The connectivity of a mesh of mixed elements, in one contiguous array.

Elements keep the order in which they were added. Geometry is elsewhere: the stages use this list
with lattice positions, `Mixed_mesh_3` uses it with points.
*/
class Element_list
{
  void check_size(std::size_t more) const
  {
    if(more > Element_index(-1) - m_kinds.size())
      throw std::length_error("Mixed_mesh_3: more than 2^32 elements");
  }

  std::vector<Element_kind> m_kinds;
  std::vector<std::size_t> m_offsets{0};
  std::vector<Vertex_index> m_vertices;

public:
  /// The number of elements.
  std::size_t size() const { return m_kinds.size(); }
  /// Whether there is no element.
  bool empty() const { return m_kinds.empty(); }

  /// An element; valid until elements are added. \pre `e < size()`, not checked
  Element_view operator[](Element_index e) const { return {m_kinds[e], m_vertices.data() + m_offsets[e]}; }

  /// Adds an element. \pre `vertices` points to as many vertices as the kind has
  void add(Element_kind kind, const Vertex_index* vertices)
  {
    check_size(1);
    m_kinds.push_back(kind);
    m_vertices.insert(m_vertices.end(), vertices, vertices + reference_elements[kind].number_of_vertices);
    m_offsets.push_back(m_vertices.size());
  }

  /// Adds an element. \pre `vertices` has as many entries as the kind has vertices
  template <class Vertices>
  auto add(Element_kind kind, const Vertices& vertices) -> decltype(std::data(vertices), void())
  {
    CGAL_precondition(int(std::size(vertices)) == reference_elements[kind].number_of_vertices);
    add(kind, std::data(vertices));
  }

  /// Adds an element from a list of vertices.
  void add(Element_kind kind, std::initializer_list<Vertex_index> vertices)
  {
    add<std::initializer_list<Vertex_index>>(kind, vertices);
  }

  /// Adds `n` elements of one kind, whose vertices are to be written to `connectivity()`.
  void add_many(Element_kind kind, std::size_t n)
  {
    check_size(n);
    const std::size_t size = std::size_t(reference_elements[kind].number_of_vertices);
    m_kinds.insert(m_kinds.end(), n, kind);
    m_offsets.reserve(m_offsets.size() + n);
    for(std::size_t i = 0; i < n; ++i)
      m_offsets.push_back(m_offsets.back() + size);
    m_vertices.resize(m_vertices.size() + n * size);
  }

  /// Reserves memory for a number of elements, and of vertices, counted once for each element.
  void reserve(std::size_t elements, std::size_t vertices)
  {
    m_kinds.reserve(elements);
    m_offsets.reserve(elements + 1);
    m_vertices.reserve(vertices);
  }

  /// Number of elements of each kind.
  std::array<std::size_t, number_of_element_kinds> counts() const
  {
    std::array<std::size_t, number_of_element_kinds> n{};
    for(Element_kind kind : m_kinds)
      ++n[kind];
    return n;
  }

  /// \name Raw arrays
  /// Arrays for writers and for renumbering: vertices of element `e` are `connectivity()[offsets()[e]] ...
  /// connectivity()[offsets()[e + 1] - 1]`.
  /// @{
  const std::vector<Element_kind>& kinds() const { return m_kinds; }           ///< one for each element
  const std::vector<std::size_t>& offsets() const { return m_offsets; }        ///< one more than elements
  const std::vector<Vertex_index>& connectivity() const { return m_vertices; } ///< vertices of all elements
  std::vector<Vertex_index>& connectivity() { return m_vertices; }             ///< vertices of all elements
  /// @}
};

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_ELEMENT_LIST_H
