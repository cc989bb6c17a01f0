// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The part of a mesh that consists of some subdomains.

#ifndef CGAL_MIXED_MESH_3_EXTRACT_SUBDOMAINS_H
#define CGAL_MIXED_MESH_3_EXTRACT_SUBDOMAINS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_attributes.h>
#include <CGAL/Mixed_mesh_3/Index.h>
#include <CGAL/Mixed_mesh_3/resect.h>

#include <algorithm>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

/*!
\ingroup PkgMixedMesh3Resection

\brief The elements of some subdomains, with their vertices: a mesh of its own.

Elements and vertices keep their order and their data, elements their attributes, so that the result is
conforming, and its elements are valid, if those of the mesh are. Interfaces with subdomains that are left out
are part of the boundary. The boundary need not be a manifold: subdomains may have only an edge or a vertex in
common, which `find_defects()` counts; `resect()` removes and restores elements such that there is no such
place.

\tparam Mesh a `Mixed_mesh_3`
\param mesh the mesh
\param subdomains indices of subdomains, in any order. Without elements of these subdomains, the result is
empty
\param vertex_map if not null, receives for each vertex of the result its index in `mesh`, in increasing order
\param element_map if not null, receives for each element of the result its index in `mesh`, likewise
\par Complexity
O(n log m) for n elements and m indices
*/
template <class Mesh>
Mesh extract_subdomains(const Mesh& mesh, std::vector<Subdomain_index> subdomains,
                        std::vector<Vertex_index>* vertex_map = nullptr,
                        std::vector<Element_index>* element_map = nullptr)
{
  std::sort(subdomains.begin(), subdomains.end());
  std::vector<bool> is_left_out(mesh.number_of_elements());
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
    is_left_out[e] = !std::binary_search(subdomains.begin(), subdomains.end(), mesh.subdomain_index(e));
  return remaining_mesh(mesh, is_left_out, vertex_map, element_map);
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_EXTRACT_SUBDOMAINS_H
