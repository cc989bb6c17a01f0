// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The optimization as a whole: the boundary arrives on the surface, then moves and flips alternate.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_SURFACE_OPTIMIZER_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_SURFACE_OPTIMIZER_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Concurrency.h>
#include <CGAL/Mixed_mesh_3/internal/base/Core_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Optimization_effort.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Working_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/bisect_boundary_edges.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/feature_paths.h>
#include <CGAL/Mixed_mesh_3/internal/moves/flips.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/merge_boundary_vertices.h>
#include <CGAL/Mixed_mesh_3/internal/surface/self_intersections.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Strata.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Surface_projection.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/surface_attraction.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/surface_targets.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Vertex_optimizer.h>
#include <CGAL/Mixed_mesh_optimization_criteria_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The quality bound of the criteria, a little less: a cost within it in doubles is within the bound exactly.
/// The relative error of the cost of an element near to the default bound is some 1e-13.
inline double bound_for_doubles(const Mixed_mesh_optimization_criteria_3& criteria)
{
  return (1 - 1e-10) * criteria.quality_bound();
}

/*!
Interfaces between subdomains are brought onto their surfaces like the boundary.

\tparam Quality a model of `MixedMeshQuality_3`
*/
template <class Quality>
class Surface_optimizer
{
  using Project = Surface_projection;
  using Moves = Vertex_optimizer<Quality, Project>;
  using Criteria = Mixed_mesh_optimization_criteria_3;
  using Attraction_ = Surface_attraction<Project>;

  Core_mesh& m_mesh;
  const Any_surface& m_domain;
  const Mixed_mesh_optimization_criteria_3 m_criteria;
  const Quality m_quality;
  Strata m_strata;
  Project m_project;
  Interface_faces m_boundary; // interfaces, too
  Working_mesh m_working;
  const Optimization_effort m_effort;
  Moves m_moves;
  const std::map<Subdomain_index, double> m_mean_edge_lengths;
  const Surface_tolerances m_tolerances;
  const std::vector<Surface_sample> m_samples;
  Attraction_ m_attraction;
  const Sharp_features* m_features = nullptr;
  std::vector<std::pair<Vertex_index, Vec3>> m_travelers; // not on the surface yet, with their targets
  std::vector<std::uint8_t> m_is_arrived;
  // Where no faces cut each other: at the start, then the last time that was seen; and what was on the
  // surface. Of new vertices, between those of the edge.
  std::vector<Vec3> m_simple_points;
  std::vector<std::uint8_t> m_simple_is_arrived;
  std::vector<std::uint8_t> m_is_held;
  std::vector<Vec3> m_feature_places; // where vertices start to look for their targets, if there are features
  bool m_only_arrives = false;
  double m_final_bound = std::numeric_limits<double>::infinity();
  std::vector<Vertex_index> m_crossing; // in the end
  Mixed_mesh_optimization_result_3 m_result;

  // Costs are ratios, 1 for the ideal element: none of these numbers has a unit. They decide how soon and how
  // far bad elements are tolerated, never whether a mesh is valid: that each move proves. While the boundary
  // arrives, elements may become that bad; in each round more, as what does not go gently shall go
  // nevertheless: from 4, 15 rounds lead to 100. A smaller limit leaves more vertices off the surface, a
  // larger one worse elements. The quality bound of the criteria is above all of them.
  static constexpr double acceptable_at_first = 4, acceptable_growth = 1.25, acceptable_at_most = 100,
                          acceptable_late = 10;
  static constexpr int rounds_for_features = 25; // of the arrival
  static constexpr int arrival_rounds = 40, arrival_sweeps = 2, rounds_until_new_target = 8,
                       rounds_until_check = 2, return_rounds = 8;
  static constexpr int retreat_rounds = 24;
  // Of the boundary vertices: if more have not arrived then, what draws the others would be in their way, and
  // take most of the time.
  static constexpr double share_left_behind = 0.02;
  // Of the boundary vertices: where faces of more of them cut each other after the arrival (four surfaces
  // of CGAL's demos, 10 % and more), the run within the bound was better, and a third of the time.
  static constexpr double hopeless_share = 0.07;
  // Of mending: rounds with all on the surface, then others. The costs are raised to a power at which only
  // the worst elements count. A mesh with a larger share of vertices of such elements is not worth it.
  static constexpr int mending_rounds_on_surface = 6, mending_rounds = 24, rounds_until_flips = 3;
  static constexpr int mending_rounds_of_features = 6; // once vertices may leave sharp edges
  static constexpr double mending_power = 16, mending_goal = 0.8, worth_mending = 0.1,
                          worth_mending_features = 0.3;
  // Once the boundary has arrived, nothing gets worse than that, for the sake of the tolerance for example.
  static constexpr double acceptable_in_the_end = 3;
  static constexpr double retreat_cost = 1000;
  // Of merging: where it makes elements so many times worse than the bound, nothing would mend them.
  static constexpr int merging_rounds = 24;
  static constexpr double worth_merging = 100;

  // Of flips, at the fourth power and at the eighth.
  static constexpr double worth_flipping[2] = {1.2, 1.4};
  static constexpr double share_of_first_power = 0.6;
  // No half of a bisected tetrahedron may cost more. And how many edges are bisected in the region, times the
  // number of vertices to the power of 2/3, like that of all vertices on the surface: 110 of 2,000, 320 of
  // 10,000.
  static constexpr double worst_half = 3.2, bisections_in_region = 0.7;
  // Of the volume of a subdomain within, times the number of vertices to the power of 2/3: 3.5 % with 2,000
  // vertices, 1.2 % with 10,000.
  static constexpr double tolerated_loss = 5.5;

public:
  Surface_optimizer(Core_mesh& mesh, const Any_surface& domain,
                    const Mixed_mesh_optimization_criteria_3& criteria, const Quality& quality)
    : m_mesh(mesh), m_domain(domain), m_criteria(criteria), m_quality(quality), m_strata(domain),
      m_project(domain, m_strata), m_boundary(m_strata.sorted_faces(mesh)),
      m_working(mesh, m_strata.of_vertices(mesh.number_of_vertices(), m_boundary)),
      m_effort(m_working.points.size()),
      m_moves(m_working, m_quality, m_project, criteria.sliding_threshold(), bound_for_doubles(criteria)),
      m_mean_edge_lengths(mean_edge_lengths()), m_tolerances(tolerances()), m_samples(surface_samples()),
      m_attraction(m_working, m_project, m_samples, Concurrency::number_of_threads(criteria)),
      m_is_arrived(m_working.points.size(), 0), m_simple_points(m_working.points),
      m_simple_is_arrived(m_working.points.size(), 0), m_is_held(m_working.points.size(), 0)
  {
    attract_boundary();
    m_moves.set_notable_gain(m_effort.notable_gain);
    m_moves.set_steps(m_effort.first_step, m_effort.step_growth);
    if(m_effort.samples_coarsely)
      m_attraction.sample_coarsely();
    if(m_effort.moves_by_colors)
      m_moves.use_colors(Concurrency::number_of_threads(criteria));
    if(m_effort.layers > 0)
      m_moves.set_good_enough_inside(acceptable_in_the_end, m_effort.layers);
  }

  Surface_optimizer(const Surface_optimizer&) = delete; // members refer to each other
  Surface_optimizer& operator=(const Surface_optimizer&) = delete;

  /// Boundary vertices that stay where they are, for each vertex whether it does.
  void hold(const std::vector<std::uint8_t>& is_held)
  {
    std::copy(is_held.begin(), is_held.end(), m_is_held.begin());
  }

  /// Paths of the boundary's edges are to be on sharp edges of the surface. To be kept by the caller.
  void follow(const Sharp_features& features)
  {
    m_features = features.empty() ? nullptr : &features;
    m_project.set_features(features);
  }

  /// Boundary vertices are not drawn to places that are too far, which are measured only; edges are bisected
  /// late.
  void only_arrive() { m_only_arrives = true; }
  /// So it is by itself where much of the boundary does not arrive, or cuts itself.
  bool has_only_arrived() const { return m_only_arrives; }

  /// On the way, elements may get worse than that, but in the end they are mended, as far as possible:
  /// boundary vertices leave the surface for it.
  void finish_within(double cost) { m_final_bound = cost; }

  Mixed_mesh_optimization_result_3 operator()(const std::function<bool()>& go_on)
  {
    using Status = Mixed_mesh_optimization_status;
    if(m_features)
      lay_feature_paths();
    bool is_stopped = !arrive(go_on);
    if(!is_stopped) {
      const double crossing = double(remember_if_simple()),
                   boundary = double(m_result.number_of_boundary_vertices);
      if(crossing > hopeless_share * boundary && m_final_bound < std::numeric_limits<double>::infinity())
        return give_up();
      m_only_arrives = m_only_arrives || double(m_travelers.size()) > share_left_behind * boundary;
      is_stopped = !alternate(go_on);
    }
    retreat_from_self_intersections();
    if(!is_stopped && m_crossing.empty()) {
      if(mend())
        retreat_from_self_intersections();
      if(m_crossing.empty())
        return_to_surface();
      if(m_crossing.empty() && m_criteria.flips() && !m_domain.has_sheets())
        is_stopped = !merge_left_behind(go_on);
    }
    if(m_criteria.tolerance() > 0) {
      m_attraction.measure();
      m_result.largest_distance = m_attraction.largest_distance();
    }
    if(m_features)
      measure_features();
    m_working.store(m_mesh);
    const bool is_fitted = m_result.number_of_arrived_vertices == m_result.number_of_boundary_vertices
                           && m_result.is_boundary_simple;
    m_result.status = is_stopped                                           ? Status::STOPPED
                      : !is_fitted                                         ? Status::NOT_ALL_ARRIVED
                      : m_result.largest_distance > m_criteria.tolerance() ? Status::TOLERANCE_NOT_REACHED
                                                                           : Status::SUCCESS;
    return m_result;
  }

  /// Those of boundary faces that cut each other in the end.
  const std::vector<Vertex_index>& crossing_vertices() const { return m_crossing; }

private:
  Subdomain_index first_subdomain(Stratum of_face) const { return m_strata.interfaces(of_face)[0].first; }

  void attract_boundary()
  {
    m_attraction.set_boundary(without_sheets(m_boundary),
                              [this](Stratum s) { return m_tolerances(first_subdomain(s)); });
  }

  // What is far from a surface does not draw them.
  Interface_faces without_sheets(const Interface_faces& all) const
  {
    if(!m_domain.has_sheets())
      return all;
    Interface_faces rest;
    for(std::size_t f = 0; f < all.faces.size(); ++f)
      if(!m_strata.is_on_sheet(all.strata[f])) {
        rest.faces.push_back(all.faces[f]);
        rest.strata.push_back(all.strata[f]);
      }
    return rest;
  }

  // Of the edges of interfaces, by the first subdomain.
  std::map<Subdomain_index, double> mean_edge_lengths() const
  {
    std::map<Subdomain_index, std::pair<double, std::size_t>> edges; // sum of lengths, number
    for(std::size_t f = 0; f < m_boundary.faces.size(); ++f) {
      const Face_vertices& v = m_boundary.faces[f].vertices();
      auto& [sum, number] = edges[first_subdomain(m_boundary.strata[f])];
      for(int i = 0; i < v.size(); ++i, ++number)
        sum += norm(m_working.points[v[i]] - m_working.points[v[(i + 1) % v.size()]]);
    }
    std::map<Subdomain_index, double> means;
    for(const auto& [index, sum] : edges)
      means[index] = sum.first / double(sum.second);
    return means;
  }

  // At the start; 0 where there is none.
  double mean_edge_length(Subdomain_index first) const
  {
    const auto found = m_mean_edge_lengths.find(first);
    return found == m_mean_edge_lengths.end() ? 0 : found->second;
  }

  // What is nearer than a tenth of an edge is the curvature of the surface: no sliding brings it nearer.
  Surface_tolerances tolerances() const
  {
    Surface_tolerances t(m_domain, m_criteria.tolerance(), m_working.points.size());
    t.enlarge([this](Subdomain_index first) { return 0.1 * mean_edge_length(first); });
    return t;
  }

  // Much closer ones than the boundary's vertices could not draw these to different places.
  std::vector<Surface_sample> surface_samples() const
  {
    if(!(m_criteria.tolerance() > 0))
      return {};
    return m_tolerances.samples(m_domain,
                                [this](Subdomain_index first) { return mean_edge_length(first) / 6; });
  }

  void lay_feature_paths()
  {
    const Surface_targets targets = surface_targets(m_boundary.faces, m_working.points, m_project,
                                                    m_working.strata);
    m_feature_places = m_working.points;
    for(std::size_t i = 0; i < targets.vertices.size(); ++i)
      m_feature_places[targets.vertices[i]] = targets.positions[i];
    Feature_paths paths(m_working, m_quality, *m_features, m_boundary, m_feature_places, m_is_held,
                        (std::min)(worst_half, bound_for_doubles(m_criteria)),
                        m_criteria.number_of_bisections());
    paths();
    m_feature_places = paths.places();
    for(Vertex_index v = Vertex_index(m_simple_points.size()); v < m_working.points.size(); ++v)
      m_simple_points.push_back(m_working.points[v]);
    m_result.number_of_bisections += paths.bisected().size();
    m_simple_is_arrived.resize(m_working.points.size(), 0);
    m_is_arrived.resize(m_working.points.size(), 0);
    m_is_held.resize(m_working.points.size(), 0);
    m_moves.add_vertices();
    for(Vertex_index v = Vertex_index(m_working.points.size() - paths.bisected().size());
        v < m_working.points.size(); ++v)
      m_moves.fix(v);
    m_boundary = m_working.interface_faces(m_strata);
    attract_boundary();
  }

  // What can not get there shall be on the surface at least; and what is there gives way at last to what can
  // not get to the surface beside it.
  void give_up_features(bool beside)
  {
    for(const auto& [v, target] : m_travelers)
      if(m_working.strata[v] >= first_sharp_stratum)
        leave_feature(v);
      else if(beside)
        for(Element_index e : m_working.incident[v])
          for(Vertex_index u : m_working.elements[e])
            if(m_working.strata[u] >= first_sharp_stratum)
              leave_feature(u);
    choose_new_targets();
  }

  void leave_feature(Vertex_index v)
  {
    m_working.strata[v] = boundary_stratum;
    for(auto e = m_working.sharp_edges.begin(); e != m_working.sharp_edges.end();)
      e = e->first.first == v || e->first.second == v ? m_working.sharp_edges.erase(e) : std::next(e);
  }

  // Along each edge that is to be sharp: how much of the polyline between its ends is near to it.
  void measure_features()
  {
    constexpr int samples = 16;
    constexpr double near_enough = 0.05; // in lengths of the edge
    const auto& polylines = m_features->polylines();
    const auto is_there = [&](Vertex_index v) { return v >= m_is_arrived.size() || m_is_arrived[v]; };
    m_result.length_of_sharp_edges = m_features->length();
    m_result.length_of_sharp_edges_kept = 0;
    for(const auto& [e, stratum] : m_working.sharp_edges) {
      const auto [a, b] = e;
      const Feature_polyline& polyline = polylines[stratum - first_sharp_stratum];
      const Vec3 &p = m_working.points[a], &q = m_working.points[b], along = q - p;
      if(!is_there(a) || !is_there(b))
        continue;
      double first = position_on(a, polyline), last = position_on(b, polyline);
      for(int i = 0; i < samples; ++i) {
        const Vec3 s = polyline.at(first + (i + 0.5) / samples * (last - first)) - p;
        const double share = (std::min)((std::max)(dot(s, along) / dot(along, along), 0.), 1.);
        if(norm(s - share * along) <= near_enough * norm(along))
          m_result.length_of_sharp_edges_kept += std::abs(last - first) / samples;
      }
    }
    m_result.number_of_corners = m_result.number_of_corners_kept = 0;
    for(std::size_t c = 0; c < m_features->corners().size(); ++c)
      m_result.number_of_corners += m_features->is_real_corner(c);
    for(Vertex_index v = 0; v < m_working.points.size(); ++v)
      if(m_working.strata[v] >= first_sharp_stratum + polylines.size() && is_there(v))
        m_result.number_of_corners_kept += m_features->is_real_corner(
          m_working.strata[v] - first_sharp_stratum - polylines.size());
  }

  // How far along a vertex is that is on it.
  double position_on(Vertex_index v, const Feature_polyline& polyline) const
  {
    const std::size_t corner = m_working.strata[v] - first_sharp_stratum - m_features->polylines().size();
    return m_working.strata[v] < first_sharp_stratum + m_features->polylines().size()
             ? polyline.closest(m_working.points[v]).length
           : corner == polyline.corners[0] ? 0
                                           : polyline.length();
  }

  // Each boundary vertex goes to its target, all the way or part of it, as far as validity and quality
  // allow; then the inner vertices give way, and the next round follows.
  bool arrive(const std::function<bool()>& go_on)
  {
    const Surface_targets targets = surface_targets(m_boundary.faces, m_working.points, m_project,
                                                    m_working.strata, m_feature_places);
    m_result.number_of_boundary_vertices = targets.vertices.size();
    for(std::size_t i = 0; i < targets.vertices.size(); ++i) {
      if(m_is_held[targets.vertices[i]])
        continue;
      // what is on the surface stays, even if its faces are folded
      const Vec3& p = m_working.points[targets.vertices[i]];
      const Vec3 q = m_project(p, targets.positions[i], m_working.strata[targets.vertices[i]]);
      const bool is_there = norm(q - p) <= 1e-14 * (norm(p) + norm(targets.positions[i] - p));
      m_travelers.emplace_back(targets.vertices[i], is_there ? p : targets.positions[i]);
    }
    // In small steps that are checked: vertices whose faces would cut others stay behind. Not without a
    // bound: where elements may get that bad, too many would.
    const bool has_bound = (std::min)(m_final_bound, m_criteria.quality_bound())
                           < std::numeric_limits<double>::infinity();
    const bool is_careful = m_only_arrives && has_bound && find_crossing().empty();
    State simple = state();
    double acceptable = acceptable_at_first;
    for(int round = 0; round < arrival_rounds && !m_travelers.empty(); ++round) {
      if(!go_on())
        return false;
      advance(acceptable);
      m_moves.run(4, m_effort.good_enough_to_arrive, arrival_sweeps);
      if(is_careful && (round % rounds_until_check == rounds_until_check - 1 || m_travelers.empty())) {
        const std::vector<Vertex_index> crossing = find_crossing();
        if(!crossing.empty()) {
          restore(simple);
          leave_behind(crossing);
        }
        simple = state();
      }
      acceptable = (std::min)(acceptable_growth * acceptable, acceptable_at_most);
      if(round % rounds_until_new_target == rounds_until_new_target - 1)
        choose_new_targets();
      if(m_features && round >= rounds_for_features && (round - rounds_for_features) % 3 == 0)
        give_up_features(round > rounds_for_features);
    }
    return true;
  }

  struct State
  {
    std::vector<Vec3> points;
    std::vector<std::uint8_t> is_arrived;
    std::vector<std::pair<Vertex_index, Vec3>> travelers;
    std::size_t number_of_arrived_vertices;
    typename Moves::Freedom freedom;
  };

  State state() const
  {
    return {m_working.points, m_is_arrived, m_travelers, m_result.number_of_arrived_vertices,
            m_moves.freedom()};
  }

  // \pre no elements were changed since
  void restore(const State& s)
  {
    m_working.points = s.points;
    m_is_arrived = s.is_arrived;
    m_travelers = s.travelers;
    m_result.number_of_arrived_vertices = s.number_of_arrived_vertices;
    m_moves.set_freedom(s.freedom);
    m_moves.forget_costs();
    m_moves.activate_all();
  }

  std::vector<Vertex_index> find_crossing() const
  {
    // interfaces can not cut anything where no element is inverted
    std::vector<Face> faces;
    for(std::size_t f = 0; f < m_boundary.faces.size(); ++f)
      if(m_strata.is_on_boundary(m_boundary.strata[f]))
        faces.push_back(m_boundary.faces[f]);
    return vertices_of_self_intersections(m_working.points, faces);
  }

  // They stay where they are.
  void leave_behind(const std::vector<Vertex_index>& vertices)
  {
    for(Vertex_index v : vertices)
      m_moves.fix(v);
    m_travelers.erase(std::remove_if(m_travelers.begin(), m_travelers.end(),
                                     [&](const auto& t) {
                                       return std::binary_search(vertices.begin(), vertices.end(), t.first);
                                     }),
                      m_travelers.end());
  }

  // What has stayed off the surface goes there at last, where its faces cut no others then.
  void return_to_surface()
  {
    m_moves.set_bound((std::min)(m_final_bound, bound_for_doubles(m_criteria)));
    std::vector<Vertex_index> off = left_behind();
    m_travelers.clear();
    for(int round = 0; round < return_rounds && !off.empty(); ++round) {
      const State simple = state();
      for(Vertex_index v : off)
        move_to(v, m_project(m_working.points[v], m_working.strata[v]), acceptable_at_first);
      if(m_result.number_of_arrived_vertices == simple.number_of_arrived_vertices) {
        restore(simple);
        return;
      }
      const std::vector<Vertex_index> crossing = find_crossing();
      const auto is_crossing = [&](Vertex_index v) {
        return std::binary_search(crossing.begin(), crossing.end(), v);
      };
      if(!crossing.empty()) {
        restore(simple);
        if(std::none_of(off.begin(), off.end(), is_crossing))
          return;
      }
      off.erase(std::remove_if(off.begin(), off.end(),
                               [&](Vertex_index v) { return m_is_arrived[v] || is_crossing(v); }),
                off.end());
    }
  }

  std::vector<Vertex_index> left_behind() const
  {
    std::vector<Vertex_index> off;
    for(Vertex_index v = 0; v < m_working.points.size(); ++v)
      if(m_working.is_on_boundary(v) && !m_is_arrived[v])
        off.push_back(v);
    return off;
  }

  // What can not get to the surface at all is merged with what is beside it. If elements are above the bound
  // then, or faces cut each other, all goes back, and others are tried.
  bool merge_left_behind(const std::function<bool()>& go_on)
  {
    const double bound = (std::min)(m_final_bound, bound_for_doubles(m_criteria));
    Boundary_vertex_merger merger(m_working, m_quality, worth_merging * bound);
    Tetrahedron_flipper<Quality> flipper(m_working, m_quality, bound);
    std::set<Working_mesh::Edge>
      failed; // from a vertex to the one it was merged with, or to itself if it moved
    m_moves.attract({});
    m_moves.set_bound(bound);
    if(!m_moves.vertices_above(bound).empty())
      return true; // they would not get better
    for(int round = 0; round < merging_rounds && !left_behind().empty(); ++round) {
      if(!go_on()) {
        attract_boundary();
        return false;
      }
      const State simple = state();
      const Working_mesh working = m_working;
      const Mixed_mesh_optimization_result_3 result = m_result;
      const std::vector<Working_mesh::Edge> merged = merge_with_neighbors(merger, failed);
      if(merged.empty())
        break;
      for(int i = 0; i < mending_rounds_on_surface; ++i)
        improve_worst(flipper, bound, i);
      const std::vector<Vertex_index> crossing = find_crossing();
      std::vector<Vertex_index> bad = m_moves.vertices_above(bound);
      if(bad.empty() && crossing.empty())
        continue;
      bad.insert(bad.end(), crossing.begin(), crossing.end());
      std::sort(bad.begin(), bad.end());
      const std::size_t before = failed.size();
      for(Vertex_index v : crossing)
        if(!simple.is_arrived[v])
          failed.insert({v, v});
      for(const Working_mesh::Edge& edge : merged)
        if(std::binary_search(bad.begin(), bad.end(), edge.second))
          failed.insert(edge);
      if(failed.size() == before)
        failed.insert(merged.begin(), merged.end());
      m_working = working;
      m_result = result;
      restore(simple);
      m_moves.forget_elements();
      m_boundary = m_working.interface_faces(m_strata);
    }
    attract_boundary();
    return true;
  }

  // Those that can not become travelers.
  std::vector<Working_mesh::Edge> merge_with_neighbors(Boundary_vertex_merger<Quality>& merger,
                                                       const std::set<Working_mesh::Edge>& failed)
  {
    std::vector<Working_mesh::Edge> merged;
    m_travelers.clear();
    for(Vertex_index v : left_behind()) {
      if(v < m_is_held.size() && m_is_held[v])
        continue;
      const Vec3 place = m_project(m_working.points[v], m_working.strata[v]);
      const Vertex_index w = merger(v, place, [&](Vertex_index u) { return failed.count({v, u}) == 0; });
      if(w != no_vertex) {
        leave_feature(v);
        m_working.strata[v] = free_stratum;
        m_moves.fix(v);
        m_moves.activate_around(w);
        --m_result.number_of_boundary_vertices;
        ++m_result.number_of_merged_vertices;
        merged.emplace_back(v, w);
      } else if(failed.count({v, v}) == 0) {
        m_travelers.emplace_back(v, place);
      }
    }
    if(!merged.empty())
      m_boundary = m_working.interface_faces(m_strata);
    return merged;
  }

  // \return the number of vertices of faces that cut each other
  std::size_t remember_if_simple()
  {
    const std::size_t crossing = find_crossing().size();
    if(crossing == 0) {
      m_simple_points = m_working.points;
      m_simple_is_arrived = m_is_arrived;
    }
    return crossing;
  }

  // Where the surface is too fine for the mesh in so many places, only small steps lead to a boundary that
  // does not cut itself. The mesh stays what it was.
  Mixed_mesh_optimization_result_3 give_up()
  {
    m_only_arrives = true;
    m_result.is_boundary_simple = false;
    m_result.status = Mixed_mesh_optimization_status::NOT_ALL_ARRIVED;
    return m_result;
  }

  // Where the surface comes near to itself, faces between its vertices may meet. Their vertices go back
  // towards where no faces met, on the surface if they were there already, until none meet.
  void retreat_from_self_intersections()
  {
    m_crossing = find_crossing();
    for(int round = 0; round < retreat_rounds && !m_crossing.empty(); ++round) {
      const double share = round < retreat_rounds / 2 ? 0.25 : 1;
      for(Vertex_index v : m_crossing) {
        const bool stays = m_is_arrived[v] && m_simple_is_arrived[v];
        const Vec3 p = m_working.points[v], back = p + share * (m_simple_points[v] - p);
        if(m_moves.try_move(v,
                            share == 1 ? m_simple_points[v]
                            : stays    ? m_project(back, p, m_working.strata[v])
                                       : back,
                            retreat_cost)) {
          m_moves.fix(v);
          if(!stays) {
            m_result.number_of_arrived_vertices -= m_is_arrived[v];
            m_is_arrived[v] = 0;
          }
        }
      }
      m_moves.run(8, m_effort.good_enough[1], arrival_sweeps);
      m_crossing = find_crossing();
    }
    m_result.is_boundary_simple = m_crossing.empty();
  }

  // Elements above the final bound get better at the cost of those around them; where that does not help,
  // boundary vertices leave the surface, and come back where it has helped.
  // \return whether a vertex was moved
  bool mend()
  {
    std::vector<Vertex_index> bad = m_moves.vertices_above(m_final_bound);
    const double worth = m_features ? worth_mending_features : worth_mending;
    if(bad.empty() || double(bad.size()) > worth * double(m_working.points.size()))
      return false;
    Tetrahedron_flipper<Quality> flipper(m_working, m_quality, m_final_bound);
    m_moves.attract({});
    m_moves.set_bound(m_final_bound);
    const int more = m_features ? mending_rounds_of_features : 0;
    for(int round = 0; round < mending_rounds + more && !bad.empty(); ++round) {
      for(Vertex_index v : bad) {
        if(round >= mending_rounds_on_surface && m_working.strata[v] >= first_sharp_stratum)
          leave_feature(v);
        else if(round >= mending_rounds_on_surface + more && m_working.is_on_boundary(v))
          leave_surface(v);
        m_moves.activate_around(v);
      }
      improve_worst(flipper, m_final_bound, round);
      bad = m_moves.vertices_above(m_final_bound);
    }
    return true;
  }

  // A round of steps at a power at which the worst elements count, below the bound.
  void improve_worst(Tetrahedron_flipper<Quality>& flipper, double bound, int round)
  {
    if(m_criteria.flips() && round % rounds_until_flips == 0)
      m_result.number_of_flips += flip(flipper, mending_power, mending_goal * bound);
    m_moves.reset_steps();
    m_moves.run(mending_power, mending_goal * bound, arrival_sweeps);
    choose_new_targets();
    advance(bound);
  }

  void leave_surface(Vertex_index v)
  {
    if(m_is_arrived[v]) {
      m_is_arrived[v] = 0;
      --m_result.number_of_arrived_vertices;
      m_travelers.emplace_back(v, m_working.points[v]);
    }
    m_moves.loosen(v);
  }

  // The boundary vertices that are not on the surface go on.
  void advance(double acceptable)
  {
    m_travelers.erase(std::remove_if(m_travelers.begin(), m_travelers.end(),
                                     [&](const auto& t) { return move_to(t.first, t.second, acceptable); }),
                      m_travelers.end());
  }

  // What can not get to its target may get to the surface where it has come near to it.
  void choose_new_targets()
  {
    for(auto& [v, target] : m_travelers)
      target = m_project(m_working.points[v], target, m_working.strata[v]);
  }

  bool move_to(Vertex_index v, const Vec3& target, double acceptable)
  {
    if(m_moves.try_move(v, target, acceptable)) {
      if(!m_project.is_reached(target, m_working.strata[v]))
        return false;
      m_moves.release(v);
      m_is_arrived[v] = 1;
      ++m_result.number_of_arrived_vertices;
      return true;
    }
    const Vec3 p = m_working.points[v];
    for(double share : {0.5, 0.25, 0.1})
      if(m_moves.try_move(v, p + share * (target - p), acceptable))
        break;
    return false;
  }

  std::size_t flip(Tetrahedron_flipper<Quality>& flipper, double power, double worst)
  {
    const std::size_t removals = flipper.number_of_removals();
    const std::size_t flips = flipper.run(power, worst, [&](Vertex_index v) { m_moves.activate(v); });
    if(flipper.number_of_removals() != removals) {
      m_boundary = m_working.interface_faces(m_strata);
      attract_boundary();
    }
    return flips;
  }

  template <class Gain>
  void bisect(std::size_t number, const Gain& gain)
  {
    const auto is_arrived = [&](Vertex_index v) { return v >= m_is_arrived.size() || m_is_arrived[v]; };
    const auto gain_if_arrived = [&](Vertex_index a, Vertex_index b,
                                     const std::array<Vertex_index, 2>& apexes, Stratum stratum) {
      return is_arrived(a) && is_arrived(b) ? gain(a, b, apexes, stratum) : 0.;
    };
    Boundary_bisector bisector(m_working, m_quality, m_project, gain_if_arrived, m_boundary,
                               (std::min)(worst_half, bound_for_doubles(m_criteria)));
    for(const auto& [a, b] : bisector(number)) {
      m_simple_points.push_back(0.5 * (m_simple_points[a] + m_simple_points[b]));
      m_simple_is_arrived.push_back(0);
      ++m_result.number_of_bisections;
      ++m_result.number_of_boundary_vertices;
      ++m_result.number_of_arrived_vertices;
    }
    m_is_arrived.resize(m_working.points.size(), 1);
    m_boundary = m_working.interface_faces(m_strata);
    m_moves.add_vertices();
    attract_boundary();
  }

  // From the middle of an edge to the surface.
  Vec3 way_to_surface(Vertex_index a, Vertex_index b, Stratum stratum) const
  {
    const Vec3 middle = 0.5 * (m_working.points[a] + m_working.points[b]);
    return (m_working.strata[a] == stratum ? m_project(middle, m_working.points[a], stratum)
                                           : m_project(middle, stratum))
           - middle;
  }

  // Of the two triangles beside an edge.
  double doubled_area_beside(Vertex_index a, Vertex_index b, const std::array<Vertex_index, 2>& apexes) const
  {
    const std::vector<Vec3>& p = m_working.points;
    return norm(cross(p[b] - p[a], p[apexes[0]] - p[a])) + norm(cross(p[b] - p[a], p[apexes[1]] - p[a]));
  }

  // What is small loses most: between the faces of a subdomain within and its surface there is as much,
  // nearly, as their edges gain by bisection, each by the two tetrahedra on the faces beside it. The
  // largest gains until all but a tolerated share of the volume is left.
  void bisect_parts(std::size_t most)
  {
    std::map<Subdomain_index, double> tolerated;
    const double share = tolerated_loss * std::pow(double(m_working.points.size()), -2. / 3);
    for(const Working_mesh::Element& element : m_working.elements)
      if(!element.is_removed)
        tolerated[element.attributes.subdomain_index] += share
                                                         * volume(element.kind,
                                                                  m_working.relative_points(element));
    if(tolerated.size() < 2)
      return;
    tolerated.erase(m_domain.subdomain_indices().back());
    const auto gain = [&](Vertex_index a, Vertex_index b, Vertex_index apex, Stratum stratum) {
      const std::vector<Vec3>& p = m_working.points;
      return dot(way_to_surface(a, b, stratum), cross(p[b] - p[a], p[apex] - p[a])) / 6;
    };
    std::map<Subdomain_index, std::map<std::pair<Vertex_index, Vertex_index>, double>> gains;
    for(std::size_t f = 0; f < m_boundary.faces.size(); ++f) {
      const Face_vertices& v = m_boundary.faces[f].vertices();
      const Subdomain_index first = first_subdomain(m_boundary.strata[f]);
      if(v.size() == 3 && tolerated.count(first) > 0)
        for(int i = 0; i < 3; ++i)
          gains[first][std::minmax(v[i], v[(i + 1) % 3])] += gain(v[i], v[(i + 1) % 3], v[(i + 2) % 3],
                                                                  m_boundary.strata[f]);
    }
    for(const auto& [subdomain, of_edges] : gains) {
      const Subdomain_index index = subdomain; // which a lambda may capture
      double loss = -tolerated.at(index);
      std::vector<double> largest;
      for(const auto& [edge, g] : of_edges) {
        loss += g;
        largest.push_back(g);
      }
      std::sort(largest.begin(), largest.end(), std::greater<double>());
      std::size_t number = 0;
      for(; number < largest.size() && largest[number] > 0 && loss > 0; ++number)
        loss -= largest[number];
      bisect((std::min)(number, most - m_result.number_of_bisections),
             [&](Vertex_index a, Vertex_index b, const std::array<Vertex_index, 2>& apexes, Stratum stratum) {
               return first_subdomain(stratum) == index
                        ? norm(way_to_surface(a, b, stratum)) * doubled_area_beside(a, b, apexes)
                        : 0.;
             });
    }
  }

  // At small parts, then in the region the longest edges, then those that are far from the surface.
  void bisect()
  {
    const std::size_t all = m_criteria.number_of_bisections(),
                      early = all - std::size_t(m_effort.share_of_late_bisections * double(all)),
                      in_region = std::size_t(bisections_in_region
                                              * std::pow(double(m_working.points.size()), 2. / 3));
    bisect_parts(all);
    const auto rest = [&] { return early - (std::min)(early, m_result.number_of_bisections); };
    if(m_features)
      bisect_sharp_edges(rest());
    bisect((std::min)(rest(), in_region), [&](Vertex_index a, Vertex_index b, const auto&, Stratum) {
      return m_working.is_edge_in_region(a, b) ? norm(m_working.points[a] - m_working.points[b]) : 0;
    });
    bisect_far(rest(), 2);
  }

  // Those farthest from their polylines, in lengths of edges.
  void bisect_sharp_edges(std::size_t number)
  {
    constexpr double near_enough = 0.04;
    bisect(number, [&](Vertex_index a, Vertex_index b, const auto&, Stratum) {
      const auto sharp = m_working.sharp_edges.find(std::minmax(a, b));
      if(sharp == m_working.sharp_edges.end())
        return 0.;
      const Vec3 &p = m_working.points[a], &q = m_working.points[b], middle = 0.5 * (p + q);
      const double share = norm(m_project(middle, sharp->second) - middle) / norm(q - p);
      return share > near_enough ? share * norm(q - p) : 0;
    });
  }

  // By the area of the faces, and a power of the distance: with 1, it is the volume between that counts, with
  // a high one the largest distance. The smaller a tolerance is, the more it counts.
  void bisect_far(std::size_t number, double power)
  {
    if(number == 0)
      return;
    if(m_only_arrives)
      m_attraction.measure();
    const auto far_edges = m_attraction.far_edges();
    bisect(number,
           [&](Vertex_index a, Vertex_index b, const std::array<Vertex_index, 2>& apexes, Stratum stratum) {
             const auto far = far_edges.find(std::minmax(a, b));
             const double distance = (std::max)(norm(way_to_surface(a, b, stratum)),
                                                far == far_edges.end() ? 0. : far->second);
             return std::pow(distance, power) * m_tolerances.weight(first_subdomain(stratum))
                    * doubled_area_beside(a, b, apexes);
           });
  }

  bool alternate(const std::function<bool()>& go_on)
  {
    const bool has_tolerance = m_criteria.tolerance() > 0 && !m_only_arrives;
    const int rounds = (has_tolerance || m_features ? m_criteria : Criteria(m_criteria).tolerance(0))
                         .number_of_rounds_for(m_working.points.size());
    const int first = int(share_of_first_power * rounds + 0.5);
    const int late = rounds / 4;
    // many short rounds, so that boundary vertices can follow what draws them
    const bool is_patient = rounds > 6;
    const int rounds_to_flip = is_patient ? 3 : 1;
    Tetrahedron_flipper<Quality> flipper(m_working, m_quality, bound_for_doubles(m_criteria));
    m_moves.set_bound((std::min)(acceptable_in_the_end, bound_for_doubles(m_criteria)));
    for(int round = 0; round < rounds; ++round) {
      if(!go_on())
        return false;
      if(has_tolerance && round % rounds_to_flip == rounds_to_flip - 1)
        remember_if_simple();
      const int phase = round < first ? 0 : 1;
      const double power = phase == 0 ? 4 : 8;
      const int sweeps = is_patient ? 3 : m_effort.sweeps[phase];
      if(m_criteria.flips() && round % rounds_to_flip == 0)
        m_result.number_of_flips += flip(flipper, power, worth_flipping[phase]);
      choose_new_targets();
      advance(acceptable_late);
      if(round == 0 || round == first)
        m_moves.activate_all();
      if(has_tolerance) {
        m_attraction.measure();
        m_moves.attract(m_attraction.attractions(phase == 0 ? 1 : 16));
      }
      m_moves.run(power, m_effort.good_enough[phase], sweeps);
      if(round == (m_only_arrives ? first : 0))
        bisect();
      if(round == (m_only_arrives ? first : late)) // for what is far yet
        bisect_far(m_criteria.number_of_bisections() - m_result.number_of_bisections, 4);
      ++m_result.number_of_rounds;
    }
    return true;
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_SURFACE_OPTIMIZER_H
