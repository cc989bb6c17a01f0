// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The command-line mesher: from a surface, a region of interest and a vertex budget to mesh files and a
// report. Exit status: 0 all checks hold; 1 bad input, or no mesh for it, or a file that cannot be
// written; 2 wrong use; 3 the mesh failed a check (nothing is written).

#include "common/Stage_log.h"
#include "common/command_line.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Mixed_mesh_3/IO/write_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/split_to_tetrahedra.h>
#include <CGAL/Mixed_mesh_3/surface_distance.h>
#include <CGAL/Mixed_mesh_3/validation.h>
#include <CGAL/Mixed_mesh_fit_criteria_3.h>
#include <CGAL/Mixed_mesh_fit_result_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/make_mixed_mesh_3.h>
#include <CGAL/optimize_mixed_mesh_3.h>
#include <CGAL/version.h>

#if __has_include(<Eigen/SparseCholesky>)
#define MIXED_MESH_3_HAS_EIGEN 1 // the paper's Algorithm 1 solves linear systems, all else does not
#include <CGAL/fit_mixed_mesh_to_surface.h>
#else
#define MIXED_MESH_3_HAS_EIGEN 0
#endif

#include <CLI/CLI.hpp>
#include <boost/version.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>
#include <filesystem>
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
using CGAL::Mixed_mesh_fit_criteria_3;
using CGAL::Mixed_mesh_status;

/// How the boundary gets onto the surface.
enum class Fit { NONE, OPTIMIZATION, ALGORITHM_1 };
/// What solves the linear systems of Algorithm 1.
enum class Solver { CG, LDLT, CHOLMOD };

const char* const fit_names[] = {"none", "optimization", "Algorithm 1"};
const char* const solver_names[] = {"cg", "ldlt", "cholmod"};

struct Options
{
  std::string surface, region, report;
  std::vector<std::string> outputs;
  std::size_t vertices = 0;
  int base_level = CGAL::Mixed_mesh_criteria_3::automatic;
  mm3::Boundary_mode mode = mm3::Boundary_mode::VERTEX_ORDER;
  mm3::Root_cell root = mm3::Root_cell::CUBE;
  mm3::Transition_templates_choice templates = mm3::Transition_templates_choice::FEWEST_VERTICES;
  bool no_fit = false, no_optimize = false, msh2 = false, tetrahedra = false, quiet = false;
  double tolerance = 0;
  unsigned threads = 1;

  // of Algorithm 1
  int steps = Mixed_mesh_fit_criteria_3().number_of_steps();
  int layers = Mixed_mesh_fit_criteria_3::automatic;
  double poisson_ratio = Mixed_mesh_fit_criteria_3().poisson_ratio();
  double stiffness_factor = Mixed_mesh_fit_criteria_3().stiffness_factor();
  double maximal_stiffness = Mixed_mesh_fit_criteria_3().maximal_stiffness();
  double acceptable_quality = Mixed_mesh_fit_criteria_3().acceptable_aspect_ratio();
  Solver solver = Solver::CG;

  Fit fit() const { return no_fit ? Fit::NONE : no_optimize ? Fit::ALGORITHM_1 : Fit::OPTIMIZATION; }
};

// The mesh failed a check: our fault, not the input's.
struct Invalid_mesh : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

// The options of the paper's way onto the surface; they need --no-optimize.
void set_up_algorithm_1(CLI::App& app, Options& o, CLI::Option* no_optimize)
{
  const std::map<std::string, Solver> solvers{
    {"cg", Solver::CG}, {"ldlt", Solver::LDLT}, {"cholmod", Solver::CHOLMOD}};
  const auto at_least_1 = number("of at least 1", [](double x) { return x >= 1; });
  const auto below_one_half = number("of at least 0 and below 0.5", [](double x) { return x >= 0 && x < 0.5; });
  std::vector<CLI::Option*> options{
    app.add_option("--steps", o.steps, "Steps to the surface, the paper's MAX_STEP")
      ->check(CLI::Range(1, 1000))
      ->type_name("N")
      ->capture_default_str(),
    app.add_option("--poisson-ratio", o.poisson_ratio, "Poisson's ratio of the elastic medium")
      ->check(below_one_half)
      ->type_name("NU")
      ->capture_default_str(),
    app.add_option("--stiffness-factor", o.stiffness_factor,
                   "By how much an element of bad quality is stiffened at a time")
      ->check(number("greater than 1", [](double x) { return x > 1; }))
      ->type_name("F")
      ->capture_default_str(),
    app.add_option("--max-stiffness", o.maximal_stiffness,
                   "Largest stiffness, as a multiple of that at the start, the paper's Y_MAX")
      ->check(at_least_1)
      ->type_name("Y")
      ->capture_default_str(),
    app.add_option("--acceptable-quality", o.acceptable_quality,
                   "Elements of a larger aspect-ratio coefficient are stiffened")
      ->check(at_least_1)
      ->type_name("ARC")
      ->capture_default_str(),
    app.add_option("--solver", o.solver,
                   "Linear solver: cg (conjugate gradients), ldlt (Eigen's simplicial factorization), or "
                   "cholmod (SuiteSparse's supernodal one, if built with it)")
      ->transform(CLI::CheckedTransformer(solvers, CLI::ignore_case).description("{cg,ldlt,cholmod}"))
      ->type_name("SOLVER")
      ->default_str("cg")};
  options.push_back(app.add_option("--layers", o.layers,
                                   "Only vertices within so many layers of elements from the boundary move "
                                   "(default: all of a mesh of up to 3,000 vertices, 4 of a larger one)")
                      ->check(CLI::Range(0, Mixed_mesh_fit_criteria_3::all_layers))
                      ->type_name("L"));
  for(CLI::Option* option : options)
    option->needs(no_optimize)->group("Options of --no-optimize");
}

void set_up(CLI::App& app, Options& o)
{
  const std::map<std::string, mm3::Boundary_mode> modes{{"default", mm3::Boundary_mode::VERTEX_ORDER},
                                                        {"paper", mm3::Boundary_mode::PAPER}};
  const std::map<std::string, mm3::Root_cell> roots{{"cube", mm3::Root_cell::CUBE},
                                                    {"box", mm3::Root_cell::BOX}};
  const std::map<std::string, mm3::Transition_templates_choice> templates{
    {"fewest", mm3::Transition_templates_choice::FEWEST_VERTICES},
    {"centered", mm3::Transition_templates_choice::CENTERED}};
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
                 "(default: 3; coarser or finer as the budget says)")
    ->check(CLI::Range(0, 10))
    ->type_name("L");
  CLI::Option* no_fit = app.add_flag("--no-fit", o.no_fit, "Leave boundary vertices where the octree has them");
  CLI::Option* no_optimize =
    app.add_flag("--no-optimize", o.no_optimize,
                 "Carry the boundary onto the surface as the paper does (Algorithm 1), without optimization")
      ->excludes(no_fit);
  app.add_option("--tolerance", o.tolerance,
                 "How far boundary and surface may be from each other, in the unit of SURFACE: part of the "
                 "budget is spent outside the region for that; takes longer")
    ->check(number("greater than 0", [](double x) { return x > 0; }))
    ->type_name("D")
    ->excludes(no_fit)
    ->excludes(no_optimize);
  app.add_option("--mode", o.mode, "Boundary stage: default, or paper (tetrahedra by parity)")
    ->transform(CLI::CheckedTransformer(modes, CLI::ignore_case).description("{default,paper}"))
    ->type_name("MODE");
  app.add_option("--root", o.root, "Root cell: cube (default), or box (the bounding box, as the paper)")
    ->transform(CLI::CheckedTransformer(roots, CLI::ignore_case).description("{cube,box}"))
    ->type_name("ROOT");
  app.add_option("--templates", o.templates,
                 "Transition templates: fewest (vertices, default), or centered (a vertex in each)")
    ->transform(CLI::CheckedTransformer(templates, CLI::ignore_case).description("{fewest,centered}"))
    ->type_name("CHOICE");
  app.add_flag("--msh2", o.msh2, "Write .msh files in Gmsh's format 2.2 instead of 4.1");
  app.add_flag("--tetrahedra", o.tetrahedra,
               "Split all elements to tetrahedra, for solvers without the other kinds");
  app.add_flag("--quiet", o.quiet, "Print errors and warnings only");
  app.add_option("--threads", o.threads, "Threads for queries on the surface; the mesh is the same")
    ->check(CLI::Range(1, 256))
    ->type_name("T");
  set_up_algorithm_1(app, o, no_optimize);
  app.set_version_flag("--version", "mixed_mesh_3 0.1 (CGAL " CGAL_VERSION_STR ")");
  app.footer("Lengths are in the unit of SURFACE. Example:\n"
             "  mixed_mesh_3 data/brain.off --region data/region.off --vertices 660 --output brain.vtu");
}

template <class Point>
std::string place(const Point& p)
{
  std::ostringstream text; // more digits than for a distance: the domain may be far from the origin
  text << '(' << p.x() << ", " << p.y() << ", " << p.z() << ')';
  return text.str();
}

// What this program was built without is wrong use.
void check_built_with(const Options& o)
{
  if(o.no_optimize && !MIXED_MESH_3_HAS_EIGEN)
    throw CLI::ValidationError("--no-optimize", "this program was built without Eigen");
#ifndef CGAL_MIXED_MESH_3_USE_CHOLMOD
  if(o.solver == Solver::CHOLMOD)
    throw CLI::ValidationError("--solver cholmod", "this program was built without CHOLMOD");
#endif
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
  // More than measured with 100,000 and 200,000 vertices; a direct solver takes more.
  const double bytes_per_vertex = o.fit() == Fit::ALGORITHM_1 ? 3000 : o.tetrahedra ? 1500 : 1100;
  const double needed = double(o.vertices) * bytes_per_vertex, available = available_memory();
  if(needed > available)
    throw std::runtime_error("--vertices " + std::to_string(o.vertices) + ": would need about "
                             + gibibytes(needed) + " GiB of memory, of " + gibibytes(available) + " GiB");
  if(o.vertices > 1000000000u || (o.tetrahedra && o.vertices > 500000000u))
    throw std::runtime_error("--vertices " + std::to_string(o.vertices)
                             + ": more than the 32-bit indices of the files allow");
}

// The library looks at points of the surface in a grid of twice the tolerance.
void check_tolerance(const Options& o, const Surface& surface)
{
  constexpr double most = 1e7; // takes an hour
  double number = 0;
  for(const auto f : faces(surface)) {
    double longest = 0;
    for(const auto h : halfedges_around_face(halfedge(f, surface), surface))
      longest = (std::max)(longest, CGAL::squared_distance(surface.point(source(h, surface)),
                                                           surface.point(target(h, surface))));
    const double n = (std::min)(std::ceil(std::sqrt(longest) / (2 * o.tolerance)), 1000.);
    number += 0.5 * (n - 1) * n;
  }
  if(number > most)
    throw std::runtime_error("--tolerance " + rounded(o.tolerance) + ": too small for " + o.surface
                             + ", it would take hours; " + rounded(o.tolerance * std::sqrt(number / most))
                             + " takes about one");
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
  case Mixed_mesh_status::TOLERANCE_NOT_REACHED: return "tolerance not reached";
  case Mixed_mesh_status::NOT_ALL_ARRIVED: return "not all arrived";
  case Mixed_mesh_status::PARTS_LOST: return "parts lost";
  case Mixed_mesh_status::BUDGET_TOO_SMALL: return "budget too small";
  case Mixed_mesh_status::EMPTY: return "empty";
  case Mixed_mesh_status::REGION_NOT_MET: return "region not met";
  case Mixed_mesh_status::BOUNDARY_NOT_MANIFOLD: return "boundary not manifold";
  case Mixed_mesh_status::STOPPED: return "stopped";
  }
  return "";
}

const char* name_of(CGAL::Mixed_mesh_fit_status status)
{
  using Status = CGAL::Mixed_mesh_fit_status;
  switch(status) {
  case Status::SUCCESS: return "success";
  case Status::CAP_REACHED: return "cap reached";
  case Status::NOT_ALL_ARRIVED: return "not all arrived";
  case Status::SOLVER_FAILED: return "solver failed";
  case Status::STOPPED: return "stopped";
  case Status::INVALID_MESH: return "invalid mesh";
  case Status::EMPTY: return "empty";
  }
  return "";
}

const char* name_of(CGAL::Mixed_mesh_optimization_status status)
{
  using Status = CGAL::Mixed_mesh_optimization_status;
  switch(status) {
  case Status::SUCCESS: return "success";
  case Status::TOLERANCE_NOT_REACHED: return "tolerance not reached";
  case Status::NOT_ALL_ARRIVED: return "not all arrived";
  case Status::STOPPED: return "stopped";
  case Status::INVALID_MESH: return "invalid mesh";
  case Status::EMPTY: return "empty";
  }
  return "";
}

// Throws where there is no mesh.
void refuse(const CGAL::Mixed_mesh_result_3& result, const Options& o)
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
  case Mixed_mesh_status::TOLERANCE_NOT_REACHED:
  case Mixed_mesh_status::NOT_ALL_ARRIVED:
  case Mixed_mesh_status::PARTS_LOST:
  case Mixed_mesh_status::SUCCESS:
    break;
  }
}

/// How the boundary of the mesh lies to the surface.
struct Fidelity
{
  mm3::Hausdorff_distance distance;
  double volume_of_mesh = 0, volume_of_surface = 0;
  std::size_t vertices = 0;     // on the boundary
  std::size_t vertices_off = 0; // of which are not on the surface
  std::size_t self_intersections = 0;

  double ratio_of_volumes() const { return volume_of_mesh / volume_of_surface; }
};

constexpr double on_surface = 1e-9; // of the diagonal of the surface's box

// Needs a boundary that is a closed manifold.
Fidelity fidelity_of(const Mesh& mesh, const Surface& surface, double volume_of_surface)
{
  std::set<mm3::Vertex_index> vertices;
  for(const auto& f : mesh.boundary_faces())
    for(mm3::Vertex_index v : mm3::internal::face_vertices(mesh.element(f.element), f.local_face))
      if(v != mm3::internal::no_vertex)
        vertices.insert(v);
  Fidelity f;
  f.distance = mm3::hausdorff_distance(mesh, surface);
  f.volume_of_mesh = mm3::volume(mesh);
  f.volume_of_surface = volume_of_surface;
  f.vertices = vertices.size();
  f.vertices_off = mm3::number_of_vertices_off_surface(mesh, surface, on_surface);
  f.self_intersections = mm3::number_of_boundary_self_intersections(mesh);
  return f;
}

// What the user should know of a mesh that is valid.
std::vector<std::string> warnings_of(const CGAL::Mixed_mesh_result_3& result, const Options& o,
                                     const Mesh& mesh, const Fidelity& fidelity)
{
  std::vector<std::string> warnings;
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
  if(o.fit() != Fit::NONE && fidelity.vertices_off != 0)
    warnings.push_back(std::to_string(fidelity.vertices_off) + " of " + std::to_string(fidelity.vertices)
                       + " boundary vertices are not on " + o.surface
                       + ": elements would be inverted, or coordinates are too large to tell");
  if(o.tolerance > 0 && fidelity.distance.distance() > o.tolerance) {
    const bool is_on_mesh = fidelity.distance.from_mesh.distance > fidelity.distance.from_surface.distance;
    const auto& d = is_on_mesh ? fidelity.distance.from_mesh : fidelity.distance.from_surface;
    warnings.push_back("--tolerance " + rounded(o.tolerance) + ": not reached, "
                       + (is_on_mesh ? "the mesh at " + place(d.from) + " is " + rounded(d.distance)
                                         + " away from " + o.surface
                                     : o.surface + " at " + place(d.from) + " is " + rounded(d.distance)
                                         + " away from the mesh")
                       + "; try more vertices");
  }
  // Before the boundary is fitted, the cells around it add some volume; corners cut off take some.
  const bool is_fitted = o.fit() != Fit::NONE;
  const double ratio = fidelity.ratio_of_volumes();
  if(ratio < 0.9 || ratio > (is_fitted ? 1.1 : 4))
    warnings.push_back(o.surface + ": the mesh has " + rounded(ratio) + " times the surface's volume: it is "
                       "too coarse for the domain; try more vertices or a larger --base-level"
                       + (o.fit() == Fit::OPTIMIZATION && o.tolerance == 0 ? ", or --tolerance" : ""));
  return warnings;
}

void check(const mm3::Mesh_defects& d, const Fidelity& fidelity, Json& report)
{
  report = {{"conforming", d.conforming()},
            {"closed manifold boundary", d.closed_manifold_boundary()},
            {"boundary does not cut itself (exact)", fidelity.self_intersections == 0},
            {"corner tetrahedra positive (exact)", d.nonpositive_corners == 0},
            {"Jacobian positive on whole elements (exact)", d.positive()},
            {"no unused vertex", d.unused_vertices == 0},
            {"no duplicate vertex", d.duplicate_vertices == 0}};
  for(const auto& check : report.items())
    if(!check.value())
      throw Invalid_mesh("the mesh failed the check: " + check.key()
                         + (d.none() ? ": " + std::to_string(fidelity.self_intersections) + " pairs of faces; "
                                       "try more vertices, a larger --base-level, or --no-fit"
                                     : ""));
}

const char* row_name(std::size_t row)
{
  return row < mm3::number_of_element_kinds ? mm3::reference_elements[row].plural : "all";
}

// A number, or null for what has none: no element, or infinity.
Json value(const mm3::Quality_statistics& row, double x) { return row.count == 0 ? Json() : Json(x); }

// The paper's Table 1.
Json aspect_ratios_of(const Mesh& mesh)
{
  const auto rows = mm3::quality_statistics(mesh);
  const auto in_interval = mm3::quality_statistics(mesh, mm3::aspect_ratio_coefficient, 1.3, 7);
  Json table = Json::object();
  for(std::size_t i = 0; i < rows.size(); ++i)
    table[row_name(i)] = {{"elements", rows[i].count},
                          {"ARC mean", value(rows[i], rows[i].mean)},
                          {"ARC min", value(rows[i], rows[i].minimum)},
                          {"ARC max", value(rows[i], rows[i].maximum)},
                          {"share of ARC <= 7", value(rows[i], rows[i].share)},
                          {"share of ARC in [1.3, 7]", value(rows[i], in_interval[i].share)}};
  return table;
}

template <class Measure>
Json values_of(const Mesh& mesh, const Measure& measure)
{
  const auto rows = mm3::quality_statistics(mesh, measure);
  Json table = Json::object();
  for(std::size_t i = 0; i < rows.size(); ++i)
    table[row_name(i)] = {{"mean", value(rows[i], rows[i].mean)},
                          {"min", value(rows[i], rows[i].minimum)},
                          {"max", value(rows[i], rows[i].maximum)}};
  return table;
}

// Where the bins of the histogram end: the first one has all below 1.1, the last one all from 3 on.
std::vector<double> histogram_edges()
{
  std::vector<double> edges;
  for(int tenths = 11; tenths <= 30; ++tenths)
    edges.push_back(tenths / 10.);
  return edges;
}

// Part of report["quality"]: `when` is "before" or "after" the boundary is fitted.
void describe_quality(const Mesh& mesh, const char* when, Json& quality)
{
  const std::vector<double> edges = histogram_edges();
  quality[when] = aspect_ratios_of(mesh);
  quality["histograms"]["ARC"]["edges"] = edges;
  quality["histograms"]["ARC"][when] = mm3::histogram(mesh, mm3::aspect_ratio_coefficient, edges);
}

// The other measures, of the mesh that is written.
void describe_shapes(const Mesh& mesh, Json& quality)
{
  quality["scaled Jacobian"] = values_of(mesh, mm3::scaled_jacobian);
  quality["smallest dihedral angle"] = values_of(mesh, mm3::smallest_dihedral_angle);
  quality["largest dihedral angle"] = values_of(mesh, mm3::largest_dihedral_angle);
  quality["quad warp"] = values_of(mesh, mm3::quad_warp);
  quality["quad warp"].erase("tetrahedra"); // has no quadrilaterals
  quality["quad warp"]["all"].erase("mean");
}

Json distance_of(const mm3::One_sided_distance& d)
{
  const auto point = [](const auto& p) { return Json{p.x(), p.y(), p.z()}; };
  return {{"distance", d.distance}, {"error", d.error}, {"at", point(d.from)}, {"nearest", point(d.to)}};
}

Json describe(const Fidelity& f)
{
  return {{"Hausdorff distance",
           {{"method", "branch and bound on triangles, not sampled: no point is farther than distance + error"},
            {"distance", f.distance.distance()},
            {"from mesh to surface", distance_of(f.distance.from_mesh)},
            {"from surface to mesh", distance_of(f.distance.from_surface)}}},
          {"volume of mesh", f.volume_of_mesh},
          {"volume of surface", f.volume_of_surface},
          {"ratio of volumes", f.ratio_of_volumes()},
          {"boundary vertices", f.vertices},
          {"boundary vertices not on surface", f.vertices_off},
          {"on surface means within, of the diagonal", on_surface},
          {"boundary self-intersections", f.self_intersections}};
}

Json describe(const CGAL::Mixed_mesh_optimization_result_3& r)
{
  return {{"method", fit_names[int(Fit::OPTIMIZATION)]},
          {"status", name_of(r.status)},
          {"boundary vertices", r.number_of_boundary_vertices},
          {"arrived", r.number_of_arrived_vertices},
          {"rounds", r.number_of_rounds},
          {"flips", r.number_of_flips}};
}

Json describe(const CGAL::Mixed_mesh_fit_result_3& r)
{
  return {{"method", fit_names[int(Fit::ALGORITHM_1)]},
          {"status", name_of(r.status)},
          {"boundary vertices", r.number_of_boundary_vertices},
          {"arrived", r.number_of_arrived_vertices},
          {"frozen", r.number_of_frozen_vertices},
          {"folded boundary faces", r.number_of_folded_faces},
          {"solves", r.number_of_solves},
          {"halvings of a step", r.number_of_halvings},
          {"elements not acceptable at the cap", r.number_of_unacceptable_elements}};
}

// The paper's way onto the surface.
CGAL::Mixed_mesh_fit_result_3 run_algorithm_1(Mesh& mesh, const CGAL::Polyhedral_mixed_mesh_domain_3& domain,
                                              const Options& o, Stage_log& log)
{
#if MIXED_MESH_3_HAS_EIGEN
  const auto criteria = Mixed_mesh_fit_criteria_3()
                          .number_of_steps(o.steps)
                          .poisson_ratio(o.poisson_ratio)
                          .stiffness_factor(o.stiffness_factor)
                          .maximal_stiffness(o.maximal_stiffness)
                          .acceptable_aspect_ratio(o.acceptable_quality)
                          .number_of_layers(o.layers);
  const auto np = CGAL::parameters::visitor(std::ref(log));
  const auto fit_with = [&](auto solver) {
    return CGAL::fit_mixed_mesh_to_surface(mesh, domain, criteria, np.sparse_linear_solver(std::ref(solver)));
  };
  switch(o.solver) {
  case Solver::CG: break; // the library's default, and how it sets it
  case Solver::LDLT: return fit_with(mm3::Simplicial_solver_traits());
  case Solver::CHOLMOD:
#ifdef CGAL_MIXED_MESH_3_USE_CHOLMOD
    return fit_with(mm3::Cholmod_solver_traits());
#endif
    break;
  }
  return CGAL::fit_mixed_mesh_to_surface(mesh, domain, criteria, np);
#else
  CGAL_USE(mesh), CGAL_USE(domain), CGAL_USE(o), CGAL_USE(log);
  throw std::logic_error("checked with the options");
#endif
}

// Carries the boundary onto the surface; the status becomes what the library would make of it.
Json fit(Mesh& mesh, const CGAL::Polyhedral_mixed_mesh_domain_3& domain, const Options& o, Stage_log& log,
         CGAL::Mixed_mesh_result_3& result, std::vector<std::string>& warnings)
{
  bool is_on_surface, is_valid;
  Json report;
  if(o.fit() == Fit::ALGORITHM_1) {
    using Status = CGAL::Mixed_mesh_fit_status;
    const auto r = log("Algorithm 1", [&] { return run_algorithm_1(mesh, domain, o, log); });
    report = describe(r);
    is_valid = r.status != Status::INVALID_MESH;
    is_on_surface = r.is_on_surface();
    if(r.status == Status::SOLVER_FAILED)
      warnings.push_back("--solver: did not solve a linear system; try another one");
    if(r.status == Status::CAP_REACHED)
      warnings.push_back(std::to_string(r.number_of_unacceptable_elements)
                         + " elements have an aspect-ratio coefficient above " + rounded(o.acceptable_quality)
                         + ": stiffening does not help them, see --max-stiffness; optimization would");
  } else {
    using Status = CGAL::Mixed_mesh_optimization_status;
    result.optimization = log(mm3::stage_names[int(mm3::Stage::OPTIMIZATION)], [&] {
      return CGAL::optimize_mixed_mesh_3(mesh, domain, CGAL::Mixed_mesh_optimization_criteria_3(),
                                         CGAL::parameters::visitor(std::ref(log)));
    });
    report = describe(result.optimization);
    is_valid = result.optimization.status != Status::INVALID_MESH;
    is_on_surface = result.optimization.status == Status::SUCCESS;
  }
  if(!is_valid)
    throw Invalid_mesh("an element of the mesh is inverted before its boundary is fitted");
  if(!is_on_surface)
    result.status = Mixed_mesh_status::NOT_ALL_ARRIVED;
  return report;
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

void print_summary(const Mesh& mesh, const Options& o, const Fidelity& fidelity, const Json& report)
{
  std::cout << mesh.number_of_vertices() << " vertices of " << o.vertices << ", "
            << mesh.number_of_elements() << " elements (";
  const auto counts = mesh.elements().counts();
  for(int k = mm3::number_of_element_kinds - 1; k >= 0; --k)
    std::cout << counts[std::size_t(k)] << ' ' << mm3::reference_elements[k].plural << (k > 0 ? ", " : ")\n");
  const Json& all = report["quality"]["after"]["all"];
  std::cout << std::setprecision(3) << "ARC mean " << double(all["ARC mean"]) << ", max "
            << double(all["ARC max"]) << "; Hausdorff distance " << fidelity.distance.distance() << "; "
            << fidelity.ratio_of_volumes() << " times the surface's volume\n"
            << "all checks hold; " << double(report["seconds"]) << " s\n";
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
  if(o.tolerance > 0)
    check_tolerance(o, surface);
  Surface region_surface;
  if(!o.region.empty())
    region_surface = log("read region", [&] { return read(o.region, region_report, warnings); });
  report["inputs"] = {{"surface", surface_report}, {"region", region_report}};
  report["options"] = {{"vertices", o.vertices},
                       {"base level", o.base_level == CGAL::Mixed_mesh_criteria_3::automatic
                                        ? Json("automatic") : Json(o.base_level)},
                       {"mode", o.mode == mm3::Boundary_mode::PAPER ? "paper" : "default"},
                       {"root", o.root == mm3::Root_cell::BOX ? "box" : "cube"},
                       {"templates", o.templates == mm3::Transition_templates_choice::CENTERED
                                       ? "centered" : "fewest"},
                       {"fit", fit_names[int(o.fit())]},
                       {"tolerance", o.tolerance > 0 ? Json(o.tolerance) : Json()},
                       {"tetrahedra", o.tetrahedra},
                       {"msh version", o.msh2 ? "2.2" : "4.1"},
                       {"threads", o.threads}};
  if(o.fit() == Fit::ALGORITHM_1)
    report["options"]["Algorithm 1"] = {{"steps", o.steps},
                                        {"Poisson's ratio", o.poisson_ratio},
                                        {"stiffness factor", o.stiffness_factor},
                                        {"maximal stiffness", o.maximal_stiffness},
                                        {"acceptable quality", o.acceptable_quality},
                                        {"layers", o.layers == Mixed_mesh_fit_criteria_3::automatic
                                                     ? Json("automatic") : Json(o.layers)},
                                        {"solver", solver_names[int(o.solver)]}};
  report["units"] = {{"lengths and distances", "unit of the surface's file"},
                     {"volumes", "cube of the unit of the surface's file"},
                     {"angles and quad warp", "degrees"},
                     {"ARC, scaled Jacobian, shares and ratios", "1"}};

  // With a tolerance, octrees are compared by what their meshes are like when fitted. Without, the boundary
  // is fitted here, so that the mesh before is seen.
  const bool is_fitted_inside = o.tolerance > 0;
  const auto criteria = CGAL::Mixed_mesh_criteria_3(o.vertices)
                          .base_level(o.base_level)
                          .boundary_mode(o.mode)
                          .root_cell(o.root)
                          .transition_templates(o.templates)
                          .fit_to_surface(is_fitted_inside)
                          .tolerance(o.tolerance)
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
  refuse(result, o);
  if(o.tetrahedra) // now, so that what is fitted, checked and reported is what is written
    mesh = log("split to tetrahedra", [&] { return mm3::split_to_tetrahedra(mesh); });

  Json quality, fitting = {{"method", fit_names[int(Fit::NONE)]}};
  if(is_fitted_inside) {
    fitting = describe(result.optimization);
  } else if(o.fit() != Fit::NONE) {
    log("quality", [&] { describe_quality(mesh, "before", quality); });
    fitting = fit(mesh, domain, o, log, result, warnings);
  }

  const mm3::Mesh_defects defects = log("checks", [&] { return mm3::find_defects(mesh); });
  Fidelity fidelity;
  if(defects.none())
    fidelity = log("distance to surface", [&] {
      return fidelity_of(mesh, surface, surface_report["volume"]);
    });
  Json checks;
  check(defects, fidelity, checks);
  for(const std::string& warning : warnings_of(result, o, mesh, fidelity))
    warnings.push_back(warning);
  if(is_fitted_inside && result.status == Mixed_mesh_status::SUCCESS
     && fidelity.distance.distance() > o.tolerance) // between the points that the library looked at
    result.status = Mixed_mesh_status::TOLERANCE_NOT_REACHED;
  log("quality", [&] {
    describe_quality(mesh, "after", quality);
    describe_shapes(mesh, quality);
  });

  const auto counts = mesh.elements().counts();
  std::size_t in_region = 0;
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
    in_region += mesh.is_in_region(e);
  const double vertices = double(mesh.number_of_vertices());
  report["status"] = name_of(result.status);
  report["mesh"] = {{"vertices", mesh.number_of_vertices()},
                    {"share of budget", vertices / double(o.vertices)},
                    {"vertices in region", result.number_of_vertices_in_region},
                    {"share of vertices in region", double(result.number_of_vertices_in_region) / vertices},
                    {"elements", mesh.number_of_elements()},
                    {"elements in region", in_region},
                    {"boundary faces", mesh.boundary_faces().size()},
                    {"volume", fidelity.volume_of_mesh}};
  for(int k = 0; k < mm3::number_of_element_kinds; ++k)
    report["mesh"][mm3::reference_elements[k].plural] = counts[std::size_t(k)];
  report["octree"] = {{"base level", result.base_level},
                      {"deepest level", result.deepest_level},
                      {"cells", result.number_of_cells},
                      {"cells lost", result.number_of_lost_cells},
                      {"octrees tried", result.number_of_trials}};
  report["vertices inserted"] = {{"by transition templates", result.number_of_transition_vertices},
                                 {"by boundary stage", result.number_of_boundary_vertices_inserted}};
  report["vertices labeled inside for a manifold boundary"] = result.number_of_relabeled_vertices;
  report["fitting"] = fitting;
  if(o.tolerance > 0)
    report["tolerance"] = {{"tolerance", o.tolerance},
                           {"reached", fidelity.distance.distance() <= o.tolerance},
                           {"largest distance", fidelity.distance.distance()},
                           {"largest distance at sample points", result.optimization.largest_distance},
                           {"vertices of the mesh as coarse as it allows",
                            result.number_of_vertices_for_tolerance}};
  report["surface"] = describe(fidelity);
  report["quality"] = quality;
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
    print_summary(mesh, o, fidelity, report);
}

int main(int argc, char** argv)
{
  Options options;
  CLI::App app("Makes a mixed-element (hexahedra, prisms, pyramids, tetrahedra) finite-element mesh of the "
               "domain inside a closed surface, fine in a region of interest, within a vertex budget.");
  set_up(app, options);
  try {
    app.parse(argc, argv);
    check_built_with(options);
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
