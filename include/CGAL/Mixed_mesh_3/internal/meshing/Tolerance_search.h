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
#include <CGAL/Mixed_mesh_3/internal/boundary/assemble_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Surface_projection.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/surface_attraction.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/surface_targets.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Located_octree.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/Any_visitor.h>
#include <CGAL/Mixed_mesh_3/internal/surface/self_intersections.h>
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
  // tolerance: the sliding of boundary vertices reaches nearer places. The other multiples are tried where
  // the first one takes too much.
  static constexpr int rounds = 6;
  static constexpr double largest_share = 0.5, largest_share_of_parts = 0.7,
                          largest_share_of_subdomains = 0.75;
  static constexpr double multiples[] = {1.6, 2, 2.5, 3}, multiples_of_wish[] = {2.5, 3.2, 4};
  static constexpr int number_of_trials = 5; // trials of a search for such a multiple
  // Rounds of sliding. Between subdomains, where folds are no defects, the first few rounds gain most; with
  // 189 subdomains most boundary vertices are where three or more meet, and all rounds would take nearly all
  // of the time.
  static constexpr int rounds_of_sliding = 100, rounds_between_subdomains = 5;

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
      for(std::size_t i = 0; i < number; ++i) {
        const Vec3& p = points[i];
        const Octree::Node_index n = octree.leaf_at(Predicates_kernel::Point_3(p[0], p[1], p[2]));
        if(octree.meets_domain(n) && (m_has_subdomains || !octree.is_in_region(n))
           && octree.octree().level(n) < Octree::max_level)
          leaves.push_back(n);
      }
      std::sort(leaves.begin(), leaves.end());
      leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
      octree.refine(leaves);
    }
  }

private:
  void run(double share)
  {
    const double limit = share * double(m_criteria.maximal_number_of_vertices());
    m_samples = tolerances().samples(m_root.domain(),
                                     [this](Subdomain_index) { return m_result.tolerance / 2; });
    // Cells in the region are split anyway, but maybe not as much as small parts need.
    const bool spares_region = !m_has_subdomains || !(m_only_parts || m_root.is_region_everywhere());
    const auto is_in_region = [&](const Surface_sample& s) {
      return spares_region && m_root.region().depth({s.point[0], s.point[1], s.point[2]}) >= 0;
    };
    m_samples.erase(std::remove_if(m_samples.begin(), m_samples.end(), is_in_region), m_samples.end());
    Located_octree octree = m_root;
    Candidate candidate = try_base_octree(octree);
    // The best number of rounds.
    std::size_t best = m_far_points.size(), least_defects = std::size_t(-1);
    for(int round = 0; !is_stopped_by(candidate) && candidate.number_of_vertices > 0; ++round) {
      if(double(candidate.number_of_vertices) > limit)
        break;
      const Estimate estimate = estimate_boundary(octree, candidate);
      if(estimate.number_of_defects <= least_defects) {
        least_defects = estimate.number_of_defects;
        best = m_far_points.size();
        m_result.number_of_vertices_for_tolerance = candidate.number_of_vertices;
      }
      if(round == rounds || m_is_full || !split(estimate, limit, octree, candidate))
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

  bool is_stopped_by(const Candidate& candidate)
  {
    m_is_stopped = candidate.is_stopped;
    return m_is_stopped;
  }

  enum class Outcome { NOTHING, FITS, TOO_MANY };

  struct Estimate
  {
    std::vector<std::pair<double, Vec3>> far_points; // on the surface, with distances in tolerances
    std::vector<Vec3>
      defects; // places where the boundary folds or cuts itself: the surface is too fine for the cells
    std::size_t number_of_defects;
  };

  // Estimates the boundary with its vertices on the surface, to which the optimization will nearly bring
  // them. Where its faces are folded or cut each other, the optimization could not bring all vertices to the
  // surface.
  Estimate estimate_boundary(const Located_octree& octree, const Candidate& candidate) const
  {
    Core_mesh mesh;
    assemble_mesh(octree, candidate.mesh, candidate.boundary, mesh);
    Strata strata(m_root.domain());
    const Interface_faces boundary = strata.sorted_faces(mesh);
    Working_mesh projected(mesh, strata.of_vertices(mesh.number_of_vertices(), boundary));
    Surface_projection project(m_root.domain(), strata);
    if(m_has_subdomains)
      project.set_approximate();
    const Surface_targets targets = surface_targets(boundary.faces, projected.points, project,
                                                    projected.strata, {},
                                                    m_has_subdomains ? rounds_between_subdomains
                                                                     : rounds_of_sliding);
    for(std::size_t i = 0; i < targets.vertices.size(); ++i)
      projected.points[targets.vertices[i]] = targets.positions[i];
    Surface_attraction attraction(projected, project, m_samples);
    attraction.set_boundary(boundary, [&, tolerance = tolerances()](Stratum s) {
      return tolerance(strata.interfaces(s)[0].first);
    });
    attraction.measure();
    Estimate estimate{attraction.far_points(), {}, 0};
    // Interfaces fold at first where a part is small: an increase of their folds by splits means nothing.
    if(m_has_subdomains)
      return estimate;
    const std::vector<Vertex_index> crossing = vertices_of_self_intersections(projected.points,
                                                                              boundary.faces);
    estimate.number_of_defects = targets.number_of_folded_faces + crossing.size();
    for(const std::vector<Vertex_index>& vertices : {targets.folded_vertices, crossing})
      for(Vertex_index v : vertices)
        estimate.defects.push_back(projected.points[v]);
    return estimate;
  }

  // Splits cells at all defects, and at as many far points as fit into the limit, the farthest points first.
  // \return whether more might be split
  bool split(const Estimate& estimate, double limit, Located_octree& octree, Candidate& candidate)
  {
    std::vector<std::pair<double, Vec3>> far_points = estimate.far_points;
    std::stable_sort(far_points.begin(), far_points.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    const auto try_beyond = [&](double multiple) {
      std::vector<Vec3> points = estimate.defects;
      for(const auto& [distance, point] : far_points)
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
      return split_subdomains(estimate, try_beyond, octree, candidate);
    const bool is_wish = m_criteria.tolerance() == Mixed_mesh_criteria_3::automatic;
    for(const double* multiple = is_wish ? std::begin(multiples_of_wish) : std::begin(multiples);
        multiple != (is_wish ? std::end(multiples_of_wish) : std::end(multiples)); ++multiple)
      if(const Outcome outcome = try_beyond(*multiple); outcome != Outcome::TOO_MANY)
        return outcome == Outcome::FITS;
    return false;
  }

  // Splits cells of subdomains. The tolerances of small subdomains are so small that all of their surface may
  // be far: the multiple beyond which points count as far is found by bisection.
  template <class Try>
  bool split_subdomains(const Estimate& estimate, const Try& try_beyond, Located_octree& octree,
                        Candidate& candidate)
  {
    if(estimate.far_points.empty())
      return false;
    double too_near = *std::begin(multiples_of_wish);
    if(const Outcome outcome = try_beyond(too_near); outcome != Outcome::TOO_MANY)
      return outcome == Outcome::FITS;
    double far_enough = std::max_element(estimate.far_points.begin(), estimate.far_points.end())->first;
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
