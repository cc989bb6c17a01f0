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
#include <CGAL/Mixed_mesh_3/internal/boundary/assemble_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/boundary/lost_cells.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Bounded_optimization.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/Candidate.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/Tolerance_search.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/base_level.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/stage_scopes.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Located_octree.h>
#include <CGAL/Mixed_mesh_3/internal/octree/fill_vertex_budget.h>
#include <CGAL/Mixed_mesh_criteria_3.h>
#include <CGAL/Mixed_mesh_result_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The stages in their order. The octree is refined, and what follows is tried, until the budget is full.
template <class Domain, class Region, class CellTraits, class Mesh, class Visitor>
class Driver
{
  using Octree_ = Located_octree<Domain, Region, CellTraits>;
  using Scope = Stage_scope<Visitor>;

  const Mixed_mesh_criteria_3& m_criteria;
  const CellTraits& m_traits;
  Visitor& m_visitor;
  const Octree_ m_root; // nothing but the root
  Octree_ m_octree;
  const double m_radius; // of the region
  Candidate m_best;
  std::vector<Octree::Node_index> m_lost;
  Mixed_mesh_result_3 m_result;
  Tolerance_search<Octree_, Mesh, Visitor> m_tolerance_search;

public:
  Driver(const Domain& domain, const Region& region, const Mixed_mesh_criteria_3& criteria,
         const CellTraits& traits, Visitor& visitor)
    : m_criteria(criteria), m_traits(traits), m_visitor(visitor), m_root(domain, region, traits),
      m_octree(m_root), m_radius(mean_radius_of_region(m_root)),
      m_tolerance_search(m_root, criteria, visitor, m_result)
  {
  }

  Driver(const Driver&) = delete; // the search refers to members
  Driver& operator=(const Driver&) = delete;

  Mixed_mesh_result_3 operator()(Mesh& mesh)
  {
    mesh.clear();
    {
      m_result.tolerance = tolerance();
      const Scope scope(m_visitor, Stage::OCTREE);
      if(m_result.tolerance > 0)
        m_tolerance_search.run();
      if(!m_tolerance_search.is_stopped())
        fill_budget();
    }
    describe();
    if(!m_result.has_mesh())
      return m_result;
    {
      const Scope scope(m_visitor, Stage::ASSEMBLY);
      mark_sheets();
      assemble_mesh(m_octree, m_best.mesh, m_best.boundary, mesh);
    }
    if(m_criteria.fit_to_surface() && !m_result.is_kept)
      optimize(mesh);
    note_share_filled(mesh.number_of_vertices());
    return m_result;
  }

private:
  // Not before: sheets add no vertex.
  void mark_sheets()
  {
    if constexpr(Is_domain_with_sheets<Domain>::value)
      if(has_sheets(m_root.domain())) {
        m_best.boundary = split_boundary(m_octree, m_best.mesh, m_criteria.boundary_mode(),
                                         m_criteria.number_of_threads(), Sheet_layer(m_octree, m_best.mesh));
        m_result.number_of_lost_sheets = m_best.boundary.number_of_lost_sheets;
        if(m_result.number_of_lost_sheets > 0)
          m_result.status = worse(m_result.status, Mixed_mesh_status::PARTS_LOST);
      }
  }

  // What the octree may have; the rest is for the optimization.
  std::size_t budget() const
  {
    const std::size_t n = m_criteria.maximal_number_of_vertices();
    return n - std::size_t(m_criteria.share_of_bisections() * double(n));
  }

  // Smaller ones take too many vertices from the region, larger ones leave furrows unresolved: with 0.42,
  // brains of 660 to 10,000 vertices are nowhere farther than that from their surface, nearly.
  double tolerance() const
  {
    constexpr double share_of_edge = 0.42;
    if(m_criteria.tolerance() != Mixed_mesh_criteria_3::automatic)
      return m_criteria.tolerance();
    return share_of_edge
           * std::cbrt(volume_of_domain(m_root) / double(m_criteria.maximal_number_of_vertices()));
  }

  void optimize(Mesh& mesh)
  {
    const Scope scope(m_visitor, Stage::OPTIMIZATION);
    const std::size_t rest = m_criteria.maximal_number_of_vertices() - m_best.number_of_vertices;
    const auto criteria = Mixed_mesh_optimization_criteria_3()
                            .tolerance(m_result.tolerance)
                            .quality_bound(m_criteria.quality_bound())
                            .number_of_bisections(m_criteria.share_of_bisections() > 0 ? rest : 0);
    const Aspect_ratio_quality_3 quality;
    Bounded_optimization optimize(mesh, m_root.domain(), criteria, quality);
    m_result.optimization = optimize([this] { return m_visitor.go_on(); });
    const bool is_only_wished = m_criteria.tolerance() == Mixed_mesh_criteria_3::automatic
                                && m_result.optimization.status
                                     == Mixed_mesh_optimization_status::TOLERANCE_NOT_REACHED;
    if(!is_only_wished)
      m_result.status = worse(m_result.status, status_of(m_result.optimization.status));
    m_result.is_kept = m_result.status == Mixed_mesh_status::STOPPED && m_best.is_manifold()
                       && m_criteria.keep_mesh_if_stopped();
    if(!m_result.has_mesh())
      mesh.clear();
  }

  // If no base level is given: coarser than the default if the budget demands it; finer, as far as the
  // budget allows, if much of a thin domain would have no elements.
  void fill_budget()
  {
    const bool is_automatic = m_criteria.base_level() == Mixed_mesh_criteria_3::automatic;
    int level = first_base_level(m_criteria);
    for(int step = 0;; level += step) {
      Octree_ octree = m_root;
      Candidate candidate;
      if(refine_to_level(octree, level, budget())) {
        m_tolerance_search.split_far_cells(octree);
        candidate = fill_vertex_budget(octree, budget(), m_criteria.grading() * m_radius,
                                       [this](const Octree_& o) { return try_octree(o); });
      } else {
        candidate.number_of_vertices = 8 * octree.number_of_cells_inside();
      }
      const bool is_above = candidate.number_of_vertices > m_criteria.maximal_number_of_vertices();
      if(is_above && step > 0)
        return; // the coarser one, which fits, stays
      if(candidate.is_stopped && candidate.number_of_vertices == 0) {
        m_best.is_stopped = true; // so does that one, if there is one
        return;
      }
      m_octree = std::move(octree);
      m_best = std::move(candidate);
      // without vertices, the last level that had too many tells more
      if(m_best.number_of_vertices != 0 || m_result.number_of_vertices_needed == 0) {
        m_result.base_level = level;
        m_result.number_of_vertices_needed = m_best.number_of_vertices;
      }
      m_lost = lost_cells(m_octree, m_best.mesh, m_best.boundary);
      m_result.number_of_cells = m_octree.number_of_cells();
      const bool is_too_coarse = m_best.number_of_vertices == 0
                                 || double(m_lost.size())
                                      > tolerated_share_of_lost_cells * double(m_result.number_of_cells);
      if(m_best.is_stopped)
        return;
      if(is_automatic && is_above && level > coarsest_automatic_base_level)
        step = -1;
      else if(is_automatic && !is_above && step >= 0 && is_too_coarse && level < finest_automatic_base_level)
        step = 1;
      else
        return;
    }
  }

  Candidate try_octree(const Octree_& octree)
  {
    Candidate c = make_candidate(octree, m_criteria, m_visitor);
    m_result.number_of_trials += !c.is_stopped;
    return c;
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
    const auto note = [this](bool is_so, Status status) {
      if(is_so)
        m_result.status = worse(m_result.status, status);
    };
    m_result.status = Status::SUCCESS;
    note(m_result.number_of_vertices_needed > m_criteria.maximal_number_of_vertices(),
         Status::BUDGET_TOO_SMALL);
    note(n == 0, Status::EMPTY);
    note(!meets_region, Status::REGION_NOT_MET);
    note(!m_best.is_manifold(), Status::BOUNDARY_NOT_MANIFOLD);
    note(!m_lost.empty(), Status::PARTS_LOST);
    if(m_tolerance_search.is_stopped() || m_best.is_stopped) {
      m_result.is_kept = m_result.status < Status::BOUNDARY_NOT_MANIFOLD && m_criteria.keep_mesh_if_stopped();
      m_result.status = Status::STOPPED;
    }
  }

  // Of the whole budget, or of what is not left over for a later optimization.
  void note_share_filled(std::size_t n)
  {
    const std::size_t whole = m_criteria.fit_to_surface() ? m_criteria.maximal_number_of_vertices()
                                                          : budget();
    if(double(n) < Mixed_mesh_criteria_3::full_share * double(whole))
      m_result.status = worse(m_result.status, Mixed_mesh_status::BUDGET_NOT_FILLED);
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_DRIVER_H
