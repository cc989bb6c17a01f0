// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The state that the passes of the optimization share: the mesh, the attraction of its boundary, and the
// vertices that have arrived.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_FITTING_STATE_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_FITTING_STATE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Concurrency.h>
#include <CGAL/Mixed_mesh_3/internal/base/Core_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Optimization_effort.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Surface_projection.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Surface_tolerances.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Vertex_optimizer.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/bound_for_doubles.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/surface_attraction.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Strata.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Working_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/moves/flips.h>
#include <CGAL/Mixed_mesh_3/internal/surface/Sharp_features.h>
#include <CGAL/Mixed_mesh_3/internal/surface/self_intersections.h>
#include <CGAL/Mixed_mesh_optimization_criteria_3.h>
#include <CGAL/Mixed_mesh_optimization_result_3.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The quality bound of the criteria, for costs in doubles.
inline double bound_for_doubles(const Mixed_mesh_optimization_criteria_3& criteria)
{
  return bound_for_doubles(criteria.quality_bound());
}

/// The liberties that a run of the optimization takes.
struct Fitting_mode
{
  /// Whether every step keeps the quality bound. Otherwise elements may exceed the bound on the way, and are
  /// mended in the end.
  bool keeps_bound = false;
  /// Whether boundary vertices are not drawn to places that are too far, which are only measured; edges are
  /// bisected late.
  bool is_without_attraction = false;
  /// Whether the run ends once it is likely that not all of the boundary will arrive.
  bool needs_all = false;
  /// For an estimate, `Fitting_estimate::number_of_vertices`.
  std::size_t number_of_vertices_estimated = 0;
  /// `Fitting_estimate::leaves_rest`.
  bool leaves_rest = false;
  /// Whether vertices stay on their way to sharp edges, or are merged along these.
  bool keeps_sharp_edges = false;
};

/*!
Vertices of the boundary are *underway* until they have *arrived* on the surface; *held* vertices stay where
they are. Interfaces between subdomains are brought onto their surfaces like the boundary.

The passes are functions of this state. A pass changes elements only by the moves, and calls
`update_boundary()` after it has changed faces of the boundary.

\tparam Quality a model of `MixedMeshQuality_3`
*/
template <class Quality>
struct Fitting_state
{
  using Criteria = With_threads<Mixed_mesh_optimization_criteria_3>;
  using Moves = Vertex_optimizer<Quality, Surface_projection>;
  using Flipper = Tetrahedron_flipper<Quality>;

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  // Largest acceptable cost once the boundary has arrived, for the sake of the tolerance for example. Costs
  // are ratios, 1 for the ideal element: no limit of a cost has a unit. Such limits decide how soon and how
  // far bad elements are tolerated, never whether a mesh is valid: each move proves validity.
  static constexpr double acceptable_final_cost = 3;
  static constexpr int sweeps_after_boundary = 2; // sweeps over inner vertices, after the boundary has moved
  // Largest cost of a half of a bisected tetrahedron. With 1.9, meshes keep 1.5 % less of their sharp edges,
  // and an anchor has an aspect-ratio coefficient of 15; with 6.4, largest distances of nine meshes are 1.17
  // times as large in the median (constants.md).
  static constexpr double largest_cost_of_half = 3.2;

  const Any_surface& domain;
  const Criteria& criteria;
  const Quality& quality;
  Fitting_mode mode;
  Strata strata;
  Surface_projection project;
  Interface_faces boundary; // and of interfaces
  Working_mesh mesh;
  const Optimization_effort effort;
  Moves moves;
  const std::map<Subdomain_index, double> mean_edge_lengths; // of interfaces, by the first subdomain
  const Surface_tolerances tolerances;
  const std::vector<Surface_sample> samples;
  Surface_attraction<Surface_projection> attraction;
  const Sharp_features* features = nullptr;
  std::vector<std::pair<Vertex_index, Vec3>> underway; // vertices with their targets
  std::vector<std::uint8_t> is_arrived;
  std::vector<std::uint8_t> is_held;
  // Positions at which no faces cut each other, at the start or at the last such test, and the vertices that
  // had arrived. New vertices get positions between the ends of their edges.
  std::vector<Vec3> saved_points;
  std::vector<std::uint8_t> saved_is_arrived;
  bool is_careful = false; // at each test, faces that cut each other go back there, as none did at the start
  // Largest cost that an element may have at saved positions: some of the start may be above the bound.
  const double largest_saved_cost;
  std::vector<Vec3> feature_places;      // starts of the search for targets, if there are features
  Self_intersections self_intersections; // of the boundary at the last test
  Mixed_mesh_optimization_result_3 result;

  Fitting_state(const Core_mesh& start, const Any_surface& surface, const Criteria& c, const Quality& q,
                const Fitting_mode& m)
    : domain(surface), criteria(c), quality(q), mode(m), strata(domain), project(domain, strata),
      boundary(strata.sorted_faces(start)),
      mesh(start, strata.of_vertices(start.number_of_vertices(), boundary),
           (std::min)(criteria.number_of_bisections(), start.number_of_vertices())),
      effort(mode.number_of_vertices_estimated > 0 ? mode.number_of_vertices_estimated : mesh.points.size()),
      moves(mesh, quality, project, criteria.sliding_threshold(), intermediate_bound()),
      mean_edge_lengths(measure_edges()), tolerances(enlarged_tolerances()), samples(surface_samples()),
      attraction(mesh, project, samples, criteria.number_of_threads), is_arrived(mesh.points.size(), 0),
      is_held(mesh.points.size(), 0), saved_points(mesh.points), saved_is_arrived(mesh.points.size(), 0),
      largest_saved_cost((std::max)(intermediate_bound(), largest_cost_at_start()))
  {
    attract_boundary();
    moves.set_steps(effort.first_step, effort.step_growth);
    if(effort.samples_coarsely)
      attraction.sample_coarsely();
    moves.use_threads(criteria.number_of_threads);
    if(effort.moves_by_colors)
      moves.use_colors();
    if(effort.layers > 0)
      moves.set_good_enough_inside(acceptable_final_cost, effort.layers);
  }

  Fitting_state(const Fitting_state&) = delete; // members refer to each other
  Fitting_state& operator=(const Fitting_state&) = delete;

  double final_bound() const { return bound_for_doubles(criteria); }
  double intermediate_bound() const { return mode.keeps_bound ? final_bound() : infinity; }
  bool has_bound() const { return criteria.quality_bound() < infinity; }

  Subdomain_index first_subdomain(Stratum of_face) const { return strata.interfaces(of_face)[0].first; }

  /// Mean edge length of the boundary, or of an interface, at the start; 0 where there is none.
  /// \param first the first subdomain of the interface
  double mean_edge_length(Subdomain_index first) const
  {
    const auto found = mean_edge_lengths.find(first);
    return found == mean_edge_lengths.end() ? 0 : found->second;
  }

  /// Updates the boundary after its faces have changed.
  void update_boundary()
  {
    boundary = mesh.interface_faces(strata);
    attract_boundary();
  }

  /// Sets the boundary of the attraction: all distances will be measured again.
  void attract_boundary()
  {
    attraction.set_boundary(without_sheets(), [this](Stratum s) { return tolerances(first_subdomain(s)); });
  }

  /// Makes room for vertices that the mesh has more than before.
  /// \param have_arrived whether the new vertices are on the surface
  void add_vertices(bool have_arrived)
  {
    is_arrived.resize(mesh.points.size(), have_arrived);
    saved_is_arrived.resize(mesh.points.size(), 0);
    is_held.resize(mesh.points.size(), 0);
    moves.add_vertices();
  }

  /// Sends a boundary vertex to its target on the surface.
  void set_underway(Vertex_index v, const Vec3& target)
  {
    moves.fix(v);
    is_arrived[v] = 0;
    underway.emplace_back(v, target);
  }

  /// Moves the boundary vertices that are underway.
  void advance(double acceptable)
  {
    underway.erase(std::remove_if(underway.begin(), underway.end(),
                                  [&](const auto& u) { return move_to(u.first, u.second, acceptable); }),
                   underway.end());
  }

  /// Chooses new targets: a vertex that does not reach its target may reach the surface where it has come
  /// near.
  void choose_new_targets()
  {
    for(auto& [v, target] : underway)
      target = project(mesh.points[v], target, mesh.strata[v]);
  }

  /// Lets a vertex that is at its target move along the surface.
  /// \return whether it is on the surface
  bool note_arrival(Vertex_index v)
  {
    if(!project.is_reached(mesh.points[v], mesh.strata[v]))
      return false;
    moves.release(v);
    is_arrived[v] = 1;
    ++result.number_of_arrived_vertices;
    return true;
  }

  /// Moves a vertex to its target, or a part of the way.
  /// \return whether the vertex has arrived
  bool move_to(Vertex_index v, const Vec3& target, double acceptable)
  {
    if(moves.try_move(v, target, acceptable))
      return note_arrival(v);
    const Vec3 p = mesh.points[v];
    for(double share : {0.5, 0.25, 0.1})
      if(moves.try_move(v, p + share * (target - p), acceptable))
        break;
    return false;
  }

  /// The boundary vertices that have not arrived, underway or not.
  std::vector<Vertex_index> vertices_not_arrived() const
  {
    std::vector<Vertex_index> off;
    for(Vertex_index v = 0; v < mesh.points.size(); ++v)
      if(mesh.is_on_boundary(v) && !is_arrived[v])
        off.push_back(v);
    return off;
  }

  /// Releases a vertex from the sharp edge or corner that it is to be on.
  void leave_feature(Vertex_index v)
  {
    Transaction transaction(mesh);
    transaction.leave_sharp_edges(v, strata.of_subdomains(
                                       features->subdomains(mesh.strata[v] - first_sharp_stratum)));
    transaction.keep();
  }

  std::size_t flip(Flipper& flipper, double power, double worst)
  {
    const std::size_t removals = flipper.number_of_removals();
    const std::size_t flips = flipper.run(power, worst, [&](Vertex_index v) { moves.activate(v); });
    if(flipper.number_of_removals() != removals)
      update_boundary();
    return flips;
  }

  /// The vertices of faces of the boundary that cut each other, ascending.
  std::vector<Vertex_index> crossing_vertices()
  {
    // Interfaces can not cut anything if no element is inverted.
    std::vector<Face> faces;
    for(std::size_t f = 0; f < boundary.faces.size(); ++f)
      if(strata.is_on_boundary(boundary.strata[f]))
        faces.push_back(boundary.faces[f]);
    return self_intersections.vertices(mesh.points, triangles_of_faces(faces), criteria.number_of_threads);
  }

  /// Saves all positions if no faces cut each other. \return the number of vertices of faces that cut
  /// each other
  std::size_t save_points_if_simple()
  {
    const std::size_t crossing = crossing_vertices().size();
    if(crossing == 0)
      save_points();
    return crossing;
  }

  /// Saves all positions. \pre no faces cut each other
  void save_points()
  {
    saved_points = mesh.points;
    saved_is_arrived = is_arrived;
  }

  /// Positions, and the progress that was achieved with them.
  struct Snapshot
  {
    std::vector<Vec3> points;
    std::vector<std::uint8_t> is_arrived;
    std::vector<std::pair<Vertex_index, Vec3>> underway;
    std::size_t number_of_arrived_vertices;
    typename Moves::Freedom freedom;
  };

  Snapshot snapshot() const
  {
    return {mesh.points, is_arrived, underway, result.number_of_arrived_vertices, moves.freedom()};
  }

  /// Restores a snapshot. \pre the elements are those of the snapshot
  void restore(const Snapshot& s)
  {
    mesh.points = s.points;
    is_arrived = s.is_arrived;
    underway = s.underway;
    result.number_of_arrived_vertices = s.number_of_arrived_vertices;
    moves.set_freedom(s.freedom);
    moves.forget_costs();
    moves.activate_all();
  }

private:
  // The faces of the boundary without sheets. Distant places of a surface do not draw sheets.
  Interface_faces without_sheets() const
  {
    if(!domain.has_sheets())
      return boundary;
    Interface_faces rest;
    for(std::size_t f = 0; f < boundary.faces.size(); ++f)
      if(!strata.is_on_sheet(boundary.strata[f])) {
        rest.faces.push_back(boundary.faces[f]);
        rest.strata.push_back(boundary.strata[f]);
      }
    return rest;
  }

  std::map<Subdomain_index, double> measure_edges() const
  {
    std::map<Subdomain_index, std::pair<double, std::size_t>> edges; // sum of lengths, number
    for(std::size_t f = 0; f < boundary.faces.size(); ++f) {
      const Face_vertices& v = boundary.faces[f].vertices();
      auto& [sum, number] = edges[first_subdomain(boundary.strata[f])];
      for(int i = 0; i < v.size(); ++i, ++number)
        sum += norm(mesh.points[v[i]] - mesh.points[v[(i + 1) % v.size()]]);
    }
    std::map<Subdomain_index, double> means;
    for(const auto& [index, sum] : edges)
      means[index] = sum.first / double(sum.second);
    return means;
  }

  // Largest cost of an element; 0 if elements may have any on the way.
  double largest_cost_at_start() const
  {
    double largest = 0;
    if(mode.keeps_bound)
      for(const Working_mesh::Element& element : mesh.elements)
        largest = (std::max)(largest, quality(element.kind, mesh.relative_points(element)));
    return largest;
  }

  // Tolerances, at least a tenth of an edge: a smaller distance is due to the curvature of the surface, and
  // no sliding reduces such a distance.
  Surface_tolerances enlarged_tolerances() const
  {
    Surface_tolerances t(domain, criteria.tolerance(), mesh.points.size());
    t.enlarge([this](Subdomain_index first) { return 0.1 * mean_edge_length(first); });
    return t;
  }

  // Samples of the surface. Samples much closer than the boundary's vertices could not draw these to
  // different places.
  std::vector<Surface_sample> surface_samples() const
  {
    if(!(criteria.tolerance() > 0))
      return {};
    return tolerances.samples(domain, [this](Subdomain_index first) { return mean_edge_length(first) / 6; });
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_FITTING_STATE_H
