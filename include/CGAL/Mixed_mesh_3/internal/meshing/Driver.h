// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The method as a list of stages: octree, transitions, boundary, assembly, optimization.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_DRIVER_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_DRIVER_H

#include <CGAL/Mixed_mesh_3/Aspect_ratio_quality_3.h>
#include <CGAL/Mixed_mesh_3/Default_visitor.h>
#include <CGAL/Mixed_mesh_3/internal/boundary/Boundary_stage.h>
#include <CGAL/Mixed_mesh_3/internal/transitions/Lattice_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Located_octree.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Surface_optimizer.h>
#include <CGAL/Mixed_mesh_3/internal/transitions/apply_transitions.h>
#include <CGAL/Mixed_mesh_3/internal/boundary/assemble_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/boundary/lost_cells.h>
#include <CGAL/Mixed_mesh_3/internal/octree/refine_in_region.h>
#include <CGAL/Mixed_mesh_criteria_3.h>
#include <CGAL/Mixed_mesh_result_3.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

// Cells of 1/8 of the domain; see the manual, "Choosing parameters".
inline constexpr int default_base_level = 3;
inline constexpr int coarsest_automatic_base_level = 1;
inline constexpr int finest_automatic_base_level = 6;
inline constexpr double tolerated_share_of_lost_cells = 0.05;
// What may be spent outside the region: beyond, elements there are not what limits the solution.
inline constexpr double largest_share_for_base_level = 0.5;

// Towards the tolerance: rounds of splitting, the share of the budget they may take, how gently a coarse mesh
// is fitted for that, and, where too many places are too far, multiples of the tolerance to begin with.
inline constexpr int tolerance_rounds = 4, rounds_of_coarse_fit = 5;
inline constexpr double largest_share_for_tolerance = 0.7;
inline constexpr double tolerance_multiples[] = {1, 1.2, 1.4, 1.7, 2};

// One octree with the mesh made of it.
struct Candidate
{
  std::size_t number_of_vertices = 0;
  bool is_stopped = false; // by the visitor
  Lattice_mesh mesh;
  Boundary_pieces boundary;

  bool is_manifold() const { return boundary.defects.empty(); }
};

/// The stages in their order. The octree is refined, and what follows is tried, until the budget is full.
template <class Domain, class Region, class CellTraits, class Mesh, class Visitor>
class Driver
{
  using Octree_ = Located_octree<Domain, Region, CellTraits>;

  const Mixed_mesh_criteria_3& m_criteria;
  const CellTraits& m_traits;
  Visitor& m_visitor;
  Octree_ m_octree;
  Candidate m_best;
  std::vector<Octree::Node_index> m_lost;
  std::vector<std::vector<Vec3>> m_far_points; // of the surface, where cells are split for the tolerance
  bool m_is_stopped = false; // by the visitor, on the way to the tolerance
  Mixed_mesh_result_3 m_result;

public:
  Driver(const Domain& domain, const Region& region, const Mixed_mesh_criteria_3& criteria,
         const CellTraits& traits, Visitor& visitor)
    : m_criteria(criteria), m_traits(traits), m_visitor(visitor), m_octree(domain, region, traits)
  {}

  Mixed_mesh_result_3 operator()(Mesh& mesh)
  {
    mesh.clear();
    m_visitor.begin_stage(Stage::OCTREE);
    if(m_criteria.tolerance() > 0)
      find_far_points();
    if(!m_is_stopped)
      fill_budget();
    m_visitor.end_stage(Stage::OCTREE);
    describe();
    if(m_result.has_mesh()) {
      m_visitor.begin_stage(Stage::ASSEMBLY);
      assemble_mesh(m_octree, m_best.mesh, m_best.boundary, mesh);
      m_visitor.end_stage(Stage::ASSEMBLY);
      if(m_criteria.fit_to_surface())
        optimize(mesh);
    }
    return m_result;
  }

private:
  std::size_t budget() const { return m_criteria.maximal_number_of_vertices(); }

  // The stages that follow the octree, for each octree on the way to the budget.
  Candidate try_octree(const Octree_& octree)
  {
    Candidate c;
    m_visitor.end_stage(Stage::OCTREE);
    c.is_stopped = !m_visitor.go_on();
    if(!c.is_stopped) {
      m_visitor.begin_stage(Stage::TRANSITIONS);
      c.mesh = apply_transitions(octree, m_criteria.transition_templates(), m_criteria.number_of_threads());
      m_visitor.end_stage(Stage::TRANSITIONS);
      m_visitor.begin_stage(Stage::BOUNDARY);
      c.boundary =
        split_boundary(octree, c.mesh, m_criteria.boundary_mode(), m_criteria.number_of_threads());
      m_visitor.end_stage(Stage::BOUNDARY);
      ++m_result.number_of_trials;
      c.number_of_vertices = c.boundary.number_of_vertices;
      m_visitor.progress(c.number_of_vertices, budget());
    }
    m_visitor.begin_stage(Stage::OCTREE);
    return c;
  }

  // The default, or a finer one if the budget is large: with elements as coarse as for a small one, the
  // solution would not gain from more vertices in the region. With a tolerance, that says where to be finer.
  int first_base_level() const
  {
    if(m_criteria.base_level() != Mixed_mesh_criteria_3::automatic)
      return m_criteria.base_level();
    const double limit = largest_share_for_base_level * double(budget());
    int level = 0;
    for(Octree_ octree = m_octree; m_criteria.tolerance() == 0 && level < finest_automatic_base_level; ++level) {
      if(8 * double(octree.number_of_cells_inside()) > limit)
        break;
      octree.refine(octree.leaves_to_refine(level, false));
      if(double(octree.number_of_cells()) > limit) // about as many as vertices
        break;
    }
    return (std::max)(level, default_base_level);
  }

  // One level more around each far point, outside the region, round by round.
  void split_far_cells(Octree_& octree) const
  {
    for(const std::vector<Vec3>& points : m_far_points) {
      std::vector<Octree::Node_index> leaves;
      for(const Vec3& p : points) {
        const Octree::Node_index n = octree.leaf_at(typename Domain::Point_3(p[0], p[1], p[2]));
        if(octree.is_alive(n) && !octree.is_in_region(n) && octree.octree().level(n) < Octree::max_level)
          leaves.push_back(n);
      }
      std::sort(leaves.begin(), leaves.end());
      leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
      octree.refine(leaves);
    }
  }

  // Fits the mesh of the base level, splits cells where it is too far from the surface, and again.
  void find_far_points()
  {
    const double limit = largest_share_for_tolerance * double(budget());
    const Octree_ root = m_octree;
    Octree_ octree = root;
    Candidate candidate = try_base_octree(octree);
    for(int round = 0; round < tolerance_rounds; ++round) {
      m_is_stopped = candidate.is_stopped;
      if(m_is_stopped || candidate.number_of_vertices == 0
         || double(candidate.number_of_vertices) > limit)
        return;
      m_result.number_of_vertices_for_tolerance = candidate.number_of_vertices;
      Mesh coarse;
      assemble_mesh(octree, candidate.mesh, candidate.boundary, coarse);
      const auto criteria = Mixed_mesh_optimization_criteria_3()
                              .tolerance(m_criteria.tolerance())
                              .number_of_rounds(rounds_of_coarse_fit);
      Surface_optimizer optimizer(coarse, m_octree.domain(), criteria, Aspect_ratio_quality_3());
      m_is_stopped = optimizer([this] { return m_visitor.go_on(); }).status
                     == Mixed_mesh_optimization_status::STOPPED;
      if(m_is_stopped)
        return;
      bool is_split = false;
      for(double multiple : tolerance_multiples) {
        const std::vector<Vec3> points = optimizer.far_points(multiple);
        if(points.empty())
          break;
        m_far_points.push_back(points);
        Octree_ finer = root;
        candidate = try_base_octree(finer);
        is_split = candidate.is_stopped || double(candidate.number_of_vertices) <= limit;
        if(is_split) {
          octree = std::move(finer);
          break;
        }
        m_far_points.pop_back();
      }
      if(!is_split)
        return;
    }
  }

  Candidate try_base_octree(Octree_& octree)
  {
    for(int level = 0; level < first_base_level(); ++level)
      octree.refine(octree.leaves_to_refine(level, false));
    split_far_cells(octree);
    return try_octree(octree);
  }

  void optimize(Mesh& mesh)
  {
    using Status = Mixed_mesh_status;
    m_visitor.begin_stage(Stage::OPTIMIZATION);
    const auto criteria = Mixed_mesh_optimization_criteria_3().tolerance(m_criteria.tolerance());
    const Aspect_ratio_quality_3 quality;
    Surface_optimizer optimizer(mesh, m_octree.domain(), criteria, quality);
    m_result.optimization = optimizer([this] { return m_visitor.go_on(); });
    m_visitor.end_stage(Stage::OPTIMIZATION);
    const Mixed_mesh_optimization_status status = m_result.optimization.status;
    if(status == Mixed_mesh_optimization_status::STOPPED) {
      m_result.status = Status::STOPPED;
      mesh.clear();
    } else if(status == Mixed_mesh_optimization_status::NOT_ALL_ARRIVED
              && m_result.status != Status::BOUNDARY_NOT_MANIFOLD) {
      m_result.status = Status::NOT_ALL_ARRIVED;
    } else if(status == Mixed_mesh_optimization_status::TOLERANCE_NOT_REACHED
              && (m_result.status == Status::SUCCESS || m_result.status == Status::BUDGET_NOT_FILLED)) {
      m_result.status = Status::TOLERANCE_NOT_REACHED;
    }
  }

  // If no base level is given: coarser than the default if the budget demands it; finer, as far as the
  // budget allows, if much of a thin domain would have no elements.
  void fill_budget()
  {
    const Octree_ root = m_octree;
    const bool is_automatic = m_criteria.base_level() == Mixed_mesh_criteria_3::automatic;
    int level = first_base_level();
    for(int step = 0;; level += step) {
      Octree_ octree = root;
      Candidate candidate = refine_in_region(octree, budget(), level,
                                             [this](Octree_& o) { split_far_cells(o); },
                                             [this](const Octree_& o) { return try_octree(o); });
      const bool is_above = candidate.number_of_vertices > budget();
      if(is_above && step > 0)
        return; // the coarser one, which fits, stays
      m_octree = std::move(octree);
      m_best = std::move(candidate);
      if(m_best.is_stopped)
        return;
      // without vertices, the last level that had too many tells more
      if(m_best.number_of_vertices != 0 || m_result.number_of_vertices_needed == 0) {
        m_result.base_level = level;
        m_result.number_of_vertices_needed = m_best.number_of_vertices;
      }
      m_lost = lost_cells(m_octree, m_best.mesh, m_best.boundary);
      m_result.number_of_cells = m_octree.number_of_cells();
      const bool is_too_coarse =
        m_best.number_of_vertices == 0
        || double(m_lost.size()) > tolerated_share_of_lost_cells * double(m_result.number_of_cells);
      if(is_automatic && is_above && level > coarsest_automatic_base_level)
        step = -1;
      else if(is_automatic && !is_above && step >= 0 && is_too_coarse && level < finest_automatic_base_level)
        step = 1;
      else
        return;
    }
  }

  // By the leaf of each vertex; a query only where that meets the region's surface.
  std::size_t count_vertices_in_region() const
  {
    std::size_t count = 0;
    for(Vertex_index v = 0; v < m_best.boundary.is_used.size(); ++v)
      count += m_best.boundary.is_used[v]
               && m_octree.is_in_region(m_best.mesh.vertices[v], m_best.mesh.leaves[v]);
    return count;
  }

  void describe()
  {
    const Octree& octree = m_octree.octree();
    bool meets_region = false;
    for(Octree::Node_index n = 0; n < octree.size(); ++n)
      if(octree.is_leaf(n) && m_octree.is_alive(n)) {
        m_result.deepest_level = (std::max)(m_result.deepest_level, octree.level(n));
        meets_region = meets_region || m_octree.is_in_region(n);
      }
    m_result.number_of_lost_cells = m_lost.size();
    m_result.number_of_vertices_in_region = count_vertices_in_region();
    for(Octree::Node_index n : m_lost)
      m_result.lost_cells += m_traits.cell(octree.corner(n), octree.side(n)).bbox();
    const std::vector<std::uint8_t>& is_used = m_best.boundary.is_used;
    m_result.number_of_transition_vertices = std::size_t(
      std::count(is_used.begin() + std::ptrdiff_t(m_best.mesh.first_inserted_vertex),
                 is_used.end() - std::ptrdiff_t(m_best.boundary.number_of_inserted_vertices), 1));
    m_result.number_of_boundary_vertices_inserted = m_best.boundary.number_of_inserted_vertices;
    m_result.number_of_relabeled_vertices = m_best.boundary.number_of_relabeled_vertices;

    using Status = Mixed_mesh_status;
    const std::size_t n = m_best.number_of_vertices;
    m_result.status = m_is_stopped || m_best.is_stopped                  ? Status::STOPPED
                      : m_result.number_of_vertices_needed > budget()    ? Status::BUDGET_TOO_SMALL
                      : n == 0                                           ? Status::EMPTY
                      : !meets_region                                    ? Status::REGION_NOT_MET
                      : !m_best.is_manifold()                            ? Status::BOUNDARY_NOT_MANIFOLD
                      : !m_lost.empty()                                  ? Status::PARTS_LOST
                      : double(n) < 0.97 * double(budget())              ? Status::BUDGET_NOT_FILLED
                                                                         : Status::SUCCESS;
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_DRIVER_H
