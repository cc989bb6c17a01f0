// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bisection of boundary edges: each bisection adds one vertex on the surface; an octree has no cheaper
// vertex.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_BISECT_BOUNDARY_EDGES_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_BISECT_BOUNDARY_EDGES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/moves/bisect_edge.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <queue>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// An edge that was bisected.
struct Boundary_bisection
{
  std::pair<Vertex_index, Vertex_index> edge;
  bool is_underway; ///< the middle
  Vec3 target;      ///< of the middle, on the surface
};

/*!
Bisects edges of a triangulated boundary, the edges with the largest gain first, and puts their middles on the
surface. A middle that may not be there yet, as some element would be inverted or too bad, stays on its edge,
underway to the surface. Those are the edges that matter most: the farther the surface, the more often.

\tparam Gain `double(a, b, apexes, stratum)`: the gain of bisecting the edge ab, between triangles of the
stratum with these apexes; 0: no gain
\tparam Project projection like `Surface_projection`
*/
template <class Quality, class Project, class Gain>
class Boundary_bisector
{
  using Edge = std::pair<Vertex_index, Vertex_index>; // smaller vertex first

  struct Hash
  {
    std::size_t operator()(const Edge& e) const { return std::uint64_t(e.first) << 32 | e.second; }
  };

  struct Triangles
  {
    std::array<Vertex_index, 2> apexes; // apexes of two of the triangles
    Stratum stratum;
    bool are_alone; // no more than two triangles, both of the stratum
  };

  Working_mesh& m_mesh;
  const Quality& m_quality;
  const Project& m_project;
  const Gain& m_gain;
  const double m_worst;
  std::unordered_map<Edge, Triangles, Hash> m_triangles; // triangles at each edge
  std::priority_queue<std::pair<double, Edge>> m_queue;  // edges by gain
  std::set<Vertex_index> m_underway;                     // whose edges are not bisected

  static Edge edge(Vertex_index a, Vertex_index b) { return std::minmax(a, b); }

  void push(Vertex_index a, Vertex_index b)
  {
    const Triangles& triangles = m_triangles.at(edge(a, b));
    const double gain = triangles.are_alone && triangles.apexes[1] != no_vertex && m_underway.count(a) == 0
                            && m_underway.count(b) == 0
                          ? m_gain(a, b, triangles.apexes, triangles.stratum)
                          : 0;
    if(gain > 0)
      m_queue.emplace(gain, edge(a, b));
  }

  void replace_apex(Edge e, Vertex_index old, Vertex_index apex)
  {
    std::array<Vertex_index, 2>& apexes = m_triangles.at(e).apexes;
    if(apexes[0] == old || apexes[1] == old)
      apexes[apexes[0] == old ? 0 : 1] = apex;
  }

  void update(Vertex_index a, Vertex_index b, Vertex_index middle)
  {
    const Triangles old = m_triangles.at(edge(a, b));
    m_triangles.erase(edge(a, b));
    m_triangles[edge(a, middle)] = m_triangles[edge(b, middle)] = old;
    for(Vertex_index c : old.apexes) {
      m_triangles[edge(c, middle)] = {{a, b}, old.stratum, true};
      replace_apex(edge(c, a), b, middle);
      replace_apex(edge(c, b), a, middle);
      push(c, middle);
    }
    push(a, middle);
    push(b, middle);
  }

public:
  /// \param boundary triangles with their strata: edges between two triangles of the same stratum are
  /// bisected
  /// \param worst largest cost of a tetrahedron
  Boundary_bisector(Working_mesh& mesh, const Quality& quality, const Project& project, const Gain& gain,
                    const Interface_faces& boundary, double worst)
    : m_mesh(mesh), m_quality(quality), m_project(project), m_gain(gain), m_worst(worst)
  {
    m_triangles.reserve(3 * boundary.faces.size() / 2);
    for(std::size_t f = 0; f < boundary.faces.size(); ++f) {
      const Face_vertices& v = boundary.faces[f].vertices();
      for(int i = 0; i < v.size(); ++i) {
        const Triangles none{{no_vertex, no_vertex}, boundary.strata[f], true};
        Triangles& triangles = m_triangles.emplace(edge(v[i], v[(i + 1) % v.size()]), none).first->second;
        std::array<Vertex_index, 2>& apexes = triangles.apexes;
        if(apexes[1] != no_vertex || triangles.stratum != boundary.strata[f])
          triangles.are_alone = false;
        else
          apexes[apexes[0] == no_vertex ? 0 : 1] = v[(i + 2) % v.size()];
      }
    }
    for(const auto& [e, triangles] : m_triangles)
      push(e.first, e.second); // in any order: the queue has a total one
  }

  /// \return the edges that were bisected, at most `number`; their middles are the last vertices
  std::vector<Boundary_bisection> operator()(std::size_t number)
  {
    std::vector<Boundary_bisection> bisected;
    while(bisected.size() < number && !m_queue.empty()) {
      const auto [a, b] = m_queue.top().second;
      m_queue.pop();
      const Vec3 middle = 0.5 * (m_mesh.points[a] + m_mesh.points[b]);
      const Stratum stratum = m_mesh.is_sharp(a, b) ? m_mesh.sharp_stratum(a, b)
                                                    : m_triangles.at({a, b}).stratum;
      const Vec3 target = m_mesh.strata[a] == stratum ? m_project(middle, m_mesh.points[a], stratum)
                                                      : m_project(middle, stratum);
      const bool arrives = bisect_edge(m_mesh, m_quality, a, b, target, stratum, m_worst);
      if(!arrives && !bisect_edge(m_mesh, m_quality, a, b, middle, stratum, m_worst))
        continue;
      const Vertex_index v = Vertex_index(m_mesh.points.size() - 1);
      if(!arrives)
        m_underway.insert(v);
      update(a, b, v);
      bisected.push_back({{a, b}, !arrives, target});
    }
    return bisected;
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_BISECT_BOUNDARY_EDGES_H
