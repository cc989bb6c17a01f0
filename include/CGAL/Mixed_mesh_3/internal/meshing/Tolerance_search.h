// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Towards a tolerance: which cells outside the region have to be split, so that the boundary comes near
// enough to the surface.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_TOLERANCE_SEARCH_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_TOLERANCE_SEARCH_H

#include <CGAL/Mixed_mesh_3/Aspect_ratio_quality_3.h>
#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/boundary/assemble_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Surface_optimizer.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/Candidate.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/base_level.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Octree.h>
#include <CGAL/Mixed_mesh_criteria_3.h>
#include <CGAL/Mixed_mesh_result_3.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Fits the mesh of the base level, splits cells where it is too far from the surface, and again.
template <class Octree_, class Mesh, class Visitor>
class Tolerance_search
{
  // Rounds of splitting (four make cells 16 times smaller), the share of the budget they may take (the rest
  // is for the region), how gently a coarse mesh is fitted for that (each round of fitting costs as much as
  // the others), and, where too many places are too far, multiples of the tolerance to begin with.
  static constexpr int rounds = 4, rounds_of_coarse_fit = 5;
  static constexpr double largest_share = 0.7;
  static constexpr double multiples[] = {1, 1.2, 1.4, 1.7, 2};

  const Octree_& m_root;
  const Mixed_mesh_criteria_3& m_criteria;
  Visitor& m_visitor;
  Mixed_mesh_result_3& m_result;
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
    Octree_ octree = m_root;
    Candidate candidate = try_base_octree(octree);
    for(int round = 0; round < rounds; ++round) {
      m_is_stopped = candidate.is_stopped;
      if(m_is_stopped || candidate.number_of_vertices == 0 || double(candidate.number_of_vertices) > limit)
        return;
      m_result.number_of_vertices_for_tolerance = candidate.number_of_vertices;
      Mesh coarse;
      assemble_mesh(octree, candidate.mesh, candidate.boundary, coarse);
      const auto criteria = Mixed_mesh_optimization_criteria_3()
                              .tolerance(m_criteria.tolerance())
                              .quality_bound(0) // the mesh is looked at only
                              .number_of_rounds(rounds_of_coarse_fit);
      Surface_optimizer optimizer(coarse, m_root.domain(), criteria, Aspect_ratio_quality_3());
      if(!fit(optimizer) || !split(optimizer, limit, octree, candidate))
        return;
    }
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
    const int base_level = first_base_level(m_root, m_criteria);
    for(int level = 0; level < base_level; ++level)
      octree.refine(octree.leaves_to_refine(level, false));
    split_far_cells(octree);
    Candidate c = make_candidate(octree, m_criteria, m_visitor);
    m_result.number_of_trials += !c.is_stopped;
    return c;
  }

  template <class Optimizer>
  bool fit(Optimizer& optimizer)
  {
    const Stage_pause<Visitor> pause(m_visitor, Stage::OCTREE);
    const Stage_scope<Visitor> scope(m_visitor, Stage::OPTIMIZATION);
    m_is_stopped = optimizer([this] { return m_visitor.go_on(); }).status
                   == Mixed_mesh_optimization_status::STOPPED;
    return !m_is_stopped;
  }

  // Splits cells at as many far points as fit into the limit, the farthest ones.
  template <class Optimizer>
  bool split(const Optimizer& optimizer, double limit, Octree_& octree, Candidate& candidate)
  {
    for(double multiple : multiples) {
      m_far_points.push_back(optimizer.far_points(multiple));
      if(m_far_points.back().empty()) {
        m_far_points.pop_back();
        return false;
      }
      Octree_ finer = m_root;
      candidate = try_base_octree(finer);
      m_is_stopped = candidate.is_stopped;
      if(m_is_stopped)
        return false;
      if(double(candidate.number_of_vertices) <= limit) {
        octree = std::move(finer);
        return true;
      }
      m_far_points.pop_back();
    }
    return false;
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_TOLERANCE_SEARCH_H
