// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The optimization with its two guarantees: no element above the quality bound, and no faces that cut each
// other.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_BOUNDED_OPTIMIZATION_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_BOUNDED_OPTIMIZATION_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Concurrency.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/element_points.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Followed_features.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/find_followed_features.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Optimization_effort.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/optimize_surface.h>
#include <CGAL/Mixed_mesh_3/internal/surface/self_intersections.h>
#include <CGAL/Mixed_mesh_optimization_criteria_3.h>
#include <CGAL/Mixed_mesh_optimization_result_3.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
Runs the optimization as often as needed, each time from the start but one, and takes the result within the
bound in which most of the boundary has arrived:

- *freely*: on the way to the surface, elements may get worse than the bound, and better again; elements above
the bound in the end are mended, as a last resort by boundary vertices that leave the surface. If all of the
boundary arrives, and no element is above the bound in the end, as for most surfaces, this result is taken;
- *without attraction*: the same, but places that are too far do not draw the boundary, and vertices are held
on their way where their faces would cut others;
- *within the bound*, which no step exceeds;
- where faces cut each other in the end, once more, with their vertices *held*, and each time more of the
vertices around them; in the end all of the boundary, which then does not cut itself if it did not at the
start.

The end has no element above the bound if the start has none; else none is worse than the worst one at the
start.

\tparam Quality a model of `MixedMeshQuality_3`
*/
template <class Quality>
class Bounded_optimization
{
  using Criteria = With_threads<Mixed_mesh_optimization_criteria_3>;
  using Result = Mixed_mesh_optimization_result_3;
  using Status = Mixed_mesh_optimization_status;

  Core_mesh& m_mesh; // the start, until the end
  const Any_surface& m_domain;
  const Criteria& m_criteria;
  const Quality& m_quality;
  const bool m_has_subdomains; // or sheets
  const Fitting_estimate m_estimate;
  const double m_tolerated_share_not_arrived; // share of the boundary vertices
  const Sharp_edges m_sharp_edges;
  const double m_edge_length; // mean of the boundary; any value if there are no sharp edges
  Sharp_features m_features;
  const Sharp_strata m_sharp_at_start; // empty: not chosen yet
  Sharp_strata m_sharp;                // of the mesh taken
  std::vector<std::uint8_t> m_is_held; // one value for each vertex
  bool m_is_within_bound = false;      // known of the mesh taken

  // Tolerated share of vertices between subdomains that have not arrived; tolerated loss of the length of
  // sharp edges. With half and twice of either, 18 meshes are the same (benchmark/results/constants.md).
  static constexpr double tolerated_share_on_interfaces = 0.01, tolerated_loss = 0.02;

  // The attraction would make hard cases harder.
  static constexpr Fitting_mode without_attraction{false, true}, within_bound{true, true};

  // Number of rings of faces around crossing faces that are held in addition, in successive attempts.
  static constexpr int rings[] = {0, 1, 2, 4, 8};

public:
  Bounded_optimization(Core_mesh& mesh, const Any_surface& domain, const Criteria& criteria,
                       const Quality& quality, const Fitting_estimate& estimate,
                       const Followed_features* followed = nullptr)
    : m_mesh(mesh), m_domain(domain), m_criteria(criteria), m_quality(quality),
      m_has_subdomains(domain.subdomain_indices().size() > 1 || domain.has_sheets()), m_estimate(estimate),
      m_tolerated_share_not_arrived(
        (std::max)(estimate.tolerated_share_not_arrived,
                   m_has_subdomains ? tolerated_share_on_interfaces : share_not_arrived_tolerated)),
      m_sharp_edges(is_chosen(followed) ? Sharp_edges() : domain.sharp_edges(criteria.sharp_angle())),
      m_edge_length(m_sharp_edges.edges.empty() ? 1 : mean_edge_length_of_boundary(mesh)),
      m_features(is_chosen(followed) ? followed->features : Sharp_features(m_sharp_edges, m_edge_length)),
      m_sharp_at_start(is_chosen(followed) ? followed->strata : Sharp_strata()), m_sharp(m_sharp_at_start),
      m_is_held(mesh.number_of_vertices(), 0)
  {
  }

  /// The features that the mesh follows in the end.
  Followed_features followed_features() && { return {std::move(m_features), std::move(m_sharp)}; }

  Result operator()(const std::function<bool()>& go_on)
  {
    Result result = optimize(go_on);
    result.quality_bound = m_criteria.quality_bound();
    if(!m_is_within_bound)
      for(std::size_t e = 0; e < m_mesh.number_of_elements(); ++e)
        result.number_of_elements_above_bound += cost(m_mesh, e) > bound();
    return result;
  }

private:
  struct Outcome
  {
    Core_mesh mesh;
    Sharp_strata sharp;
    Result result;
    bool is_within_bound = false;   // known to have no element above the bound
    bool meets_guarantees = false;  // within the bound, and the boundary does not cut itself
    bool may_be_attraction = false; // that keeps vertices from arriving, or makes faces cut each other
  };

  static bool is_chosen(const Followed_features* followed)
  {
    return followed != nullptr && !followed->strata.empty();
  }

  Result optimize(const std::function<bool()>& go_on)
  {
    // A mesh that follows sharp edges already is on the surface, but for few vertices, and does not cut
    // itself.
    if(!m_sharp_at_start.empty()) {
      Outcome outcome = optimize_freely({true, false}, go_on);
      if(!outcome.result.is_boundary_simple && outcome.result.status != Status::STOPPED)
        outcome.result = optimize_without_crossing(outcome, within_bound, go_on);
      return take(outcome);
    }
    Outcome best;
    if(m_estimate.stays_simple) {
      best.result = optimize_without_crossing(best, freely(), go_on);
      return take(best);
    }
    for(const Fitting_mode& mode : {freely(), without_attraction}) {
      Outcome outcome = optimize_freely(mode, go_on);
      if(outcome.result.status == Status::STOPPED)
        return outcome.meets_guarantees && !mode.is_without_attraction ? take(outcome)
                                                                       : stopped(outcome.result);
      if(m_estimate.leaves_rest)
        return take(outcome);
      if(outcome.meets_guarantees && (is_fitted(outcome.result) || !has_bound()))
        return take(outcome); // no other run would do better
      const bool may_be_attraction = outcome.may_be_attraction;
      if(is_better(outcome, best))
        best = std::move(outcome);
      if(!may_be_attraction)
        break;
    }
    Outcome bounded;
    bounded.result = optimize_without_crossing(bounded, within_bound, go_on);
    bounded.meets_guarantees = true;
    return take(bounded.result.status == Status::STOPPED || is_better(bounded, best) ? bounded : best);
  }

  // The first mode: a run that is good only if all of the boundary arrives may end early.
  Fitting_mode freely() const
  {
    return {false, m_estimate.leaves_rest, m_tolerated_share_not_arrived <= share_not_arrived_tolerated,
            m_estimate.number_of_vertices, m_estimate.leaves_rest};
  }

  double bound() const { return bound_for_doubles(m_criteria); }
  bool has_bound() const { return m_criteria.quality_bound() < std::numeric_limits<double>::infinity(); }

  bool is_better(const Outcome& a, const Outcome& b) const
  {
    return a.meets_guarantees
           && (!b.meets_guarantees || number_not_arrived(a.result) < number_not_arrived(b.result));
  }

  Result take(Outcome& outcome)
  {
    m_mesh = std::move(outcome.mesh);
    m_sharp = std::move(outcome.sharp);
    m_is_within_bound = outcome.is_within_bound;
    return outcome.result;
  }

  // Optimizes with elements that may get worse than the bound on the way.
  Outcome optimize_freely(const Fitting_mode& mode, const std::function<bool()>& go_on) const
  {
    Fitting_outcome fitted = optimize_surface(m_mesh, m_domain, m_criteria, m_quality, mode, m_features,
                                              m_sharp_at_start, m_is_held, go_on);
    Outcome outcome;
    outcome.mesh = std::move(fitted.mesh);
    outcome.sharp = std::move(fitted.sharp);
    outcome.result = fitted.result;
    const double largest = largest_cost(outcome.mesh);
    outcome.is_within_bound = largest <= bound();
    outcome.meets_guarantees = (outcome.is_within_bound || largest <= largest_cost(m_mesh))
                               && outcome.result.is_boundary_simple;
    outcome.may_be_attraction = fitted.has_crossed
                                || ((m_criteria.tolerance() > 0 || m_criteria.number_of_bisections() > 0)
                                    && !fitted.is_without_attraction);
    return outcome;
  }

  // The result of a stopped run. The mesh is the start: vertices that had arrived have come back.
  static Result stopped(Result result)
  {
    result.number_of_arrived_vertices = result.number_of_flips = result.number_of_bisections =
      result.number_of_merged_vertices = 0;
    return result;
  }

  // The number of vertices that have not arrived, plus the lost length of sharp edges in lengths of edges.
  double number_not_arrived(const Result& r) const
  {
    const double lost = r.length_of_sharp_edges - r.length_of_sharp_edges_kept;
    return double(r.number_of_boundary_vertices - r.number_of_arrived_vertices)
           + (lost > 0 ? lost / m_edge_length : 0);
  }

  // Whether the boundary is fitted well enough. Between subdomains and on sheets a few vertices are often
  // kept from arriving from both sides: another run would rarely help.
  bool is_fitted(const Result& r) const
  {
    const double tolerated = m_tolerated_share_not_arrived * double(r.number_of_boundary_vertices);
    return r.is_boundary_simple
           && number_not_arrived(r) <= tolerated + tolerated_loss * r.length_of_sharp_edges / m_edge_length;
  }

  // Optimizes, and repeats until no faces cut each other, if none did before.
  Result optimize_without_crossing(Outcome& outcome, const Fitting_mode& mode,
                                   const std::function<bool()>& go_on)
  {
    for(std::size_t i = 0;; ++i) {
      Fitting_outcome fitted = optimize_surface(m_mesh, m_domain, m_criteria, m_quality, mode, m_features,
                                                m_sharp_at_start, m_is_held, go_on);
      outcome.mesh = std::move(fitted.mesh);
      outcome.sharp = std::move(fitted.sharp);
      const Result& result = fitted.result;
      if(result.is_boundary_simple || result.status == Status::STOPPED || i > std::size(rings)
         || (i == 0 && cuts_itself(m_mesh)))
        return result;
      if(i == std::size(rings))
        std::fill(m_is_held.begin(), m_is_held.end(), 1);
      else
        hold(fitted.crossing, rings[i]);
    }
  }

  void hold(const std::vector<Vertex_index>& vertices, int number_of_rings)
  {
    for(Vertex_index v : vertices)
      if(v < m_is_held.size()) // new vertices are between these
        m_is_held[v] = 1;
    for(int ring = 0; ring < number_of_rings; ++ring) {
      const std::vector<std::uint8_t> is_inner = m_is_held;
      for(const Face& face : boundary_faces(m_mesh))
        if(std::any_of(face.vertices().begin(), face.vertices().end(),
                       [&](Vertex_index v) { return is_inner[v] != 0; }))
          for(Vertex_index v : face.vertices())
            m_is_held[v] = 1;
    }
  }

  double cost(const Core_mesh& mesh, std::size_t e) const
  {
    const Element_view element = mesh.element(e);
    return m_quality(element.kind(), element_points(mesh, element));
  }

  double largest_cost(const Core_mesh& mesh) const
  {
    double largest = 0;
    for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
      largest = (std::max)(largest, cost(mesh, e));
    return largest;
  }
};

/// Runs the optimization, for any quality.
template <class Quality>
Mixed_mesh_optimization_result_3
optimize_bounded(Core_mesh& mesh, const Any_surface& surface,
                 const With_threads<Mixed_mesh_optimization_criteria_3>& criteria, const Quality& quality,
                 const std::function<bool()>& go_on, const Fitting_estimate& estimate = {},
                 Followed_features* followed = nullptr)
{
  Bounded_optimization<Quality> run(mesh, surface, criteria, quality, estimate, followed);
  const Mixed_mesh_optimization_result_3 result = run(go_on);
  CGAL_postcondition(result.number_of_arrived_vertices <= result.number_of_boundary_vertices);
  if(followed != nullptr)
    *followed = std::move(run).followed_features();
  return result;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_BOUNDED_OPTIMIZATION_H
