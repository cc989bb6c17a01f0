// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_SPLIT_TO_TETRAHEDRA_H
#define CGAL_MIXED_MESH_3_SPLIT_TO_TETRAHEDRA_H

#include <CGAL/Mixed_mesh_3.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

/*!
\brief Splits all elements of a mesh into tetrahedra, for programs that know nothing else.

Every quadrilateral is split by the diagonal through its vertex of smallest index, and every element
is a cone from its vertex of smallest index. Both elements at a face therefore split it in the same
way, and the result is conforming; no vertex is added. A pyramid becomes 2 tetrahedra, a prism 3, a
hexahedron 6.

Tetrahedra stand in the order of the elements they come from. They are in the region if their element
is; boundary faces are the parts of the boundary faces of `mesh`.

The union is the same where quadrilaterals are planar. Where they are warped, the surface follows the
diagonals, and tetrahedra of a valid but badly shaped element can have a negative volume.

\param mesh the mesh.
\param origins if not null, receives for each tetrahedron the element of `mesh` it comes from.
*/
template <class Mesh>
Mesh split_to_tetrahedra(const Mesh& mesh, std::vector<Element_index>* origins = nullptr)
{
  const auto bit = [](int i) { return std::uint32_t(1) << i; };

  std::vector<std::uint8_t> boundary(mesh.number_of_elements());
  for(const auto& face : mesh.boundary_faces())
    boundary[face.element] |= std::uint8_t(bit(face.local_face));

  Mesh result;
  std::vector<typename Mesh::Boundary_face> boundary_faces;
  result.points() = mesh.points();
  if(origins != nullptr)
    origins->clear();

  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e) {
    const Element_view element = mesh.element(e);
    const Reference_element& reference = element.reference();
    int apex = 0;
    for(int i = 1; i < element.size(); ++i)
      if(element[i] < element[apex])
        apex = i;

    const auto vertices_of = [&](const Element_face& face) {
      std::uint32_t bits = 0;
      for(int i = 0; i < face.size; ++i)
        bits |= bit(face.vertices[i]);
      return bits;
    };
    // The element's face that has the three vertices is unique. Is it on the boundary?
    const auto is_on_boundary = [&](std::uint32_t triangle) {
      for(int f = 0; f < reference.number_of_faces; ++f)
        if((triangle & ~vertices_of(reference.faces[f])) == 0)
          return (boundary[e] & bit(f)) != 0;
      return false;
    };

    for(int f = 0; f < reference.number_of_faces; ++f) {
      const Element_face& face = reference.faces[f];
      if((vertices_of(face) & bit(apex)) != 0)
        continue;
      int first = 0;
      for(int i = 1; i < face.size; ++i)
        if(element[face.vertices[i]] < element[face.vertices[first]])
          first = i;
      for(int i = 1; i + 1 < face.size; ++i) {
        const int local[4] = {apex, face.vertices[first], face.vertices[(first + i) % face.size],
                              face.vertices[(first + i + 1) % face.size]};
        const Element_index tetrahedron = result.add_element(
          TETRAHEDRON, {element[local[0]], element[local[1]], element[local[2]], element[local[3]]},
          mesh.is_in_region(e));
        if(origins != nullptr)
          origins->push_back(Element_index(e));
        if(boundary[e] == 0)
          continue;
        const Reference_element& tetrahedra = reference_elements[TETRAHEDRON];
        for(int g = 0; g < tetrahedra.number_of_faces; ++g) {
          const auto& v = tetrahedra.faces[g].vertices;
          if(is_on_boundary(bit(local[v[0]]) | bit(local[v[1]]) | bit(local[v[2]])))
            boundary_faces.push_back({tetrahedron, g});
        }
      }
    }
  }
  result.set_boundary_faces(std::move(boundary_faces));
  return result;
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_SPLIT_TO_TETRAHEDRA_H
