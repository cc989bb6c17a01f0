// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mixed_mesh_3/examine.h"

#include "mixed_mesh_3/verdict.h"

#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/certify_mesh.h>
#include <CGAL/Mixed_mesh_3/fidelity.h>
#include <CGAL/Mixed_mesh_3/quality_bound.h>
#include <CGAL/Mixed_mesh_3/surface_distance.h>

#include <algorithm>

namespace mm3 = CGAL::Mixed_meshes_3;

namespace {

Shapes shapes_of(const Mesh& mesh)
{
  return {mm3::quality_statistics(mesh, mm3::scaled_jacobian),
          mm3::quality_statistics(mesh, mm3::smallest_dihedral_angle),
          mm3::quality_statistics(mesh, mm3::largest_dihedral_angle),
          mm3::quality_statistics(mesh, mm3::quad_warp)};
}

Distance distance_of(const mm3::One_sided_distance& d)
{
  return {d.distance, d.error, {d.from.x(), d.from.y(), d.from.z()}, {d.to.x(), d.to.y(), d.to.z()}};
}

// Measures the fidelity. \pre the boundary is a closed manifold
Fidelity fidelity_of(const Mesh& mesh, const Surface& surface, double volume_of_surface)
{
  const mm3::Hausdorff_distance distance = mm3::hausdorff_distance(mesh, surface);
  Fidelity f;
  f.from_mesh = distance_of(distance.from_mesh);
  f.from_surface = distance_of(distance.from_surface);
  f.volume_of_mesh = mm3::volume(mesh);
  f.volume_of_surface = volume_of_surface;
  f.vertices = mm3::boundary_vertices(mesh).size();
  f.vertices_off = mm3::number_of_vertices_off_surface(mesh, surface, on_surface);
  return f;
}

Solid solid_of(const mm3::Solid_topology& t)
{
  return {t.number_of_bodies, t.number_of_handles, t.number_of_cavities, t.volume};
}

// A sentence with the unit of volumes, which the library does not know, where the program knows the unit.
std::string with_unit(std::string sentence, const Options& options)
{
  const std::string unknown = "cubic units";
  const std::size_t at = sentence.find(unknown);
  return at != std::string::npos && options.is_in_patient_space()
           ? sentence.replace(at, unknown.size(), "mm^3")
           : sentence;
}

// Compares the topology. \pre the boundary is a closed manifold. Before the boundary is fitted, the cells
// around it add some volume.
Topology topology_of(const Mesh& mesh, const Surface& surface, const Options& options,
                     CGAL::Mixed_mesh_status& status)
{
  mm3::Solid_comparison c = mm3::compare_with_surface(mesh, surface, volume_tolerance);
  auto& d = c.differences;
  if(options.fit() == Fit::NONE)
    d.erase(std::remove_if(d.begin(), d.end(),
                           [](const auto& x) { return x.kind == mm3::Solid_difference_kind::VOLUME; }),
            d.end());
  status = mm3::worse_status(status, mm3::status_of(c));
  Topology t{solid_of(c.surface), solid_of(c.mesh), {}, c.has_same_topology()};
  for(const mm3::Solid_difference& x : d)
    t.differences.push_back({with_unit(x.sentence, options), {x.point.x(), x.point.y(), x.point.z()}});
  return t;
}

std::vector<Check> checks_of_fidelity(const Outcome& outcome, bool is_fitted)
{
  std::vector<Check> checks{{"same topology as the surface", outcome.topology.is_same},
                            {"no part of the domain lost", outcome.result.number_of_lost_cells == 0}};
  if(is_fitted) {
    checks.push_back({"volume within 5 % of the surface's",
                      std::abs(outcome.fidelity.ratio_of_volumes() - 1) <= volume_tolerance});
    checks.push_back({"boundary vertices on the surface", outcome.fidelity.vertices_off == 0});
  }
  return checks;
}

} // namespace

Aspect_ratios aspect_ratios_of(const Mesh& mesh)
{
  return {mm3::quality_statistics(mesh), mm3::quality_statistics(mesh, mm3::aspect_ratio_coefficient, 1.3, 7),
          mm3::histogram(mesh, mm3::aspect_ratio_coefficient, histogram_edges())};
}

void examine(const Mesh& mesh, const Surface& surface, const Options& options, Stage_log& log,
             Outcome& outcome)
{
  const mm3::Mesh_certificate certificate = log("checks", [&] { return mm3::certify_mesh(mesh); });
  if(certificate.defects.none())
    outcome.fidelity = log("distance to surface",
                           [&] { return fidelity_of(mesh, surface, outcome.surface.volume); });
  outcome.fidelity.self_intersections = certificate.number_of_self_intersections;
  for(const mm3::Mesh_certificate::Check& check : certificate.checks())
    outcome.checks.push_back({check.name, check.holds});
  require_all(outcome.checks, certificate.number_of_self_intersections);
  require_volume(options, outcome);
  outcome.topology = log("topology",
                         [&] { return topology_of(mesh, surface, options, outcome.result.status); });
  outcome.checks_of_fidelity = checks_of_fidelity(outcome, options.fit() != Fit::NONE);

  outcome.mesh = facts_of(mesh);
  outcome.boundary_faces = mm3::boundary_faces(mesh).size();
  for(mm3::Element_index e = 0; e < mesh.number_of_elements(); ++e)
    outcome.elements_in_region += mesh.is_in_region(e);
  if(options.has_quality_bound())
    outcome.elements_above_bound = log("quality bound", [&] {
      return mm3::number_of_elements_above(mesh, options.largest_arc);
    });
  add_warnings(options, outcome);
  if(options.tolerance > 0 && outcome.result.status == CGAL::Mixed_mesh_status::SUCCESS
     && outcome.fidelity.distance() > options.tolerance) // between the points that the library tested
    outcome.result.status = CGAL::Mixed_mesh_status::TOLERANCE_NOT_REACHED;
  log("quality", [&] {
    outcome.after = aspect_ratios_of(mesh);
    outcome.shapes = shapes_of(mesh);
  });
}
