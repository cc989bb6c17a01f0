// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a mesh that is fine enough for the topology to one with fewer vertices, of the same topology.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_COARSENER_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_COARSENER_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/moves/Boundary_triangles.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Edge_collapser.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Working_mesh.h>

#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
Collapses edges, those first whose loss is least, until a number of vertices is left. Vertices inside go into
any neighbor; those of the boundary into one beside them on it, if the boundary stays near to the places of
all vertices that were removed, turns nowhere too far, and does not cut itself. Vertices on several interfaces
stay.

The loss is the weight of the vertex times the cube of the longest new edge, and what lies between the new
faces and the places that they leave: both are volumes. Boundary vertices that are not where they should be
are removed first, and no other one goes into them.

\tparam Quality a model of `MixedMeshQuality_3`
*/
template <class Quality>
class Coarsener
{
  using Face_key = typename Edge_collapser<Quality>::Face_key;
  using Triangle = Boundary_triangles::Triangle;
  using Kernel = CGAL::Simple_cartesian<double>;

  struct Loss
  {
    double value;
    Vertex_index end; // no_vertex: the vertex stays
  };

  struct Entry
  {
    std::int64_t key; // of the loss: the same on every machine, nearly always
    Vertex_index vertex;

    bool operator<(const Entry& e) const // the first one is the largest
    {
      return key != e.key ? key > e.key : vertex > e.vertex;
    }
  };

  Working_mesh& m_mesh;
  Edge_collapser<Quality> m_collapser;
  Boundary_triangles m_boundary;
  const std::vector<Vec3>& m_targets;
  std::vector<double> m_weights;
  std::vector<std::vector<Vec3>> m_places; // of what was removed, at the vertices it went into
  std::vector<std::uint8_t> m_stays, m_is_queued;
  std::priority_queue<Entry> m_queue;
  const double m_weight_of_surface;   // of the volume between new faces and what they replace
  double m_bound = 0, m_distance = 0; // of costs; from removed vertices to the new faces

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr double least_cosine = 0.2; // between a face and the one that takes its place
  static constexpr double weight_of_cost = 0.05;

public:
  /// \param boundary triangles, all of it
  /// \param targets where the vertices should be, to be kept by the caller
  /// \param weights of the vertices
  /// \param weight_of_surface of the volume between new faces and surface, beside the cubes of edges
  Coarsener(Working_mesh& mesh, const Quality& quality, const std::vector<Face>& boundary,
            const std::vector<Vec3>& targets, std::vector<double> weights, double weight_of_surface,
            std::size_t number_of_vertices)
    : m_mesh(mesh), m_collapser(mesh, quality), m_boundary(mesh.points, boundary, number_of_vertices),
      m_targets(targets), m_weights(std::move(weights)), m_places(mesh.points.size()),
      m_stays(mesh.points.size(), 0), m_is_queued(mesh.points.size(), 0),
      m_weight_of_surface(weight_of_surface)
  {
    for(Vertex_index v = 0; v < mesh.points.size(); ++v)
      m_stays[v] = mesh.incident[v].empty() || !m_collapser.is_in_one_subdomain(v);
  }

  /// \param bound no new element costs more
  /// \param distance no place of a removed boundary vertex is farther from the boundary
  /// \param most vertices that are removed
  /// \return how many were
  std::size_t operator()(double bound, double distance, std::size_t most, const std::function<bool()>& go_on)
  {
    m_bound = bound;
    m_distance = distance;
    m_queue = {};
    std::fill(m_is_queued.begin(), m_is_queued.end(), 0);
    for(Vertex_index v = 0; v < m_mesh.points.size(); ++v)
      push(v);
    std::size_t removed = 0;
    while(removed < most && !m_queue.empty() && (removed % 256 != 0 || go_on())) {
      const auto [key, v] = m_queue.top();
      m_queue.pop();
      m_is_queued[v] = 0;
      if(m_mesh.incident[v].empty())
        continue;
      const Loss loss = least_loss(v);
      if(loss.end == no_vertex)
        continue; // until something changes beside it
      if(key_of(loss.value) > key) {
        push(v, loss.value);
        continue;
      }
      removed += collapse(v, loss.end);
    }
    return removed;
  }

private:
  static std::int64_t key_of(double loss)
  {
    return std::int64_t(std::llround(65536 * std::log2((std::max)(loss, 1e-300))));
  }

  void push(Vertex_index v, double loss)
  {
    m_queue.push({key_of(loss), v});
    m_is_queued[v] = 1;
  }

  // With what the loss is at least: that it may be more shows when its turn comes.
  void push(Vertex_index v)
  {
    if(m_mesh.incident[v].empty() || m_stays[v] || m_is_queued[v])
      return;
    double least = infinity;
    const std::vector<Vertex_index> around = m_mesh.neighbors(v);
    for(Vertex_index w : around)
      least = (std::min)(least, volume_of(v, w, around));
    push(v, least);
  }

  bool is_off(Vertex_index v) const { return m_mesh.points[v] != m_targets[v]; }

  double volume_of(Vertex_index v, Vertex_index w, const std::vector<Vertex_index>& around) const
  {
    if(is_off(v))
      return 0;
    if(is_off(w))
      return infinity;
    double longest = 0; // squared
    for(Vertex_index u : around) {
      const Vec3 edge = m_mesh.points[u] - m_mesh.points[w];
      longest = (std::max)(longest, dot(edge, edge));
    }
    return (std::max)(m_weights[v], m_weights[w]) * longest * std::sqrt(longest);
  }

  bool collapse(Vertex_index v, Vertex_index w)
  {
    const std::vector<Vertex_index> around = m_mesh.neighbors(v);
    const bool is_on_boundary = m_mesh.is_on_boundary(v);
    if(!m_collapser(v, w, m_bound))
      return false;
    if(is_on_boundary) {
      m_boundary.collapse(v, w);
      m_places[w].push_back(m_targets[v]);
      m_places[w].insert(m_places[w].end(), m_places[v].begin(), m_places[v].end());
      m_places[v] = {};
    }
    m_weights[w] = (std::max)(m_weights[w], m_weights[v]);
    for(Vertex_index u : around)
      push(u);
    return true;
  }

  Loss least_loss(Vertex_index v)
  {
    Loss least{infinity, no_vertex};
    const bool is_on_boundary = m_mesh.is_on_boundary(v);
    const std::vector<Vertex_index> around = m_mesh.neighbors(v);
    std::vector<Face_key> faces;
    if(is_on_boundary)
      for(Triangle t : m_boundary.at(v)) {
        std::sort(t.begin(), t.end());
        faces.push_back({t[0], t[1], t[2], no_vertex});
      }
    std::sort(faces.begin(), faces.end());
    const std::vector<Vertex_index> ends = is_on_boundary ? m_collapser.ends_of_edges(v, faces) : around;
    std::vector<std::pair<double, Vertex_index>> sorted; // by what the loss is at least
    for(Vertex_index w : ends)
      sorted.emplace_back(volume_of(v, w, around), w);
    std::sort(sorted.begin(), sorted.end());
    for(const auto& [volume, w] : sorted) {
      if(!(volume < least.value))
        break;
      const double loss = volume + (is_on_boundary ? loss_of_surface(v, w) : 0);
      if(!(loss < least.value))
        continue;
      const double worst = m_collapser.worst_after(v, w, m_bound),
                   value = loss * (1 + weight_of_cost * worst);
      if(value < least.value && m_collapser.keeps_topology(v, w, faces)
         && !(is_on_boundary && m_boundary.would_cross(v, w)))
        least = {value, w};
    }
    return least;
  }

  // Infinity if it is too far.
  double loss_of_surface(Vertex_index v, Vertex_index w) const
  {
    const std::vector<Vec3>& p = m_mesh.points;
    std::vector<Kernel::Triangle_3> fan;
    double doubled_area = 0;
    const auto point = [](const Vec3& q) { return Kernel::Point_3(q[0], q[1], q[2]); };
    for(const Triangle& old : m_boundary.at(v)) {
      if(std::find(old.begin(), old.end(), w) != old.end())
        continue;
      Triangle t = old;
      std::replace(t.begin(), t.end(), v, w);
      const Vec3 before = cross(p[old[1]] - p[old[0]], p[old[2]] - p[old[0]]),
                 after = cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
      if(!(dot(before, after) > least_cosine * norm(before) * norm(after)))
        return infinity;
      doubled_area += norm(after);
      fan.emplace_back(point(p[t[0]]), point(p[t[1]]), point(p[t[2]]));
    }
    double farthest = 0;
    const auto is_near = [&](const Vec3& place) {
      double least = infinity;
      for(const Kernel::Triangle_3& t : fan)
        least = (std::min)(least, CGAL::squared_distance(point(place), t));
      farthest = (std::max)(farthest, least);
      return least <= m_distance * m_distance;
    };
    if(!is_near(m_targets[v]) || !std::all_of(m_places[v].begin(), m_places[v].end(), is_near))
      return infinity;
    return m_weight_of_surface * std::sqrt(farthest) * doubled_area / 2;
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_COARSENER_H
