// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The method as a list of stages: octree, transitions, boundary, assembly, optimization.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_DRIVER_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_DRIVER_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Aspect_ratio_quality_3.h>
#include <CGAL/Mixed_mesh_3/Default_visitor.h>
#include <CGAL/Mixed_mesh_3/internal/base/Concurrency.h>
#include <CGAL/Mixed_mesh_3/internal/boundary/assemble_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/boundary/lost_cells.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/coarsen.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/optimize_bounded.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/Candidate.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/Misfit.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/Tolerance_search.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/base_level.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/stage_scopes.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/thin_cells.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/unreached_cells.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Located_octree.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Refinement_sequence.h>
#include <CGAL/Mixed_mesh_3/internal/octree/fill_vertex_budget.h>
#include <CGAL/Mixed_mesh_3/internal/octree/place_lattice.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/Any_visitor.h>
#include <CGAL/Mixed_mesh_3/internal/surface/Sharp_features.h>
#include <CGAL/Mixed_mesh_3/split_to_tetrahedra.h>
#include <CGAL/Mixed_mesh_criteria_3.h>
#include <CGAL/Mixed_mesh_result_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The stages in their order. The octree is refined, and what follows is tried, until the budget is full.
class Driver
{
  const Mixed_mesh_criteria_3& m_criteria;
  Any_visitor& m_visitor;
  const Located_octree m_root; // nothing but the root
  Located_octree m_octree;
  const double m_radius; // of the region
  const Lattice_on_surface m_lattice;
  Candidate m_best;
  std::vector<Octree::Node_index> m_lost;
  std::optional<Located_octree> m_thin_start;  // walls and gaps are resolved
  std::optional<Located_octree> m_right_start; // on the way there, the topology was right
  bool m_are_gaps_wider = false;
  bool m_keeps_topology = false; // while the budget is filled
  bool m_is_stopped = false;     // by the visitor, which is not asked again then
  Mixed_mesh_result_3 m_result;
  Tolerance_search m_tolerance_search;

  // Cells for a wall, times what should suffice: lucky ones take less. And where they shall have volume, too:
  // tubes of two cells lose an eighth of it.
  static constexpr std::array<double, 4> strictnesses{0.7, 1, 1.4, 2},
    strictnesses_for_volume{2, 1.4, 1, 0.7};
  // Of the budget: how many vertices a mesh may have that is coarsened to it.
  static constexpr double finer_multiple = 20;
  // Of its boundary vertices, before it is: those off the surface go first.
  static constexpr double tolerated_off = 0.2;

public:
  /// \param root the octree with nothing but its root
  Driver(const Located_octree& root, const Mixed_mesh_criteria_3& criteria, Any_visitor& visitor)
    : m_criteria(criteria), m_visitor(visitor), m_root(root), m_octree(m_root),
      m_radius(mean_radius_of_region(m_root)), m_lattice(root.cell_traits().lattice_on_surface()),
      m_tolerance_search(m_root, criteria, visitor, m_result)
  {
  }

  Driver(const Driver&) = delete; // the search refers to members
  Driver& operator=(const Driver&) = delete;

  Mixed_mesh_result_3 operator()(Core_mesh& mesh)
  {
    m_result.tolerance = tolerance();
    {
      const Stage_scope scope(m_visitor, Stage::OCTREE);
      if(!fill_lattice()) {
        if(m_result.tolerance > 0)
          m_tolerance_search.run();
        if(!m_tolerance_search.is_stopped())
          fill_budget_at_first();
      }
    }
    Misfit misfit = Misfit::of_no_mesh();
    if(!may_resolve_thin_parts() || !resolve_topology(mesh, misfit)) {
      make_mesh(mesh);
      misfit = misfit_of(mesh);
      if(may_resolve_thin_parts())
        improve_thin_parts(mesh, misfit);
    }
    note(misfit);
    return m_result;
  }

private:
  void fill_budget_at_first()
  {
    if(m_criteria.thin_parts() == Thin_parts::FIRST)
      resolve_thin_parts(true);
    fill_budget();
  }

  // From the octree.
  void make_mesh(Core_mesh& mesh)
  {
    mesh.clear();
    describe();
    if(!m_result.has_mesh())
      return;
    {
      const Stage_scope scope(m_visitor, Stage::ASSEMBLY);
      mark_sheets();
      assemble_mesh(m_octree, m_best.mesh, m_best.boundary, mesh);
      if(m_criteria.only_tetrahedra())
        mesh = split_to_tetrahedra(mesh);
    }
    if(m_criteria.fit_to_surface() && !m_result.is_kept) {
      const Stage_scope scope(m_visitor, Stage::OPTIMIZATION);
      optimize(mesh);
    }
    note_lost_cells(mesh);
    if(!m_result.is_lattice_on_surface)
      note_share_filled(mesh.number_of_vertices());
  }

  bool may_resolve_thin_parts() const
  {
    return m_criteria.thin_parts() == Thin_parts::WHERE_NEEDED
           && m_root.domain().subdomain_indices().size() == 1;
  }

  // What the octree is like; the boundary is not fitted yet.
  struct State
  {
    Located_octree octree;
    Candidate best;
    std::vector<Octree::Node_index> lost;
    Mixed_mesh_result_3 result;
    bool are_gaps_wider;
  };

  State state() const { return {m_octree, m_best, m_lost, m_result, m_are_gaps_wider}; }

  void restore(State s)
  {
    m_octree = std::move(s.octree);
    m_best = std::move(s.best);
    m_lost = std::move(s.lost);
    m_result = s.result;
    m_are_gaps_wider = s.are_gaps_wider;
  }

  Misfit misfit_on_lattice() const
  {
    return m_best.number_of_vertices == 0 ? Misfit::of_no_mesh()
                                          : misfit_on_lattice(m_octree, m_best, m_lost.size());
  }

  Misfit misfit_on_lattice(const Located_octree& octree, const Candidate& candidate, std::size_t lost) const
  {
    Core_mesh mesh;
    assemble_mesh(octree, candidate.mesh, candidate.boundary, mesh);
    return Misfit(mesh, m_root.domain(), false, lost, 0);
  }

  // Fitting does not change the topology. Where that is wrong on the lattice, the budget is spent on thin
  // parts first; if it does not suffice, a finer mesh is coarsened to it.
  // \return whether the mesh is made
  bool resolve_topology(Core_mesh& mesh, Misfit& misfit)
  {
    if(m_result.is_lattice_on_surface || m_best.is_stopped || m_tolerance_search.is_stopped())
      return false;
    const Misfit before = misfit_on_lattice();
    if(before.is_topology_right())
      return false;
    State best = state();
    {
      const Stage_scope scope(m_visitor, Stage::OCTREE);
      resolve_thin_parts(false);
      if(m_thin_start)
        fill_budget();
      if(m_right_start && !m_best.is_stopped && misfit_on_lattice().is_topology_wrong()) {
        m_thin_start = m_right_start;
        m_keeps_topology = true;
        fill_budget();
        m_keeps_topology = false;
      }
    }
    if(m_is_stopped)
      return stop_at(std::move(best));
    const Misfit within_budget = misfit_on_lattice();
    const std::size_t needed = m_result.number_of_vertices_for_thin_parts;
    if(within_budget < before)
      best = state();
    if(!within_budget.is_topology_right()) {
      improve_by_finer_octree(mesh, misfit);
      if(m_is_stopped)
        return stop_at(std::move(best));
      if(misfit.is_topology_right())
        return true;
    }
    restore(std::move(best));
    m_result.number_of_vertices_for_thin_parts = needed;
    make_mesh(mesh);
    misfit = misfit_of(mesh);
    if(within_budget.is_topology_right())
      improve_by_finer_octree(mesh, misfit);
    return true;
  }

  // The mesh is not made: what is kept of it is on the lattice.
  bool stop_at(State s)
  {
    restore(std::move(s));
    m_best.is_stopped = true;
    return false;
  }

  // Once more, if what there is has lost something, or too much of its volume; then from a finer mesh.
  void improve_thin_parts(Core_mesh& mesh, Misfit& misfit)
  {
    const bool can_be_better = m_result.status == Mixed_mesh_status::EMPTY
                               || (m_result.has_mesh() && !m_result.is_kept);
    if(!can_be_better)
      return;
    if(!misfit.is_none()) {
      const Mixed_mesh_result_3 result = m_result;
      Core_mesh other;
      {
        const Stage_scope scope(m_visitor, Stage::OCTREE);
        resolve_thin_parts(misfit.is_of_volume_only());
        if(m_thin_start)
          fill_budget();
      }
      if(m_thin_start)
        make_mesh(other);
      const Misfit other_misfit = misfit_of(other);
      if(m_is_stopped || !(other_misfit < misfit)) {
        const std::size_t needed = m_result.number_of_vertices_for_thin_parts;
        m_result = result;
        m_result.number_of_vertices_for_thin_parts = needed;
      } else {
        mesh = std::move(other);
        misfit = other_misfit;
      }
    }
    improve_by_finer_octree(mesh, misfit);
  }

  // With more and more vertices, until nothing is wrong; the best mesh is taken, or, if the run is stopped,
  // what there was.
  void improve_by_finer_octree(Core_mesh& mesh, Misfit& misfit)
  {
    constexpr int most_trials = 3;
    if(m_is_stopped || !m_criteria.fit_to_surface() || m_root.domain().has_sheets())
      return;
    const std::size_t most = std::size_t(finer_multiple * double(m_criteria.maximal_number_of_vertices()));
    std::size_t least = budget() + budget() / 4;
    const Mixed_mesh_result_3 result_before = m_result;
    Mixed_mesh_result_3 result = m_result;
    std::optional<Core_mesh> better;
    Misfit best = misfit;
    for(int trial = 0; trial < most_trials && !best.is_right(); ++trial) {
      if(!find_finer_octree(least, most, true) && !find_finer_octree(least, most, false))
        break;
      least = 2 * m_best.number_of_vertices;
      Core_mesh other;
      make_coarsened_mesh(other);
      if(m_is_stopped)
        break;
      const Misfit other_misfit = misfit_of(other);
      if(other_misfit < best) {
        better = std::move(other);
        best = other_misfit;
        result = m_result;
      }
    }
    m_result = m_is_stopped ? result_before : result;
    if(better && !m_is_stopped) {
      mesh = std::move(*better);
      misfit = best;
    }
  }

  // An octree with which the topology is right: with cells as small as walls and gaps ask for, or with all
  // cells at the surface smaller. It becomes the best.
  bool find_finer_octree(std::size_t least, std::size_t most, bool only_thin)
  {
    const Stage_scope scope(m_visitor, Stage::OCTREE);
    constexpr double cells_for_a_vertex = 2; // at most, nearly
    Located_octree octree = m_root;
    m_are_gaps_wider = only_thin;
    if(!refine_to_level(octree, coarsest_level(), most))
      return false;
    for(int level = coarsest_level(); level < Octree::max_level; ++level) {
      std::vector<Octree::Node_index> leaves;
      if(only_thin)
        leaves = thin_cells(octree, level, 1);
      else
        for(Octree::Node_index n : octree.leaves_to_refine(level, false))
          if(octree.side(n) == ON_BOUNDARY)
            leaves.push_back(n);
      if(leaves.empty())
        continue;
      octree.refine(leaves);
      if(double(octree.number_of_cells()) > cells_for_a_vertex * double(most))
        return false;
      Candidate candidate = try_octree(octree);
      if(candidate.is_stopped || candidate.number_of_vertices > most)
        return false;
      if(candidate.number_of_vertices < least || !candidate.is_manifold()
         || misfit_on_lattice(octree, candidate, 0).is_topology_wrong())
        continue;
      take(std::move(octree), std::move(candidate));
      return true;
    }
    return false;
  }

  // From the octree that is finer than the budget: once its boundary is on the surface, vertices are removed
  // until the budget is met.
  void make_coarsened_mesh(Core_mesh& mesh)
  {
    mesh.clear();
    describe();
    if(!m_result.has_mesh())
      return;
    const Core_mesh fine = roughly_fitted_mesh();
    const Mixed_mesh_result_3 result = m_result;
    coarsen_and_optimize(fine, Coarsening_goal::SHAPE, mesh);
    if(m_is_stopped || !m_result.has_mesh())
      return;
    const Misfit first = misfit_of(mesh);
    if(!first.is_volume_wrong())
      return;
    const Mixed_mesh_result_3 first_result = m_result;
    m_result = result;
    Core_mesh other;
    coarsen_and_optimize(fine, Coarsening_goal::VOLUME, other);
    if(!m_is_stopped && m_result.optimization.number_of_elements_above_bound == 0 && misfit_of(other) < first)
      mesh = std::move(other);
    else
      m_result = first_result;
  }

  Core_mesh roughly_fitted_mesh()
  {
    Core_mesh fine;
    {
      const Stage_scope scope(m_visitor, Stage::ASSEMBLY);
      Core_mesh mixed;
      assemble_mesh(m_octree, m_best.mesh, m_best.boundary, mixed);
      fine = split_to_tetrahedra(mixed);
    }
    const Stage_scope scope(m_visitor, Stage::OPTIMIZATION);
    const auto rough = Mixed_mesh_optimization_criteria_3()
                         .quality_bound(m_criteria.quality_bound())
                         .sharp_angle(m_criteria.sharp_angle())
                         .number_of_rounds(1);
    optimize_bounded(
      fine, m_root.domain(), Concurrency::with_threads(rough, Concurrency::number_of_threads(m_criteria)),
      Aspect_ratio_quality_3(), [this] { return go_on(); }, tolerated_off);
    return fine;
  }

  // \param mesh empty; stays so if edges that may be collapsed do not suffice
  void coarsen_and_optimize(const Core_mesh& fine, Coarsening_goal goal, Core_mesh& mesh)
  {
    const Stage_scope scope(m_visitor, Stage::OPTIMIZATION);
    Core_mesh coarse = fine;
    if(m_is_stopped || !coarsen_to(coarse, budget(), goal))
      return;
    m_result.is_lattice_on_surface = false;
    m_result.number_of_vertices_needed = coarse.number_of_vertices();
    m_result.number_of_transition_vertices = m_result.number_of_boundary_vertices_inserted = 0;
    m_result.number_of_vertices_in_region = vertices_in_region(coarse);
    mesh = std::move(coarse);
    m_result.number_of_collapsed_vertices = fine.number_of_vertices() - mesh.number_of_vertices();
    const Mixed_mesh_status status = m_result.status;
    optimize(mesh);
    remove_vertices_off(mesh, status);
    note_lost_cells(mesh);
    note_share_filled(mesh.number_of_vertices());
  }

  // \return whether it has so few vertices then
  bool coarsen_to(Core_mesh& mesh, std::size_t number_of_vertices,
                  Coarsening_goal goal = Coarsening_goal::SHAPE)
  {
    const double radius = m_root.is_region_everywhere() ? 0 : m_criteria.grading() * m_radius;
    return coarsen(
             mesh, m_root.domain(), number_of_vertices, m_criteria.quality_bound(), radius,
             [this] { return go_on(); }, goal)
           && !m_is_stopped;
  }

  // A mesh of tetrahedra with a few boundary vertices off the surface may do without these.
  // \param status before the optimization
  void remove_vertices_off(Core_mesh& mesh, Mixed_mesh_status status)
  {
    const std::size_t off = number_off();
    if(off == 0 || m_is_stopped || !m_result.has_mesh())
      return;
    Core_mesh other = mesh;
    const Mixed_mesh_result_3 result = m_result;
    m_result.status = status;
    m_result.number_of_collapsed_vertices += off;
    if(coarsen_to(other, mesh.number_of_vertices() - off))
      optimize(other);
    if(!m_is_stopped && other.number_of_vertices() > 0 && number_off() < off)
      mesh = std::move(other);
    else
      m_result = result;
  }

  static std::size_t vertices_in_region(const Core_mesh& mesh)
  {
    std::vector<std::uint8_t> is_in_region(mesh.number_of_vertices(), 0);
    for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
      if(mesh.attributes(e).is_in_region)
        for(Vertex_index v : mesh.element(e))
          is_in_region[v] = 1;
    return std::size_t(std::count(is_in_region.begin(), is_in_region.end(), 1));
  }

  // In the result. The volume of a mesh that is not fitted is larger than that of the domain, and its status
  // is left to what fits it.
  void note(const Misfit& misfit)
  {
    m_result.shells_of_domain = misfit.shells_of_domain();
    m_result.shells = misfit.shells();
    if(m_result.is_kept || !m_result.has_mesh() || !m_criteria.fit_to_surface())
      return;
    if(misfit.is_topology_wrong())
      m_result.status = worse(m_result.status, Mixed_mesh_status::TOPOLOGY_DIFFERS);
    else if(misfit.is_volume_wrong())
      m_result.status = worse(m_result.status, Mixed_mesh_status::VOLUME_DIFFERS);
  }

  Misfit misfit_of(const Core_mesh& mesh) const
  {
    if(mesh.number_of_elements() == 0)
      return Misfit::of_no_mesh();
    return Misfit(mesh, m_root.domain(), m_criteria.fit_to_surface(), m_result.number_of_lost_cells,
                  number_off());
  }

  // Of the boundary vertices of the mesh that was optimized last.
  std::size_t number_off() const
  {
    const Mixed_mesh_optimization_result_3& fit = m_result.optimization;
    return fit.number_of_boundary_vertices - fit.number_of_arrived_vertices;
  }

  // Where the topology is wrong, with more and more cells for a wall or a gap, until it is right. Where only
  // the volume is, with as many as the budget has room for.
  void resolve_thin_parts(bool is_for_volume)
  {
    Located_octree start = m_root;
    m_thin_start.reset();
    m_right_start.reset();
    if(!refine_to_level(start, coarsest_level(), budget()))
      return;
    m_tolerance_search.split_far_cells(start);
    m_are_gaps_wider = true;
    Misfit best = Misfit::of_no_mesh();
    for(const double strictness : is_for_volume ? strictnesses_for_volume : strictnesses) {
      Located_octree octree = start;
      std::optional<Misfit> misfit;
      const auto count_vertices = [&](const Located_octree& o) {
        const Candidate c = try_octree(o);
        const std::size_t n = c.number_of_vertices;
        if(!c.is_stopped && 0 < n && n <= budget()) {
          misfit = misfit_on_lattice(o, c, lost_cells(o, c.mesh, c.boundary).size());
          if(!misfit->is_topology_wrong())
            m_right_start = o;
        }
        return n;
      };
      const Thin_cell_splits splits = split_thin_cells(octree, strictness, budget(), count_vertices);
      m_result.number_of_vertices_for_thin_parts = splits.number_of_vertices;
      if(!misfit)
        continue; // not even one level fits, or there are no vertices
      if(*misfit < best || !m_thin_start) {
        best = *misfit;
        m_thin_start = std::move(octree);
      }
      if(is_for_volume ? splits.is_complete : !splits.is_complete || misfit->is_none())
        return;
    }
  }

  // Not before: sheets add no vertex.
  void mark_sheets()
  {
    if(m_root.domain().has_sheets()) {
      m_best.boundary = split_boundary(m_octree, m_best.mesh, m_criteria.boundary_mode(),
                                       Concurrency::number_of_threads(m_criteria),
                                       Sheet_layer(m_octree, m_best.mesh));
      m_result.number_of_lost_sheets = m_best.boundary.number_of_lost_sheets;
      if(m_result.number_of_lost_sheets > 0)
        m_result.status = worse(m_result.status, Mixed_mesh_status::PARTS_LOST);
    }
  }

  double share_of_bisections() const
  {
    return m_criteria.share_of_bisections_for(m_root.domain().subdomain_indices().size());
  }

  // What the octree may have; the rest is for the optimization.
  std::size_t budget() const
  {
    const std::size_t n = m_criteria.maximal_number_of_vertices();
    return n - std::size_t(share_of_bisections() * double(n));
  }

  // Smaller ones take too many vertices from the region, larger ones leave furrows unresolved: with 0.42,
  // brains of 660 to 10,000 vertices are nowhere farther than that from their surface, nearly.
  double tolerance() const
  {
    constexpr double share_of_edge = 0.42;
    if(m_criteria.tolerance() != Mixed_mesh_criteria_3::automatic)
      return m_criteria.tolerance();
    return share_of_edge * mean_edge();
  }

  // Of the cubes that the vertices of the budget have to serve.
  double mean_edge() const
  {
    return std::cbrt(volume_of_domain(m_root) / double(m_criteria.maximal_number_of_vertices()));
  }

  void optimize(Core_mesh& mesh)
  {
    m_visitor.before_fitting(mesh);
    const std::size_t rest = m_criteria.maximal_number_of_vertices() - mesh.number_of_vertices();
    const auto criteria = Mixed_mesh_optimization_criteria_3()
                            .tolerance(m_result.tolerance)
                            .quality_bound(m_criteria.quality_bound())
                            .sharp_angle(m_criteria.sharp_angle())
                            .number_of_bisections(share_of_bisections() > 0 ? rest : 0);
    const auto with_threads = Concurrency::with_threads(criteria, Concurrency::number_of_threads(m_criteria));
    m_result.optimization = optimize_bounded(mesh, m_root.domain(), with_threads, Aspect_ratio_quality_3(),
                                             [this] { return go_on(); });
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

  // Uniform cells between planes of the surface need nothing more.
  bool fill_lattice()
  {
    Located_octree octree = m_root;
    if(!m_lattice.is_uniform || !refine_to_level(octree, m_lattice.level, budget()))
      return false;
    Candidate candidate = try_octree(octree);
    const std::size_t n = candidate.number_of_vertices;
    if(n == 0 || n > m_criteria.maximal_number_of_vertices() || !candidate.is_manifold())
      return false;
    take(std::move(octree), std::move(candidate));
    m_result.base_level = m_lattice.level;
    m_result.number_of_vertices_needed = n;
    return m_result.is_lattice_on_surface = true;
  }

  void take(Located_octree octree, Candidate candidate)
  {
    m_octree = std::move(octree);
    m_best = std::move(candidate);
    m_lost = lost_cells(m_octree, m_best.mesh, m_best.boundary);
    m_result.number_of_cells = m_octree.number_of_cells();
  }

  int coarsest_level() const { return (std::max)(first_base_level(m_criteria), m_lattice.level); }

  // If no base level is given: coarser than the default if the budget demands it; finer, as far as the
  // budget allows, if much of a thin domain would have no elements.
  void fill_budget()
  {
    const bool is_automatic = m_criteria.base_level() == Mixed_mesh_criteria_3::automatic && !m_thin_start;
    const int coarsest = (std::max)(coarsest_automatic_base_level, m_lattice.level);
    int level = coarsest_level();
    const auto first_to_split = points_on_sharp_edges();
    for(int step = 0;; level += step) {
      Located_octree octree = m_thin_start ? *m_thin_start : m_root;
      Candidate candidate;
      const auto fill = [&](Located_octree& o) {
        return fill_vertex_budget(
          o, budget(), m_criteria.grading() * m_radius,
          [this](const Located_octree& tried) { return try_octree(tried); }, first_to_split);
      };
      if(m_thin_start) {
        candidate = fill(octree);
      } else if(refine_to_level(octree, level, budget())) {
        const Located_octree base = octree;
        m_tolerance_search.split_far_cells(octree);
        candidate = fill(octree);
        if(std::optional<Located_octree> other = octree_for_region_first(base, octree)) {
          Candidate other_candidate = fill(*other);
          if(!other_candidate.is_stopped && other_candidate.is_good()
             && other_candidate.number_of_vertices <= budget()) {
            octree = std::move(*other);
            candidate = std::move(other_candidate);
          }
        }
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
      take(std::move(octree), std::move(candidate));
      // without vertices, the last level that had too many tells more
      if(m_best.number_of_vertices != 0 || m_result.number_of_vertices_needed == 0) {
        m_result.base_level = level;
        m_result.number_of_vertices_needed = m_best.number_of_vertices;
      }
      const bool is_too_coarse = m_best.number_of_vertices == 0
                                 || double(m_lost.size())
                                      > tolerated_share_of_lost_cells * double(m_result.number_of_cells);
      if(m_best.is_stopped)
        return;
      if(is_automatic && is_above && level > coarsest)
        step = -1;
      else if(is_automatic && !is_above && step >= 0 && is_too_coarse && level < finest_automatic_base_level)
        step = 1;
      else
        return;
    }
  }

  // Cells that are split for fidelity that nobody asked for may take vertices from the region, but not a
  // level of its surface, where displacements are prescribed: at 2,000 vertices, that can cost half of the
  // accuracy.
  // \return the start with that level, and as many of those cells as there is room for, if it is needed
  std::optional<Located_octree> octree_for_region_first(const Located_octree& base,
                                                        const Located_octree& filled) const
  {
    constexpr double shares[] = {1, 0.5, 0.25, 0.125};
    constexpr double room = 0.97; // in cells, whose vertices are not counted yet
    if(m_criteria.tolerance() != Mixed_mesh_criteria_3::automatic || !m_tolerance_search.has_far_points()
       || m_root.is_region_everywhere() || m_root.domain().subdomain_indices().size() > 1)
      return std::nullopt;
    const std::size_t number_of_cells = filled.number_of_cells();
    Refinement_sequence sequence(base, m_criteria.grading() * m_radius);
    while(sequence.number_of_cells(sequence.number_of_steps()) < number_of_cells && sequence.extend()) {
    }
    std::size_t low = 0, high = sequence.number_of_steps();
    const auto level_after = [&](std::size_t steps) {
      return sequence.octree(steps).level_of_surface_in_region();
    };
    const int level = level_after(high);
    if(level <= filled.level_of_surface_in_region())
      return std::nullopt;
    while(low < high) {
      const std::size_t middle = low + (high - low) / 2;
      if(level_after(middle) < level)
        low = middle + 1;
      else
        high = middle;
    }
    const Located_octree start = sequence.octree(low);
    for(const double share : shares) {
      Located_octree far = base, octree = start;
      m_tolerance_search.split_far_cells(far, share);
      octree.refine_like(far);
      if(double(octree.number_of_cells()) < room * double(number_of_cells))
        return octree;
    }
    return start;
  }

  // Where there is no region, at a distance of half the edges that the budget allows, or less.
  std::vector<Located_octree::Point_3> points_on_sharp_edges() const
  {
    std::vector<Located_octree::Point_3> points;
    if(!m_root.is_region_everywhere())
      return points;
    const Sharp_edges edges = m_root.domain().sharp_edges(m_criteria.sharp_angle());
    if(edges.edges.empty())
      return points;
    const double size = mean_edge();
    const Sharp_features features(edges, size);
    for(const Feature_polyline& p : features.polylines()) {
      const int n = int(std::ceil(2 * p.length() / size));
      for(int i = 0; i <= n; ++i) {
        const Vec3 q = p.at(p.length() * i / n);
        points.emplace_back(q[0], q[1], q[2]);
      }
    }
    return points;
  }

  bool go_on()
  {
    m_is_stopped = m_is_stopped || !m_visitor.go_on();
    return !m_is_stopped;
  }

  Candidate try_octree(const Located_octree& octree)
  {
    Candidate c;
    c.is_stopped = m_is_stopped;
    if(m_is_stopped)
      return c;
    c = make_candidate(octree, m_criteria, m_visitor, m_are_gaps_wider ? Gap_rule::NORMALS : Gap_rule::NONE);
    m_is_stopped = c.is_stopped;
    bool is_wrong = (m_are_gaps_wider || m_keeps_topology) && c.number_of_vertices > 0
                    && misfit_on_lattice(octree, c, 0).is_topology_wrong();
    if(m_are_gaps_wider && is_wrong) {
      Candidate other = make_candidate(octree, m_criteria, m_visitor, Gap_rule::LINES);
      m_is_stopped = other.is_stopped;
      m_result.number_of_trials += !other.is_stopped;
      if(!m_is_stopped && other.number_of_vertices > 0 && other.is_manifold()
         && !misfit_on_lattice(octree, other, 0).is_topology_wrong()) {
        c = std::move(other);
        is_wrong = false;
      }
    }
    c.is_topology_wrong = m_keeps_topology && is_wrong;
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
    m_result.number_of_vertices_in_region = count_vertices_in_region();
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
    if(m_tolerance_search.is_stopped() || m_best.is_stopped) {
      m_result.is_kept = m_result.status < Status::BOUNDARY_NOT_MANIFOLD && m_criteria.keep_mesh_if_stopped();
      m_result.status = Status::STOPPED;
    }
  }

  // Cells without elements are lost, but for those that the boundary has come near to.
  void note_lost_cells(const Core_mesh& mesh)
  {
    const std::vector<Octree::Node_index> lost = m_criteria.fit_to_surface()
                                                   ? unreached_cells(m_octree, m_lost, mesh, mean_edge())
                                                   : m_lost;
    m_result.number_of_lost_cells = lost.size();
    m_result.lost_cells = Bbox_3();
    for(Octree::Node_index n : lost)
      m_result.lost_cells += m_root.domain().cell_box(m_octree.octree().corner(n), m_octree.octree().side(n));
    if(!lost.empty())
      m_result.status = worse(m_result.status, Mixed_mesh_status::PARTS_LOST);
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
