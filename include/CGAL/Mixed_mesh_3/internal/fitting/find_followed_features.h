// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sharp edges of the surface that a mesh follows already.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_FIND_FOLLOWED_FEATURES_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_FIND_FOLLOWED_FEATURES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/internal/base/Core_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Followed_features.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Surface_projection.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Strata.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/Any_surface.h>
#include <CGAL/Mixed_mesh_3/internal/surface/Sharp_features.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Mean edge length of the boundary.
inline double mean_edge_length_of_boundary(const Core_mesh& mesh)
{
  double sum = 0;
  int number = 0;
  for(const Face& face : boundary_faces(mesh)) {
    const Face_vertices& v = face.vertices();
    for(int i = 0; i < v.size(); ++i, ++number)
      sum += norm(to_vec3(mesh.points()[v[i]]) - to_vec3(mesh.points()[v[(i + 1) % v.size()]]));
  }
  return sum / number;
}

/*!
The sharp features of a surface that a mesh follows as it is, without any move: vertices at corners, and
vertices on polylines with the edges between successive ones.

The choice of paths for a mesh that is to follow sharp edges, `Feature_paths`, needs vertices that may move; a
path that this mesh follows in part would be lost as a whole, or lead past its vertices. Here each part of a
polyline that has its edges counts, and its ends stay, as no two edges go on from them.

\param sharp_angle as of `Any_surface::sharp_edges()`
*/
inline Followed_features find_followed_features(const Core_mesh& mesh, const Any_surface& surface,
                                                double sharp_angle)
{
  using Edge = std::pair<Vertex_index, Vertex_index>;
  Followed_features followed;
  const Sharp_edges sharp = surface.sharp_edges(sharp_angle);
  if(sharp.edges.empty())
    return followed;
  followed.features = Sharp_features(sharp, mean_edge_length_of_boundary(mesh));
  if(followed.features.empty())
    return followed;
  Strata strata(surface);
  const Interface_faces faces = strata.sorted_faces(mesh);
  std::map<Edge, Stratum> edges; // of the boundary, with what the strata of their faces have in common
  for(std::size_t f = 0; f < faces.faces.size(); ++f) {
    const Face_vertices& v = faces.faces[f].vertices();
    for(int i = 0; i < v.size(); ++i) {
      const auto [edge, is_new] = edges.try_emplace(std::minmax(v[i], v[(i + 1) % v.size()]),
                                                    faces.strata[f]);
      if(!is_new)
        edge->second = strata.meet(edge->second, faces.strata[f]);
    }
  }
  const std::vector<Stratum> of_vertices = strata.of_vertices(mesh.number_of_vertices(), faces);
  Surface_projection project(surface, strata);
  project.set_features(followed.features);
  const std::vector<Feature_polyline>& polylines = followed.features.polylines();
  const Stratum first_corner = Stratum(first_sharp_stratum + polylines.size());
  const auto point = [&](Vertex_index v) { return to_vec3(mesh.point(v)); };

  followed.strata.of_vertices.assign(mesh.number_of_vertices(), free_stratum);
  std::vector<Stratum>& chosen = followed.strata.of_vertices;
  for(std::size_t c = 0; c < followed.features.corners().size(); ++c)
    for(Vertex_index v = 0; v < chosen.size(); ++v)
      if(of_vertices[v] != free_stratum && project.is_there(point(v), Stratum(first_corner + c)))
        chosen[v] = Stratum(first_corner + c);
  for(std::size_t i = 0; i < polylines.size(); ++i) {
    const Stratum stratum = Stratum(first_sharp_stratum + i),
                  of_places = strata.of_subdomains(followed.features.subdomains(i));
    std::vector<std::pair<double, Vertex_index>> along; // by arc length
    for(Vertex_index v = 0; v < chosen.size(); ++v)
      if(of_vertices[v] != free_stratum && project.is_there(point(v), stratum)) {
        const bool is_end = chosen[v] == first_corner + polylines[i].corners[0]
                            || chosen[v] == first_corner + polylines[i].corners[1];
        if(is_end)
          along.emplace_back(followed.features.arc_length(point(v), chosen[v] - first_sharp_stratum,
                                                          polylines[i]),
                             v);
        else if(chosen[v] == free_stratum && of_vertices[v] == of_places)
          along.emplace_back(polylines[i].closest(point(v)).length, v);
      }
    std::sort(along.begin(), along.end());
    for(std::size_t k = 1; k < along.size(); ++k) {
      const Vertex_index a = along[k - 1].second, b = along[k].second;
      const auto edge = edges.find(std::minmax(a, b));
      if(edge == edges.end() || edge->second != of_places)
        continue;
      followed.strata.edges.emplace(edge->first, stratum);
      for(Vertex_index v : {a, b})
        if(chosen[v] < first_corner)
          chosen[v] = stratum;
    }
  }
  return followed;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_FIND_FOLLOWED_FEATURES_H
