// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "brain_shift/report.h"

#include "brain_shift/landmark_report.h"
#include "core/messages.h"
#include "core/report_json.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <string>
#include <vector>

namespace mm3 = CGAL::Mixed_meshes_3;

namespace {

Json describe_mesh(const std::string& file, const Outcome& outcome)
{
  Json report = {{"file", file}, {"vertices", outcome.mesh.vertices}, {"elements", outcome.mesh.elements}};
  add_kinds(outcome.mesh, report);
  report["volume"] = outcome.volume;
  return report;
}

Json describe(const Surface_facts& s)
{
  return {{"file", s.file}, {"triangles", s.triangles}, {"volume", s.volume}, {"repairs", s.repairs}};
}

Json describe(const Image_facts& image, const std::string& file)
{
  return {{"file", file},
          {"voxels", image.voxels},
          {"volume of a voxel", image.volume_of_voxel},
          {"world (NIfTI's number)", image.world},
          {"smallest value", image.smallest},
          {"largest value", image.largest},
          {"share of the mesh's vertices inside", image.share_inside}};
}

Json quantity(const Json& value, const char* unit) { return {{"value", value}, {"unit", unit}}; }

Json parameters_of(const Options& o)
{
  return {{"Young's modulus", quantity(o.material.young_modulus, "kPa")},
          {"Poisson's ratio", quantity(o.material.poisson_ratio, "1")},
          {"density", quantity(o.density, "g/cm^3")},
          {"density of the fluid", quantity(o.model.fluid_density, "g/cm^3")},
          {"level of the fluid",
           quantity(std::isfinite(o.model.fluid_level) ? Json(o.model.fluid_level) : Json(), "mm")},
          {"gravity", quantity(o.model.acceleration, "mm/s^2")},
          {"up", quantity(o.model.supports.up, "1")},
          {"fixed below", quantity(o.model.supports.fixed_below, "height")},
          {"slide below", quantity(o.model.supports.slide_below, "height")},
          {"fixed patches", o.patches.fixed},
          {"sliding patches", o.patches.sliding},
          {"touching patches", o.patches.touching},
          {"openings", o.patches.openings},
          {"slide beyond",
           quantity(std::isfinite(o.model.supports.slide_beyond) ? Json(o.model.supports.slide_beyond)
                                                                 : Json(),
                    "mm")},
          {"largest distance of control points", quantity(o.model.points.max_distance, "mm")},
          {"compliance of control points", quantity(o.model.points.compliance, "mm/mN")},
          {"radius of control points", quantity(o.model.points.radius, "mm")},
          {"rotations", o.model.corotational ? "finite (corotational elements)" : "small"},
          {"space of surfaces", space_of(o.surface_options)},
          {"interpolation between vertices",
           o.images.interpolation == mm3::Displacement_interpolation::LINEAR ? "linear" : "recovered"},
          {"order of output", o.output_order}};
}

Json describe_subdomains(const std::vector<Subdomain_facts>& subdomains)
{
  constexpr double g_per_cm3 = 1e6; // of 1 kg/mm^3
  Json result = Json::array();
  for(const Subdomain_facts& facts : subdomains)
    result.push_back({{"index", facts.index},
                      {"name", facts.name.empty() ? Json() : Json(facts.name)},
                      {"elements", facts.elements},
                      {"volume", facts.volume},
                      {"Young's modulus", quantity(facts.material.young_modulus, "kPa")},
                      {"Poisson's ratio", quantity(facts.material.poisson_ratio, "1")},
                      {"density", quantity(g_per_cm3 * facts.material.density, "g/cm^3")}});
  return result;
}

Json describe_points(const Outcome& outcome)
{
  Json controls = Json::array();
  for(std::size_t i = 0; i < outcome.points.size(); ++i)
    controls.push_back({{outcome.points[i].unit, outcome.points[i].number},
                        {"position", outcome.points[i].position},
                        {"displacement", outcome.points[i].displacement},
                        {"weight", outcome.points[i].weight},
                        {"element", std::uint32_t(outcome.locations[i].element)},
                        {"distance to the mesh", outcome.locations[i].distance}});
  return controls;
}

Json describe(const Shift& shift, const std::vector<Control_point>& points)
{
  Json controls = Json::array();
  for(std::size_t i = 0; i < points.size(); ++i) {
    const Control& c = shift.controls[i];
    Json control = {{points[i].unit, points[i].number}, {"used", c.is_used}};
    if(c.is_used) {
      control["displacement"] = c.displacement;
      control["missed by"] = c.miss;
      control["force"] = c.force;
      if(c.left_out)
        control["error if left out"] = *c.left_out;
    }
    controls.push_back(control);
  }
  Json result = {{"largest displacement", shift.largest},
                 {"at", shift.at},
                 {"energy", shift.energy},
                 {"inverted elements", shift.inverted_elements},
                 {"control points", controls},
                 {"control points missed by at most", shift.largest_miss},
                 {"root mean square of what control points are missed by", shift.root_mean_square_miss},
                 {"vertices in contact", shift.closed_contacts},
                 {"force of contact", shift.contact_force}};
  if(shift.left_out)
    result["root mean square of leave-one-out errors"] = *shift.left_out;
  if(!shift.residuals.empty()) {
    result["residuals"] = shift.residuals;
    result["iterations"] = shift.iterations;
  }
  return result;
}

Json describe(const CGAL::Mixed_mesh_adaptation_result_3& adaptation)
{
  return {{"status", mm3::description(adaptation.status)},
          {"steps", adaptation.number_of_steps},
          {"solves", adaptation.number_of_solves},
          {"vertices that may move", adaptation.number_of_inner_vertices},
          {"energies of unit bumps before", adaptation.energies_before},
          {"energies of unit bumps after", adaptation.energies_after},
          {"energies of guard loads before", adaptation.guard_energies_before},
          {"energies of guard loads after", adaptation.guard_energies_after},
          {"mean energy, after / before", adaptation.functional},
          {"worst ARC before", adaptation.worst_aspect_ratio_before},
          {"worst ARC after", adaptation.worst_aspect_ratio_after}};
}

Json describe(const Resection_facts& resection)
{
  Json floating = Json::array();
  for(const Resection_facts::Piece& piece : resection.floating_pieces)
    floating.push_back({{"elements", piece.elements}, {"volume", piece.volume}});
  return {{"status", resection.status},
          {"elements removed", resection.removed},
          {"elements inside", resection.asked},
          {"of which stay, or a vertex would be pinched", resection.restored},
          {"removed besides, as they came loose", resection.floating},
          {"removed besides, or a vertex would be pinched", resection.pinch},
          {"floating pieces", floating},
          {"cavity volume", resection.volume},
          {"cavity area", resection.area},
          {"vertices left", resection.left.vertices},
          {"elements left", resection.left.elements}};
}

Json describe_rims(const std::vector<Rim_facts>& rims)
{
  Json result = Json::array();
  for(const Rim_facts& rim : rims)
    result.push_back(
      {{"label", rim.label}, {"voxels resected", rim.resected}, {"voxels left as a rim", rim.left}});
  return result;
}

// The largest displacement in words, beside the largest measured one, which may be smaller.
std::string largest_shift(const Shift& shift, double control_radius, const std::vector<Control_point>& points)
{
  constexpr double notable = 1.1; // times as much; a difference of less than a tenth needs no reason
  const std::string text = "up to " + rounded(shift.largest) + " mm";
  double measured = 0;
  for(std::size_t i = 0; i < points.size(); ++i)
    if(shift.controls[i].is_used)
      measured = (std::max)(measured, norm(Vector(points[i].displacement)));
  if(measured == 0 || shift.largest < notable * measured)
    return text;
  const std::string why = control_radius > 0 ? ": the mean within " + rounded(control_radius)
                                                 + " mm of a control point is prescribed (--control-radius), "
                                                   "and its middle moves farther"
                                             : "";
  return text + " at " + place(shift.at) + ", more than the " + rounded(measured) + " mm measured" + why;
}

// Prints a line for each subdomain, if there are several.
void print_subdomains(const std::vector<Subdomain_facts>& subdomains)
{
  if(subdomains.size() < 2)
    return;
  for(const Subdomain_facts& facts : subdomains)
    std::cout << "subdomain " << facts.index << (facts.name.empty() ? "" : " (" + facts.name + ")") << ": "
              << counted(facts.elements, "element", "elements") << ", " << rounded(facts.volume / 1000)
              << " ml; Young's modulus " << rounded(facts.material.young_modulus) << " kPa, Poisson's ratio "
              << rounded(facts.material.poisson_ratio) << '\n';
}

} // namespace

Json report(const Options& o, const Outcome& outcome, const Stage_log& log)
{
  Json report;
  report["program"] = describe_program("brain_shift");
  report["inputs"] = {{"mesh", describe_mesh(o.model.mesh, outcome)},
                      {"control points",
                       {{"file", o.model.points.file},
                        {"file of points after",
                         o.model.points.file_after.empty() ? Json() : Json(o.model.points.file_after)},
                        {"number", outcome.points.size()}}},
                      {"tumor", outcome.tumor ? describe(*outcome.tumor) : Json()},
                      {"label of the tumor", o.tumor_label.empty() ? Json() : Json(o.tumor_label)},
                      {"image", outcome.image ? describe(*outcome.image, o.images.file) : Json()},
                      {"labels", o.images.labels.empty() ? Json() : Json(o.images.labels)}};
  report["parameters"] = parameters_of(o);
  report["units"] = {{"lengths", "mm"},
                     {"areas", "mm^2"},
                     {"volumes", "mm^3"},
                     {"forces", "mN"},
                     {"energy", "microjoule"},
                     {"times", "ms"},
                     {"heights", "height of the mesh"}};
  report["solver"] = outcome.petsc ? Json{{"name", "PETSc, conjugate gradients with GAMG"},
                                          {"processes", outcome.petsc->processes},
                                          {"largest number of iterations", outcome.petsc->iterations}}
                                   : Json{{"name", "direct"}};
  report["order"] = {{"order", outcome.order.order},
                     {"because of", outcome.order.reason.empty() ? Json() : Json(outcome.order.reason)},
                     {"nodes", outcome.order.nodes},
                     {"unknowns", outcome.order.unknowns}};
  report["subdomains"] = describe_subdomains(outcome.subdomains);
  report["supports"] = {{"boundary vertices", outcome.supports.boundary_vertices},
                        {"fixed", outcome.supports.fixed},
                        {"sliding", outcome.supports.sliding},
                        {"touching", outcome.supports.touching}};
  report["adaptation"] = outcome.adaptation ? describe(*outcome.adaptation) : Json();
  report["control points"] = describe_points(outcome);
  report["landmarks"] = outcome.landmarks
                          ? describe_landmarks(o.model.landmarks, o.model.corotational, *outcome.landmarks)
                          : Json();
  report["shift"] = describe(outcome.before, outcome.points);
  report["resection"] = outcome.resection ? describe(*outcome.resection) : Json();
  report["shift after resection"] = outcome.after ? describe(*outcome.after, outcome.points) : Json();
  if(outcome.image)
    report["image"] = {{"voxels of tissue", outcome.image->voxels_of_tissue},
                       {"voxels resected", outcome.image->voxels_resected},
                       {"elements with linear interpolation", outcome.image->linear_elements}};
  if(!o.images.labels.empty())
    report["image"]["labels with a rim"] = describe_rims(outcome.image->rims);
  report["outputs"] = outputs_of(o);
  report["warnings"] = outcome.warnings;
  report["stages"] = describe_stages(log, "ms", 1000);
  report["ms"] = 1000 * outcome.seconds;
  report["peak memory MiB"] = mebibytes(outcome.peak_bytes);
  return report;
}

void print_summary(const Options& o, const Outcome& outcome, const Stage_log& log)
{
  const auto time = [&log](const std::string& stage) {
    for(const Stage_cost& cost : log.costs())
      if(cost.name == stage)
        return duration(cost.seconds);
    return std::string();
  };
  std::cout << outcome.mesh.vertices << " vertices, " << outcome.mesh.elements << " elements; "
            << outcome.supports.fixed << " vertices fixed, " << outcome.supports.sliding << " sliding"
            << (outcome.supports.touching > 0 ? ", " : "; ");
  if(outcome.supports.touching > 0)
    std::cout << outcome.supports.touching << " touch the skull; ";
  std::cout << counted(outcome.points.size(), "control point", "control points") << '\n';
  print_subdomains(outcome.subdomains);
  if(outcome.adaptation) {
    const CGAL::Mixed_mesh_adaptation_result_3& a = *outcome.adaptation;
    std::cout << "adaptation: energies of unit bumps, normal and tangential, in microjoules";
    for(std::size_t i = 0; i < a.energies_before.size(); ++i)
      std::cout << (i == 0 ? ": " : ", ") << rounded(a.energies_before[i]) << " -> "
                << rounded(a.energies_after[i]);
    std::cout << "; worst ARC " << rounded(a.worst_aspect_ratio_before) << " -> "
              << rounded(a.worst_aspect_ratio_after) << "; " << a.number_of_steps << " steps, "
              << time("adapt mesh") << '\n';
  }
  const Order_facts& order = outcome.order;
  std::cout << (order.order == "region" ? "order 2 in the region" : "order " + order.order)
            << (order.reason.empty() ? "" : " because of " + order.reason) << ": " << order.nodes
            << " nodes, " << order.unknowns << " unknowns\n";
  std::cout << "before surgery: factor " << time("factor") << ", control points " << time("control points")
            << '\n';
  if(outcome.petsc)
    std::cout << "PETSc: " << counted(std::size_t(outcome.petsc->processes), "process", "processes")
              << ", up to " << outcome.petsc->iterations << " iterations\n";
  std::cout << "shift: " << largest_shift(outcome.before, o.model.points.radius, outcome.points) << "; "
            << time("solve") << '\n';
  if(outcome.supports.touching > 0)
    std::cout << "contact: " << counted(outcome.before.closed_contacts, "vertex", "vertices")
              << " still at the skull, which pushes with " << rounded(outcome.before.contact_force)
              << " mN\n";
  if(outcome.before.left_out)
    std::cout << "control points: each is predicted by the others to " << rounded(*outcome.before.left_out)
              << " mm (root mean square)\n";
  if(outcome.landmarks)
    print_landmarks(o.model.landmarks, o.model.corotational, *outcome.landmarks);
  if(outcome.resection)
    std::cout << "resection: " << outcome.resection->removed << " elements, "
              << rounded(outcome.resection->volume / 1000) << " ml; shift up to "
              << rounded(outcome.after->largest) << " mm; " << time("remove elements") << " and "
              << time("solve after resection") << '\n';
  if(!o.images.file.empty())
    std::cout << "image: " << time("warp image") << '\n';
  for(const std::string& path : outputs_of(o))
    std::cout << "wrote " << printable(path) << '\n';
}
