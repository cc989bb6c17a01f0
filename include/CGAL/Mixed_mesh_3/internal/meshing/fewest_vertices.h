// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The smallest budget with which a mesh is within its tolerance.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_FEWEST_VERTICES_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_FEWEST_VERTICES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Core_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/run_stages.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Located_octree.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/Any_visitor.h>
#include <CGAL/Mixed_mesh_criteria_3.h>
#include <CGAL/Mixed_mesh_result_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

// The shape of a brain is lost with fewer vertices: with 60 it lacks a tenth of its volume, with 30 a sixth,
// with 120 a twentieth.
constexpr std::size_t least_budget = 60;

/// Whether a mesh is within the tolerance, and has topology and volume of the domain.
inline bool meets_all_criteria(const Mixed_mesh_result_3& r)
{
  return (r.status == Mixed_mesh_status::SUCCESS || r.status == Mixed_mesh_status::BUDGET_NOT_FILLED)
         && r.optimization.largest_distance <= share_of_tolerance * r.tolerance;
}

/// The budget that is tried first: a quarter of the budget whose default tolerance is the tolerance of the
/// criteria; a brain needs about that quarter.
inline std::size_t first_budget(const Located_octree& root, const Mixed_mesh_criteria_3& criteria)
{
  constexpr double share = 0.25;
  const double edge = criteria.tolerance() / share_of_edge_tolerated;
  const double n = share * volume_of_domain(root) / (edge * edge * edge);
  return std::size_t(std::clamp(n, double(least_budget), double(criteria.maximal_number_of_vertices())));
}

/*!
Makes meshes with more and more vertices until a mesh is as wanted, or with fewer and fewer until a mesh is
not, and with budgets in between, until the fewest vertices that suffice are known to a tenth. The mesh with
the fewest vertices is taken; if even the largest budget does not suffice, the mesh of that budget is taken.

\par Complexity
Some five to ten meshes
*/
inline Mixed_mesh_result_3 run_with_fewest_vertices(const Located_octree& root,
                                                    const Meshing_criteria& criteria, Any_visitor& visitor,
                                                    Core_mesh& mesh)
{
  constexpr double step = 2, near_enough = 1.1;
  const std::size_t most = criteria.maximal_number_of_vertices();
  std::size_t sufficient_budget = 0, insufficient_budget = 0, trials = 0; // 0: not known
  std::size_t budget = first_budget(root, criteria);
  Mixed_mesh_result_3 best;
  for(;;) {
    Core_mesh trial;
    Meshing_criteria with_budget = criteria;
    with_budget.maximal_number_of_vertices(budget);
    const Mixed_mesh_result_3 result = run_stages(root, with_budget, visitor, trial);
    const bool is_sufficient = meets_all_criteria(result);
    if(is_sufficient || sufficient_budget == 0) {
      best = result;
      mesh = std::move(trial);
    }
    best.number_of_budgets = ++trials;
    if(result.status == Mixed_mesh_status::STOPPED)
      return best;
    if(is_sufficient)
      sufficient_budget = (std::min)(budget, mesh.number_of_vertices());
    else
      insufficient_budget = budget;
    if(sufficient_budget > 0 && insufficient_budget > 0) {
      if(double(sufficient_budget) <= near_enough * double(insufficient_budget))
        return best;
      budget = std::size_t(std::sqrt(double(sufficient_budget) * double(insufficient_budget)));
    } else if(sufficient_budget > 0) {
      if(sufficient_budget <= least_budget)
        return best;
      budget = (std::max)(least_budget, std::size_t(double(sufficient_budget) / step));
    } else {
      if(insufficient_budget >= most)
        return best;
      budget = (std::min)(most, std::size_t(step * double(insufficient_budget)));
    }
  }
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_FEWEST_VERTICES_H
