// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Optimization of vertices: each vertex moves to where the elements around it are best.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_VERTEX_OPTIMIZER_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_VERTEX_OPTIMIZER_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Shared_mark.h>
#include <CGAL/Mixed_mesh_3/internal/base/parallel_for.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Vertex_coloring.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Vertex_levels.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Vertex_star.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Working_mesh.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The attraction of a boundary vertex to a place: `weight` times the squared distance is added to the
/// energy.
struct Attraction
{
  Vertex_index vertex = no_vertex;
  Vec3 place{};
  double weight = 0;
};

/*!
Descends, vertex after vertex, on the sum of the powers of the costs of the elements around a vertex. A move
is made only if the sum falls, none of these elements gets a cost above the bound (or, if one is above
already, above the worst one), and all are proved positive: validity and the bound are always kept.

Boundary vertices slide on the surface, and only where an element is bad (free sliding would lose volume) or
an attraction draws them.

Vertices move in the order of their numbers by default, which several threads keep by levels; or by colors.
Vertices of one level, or color, share no element, so that several threads move them, with the same result as
one thread. There are far fewer colors than levels, but moves by colors have another result.

\tparam Quality a model of `MixedMeshQuality_3`
\tparam Project projection like `Surface_projection`
*/
template <class Quality, class Project>
class Vertex_optimizer
{
  Working_mesh& m_mesh;
  const Quality& m_quality;
  const Project& m_project;
  const double m_sliding_threshold;
  double m_bound;
  std::vector<double> m_radii;          // next trial step of each vertex; 0: not known
  std::vector<Shared_mark> m_is_active; // whether a move may gain something
  std::vector<std::uint8_t> m_is_fixed;
  std::vector<std::uint8_t> m_may_leave_surface; // boundary vertices that need not stay on the surface
  std::vector<std::uint8_t> m_is_inside;         // vertices where only bad elements count
  std::vector<Attraction> m_attractions;         // by vertex, ascending
  std::vector<std::uint32_t> m_attraction_of;    // number of attraction of each vertex, from 1; 0: none
  std::vector<double> m_costs;                   // cost of each element; negative: not known
  Vertex_coloring m_coloring;
  Vertex_levels m_levels;
  unsigned m_threads = 1;
  bool m_moves_by_colors = false;
  double m_power = 4;
  double m_good_enough = 1, m_good_enough_inside = 1;
  double m_first_step = 0.1, m_growth = 1.5;

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  // Steps grow when they succeed, and shrink when they fail, up to five times: 0.4^5 is just above 0.01. Of
  // nine meshes of 2,000 vertices, a slot keeps less of its sharp edges, 0.982 and 0.970 instead of 0.984,
  // with half or twice as much shrinkage, and 0.962 with twice the smallest step; with half of that step, the
  // worst aspect-ratio coefficients of two are 2.9 and 3.2 instead of 2.55. Distances vary either way.
  static constexpr double shrinkage = 0.4, smallest_step = 0.01;
  // Longest step of a vertex that slides, as a share of its shortest edge: longer ones lead over furrows, to
  // where faces cut each other. Without a limit, one of 14 mm with edges of 13 mm did in a brain.
  static constexpr double longest_slide = 0.5;
  static constexpr std::size_t moves_worth_a_thread = 64;
  // Levels are smaller than colors: a brain of 10,000 vertices has 270, of 37 vertices on average.
  static constexpr std::size_t moves_of_level_worth_a_thread = 8;
  // Gain that wakes the neighbors of a vertex, as a share of its sum. With 10,000 vertices, 0.003 takes 1.7
  // times as long, for a mean aspect-ratio coefficient of 1.418 instead of 1.426; 0.04 a sixth less, for
  // 1.434.
  static constexpr double notable_gain = 0.02;

public:
  /// \param sliding_threshold cost of an element above which boundary vertices slide
  /// \param bound largest cost that an element may get
  Vertex_optimizer(Working_mesh& mesh, const Quality& quality, const Project& project,
                   double sliding_threshold, double bound)
    : m_mesh(mesh), m_quality(quality), m_project(project), m_sliding_threshold(sliding_threshold),
      m_bound(bound), m_radii(mesh.points.size(), 0), m_is_active(mesh.points.size()),
      m_is_fixed(mesh.points.size(), 0), m_may_leave_surface(mesh.points.size(), 0),
      m_is_inside(mesh.points.size(), 0)
  {
    for(Vertex_index v = 0; v < mesh.points.size(); ++v)
      m_is_fixed[v] = mesh.is_on_boundary(v);
  }

  /// Sets the largest cost that an element may get from now on.
  void set_bound(double cost) { m_bound = cost; }

  /// Sets the first trial step of a vertex, as a share of the shortest edge, and the growth of a step that
  /// succeeds. Default: 0.1, 1.5.
  void set_steps(double first, double growth)
  {
    m_first_step = first;
    m_growth = growth;
  }

  /// Sets the cost that is good enough inside: vertices that are more than `layers` layers of elements away
  /// from the boundary, and not in tetrahedra only, stay where no element has a larger cost. They are
  /// vertices of an octree, which is good enough.
  void set_good_enough_inside(double cost, int layers)
  {
    m_good_enough_inside = cost;
    std::vector<std::uint8_t> is_near(m_mesh.points.size(), 0);
    for(Vertex_index v = 0; v < is_near.size(); ++v)
      is_near[v] = m_mesh.is_on_boundary(v);
    for(int layer = 0; layer < layers; ++layer) {
      const std::vector<std::uint8_t> was_near = is_near;
      for(const Working_mesh::Element& element : m_mesh.elements)
        if(!element.is_removed
           && std::any_of(element.begin(), element.end(), [&](Vertex_index v) { return was_near[v] != 0; }))
          for(Vertex_index v : element)
            is_near[v] = 1;
    }
    for(const Working_mesh::Element& element : m_mesh.elements)
      if(!element.is_removed && element.kind != TETRAHEDRON)
        for(Vertex_index v : element)
          m_is_inside[v] = !is_near[v];
  }

  /// Sets the number of threads that move vertices. Default: 1.
  void use_threads(unsigned threads) { m_threads = threads; }
  /// Moves vertices by colors from now on.
  void use_colors() { m_moves_by_colors = true; }

  /// Makes vertices that the mesh has more than before free to move.
  void add_vertices()
  {
    m_radii.resize(m_mesh.points.size(), 0);
    m_is_active.resize(m_mesh.points.size(), true);
    m_is_fixed.resize(m_mesh.points.size(), 0);
    m_may_leave_surface.resize(m_mesh.points.size(), 0);
    m_is_inside.resize(m_mesh.points.size(), 0);
  }

  /// Releases a boundary vertex: boundary vertices are fixed until they are on the surface.
  void release(Vertex_index v) { m_is_fixed[v] = m_may_leave_surface[v] = 0; }
  void fix(Vertex_index v) { m_is_fixed[v] = 1; }
  /// Lets a vertex move off the surface, until it is released.
  void free_from_surface(Vertex_index v)
  {
    m_is_fixed[v] = 0;
    m_may_leave_surface[v] = 1;
  }

  /// Makes the next steps long again: steps that failed have become short.
  void reset_steps() { std::fill(m_radii.begin(), m_radii.end(), 0); }

  /// Forgets costs. To be called when positions were changed from outside.
  void forget_costs() { m_costs.clear(); }
  /// Forgets elements. To be called when elements were changed to what they were before.
  void forget_elements()
  {
    m_costs.clear();
    m_coloring = Vertex_coloring();
    m_levels = Vertex_levels();
  }

  /// The vertices that are fixed, and those that need not stay on the surface.
  struct Freedom
  {
    std::vector<std::uint8_t> is_fixed, may_leave_surface;
  };
  Freedom freedom() const { return {m_is_fixed, m_may_leave_surface}; }
  void set_freedom(const Freedom& freedom)
  {
    m_is_fixed = freedom.is_fixed;
    m_may_leave_surface = freedom.may_leave_surface;
  }

  void activate(Vertex_index v) { m_is_active[v] = true; }
  void activate_all() { std::fill(m_is_active.begin(), m_is_active.end(), true); }

  void activate_around(Vertex_index v)
  {
    for(Element_index e : m_mesh.incident[v])
      for(Vertex_index u : m_mesh.elements[e])
        m_is_active[u] = true;
  }

  /// Replaces the attractions, of some vertices, ascending.
  void attract(std::vector<Attraction> attractions)
  {
    m_attractions = std::move(attractions);
    m_attraction_of.assign(m_mesh.points.size(), 0);
    for(std::size_t i = 0; i < m_attractions.size(); ++i) {
      m_attraction_of[m_attractions[i].vertex] = std::uint32_t(i + 1);
      if(m_attractions[i].weight > 0)
        activate_around(m_attractions[i].vertex);
    }
  }

  /// Sweeps over the active vertices, until none is active or the number of sweeps is reached.
  /// \param good_enough cost: vertices stay if no element has a larger cost
  void run(double power, double good_enough, int sweeps)
  {
    m_power = power;
    m_good_enough = good_enough;
    m_costs.resize(m_mesh.elements.size(), -1);
    if(m_moves_by_colors)
      m_coloring.update(m_mesh);
    else if(m_threads > 1)
      m_levels.update(m_mesh);
    for(int i = 0; i < sweeps && sweep(); ++i) {
    }
  }

  /// The vertices of the elements that cost more than `cost`, ascending.
  std::vector<Vertex_index> vertices_above(double cost)
  {
    std::vector<std::uint8_t> is_above(m_mesh.points.size(), 0);
    for(Element_index e = 0; e < m_mesh.elements.size(); ++e)
      if(const Working_mesh::Element& element = m_mesh.elements[e];
         !element.is_removed && known_cost(e) > cost)
        for(Vertex_index v : element)
          is_above[v] = 1;
    std::vector<Vertex_index> vertices;
    for(Vertex_index v = 0; v < is_above.size(); ++v)
      if(is_above[v])
        vertices.push_back(v);
    return vertices;
  }

  /// Moves a vertex if all elements around it stay positive, and none gets worse than `acceptable` and the
  /// bound, or than the worst of these elements is.
  bool try_move(Vertex_index v, const Vec3& p, double acceptable)
  {
    double limit = (std::min)(acceptable, m_bound);
    for(Element_index e : m_mesh.incident[v])
      limit = (std::max)(limit, known_cost(e));
    const Vec3 old = m_mesh.points[v];
    m_mesh.points[v] = p;
    const auto around = m_mesh.incident[v];
    boost::container::small_vector<double, 40> costs;
    const auto is_acceptable_element = [&](Element_index e) {
      costs.push_back(cost(e));
      return costs.back() <= limit;
    };
    const auto is_positive = [&](Element_index e) { return m_mesh.is_positive(m_mesh.elements[e]); };
    if(!std::all_of(around.begin(), around.end(), is_acceptable_element)
       || !std::all_of(around.begin(), around.end(), is_positive)) {
      m_mesh.points[v] = old;
      return false;
    }
    for(std::size_t i = 0; i < around.size(); ++i)
      m_costs[around[i]] = costs[i];
    activate_around(v);
    return true;
  }

private:
  // Moves each active vertex once. \return whether a vertex moved
  bool sweep()
  {
    if(m_moves_by_colors)
      return sweep_by(m_coloring, moves_worth_a_thread);
    return m_threads > 1 ? sweep_by(m_levels, moves_of_level_worth_a_thread) : sweep_in_order();
  }

  bool sweep_in_order()
  {
    bool moved = false;
    for(Vertex_index v = 0; v < m_mesh.points.size(); ++v)
      if(m_is_active[v]) {
        m_is_active[v] = false;
        moved = improve(v) || moved;
      }
    return moved;
  }

  // `Classes`: colors or levels.
  template <class Classes>
  bool sweep_by(const Classes& classes, std::size_t worth_a_thread)
  {
    Shared_mark moved;
    std::vector<Vertex_index> active, in_turn;
    for(const std::vector<Vertex_index>& vertices : classes.vertices()) {
      active.clear();
      in_turn.clear();
      for(Vertex_index v : vertices)
        if(m_is_active[v]) {
          m_is_active[v] = false;
          (m_project.is_concurrent(m_mesh.strata[v]) ? active : in_turn).push_back(v);
        }
      const auto move = [&](Vertex_index v) {
        if(improve(v))
          moved = true;
      };
      parallel_for(
        active.size(), m_threads, [&](std::size_t i) { move(active[i]); }, worth_a_thread);
      std::for_each(in_turn.begin(), in_turn.end(), move);
    }
    return moved;
  }

  double cost(Element_index e) const
  {
    return m_quality(m_mesh.elements[e].kind, m_mesh.relative_points(m_mesh.elements[e]));
  }

  // The cost of an element, which may be new: flips add elements.
  double known_cost(Element_index e)
  {
    if(e >= m_costs.size())
      m_costs.resize(m_mesh.elements.size(), -1);
    if(m_costs[e] < 0)
      m_costs[e] = cost(e);
    return m_costs[e];
  }

  // The attraction of a vertex; the weight is 0 if there is none.
  Attraction attraction(Vertex_index v) const
  {
    return v < m_attraction_of.size() && m_attraction_of[v] != 0 ? m_attractions[m_attraction_of[v] - 1]
                                                                 : Attraction();
  }

  double attraction_energy(Vertex_index v) const
  {
    const Attraction a = attraction(v);
    const Vec3 d = m_mesh.points[v] - a.place;
    return a.weight * dot(d, d);
  }

  // The length of the shortest edge of elements around a vertex that ends there.
  double shortest_edge(Vertex_index v) const
  {
    double shortest = infinity; // squared
    for(Element_index e : m_mesh.incident[v])
      for(Vertex_index u : m_mesh.elements[e])
        if(u != v) {
          const Vec3 d = m_mesh.points[u] - m_mesh.points[v];
          shortest = (std::min)(shortest, dot(d, d));
        }
    return std::sqrt(shortest);
  }

  bool improve(Vertex_index v)
  {
    if(m_is_fixed[v])
      return false;
    const bool slides = m_mesh.is_on_boundary(v) && !m_may_leave_surface[v];
    const Attraction a = attraction(v);
    double worst = 0;
    for(Element_index e : m_mesh.incident[v])
      worst = (std::max)(worst, known_cost(e));
    const double stays = slides ? m_sliding_threshold : m_is_inside[v] ? m_good_enough_inside : 1;
    if(a.weight == 0 && worst <= (std::max)(stays, m_good_enough))
      return false;

    const Vec3 old = m_mesh.points[v];
    Vertex_star<Quality> star(m_mesh, m_quality, v);
    Vec3 gradient = (2 * a.weight) * (old - a.place);
    const double sum = attraction_energy(v) + star.energy(m_power, gradient), slope = norm(gradient);
    if(!(slope > 0 && slope < infinity))
      return false;
    if(m_radii[v] == 0)
      m_radii[v] = m_first_step * shortest_edge(v);
    if(slides)
      m_radii[v] = (std::min)(m_radii[v], longest_slide * shortest_edge(v));
    for(double radius = m_radii[v]; radius > smallest_step * m_radii[v]; radius *= shrinkage) {
      Vec3 p = old - (radius / slope) * gradient;
      if(slides) {
        p = m_project(p, old, m_mesh.strata[v]);
        if(!m_project.is_reached(p, m_mesh.strata[v]))
          continue;
      }
      m_mesh.points[v] = p;
      const double now = star.energy_at(p, m_power, attraction_energy(v), sum, (std::max)(m_bound, worst));
      if(now < sum && star.is_positive()) {
        star.for_each_cost([this](Element_index e, double cost) { m_costs[e] = cost; });
        m_radii[v] = radius == m_radii[v] ? m_growth * radius : radius;
        if(sum - now > notable_gain * sum)
          activate_around(v);
        return true;
      }
    }
    m_mesh.points[v] = old;
    m_radii[v] *= 10 * smallest_step;
    return false;
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_VERTEX_OPTIMIZER_H
