// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_SPLIT_TO_TETRAHEDRA_H
#define CGAL_MIXED_MESH_3_SPLIT_TO_TETRAHEDRA_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

/*!
\ingroup PkgMixedMesh3Validity

\brief Splits all elements of a mesh into tetrahedra, for programs that know no other elements.

Every quadrilateral is split by the diagonal through its vertex of smallest index, and every element
is a cone from its vertex of smallest index. Both elements at a face therefore split it in the same
way, and the result is conforming; no vertex is added. A pyramid becomes 2 tetrahedra, a prism 3, a
hexahedron 6.

Tetrahedra are in the order of the elements that they come from, and have the attributes and the data of these
elements. Vertices keep their data.

The union is the same where quadrilaterals are planar. Where quadrilaterals are warped, the surface follows
the diagonals, and tetrahedra of a valid but badly shaped element can have a negative volume.

\param mesh the mesh.
\param origins if not null, receives for each tetrahedron the element of `mesh` it comes from.
*/
template <class Mesh>
Mesh split_to_tetrahedra(const Mesh& mesh, std::vector<Element_index>* origins = nullptr)
{
  constexpr std::size_t tetrahedra[] = {1, 2, 3, 6}; // of an element, by kind
  const auto counts = mesh.elements().counts();
  const std::size_t number = std::inner_product(counts.begin(), counts.end(), tetrahedra, std::size_t(0));
  Element_list list;
  list.reserve(number, 4 * number);
  std::vector<Element_attributes> attributes;
  attributes.reserve(number);
  std::vector<Element_index> elements; // element of each tetrahedron
  elements.reserve(number);

  for(Element_index e = 0; e < mesh.number_of_elements(); ++e) {
    const Element_view element = mesh.element(e);
    const Reference_element& reference = element.reference();
    int apex = 0;
    for(int i = 1; i < element.size(); ++i)
      if(element[i] < element[apex])
        apex = i;

    for(int f = 0; f < reference.number_of_faces; ++f) {
      const Element_face& face = reference.faces[f];
      if(std::find(face.vertices, face.vertices + face.size, apex) != face.vertices + face.size)
        continue;
      int first = 0;
      for(int i = 1; i < face.size; ++i)
        if(element[face.vertices[i]] < element[face.vertices[first]])
          first = i;
      for(int i = 1; i + 1 < face.size; ++i) {
        list.add(TETRAHEDRON, {element[apex], element[face.vertices[first]],
                               element[face.vertices[(first + i) % face.size]],
                               element[face.vertices[(first + i + 1) % face.size]]});
        attributes.push_back(mesh.attributes(e));
        elements.push_back(e);
      }
    }
  }
  Mesh result;
  result.assign(mesh.points(), std::move(list), std::move(attributes), mesh.vertex_data(),
                mesh.element_data().selected(elements));
  if(origins != nullptr)
    *origins = std::move(elements);
  return result;
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_SPLIT_TO_TETRAHEDRA_H
