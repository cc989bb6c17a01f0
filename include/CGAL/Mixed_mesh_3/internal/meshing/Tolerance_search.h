// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Search for the cells outside the region that have to be split, so that the boundary comes near enough to
// the surface.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_TOLERANCE_SEARCH_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_TOLERANCE_SEARCH_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/internal/base/Core_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Surface_projection.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/optimize_bounded.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/surface_attraction.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/surface_targets.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Located_octree.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/Any_visitor.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/Candidate.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/base_level.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Octree.h>
#include <CGAL/Mixed_mesh_3/internal/octree/place_lattice.h>
#include <CGAL/Mixed_mesh_criteria_3.h>
#include <CGAL/Mixed_mesh_result_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Splits cells of the base level where the boundary would be too far from the surface, in several rounds.
class Tolerance_search
{
  // Rounds of splitting (six make cells 64 times smaller), and the share of the budget that they may take
  // (the rest is for the region). Cells are split at places farther than the first of these multiples of the
  // tolerance; the other multiples are tried where the first one takes too much.
  static constexpr int rounds = 6;
  static constexpr double largest_share = 0.5, largest_share_of_parts = 0.7,
                          largest_share_of_subdomains = 0.75;
  static constexpr double multiples[] = {1, 1.3, 2, 3}, multiples_of_wish[] = {1.9, 2.4, 3.2};
  // Between subdomains, the sliding of boundary vertices, which is not estimated, reaches nearer places: the
  // first multiple that is tried, and the number of trials of the search for another one: five
  // trials narrow a range of 1 to 10 to a factor of 1.07, the 32nd root of 10.
  static constexpr double multiple_between_subdomains = 2.5;
  static constexpr int number_of_trials = 5;

  const Located_octree& m_root;
  const Meshing_criteria& m_criteria;
  Any_visitor& m_visitor;
  Mixed_mesh_result_3& m_result;
  const bool m_has_subdomains;
  std::vector<Surface_sample> m_samples;
  std::vector<std::vector<Vec3>> m_far_points; // on the surface, where cells are split: the farthest first
  bool m_is_stopped = false;                   // the visitor stopped the search
  bool m_only_parts = false;                   // small parts only, not the outer surface
  bool m_is_full = false;                      // there is no room for more splits

public:
  /// \param root the octree with nothing but its root
  Tolerance_search(const Located_octree& root, const Meshing_criteria& criteria, Any_visitor& visitor,
                   Mixed_mesh_result_3& result)
    : m_root(root), m_criteria(criteria), m_visitor(visitor), m_result(result),
      m_has_subdomains(root.domain().subdomain_indices().size() > 1)
  {
  }

  bool is_stopped() const { return m_is_stopped; }

  /// Runs the search. To be called in the stage `OCTREE`.
  void run()
  {
    if(m_has_subdomains) { // small parts come first
      m_only_parts = true;
      run(largest_share_of_parts);
      m_only_parts = m_is_full = false;
    }
    if(!m_is_stopped)
      run(m_has_subdomains ? largest_share_of_subdomains : largest_share);
  }

  bool has_far_points() const { return !m_far_points.empty(); }
  /// Splits the cell around each far point once, round by round.
  /// \param share share of the points of each round; the farthest points are used
  void split_far_cells(Located_octree& octree, double share = 1) const
  {
    for(const std::vector<Vec3>& points : m_far_points) {
      std::vector<Octree::Node_index> leaves;
      const auto number = std::size_t(std::ceil(share * double(points.size())));
      for(std::size_t i = 0; i < number; ++i)
        if(const Octree::Node_index n = octree.leaf_at({points[i][0], points[i][1], points[i][2]});
           may_split(octree, n))
          leaves.push_back(n);
      std::sort(leaves.begin(), leaves.end());
      leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
      octree.refine(leaves);
    }
  }

private:
  // Cells in the region are split anyway, but maybe not as much as small parts need.
  bool may_split(const Located_octree& octree, Octree::Node_index n) const
  {
    return octree.meets_domain(n) && (m_has_subdomains || !octree.is_in_region(n))
           && octree.octree().level(n) < Octree::max_level;
  }

  void run(double share)
  {
    const double limit = share * double(m_criteria.maximal_number_of_vertices());
    m_samples = tolerances().samples(m_root.domain(),
                                     [this](Subdomain_index) { return m_result.tolerance / 2; });
    const bool spares_region = !m_has_subdomains || !(m_only_parts || m_root.is_region_everywhere());
    const auto is_in_region = [&](const Surface_sample& s) {
      return spares_region && m_root.region().depth({s.point[0], s.point[1], s.point[2]}) >= 0;
    };
    m_samples.erase(std::remove_if(m_samples.begin(), m_samples.end(), is_in_region), m_samples.end());
    if(m_samples.empty())
      return;
    Located_octree octree = m_root;
    Candidate candidate = try_base_octree(octree);
    std::size_t best = m_far_points.size(); // number of rounds
    double least = std::numeric_limits<double>::infinity();
    for(int round = 0; !is_stopped_by(candidate) && candidate.number_of_vertices > 0; ++round) {
      if(double(candidate.number_of_vertices) > limit)
        break;
      Far_points far = m_has_subdomains ? far_if_projected(octree, candidate)
                                        : far_if_fitted(octree, candidate);
      if(m_is_stopped)
        break;
      const double farthest = far.empty() ? 0 : far.front().first;
      if(farthest <= least || m_has_subdomains) {
        least = farthest;
        best = m_far_points.size();
        m_result.number_of_vertices_for_tolerance = candidate.number_of_vertices;
      }
      if(round == rounds || m_is_full || !split(far, limit, octree, candidate))
        break;
    }
    m_far_points.resize(best);
  }

  Surface_tolerances tolerances() const
  {
    return {m_root.domain(), m_only_parts ? std::numeric_limits<double>::infinity() : m_result.tolerance,
            m_criteria.maximal_number_of_vertices()};
  }

  Candidate try_base_octree(Located_octree& octree)
  {
    const int level = (std::max)(first_base_level(m_criteria),
                                 octree.cell_traits().lattice_on_surface().level);
    if(!refine_to_level(octree, level, m_criteria.maximal_number_of_vertices()))
      return {};
    split_far_cells(octree);
    Candidate c = make_candidate(octree, m_criteria, m_visitor);
    m_result.number_of_trials += !c.is_stopped;
    return c;
  }

  bool is_wish() const { return is_tolerance_wished(m_criteria); }

  bool is_stopped_by(const Candidate& candidate)
  {
    m_is_stopped = candidate.is_stopped;
    return m_is_stopped;
  }

  enum class Outcome { NOTHING, FITS, TOO_MANY };

  // Points on the surface with their distances from the boundary in tolerances, the farthest first.
  using Far_points = std::vector<std::pair<double, Vec3>>;

  Far_points far_points(const Working_mesh& mesh, const Interface_faces& boundary, Strata& strata,
                        const Surface_projection& project) const
  {
    Surface_attraction attraction(mesh, project, m_samples, m_criteria.number_of_threads);
    attraction.set_boundary(boundary, [&, tolerance = tolerances()](Stratum s) {
      return tolerance(strata.interfaces(s)[0].first);
    });
    attraction.measure();
    Far_points points = attraction.far_points();
    std::stable_sort(points.begin(), points.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    return points;
  }

  Far_points far_points(const Core_mesh& mesh) const
  {
    Strata strata(m_root.domain());
    const Interface_faces boundary = strata.sorted_faces(mesh);
    const Working_mesh fitted(mesh, strata.of_vertices(mesh.number_of_vertices(), boundary));
    return far_points(fitted, boundary, strata, Surface_projection(m_root.domain(), strata));
  }

  // Estimates the boundary by a fit of one round: where cells are too coarse for a furrow, elements fill the
  // furrow, and the boundary gets even farther from it than its vertices on the surface are.
  Far_points far_if_fitted(const Located_octree& octree, const Candidate& candidate)
  {
    Core_mesh mesh = assembled_mesh(octree, candidate);
    const auto rough = Mixed_mesh_optimization_criteria_3()
                         .tolerance(m_result.tolerance)
                         .quality_bound(m_criteria.quality_bound())
                         .number_of_rounds(1);
    bool goes_on = true;
    optimize_bounded(mesh, m_root.domain(), {rough, m_criteria.number_of_threads}, Aspect_ratio_quality_3(),
                     [&] { return goes_on = goes_on && m_visitor.go_on(); },
                     {1, m_criteria.maximal_number_of_vertices()});
    m_is_stopped = !goes_on;
    return far_points(mesh);
  }

  // Estimates the boundary with its vertices on the surface: between subdomains, where a fit takes long.
  Far_points far_if_projected(const Located_octree& octree, const Candidate& candidate) const
  {
    // The first few rounds of sliding gain most; with 189 subdomains most boundary vertices are where three
    // or more meet, and all rounds would take nearly all of the time.
    constexpr int rounds_of_sliding = 5;
    const Core_mesh mesh = assembled_mesh(octree, candidate);
    Strata strata(m_root.domain());
    const Interface_faces boundary = strata.sorted_faces(mesh);
    Working_mesh projected(mesh, strata.of_vertices(mesh.number_of_vertices(), boundary));
    Surface_projection project(m_root.domain(), strata);
    project.set_approximate();
    const Surface_targets targets = surface_targets(boundary.faces, projected.points, project,
                                                    projected.strata, {}, rounds_of_sliding);
    for(std::size_t i = 0; i < targets.vertices.size(); ++i)
      projected.points[targets.vertices[i]] = targets.positions[i];
    return far_points(projected, boundary, strata, project);
  }

  // Splits cells at as many far points as fit into the limit, the farthest points first.
  // \return whether more might be split
  bool split(const Far_points& far, double limit, Located_octree& octree, Candidate& candidate)
  {
    const auto try_beyond = [&](double multiple) {
      std::vector<Vec3> points;
      for(const auto& [distance, point] : far)
        if(distance > multiple)
          points.push_back(point);
      if(points.empty())
        return Outcome::NOTHING;
      const std::size_t before = candidate.number_of_vertices;
      m_far_points.push_back(std::move(points));
      octree = m_root;
      candidate = try_base_octree(octree);
      if(candidate.is_stopped)
        return Outcome::FITS;
      if(double(candidate.number_of_vertices) <= limit)
        return candidate.number_of_vertices == before ? Outcome::NOTHING : Outcome::FITS;
      m_far_points.pop_back();
      return Outcome::TOO_MANY;
    };
    if(m_has_subdomains)
      return split_subdomains(far, try_beyond, octree, candidate);
    const auto first = is_wish() ? std::begin(multiples_of_wish) : std::begin(multiples),
               last = is_wish() ? std::end(multiples_of_wish) : std::end(multiples);
    for(auto multiple = first; multiple != last; ++multiple)
      if(const Outcome outcome = try_beyond(*multiple); outcome != Outcome::TOO_MANY)
        return outcome == Outcome::FITS;
    return false;
  }

  // Splits cells of subdomains. The tolerances of small subdomains are so small that all of their surface may
  // be far: the multiple beyond which points count as far is found by bisection.
  template <class Try>
  bool split_subdomains(const Far_points& far, const Try& try_beyond, Located_octree& octree,
                        Candidate& candidate)
  {
    if(far.empty())
      return false;
    double too_near = multiple_between_subdomains;
    if(const Outcome outcome = try_beyond(too_near); outcome != Outcome::TOO_MANY)
      return outcome == Outcome::FITS;
    double far_enough = far.front().first;
    std::vector<Vec3> best;
    for(int trial = 0; trial < number_of_trials; ++trial) {
      const double multiple = std::sqrt(too_near * far_enough);
      if(try_beyond(multiple) == Outcome::TOO_MANY) {
        too_near = multiple;
      } else {
        far_enough = multiple;
        best = std::move(m_far_points.back());
        m_far_points.pop_back();
      }
    }
    m_is_full = true;
    if(best.empty())
      return false;
    m_far_points.push_back(std::move(best));
    octree = m_root;
    candidate = try_base_octree(octree); // the last trial may have had too many vertices
    return true;
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_TOLERANCE_SEARCH_H
