// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_H
#define CGAL_MIXED_MESH_3_H

#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/Mixed_element_traits_3.h>

#include <CGAL/assertions.h>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <utility>
#include <vector>

namespace CGAL {

/*!
\brief A volume mesh of tetrahedra, pyramids, prisms and hexahedra.

Vertices and elements are numbered from 0, in arrays. The vertices of an element are ordered as in
`Mixed_meshes_3::Reference_element`, such that the Jacobian of a valid element is positive.

\tparam GeomTraits a model of `MixedMeshTraits_3`, for example any CGAL kernel. Positions are
        always doubles, whatever the number type of the traits.
*/
template <class GeomTraits>
class Mixed_mesh_3
{
public:
  using Geom_traits = GeomTraits;
  using Point_3 = typename Geom_traits::Point_3;
  using Vertex_index = Mixed_meshes_3::Vertex_index;
  using Element_index = Mixed_meshes_3::Element_index;
  using Element_kind = Mixed_meshes_3::Element_kind;
  using Element = Mixed_meshes_3::Element_view;
  using Elements = Mixed_meshes_3::Element_list;

  /// A face on the boundary: vertices counter-clockwise seen from outside, and where it belongs.
  struct Boundary_face
  {
    Element_index element;
    int local_face; ///< position in the element's `Reference_element::faces`
  };

  std::size_t number_of_vertices() const { return m_points.size(); }
  std::size_t number_of_elements() const { return m_elements.size(); }
  bool is_empty() const { return m_elements.empty(); }

  const Point_3& point(Vertex_index v) const { return m_points[v]; }
  Element element(std::size_t e) const { return m_elements[e]; }

  /// Whether the element meets the region of interest.
  bool is_in_region(std::size_t e) const { return m_in_region[e] != 0; }

  const std::vector<Point_3>& points() const { return m_points; }
  std::vector<Point_3>& points() { return m_points; }
  const Elements& elements() const { return m_elements; }

  /// Faces that belong to one element only, in the order of the elements.
  const std::vector<Boundary_face>& boundary_faces() const { return m_boundary_faces; }
  void set_boundary_faces(std::vector<Boundary_face> faces) { m_boundary_faces = std::move(faces); }

  /// \name Construction
  /// @{

  /// Adds a vertex at a point.
  Vertex_index add_vertex(const Point_3& p)
  {
    m_points.push_back(p);
    return Vertex_index(m_points.size() - 1);
  }

  /// Adds an element; its vertices are in the order of `reference_elements`.
  template <class Vertices>
  Element_index add_element(Element_kind kind, const Vertices& vertices, bool in_region = false)
  {
    m_elements.add(kind, vertices);
    m_in_region.push_back(in_region);
    return Element_index(m_elements.size() - 1);
  }

  /// As above.
  Element_index add_element(Element_kind kind, std::initializer_list<Vertex_index> vertices,
                            bool in_region = false)
  {
    return add_element<std::initializer_list<Vertex_index>>(kind, vertices, in_region);
  }

  /// Takes whole arrays over. \pre `in_region.size() == elements.size()`
  void assign(std::vector<Point_3> points, Elements elements, std::vector<std::uint8_t> in_region)
  {
    CGAL_precondition(in_region.size() == elements.size());
    m_points = std::move(points);
    m_elements = std::move(elements);
    m_in_region = std::move(in_region);
    m_boundary_faces.clear();
  }

  /// Removes all vertices and elements.
  void clear() { *this = Mixed_mesh_3(); }
  /// @}

private:
  std::vector<Point_3> m_points;
  Elements m_elements;
  std::vector<std::uint8_t> m_in_region;
  std::vector<Boundary_face> m_boundary_faces;
};

} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_H
