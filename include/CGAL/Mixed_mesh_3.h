// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_H
#define CGAL_MIXED_MESH_3_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Data_columns.h>
#include <CGAL/Mixed_mesh_3/Element_attributes.h>
#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/Mixed_element_traits_3.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {

/*!
\ingroup PkgMixedMesh3Mesh

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
  /// The geometric traits.
  using Geom_traits = GeomTraits;
  /// The type of points.
  using Point_3 = typename Geom_traits::Point_3;
  static_assert(!std::is_same_v<std::decay_t<decltype(std::declval<const Point_3&>().x())>, float>,
                "positions are doubles: float would round them, and elements proved valid could be inverted");
  /// The number of a vertex, from 0.
  using Vertex_index = Mixed_meshes_3::Vertex_index;
  /// The number of an element, from 0.
  using Element_index = Mixed_meshes_3::Element_index;
  /// Tetrahedron, pyramid, prism or hexahedron.
  using Element_kind = Mixed_meshes_3::Element_kind;
  /// The label of elements.
  using Subdomain_index = Mixed_meshes_3::Subdomain_index;
  /// The attributes of an element besides its kind and vertices.
  using Element_attributes = Mixed_meshes_3::Element_attributes;
  /// The data of the user.
  using Data_columns = Mixed_meshes_3::Data_columns;
  /// An element: its kind and its vertices, a range.
  using Element = Mixed_meshes_3::Element_view;
  /// The list of elements.
  using Elements = Mixed_meshes_3::Element_list;

  /// The number of vertices.
  std::size_t number_of_vertices() const { return m_points.size(); }
  /// The number of elements.
  std::size_t number_of_elements() const { return m_elements.size(); }
  /// Whether there is no element.
  bool is_empty() const { return m_elements.empty(); }

  /// The position of a vertex. \pre `v < number_of_vertices()`, not checked
  const Point_3& point(Vertex_index v) const { return m_points[v]; }
  /// An element: its kind, and its vertices in the order of `Mixed_meshes_3::Reference_element`; valid until
  /// elements are added or the mesh is assigned to. \pre `e < number_of_elements()`, not checked
  Element element(Element_index e) const { return m_elements[e]; }

  /// The attributes of an element. \pre `e < number_of_elements()`, not checked
  const Element_attributes& attributes(Element_index e) const { return m_attributes[e]; }
  /// The attributes of all elements, in their order.
  const std::vector<Element_attributes>& attributes() const { return m_attributes; }
  /// Whether the element meets the region of interest.
  bool is_in_region(Element_index e) const { return m_attributes[e].is_in_region; }
  /// The label of the element, for example its material.
  Subdomain_index subdomain_index(Element_index e) const { return m_attributes[e].subdomain_index; }
  /// Sets the label of an element. \pre `index` is positive: 0 is outside
  void set_subdomain_index(Element_index e, Subdomain_index index)
  {
    CGAL_precondition(index > 0);
    m_attributes[e].subdomain_index = index;
  }

  /// The positions of all vertices.
  const std::vector<Point_3>& points() const { return m_points; }
  /// The positions of all vertices; the caller may change positions, and has to keep elements valid.
  std::vector<Point_3>& points() { return m_points; }
  /// All elements.
  const Elements& elements() const { return m_elements; }

  /// \name Data of the user
  /// @{

  /// The data at the vertices.
  const Data_columns& vertex_data() const { return m_vertex_data; }
  /// The data at the vertices; the caller may change columns, which have a row for each vertex.
  Data_columns& vertex_data() { return m_vertex_data; }
  /// The data of the elements.
  const Data_columns& element_data() const { return m_element_data; }
  /// The data of the elements; the caller may change columns, which have a row for each element.
  Data_columns& element_data() { return m_element_data; }
  /// @}

  /// \name Construction
  /// @{

  /// Adds a vertex at a point; data there are NaN.
  Vertex_index add_vertex(const Point_3& p)
  {
    m_points.push_back(p);
    m_vertex_data.add_row();
    return Vertex_index(m_points.size() - 1);
  }

  /// Adds an element; its vertices are in the order of `reference_elements`, and its data are NaN.
  template <class Vertices>
  Element_index add_element(Element_kind kind, const Vertices& vertices,
                            const Element_attributes& attributes = {})
  {
    CGAL_precondition(attributes.subdomain_index > 0);
    m_elements.add(kind, vertices);
    m_attributes.push_back(attributes);
    m_element_data.add_row();
    return Element_index(m_elements.size() - 1);
  }

  /// Adds an element with a list of vertices.
  Element_index add_element(Element_kind kind, std::initializer_list<Vertex_index> vertices,
                            const Element_attributes& attributes = {})
  {
    return add_element<std::initializer_list<Vertex_index>>(kind, vertices, attributes);
  }

  /// Takes whole arrays over, and the data, by default none.
  /// \pre `attributes.size() == elements.size()`, subdomain indices are positive, columns have a row for each
  /// vertex, or each element
  void assign(std::vector<Point_3> points, Elements elements, std::vector<Element_attributes> attributes,
              Data_columns vertex_data = {}, Data_columns element_data = {})
  {
    CGAL_precondition(attributes.size() == elements.size());
    CGAL_precondition(vertex_data.has_size(points.size()) && element_data.has_size(elements.size()));
    CGAL_expensive_precondition(
      std::all_of(attributes.begin(), attributes.end(),
                  [](const Element_attributes& a) { return a.subdomain_index > 0; }));
    m_points = std::move(points);
    m_elements = std::move(elements);
    m_attributes = std::move(attributes);
    m_vertex_data = std::move(vertex_data);
    m_element_data = std::move(element_data);
  }

  /// Removes all vertices, elements and data.
  void clear() { *this = Mixed_mesh_3(); }
  /// @}

private:
  std::vector<Point_3> m_points;
  Elements m_elements;
  std::vector<Element_attributes> m_attributes;
  Data_columns m_vertex_data, m_element_data;
};

} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_H
