// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/comparison.h"

#include "core/messages.h"

#include <CGAL/Mixed_mesh_3/fidelity.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/surface_distance.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace mm3 = CGAL::Mixed_meshes_3;
using Status = CGAL::Mixed_mesh_status;

namespace {

Distance distance_of(const mm3::One_sided_distance& d)
{
  return {d.distance, d.error, {d.from.x(), d.from.y(), d.from.z()}, {d.to.x(), d.to.y(), d.to.z()}};
}

Solid solid_of(const mm3::Solid_topology& t)
{
  return {t.number_of_bodies, t.number_of_handles, t.number_of_cavities, t.volume};
}

} // namespace

Fidelity fidelity_of(const Mesh& mesh, const Boundary& boundary, const Surface& surface,
                     double volume_of_surface, Surface_tree tree)
{
  constexpr double relative_error = 1e-4; // default of hausdorff_distance()
  const auto [distance, vertices_off] = mm3::internal::distances_from_surface(boundary, surface,
                                                                              relative_error, on_surface,
                                                                              std::move(tree));
  Fidelity f;
  f.vertices = boundary.points.size();
  f.vertices_off = vertices_off;
  f.from_mesh = distance_of(distance.from_mesh);
  f.from_surface = distance_of(distance.from_surface);
  f.volume_of_mesh = mm3::volume(mesh);
  f.volume_of_surface = volume_of_surface;
  return f;
}

Topology topology_of(const Boundary& boundary, const Surface& surface, bool is_fitted, Status& status)
{
  mm3::Solid_comparison c = mm3::internal::compare_boundary(boundary, surface, volume_tolerance);
  auto& d = c.differences;
  if(!is_fitted)
    d.erase(std::remove_if(d.begin(), d.end(),
                           [](const auto& x) { return x.kind == mm3::Solid_difference_kind::VOLUME; }),
            d.end());
  status = mm3::worse_status(status, mm3::status_of(c));
  Topology t{solid_of(c.surface), solid_of(c.mesh), {}, c.has_same_topology()};
  for(const mm3::Solid_difference& x : d)
    t.differences.push_back({x.sentence, {x.point.x(), x.point.y(), x.point.z()}});
  return t;
}

double share_of_sharp_edges(const CGAL::Mixed_mesh_result_3& result)
{
  const CGAL::Mixed_mesh_optimization_result_3& r = result.optimization;
  return r.length_of_sharp_edges > 0 ? r.length_of_sharp_edges_kept / r.length_of_sharp_edges : 1;
}

Status checked_status(Status status, const Fidelity& fidelity, double tolerance)
{
  return status == Status::SUCCESS && fidelity.misses(tolerance) ? Status::TOLERANCE_NOT_REACHED : status;
}

std::string reason_for_no_mesh(const CGAL::Mixed_mesh_result_3& result, const Input_names& names)
{
  switch(result.status) {
  case Status::BUDGET_TOO_SMALL:
    return names.budget + ": too small, the coarsest mesh of " + names.surface + " at base level "
           + std::to_string(result.base_level) + " has at least "
           + std::to_string(result.number_of_vertices_needed) + " vertices";
  case Status::EMPTY:
    return names.surface
           + ": too thin for this budget, no octree vertex is inside; try more vertices or a larger "
           + names.base_level;
  case Status::REGION_NOT_MET:
    return names.regions.size() == 1
             ? names.regions.front() + ": the region does not meet the domain of " + names.surface
             : names.surface + ": none of the regions meets the domain";
  case Status::STOPPED: return result.is_kept ? "" : "stopped before there was a mesh: nothing is written";
  case Status::BOUNDARY_NOT_MANIFOLD:
    return "the boundary is pinched at the border of the root cell; try another " + names.base_level;
  case Status::BUDGET_NOT_FILLED:
  case Status::TOLERANCE_NOT_REACHED:
  case Status::NOT_ALL_ARRIVED:
  case Status::VOLUME_DIFFERS:
  case Status::TOPOLOGY_DIFFERS:
  case Status::PARTS_LOST:
  case Status::SUCCESS: break;
  }
  return {};
}

std::string sentence_on_volume(double ratio, const Input_names& names)
{
  return names.surface + ": the mesh has " + as_part_of(ratio)
         + " the surface's volume: it is too coarse for the domain; try more vertices or a larger "
         + names.base_level + (names.tolerance.empty() ? "" : ", or " + names.tolerance);
}

std::string sentence_on_sharp_edges(const CGAL::Mixed_mesh_result_3& result, const Input_names& names)
{
  const double share = share_of_sharp_edges(result);
  if(share >= least_share_of_sharp_edges)
    return "";
  const auto& lost = result.optimization.lost_sharp_edges;
  const auto length = [](const std::vector<mm3::Vec3>& part) {
    double sum = 0;
    for(std::size_t i = 1; i < part.size(); ++i)
      sum += mm3::norm(part[i] - part[i - 1]);
    return sum;
  };
  const auto longest = std::max_element(lost.begin(), lost.end(),
                                        [&](const auto& a, const auto& b) { return length(a) < length(b); });
  return "only " + as_part_of(share) + " the length of the sharp edges of " + names.surface
         + " is kept, the rest is cut off"
         + (longest != lost.end() ? ", the longest part at " + place((*longest)[longest->size() / 2]) : "")
         + "; try more vertices";
}

std::string sentence_on_vertices_off(const Fidelity& fidelity, const Input_names& names)
{
  return std::to_string(fidelity.vertices_off) + " of " + std::to_string(fidelity.vertices)
         + " boundary vertices are not on " + names.surface
         + (names.quality_bound.empty()
              ? ": elements would be inverted"
              : ": elements would be worse than " + names.quality_bound + " allows, or inverted");
}

std::string sentence_on_lost_parts(const CGAL::Mixed_mesh_result_3& result, const Input_names& names)
{
  const CGAL::Bbox_3& b = result.lost_cells;
  std::ostringstream where;
  where << '[' << b.xmin() << ", " << b.xmax() << "] x [" << b.ymin() << ", " << b.ymax() << "] x ["
        << b.zmin() << ", " << b.zmax() << ']';
  return names.surface
         + ": parts thinner than a cell are lost: " + std::to_string(result.number_of_lost_cells)
         + " octree cells that they meet are away from the mesh, within " + where.str()
         + "; try more vertices or a larger " + names.base_level;
}

std::string sentence_on_tolerance(const Fidelity& fidelity, const std::string& option,
                                  const Input_names& names)
{
  const bool is_on_mesh = fidelity.from_mesh.distance > fidelity.from_surface.distance;
  const Distance& d = is_on_mesh ? fidelity.from_mesh : fidelity.from_surface;
  const std::string at = " at " + place(d.from) + " is " + rounded(d.distance) + " away from ";
  return option + ": not reached, "
         + (is_on_mesh ? "the mesh" + at + names.surface : names.surface + at + "the mesh")
         + "; try more vertices";
}

std::string reason_for_no_likeness(const Fidelity& fidelity, const Input_names& names)
{
  const double ratio = fidelity.ratio_of_volumes();
  return 0.5 <= ratio && ratio <= 1.5 ? "" : sentence_on_volume(ratio, names);
}
