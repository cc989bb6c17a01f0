// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Conversion of the octree to a mesh whose boundary is on the surface, with a result that describes the mesh.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_MAKE_MESH_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_MAKE_MESH_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/Meshing_state.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/optimize_bounded.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/stage_scopes.h>
#include <CGAL/Mixed_mesh_3/internal/meshing/unreached_cells.h>
#include <CGAL/Mixed_mesh_3/internal/surface/Sharp_features.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/split_to_tetrahedra.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Number of vertices in the region. The leaf of each vertex tells whether the vertex is in the region; a
/// query is made only where the leaf meets the region's surface.
inline std::size_t count_vertices_in_region(const Meshing_state& s)
{
  std::size_t count = 0;
  for(Vertex_index v = 0; v < s.best.boundary.is_used.size(); ++v)
    count += s.best.boundary.is_used[v]
             && s.octree.is_in_region(s.best.mesh.vertices[v], s.best.mesh.leaves[v]);
  return count;
}

/// Describes the cells of the octree in the result.
/// \return whether some meet the region
inline bool describe_cells(Meshing_state& s)
{
  const Octree& octree = s.octree.octree();
  bool meets_region = false;
  s.result.number_of_cells = s.octree.number_of_cells();
  for(Octree::Node_index n = 0; n < octree.size(); ++n)
    if(octree.is_leaf(n) && s.octree.meets_domain(n)) {
      s.result.deepest_level = (std::max)(s.result.deepest_level, octree.level(n));
      meets_region = meets_region || s.octree.is_in_region(n);
    }
  return meets_region;
}

/// Describes the octree, and the defects of its mesh on the lattice, in the result.
inline void describe_octree(Meshing_state& s)
{
  const bool meets_region = describe_cells(s);
  s.result.number_of_vertices_in_region = count_vertices_in_region(s);
  const std::vector<std::uint8_t>& is_used = s.best.boundary.is_used;
  s.result.number_of_transition_vertices = std::size_t(
    std::count(is_used.begin() + std::ptrdiff_t(s.best.mesh.first_inserted_vertex),
               is_used.end() - std::ptrdiff_t(s.best.boundary.number_of_inserted_vertices), 1));
  s.result.number_of_boundary_vertices_inserted = s.best.boundary.number_of_inserted_vertices;
  s.result.number_of_relabeled_vertices = s.best.boundary.number_of_relabeled_vertices;

  using Status = Mixed_mesh_status;
  const std::size_t n = s.best.number_of_vertices;
  const auto note = [&s](bool is_so, Status status) {
    if(is_so)
      s.result.status = worse_status(s.result.status, status);
  };
  s.result.status = Status::SUCCESS;
  note(s.result.number_of_vertices_needed > s.criteria.maximal_number_of_vertices(),
       Status::BUDGET_TOO_SMALL);
  note(n == 0, Status::EMPTY);
  note(!meets_region, Status::REGION_NOT_MET);
  note(!s.best.is_manifold(), Status::BOUNDARY_NOT_MANIFOLD);
  if(s.tolerance_search.is_stopped() || s.best.is_stopped) {
    s.result.is_kept = s.result.status < Status::BOUNDARY_NOT_MANIFOLD && s.criteria.keep_mesh_if_stopped();
    s.result.status = Status::STOPPED;
  }
}

/// Marks sheets in the best mesh only, as they add no vertex.
inline void mark_sheets(Meshing_state& s)
{
  if(!s.root.domain().has_sheets())
    return;
  s.best.boundary = split_boundary(s.octree, s.best.mesh, s.criteria.boundary_mode(),
                                   s.criteria.number_of_threads, Sheet_layer(s.octree, s.best.mesh));
  s.result.number_of_lost_sheets = s.best.boundary.number_of_lost_sheets;
  if(s.result.number_of_lost_sheets > 0)
    s.result.status = worse_status(s.result.status, Mixed_mesh_status::PARTS_LOST);
}

/// Notes lost cells: cells without elements, except those that the boundary has come near to.
inline void note_lost_cells(Meshing_state& s, const Core_mesh& mesh)
{
  const std::vector<Octree::Node_index> lost = s.criteria.fit_to_surface()
                                                 ? unreached_cells(s.octree, s.lost, mesh, s.mean_edge())
                                                 : s.lost;
  s.result.number_of_lost_cells = lost.size();
  s.result.lost_cells = Bbox_3();
  for(Octree::Node_index n : lost)
    s.result.lost_cells += s.root.domain().cell_box(s.octree.octree().corner(n), s.octree.octree().side(n));
  if(!lost.empty())
    s.result.status = worse_status(s.result.status, Mixed_mesh_status::PARTS_LOST);
}

/// Notes the share of the budget that is filled. The budget counts as filled if the mesh has most of the
/// vertices of the whole budget, or of the part that is not reserved for a later optimization.
inline void note_share_filled(Meshing_state& s, std::size_t n)
{
  const std::size_t whole = s.criteria.fit_to_surface() ? s.criteria.maximal_number_of_vertices()
                                                        : s.budget();
  if(double(n) < Mixed_mesh_criteria_3::full_share * double(whole))
    s.result.status = worse_status(s.result.status, Mixed_mesh_status::BUDGET_NOT_FILLED);
}

/// Brings the boundary onto the surface, and notes the result; the mesh is cleared if it is not kept.
/// \param followed sharp features that the mesh follows already
inline void optimize_boundary(Meshing_state& s, Core_mesh& mesh, Followed_features* followed = nullptr)
{
  s.visitor.before_fitting(mesh);
  s.result.quality_bound = s.quality_bound;
  const std::size_t rest = s.criteria.maximal_number_of_vertices() - mesh.number_of_vertices();
  const auto criteria = Mixed_mesh_optimization_criteria_3()
                          .tolerance(s.result.tolerance)
                          .quality_bound(s.quality_bound)
                          .sharp_angle(s.criteria.sharp_angle())
                          .number_of_bisections(s.share_of_bisections() > 0 ? rest : 0);
  s.result.optimization = optimize_bounded(
    mesh, s.root.domain(), {criteria, s.criteria.number_of_threads}, Aspect_ratio_quality_3(),
    [&s] { return s.go_on(); }, {}, followed);
  const bool is_only_wished = is_tolerance_wished(s.criteria)
                              && s.result.optimization.status
                                   == Mixed_mesh_optimization_status::TOLERANCE_NOT_REACHED;
  if(!is_only_wished)
    s.result.status = worse_status(s.result.status, status_of(s.result.optimization.status));
  s.result.is_kept = s.result.status == Mixed_mesh_status::STOPPED && s.keeps_mesh_if_stopped();
  if(!s.result.has_mesh())
    mesh.clear();
}

/// The boundary of uniform cells between planes of the surface is the surface: vertices are at their final
/// places, also where walls need cells that are flatter than the bound, as no move could mend these.
inline void note_boundary_on_surface(Meshing_state& s, const Core_mesh& mesh)
{
  const Sharp_features features(s.root.domain().sharp_edges(s.criteria.sharp_angle()), s.mean_edge());
  Mixed_mesh_optimization_result_3& r = s.result.optimization = {};
  r.status = Mixed_mesh_optimization_status::SUCCESS;
  r.number_of_boundary_vertices = r.number_of_arrived_vertices = boundary_vertices(mesh).size();
  r.length_of_sharp_edges = r.length_of_sharp_edges_kept = features.length();
  r.number_of_corners = r.number_of_corners_kept = features.number_of_real_corners();
  r.quality_bound = s.criteria.quality_bound();
  s.result.quality_bound = (std::max)(r.quality_bound, quality_statistics(mesh).back().maximum);
}

/// Makes the mesh of the octree.
inline void make_mesh(Meshing_state& s, Core_mesh& mesh)
{
  mesh.clear();
  s.make_best_again();
  describe_octree(s);
  if(!s.result.has_mesh())
    return;
  {
    const Stage_scope scope(s.visitor, Stage::ASSEMBLY);
    mark_sheets(s);
    mesh = assembled_mesh(s.octree, s.best);
    s.best.release();
    if(s.criteria.only_tetrahedra())
      mesh = split_to_tetrahedra(mesh);
  }
  if(s.criteria.fit_to_surface() && !s.result.is_kept) {
    const Stage_scope scope(s.visitor, Stage::OPTIMIZATION);
    const bool is_final = s.result.is_lattice_on_surface && !s.criteria.only_tetrahedra()
                          && !s.root.domain().has_sheets();
    if(is_final) {
      s.visitor.before_fitting(mesh);
      note_boundary_on_surface(s, mesh);
    } else
      optimize_boundary(s, mesh);
  }
  note_lost_cells(s, mesh);
  if(!s.result.is_lattice_on_surface)
    note_share_filled(s, mesh.number_of_vertices());
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_MAKE_MESH_H
