// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// With a tolerance: which root of the octree leaves most vertices to the region.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_SEARCH_ROOT_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_SEARCH_ROOT_H

#include <CGAL/Mixed_mesh_3/internal/octree/place_lattice.h>
#include <CGAL/Mixed_mesh_criteria_3.h>
#include <CGAL/Mixed_mesh_result_3.h>

#include <CGAL/Bbox_3.h>

#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Whether the root of the octree is worth a search: it decides how many vertices are left for the region.
inline bool is_root_searched(const Mixed_mesh_criteria_3& criteria)
{
  return criteria.tolerance() > 0 && criteria.root_cell() == Root_cell::CUBE
         && criteria.maximal_number_of_vertices() <= largest_budget_to_place_lattice;
}

/// Whether a result is to be preferred: valid, then within the tolerance, then with more vertices in the
/// region (or, outside the tolerance, nearer to the surface).
inline bool is_better(const Mixed_mesh_result_3& a, const Mixed_mesh_result_3& b, double tolerance)
{
  const auto rank = [&](const Mixed_mesh_result_3& r) {
    const bool is_within = r.optimization.largest_distance <= tolerance;
    return std::make_tuple(r.has_mesh(), r.status != Mixed_mesh_status::NOT_ALL_ARRIVED, is_within,
                           is_within ? double(r.number_of_vertices_in_region)
                                     : -r.optimization.largest_distance);
  };
  return rank(a) > rank(b);
}

/// Of the roots that leave most vertices to the region, takes the one whose mesh is within the tolerance with
/// most vertices in the region, else nearest to it.
/// \param bbox of the domain
/// \param criteria with a tolerance
/// \param make `Mixed_mesh_result_3(root, criteria, mesh)`
/// \param mesh the result
template <class Make, class Mesh>
Mixed_mesh_result_3 search_root(const Bbox_3& bbox, const Mixed_mesh_criteria_3& criteria, const Make& make,
                                Mesh& mesh)
{
  Mesh trial;
  bool is_stopped = false;
  const std::size_t compared = vertices_to_compare_roots / criteria.maximal_number_of_vertices() + 1;
  const std::vector<Bbox_3> roots = best_roots(
    candidate_roots(bbox), compared, [&](const Bbox_3& root) -> std::size_t {
      if(is_stopped)
        return 0;
      const Mixed_mesh_result_3 result = make(
        root, Mixed_mesh_criteria_3(criteria).tolerance(0).fit_to_surface(false), trial);
      is_stopped = result.status == Mixed_mesh_status::STOPPED;
      return result.has_mesh() ? result.number_of_vertices_in_region : 0;
    });
  if(is_stopped) {
    mesh.clear();
    Mixed_mesh_result_3 result;
    result.status = Mixed_mesh_status::STOPPED;
    return result;
  }
  const Mixed_mesh_criteria_3 fitted = Mixed_mesh_criteria_3(criteria).fit_to_surface(true);
  Mixed_mesh_result_3 best = make(roots.front(), fitted, mesh);
  Bbox_3 best_root = roots.front();
  for(std::size_t i = 1; i < roots.size() && best.status != Mixed_mesh_status::STOPPED; ++i) {
    const Mixed_mesh_result_3 result = make(roots[i], fitted, trial);
    if(result.status == Mixed_mesh_status::STOPPED || is_better(result, best, criteria.tolerance())) {
      best = result;
      best_root = roots[i];
      std::swap(mesh, trial);
    }
  }
  if(!criteria.fit_to_surface() && best.has_mesh())
    return make(best_root, criteria, mesh);
  return best;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_SEARCH_ROOT_H
