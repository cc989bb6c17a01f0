// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Towards a tolerance: which cells outside the region have to be split, so that the boundary comes near
// enough to the surface.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_TOLERANCE_SEARCH_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_TOLERANCE_SEARCH_H

#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/boundary/assemble_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/surface_attraction.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/surface_targets.h>
#include <CGAL/Mixed_mesh_3/internal/surface/self_intersections.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/Candidate.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/base_level.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Octree.h>
#include <CGAL/Mixed_mesh_criteria_3.h>
#include <CGAL/Mixed_mesh_result_3.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Splits cells of the base level where the boundary would be too far from the surface, and again.
template <class Octree_, class Mesh, class Visitor>
class Tolerance_search
{
  // Rounds of splitting (six make cells 64 times smaller), the share of the budget they may take (the rest is
  // for the region). Places farther than the first of these multiples of the tolerance are split for: nearer
  // ones the sliding of boundary vertices reaches. The others follow where that takes too much.
  static constexpr int rounds = 6;
  static constexpr double largest_share = 0.5;
  static constexpr double multiples[] = {1.6, 2, 2.5, 3}, multiples_of_wish[] = {2.5, 3.2, 4};

  const Octree_& m_root;
  const Mixed_mesh_criteria_3& m_criteria;
  Visitor& m_visitor;
  Mixed_mesh_result_3& m_result;
  std::vector<Vec3> m_samples;                 // of the surface
  std::vector<std::vector<Vec3>> m_far_points; // of the surface, where cells are split
  bool m_is_stopped = false;                   // by the visitor

public:
  /// \param root the octree with nothing but its root
  Tolerance_search(const Octree_& root, const Mixed_mesh_criteria_3& criteria, Visitor& visitor,
                   Mixed_mesh_result_3& result)
    : m_root(root), m_criteria(criteria), m_visitor(visitor), m_result(result)
  {
  }

  bool is_stopped() const { return m_is_stopped; }

  /// To be called in the stage `OCTREE`.
  void run()
  {
    const double limit = largest_share * double(m_criteria.maximal_number_of_vertices());
    for(const auto& p : m_root.domain().surface_samples(2 * m_result.tolerance))
      m_samples.push_back(to_vec3(p));
    Octree_ octree = m_root;
    Candidate candidate = try_base_octree(octree);
    std::size_t best = 0, least_defects = std::size_t(-1); // after how many rounds
    for(int round = 0; !is_stopped_by(candidate) && candidate.number_of_vertices > 0; ++round) {
      if(double(candidate.number_of_vertices) > limit)
        break;
      const Estimate estimate = estimate_boundary(octree, candidate);
      if(estimate.number_of_defects <= least_defects) {
        least_defects = estimate.number_of_defects;
        best = m_far_points.size();
        m_result.number_of_vertices_for_tolerance = candidate.number_of_vertices;
      }
      if(round == rounds || !split(estimate, limit, octree, candidate))
        break;
    }
    m_far_points.resize(best);
  }

  /// One level more around each far point, outside the region, round by round.
  void split_far_cells(Octree_& octree) const
  {
    for(const std::vector<Vec3>& points : m_far_points) {
      std::vector<Octree::Node_index> leaves;
      for(const Vec3& p : points) {
        const Octree::Node_index n = octree.leaf_at(Predicates_kernel::Point_3(p[0], p[1], p[2]));
        if(octree.is_alive(n) && !octree.is_in_region(n) && octree.octree().level(n) < Octree::max_level)
          leaves.push_back(n);
      }
      std::sort(leaves.begin(), leaves.end());
      leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
      octree.refine(leaves);
    }
  }

private:
  Candidate try_base_octree(Octree_& octree)
  {
    if(!refine_to_level(octree, first_base_level(m_criteria), m_criteria.maximal_number_of_vertices()))
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

  struct Estimate
  {
    std::vector<std::pair<double, Vec3>> far_points; // of the surface, with their distances
    std::vector<Vec3> defects;                       // where the surface is too fine for the cells
    std::size_t number_of_defects;
  };

  // From the boundary with its vertices on the surface, where the optimization will bring them nearly. Where
  // its faces are folded or cut each other, it would have to leave vertices behind.
  Estimate estimate_boundary(const Octree_& octree, const Candidate& candidate) const
  {
    Mesh mesh;
    assemble_mesh(octree, candidate.mesh, candidate.boundary, mesh);
    Strata strata(m_root.domain());
    const Interface_faces boundary = strata.sorted_faces(mesh);
    Working_mesh projected(mesh, strata.of_vertices(mesh.number_of_vertices(), boundary));
    const Surface_projection project(m_root.domain(), strata);
    const Surface_targets targets = surface_targets(boundary.faces, projected.points, project,
                                                    projected.strata);
    for(std::size_t i = 0; i < targets.vertices.size(); ++i)
      projected.points[targets.vertices[i]] = targets.positions[i];
    Surface_attraction attraction(projected, project, m_samples, m_result.tolerance);
    attraction.set_boundary(boundary);
    attraction.measure();
    Estimate estimate{attraction.far_points(), {}, targets.number_of_folded_faces};
    const std::vector<Vertex_index> crossing = vertices_of_self_intersections(projected.points,
                                                                              boundary.faces);
    estimate.number_of_defects += crossing.size();
    for(const std::vector<Vertex_index>& vertices : {targets.folded_vertices, crossing})
      for(Vertex_index v : vertices)
        estimate.defects.push_back(projected.points[v]);
    return estimate;
  }

  // Splits cells at all defects, and at as many far points as fit into the limit, the farthest ones.
  bool split(const Estimate& estimate, double limit, Octree_& octree, Candidate& candidate)
  {
    const bool is_wish = m_criteria.tolerance() == Mixed_mesh_criteria_3::automatic;
    for(const double* multiple = is_wish ? std::begin(multiples_of_wish) : std::begin(multiples);
        multiple != (is_wish ? std::end(multiples_of_wish) : std::end(multiples)); ++multiple) {
      std::vector<Vec3> points = estimate.defects;
      for(const auto& [distance, point] : estimate.far_points)
        if(distance > *multiple * m_result.tolerance)
          points.push_back(point);
      if(points.empty())
        return false;
      m_far_points.push_back(points);
      octree = m_root;
      candidate = try_base_octree(octree);
      if(candidate.is_stopped || double(candidate.number_of_vertices) <= limit)
        return true;
      m_far_points.pop_back();
    }
    return false;
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_TOLERANCE_SEARCH_H
