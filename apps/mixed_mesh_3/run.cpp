// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mixed_mesh_3/run.h"

#include "core/Thread_limit.h"
#include "core/Deferred_signals.h"
#include "core/Stage_log.h"
#include "core/messages.h"
#include "core/misfit.h"
#include "core/resources.h"
#include "core/write_files.h"
#include "mixed_mesh_3/algorithm_1.h"
#include "mixed_mesh_3/examine.h"
#include "mixed_mesh_3/extract.h"
#include "mixed_mesh_3/inputs.h"
#include "mixed_mesh_3/layers.h"
#include "mixed_mesh_3/nodes.h"
#include "mixed_mesh_3/patches.h"
#include "mixed_mesh_3/report.h"
#include "mixed_mesh_3/sheets.h"
#include "mixed_mesh_3/subdomains.h"
#include "mixed_mesh_3/verdict.h"
#include "page/page.h"

#include <CGAL/make_mixed_mesh_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mm3 = CGAL::Mixed_meshes_3;
using Domain = CGAL::Labeled_polyhedral_mixed_mesh_domain_3;

namespace {

// Checks the tolerance: the library tests points of the surface in a grid of twice the tolerance.
void check_tolerance(double tolerance, const std::string& file, const Surface& surface)
{
  constexpr double most = 1e7; // takes an hour
  double number = 0;
  for(const auto f : faces(surface)) {
    double longest = 0;
    for(const auto h : halfedges_around_face(halfedge(f, surface), surface))
      longest = (std::max)(longest, CGAL::squared_distance(surface.point(source(h, surface)),
                                                           surface.point(target(h, surface))));
    const double n = (std::min)(std::ceil(std::sqrt(longest) / (2 * tolerance)), 1000.);
    number += 0.5 * (n - 1) * n;
  }
  if(number > most)
    throw std::runtime_error("--tolerance " + rounded(tolerance) + ": too small for " + file
                             + ", it would take hours; " + rounded(tolerance * std::sqrt(number / most))
                             + " takes about one");
}

// Checks that regions meet the domain: a region elsewhere is no region; if the reason is plain, the message
// gives the reason.
void check_regions(const Domain& domain, const Inputs& inputs, const Input_options& o, Outcome& outcome)
{
  std::vector<std::string> defects;
  bool are_all_apart = true;
  for(std::size_t i = 0; i < inputs.regions.size(); ++i) {
    const auto points = coordinates_of(inputs.regions[i].points());
    const std::string defect = misfit(points, domain.bbox(), [&domain](const std::array<double, 3>& p) {
      return domain.subdomain_index(Kernel::Point_3(p[0], p[1], p[2])) != 0;
    });
    if(!defect.empty())
      defects.push_back(o.regions[i].file + ": beside " + o.surface + ", it " + defect);
    are_all_apart = are_all_apart && !CGAL::do_overlap(domain.bbox(), box_of(points));
  }
  if(are_all_apart && !defects.empty())
    throw std::runtime_error(defects.front()); // the library would refuse the regions anyway
  outcome.warnings.insert(outcome.warnings.end(), defects.begin(), defects.end());
}

// The regions; without any, the region is everywhere.
CGAL::Polyhedral_mixed_mesh_regions_3 make_regions(const std::vector<Surface>& surfaces,
                                                   const std::vector<Region_option>& options, Stage_log& log)
{
  CGAL::Polyhedral_mixed_mesh_regions_3 regions;
  for(std::size_t i = 0; i < surfaces.size(); ++i)
    log("AABB tree of region", [&] {
      regions.add(std::make_shared<const CGAL::Polyhedral_mixed_mesh_region_3>(surfaces[i]),
                  options[i].weight);
    });
  return regions;
}

// Visitor that measures the mesh before its boundary is fitted.
struct Observer
{
  Stage_log& log;
  std::optional<Aspect_ratios>& before;

  void begin_stage(mm3::Stage stage) { log.begin_stage(stage); }
  void end_stage(mm3::Stage stage) { log.end_stage(stage); }
  void progress(std::size_t number_of_vertices, std::size_t budget)
  {
    log.progress(number_of_vertices, budget);
  }
  bool go_on() { return log.go_on(); }
  void before_fitting(const Mesh& mesh) { before = aspect_ratios_of(mesh); }
};

// Makes a mesh, with its boundary on the surface if the library fits it.
Mesh make_mesh(const Domain& domain, const CGAL::Polyhedral_mixed_mesh_regions_3& regions,
               const Meshing_options& o, Stage_log& log, Outcome& outcome)
{
  auto criteria = CGAL::Mixed_mesh_criteria_3(o.vertices)
                    .fit_to_surface(o.fit() == Fit::OPTIMIZATION)
                    .base_level(o.base_level)
                    .grading(o.grading)
                    .simplification(!o.no_simplification)
                    .boundary_mode(o.mode)
                    .root_cell(o.root)
                    .transition_templates(o.templates)
                    .quality_bound(o.largest_arc)
                    .strict_quality_bound(o.is_arc_strict)
                    .sharp_angle(o.sharp_angle())
                    .only_tetrahedra(o.tetrahedra) // the tetrahedra are fitted, checked, reported and written
                    .keep_mesh_if_stopped(true)
                    .fewest_vertices(o.fewest_vertices);
  if(o.tolerance > 0)
    criteria.tolerance(o.tolerance);
  Mesh mesh;
  Observer observer{log, outcome.before};
  outcome.result = CGAL::make_mixed_mesh_3<CGAL::Parallel_if_available_tag>(domain, regions, criteria, mesh,
                                                                            CGAL::parameters::visitor(
                                                                              std::ref(observer)));
  return mesh;
}

// Makes meshes until one fills the budget in nodes, at most three, and takes the best: the one with most
// nodes of those within the budget.
Mesh make_mesh_of_nodes(const Domain& domain, const CGAL::Polyhedral_mixed_mesh_regions_3& regions,
                        Meshing_options o, Stage_log& log, Outcome& outcome)
{
  constexpr std::size_t most_meshes = 3;
  const auto rank = [&o](std::size_t nodes) { return (nodes <= o.nodes ? 1. : -1.) * double(nodes); };
  const Outcome before = outcome;
  Mesh best;
  std::vector<Node_counts> made;
  for(;;) {
    Outcome with_trial = before;
    Mesh trial = make_mesh(domain, regions, o, log, with_trial);
    with_trial.nodes = number_of_nodes(trial, o.order);
    const CGAL::Mixed_mesh_result_3& result = with_trial.result;
    const bool is_stopped = result.status == CGAL::Mixed_mesh_status::STOPPED;
    made.push_back({trial.number_of_vertices(), with_trial.nodes});
    // A complete mesh is better than an incomplete one, unless only the latter is within the budget.
    const bool is_better = is_stopped ? outcome.nodes > o.nodes && with_trial.nodes <= o.nodes
                                      : rank(with_trial.nodes) > rank(outcome.nodes);
    const bool is_last = is_stopped || !result.has_mesh() || fills_node_budget(made.back(), o.nodes)
                         || made.size() == most_meshes;
    if(made.size() == 1 || (result.has_mesh() && is_better)) {
      best = std::move(trial);
      outcome = with_trial;
    } else if(is_stopped) {
      outcome.result.status = CGAL::Mixed_mesh_status::STOPPED;
      outcome.result.is_kept = true;
    }
    if(is_last)
      break;
    o.vertices = next_vertex_budget(made, o.nodes);
  }
  if(outcome.result.has_mesh() && !outcome.result.is_kept && outcome.nodes > o.nodes)
    throw std::runtime_error(o.budget() + ": too small, the coarsest mesh made of " + o.surface + " has "
                             + std::to_string(outcome.nodes) + " nodes");
  return best;
}

// Brings the boundary onto the surface by the paper's method; the status becomes the corresponding status of
// the library.
void fit_by_algorithm_1(Mesh& mesh, const Domain& domain, const Relaxation_options& o, Stage_log& log,
                        Outcome& outcome)
{
  using Status = CGAL::Mixed_mesh_fit_status;
  outcome.before = log("quality", [&] { return aspect_ratios_of(mesh); });
  const auto r = log.fit("Algorithm 1", [&] { return run_algorithm_1(mesh, domain, o, log); });
  if(r.status == Status::INVALID_MESH)
    throw Invalid_mesh("an element of the mesh is inverted before its boundary is fitted");
  outcome.algorithm_1 = r;
  outcome.is_stopped = r.status == Status::STOPPED;
  if(r.status == Status::SOLVER_FAILED)
    outcome.warnings.push_back("--solver: did not solve a linear system; try another one");
  if(r.status == Status::CAP_REACHED)
    outcome.warnings.push_back(std::to_string(r.number_of_unacceptable_elements)
                               + " elements have an aspect-ratio coefficient above "
                               + rounded(o.acceptable_quality)
                               + ": stiffening does not help them, see --max-stiffness; optimization would");
  if(outcome.is_stopped)
    outcome.result.status = CGAL::Mixed_mesh_status::STOPPED;
  else if(!r.is_on_surface())
    outcome.result.status = CGAL::Mixed_mesh_status::NOT_ALL_ARRIVED;
}

// The work of a run, measured on the brain with 660 to 50,000 vertices.
Work_plan plan_for(Fit fit, std::size_t vertices)
{
  if(fit == Fit::NONE)
    return {0.6, 0.6, 10, 1};
  return {0.2, 0.9, 10, vertices <= 20000 ? 17u : 12u};
}

// Makes a mesh on the surface, or stops at a signal or the limit of time.
Mesh make_mesh_until_stopped(const Domain& domain, const Inputs& inputs, const Meshing_options& o,
                             const Relaxation_options& relaxation, Stage_log& log, Outcome& outcome)
{
  const Deferred_signals deferred({SIGINT}, Deferred_signals::Second::ENDS);
  log.stop_when([&] { return Deferred_signals::has_come() || log.seconds() > o.time_limit; });
  const auto regions = make_regions(inputs.regions, o.regions, log);
  Mesh mesh = o.nodes > 0 ? make_mesh_of_nodes(domain, regions, o, log, outcome)
                          : make_mesh(domain, regions, o, log, outcome);
  if(outcome.result.status == CGAL::Mixed_mesh_status::STOPPED && !outcome.result.has_mesh())
    Deferred_signals::take(); // a line tells that nothing is written, where the signal would end the program
  refuse(outcome.result, o);
  outcome.is_stopped = outcome.result.status == CGAL::Mixed_mesh_status::STOPPED;
  if(o.fit() == Fit::ALGORITHM_1 && !outcome.is_stopped)
    fit_by_algorithm_1(mesh, domain, relaxation, log, outcome);
  if(outcome.is_stopped) {
    const std::string by = Deferred_signals::has_come() ? "a signal" : "--time-limit";
    outcome.warnings.push_back(
      "stopped by " + by + " after " + duration(log.seconds())
      + ": the mesh is what there was then, and its boundary may be off the surface");
    Deferred_signals::take(); // another signal stops the following steps
  }
  return mesh;
}

void write_files(const Mesh& mesh, const std::vector<mm3::IO::Facet_set>& facet_sets,
                 const std::vector<Subdomain>& subdomains, const Options& o, Stage_log& log, Outcome& outcome)
{
  mm3::IO::Write_options write_options;
  write_options.msh_2_2 = o.msh2;
  write_options.order = o.order;
  write_options.facet_sets = facet_sets;
  mm3::IO::Subdomain_names subdomain_names;
  for(const Subdomain& s : subdomains)
    if(s.index != 0)
      subdomain_names.emplace(s.index, s.name);
  if(subdomains.size() > 1)
    write_options.subdomain_names = subdomain_names;
  const Deferred_signals deferred({SIGINT, SIGTERM, SIGHUP}, Deferred_signals::Second::DEFERRED);
  mm3::IO::Output_files files([] { return !Deferred_signals::has_come(); }); // appear together, at the end
  for(const std::string& path : o.outputs)
    log("write " + path, [&] { write_mesh(files, path, mesh, write_options); });
  if(!o.page.empty())
    log("write " + o.page, [&] {
      Page_data data{o.command, subdomain_names, o.is_in_patient_space()};
      data.files = inputs_of(o);
      for(const std::string& path : outputs_of(o))
        data.files.push_back(path);
      write_text(files, o.page, page(mesh, data, report(o, outcome, log)));
    });
  outcome.seconds = log.seconds();
  outcome.peak_bytes = log.peak_bytes();
  if(!o.report.empty())
    write_text(files, o.report, text_of(report(o, outcome, log)));
  require([&](std::string* error) { return files.commit(error); });
}

} // namespace

bool run(Options o)
{
  const Thread_limit limit(o.threads);
  check_feasible(o);
  if(!o.quiet && o.outputs.empty() && o.report.empty() && o.page.empty())
    std::cerr << "note: nothing will be written, without --output, --report and --page\n";
  if(!o.quiet && o.order == 2 && !o.tetrahedra)
    for(const std::string& path : o.outputs)
      if(mm3::IO::format_of(path) == mm3::IO::Format::INP)
        std::cerr << "note: " << path
                  << ": a mesh with pyramids will be refused, Abaqus has none of order 2; "
                  << "--tetrahedra gives a mesh without\n";
  Stage_log log(!o.quiet);
  Outcome outcome;
  const Inputs inputs = read_inputs(o, log, outcome);
  check_names_to_extract(o.extract, inputs.subdomains);
  if(o.label_choice
     == Label_choice::NONE) // layers of labels have been checked before their surfaces were made
    check_layers(layers_of(inputs.subdomains), o, outcome.warnings);
  if(o.tolerance > 0)
    check_tolerance(o.tolerance, o.surface, *inputs.boundary);
  Domain domain = log("AABB tree of surface", [&] { return make_domain(inputs.subdomains); });
  const std::vector<Sheet> sheets = add_sheets(o, domain, outcome.warnings);
  const std::vector<Patch> patches = read_patches(o, o, inputs.subdomains, outcome.warnings);
  check_regions(domain, inputs, o, outcome);
  log.expect(plan_for(o.fit(), o.vertices));
  constexpr unsigned seconds_until_exit = 2; // from Ctrl-C
  std::optional<Signal_deadline> deadline;
  deadline.emplace(seconds_until_exit,
                   "mixed_mesh_3: stopped by a signal: there was no mesh to write within "
                     + std::to_string(seconds_until_exit)
                     + " s, nothing is written; --time-limit waits for one",
                   1);
  Mesh mesh = make_mesh_until_stopped(domain, inputs, o, o, log, outcome);
  o.vertices = outcome.result.vertex_budget; // number found by --vertices auto
  const std::vector<std::string> warnings = outcome.warnings;
  Surface_tree tree;
  if(inputs.subdomains.size() == 1 && inputs.boundary == inputs.subdomains.front().surface) {
    tree = domain.tree_of_closest_points();
    if(sheets.empty())
      domain = Domain(); // a copy of a large surface, which nothing below needs
  }
  examine(mesh, *inputs.boundary, std::move(tree), o, log, outcome);
  examine_subdomains(mesh, domain, inputs.subdomains, o, outcome);
  std::vector<mm3::IO::Facet_set> facet_sets = examine_sheets(mesh, domain, sheets, o, outcome);
  outcome.nodes = number_of_nodes(mesh, o.order); // with those that --slit doubles
  extract(o.extract, o.order, o.budget(), inputs.subdomains, mesh, facet_sets, outcome);
  for(mm3::IO::Facet_set& set : interfaces_of(mesh, inputs.subdomains))
    facet_sets.push_back(std::move(set));
  for(mm3::IO::Facet_set& set : examine_patches(mesh, patches, outcome))
    facet_sets.push_back(std::move(set));
  if(outcome.is_stopped) // others would blame surface or options for unfinished work
    outcome.warnings = warnings;
  deadline.reset();
  write_files(mesh, facet_sets, inputs.subdomains, o, log, outcome);
  log.finish_progress();
  for(const std::string& warning : outcome.warnings)
    std::cerr << "warning: " << printable(warning) << '\n';
  if(!o.quiet)
    print_summary(o, outcome);
  return !outcome.is_stopped;
}
