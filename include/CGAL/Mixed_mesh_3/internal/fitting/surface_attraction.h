// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Attraction of the boundary of a mesh to places of the surface that are far: its vertices slide to come
// nearer.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_SURFACE_ATTRACTION_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_SURFACE_ATTRACTION_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_3/internal/base/parallel_for.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Working_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Surface_tolerances.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Vertex_optimizer.h>
#include <CGAL/Mixed_mesh_3/internal/surface/Triangle_tree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
Measures the distance between boundary and surface at sample points of both, and tells each boundary vertex
where to slide: samples that are too far draw the boundary face nearest to them, and so its vertices, as in
the iterative-closest-point method. The farther a sample is, the more it counts; a sample that has drawn in
vain draws more strongly.

\tparam Project projection like `Surface_projection`
*/
template <class Project>
class Surface_attraction
{
  using Triangle = std::array<Vertex_index, 3>;

  struct Boundary_triangle
  {
    Triangle vertices;
    Stratum stratum;
    double tolerance;
    int steps = 0;                // of the grid of samples; 0: there is none yet
    std::size_t first_sample = 0; // its other samples follow

    friend bool operator<(const Boundary_triangle& a, const Boundary_triangle& b)
    {
      return std::tie(a.vertices, a.stratum, a.tolerance) < std::tie(b.vertices, b.stratum, b.tolerance);
    }
  };

  const Working_mesh& m_mesh;
  const Project& m_project;
  const std::vector<Surface_sample>& m_samples;
  const unsigned m_threads;
  std::vector<Boundary_triangle> m_triangles;
  std::vector<double> m_stiffness; // factor of each vertex: grows when drawn in vain
  // Vertices of the boundary, ascending. In a large mesh they are few: what is known of them only is in
  // arrays in this order, and the corners of triangles are their positions here.
  std::vector<Vertex_index> m_vertices;
  std::vector<std::array<std::uint32_t, 3>> m_corners;
  std::vector<Vec3> m_shifts; // weighted mean of the shifts of each boundary vertex
  std::vector<double> m_weights;
  std::vector<std::pair<double, Vec3>> m_far_points; // points with their distances
  std::vector<double> m_farthest;                    // distance of the farthest sample of each triangle
  double m_largest_distance = 0;
  // Largest number of steps along the edge of a triangle. With 4, a pipe with a wall of a fortieth of its
  // radius loses 4 % of its volume, and the optimization of five labels takes a sixth less time.
  double m_most_steps = 8;
  // Most samples are near: a sample need not be measured again until the boundary next to it has moved so far
  // that the sample might draw.
  std::vector<Vec3> m_last_points;        // positions of the boundary vertices at the last measurement
  std::vector<double> m_moved;            // way of each boundary vertex since the last measurement
  std::vector<double> m_slack_of_samples; // distance that the boundary may move until the sample draws
  std::vector<std::size_t> m_nearest;     // triangle of each sample
  std::vector<double> m_slacks;           // of samples of the boundary
  std::vector<Vec3> m_found;              // points of the surface, the closest ones when they were asked for

  // Rounding of barycentric coordinates: a place on an edge does not draw the vertex opposite to the edge.
  // It is 10^7 roundings of 2^-53.
  static constexpr double nearly_0 = 1e-9;
  static constexpr double not_measured = -std::numeric_limits<double>::infinity(); // slack of a new sample
  static constexpr std::size_t no_triangle = std::size_t(-1);
  // Share of the tolerance below which samples draw nothing. With half of it, the largest distance of a brain
  // of 2,000 vertices is smaller by a quarter, those of a gear and a torus are larger by a tenth; with twice
  // as much, that of the brain is larger by a fifth, and these by a tenth.
  static constexpr double tolerated_share = 0.35;
  // Number of successive samples for one thread, each of which is a hint for the next one.
  static constexpr std::size_t samples_in_turn = 1024;
  // Weights in the unit of costs to the fourth power, at a shift as long as the edges around the vertex. With
  // half of the first weight, three of seven largest distances are larger by 15 to 23 % and one is smaller by
  // 16 %; with twice as much, two are larger, by 14 and 61 %, and two smaller, by 5 and 10 %. Weights of
  // places that stay far grow by half at a time, to three hundred times theirs; if they grow to 3 times
  // theirs at a time, distances of an elephant and a torus are larger by 9 and 22 %, that of a brain with a
  // region smaller by 28 %.
  static constexpr double weight = 100, stiffening = 1.5, stiffest = 300;

public:
  /// \param samples samples of the surface; may be empty
  Surface_attraction(const Working_mesh& mesh, const Project& project,
                     const std::vector<Surface_sample>& samples, unsigned threads = 1)
    : m_mesh(mesh), m_project(project), m_samples(samples), m_threads(threads),
      m_stiffness(mesh.points.size(), 1), m_slack_of_samples(samples.size(), 0), m_nearest(samples.size(), 0)
  {
  }

  /// Sets the faces of the boundary. Samples are not measured again where these stay.
  /// \param tolerance `double(Stratum)`: tolerance of a face
  template <class Tolerance>
  void set_boundary(const Interface_faces& boundary, const Tolerance& tolerance)
  {
    const std::vector<Boundary_triangle> before = std::exchange(m_triangles, {});
    m_stiffness.resize(m_mesh.points.size(), 1);
    for(std::size_t f = 0; f < boundary.faces.size(); ++f) {
      const Face_vertices& v = boundary.faces[f].vertices();
      for(int i = 2; i < v.size(); ++i)
        m_triangles.push_back({{v[0], v[i - 1], v[i]}, boundary.strata[f], tolerance(boundary.strata[f])});
    }
    number_vertices();
    take_over_measurements(before);
  }

  /// Lets all samples be measured again.
  void forget_measurements()
  {
    for(Boundary_triangle& t : m_triangles)
      t.steps = 0;
    m_slack_of_samples.assign(m_samples.size(), 0);
  }

  /// Samples the boundary at the middles of edges only.
  void sample_coarsely() { m_most_steps = 2; }

  /// The largest distance at the last measurement, as an upper bound.
  double largest_distance() const { return m_largest_distance; }
  /// Points of the surface that were farther from the boundary than the tolerance at the last measurement,
  /// and points next to places of the boundary that were; with their distances, in tolerances.
  const std::vector<std::pair<double, Vec3>>& far_points() const { return m_far_points; }

  /// The largest distance at the longest edge of each triangle that has samples farther than the tolerance.
  std::map<std::pair<Vertex_index, Vertex_index>, double> far_edges() const
  {
    std::map<std::pair<Vertex_index, Vertex_index>, double> edges;
    for(std::size_t t = 0; t < m_farthest.size(); ++t)
      if(m_farthest[t] > m_triangles[t].tolerance) {
        const Triangle& v = m_triangles[t].vertices;
        std::pair<double, std::pair<Vertex_index, Vertex_index>> longest{};
        for(int i = 0; i < 3; ++i) {
          const Vertex_index a = v[i], b = v[(i + 1) % 3];
          longest = (std::max)(longest, {norm(m_mesh.points[a] - m_mesh.points[b]), std::minmax(a, b)});
        }
        double& distance = edges[longest.second];
        distance = (std::max)(distance, m_farthest[t]);
      }
    return edges;
  }

  /// Measures all distances.
  /// \par Complexity
  /// A query to an AABB tree for each sample of the surface, and of the boundary
  void measure()
  {
    m_shifts.assign(m_vertices.size(), Vec3{});
    m_weights.assign(m_vertices.size(), 0);
    m_far_points.clear();
    m_largest_distance = 0;
    m_farthest.assign(m_triangles.size(), 0);
    m_moved.assign(m_vertices.size(), 0);
    for(std::size_t i = 0; i < m_last_points.size(); ++i)
      m_moved[i] = norm(m_mesh.points[m_vertices[i]] - m_last_points[i]);
    m_last_points.clear();
    for(Vertex_index v : m_vertices)
      m_last_points.push_back(m_mesh.points[v]);
    measure_from_surface();
    measure_from_boundary();
  }

  /// The attractions of the vertices that are drawn, ascending, by the last measurement. Those drawn before,
  /// and no longer, are held where they are: else they would leave this place, for better elements.
  /// \param scale factor of the weights; 1 where costs to the fourth power are minimized
  std::vector<Attraction> attractions(double scale)
  {
    std::vector<Attraction> result;
    for(std::size_t i = 0; i < m_vertices.size(); ++i) {
      const Vertex_index v = m_vertices[i];
      const bool is_drawn = m_weights[i] > 0;
      if(!is_drawn && m_stiffness[v] == 1)
        continue;
      const Vec3& p = m_mesh.points[v];
      const double length = mean_edge_length(v);
      result.push_back({v,
                        is_drawn ? m_project(p + (1 / m_weights[i]) * m_shifts[i], p, m_mesh.strata[v]) : p,
                        scale * weight * m_stiffness[v] / (length * length)});
      if(is_drawn)
        m_stiffness[v] = (std::min)(stiffening * m_stiffness[v], stiffest);
    }
    return result;
  }

private:
  // Numbers the vertices of the boundary. Those that were there keep their last positions.
  void number_vertices()
  {
    const std::vector<Vertex_index> before = std::exchange(m_vertices, {});
    for(const Boundary_triangle& t : m_triangles)
      m_vertices.insert(m_vertices.end(), t.vertices.begin(), t.vertices.end());
    std::sort(m_vertices.begin(), m_vertices.end());
    m_vertices.erase(std::unique(m_vertices.begin(), m_vertices.end()), m_vertices.end());
    const auto number = [this](Vertex_index v) {
      return std::uint32_t(std::lower_bound(m_vertices.begin(), m_vertices.end(), v) - m_vertices.begin());
    };
    m_corners.clear();
    for(const Boundary_triangle& t : m_triangles)
      m_corners.push_back({number(t.vertices[0]), number(t.vertices[1]), number(t.vertices[2])});
    const std::vector<Vec3> last = std::exchange(m_last_points, {});
    auto old = before.begin();
    for(Vertex_index v : m_vertices) {
      old = std::lower_bound(old, before.end(), v);
      m_last_points.push_back(!last.empty() && old != before.end() && *old == v ? last[old - before.begin()]
                                                                                : m_mesh.points[v]);
    }
  }

  // Lets triangles that were there keep their samples, and samples of the surface the triangles that were
  // nearest.
  void take_over_measurements(const std::vector<Boundary_triangle>& before)
  {
    std::vector<std::size_t> sorted(before.size()), now(before.size(), no_triangle);
    std::iota(sorted.begin(), sorted.end(), 0);
    std::sort(sorted.begin(), sorted.end(),
              [&](std::size_t a, std::size_t b) { return before[a] < before[b]; });
    for(std::size_t k = 0; k < m_triangles.size(); ++k) {
      Boundary_triangle& t = m_triangles[k];
      const auto old = std::lower_bound(sorted.begin(), sorted.end(), t,
                                        [&](std::size_t i, const auto& value) { return before[i] < value; });
      if(old == sorted.end() || t < before[*old])
        continue;
      t = before[*old];
      now[*old] = k;
    }
    for(std::size_t i = 0; i < m_samples.size(); ++i) {
      m_nearest[i] = before.empty() ? no_triangle : now[m_nearest[i]];
      if(m_nearest[i] != no_triangle)
        continue;
      m_nearest[i] = 0; // some hint
      m_slack_of_samples[i] = 0;
    }
  }

  double mean_edge_length(Vertex_index v) const
  {
    double sum = 0;
    int count = 0;
    for(Element_index e : m_mesh.incident[v])
      for(Vertex_index u : m_mesh.elements[e])
        if(u != v) {
          sum += norm(m_mesh.points[u] - m_mesh.points[v]);
          ++count;
        }
    return sum / count;
  }

  static double threshold(double tolerance) { return tolerated_share * tolerance; }

  // Whether a sample at a distance of the threshold minus the slack is still nearer than the threshold.
  bool is_near(double& slack, std::size_t triangle, double tolerance)
  {
    const std::array<std::uint32_t, 3>& corners = m_corners[triangle];
    slack -= (std::max)({m_moved[corners[0]], m_moved[corners[1]], m_moved[corners[2]]});
    if(!(slack > 0))
      return false;
    m_largest_distance = (std::max)(m_largest_distance, threshold(tolerance) - slack);
    return true;
  }

  // Adds a sample: the point of the triangle with barycentric coordinates b should be at `where` on the
  // surface.
  void add(std::size_t number, const std::array<double, 3>& b, const Vec3& shift, const Vec3& where,
           double share, double tolerance)
  {
    const std::array<std::uint32_t, 3>& corners = m_corners[number];
    const double distance = norm(shift), excess = distance - 0.7 * threshold(tolerance);
    m_largest_distance = (std::max)(m_largest_distance, distance);
    m_farthest[number] = (std::max)(m_farthest[number], distance);
    if(distance > tolerance)
      m_far_points.emplace_back(distance / tolerance, where);
    if(distance < threshold(tolerance))
      return;
    for(int i = 0; i < 3; ++i)
      if(b[i] > nearly_0) {
        const double w = share * b[i] * excess * excess;
        m_shifts[corners[i]] = m_shifts[corners[i]] + w * shift;
        m_weights[corners[i]] += w * b[i];
      }
  }

  void measure_from_surface()
  {
    if(m_samples.empty() || m_triangles.empty())
      return;
    std::vector<std::size_t> asked;
    for(std::size_t i = 0; i < m_samples.size(); ++i)
      if(!is_near(m_slack_of_samples[i], m_nearest[i], m_samples[i].tolerance))
        asked.push_back(i);
    if(asked.empty())
      return;
    std::vector<std::array<Vec3, 3>> triangles;
    for(const auto& [t, stratum, tolerance, steps, first] : m_triangles)
      triangles.push_back({m_mesh.points[t[0]], m_mesh.points[t[1]], m_mesh.points[t[2]]});
    const Triangle_tree tree(triangles);
    std::vector<Vec3> found(asked.size());
    parallel_for((asked.size() + samples_in_turn - 1) / samples_in_turn, m_threads,
                 [&](std::size_t block) {
                   const std::size_t first = block * samples_in_turn;
                   for(std::size_t k = first; k < (std::min)(first + samples_in_turn, asked.size()); ++k) {
                     const Vec3& s = m_samples[asked[k]].point;
                     std::size_t& nearest = m_nearest[asked[k]];
                     // Hints: the nearest triangle of the last measurement, and of the last sample.
                     Triangle_tree::Closest hint = tree.closest(s, nearest);
                     if(k > first)
                       hint = tree.nearer(s, hint, tree.closest(s, m_nearest[asked[k - 1]]));
                     const Triangle_tree::Closest closest = tree.closest(s, hint);
                     nearest = closest.triangle;
                     found[k] = closest.point;
                   }
                 },
                 1);
    for(std::size_t k = 0; k < asked.size(); ++k) {
      const std::size_t i = asked[k];
      const Vec3 &s = m_samples[i].point, &p = found[k];
      m_slack_of_samples[i] = threshold(m_samples[i].tolerance) - norm(s - p);
      add(m_nearest[i], barycentric_coordinates(m_triangles[m_nearest[i]].vertices, p), s - p, s, 1,
          m_samples[i].tolerance);
    }
  }

  std::array<double, 3> barycentric_coordinates(const Triangle& t, const Vec3& p) const
  {
    const Vec3 a = m_mesh.points[t[0]] - p, b = m_mesh.points[t[1]] - p, c = m_mesh.points[t[2]] - p;
    const Vec3 normal = cross(b - a, c - a);
    const double area = dot(normal, normal);
    if(!(area > 0))
      return {0, 0, 0};
    return {dot(normal, cross(b, c)) / area, dot(normal, cross(c, a)) / area,
            dot(normal, cross(a, b)) / area};
  }

  // Number of steps of the grid on a triangle, which is finer the larger the triangle is.
  int number_of_steps(const Triangle& t, double tolerance) const
  {
    double longest = 0;
    for(int i = 0; i < 3; ++i)
      longest = (std::max)(longest, norm(m_mesh.points[t[i]] - m_mesh.points[t[(i + 1) % 3]]));
    return int((std::min)((std::max)(std::ceil(longest / tolerance), 2.), m_most_steps));
  }

  static int number_of_samples(int steps) { return (steps + 1) * (steps + 2) / 2 - 3; }

  // Calls `f(sample, b, p)` for each sample of a triangle, with its barycentric coordinates.
  template <class F>
  void for_each_sample(const Boundary_triangle& triangle, const F& f) const
  {
    const Triangle& t = triangle.vertices;
    const int n = triangle.steps;
    std::size_t sample = triangle.first_sample;
    for(int i = 0; i <= n; ++i)
      for(int j = 0; i + j <= n; ++j)
        if((i > 0) + (j > 0) + (i + j < n) > 1) { // not at a vertex
          const std::array<double, 3> b{1 - double(i + j) / n, double(i) / n, double(j) / n};
          f(sample++, b,
            b[0] * m_mesh.points[t[0]] + (b[1] * m_mesh.points[t[1]] + b[2] * m_mesh.points[t[2]]));
        }
  }

  // Chooses the samples of the boundary: those of a triangle with as many steps as before stay.
  void update_samples_of_boundary()
  {
    std::vector<int> steps;
    std::size_t number = 0;
    for(const Boundary_triangle& t : m_triangles) {
      steps.push_back(number_of_steps(t.vertices, t.tolerance));
      number += std::size_t(number_of_samples(steps.back()));
    }
    std::vector<double> slacks;
    std::vector<Vec3> found;
    slacks.reserve(number);
    found.reserve(number);
    for(std::size_t k = 0; k < m_triangles.size(); ++k) {
      Boundary_triangle& t = m_triangles[k];
      const auto first = std::ptrdiff_t(std::exchange(t.first_sample, slacks.size()));
      const int n = number_of_samples(steps[k]);
      if(std::exchange(t.steps, steps[k]) == steps[k]) {
        slacks.insert(slacks.end(), m_slacks.begin() + first, m_slacks.begin() + first + n);
        found.insert(found.end(), m_found.begin() + first, m_found.begin() + first + n);
      } else {
        slacks.insert(slacks.end(), std::size_t(n), not_measured);
        found.resize(slacks.size());
      }
    }
    m_slacks = std::move(slacks);
    m_found = std::move(found);
  }

  void measure_from_boundary()
  {
    update_samples_of_boundary();
    std::vector<std::size_t> asked; // triangles with samples that are not near
    for(std::size_t k = 0; k < m_triangles.size(); ++k) {
      const Boundary_triangle& t = m_triangles[k];
      bool are_near = true;
      for(int i = 0; i < number_of_samples(t.steps); ++i)
        are_near = is_near(m_slacks[t.first_sample + std::size_t(i)], k, t.tolerance) && are_near;
      if(!are_near)
        asked.push_back(k);
    }
    // A point of the surface of each stratum, a hint where there is no nearer one: several threads need
    // hints.
    std::map<Stratum, Vec3> anywhere;
    for(std::size_t k : asked) {
      const Boundary_triangle& t = m_triangles[k];
      if(const auto found = anywhere.try_emplace(t.stratum); found.second)
        found.first->second = m_project(m_mesh.points[t.vertices[0]], t.stratum);
    }
    parallel_for(asked.size(), m_threads, [&](std::size_t i) {
      const Boundary_triangle& t = m_triangles[asked[i]];
      const Vec3* last = &anywhere.at(t.stratum);
      for_each_sample(t, [&](std::size_t sample, const auto&, const Vec3& p) {
        Vec3& found = m_found[sample];
        if(!(m_slacks[sample] > 0))
          found = m_project(p, m_slacks[sample] == not_measured ? *last : found, t.stratum);
        last = &found;
      });
    });
    for(std::size_t k : asked) {
      const Boundary_triangle& t = m_triangles[k];
      const double share = 4. / number_of_samples(t.steps); // weighted like four samples
      for_each_sample(t, [&](std::size_t sample, const std::array<double, 3>& b, const Vec3& p) {
        if(m_slacks[sample] > 0)
          return;
        const Vec3& q = m_found[sample];
        m_slacks[sample] = threshold(t.tolerance) - norm(q - p);
        add(k, b, q - p, q, share, t.tolerance);
      });
    }
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_SURFACE_ATTRACTION_H
