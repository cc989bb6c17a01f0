// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mixed_mesh_3/report.h"

#include "core/messages.h"
#include "core/report_json.h"

#include <CGAL/Mixed_mesh_3/quality_bound.h>

#include <cmath>
#include <cstddef>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace mm3 = CGAL::Mixed_meshes_3;

namespace {

const char* const fit_names[] = {"none", "optimization", "Algorithm 1"};
const char* const solver_names[] = {"cg", "ldlt"};

Json describe(const Surface_facts& s)
{
  return {{"file", s.file},         {"points", s.points},       {"polygons", s.polygons},
          {"vertices", s.vertices}, {"triangles", s.triangles}, {"components", s.components},
          {"volume", s.volume},     {"repairs", s.repairs}};
}

Json describe(const Completion_facts& c)
{
  return {{"closing radius", c.closing_radius},  {"voxels", c.voxels},
          {"voxels added by closing", c.closed}, {"voxels filled in", c.filled},
          {"voxels dropped", c.removed},         {"components dropped", c.components_removed}};
}

Json describe(const Options& o)
{
  Json report = {{"vertices", o.vertices},
                 {"nodes", o.nodes > 0 ? Json(o.nodes) : Json()},
                 {"fewest vertices", o.fewest_vertices},
                 {"base level", o.base_level == CGAL::Mixed_mesh_criteria_3::automatic ? Json("automatic")
                                                                                       : Json(o.base_level)},
                 {"mode", o.mode == mm3::Boundary_mode::PAPER ? "paper" : "default"},
                 {"root", o.root == mm3::Root_cell::BOX ? "box" : "cube"},
                 {"templates",
                  o.templates == mm3::Transition_templates_choice::CENTERED ? "centered" : "fewest"},
                 {"fit", fit_names[int(o.fit())]},
                 {"grading", o.grading},
                 {"simplification", !o.no_simplification},
                 {"time limit", std::isfinite(o.time_limit) ? Json(o.time_limit) : Json()},
                 {"tolerance", o.tolerance > 0 ? Json(o.tolerance) : Json("automatic")},
                 {"max ARC", o.has_quality_bound() ? Json(o.largest_arc) : Json()},
                 {"max ARC is strict", o.is_arc_strict},
                 {"sharp angle", o.sharp_angle()},
                 {"tetrahedra", o.tetrahedra},
                 {"order", o.order},
                 {"slit", o.slit},
                 {"best effort", o.best_effort},
                 {"msh version", o.msh2 ? "2.2" : "4.1"},
                 {"space", space_of(o.surface_options)},
                 {"strict", o.surface_options.is_strict},
                 {"wrap",
                  o.surface_options.wrap_diameter > 0 ? Json(o.surface_options.wrap_diameter) : Json()},
                 {"threads", o.threads}};
  const double weld = o.surface_options.weld_distance;
  report["weld"] = weld > 0 ? Json(weld) : Json();
  if(o.fit() == Fit::ALGORITHM_1)
    report["Algorithm 1"] = {{"steps", o.steps},
                             {"Poisson's ratio", o.poisson_ratio},
                             {"stiffness factor", o.stiffness_factor},
                             {"maximal stiffness", o.maximal_stiffness},
                             {"acceptable quality", o.acceptable_quality},
                             {"layers", o.layers == CGAL::Mixed_mesh_fit_criteria_3::automatic
                                          ? Json("automatic")
                                          : Json(o.layers)},
                             {"solver", solver_names[int(o.solver)]}};
  return report;
}

const char* row_name(std::size_t row)
{
  return row < mm3::number_of_element_kinds ? mm3::reference_elements[row].plural : "all";
}

// A number, or null without a number: for no element, or infinity.
Json value(const mm3::Quality_statistics& row, double x) { return row.count == 0 ? Json() : Json(x); }

// The paper's Table 1.
Json describe(const Aspect_ratios& ratios)
{
  const Table& rows = ratios.up_to_7;
  Json table = Json::object();
  for(std::size_t i = 0; i < rows.size(); ++i)
    table[row_name(i)] = {{"elements", rows[i].count},
                          {"ARC mean", value(rows[i], rows[i].mean)},
                          {"ARC min", value(rows[i], rows[i].minimum)},
                          {"ARC max", value(rows[i], rows[i].maximum)},
                          {"share of ARC <= 7", value(rows[i], rows[i].share)},
                          {"share of ARC in [1.3, 7]", value(rows[i], ratios.from_1_3_to_7[i].share)}};
  return table;
}

Json describe(const Table& rows)
{
  Json table = Json::object();
  for(std::size_t i = 0; i < rows.size(); ++i)
    table[row_name(i)] = {{"mean", value(rows[i], rows[i].mean)},
                          {"min", value(rows[i], rows[i].minimum)},
                          {"max", value(rows[i], rows[i].maximum)}};
  return table;
}

// Part of `quality`: `when` is "before" or "after" the boundary is fitted.
void describe_ratios(const Aspect_ratios& ratios, const char* when, Json& quality)
{
  quality[when] = describe(ratios);
  quality["histograms"]["ARC"]["edges"] = histogram_edges();
  quality["histograms"]["ARC"][when] = ratios.histogram;
}

Json describe_quality(const Meshing_options& o, const Outcome& outcome)
{
  Json quality;
  if(o.has_quality_bound())
    quality["quality bound"] = {{"ARC", o.largest_arc},
                                {"elements above", outcome.elements_above_bound},
                                {"ARC in force", outcome.result.quality_bound},
                                {"dihedral angles of tetrahedra within it",
                                 mm3::dihedral_angle_bounds(o.largest_arc)},
                                {"method", "proved for each element, exact on the coordinates written"}};
  if(outcome.before)
    describe_ratios(*outcome.before, "before", quality);
  describe_ratios(outcome.after, "after", quality);
  const Shapes& shapes = outcome.shapes;
  quality["scaled Jacobian"] = describe(shapes.scaled_jacobian);
  quality["smallest dihedral angle"] = describe(shapes.smallest_dihedral_angle);
  quality["largest dihedral angle"] = describe(shapes.largest_dihedral_angle);
  quality["quad warp"] = describe(shapes.quad_warp);
  quality["quad warp"].erase("tetrahedra"); // tetrahedra have no quadrilaterals
  quality["quad warp"]["all"].erase("mean");
  return quality;
}

Json describe(const Distance& d)
{
  return {{"distance", d.distance}, {"error", d.error}, {"at", d.from}, {"nearest", d.to}};
}

Json describe(const Fidelity& f)
{
  return {{"Hausdorff distance",
           {{"method",
             "branch and bound on triangles, not sampled: no point is farther than distance + error"},
            {"distance", f.distance()},
            {"from mesh to surface", describe(f.from_mesh)},
            {"from surface to mesh", describe(f.from_surface)}}},
          {"volume of mesh", f.volume_of_mesh},
          {"volume of surface", f.volume_of_surface},
          {"ratio of volumes", f.ratio_of_volumes()},
          {"boundary vertices", f.vertices},
          {"boundary vertices not on surface", f.vertices_off},
          {"on surface means within, of the diagonal", on_surface},
          {"boundary self-intersections", f.self_intersections}};
}

Json describe(const Solid& s)
{
  return {{"bodies", s.bodies}, {"handles", s.handles}, {"cavities", s.cavities}, {"volume", s.volume}};
}

Json describe(const std::vector<Difference>& differences)
{
  Json result = Json::array();
  for(const Difference& d : differences)
    result.push_back({{"text", d.sentence}, {"at", d.at}});
  return result;
}

Json describe(const Topology& t)
{
  return {{"surface", describe(t.surface)},
          {"mesh", describe(t.mesh)},
          {"same topology", t.is_same},
          {"volumes may differ by, relatively", volume_tolerance},
          {"differences", describe(t.differences)}};
}

Json describe(const CGAL::Mixed_mesh_optimization_result_3& r)
{
  return {{"method", fit_names[int(Fit::OPTIMIZATION)]},
          {"status", mm3::description(r.status)},
          {"boundary vertices", r.number_of_boundary_vertices},
          {"arrived", r.number_of_arrived_vertices},
          {"rounds", r.number_of_rounds},
          {"flips", r.number_of_flips},
          {"merged vertices", r.number_of_merged_vertices},
          {"sharp edges",
           {{"length", r.length_of_sharp_edges},
            {"share kept", r.length_of_sharp_edges > 0
                             ? Json(r.length_of_sharp_edges_kept / r.length_of_sharp_edges)
                             : Json()},
            {"lost", r.lost_sharp_edges},
            {"corners", r.number_of_corners},
            {"corners kept", r.number_of_corners_kept}}}};
}

Json describe(const CGAL::Mixed_mesh_fit_result_3& r)
{
  return {{"method", fit_names[int(Fit::ALGORITHM_1)]},
          {"status", mm3::description(r.status)},
          {"boundary vertices", r.number_of_boundary_vertices},
          {"arrived", r.number_of_arrived_vertices},
          {"frozen", r.number_of_frozen_vertices},
          {"folded boundary faces", r.number_of_folded_faces},
          {"solves", r.number_of_solves},
          {"halvings of a step", r.number_of_halvings},
          {"elements not acceptable at the cap", r.number_of_unacceptable_elements}};
}

Json describe_fitting(Fit fit, const Outcome& outcome)
{
  switch(fit) {
  case Fit::OPTIMIZATION: return describe(outcome.result.optimization);
  case Fit::ALGORITHM_1: return describe(outcome.algorithm_1);
  case Fit::NONE: break;
  }
  return {{"method", fit_names[int(Fit::NONE)]}};
}

Json describe_mesh(std::size_t budget_in_nodes, std::size_t budget_in_vertices, const Outcome& outcome)
{
  const double vertices = double(outcome.mesh.vertices);
  const std::size_t in_region = outcome.result.number_of_vertices_in_region;
  Json report = {{"vertices", outcome.mesh.vertices},
                 {"nodes", outcome.nodes},
                 {"share of budget", budget_in_nodes > 0 ? double(outcome.nodes) / double(budget_in_nodes)
                                                         : vertices / double(budget_in_vertices)},
                 {"vertices in region", in_region},
                 {"share of vertices in region", double(in_region) / vertices},
                 {"elements", outcome.mesh.elements},
                 {"elements in region", outcome.elements_in_region},
                 {"boundary faces", outcome.boundary_faces},
                 {"volume", outcome.fidelity.volume_of_mesh}};
  add_kinds(outcome.mesh, report);
  return report;
}

void describe_subdomains(const Outcome& outcome, Json& report)
{
  for(const Subdomain_outcome& s : outcome.subdomains) {
    report["subdomains"].push_back(
      {{"name", s.name},
       {"index", s.index},
       {"surface", describe(s.surface)},
       {"elements", s.elements},
       {"volume", s.volume},
       {"volume of surface", s.volume_of_surface ? Json(*s.volume_of_surface) : Json()},
       {"ratio of volumes", s.volume_of_surface ? Json(s.volume / *s.volume_of_surface) : Json()},
       {"ARC mean", s.elements > 0 ? Json(s.mean_arc) : Json()},
       {"ARC max", s.elements > 0 ? Json(s.largest_arc) : Json()}});
    if(!s.voxels.empty())
      report["subdomains"].back()["voxels"] = s.voxels;
    if(s.volume_of_voxels)
      report["subdomains"].back()["volume of voxels"] = *s.volume_of_voxels;
  }
  for(const Interface_outcome& i : outcome.interfaces)
    report["interfaces"].push_back({{"between", {i.first, i.second}},
                                    {"faces", i.faces},
                                    {"area", i.area},
                                    {"manifold", i.is_manifold},
                                    {"vertices", i.vertices},
                                    {"vertices not on surface", i.vertices_off}});
}

void describe_sheets(const Outcome& outcome, Json& report)
{
  for(const Sheet_outcome& s : outcome.sheets)
    report["sheets"].push_back({{"name", s.name},
                                {"surface", describe(s.surface)},
                                {"faces", s.faces},
                                {"area", s.area},
                                {"area of surface inside the domain", s.area_inside},
                                {"vertices", s.vertices},
                                {"vertices not on surface", s.vertices_off},
                                {"largest distance of a vertex", s.largest_distance}});
  if(outcome.slit)
    report["slit"] = {{"faces", outcome.slit->faces},
                      {"faces that stay closed", outcome.slit->faces_left},
                      {"vertices doubled", outcome.slit->vertices}};
}

// Describes the part of the mesh that the files have; everything else is about the whole mesh.
void describe_extract(const Outcome& outcome, Json& report)
{
  if(!outcome.extract)
    return;
  const Extract_outcome& part = *outcome.extract;
  Json extracted = {{"subdomains", part.subdomains},
                    {"vertices", part.mesh.vertices},
                    {"nodes", part.nodes},
                    {"elements", part.mesh.elements},
                    {"boundary faces", part.boundary_faces},
                    {"nonmanifold boundary edges", part.bad_edges},
                    {"nonmanifold boundary vertices", part.bad_vertices},
                    {"volume", part.volume},
                    {"share of volume", part.volume / outcome.fidelity.volume_of_mesh}};
  add_kinds(part.mesh, extracted);
  for(const Interface_outcome& i : part.interfaces)
    extracted["interfaces"].push_back(
      {{"between", {i.first, i.second}}, {"faces", i.faces}, {"area", i.area}, {"manifold", i.is_manifold}});
  report["extracted"] = std::move(extracted);
}

void describe_patches(const Outcome& outcome, Json& report)
{
  for(const Patch_outcome& p : outcome.patches)
    report["patches"].push_back({{"name", p.name}, {"where", p.place}, {"faces", p.faces}, {"area", p.area}});
}

// Describes the method by which the mesh was made.
void describe_method(Fit fit, const Outcome& outcome, Json& report)
{
  const CGAL::Mixed_mesh_result_3& result = outcome.result;
  report["octree"] = {{"base level", result.base_level},
                      {"deepest level", result.deepest_level},
                      {"cells", result.number_of_cells},
                      {"cells lost", result.number_of_lost_cells},
                      {"octrees tried", result.number_of_trials},
                      {"vertices collapsed", result.number_of_collapsed_vertices}};
  report["vertices inserted"] = {{"by transition templates", result.number_of_transition_vertices},
                                 {"by boundary stage", result.number_of_boundary_vertices_inserted},
                                 {"by bisection of boundary edges",
                                  result.optimization.number_of_bisections}};
  report["vertices labeled inside for a manifold boundary"] = result.number_of_relabeled_vertices;
  report["fitting"] = describe_fitting(fit, outcome);
  const double distance = outcome.fidelity.distance();
  if(result.tolerance > 0)
    report["tolerance"] = {{"tolerance", result.tolerance},
                           {"reached", distance <= result.tolerance},
                           {"largest distance", distance},
                           {"largest distance at sample points", result.optimization.largest_distance},
                           {"vertices of the mesh as coarse as it allows",
                            result.number_of_vertices_for_tolerance}};
}

// A line for each subdomain, if there are several, each sheet and each patch.
std::string parts_in_words(bool is_in_mm, const Outcome& outcome)
{
  const char* const unit_of_area = is_in_mm ? " mm^2" : " square units";
  std::ostringstream text;
  text << std::setprecision(4);
  for(const Subdomain_outcome& s : outcome.subdomains) {
    text << s.name << " (" << s.index << "): " << s.elements << " elements, volume "
         << volume_with_unit(s.volume, is_in_mm);
    if(s.volume_of_surface)
      text << ", " << as_part_of(s.volume / *s.volume_of_surface) << " that of its "
           << (s.volume_of_voxels ? "voxels, " : "surface, ")
           << volume_with_unit(*s.volume_of_surface, is_in_mm);
    text << '\n';
  }
  for(const Sheet_outcome& s : outcome.sheets)
    text << s.name << ": " << s.faces << " faces, area " << s.area << unit_of_area << ", "
         << as_part_of(s.area_inside > 0 ? s.area / s.area_inside : 0) << " that of the sheet inside\n";
  if(outcome.slit)
    text << "slit along " << outcome.slit->faces << " of them: " << outcome.slit->vertices
         << " vertices doubled\n";
  if(outcome.extract) {
    const Extract_outcome& part = *outcome.extract;
    std::string names;
    for(const std::string& name : part.subdomains)
      names += (names.empty() ? "" : ", ") + name;
    text << "written of that: " << names << ", " << part.mesh.vertices << " vertices, " << part.mesh.elements
         << " elements, volume " << volume_with_unit(part.volume, is_in_mm) << '\n';
  }
  for(const Patch_outcome& p : outcome.patches)
    text << p.name << ": " << counted(p.faces, "face", "faces") << " of the boundary, area " << p.area
         << unit_of_area << '\n';
  return text.str();
}

// The checks in words. Checks of validity hold, or there is no mesh.
std::string checks_in_words(const Outcome& outcome)
{
  std::string failed;
  for(const Check& check : outcome.checks_of_fidelity)
    if(!check.holds)
      failed += (failed.empty() ? "" : ", ") + std::string(check.name);
  return failed.empty() ? "all checks hold" : "valid, but not: " + failed;
}

std::string completion_in_words(const Completion_facts& c)
{
  std::ostringstream text;
  const char* separator = "image: ";
  const auto add = [&](bool is_so, const std::string& what) {
    if(is_so)
      text << std::exchange(separator, "; ") << what;
  };
  const auto number = [](std::size_t n) { return counted(n, "voxel", "voxels"); };
  const auto share = [&c](std::size_t n) {
    return " (" + rounded(100 * double(n) / double(c.voxels)) + " % of its voxels)";
  };
  add(c.closing_radius > 0,
      "closed by " + rounded(c.closing_radius) + " mm, " + number(c.closed) + " added" + share(c.closed));
  add(c.filled > 0, number(c.filled) + " filled in" + share(c.filled));
  add(c.components_removed > 0,
      counted(c.components_removed, "component", "components") + " of " + number(c.removed) + " dropped");
  return text.str().empty() ? "" : text.str() + '\n';
}

std::string layer_in_words(const Layer_outcome& layer)
{
  const std::string number = counted(layer.voxels, "voxel", "voxels");
  return "image: " + layer.name
         + (layer.distance
              ? (layer.is_new ? ", around all labels by " : " grown by ") + rounded(*layer.distance) + " mm: "
              : std::string(" fills holes: "))
         + number + '\n';
}

} // namespace

Json report(const Options& o, const Outcome& outcome, const Stage_log& log)
{
  Json report;
  report["program"] = describe_program("mixed_mesh_3");
  report["inputs"] = {{"surface", describe(outcome.surface)}, {"regions", Json::array()}};
  if(is_image(o.surface))
    report["inputs"]["surface"]["voxels"] = outcome.voxels;
  if(outcome.completion)
    report["inputs"]["surface"]["completion"] = describe(*outcome.completion);
  if(!outcome.changes_by_smoothing.empty())
    report["inputs"]["surface"]["changes by smoothing"] = describe(outcome.changes_by_smoothing);
  for(const Layer_outcome& layer : outcome.layers)
    report["inputs"]["surface"]["layers"].push_back(
      {{"name", layer.name},
       {"distance", layer.distance ? Json(*layer.distance) : Json()},
       {"voxels", layer.voxels},
       {"new", layer.is_new}});
  for(std::size_t i = 0; i < o.regions.size(); ++i) {
    report["inputs"]["regions"].push_back(describe(outcome.regions[i]));
    report["inputs"]["regions"].back()["weight"] = o.regions[i].weight;
    if(is_image(o.regions[i].file))
      report["inputs"]["regions"].back()["voxels"] = o.regions[i].voxels.text;
  }
  report["options"] = describe(o);
  report["units"] = {{"lengths and distances", "unit of the surface's file"},
                     {"volumes", "cube of the unit of the surface's file"},
                     {"angles and quad warp", "degrees"},
                     {"ARC, scaled Jacobian, shares and ratios", "1"}};
  report["status"] = mm3::description(outcome.result.status);
  report["mesh"] = describe_mesh(o.nodes, o.vertices, outcome);
  describe_method(o.fit(), outcome, report);
  report["surface"] = describe(outcome.fidelity);
  describe_subdomains(outcome, report);
  describe_sheets(outcome, report);
  describe_extract(outcome, report);
  describe_patches(outcome, report);
  report["topology"] = describe(outcome.topology);
  report["quality"] = describe_quality(o, outcome);
  for(const Check& check : outcome.checks)
    report["checks"][check.name] = check.holds;
  for(const Check& check : outcome.checks_of_fidelity)
    report["checks of fidelity"][check.name] = check.holds;
  report["outputs"] = o.outputs;
  report["warnings"] = outcome.warnings;
  report["stages"] = describe_stages(log, "seconds", 1);
  report["seconds"] = outcome.seconds;
  report["peak memory MiB"] = mebibytes(outcome.peak_bytes);
  return report;
}

void print_summary(const Options& o, const Outcome& outcome)
{
  const Mesh_facts& mesh = outcome.mesh;
  if(outcome.completion)
    std::cout << completion_in_words(*outcome.completion);
  for(const Layer_outcome& layer : outcome.layers)
    std::cout << layer_in_words(layer);
  if(o.nodes > 0)
    std::cout << outcome.nodes << " nodes of " << o.nodes << ", " << mesh.vertices << " vertices, ";
  else
    std::cout << mesh.vertices << " vertices of " << o.vertices
              << (o.fewest_vertices ? ", the smallest budget found that suffices, " : ", ");
  if(o.nodes == 0 && o.order == 2)
    std::cout << outcome.nodes << " nodes of order 2, ";
  std::cout << mesh.elements << " elements (";
  for(int k = mm3::number_of_element_kinds - 1; k >= 0; --k)
    std::cout << mesh.elements_of_kind[std::size_t(k)] << ' ' << mm3::reference_elements[k].plural
              << (k > 0 ? ", " : ")\n");
  const mm3::Quality_statistics& all = outcome.after.up_to_7.back();
  std::cout << std::setprecision(3) << "ARC mean " << all.mean << ", max " << all.maximum
            << "; Hausdorff distance " << outcome.fidelity.distance()
            << (o.is_in_patient_space() ? " mm; " : "; ") << as_part_of(outcome.fidelity.ratio_of_volumes())
            << " the surface's volume\n"
            << parts_in_words(o.is_in_patient_space(), outcome) << checks_in_words(outcome) << "; "
            << duration(outcome.seconds) << '\n';
  for(const std::string& path : o.outputs)
    std::cout << "wrote " << printable(path) << '\n';
  for(const std::string& path : {o.report, o.page})
    if(!path.empty())
      std::cout << "wrote " << printable(path) << '\n';
}
