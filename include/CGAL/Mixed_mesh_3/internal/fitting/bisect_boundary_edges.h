// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One more vertex on the surface for one vertex: an octree has no cheaper one.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_BISECT_BOUNDARY_EDGES_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_BISECT_BOUNDARY_EDGES_H

#include <CGAL/Mixed_mesh_3/internal/fitting/Working_mesh.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <queue>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Splits the tetrahedra around an edge in two, by a new vertex at `p`, if the new ones are positive and cost
/// at most `worst`. The new vertex is the last one.
/// \return whether it did so
template <class Quality>
bool bisect_edge(Working_mesh& mesh, const Quality& quality, Vertex_index a, Vertex_index b, const Vec3& p,
                 double worst)
{
  std::vector<Element_index> old;
  for(Element_index e : mesh.incident[a]) {
    const Working_mesh::Element& element = mesh.elements[e];
    if(element.begin() + element.position(b) == element.end())
      continue;
    if(element.kind != TETRAHEDRON)
      return false;
    old.push_back(e);
  }
  const Vertex_index middle = mesh.add_vertex(p, true);
  std::vector<Working_mesh::Element> halves;
  for(Element_index e : old)
    for(Vertex_index end : {a, b}) {
      halves.push_back(mesh.elements[e]);
      halves.back().vertices[std::size_t(halves.back().position(end))] = middle;
      const Working_mesh::Element& half = halves.back();
      if(!(quality(TETRAHEDRON, mesh.relative_points(half)) <= worst) || !mesh.is_positive(half)) {
        mesh.remove_last_vertex();
        return false;
      }
    }
  for(Element_index e : old)
    mesh.remove(e);
  for(const Working_mesh::Element& half : halves)
    mesh.add(half);
  return true;
}

/*!
Bisects edges of a triangulated boundary, those with the largest gain first, and puts their middles on the
surface.

\tparam Gain `double(a, b, apexes)`: what bisecting the edge ab gains, between triangles with these apexes; 0:
        nothing
\tparam Project `Vec3(Vec3 p, Vec3 hint)`: a point of the surface near p
*/
template <class Quality, class Project, class Gain>
class Boundary_bisector
{
  using Edge = std::pair<Vertex_index, Vertex_index>; // the smaller one first

  Working_mesh& m_mesh;
  const Quality& m_quality;
  const Project& m_project;
  const Gain& m_gain;
  const double m_worst;
  std::map<Edge, std::array<Vertex_index, 2>> m_apexes; // of the two triangles at an edge
  std::priority_queue<std::pair<double, Edge>> m_queue; // by gain

  static Edge edge(Vertex_index a, Vertex_index b) { return std::minmax(a, b); }

  void push(Vertex_index a, Vertex_index b)
  {
    const std::array<Vertex_index, 2>& apexes = m_apexes.at(edge(a, b));
    const double gain = apexes[0] == no_vertex || apexes[1] == no_vertex ? 0 : m_gain(a, b, apexes);
    if(gain > 0)
      m_queue.emplace(gain, edge(a, b));
  }

  void replace_apex(Edge e, Vertex_index old, Vertex_index apex)
  {
    std::array<Vertex_index, 2>& apexes = m_apexes.at(e);
    apexes[apexes[0] == old ? 0 : 1] = apex;
  }

  void update(Vertex_index a, Vertex_index b, Vertex_index middle)
  {
    const std::array<Vertex_index, 2> apexes = m_apexes.at(edge(a, b));
    m_apexes.erase(edge(a, b));
    m_apexes[edge(a, middle)] = m_apexes[edge(b, middle)] = apexes;
    for(Vertex_index c : apexes) {
      m_apexes[edge(c, middle)] = {a, b};
      replace_apex(edge(c, a), b, middle);
      replace_apex(edge(c, b), a, middle);
      push(c, middle);
    }
    push(a, middle);
    push(b, middle);
  }

public:
  /// \param worst no tetrahedron may cost more
  Boundary_bisector(Working_mesh& mesh, const Quality& quality, const Project& project, const Gain& gain,
                    const std::vector<Face>& boundary, double worst)
    : m_mesh(mesh), m_quality(quality), m_project(project), m_gain(gain), m_worst(worst)
  {
    constexpr std::array<Vertex_index, 2> none{no_vertex, no_vertex};
    for(const Face& face : boundary) {
      const Face_vertices& v = face.vertices();
      for(int i = 0; i < v.size(); ++i) {
        const Edge e = edge(v[i], v[(i + 1) % v.size()]);
        std::array<Vertex_index, 2>& apexes = m_apexes.emplace(e, none).first->second;
        if(apexes[1] != no_vertex) // more than two faces
          apexes[0] = no_vertex;
        else
          apexes[apexes[0] == no_vertex ? 0 : 1] = v[(i + 2) % v.size()];
      }
    }
    for(const auto& [e, apexes] : m_apexes)
      push(e.first, e.second);
  }

  /// \return the edges that were bisected, at most `number`; their middles are the last vertices
  std::vector<Edge> operator()(std::size_t number)
  {
    std::vector<Edge> bisected;
    while(bisected.size() < number && !m_queue.empty()) {
      const auto [a, b] = m_queue.top().second;
      m_queue.pop();
      const Vec3 middle = 0.5 * (m_mesh.points[a] + m_mesh.points[b]);
      if(bisect_edge(m_mesh, m_quality, a, b, m_project(middle, m_mesh.points[a]), m_worst)) {
        update(a, b, Vertex_index(m_mesh.points.size() - 1));
        bisected.emplace_back(a, b);
      }
    }
    return bisected;
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_BISECT_BOUNDARY_EDGES_H
