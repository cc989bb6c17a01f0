// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_FACE_H
#define CGAL_MIXED_MESH_3_FACE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/Index.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <tuple>

namespace CGAL {
namespace Mixed_meshes_3 {

namespace internal {

inline constexpr Vertex_index no_vertex = Vertex_index(-1);
inline constexpr Element_index no_element = Element_index(-1);

} // namespace internal

/// \ingroup PkgMixedMesh3Mesh
/// The three or four vertices of a face, as a range.
class Face_vertices
{
  std::array<Vertex_index, 4> m_vertices;
  std::uint8_t m_size;

public:
  /// Constructs a face from its vertices. \pre there are three or four vertices
  Face_vertices(std::initializer_list<Vertex_index> vertices) : m_size(std::uint8_t(vertices.size()))
  {
    CGAL_precondition(m_size == 3 || m_size == 4);
    m_vertices[3] = internal::no_vertex;
    std::copy(vertices.begin(), vertices.end(), m_vertices.begin());
  }

  /// The number of vertices, three or four.
  int size() const { return m_size; }
  /// Vertex `i`. \pre `0 <= i < size()`, not checked
  Vertex_index operator[](int i) const { return m_vertices[std::size_t(i)]; }
  /// Vertex `i`, which may be changed.
  Vertex_index& operator[](int i) { return m_vertices[std::size_t(i)]; }
  /// The first vertex.
  const Vertex_index* begin() const { return m_vertices.data(); }
  /// The end of the vertices.
  const Vertex_index* end() const { return m_vertices.data() + m_size; }

  /// All four vertices; the fourth of a triangle is the same for all triangles, and larger than any index.
  const std::array<Vertex_index, 4>& padded() const { return m_vertices; }
};

/// \ingroup PkgMixedMesh3Mesh
/// A face of an element, with its vertices counter-clockwise seen from outside the element.
class Face
{
  Face_vertices m_vertices;
  std::uint8_t m_local_index;
  Element_index m_element;

public:
  /// Constructs face `local_index` of an element, in the order of `Reference_element::faces`.
  Face(const Element_list& elements, Element_index element, int local_index)
    : m_vertices{0, 0, 0}, m_local_index(std::uint8_t(local_index)), m_element(element)
  {
    const Element_view e = elements[element];
    const Element_face& f = e.reference().faces[local_index];
    m_vertices = f.size == 3
                   ? Face_vertices{e[f.vertices[0]], e[f.vertices[1]], e[f.vertices[2]]}
                   : Face_vertices{e[f.vertices[0]], e[f.vertices[1]], e[f.vertices[2]], e[f.vertices[3]]};
  }

  /// The vertices of the face, counter-clockwise seen from outside the element.
  const Face_vertices& vertices() const { return m_vertices; }
  /// The element that the face belongs to.
  Element_index element() const { return m_element; }
  /// The position of the face in `Reference_element::faces` of its element.
  int local_index() const { return m_local_index; }

  /// Compares faces in the order of the elements.
  bool operator<(const Face& f) const
  {
    return std::make_tuple(m_element, m_local_index) < std::make_tuple(f.m_element, f.m_local_index);
  }
  /// Whether both are the same face of the same element.
  bool operator==(const Face& f) const
  {
    return m_element == f.m_element && m_local_index == f.m_local_index;
  }
};

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_FACE_H
