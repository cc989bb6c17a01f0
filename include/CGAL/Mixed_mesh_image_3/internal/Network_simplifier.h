// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Simplification of a network of labels in which no triangles cut each other.

#ifndef CGAL_MIXED_MESH_IMAGE_3_INTERNAL_NETWORK_SIMPLIFIER_H
#define CGAL_MIXED_MESH_IMAGE_3_INTERNAL_NETWORK_SIMPLIFIER_H

#include <CGAL/Mixed_mesh_3/Index.h>
#include <CGAL/Mixed_mesh_3/internal/base/parallel_for.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/surface/self_intersections.h>
#include <CGAL/Mixed_mesh_image_3/internal/Label_network.h>
#include <CGAL/Mixed_mesh_image_3/internal/Network_collapses.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
Simplifies a network to about a number of vertices, in steps. Where triangles would cut each other, vertices
stay as they are.

All steps but the last one are taken cube by cube. What has all vertices in a cube stays in it, as the cube is
convex, and triangles between cubes stay as they are: so no triangles of two cubes cut each other, cubes are
simplified in parallel, and where triangles would cut each other, one cube is simplified again. The last step
is taken in the whole network, so that vertices are where it is curved.
*/
class Network_simplifier
{
  using Index = std::uint32_t;
  using Triangle = Label_network::Triangle;
  using Cube = std::array<std::size_t, 3>;

  // The triangles that meet a cube. Where all vertices of a triangle are of triangles between cubes, it stays
  // as it is.
  struct Part
  {
    std::vector<Index> triangles; // numbers in the whole network
    std::vector<Index> vertices;  // numbers in the whole network, ascending
    Label_network network;
    std::vector<bool> is_between; // vertices of triangles between cubes
    std::vector<bool> is_fixed;   // vertices with which triangles would cut each other
    CGAL::Bbox_3 box;             // of the vertices in the cube
  };

  // A grid of cubes.
  class Grid
  {
    Vec3 m_origin;
    double m_side;
    Cube m_size;

  public:
    // \param number of cubes of the box of points, about
    Grid(const std::vector<Vec3>& points, std::size_t number) : m_origin(points.front())
    {
      Vec3 last = points.front();
      for(const Vec3& p : points)
        for(std::size_t k = 0; k < 3; ++k) {
          m_origin[k] = (std::min)(m_origin[k], p[k]);
          last[k] = (std::max)(last[k], p[k]);
        }
      const Vec3 sides = last - m_origin;
      const double longest = *std::max_element(sides.begin(), sides.end());
      m_side = longest > 0 ? longest / std::ceil(std::cbrt(double(number))) : 1;
      for(std::size_t k = 0; k < 3; ++k)
        m_size[k] = (std::max)(std::size_t(std::ceil(sides[k] / m_side)), std::size_t(1));
    }

    std::size_t number_of_cubes() const { return m_size[0] * m_size[1] * m_size[2]; }
    Cube cube_of(const Vec3& p) const
    {
      Cube cube;
      for(std::size_t k = 0; k < 3; ++k)
        cube[k] = (std::min)(std::size_t((p[k] - m_origin[k]) / m_side), m_size[k] - 1);
      return cube;
    }
    std::size_t number(const Cube& c) const { return (c[0] * m_size[1] + c[1]) * m_size[2] + c[2]; }
  };

  Label_network m_network;
  std::vector<bool> m_is_fixed; // vertices with which triangles would cut each other
  unsigned m_threads;

  // Vertices of a cube, on average: what they take is in the cache. With a third and three times as many, the
  // surfaces of a head take 13 and 16 % more time.
  static constexpr std::size_t vertices_of_cube = 30000;
  static constexpr std::size_t vertices_for_one = 4; // of a step

public:
  Network_simplifier(Label_network network, unsigned threads)
    : m_network(std::move(network)), m_is_fixed(m_network.points.size(), false), m_threads(threads)
  {
  }

  const Label_network& operator()(std::size_t number_of_vertices)
  {
    std::size_t next = number_of_vertices;
    while(vertices_for_one * next < m_network.points.size())
      next *= vertices_for_one;
    for(; next >= number_of_vertices && next < m_network.points.size(); next /= vertices_for_one)
      take_step(double(next) / double(m_network.points.size()),
                next == number_of_vertices ? 1 : m_network.points.size() / vertices_of_cube + 1);
    return m_network;
  }

private:
  // \param share share that is to be left of the vertices that are not fixed
  void take_step(double share, std::size_t number_of_cubes)
  {
    std::vector<bool> is_between(m_network.points.size(), false);
    std::vector<Part> parts = make_parts(number_of_cubes, is_between);
    parallel_for(
      parts.size(), m_threads,
      [&](std::size_t i) {
        fill(parts[i], is_between, number_of_cubes > 1);
        simplify(parts[i], share);
      },
      1);
    std::vector<Triangle> triangles;
    for(const Triangle& t : m_network.triangles)
      if(stays(t, is_between))
        triangles.push_back(t);
    for(const Part& part : parts) {
      for(std::size_t v = 0; v < part.vertices.size(); ++v)
        if(!part.is_between[v]) {
          m_network.points[part.vertices[v]] = part.network.points[v];
          m_is_fixed[part.vertices[v]] = part.is_fixed[v];
        }
      for(Triangle t : part.network.triangles) {
        for(Index& v : t.vertices)
          v = part.vertices[v];
        triangles.push_back(t);
      }
    }
    m_network.triangles = std::move(triangles);
    leave_out_unused_vertices();
  }

  // Whether the vertices of a triangle are all of triangles between cubes: none of them moves.
  static bool stays(const Triangle& t, const std::vector<bool>& is_between)
  {
    return is_between[t.vertices[0]] && is_between[t.vertices[1]] && is_between[t.vertices[2]];
  }

  // The triangles of each cube that has some.
  std::vector<Part> make_parts(std::size_t number_of_cubes, std::vector<bool>& is_between) const
  {
    const Grid grid(m_network.points, number_of_cubes);
    std::vector<Part> parts(grid.number_of_cubes());
    for(Index t = 0; t < m_network.triangles.size(); ++t) {
      const auto& v = m_network.triangles[t].vertices;
      const std::array<Cube, 3> cubes{grid.cube_of(m_network.points[v[0]]),
                                      grid.cube_of(m_network.points[v[1]]),
                                      grid.cube_of(m_network.points[v[2]])};
      Cube first = cubes[0], last = cubes[0];
      for(std::size_t k = 0; k < 3; ++k) {
        first[k] = (std::min)({cubes[0][k], cubes[1][k], cubes[2][k]});
        last[k] = (std::max)({cubes[0][k], cubes[1][k], cubes[2][k]});
      }
      if(first != last)
        for(Index u : v)
          is_between[u] = true;
      Cube c;
      for(c[0] = first[0]; c[0] <= last[0]; ++c[0])
        for(c[1] = first[1]; c[1] <= last[1]; ++c[1])
          for(c[2] = first[2]; c[2] <= last[2]; ++c[2])
            parts[grid.number(c)].triangles.push_back(t);
    }
    return parts;
  }

  // Fills a part of which the triangles are known.
  void fill(Part& part, const std::vector<bool>& is_between, bool is_bounded) const
  {
    std::vector<Index>& vertices = part.vertices;
    for(Index t : part.triangles)
      vertices.insert(vertices.end(), m_network.triangles[t].vertices.begin(),
                      m_network.triangles[t].vertices.end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for(Index t : part.triangles) {
      Triangle triangle = m_network.triangles[t];
      for(Index& v : triangle.vertices)
        v = Index(std::lower_bound(vertices.begin(), vertices.end(), v) - vertices.begin());
      part.network.triangles.push_back(triangle);
    }
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if(!is_bounded)
      part.box = CGAL::Bbox_3(-infinity, -infinity, -infinity, infinity, infinity, infinity);
    for(Index v : vertices) {
      const Vec3& p = m_network.points[v];
      part.network.points.push_back(p);
      part.is_between.push_back(is_between[v]);
      part.is_fixed.push_back(m_is_fixed[v]);
      if(!is_between[v]) // those between cubes may be outside
        part.box += CGAL::Bbox_3(p[0], p[1], p[2], p[0], p[1], p[2]);
    }
  }

  // Leaves the triangles that do not stay. A part that no attempt helps is not simplified.
  static void simplify(Part& part, double share)
  {
    constexpr int most_attempts = 8;
    const std::size_t n = part.vertices.size();
    std::vector<bool> is_fixed(n), is_cut = part.is_fixed;
    const auto number_of_fixed = [&] {
      for(std::size_t v = 0; v < n; ++v)
        is_fixed[v] = part.is_between[v] || is_cut[v];
      return std::size_t(std::count(is_fixed.begin(), is_fixed.end(), true));
    };
    const double wanted = share * double(n - number_of_fixed());
    for(int attempt = 0; attempt < most_attempts; ++attempt) {
      const std::size_t fixed = number_of_fixed();
      Network_collapses collapses(part.network, is_fixed, part.box);
      collapses(fixed + std::size_t(wanted));
      const std::vector<Triangle>& merged = collapses.network().triangles;
      std::vector<std::array<Vertex_index, 3>> left;
      for(std::size_t t = 0; t < merged.size(); ++t)
        if(const auto& v = merged[t].vertices; collapses.is_left(t))
          left.push_back({Vertex_index(v[0]), Vertex_index(v[1]), Vertex_index(v[2])});
      const std::vector<Vertex_index> cuts = vertices_of_self_intersections(collapses.network().points, left);
      if(cuts.empty()) {
        std::vector<Triangle> triangles;
        for(std::size_t t = 0; t < merged.size(); ++t)
          if(collapses.is_left(t) && !stays(part.network.triangles[t], part.is_between))
            triangles.push_back(merged[t]);
        part.network.triangles = std::move(triangles);
        part.network.points = collapses.network().points;
        part.is_fixed = std::move(is_cut);
        return;
      }
      std::vector<bool> is_at_cut(n, false);
      for(Vertex_index v : cuts)
        is_at_cut[v] = true;
      for(Index v = 0; v < n; ++v)
        is_cut[v] = is_cut[v] || is_at_cut[collapses.merged_into(v)];
    }
    std::vector<Triangle>& all = part.network.triangles;
    const auto is_of_part = [&part](const Triangle& t) { return !stays(t, part.is_between); };
    all.erase(std::stable_partition(all.begin(), all.end(), is_of_part), all.end());
  }

  void leave_out_unused_vertices()
  {
    constexpr auto none = Index(-1);
    std::vector<Index> numbers(m_network.points.size(), none);
    for(const Triangle& t : m_network.triangles)
      for(Index v : t.vertices)
        numbers[v] = 0;
    Index number = 0;
    for(Index v = 0; v < numbers.size(); ++v)
      if(numbers[v] != none) {
        m_network.points[number] = m_network.points[v];
        m_is_fixed[number] = m_is_fixed[v];
        numbers[v] = number++;
      }
    m_network.points.resize(number);
    m_is_fixed.resize(number);
    for(Triangle& t : m_network.triangles)
      for(Index& v : t.vertices)
        v = numbers[v];
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_INTERNAL_NETWORK_SIMPLIFIER_H
