// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_BOUNDARY_BOUNDARY_POLYGONS_H
#define CGAL_MIXED_MESH_3_INTERNAL_BOUNDARY_BOUNDARY_POLYGONS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/Face.h>
#include <CGAL/Mixed_mesh_3/internal/base/labeled_domain.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

struct Boundary_polygons
{
  using Polygons = std::vector<Face_vertices>;

  Polygons whole;
  std::map<Subdomain_rank, Polygons> of_subdomains;                            // empty for a single one
  std::map<std::pair<Subdomain_rank, Subdomain_rank>, Polygons> of_interfaces; // earlier first
};

/// The polygons of the boundary and of interfaces, which are all between interface vertices.
/// \param subdomains subdomain of each piece
/// \param has_subdomains whether there are several
/// \param is_on_interface `bool(Vertex_index)`
template <class Is_on_interface>
Boundary_polygons boundary_polygons(const Element_list& pieces, const std::vector<Subdomain_rank>& subdomains,
                                    bool has_subdomains, const Is_on_interface& is_on_interface)
{
  struct Piece_face
  {
    std::array<Vertex_index, 4> key;
    Face_vertices vertices;
    Subdomain_rank subdomain;
  };
  std::vector<Piece_face> faces;
  for(std::size_t i = 0; i < pieces.size(); ++i)
    for(int f = 0; f < pieces[i].reference().number_of_faces; ++f) {
      const Face_vertices vertices = Face(pieces, Element_index(i), f).vertices();
      if(std::all_of(vertices.begin(), vertices.end(), is_on_interface)) {
        const bool is_quad = vertices.size() == 4; // face of an element that stays whole
        faces.push_back({{vertices[0], vertices[1], vertices[2], is_quad ? vertices[3] : no_vertex},
                         vertices,
                         subdomains[i]});
        std::sort(faces.back().key.begin(), faces.back().key.end());
      }
    }
  std::sort(faces.begin(), faces.end(),
            [](const Piece_face& a, const Piece_face& b) { return a.key < b.key; });
  Boundary_polygons result;
  for(std::size_t i = 0, n = 0; i < faces.size(); i += n) {
    n = i + 1 < faces.size() && faces[i + 1].key == faces[i].key ? 2 : 1;
    if(n == 1)
      result.whole.push_back(faces[i].vertices);
    const Subdomain_rank a = faces[i].subdomain, b = n == 1 ? outside_rank : faces[i + 1].subdomain;
    if(has_subdomains && a != b) {
      for(std::size_t j = i; j < i + n; ++j)
        result.of_subdomains[faces[j].subdomain].push_back(faces[j].vertices);
      result.of_interfaces[std::minmax(a, b)].push_back(faces[i].vertices);
    }
  }
  return result;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_BOUNDARY_BOUNDARY_POLYGONS_H
