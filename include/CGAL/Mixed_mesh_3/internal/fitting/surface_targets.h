// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Targets of the boundary vertices: the closest point of the surface, moved along the surface until no
// boundary face would fold. A folded face inverts its element whatever the inner vertices do, so that no
// stiffness can prevent the inversion.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_SURFACE_TARGETS_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_SURFACE_TARGETS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Strata.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The result of `surface_targets()`.
struct Surface_targets
{
  std::vector<Vertex_index> vertices;     ///< the boundary vertices, ascending
  std::vector<Vec3> positions;            ///< target of each vertex, on the surface
  std::size_t number_of_folded_faces = 0; ///< faces that sliding could not unfold
};

/*!
The boundary as triangles, to detect folds of targets. A quadrilateral gives its four corner triangles: no
corner triangle may be folded.

A target triangle is folded when its normal turns away from the normal of the boundary there, which is that of
the *mesh* before it moves, averaged over the faces around the vertices. The surface's own normals are less
suitable: between the banks of a furrow narrower than a face the normals say nothing about the face. The
normal of the single face before it moves is not suitable either: on a staircase the face may be at a right
angle to the surface.
*/
class Boundary_folds
{
  std::vector<std::array<std::size_t, 3>> m_triangles; // positions in `Surface_targets::vertices`
  std::vector<Vec3> m_normals;                         // normal of the boundary at each triangle

  // The area vector, times 2.
  static Vec3 area(const std::vector<Vec3>& p, const std::array<std::size_t, 3>& t)
  {
    return cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
  }

  static Vec3 unit(const Vec3& v)
  {
    const double length = norm(v);
    return length > 0 ? (1 / length) * v : v;
  }

public:
  /// Least quality to reach: 1 is an equilateral target triangle that faces outwards, 0 one without area or
  /// at a right angle. Sliding costs fidelity: with 0.5 a brain of 10,000 vertices loses 0.6 % of its volume
  /// more than with 0.3; with 0.1 its worst elements have three times the aspect-ratio coefficient.
  static constexpr double least_quality = 0.3;

  /// \param polygons faces of the boundary, in positions of `points`
  Boundary_folds(const std::vector<Face_vertices>& polygons, const std::vector<Vec3>& points)
  {
    std::vector<Vec3> vertex_normals(points.size(), Vec3{});
    for(const Face_vertices& v : polygons)
      for(int i = 0; i < (v.size() == 3 ? 1 : 4); ++i)
        m_triangles.push_back({v[i], v[(i + 1) % v.size()], v[(i + 2) % v.size()]});
    for(const auto& t : m_triangles)
      for(std::size_t v : t)
        vertex_normals[v] = vertex_normals[v] + area(points, t);
    for(Vec3& n : vertex_normals)
      n = unit(n);
    for(const auto& t : m_triangles)
      m_normals.push_back(unit(vertex_normals[t[0]] + (vertex_normals[t[1]] + vertex_normals[t[2]])));
  }

  /// Marks the vertices of triangles below a quality, and counts these triangles.
  std::size_t find(const std::vector<Vec3>& targets, double quality,
                   std::vector<std::uint8_t>& is_marked) const
  {
    std::fill(is_marked.begin(), is_marked.end(), 0);
    std::size_t count = 0;
    for(std::size_t i = 0; i < m_triangles.size(); ++i) {
      const auto& t = m_triangles[i];
      double squared_lengths = 0;
      for(int k = 0; k < 3; ++k) {
        const Vec3 edge = targets[t[k]] - targets[t[(k + 1) % 3]];
        squared_lengths += dot(edge, edge);
      }
      // The factor 2 sqrt(3) makes twice the area over the sum of squares 1 for the equilateral triangle.
      if(3.4641016 * dot(area(targets, t), m_normals[i]) > quality * squared_lengths)
        continue;
      ++count;
      for(std::size_t v : t)
        is_marked[v] = 1;
    }
    return count;
  }
};

/// The edges of polygons, as the neighbors of each vertex.
inline std::vector<std::vector<std::size_t>> neighbors(const std::vector<Face_vertices>& polygons,
                                                       std::size_t number_of_vertices)
{
  std::vector<std::vector<std::size_t>> result(number_of_vertices);
  for(const Face_vertices& p : polygons)
    for(int i = 0; i < p.size(); ++i) {
      const Vertex_index a = p[i], b = p[(i + 1) % p.size()];
      result[a].push_back(b);
      result[b].push_back(a);
    }
  for(auto& n : result) {
    std::sort(n.begin(), n.end());
    n.erase(std::unique(n.begin(), n.end()), n.end());
  }
  return result;
}

/*!
The target of each boundary vertex.

\param boundary the boundary faces
\param points positions of all vertices
\param closest projection like `Surface_projection`
\param strata strata of all vertices
\param starts points of all vertices to be projected, if these are not their positions
\param maximal_number_of_rounds number of rounds of sliding

\par Complexity
One query per boundary vertex, and one for each vertex of a folded face in each round
*/
template <class Project>
Surface_targets surface_targets(const std::vector<Face>& boundary, const std::vector<Vec3>& points,
                                const Project& closest, const std::vector<Stratum>& strata,
                                const std::vector<Vec3>& starts = {}, int maximal_number_of_rounds = 100)
{
  // With half of it, largest distances of 14 meshes are 0.91 times as large in the median, with twice as much
  // they are the same; meshes keep 0.2 and 0.3 % less of their sharp edges (constants.md).
  constexpr int rounds_until_wider = 10;

  // Numbers of the boundary vertices.
  Surface_targets result;
  std::vector<Vertex_index> numbers(points.size(), no_vertex);
  result.vertices = vertices_of(boundary);
  for(std::size_t i = 0; i < result.vertices.size(); ++i)
    numbers[result.vertices[i]] = Vertex_index(i);
  std::vector<Face_vertices> polygons;
  for(const Face& face : boundary) {
    polygons.push_back(face.vertices());
    for(int i = 0; i < polygons.back().size(); ++i)
      polygons.back()[i] = numbers[polygons.back()[i]];
  }
  const std::size_t n = result.vertices.size();
  const auto neighbors_of = neighbors(polygons, n);
  std::vector<Vec3> sources;
  for(Vertex_index v : result.vertices)
    sources.push_back(points[v]);

  // Projection; the target of a neighbor is a good start of the search.
  std::vector<Vec3>& targets = result.positions;
  for(std::size_t i = 0; i < n; ++i) {
    const Vec3& p = starts.empty() ? sources[i] : starts[result.vertices[i]];
    const Stratum s = strata[result.vertices[i]];
    const std::size_t j = neighbors_of[i].empty() ? n : neighbors_of[i][0];
    targets.push_back(j < i && strata[result.vertices[j]] == s ? closest(p, targets[j], s) : closest(p, s));
  }

  // Unfolding. Where unfolding takes long, the neighbors must give way too.
  const Boundary_folds folds(polygons, sources);
  std::vector<std::uint8_t> is_folded(n), slides;
  std::vector<int> rounds(n, 0);
  for(int round = 0; round < maximal_number_of_rounds; ++round) {
    if(folds.find(targets, Boundary_folds::least_quality, is_folded) == 0)
      break;
    slides = is_folded;
    for(std::size_t i = 0; i < n; ++i)
      if(is_folded[i] && ++rounds[i] > rounds_until_wider)
        for(std::size_t j : neighbors_of[i])
          slides[j] = 1;
    for(std::size_t i = 0; i < n; ++i)
      if(slides[i]) {
        Vec3 offset{}; // from there to the mean of the neighbors
        for(std::size_t j : neighbors_of[i])
          offset = offset + (targets[j] - targets[i]);
        targets[i] = closest(targets[i] + (1. / double(neighbors_of[i].size())) * offset, targets[i],
                             strata[result.vertices[i]]);
      }
  }
  result.number_of_folded_faces = folds.find(targets, 0, is_folded);
  return result;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_SURFACE_TARGETS_H
