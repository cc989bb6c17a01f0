// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INDEX_H
#define CGAL_MIXED_MESH_3_INDEX_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <cstdint>

namespace CGAL {
namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMesh3Mesh
/// A number of 32 bits that counts one kind of item: integers convert to the index and back, but an index of
/// another kind does not convert, so that `prescribe(element)` does not compile.
template <class Tag>
class Index
{
  std::uint32_t m_value;

public:
  /// Constructs an index that is not initialized; `Index{}` is 0.
  Index() = default; // `Index{}` is 0
  /// Constructs an index from its number.
  constexpr Index(std::uint32_t value) : m_value(value) {}
  /// Deleted: an index of another kind does not convert.
  template <class Other>
  Index(const Index<Other>&) = delete;

  /// The number.
  constexpr operator std::uint32_t() const { return m_value; }

  /// Moves to the next index.
  Index& operator++()
  {
    ++m_value;
    return *this;
  }
  /// Moves to the next index, and returns the old one.
  Index operator++(int)
  {
    const Index old = *this;
    ++m_value;
    return old;
  }
  /// Moves to the previous index.
  Index& operator--()
  {
    --m_value;
    return *this;
  }
};

/// \ingroup PkgMixedMesh3Mesh
/// The number of a vertex of a mesh.
using Vertex_index = Index<struct Vertex_index_tag>;
/// \ingroup PkgMixedMesh3Mesh
/// The number of an element of a mesh.
using Element_index = Index<struct Element_index_tag>;

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INDEX_H
