// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_LINEAR_CELL_COMPLEX_H
#define CGAL_MIXED_MESH_3_LINEAR_CELL_COMPLEX_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/Face.h>

#include <CGAL/Cell_attribute.h>
#include <CGAL/Cell_attribute_with_point.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {

/*!
\ingroup PkgMixedMesh3Validity

\brief Items of a linear cell complex whose volumes store the attributes of the elements of a mesh.

Labels go from mesh to complex and back with these items, or others whose 3-attributes have
`Mixed_meshes_3::Element_attributes` as information.

\cgalModels{LinearCellComplexItems}
*/
struct Mixed_mesh_linear_cell_complex_items_3
{
  /// The attributes of darts.
  template <class LCC>
  struct Dart_wrapper
  {
    /// The point of a vertex, nothing for edges and faces, and the attributes of an element.
    using Attributes = std::tuple<Cell_attribute_with_point<LCC>, void, void,
                                  Cell_attribute<LCC, Mixed_meshes_3::Element_attributes>>;
  };
};

namespace Mixed_meshes_3 {
namespace internal {

/// Whether volumes of a complex store `Element_attributes`.
template <class Attribute, class = void>
struct Holds_element_attributes : std::false_type
{
};
template <class Attribute>
struct Holds_element_attributes<Attribute, std::void_t<typename Attribute::Info>>
  : std::is_same<typename Attribute::Info, Element_attributes>
{
};
template <class LCC>
inline constexpr bool holds_element_attributes =
  Holds_element_attributes<typename LCC::template Attribute_type<3>::type>::value;

/// The face that numbers an element: a quadrilateral of a pyramid, a triangle of a prism. The face has vertex
/// 0, and 1 as its last vertex.
inline int base_face(Element_kind kind)
{
  constexpr int faces[number_of_element_kinds] = {3, 0, 0, 4};
  return faces[kind];
}

/// The kind of a volume with given numbers of faces, of triangles among them, and of vertices; none if the
/// volume is not an element.
inline std::pair<Element_kind, bool> kind_of_volume(int faces, int triangles, std::size_t vertices)
{
  for(const Element_kind kind : element_kinds) {
    const Reference_element& r = reference_elements[kind];
    int n = 0;
    for(int f = 0; f < r.number_of_faces; ++f)
      n += r.faces[f].size == 3;
    if(r.number_of_faces == faces && n == triangles && std::size_t(r.number_of_vertices) == vertices)
      return {kind, true};
  }
  return {TETRAHEDRON, false};
}

/// A volume of a complex as an element, with the points of its vertices.
template <class LCC>
struct Element_of_complex
{
  Element_kind kind;
  std::vector<const typename LCC::Point*> vertices;
  Element_attributes attributes;
};

/// A handle or descriptor of a dart, which iterators become.
template <class LCC>
using Dart_of =
  std::decay_t<decltype(std::declval<const LCC&>().beta(std::declval<const LCC&>().darts().begin(), 1))>;

/// The number of vertices of the face of a dart, at most 5; the count ends where the face is open.
template <class LCC>
int size_of_face(const LCC& lcc, Dart_of<LCC> dart)
{
  int n = 0;
  Dart_of<LCC> next = dart;
  do {
    next = lcc.template is_free<1>(next) ? dart : lcc.beta(next, 1);
    ++n;
  } while(next != dart && n < 5);
  return n;
}

/// The kind of the volume of a dart with given vertices; none if a face is neither a triangle nor a
/// quadrilateral, or the volume is not an element.
template <class LCC>
std::optional<Element_kind> kind_of_volume(const LCC& lcc, Dart_of<LCC> dart, std::size_t number_of_vertices)
{
  int faces = 0, triangles = 0;
  for(auto f = lcc.template one_dart_per_incident_cell<2, 3>(dart).begin(),
           end = lcc.template one_dart_per_incident_cell<2, 3>(dart).end();
      f != end; ++f) {
    const int n = size_of_face(lcc, f);
    ++faces;
    triangles += n == 3;
    if(n < 3 || n > 4)
      return std::nullopt;
  }
  const auto [kind, is_element] = kind_of_volume(faces, triangles, number_of_vertices);
  return is_element ? std::optional(kind) : std::nullopt;
}

/// The element that is the volume of a dart; none if the volume is not closed, or not an element.
template <class LCC>
std::optional<Element_of_complex<LCC>> element_of_volume(const LCC& lcc, Dart_of<LCC> of_volume)
{
  std::set<const typename LCC::Point*> vertices;
  for(auto d = lcc.template darts_of_cell<3>(of_volume).begin(),
           end = lcc.template darts_of_cell<3>(of_volume).end();
      d != end; ++d) {
    if(lcc.template is_free<2>(d))
      return std::nullopt;
    vertices.insert(&lcc.point(d));
  }
  const std::optional<Element_kind> kind = kind_of_volume(lcc, of_volume, vertices.size());
  if(!kind)
    return std::nullopt;

  const Element_face& base = reference_elements[*kind].faces[base_face(*kind)];
  auto dart = lcc.template darts_of_cell<3>(of_volume).begin();
  while(size_of_face(lcc, dart) != base.size)
    ++dart;
  Element_of_complex<LCC> element{*kind, std::vector<const typename LCC::Point*>(vertices.size()), {}};
  Dart_of<LCC> b = dart;
  for(int i = 0; i < base.size; ++i, b = lcc.beta(b, 0)) {
    const int v = base.vertices[i];
    const int above = *kind == HEXAHEDRON ? v + 4 : *kind == PRISM ? v + 3 : base.size;
    element.vertices[std::size_t(v)] = &lcc.point(b);
    element.vertices[std::size_t(above)] = &lcc.point(lcc.beta(b, 2, 1, 1));
  }
  if(std::set(element.vertices.begin(), element.vertices.end()) != vertices)
    return std::nullopt;
  if constexpr(holds_element_attributes<LCC>)
    if(lcc.template attribute<3>(of_volume) != LCC::null_handle)
      element.attributes = lcc.template info<3>(of_volume);
  return element;
}

} // namespace internal
} // namespace Mixed_meshes_3

/*!
\ingroup PkgMixedMesh3Validity

\brief Adds the elements of a mesh to a linear cell complex, as volumes.

Elements with a face in common are sewn at the face. A vertex at which the mesh is pinched becomes several
vertices. Labels are passed on if the complex has a place for them, as with
`Mixed_mesh_linear_cell_complex_items_3`.

\tparam GeomTraits a model of `MixedMeshTraits_3`
\tparam LCC `Linear_cell_complex_for_combinatorial_map` of dimensions 3, 3
\param mesh a conforming mesh
\param lcc complex to which the elements are added
\par Complexity
O(n log n) for n elements
*/
template <class GeomTraits, class LCC>
void mixed_mesh_to_linear_cell_complex(const Mixed_mesh_3<GeomTraits>& mesh, LCC& lcc)
{
  using namespace Mixed_meshes_3;
  using Dart = std::decay_t<decltype(lcc.create_dart())>;
  const bool was_automatic = lcc.are_attributes_automatically_managed();
  lcc.set_automatic_attributes_management(false); // vertices are the same wherever elements are sewn
  std::vector<decltype(lcc.create_vertex_attribute(typename LCC::Point()))> vertices;
  for(const auto& p : mesh.points())
    vertices.push_back(lcc.create_vertex_attribute(
      typename LCC::Point(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()))));

  // Open faces by their vertices in order: a dart of a face that no second element has had yet, from the
  // smallest vertex.
  std::map<std::vector<Vertex_index>, Dart> open_faces;
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e) {
    const Element_view element = mesh.element(Element_index(e));
    const int base = Mixed_meshes_3::internal::base_face(element.kind());
    std::map<std::pair<Vertex_index, Vertex_index>, Dart> edges;
    Dart first{};
    for(int i = 0; i < element.reference().number_of_faces; ++i) {
      const int f = i == 0 ? base : i <= base ? i - 1 : i;
      const Face face(mesh.elements(), Element_index(e), f);
      // The order is clockwise seen from outside, as in volumes that the complex makes itself.
      std::vector<Vertex_index> v(face.vertices().begin(), face.vertices().end());
      std::reverse(v.begin() + 1, v.end());
      std::vector<Dart> darts;
      for(std::size_t k = 0; k < v.size(); ++k)
        darts.push_back(lcc.create_dart(vertices[v[k]]));
      if(i == 0)
        first = darts[0];
      std::size_t smallest = 0;
      for(std::size_t k = 0; k < v.size(); ++k) {
        lcc.template sew<1>(darts[k], darts[(k + 1) % v.size()]);
        const Vertex_index a = v[k], b = v[(k + 1) % v.size()];
        const auto opposite = edges.find({b, a});
        if(opposite == edges.end())
          edges.emplace(std::pair(a, b), darts[k]);
        else
          lcc.template sew<2>(darts[k], opposite->second);
        smallest = a < v[smallest] ? k : smallest;
      }
      std::vector<Vertex_index> key = v;
      std::sort(key.begin(), key.end());
      const auto [other, is_new] = open_faces.try_emplace(key, darts[smallest]);
      if(!is_new) { // seen from the other side: the dart ends at the smallest vertex
        lcc.template sew<3>(darts[(smallest + v.size() - 1) % v.size()], other->second);
        open_faces.erase(other);
      }
    }
    if constexpr(Mixed_meshes_3::internal::holds_element_attributes<LCC>)
      lcc.template set_attribute<3>(first,
                                    lcc.template create_attribute<3>(mesh.attributes(Element_index(e))));
  }
  lcc.correct_invalid_attributes(); // a vertex at which the mesh is pinched becomes several vertices
  if(was_automatic)
    lcc.set_automatic_attributes_management(true);
}

/*!
\ingroup PkgMixedMesh3Validity

\brief Makes a mixed mesh of the volumes of a linear cell complex.

Each volume becomes an element with the orientation that the complex gives the volume: positive are volumes
whose faces are clockwise seen from outside, like the volume that `make_hexahedron()` of the complex makes of
the points in the figure of its manual. Labels are taken over if the complex has them, as with
`Mixed_mesh_linear_cell_complex_items_3`. `Mixed_meshes_3::find_defects()` tells whether the mesh is valid.

\tparam LCC `Linear_cell_complex_for_combinatorial_map` of dimensions 3, 3
\tparam GeomTraits a model of `MixedMeshTraits_3`
\param lcc the complex
\param mesh the result; cleared first. Vertices are in the order of the complex, without those that have no
volume
\return whether each volume is a tetrahedron, pyramid, prism or hexahedron, closed; if not, `mesh` is empty
\par Complexity
O(n log n) for n volumes
*/
template <class LCC, class GeomTraits>
bool linear_cell_complex_to_mixed_mesh(const LCC& lcc, Mixed_mesh_3<GeomTraits>& mesh)
{
  namespace mm3 = Mixed_meshes_3;
  mesh.clear();
  // Indices of vertices: first in the complex, then in the mesh.
  std::map<const typename LCC::Point*, mm3::Vertex_index> indices;
  for(auto a = lcc.vertex_attributes().begin(); a != lcc.vertex_attributes().end(); ++a)
    indices.emplace(&lcc.point_of_vertex_attribute(a), mm3::internal::no_vertex);

  std::vector<mm3::internal::Element_of_complex<LCC>> volumes;
  std::set<const typename LCC::Point*> used;
  const auto darts = lcc.template one_dart_per_cell<3>();
  for(auto d = darts.begin(); d != darts.end(); ++d) {
    auto volume = mm3::internal::element_of_volume(lcc, d);
    if(!volume)
      return false;
    used.insert(volume->vertices.begin(), volume->vertices.end());
    volumes.push_back(std::move(*volume));
  }

  for(auto a = lcc.vertex_attributes().begin(); a != lcc.vertex_attributes().end(); ++a) {
    const typename LCC::Point& p = lcc.point_of_vertex_attribute(a);
    if(used.count(&p) != 0)
      indices[&p] = mesh.add_vertex(
        typename GeomTraits::Point_3(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())));
  }
  for(const auto& volume : volumes) {
    std::vector<mm3::Vertex_index> vertices;
    for(const auto* p : volume.vertices)
      vertices.push_back(indices.at(p));
    mesh.add_element(volume.kind, vertices, volume.attributes);
  }
  return true;
}

} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_LINEAR_CELL_COMPLEX_H
