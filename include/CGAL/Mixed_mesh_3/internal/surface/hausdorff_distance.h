// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Hausdorff distance between sets of triangles, by branch and bound. CGAL's
// bounded_error_Hausdorff_distance() is not used: in CGAL 5.5 it fails an assertion where surfaces coincide,
// as fitted meshes do, and no version is documented to return the place.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_SURFACE_HAUSDORFF_DISTANCE_H
#define CGAL_MIXED_MESH_3_INTERNAL_SURFACE_HAUSDORFF_DISTANCE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/surface/Triangle_soup.h>
#include <CGAL/Mixed_mesh_3/internal/surface/Triangle_tree.h>

#include <CGAL/assertions.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <queue>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The boundary of a mesh. Quadrilaterals are split through their vertex of smallest index, as
/// `split_to_tetrahedra()` does. Only the vertices of the boundary are in the soup.
/// \param boundary boundary faces of the mesh
template <class Mesh>
Triangle_soup boundary_triangles(const Mesh& mesh, const std::vector<Face>& boundary)
{
  CGAL_precondition(!mesh.is_empty());
  Triangle_soup soup;
  constexpr std::size_t none = std::size_t(-1);
  std::vector<std::size_t> index(mesh.number_of_vertices(), none);
  for(const Face& face : boundary) {
    std::array<Vertex_index, 4> v = face.vertices().padded();
    const int size = face.vertices().size();
    std::rotate(v.begin(), std::min_element(v.begin(), v.begin() + size), v.begin() + size);
    for(int i = 0; i < size; ++i)
      if(index[v[i]] == none) {
        index[v[i]] = soup.points.size();
        soup.points.push_back(rounded_point(to_vec3(mesh.point(v[i]))));
      }
    for(int i = 1; i + 1 < size; ++i)
      soup.triangles.push_back({index[v[0]], index[v[i]], index[v[i + 1]]});
  }
  return soup;
}

/// Overload that finds the boundary faces.
template <class Mesh>
Triangle_soup boundary_triangles(const Mesh& mesh)
{
  return boundary_triangles(mesh, boundary_faces(mesh));
}

/// The corners of a triangle.
inline std::array<Vec3, 3> corners(const Triangle_soup& soup, std::size_t triangle)
{
  const auto& t = soup.triangles[triangle];
  return {to_vec3(soup.points[t[0]]), to_vec3(soup.points[t[1]]), to_vec3(soup.points[t[2]])};
}

/// Nearest points on the triangles of a soup.
class Nearest_triangle
{
  using Point_3 = Predicates_kernel::Point_3;

  std::shared_ptr<const Triangle_tree> m_tree;

public:
  using Hint = Triangle_tree::Closest;

  /// A point, the nearest point of the soup, and its location.
  struct Query
  {
    Point_3 point;
    Hint nearest;
    double distance;
  };

  /// Constructs the query. \pre the soup is not empty
  explicit Nearest_triangle(const Triangle_soup& soup)
    : m_tree(std::make_shared<const Triangle_tree>(soup.triangles.size(),
                                                   [&soup](std::size_t i) { return corners(soup, i); }))
  {
  }

  /// Constructs the query from the tree of a soup, or of a surface. \pre the tree is not empty
  explicit Nearest_triangle(std::shared_ptr<const Triangle_tree> tree) : m_tree(std::move(tree)) {}

  Query operator()(const Point_3& p) const { return query(p, m_tree->closest(to_vec3(p))); }

  /// \param hint point of the soup; the query is faster if the hint is near
  Query operator()(const Point_3& p, const Hint& hint) const
  {
    return query(p, m_tree->closest(to_vec3(p), hint));
  }

  double distance(const Point_3& p, std::size_t triangle) const
  {
    return query(p, m_tree->closest(to_vec3(p), triangle)).distance;
  }

private:
  static Query query(const Point_3& p, const Hint& nearest)
  {
    return {p, nearest, norm(nearest.point - to_vec3(p))};
  }
};

} // namespace internal

/// \ingroup PkgMixedMesh3Validity
/// The distance of a surface from another one.
struct One_sided_distance
{
  double distance = 0;             ///< distance of `from`, the farthest point found
  double error = 0;                ///< no point is farther than `distance + error`
  Predicates_kernel::Point_3 from; ///< a point of the surface
  Predicates_kernel::Point_3 to;   ///< the point of the other surface nearest to `from`
};

namespace internal {

/*!
The search for the point of some triangles that is farthest from `target`.

The distance to one triangle is convex: on a piece of a triangle it is largest at a vertex. So the distance
of a piece is at most the largest distance of its vertices to any one triangle, and the triangles nearest to
its vertices are good candidates. The piece with the largest bound is halved, until no bound exceeds the
distance of the farthest vertex by more than `maximal_error`.

A point of a piece is from some vertex at most as far as the longest edge divided by the square root of 3, and
the distance grows by at most as much: where triangles of the target are smaller, so is this bound.
*/
class Farthest_point_search
{
  using Query = Nearest_triangle::Query;
  using Vertices = std::array<std::size_t, 3>; // indices of queries

  struct Piece
  {
    double bound;
    Vertices vertices;
    bool operator<(const Piece& p) const
    {
      return bound != p.bound ? bound < p.bound : vertices < p.vertices;
    }
  };

  const Nearest_triangle& m_target;
  const double m_maximal_error;
  std::vector<Query> m_queries;
  std::size_t m_farthest = 0;
  std::priority_queue<Piece> m_pieces;

public:
  Farthest_point_search(const Nearest_triangle& target, double maximal_error)
    : m_target(target), m_maximal_error(maximal_error)
  {
  }

  void add_triangles(const Triangle_soup& soup)
  {
    constexpr std::size_t none = std::size_t(-1);
    std::vector<std::size_t> query_of_point(soup.points.size(), none);
    m_queries.reserve(soup.points.size());
    for(const auto& t : soup.triangles)
      for(std::size_t v : t)
        if(query_of_point[v] == none)
          query_of_point[v] = add(m_queries.empty() ? m_target(soup.points[v])
                                                    : m_target(soup.points[v], m_queries.back().nearest));
    for(const auto& t : soup.triangles)
      add_piece({query_of_point[t[0]], query_of_point[t[1]], query_of_point[t[2]]},
                std::numeric_limits<double>::infinity());
  }

  bool is_ended() const { return m_pieces.empty() || m_pieces.top().bound <= limit(); }

  /// Halves the piece with the largest bound at its longest edge.
  void halve()
  {
    const Piece piece = m_pieces.top();
    m_pieces.pop();
    auto [a, b, c] = piece.vertices;
    if(squared_length(b, c) > squared_length(a, b))
      std::swap(a, c);
    if(squared_length(a, c) > squared_length(a, b))
      std::swap(b, c);
    const std::size_t m = add(
      m_target(CGAL::midpoint(m_queries[a].point, m_queries[b].point), m_queries[a].nearest));
    add_piece({a, m, c}, piece.bound);
    add_piece({m, b, c}, piece.bound);
  }

  One_sided_distance result() const
  {
    const Query& q = m_queries[m_farthest];
    // Pieces left out are within the limit at that time, which has only grown.
    const double bound = m_pieces.empty() ? limit() : (std::max)(limit(), m_pieces.top().bound);
    return {q.distance, bound - q.distance, q.point, rounded_point(q.nearest.point)};
  }

private:
  double limit() const { return m_queries[m_farthest].distance + m_maximal_error; }

  double squared_length(std::size_t i, std::size_t j) const
  {
    return CGAL::squared_distance(m_queries[i].point, m_queries[j].point);
  }

  std::size_t add(const Query& query)
  {
    m_queries.push_back(query);
    if(query.distance > m_queries[m_farthest].distance)
      m_farthest = m_queries.size() - 1;
    return m_queries.size() - 1;
  }

  void add_piece(const Vertices& v, double bound)
  {
    const double longest = (std::max)(
                   {squared_length(v[0], v[1]), squared_length(v[1], v[2]), squared_length(v[2], v[0])}),
                 farthest = (std::max)(
                   {m_queries[v[0]].distance, m_queries[v[1]].distance, m_queries[v[2]].distance});
    bound = (std::min)(bound, farthest + std::sqrt(longest / 3));
    if(bound <= limit())
      return;
    for(std::size_t i : v) {
      const std::size_t nearest = m_queries[i].nearest.triangle;
      double largest = 0;
      for(std::size_t j : v)
        largest = (std::max)(largest, m_queries[j].nearest.triangle == nearest
                                        ? m_queries[j].distance
                                        : m_target.distance(m_queries[j].point, nearest));
      bound = (std::min)(bound, largest);
    }
    if(bound > limit())
      m_pieces.push({bound, v});
  }
};

/// The point of `soup` that is farthest from `target`. Where large triangles coincide with small ones, very
/// many pieces would be needed, so their number is limited: the point is found early, and the error is told.
inline One_sided_distance one_sided_distance(const Triangle_soup& soup, const Nearest_triangle& target,
                                             double maximal_error)
{
  constexpr std::size_t maximal_number_of_halvings = 200000; // twice what a brain of 10,000 vertices takes
  Farthest_point_search search(target, maximal_error);
  search.add_triangles(soup);
  for(std::size_t n = 0; n < maximal_number_of_halvings && !search.is_ended(); ++n)
    search.halve();
  return search.result();
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_SURFACE_HAUSDORFF_DISTANCE_H
