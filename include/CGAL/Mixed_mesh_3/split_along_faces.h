// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_SPLIT_ALONG_FACES_H
#define CGAL_MIXED_MESH_3_SPLIT_ALONG_FACES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Data_columns.h>
#include <CGAL/Mixed_mesh_3/Face.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/internal/base/Disjoint_sets.h>
#include <CGAL/Mixed_mesh_3/internal/elements/for_each_face.h>
#include <CGAL/Mixed_mesh_3/internal/elements/manifold_defects.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMesh3Validity
/// The result of `split_along_faces()`.
struct Slit
{
  /// The faces of the slit, from both sides; in the order of the first faces.
  std::vector<std::pair<Face, Face>> faces;
  std::vector<Vertex_index> origins; ///< vertex of which each added vertex is a copy
  /// The number of faces that stay closed: all of their vertices are at the rim; or parts of the slit would
  /// meet in an edge or a vertex only, where the boundary would not be manifold.
  std::size_t number_of_faces_left = 0;
};

namespace internal {

/// The vertices of a mesh when some of its faces are slit.
template <class Mesh>
class Slit_vertices
{
  using Key = std::array<Vertex_index, 4>; // ascending

  const Mesh& m_mesh;
  std::map<Key, std::pair<Face, Face>> m_faces;
  std::vector<Element_index> m_elements; // elements at vertices of the slit
  Element_list m_new_elements;           // copies of the elements with the new vertices
  std::vector<Vertex_index> m_origins;

public:
  Slit_vertices(const Mesh& mesh, const std::vector<Face>& faces) : m_mesh(mesh)
  {
    std::set<Key> keys;
    for(const Face& face : faces)
      keys.insert(key(face));
    const auto is_candidate = is_of(vertices_of(faces));
    for_each_face(mesh.elements(), mesh.number_of_vertices(), is_candidate, [&](const auto& group) {
      if(group.size() == 2 && keys.count(key(group[0])) > 0)
        m_faces.emplace(key(group[0]), std::make_pair(group[0], group[1]));
    });
    for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
      if(const Element_view element = mesh.element(e);
         std::any_of(element.begin(), element.end(), is_candidate))
        m_elements.push_back(e);
    open();
    while(leave_out_pinching())
      open();
  }

  const std::vector<Vertex_index>& origins() const { return m_origins; }
  const std::map<Key, std::pair<Face, Face>>& faces() const { return m_faces; }

  /// All elements of the mesh with the slit.
  Element_list elements() const
  {
    Element_list all;
    std::size_t next = 0;
    for(Element_index e = 0; e < m_mesh.number_of_elements(); ++e) {
      const bool is_changed = next < m_elements.size() && m_elements[next] == e;
      const Element_view element = is_changed ? m_new_elements[Element_index(next++)] : m_mesh.element(e);
      all.add(element.kind(), element.begin());
    }
    return all;
  }

private:
  static Key key(const Face& face)
  {
    Key k = face.vertices().padded();
    sort_vertices(k);
    return k;
  }

  static auto is_of(std::vector<Vertex_index> ascending)
  {
    return [vertices = std::move(ascending)](Vertex_index v) {
      return std::binary_search(vertices.begin(), vertices.end(), v);
    };
  }

  std::vector<Vertex_index> vertices() const
  {
    std::vector<Face> faces;
    for(const auto& [k, sides] : m_faces)
      faces.push_back(sides.first);
    return vertices_of(faces);
  }

  // Opens the slit. A vertex stays single where its elements are connected by faces that are not slit; of
  // other elements, the later ones get copies.
  void open()
  {
    using Corner = std::pair<Vertex_index, std::size_t>; // a vertex, and an element that has it
    const auto is_slit = is_of(vertices());
    Element_list around;
    std::map<Corner, std::size_t> corners;
    for(std::size_t i = 0; i < m_elements.size(); ++i) {
      const Element_view element = m_mesh.element(m_elements[i]);
      around.add(element.kind(), element.begin());
      for(Vertex_index v : element)
        if(is_slit(v))
          corners.emplace(Corner(v, i), corners.size());
    }
    internal::Disjoint_sets sets(corners.size());
    for_each_face(around, m_mesh.number_of_vertices(), [&](const auto& group) {
      if(group.size() != 2 || m_faces.count(key(group[0])) > 0)
        return;
      const Face face = group[0];
      for(Vertex_index v : face.vertices())
        if(is_slit(v))
          sets.unite(corners.at({v, group.element(0)}), corners.at({v, group.element(1)}));
    });

    m_origins.clear();
    std::vector<Vertex_index> numbers(corners.size(), no_vertex); // numbers of sets
    Vertex_index last = no_vertex;
    std::map<Corner, Vertex_index> renamed;
    for(const auto& [corner, c] : corners) { // sorted by vertex, then by element
      Vertex_index& number = numbers[sets.least(c)];
      if(number == no_vertex) {
        number = corner.first;
        if(corner.first == last) {
          number = Vertex_index(m_mesh.number_of_vertices() + m_origins.size());
          m_origins.push_back(corner.first);
        }
        last = corner.first;
      }
      renamed[corner] = number;
    }
    m_new_elements = Element_list();
    for(std::size_t i = 0; i < m_elements.size(); ++i) {
      std::array<Vertex_index, 8> v{};
      const Element_view element = around[Element_index(i)];
      for(int k = 0; k < element.size(); ++k) {
        const auto found = renamed.find({element[k], i});
        v[std::size_t(k)] = found == renamed.end() ? element[k] : found->second;
      }
      m_new_elements.add(element.kind(), v.data());
    }
  }

  // Removes faces where the boundary would not be manifold. \return whether there were such faces
  bool leave_out_pinching()
  {
    Mesh slit;
    auto points = m_mesh.points();
    for(Vertex_index v : m_origins)
      points.push_back(m_mesh.point(v));
    slit.assign(std::move(points), elements(), m_mesh.attributes());
    std::vector<Face_vertices> polygons;
    for(const Face& face : boundary_faces(slit))
      polygons.push_back(face.vertices());
    const Manifold_defects defects = manifold_defects(polygons);
    const auto origin = [this](Vertex_index v) {
      return v < m_mesh.number_of_vertices() ? v : m_origins[v - m_mesh.number_of_vertices()];
    };
    const auto has = [](const Key& k, Vertex_index v) { return std::find(k.begin(), k.end(), v) != k.end(); };
    bool changed = false;
    for(const auto& [a, b] : defects.edges) {
      const Vertex_index v = origin(a), w = origin(b);
      const auto at_edge = std::find_if(m_faces.begin(), m_faces.end(),
                                        [&](const auto& f) { return has(f.first, v) && has(f.first, w); });
      if(at_edge != m_faces.end()) {
        m_faces.erase(at_edge);
        changed = true;
      }
    }
    if(changed)
      return true;
    for(Vertex_index v : defects.vertices)
      for(auto f = m_faces.begin(); f != m_faces.end();)
        if(has(f->first, origin(v))) {
          f = m_faces.erase(f);
          changed = true;
        } else {
          ++f;
        }
    return changed;
  }
};

} // namespace internal

/*!
\ingroup PkgMixedMesh3Validity

Slits a mesh along faces between its elements: the vertices of the faces are doubled, so that both sides can
come apart, or slide along each other. Vertices at the rim of the faces, where the elements around are still
connected, stay single, except on the boundary of the mesh: the slit is open there. A vertex where sheets meet
gets as many copies as there are parts around.

All vertices and elements keep their numbers and their data; copies are at the end, at the same places as
their originals, with the same data.
The mesh is conforming except for the slit, and no element changes its shape. The boundary is a manifold if it
was one: where it would not be, faces stay closed.

\param mesh a conforming mesh; vertices are added
\param faces faces of the mesh, from either side, such as those of `find_sheet_faces()`. Faces on the boundary
are ignored
\par Complexity
O(n log n) for n elements, several times
*/
template <class Mesh>
Slit split_along_faces(Mesh& mesh, const std::vector<Face>& faces)
{
  Slit result;
  if(faces.empty())
    return result;
  const internal::Slit_vertices<Mesh> slit(mesh, faces);
  auto points = mesh.points();
  for(Vertex_index v : slit.origins())
    points.push_back(mesh.point(v));
  Element_list elements = slit.elements();
  for(const Face& face : faces) {
    std::array<Vertex_index, 4> key = face.vertices().padded();
    internal::sort_vertices(key);
    const auto found = slit.faces().find(key);
    if(found == slit.faces().end()) {
      ++result.number_of_faces_left;
      continue;
    }
    const auto& [first, second] = found->second;
    const Face a(elements, first.element(), first.local_index()),
      b(elements, second.element(), second.local_index());
    if(std::is_permutation(a.vertices().begin(), a.vertices().end(), b.vertices().begin()))
      ++result.number_of_faces_left;
    else
      result.faces.emplace_back(first == face ? a : b, first == face ? b : a);
  }
  result.origins = slit.origins();
  Data_columns vertex_data = mesh.vertex_data();
  for(Vertex_index v : result.origins)
    vertex_data.add_row({{v, 1}});
  mesh.assign(std::move(points), std::move(elements), mesh.attributes(), std::move(vertex_data),
              mesh.element_data());
  return result;
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_SPLIT_ALONG_FACES_H
