// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The command-line mesher: from a surface, a region of interest and a vertex budget to mesh files and a
// report. Exit status: 0 all checks hold; 1 bad input, or no mesh for it, or a file that cannot be
// written; 2 wrong use; 3 the mesh failed a check (nothing is written).

#include "Stage_log.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Mixed_mesh_3/IO/write_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/split_to_tetrahedra.h>
#include <CGAL/Mixed_mesh_3/validation.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/make_mixed_mesh_3.h>
#include <CGAL/version.h>

#include <CLI/CLI.hpp>
#include <boost/version.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iomanip>
#include <iostream>
#include <limits>
#include <map>
#include <new>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <unistd.h>

namespace mm3 = CGAL::Mixed_meshes_3;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Mesh = CGAL::Mixed_mesh_3<Kernel>;
using Json = nlohmann::ordered_json;
using CGAL::Mixed_mesh_status;

struct Options
{
  std::string surface, region, report;
  std::vector<std::string> outputs;
  std::size_t vertices = 0;
  int base_level = CGAL::Mixed_mesh_criteria_3::automatic;
  mm3::Boundary_mode mode = mm3::Boundary_mode::VERTEX_ORDER;
  mm3::Root_cell root = mm3::Root_cell::CUBE;
  mm3::Transition_templates_choice templates = mm3::Transition_templates_choice::FEWEST_VERTICES;
  bool no_fit = false, msh2 = false, tetrahedra = false, quiet = false;
  unsigned threads = 1;
};

// The mesh failed a check: our fault, not the input's.
struct Invalid_mesh : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

void set_up(CLI::App& app, Options& o)
{
  const std::map<std::string, mm3::Boundary_mode> modes{{"default", mm3::Boundary_mode::VERTEX_ORDER},
                                                        {"paper", mm3::Boundary_mode::PAPER}};
  const std::map<std::string, mm3::Root_cell> roots{{"cube", mm3::Root_cell::CUBE},
                                                    {"box", mm3::Root_cell::BOX}};
  const std::map<std::string, mm3::Transition_templates_choice> templates{
    {"fewest", mm3::Transition_templates_choice::FEWEST_VERTICES},
    {"centred", mm3::Transition_templates_choice::CENTRED}};
  app.add_option("SURFACE", o.surface, "Closed surface of the domain: .off, .obj, .stl or .ply")
    ->required();
  app.add_option("--region", o.region,
                 "Closed surface of the region of interest, in the same coordinates (default: refine "
                 "everywhere)");
  app.add_option("--vertices", o.vertices, "Vertex budget: the mesh has at most that many vertices")
    ->required()
    ->check(CLI::PositiveNumber)
    ->type_name("N");
  app.add_option("--output", o.outputs,
                 "Mesh files: .vtu (VTK, ParaView), .msh (Gmsh), .mesh (Medit), .inp (Abaqus), .feb "
                 "(FEBio); can be given several times")
    ->type_name("FILE")
    ->allow_extra_args(false);
  app.add_option("--report", o.report, "Report with counts, quality, checks, times and memory")
    ->type_name("FILE.json");
  app.add_option("--base-level", o.base_level,
                 "Octree level of the whole domain; cells are 2^L times smaller than the root "
                 "(default: 3, or what the budget allows)")
    ->check(CLI::Range(0, 10))
    ->type_name("L");
  app.add_flag("--no-fit", o.no_fit, "Leave boundary vertices where the octree has them (the only way so far)");
  app.add_option("--mode", o.mode, "Boundary stage: default, or paper (tetrahedra by parity)")
    ->transform(CLI::CheckedTransformer(modes, CLI::ignore_case).description("{default,paper}"))
    ->type_name("MODE");
  app.add_option("--root", o.root, "Root cell: cube (default), or box (the bounding box, as the paper)")
    ->transform(CLI::CheckedTransformer(roots, CLI::ignore_case).description("{cube,box}"))
    ->type_name("ROOT");
  app.add_option("--templates", o.templates,
                 "Transition templates: fewest (vertices, default), or centred (a vertex in each)")
    ->transform(CLI::CheckedTransformer(templates, CLI::ignore_case).description("{fewest,centred}"))
    ->type_name("CHOICE");
  app.add_flag("--msh2", o.msh2, "Write .msh files in Gmsh's format 2.2 instead of 4.1");
  app.add_flag("--tetrahedra", o.tetrahedra,
               "Split all elements to tetrahedra, for solvers without the other kinds");
  app.add_flag("--quiet", o.quiet, "Print errors and warnings only");
  app.add_option("--threads", o.threads, "Threads for queries on the surface; the mesh is the same")
    ->check(CLI::Range(1, 256))
    ->type_name("T");
  app.set_version_flag("--version", "mixed_mesh_3 0.1 (CGAL " CGAL_VERSION_STR ")");
  app.footer("Lengths are in the unit of SURFACE. Example:\n"
             "  mixed_mesh_3 data/brain.off --region data/region.off --vertices 660 --output brain.vtu");
}

// Physical memory, or the limit of the control group if that is less. Unknown: infinite.
double available_memory()
{
  const double pages = double(sysconf(_SC_PHYS_PAGES)), page = double(sysconf(_SC_PAGE_SIZE));
  double bytes = pages > 0 && page > 0 ? pages * page : std::numeric_limits<double>::infinity(), limit;
  if(std::ifstream("/sys/fs/cgroup/memory.max") >> limit && limit > 0)
    bytes = (std::min)(bytes, limit);
  return bytes;
}

// Before anything takes time: what can not be written, or not fit into memory.
void check_feasible(const Options& o)
{
  std::vector<std::string> outputs = o.outputs;
  for(const std::string& path : o.outputs)
    if(const auto error = mm3::IO::check_output_path(path))
      throw std::runtime_error(*error);
  if(!o.report.empty()) {
    if(const auto error = mm3::IO::check_output_directory(o.report))
      throw std::runtime_error(*error);
    outputs.push_back(o.report);
  }
  std::set<std::filesystem::path> seen;
  for(const std::string& path : outputs) {
    std::error_code ignored;
    for(const std::string& input : {o.surface, o.region})
      if(std::filesystem::equivalent(path, input, ignored))
        throw std::runtime_error(path + ": is given twice, as input and as output");
    if(!seen.insert(std::filesystem::weakly_canonical(path, ignored)).second)
      throw std::runtime_error(path + ": is given twice as output");
  }
  constexpr double bytes_per_vertex = 700; // more than measured
  const double needed = double(o.vertices) * bytes_per_vertex, available = available_memory();
  const auto gibibytes = [](double bytes) { return std::to_string(std::size_t(bytes / (1 << 30)) + 1); };
  if(needed > available)
    throw std::runtime_error("--vertices " + std::to_string(o.vertices) + ": would need about "
                             + gibibytes(needed) + " GiB of memory, of " + gibibytes(available) + " GiB");
  if(o.vertices > 1000000000u || (o.tetrahedra && o.vertices > 500000000u))
    throw std::runtime_error("--vertices " + std::to_string(o.vertices)
                             + ": more than the 32-bit indices of the files allow");
}

Surface read(const std::string& path, Json& report, std::vector<std::string>& warnings)
{
  Surface surface;
  const mm3::IO::Surface_input input = mm3::IO::read_closed_surface(path, surface);
  for(const std::string& warning : input.warnings)
    warnings.push_back(path + ": " + warning);
  report = {{"file", path},
            {"points", input.number_of_points},
            {"polygons", input.number_of_polygons},
            {"vertices", surface.number_of_vertices()},
            {"triangles", surface.number_of_faces()},
            {"components", input.number_of_components},
            {"volume", input.volume}};
  return surface;
}

const char* name_of(Mixed_mesh_status status)
{
  switch(status) {
  case Mixed_mesh_status::SUCCESS: return "success";
  case Mixed_mesh_status::BUDGET_NOT_FILLED: return "budget not filled";
  case Mixed_mesh_status::PARTS_LOST: return "parts lost";
  case Mixed_mesh_status::BUDGET_TOO_SMALL: return "budget too small";
  case Mixed_mesh_status::EMPTY: return "empty";
  case Mixed_mesh_status::REGION_NOT_MET: return "region not met";
  case Mixed_mesh_status::BOUNDARY_NOT_MANIFOLD: return "boundary not manifold";
  case Mixed_mesh_status::STOPPED: return "stopped";
  }
  return "";
}

void check_result(const CGAL::Mixed_mesh_result_3& result, const Options& o, const Mesh& mesh,
                  double surface_volume, double mesh_volume, std::vector<std::string>& warnings)
{
  switch(result.status) {
  case Mixed_mesh_status::BUDGET_TOO_SMALL:
    throw std::runtime_error("--vertices " + std::to_string(o.vertices) + ": too small, the coarsest mesh "
                             "of " + o.surface + " at base level " + std::to_string(result.base_level)
                             + " has at least " + std::to_string(result.number_of_vertices_needed)
                             + " vertices");
  case Mixed_mesh_status::EMPTY:
    throw std::runtime_error(o.surface + ": too thin for this budget, no octree vertex is inside; try "
                             "more vertices or a larger --base-level");
  case Mixed_mesh_status::REGION_NOT_MET:
    throw std::runtime_error(o.region + ": the region does not meet the domain of " + o.surface);
  case Mixed_mesh_status::STOPPED:
    throw std::runtime_error("stopped");
  case Mixed_mesh_status::BOUNDARY_NOT_MANIFOLD:
    throw Invalid_mesh("the boundary is pinched at the border of the root cell; try another --base-level");
  case Mixed_mesh_status::BUDGET_NOT_FILLED:
  case Mixed_mesh_status::PARTS_LOST:
  case Mixed_mesh_status::SUCCESS:
    break;
  }
  if(double(mesh.number_of_vertices()) < 0.97 * double(o.vertices))
    warnings.push_back("only " + std::to_string(mesh.number_of_vertices()) + " of "
                       + std::to_string(o.vertices) + " vertices used: the region cannot be refined "
                       "further, or each further cell tried would exceed the budget");
  if(result.number_of_lost_cells != 0) {
    const CGAL::Bbox_3& b = result.lost_cells;
    std::ostringstream where;
    where << '[' << b.xmin() << ", " << b.xmax() << "] x [" << b.ymin() << ", " << b.ymax() << "] x ["
          << b.zmin() << ", " << b.zmax() << ']';
    warnings.push_back(o.surface + ": parts thinner than a cell are lost: "
                       + std::to_string(result.number_of_lost_cells) + " octree cells that they meet are "
                       "away from the mesh, within " + where.str()
                       + "; try more vertices or a larger --base-level");
  }
  // Before the boundary is fitted, the cells around it add some volume; corners cut off take some.
  const double ratio = mesh_volume / surface_volume;
  if(ratio < 0.9 || ratio > 4) {
    std::ostringstream text;
    text << o.surface << ": the mesh has " << std::setprecision(3) << ratio
         << " times the surface's volume: it is too coarse for the domain; try more vertices or a larger "
            "--base-level";
    warnings.push_back(text.str());
  }
}

Json checks_of(const mm3::Mesh_defects& d)
{
  return {{"conforming", d.conforming()},
          {"closed manifold boundary", d.closed_manifold_boundary()},
          {"corner tetrahedra positive (exact)", d.nonpositive_corners == 0},
          {"Jacobian positive on whole elements (exact)", d.positive()},
          {"no unused vertex", d.unused_vertices == 0},
          {"no duplicate vertex", d.duplicate_vertices == 0}};
}

Json quality_of(const Mesh& mesh)
{
  Json quality = Json::object();
  const auto rows = mm3::quality_statistics(mesh);
  for(std::size_t row = 0; row < rows.size(); ++row)
    quality[row < mm3::number_of_element_kinds ? mm3::reference_elements[row].plural : "all"] = {
      {"elements", rows[row].count},
      {"ARC mean", rows[row].mean},
      {"ARC max", rows[row].maximum},
      {"share of ARC <= 7", rows[row].share_at_most_7}};
  return quality;
}

Json costs_of(const Stage_log& log)
{
  Json stages = Json::array();
  for(const Stage_cost& c : log.costs())
    stages.push_back({{"stage", c.name},
                      {"seconds", c.seconds},
                      {"CPU seconds", c.cpu_seconds},
                      {"peak memory MiB", double(c.peak_bytes) / (1 << 20)}});
  return stages;
}

void print_summary(const Mesh& mesh, const Options& o, const Json& report)
{
  std::cout << mesh.number_of_vertices() << " vertices of " << o.vertices << ", "
            << mesh.number_of_elements() << " elements (";
  const auto counts = mesh.elements().counts();
  for(int k = mm3::number_of_element_kinds - 1; k >= 0; --k)
    std::cout << counts[std::size_t(k)] << ' ' << mm3::reference_elements[k].plural << (k > 0 ? ", " : ")\n");
  const Json& all = report["quality"]["all"];
  std::cout << std::setprecision(3) << "ARC mean " << double(all["ARC mean"]) << ", max "
            << double(all["ARC max"]) << "; all checks hold; " << double(report["seconds"]) << " s\n";
  for(const std::string& path : o.outputs)
    std::cout << "wrote " << path << '\n';
  if(!o.report.empty())
    std::cout << "wrote " << o.report << '\n';
}

void run(const Options& o)
{
  check_feasible(o);
  Stage_log log(!o.quiet && isatty(STDERR_FILENO));
  std::vector<std::string> warnings;
  Json report;
  report["program"] = {{"name", "mixed_mesh_3"},
                       {"version", "0.1"},
                       {"CGAL", CGAL_VERSION_STR},
                       {"Boost", BOOST_LIB_VERSION}};

  Json surface_report, region_report;
  const Surface surface =
    log("read surface", [&] { return read(o.surface, surface_report, warnings); });
  Surface region_surface;
  if(!o.region.empty())
    region_surface = log("read region", [&] { return read(o.region, region_report, warnings); });
  report["inputs"] = {{"surface", surface_report}, {"region", region_report}};
  report["options"] = {{"vertices", o.vertices},
                       {"base level", o.base_level == CGAL::Mixed_mesh_criteria_3::automatic
                                        ? Json("automatic") : Json(o.base_level)},
                       {"mode", o.mode == mm3::Boundary_mode::PAPER ? "paper" : "default"},
                       {"root", o.root == mm3::Root_cell::BOX ? "box" : "cube"},
                       {"templates", o.templates == mm3::Transition_templates_choice::CENTRED
                                       ? "centred" : "fewest"},
                       {"fit", false},
                       {"tetrahedra", o.tetrahedra},
                       {"msh version", o.msh2 ? "2.2" : "4.1"},
                       {"threads", o.threads}};

  const auto criteria = CGAL::Mixed_mesh_criteria_3(o.vertices)
                          .base_level(o.base_level)
                          .boundary_mode(o.mode)
                          .root_cell(o.root)
                          .transition_templates(o.templates)
                          .number_of_threads(o.threads);
  Mesh mesh;
  CGAL::Mixed_mesh_result_3 result;
  const auto domain = log("AABB tree of surface", [&] {
    return CGAL::Polyhedral_mixed_mesh_domain_3(surface);
  });
  const auto np = CGAL::parameters::visitor(std::ref(log));
  if(o.region.empty()) {
    result = CGAL::make_mixed_mesh_3(domain, CGAL::Everywhere_mixed_mesh_region_3(), criteria, mesh, np);
  } else {
    const auto region = log("AABB tree of region", [&] {
      return CGAL::Polyhedral_mixed_mesh_region_3(region_surface);
    });
    result = CGAL::make_mixed_mesh_3(domain, region, criteria, mesh, np);
  }
  if(o.tetrahedra) // now, so that what is checked and reported is what is written
    mesh = log("split to tetrahedra", [&] { return mm3::split_to_tetrahedra(mesh); });
  const double mesh_volume = mm3::volume(mesh);
  check_result(result, o, mesh, surface_report["volume"], mesh_volume, warnings);

  const mm3::Mesh_defects defects = log("checks", [&] { return mm3::find_defects(mesh); });
  const Json checks = checks_of(defects);
  for(const auto& check : checks.items())
    if(!check.value())
      throw Invalid_mesh("the mesh failed the check: " + check.key());

  const auto counts = mesh.elements().counts();
  std::size_t in_region = 0;
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
    in_region += mesh.is_in_region(e);
  report["status"] = name_of(result.status);
  report["mesh"] = {{"vertices", mesh.number_of_vertices()},
                    {"share of budget", double(mesh.number_of_vertices()) / double(o.vertices)},
                    {"elements", mesh.number_of_elements()},
                    {"elements in region", in_region},
                    {"boundary faces", mesh.boundary_faces().size()},
                    {"volume", mesh_volume}};
  for(int k = 0; k < mm3::number_of_element_kinds; ++k)
    report["mesh"][mm3::reference_elements[k].plural] = counts[std::size_t(k)];
  report["octree"] = {{"base level", result.base_level},
                      {"deepest level", result.deepest_level},
                      {"cells", result.number_of_cells},
                      {"cells lost", result.number_of_lost_cells},
                      {"octrees tried", result.number_of_trials}};
  report["vertices inserted"] = {{"by transition templates", result.number_of_transition_vertices},
                                 {"by boundary stage", result.number_of_boundary_vertices_inserted}};
  report["vertices labelled inside for a manifold boundary"] = result.number_of_relabelled_vertices;
  report["quality"] = log("quality", [&] { return quality_of(mesh); });
  report["checks"] = checks;

  mm3::IO::Write_options write_options;
  write_options.msh_2_2 = o.msh2;
  mm3::IO::Output_files files; // appear together, at the end
  for(const std::string& path : o.outputs)
    if(const auto error = log("write " + path, [&] {
         return mm3::IO::write_mixed_mesh(files, path, mesh, write_options);
       }))
      throw std::runtime_error(*error);
  report["outputs"] = o.outputs;
  report["warnings"] = warnings;
  report["stages"] = costs_of(log);
  report["seconds"] = log.seconds();
  report["peak memory MiB"] = double(log.peak_bytes()) / (1 << 20);
  if(!o.report.empty())
    if(const auto error = files.write(o.report, [&](std::ostream& stream) {
         // file names need not be UTF-8
         return bool(stream << report.dump(2, ' ', false, Json::error_handler_t::replace) << '\n');
       }))
      throw std::runtime_error(*error);
  if(const auto error = files.commit())
    throw std::runtime_error(*error);
  log.finish_progress();
  for(const std::string& warning : warnings)
    std::cerr << "warning: " << warning << '\n';
  if(!o.quiet)
    print_summary(mesh, o, report);
}

int main(int argc, char** argv)
{
  Options options;
  CLI::App app("Makes a mixed-element (hexahedra, prisms, pyramids, tetrahedra) finite-element mesh of the "
               "domain inside a closed surface, fine in a region of interest, within a vertex budget.");
  set_up(app, options);
  try {
    app.parse(argc, argv);
  } catch(const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }
  const auto fail = [](const std::exception& e, int status) {
    std::cerr << "mixed_mesh_3: error: " << e.what() << '\n';
    return status;
  };
  try {
    run(options);
    return 0;
  } catch(const Invalid_mesh& e) {
    return fail(e, 3);
  } catch(const std::bad_alloc&) {
    return fail(std::runtime_error("out of memory; try a smaller --vertices"), 1);
  } catch(const std::exception& e) {
    return fail(e, 1);
  }
}
