// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Conversion of meshes of CGAL's Mesh_3.

#ifndef CGAL_MIXED_MESH_3_CELLS_IN_COMPLEX_3_TO_MIXED_MESH_H
#define CGAL_MIXED_MESH_3_CELLS_IN_COMPLEX_3_TO_MIXED_MESH_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3.h>

#include <CGAL/number_utils.h>

#include <map>
#include <type_traits>

namespace CGAL {

/*!
\ingroup PkgMixedMesh3Validity

\brief Makes a mixed mesh of the tetrahedra of a complex, such as `make_mesh_3()` returns.

Functions of `Mixed_mesh_3` can then be used for meshes of Mesh_3 and of Tetrahedral Remeshing:
`optimize_mixed_mesh_3()`, `find_defects()`, `jacobian_sign()`, elasticity, writers. Vertices are those of
tetrahedra in the complex, in the order in which these have them, and lose their weights. The subdomain of a
tetrahedron is its subdomain index in the complex if that is a positive integer, else 1; no tetrahedron is in
the region.

\tparam C3t3 a model of `MeshComplex_3InTriangulation_3`
\tparam GeomTraits a model of `MixedMeshTraits_3`
\param c3t3 the complex
\param mesh the result; cleared first

\par Complexity
O(n log n)
*/
template <class C3t3, class GeomTraits>
void cells_in_complex_3_to_mixed_mesh(const C3t3& c3t3, Mixed_mesh_3<GeomTraits>& mesh)
{
  using Subdomain_index = Mixed_meshes_3::Subdomain_index;
  using Point_3 = typename GeomTraits::Point_3;
  mesh.clear();
  const auto& point = c3t3.triangulation().geom_traits().construct_point_3_object(); // without the weight
  std::map<typename C3t3::Vertex_handle, Mixed_meshes_3::Vertex_index> indices;
  for(auto c = c3t3.cells_in_complex_begin(); c != c3t3.cells_in_complex_end(); ++c) {
    Mixed_meshes_3::Vertex_index v[4];
    for(int i = 0; i < 4; ++i) {
      const auto [position, is_new] = indices.try_emplace(c->vertex(i), 0);
      if(is_new) {
        const auto& p = point(c->vertex(i)->point());
        position->second = mesh.add_vertex(
          Point_3(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())));
      }
      v[i] = position->second;
    }
    Mixed_meshes_3::Element_attributes attributes;
    if constexpr(std::is_integral_v<typename C3t3::Subdomain_index>)
      if(c3t3.subdomain_index(c) > 0)
        attributes.subdomain_index = Subdomain_index(c3t3.subdomain_index(c));
    mesh.add_element(Mixed_meshes_3::TETRAHEDRON, {v[0], v[1], v[2], v[3]}, attributes);
  }
}

} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_CELLS_IN_COMPLEX_3_TO_MIXED_MESH_H
