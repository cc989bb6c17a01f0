// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mixed_mesh_3/examine.h"

#include "mixed_mesh_3/verdict.h"

#include <CGAL/Mixed_mesh_3/certify_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/elements/element_measures.h>
#include <CGAL/Mixed_mesh_3/internal/elements/element_points.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/quality_bound.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace mm3 = CGAL::Mixed_meshes_3;

namespace {

// A measure of elements by their values, for several statistics of one measurement.
auto known(const std::vector<double>& values)
{
  return [&values](const Mesh&, std::size_t e) { return values[e]; };
}

Shapes shapes_of(const Mesh& mesh)
{
  std::vector<double> smallest(mesh.number_of_elements()), largest(mesh.number_of_elements());
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e) {
    const mm3::Element_view element = mesh.element(e);
    const auto angles = mm3::internal::dihedral_angles(element.kind(),
                                                       mm3::internal::element_points(mesh, element));
    smallest[e] = angles.smallest;
    largest[e] = angles.largest;
  }
  return {mm3::quality_statistics(mesh, mm3::scaled_jacobian), mm3::quality_statistics(mesh, known(smallest)),
          mm3::quality_statistics(mesh, known(largest)), mm3::quality_statistics(mesh, mm3::quad_warp)};
}

// A sentence with the unit of volumes, which the library does not know, where the program knows the unit.
std::string with_unit(std::string sentence, bool is_in_mm)
{
  const std::string unknown = "cubic units";
  const std::size_t at = sentence.find(unknown);
  return at != std::string::npos && is_in_mm ? sentence.replace(at, unknown.size(), "mm^3") : sentence;
}

// The differences in units that the program knows.
Topology topology_with_units(const Boundary& boundary, const Surface& surface, bool is_fitted, bool is_in_mm,
                             CGAL::Mixed_mesh_result_3& result)
{
  Topology t = topology_of(boundary, surface, is_fitted, result.status);
  for(Difference& d : t.differences)
    d.sentence = with_unit(d.sentence, is_in_mm);
  return t;
}

std::vector<Check> checks_of_fidelity(const Outcome& outcome, Fit fit)
{
  std::vector<Check> checks{{"same topology as the surface", outcome.topology.is_same},
                            {"no part of the domain lost", outcome.result.number_of_lost_cells == 0}};
  if(fit != Fit::NONE) {
    checks.push_back({"volume within 5 % of the surface's", outcome.fidelity.has_right_volume()});
    checks.push_back({"boundary vertices on the surface", outcome.fidelity.vertices_off == 0});
    if(outcome.result.optimization.length_of_sharp_edges > 0)
      checks.push_back(
        {"sharp edges kept", share_of_sharp_edges(outcome.result) >= least_share_of_sharp_edges});
    if(fit == Fit::OPTIMIZATION && outcome.result.tolerance > 0)
      checks.push_back({"distance within the tolerance", !outcome.fidelity.misses(outcome.result.tolerance)});
  }
  return checks;
}

} // namespace

Aspect_ratios aspect_ratios_of(const Mesh& mesh)
{
  std::vector<double> ratios(mesh.number_of_elements());
  for(std::size_t e = 0; e < ratios.size(); ++e)
    ratios[e] = mm3::aspect_ratio_coefficient(mesh, e);
  return {mm3::quality_statistics(mesh, known(ratios), 0, 7),
          mm3::quality_statistics(mesh, known(ratios), 1.3, 7),
          mm3::histogram(mesh, known(ratios), histogram_edges())};
}

void examine(const Mesh& mesh, const Surface& surface, Surface_tree tree, const Meshing_options& options,
             Stage_log& log, Outcome& outcome)
{
  const bool is_fitted = options.fit() != Fit::NONE, is_in_mm = options.is_in_patient_space();
  Boundary boundary;
  mm3::Mesh_certificate certificate{log("checks", [&] {
    const mm3::internal::Examined_mesh examined = mm3::internal::examine_mesh(mesh);
    if(examined.defects.none()) {
      boundary = mm3::internal::boundary_triangles(mesh, examined.boundary);
      outcome.boundary_faces = examined.boundary.size();
    }
    return examined.defects;
  })};
  if(certificate.defects.none()) {
    std::size_t& self_intersections = certificate.number_of_self_intersections;
    log.together(
      options.threads,
      {{"distance to surface",
        [&] {
          outcome.fidelity = fidelity_of(mesh, boundary, surface, outcome.surface.volume, std::move(tree));
        }},
       {"checks", [&] { self_intersections = mm3::internal::number_of_self_intersections(boundary); }},
       {"topology",
        [&] {
          outcome.topology = topology_with_units(boundary, surface, is_fitted, is_in_mm, outcome.result);
        }},
       {"quality", [&] {
          outcome.after = aspect_ratios_of(mesh);
          outcome.shapes = shapes_of(mesh);
        }}});
  }
  outcome.fidelity.self_intersections = certificate.number_of_self_intersections;
  for(const mm3::Mesh_certificate::Check& check : certificate.checks())
    outcome.checks.push_back({check.name, check.holds});
  require_all(outcome.checks, certificate.number_of_self_intersections); // throws if there are defects
  require_volume(options, outcome);
  outcome.checks_of_fidelity = checks_of_fidelity(outcome, options.fit());

  outcome.mesh = facts_of(mesh);
  for(mm3::Element_index e = 0; e < mesh.number_of_elements(); ++e)
    outcome.elements_in_region += mesh.is_in_region(e);
  if(options.has_quality_bound())
    outcome.elements_above_bound = log("quality bound", [&] {
      return mm3::number_of_elements_above(mesh, options.largest_arc);
    });
  add_warnings(options, outcome);
  outcome.result.status = checked_status(outcome.result.status, outcome.fidelity, options.tolerance);
}
