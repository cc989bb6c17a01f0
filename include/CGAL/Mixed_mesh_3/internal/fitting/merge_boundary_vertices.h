// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Removal of a vertex of the boundary that can not arrive while a vertex beside it has arrived.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_MERGE_BOUNDARY_VERTICES_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_MERGE_BOUNDARY_VERTICES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/moves/Edge_collapser.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Working_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/moves/remove_vertex.h>

#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
Merges a vertex of the boundary with the other end of one of its boundary edges, as `Edge_collapser` does.

\tparam Quality a model of `MixedMeshQuality_3`
*/
template <class Quality>
class Boundary_vertex_merger
{
  using Face_key = typename Edge_collapser<Quality>::Face_key;

  Working_mesh& m_mesh;
  Edge_collapser<Quality> m_collapser;
  const double m_worst;

  // Share of an edge. Of seven meshes of 2,000 vertices, with half of it a slot keeps 0.981 of its sharp
  // edges instead of 0.984, with twice as much its worst aspect-ratio coefficient is 2.8 instead of 2.55.
  static constexpr double far_share = 0.6;

public:
  /// \param worst largest cost that an element may get
  Boundary_vertex_merger(Working_mesh& mesh, const Quality& quality, double worst)
    : m_mesh(mesh), m_collapser(mesh, quality), m_worst(worst)
  {
  }

  /// \param place place of the surface near the vertex, from which the new faces shall not be far: not
  /// farther than the vertex is, or than a share of an edge
  /// \param is_candidate whether the vertex may be merged with a given vertex
  /// \return the vertex with which the vertex was merged, where the worst new element is best; `no_vertex`:
  /// none
  template <class Is_candidate>
  Vertex_index operator()(Vertex_index v, const Vec3& place, const Is_candidate& is_candidate)
  {
    if(!m_collapser.is_in_one_subdomain(v))
      return no_vertex;
    const std::vector<Face_key> faces = m_collapser.boundary_faces_at(v);
    Vertex_index best = no_vertex;
    double least = std::nextafter(m_worst, std::numeric_limits<double>::infinity()); // the first cost is less
    for(Vertex_index w : m_collapser.ends_of_edges(v, faces))
      if(is_candidate(w) && m_mesh.keeps_sharp_edges(v, w) && m_collapser.keeps_topology(v, w, faces)
         && is_near(place, v, w, faces)) {
        const double worst = m_collapser.worst_after(v, w, least);
        if(worst < least) {
          best = w;
          least = worst;
        }
      }
    return best != no_vertex && m_collapser(v, best, m_worst) ? best : no_vertex;
  }

  /// Removes a vertex with all of its elements, if the topology is kept and no vertex that is gone is farther
  /// from the new faces.
  /// \return the vertices that are gone
  std::vector<Vertex_index> remove(Vertex_index v, double far_enough)
  {
    const Vertex_removal removal = find_removal(m_mesh, v);
    if(removal.faces.empty()
       || !std::all_of(removal.vertices.begin(), removal.vertices.end(),
                       [&](Vertex_index u) { return is_near(u, far_enough, removal.faces); }))
      return {};
    remove_vertex(m_mesh, v, removal);
    return removal.vertices;
  }

private:
  using Kernel = CGAL::Simple_cartesian<double>;

  static Kernel::Point_3 point(const Vec3& p) { return {p[0], p[1], p[2]}; }

  bool is_near(Vertex_index v, double far_enough, const std::vector<std::array<Vertex_index, 3>>& faces) const
  {
    const auto point_of = [&](Vertex_index u) { return point(m_mesh.points[u]); };
    return std::any_of(faces.begin(), faces.end(), [&](const auto& face) {
      const Kernel::Triangle_3 triangle(point_of(face[0]), point_of(face[1]), point_of(face[2]));
      return CGAL::squared_distance(point_of(v), triangle) <= far_enough * far_enough;
    });
  }

  bool is_near(const Vec3& place, Vertex_index v, Vertex_index w, const std::vector<Face_key>& faces) const
  {
    const auto point_of = [&](Vertex_index u) { return point(m_mesh.points[u]); };
    const double far_enough = (std::max)(norm(m_mesh.points[v] - place),
                                         far_share * norm(m_mesh.points[v] - m_mesh.points[w]));
    const Kernel::Point_3 p = point(place);
    return std::any_of(faces.begin(), faces.end(), [&](const Face_key& face) {
      if(std::find(face.begin(), face.end(), w) != face.end())
        return false; // the element vanishes
      std::vector<Kernel::Point_3> q;
      for(Vertex_index u : face)
        if(u != v && u != no_vertex)
          q.push_back(point_of(u));
      const auto is_near_triangle = [&](std::size_t i, std::size_t j) {
        return CGAL::squared_distance(p, Kernel::Triangle_3(point_of(w), q[i], q[j]))
               <= far_enough * far_enough;
      };
      return is_near_triangle(0, 1) || (q.size() > 2 && (is_near_triangle(1, 2) || is_near_triangle(0, 2)));
    });
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_MERGE_BOUNDARY_VERTICES_H
