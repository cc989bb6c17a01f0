// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mixed_mesh_3/options.h"

#include "core/Thread_limit.h"
#include "core/Deferred_signals.h"
#include "core/command_line.h"
#include "core/patch_shapes.h"
#include "core/resources.h"
#include "mixed_mesh_3/nodes.h"

#include <CGAL/Mixed_mesh_3/IO/write_mixed_mesh.h>
#include <CGAL/version.h>

#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/split.hpp>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <stdexcept>
#include <system_error>

namespace mm3 = CGAL::Mixed_meshes_3;

namespace {

// Whether CMakeLists.txt found Eigen: the paper's Algorithm 1 solves linear systems.
#if MIXED_MESH_3_HAS_EIGEN
constexpr bool has_eigen = true;
#else
constexpr bool has_eigen = false;
#endif

constexpr const char* automatic_vertices = "auto"; // value of --vertices
constexpr std::size_t most_automatic_vertices = 200000;

double weight_option(const std::string& option, const std::string& text)
{
  double weight = 0;
  if(!CLI::detail::lexical_cast(text, weight) || !(weight >= 1e-6 && weight <= 1e6))
    throw CLI::ValidationError(option, "the weight '" + text + "' is not a number from 0.000001 to 1000000");
  return weight;
}

void set_largest_arc(const std::string& text, Meshing_options& o)
{
  const std::string strict = ",strict";
  o.is_arc_strict = boost::algorithm::ends_with(text, strict);
  const std::string arc = text.substr(0, text.size() - (o.is_arc_strict ? strict.size() : 0));
  const bool is_number = arc == "none" || CLI::detail::lexical_cast(arc, o.largest_arc);
  if(arc == "none")
    o.largest_arc = 0;
  if(!is_number || !std::isfinite(o.largest_arc) || !(o.largest_arc == 0 || o.largest_arc >= 1))
    throw CLI::ValidationError("--max-arc",
                               "expected a number of at least 1, 0 or none, with ,strict or not, not "
                                 + text);
}

// The option of a region. A file whose name ends like a weight is that file.
Region_option region_option(const std::string& text)
{
  const std::size_t colon = text.rfind(':');
  std::error_code ignored;
  if(colon == std::string::npos || std::filesystem::exists(text, ignored))
    return {text, 1};
  return {text.substr(0, colon), weight_option("--region " + text, text.substr(colon + 1))};
}

// The labels of an option, which a function of the text and of the table reads.
template <class Read>
auto labels_option(const std::string& option, const std::string& text, const Input_options& o,
                   const Read& read)
{
  try {
    return read(text, o.label_table);
  } catch(const std::invalid_argument& e) {
    throw CLI::ValidationError(option, e.what());
  }
}

Voxel_selection one_selection(const std::string& text, const Label_table& table)
{
  return labels_selection(text, table);
}

const char* const what_a_name_is = "a name has up to 24 letters, digits, _ and -, a letter first, and is "
                                   "neither all, boundary, region or rest, nor begins as those of files";

// The option of a subdomain, whose name is that of the file, without its ending, if no name is given.
Subdomain_option subdomain_option(const std::string& option, const std::string& text)
{
  const std::size_t equals = text.find('=');
  std::error_code ignored;
  const bool has_name = equals != std::string::npos && !std::filesystem::exists(text, ignored);
  Subdomain_option s{has_name ? text.substr(0, equals) : std::filesystem::path(text).stem().string(),
                     has_name ? text.substr(equals + 1) : text};
  if(!is_subdomain_name(s.name))
    throw CLI::ValidationError(option + " " + text, std::string(what_a_name_is) + ", as in tumor=" + s.file);
  return s;
}

Patch_option patch_option(const std::string& text)
{
  const std::string option = "--patch " + text;
  const std::size_t equals = text.find('=');
  if(equals == std::string::npos || equals + 1 == text.size())
    throw CLI::ValidationError(option, "expected NAME=WHERE, as in support=sphere:0,0,0,5");
  const Patch_option patch{text.substr(0, equals), text.substr(equals + 1)};
  if(!mm3::IO::is_facet_set_name(patch.name))
    throw CLI::ValidationError(option,
                               "a name has up to 60 letters, digits, _ and -, a letter first, and is neither "
                               "all, boundary, region or rest, nor begins as those of files");
  if(const auto shape = patch_shape(patch.place); shape && !shape->defect.empty())
    throw CLI::ValidationError(option, shape->defect);
  return patch;
}

// The groups of `--labels freesurfer`: the numbers of aseg, SynthSeg, aparc+aseg and wmparc, nearly as in
// FreeSurfer's mri_binarize --all-wm, --subcort-gm and --ventricles. White matter also has what would be a
// hole in it or a thread at it: vessels (30, 62), fornix (250) and optic chiasm (85).
const char* const freesurfer_labels =
  "white_matter=2,7,30,41,46,62,77-79,85,250-255,3000-3035,4000-4035,5001-5002,"
  "gray_matter=3,8,10-13,17-18,26-28,42,47,49-54,58-60,80-82,1000-1035,2000-2035,"
  "ventricles=4-5,14-15,31,43-44,63,72,fluid=24,brain_stem=16";

// Sets the labels of one domain, or of several with names.
void set_labels(const std::string& text, Input_options& o)
{
  const std::string option = "--labels " + text;
  o.label_choice = text == "each"                        ? Label_choice::EACH
                   : text == "freesurfer"                ? Label_choice::FREESURFER
                   : text.find('=') != std::string::npos ? Label_choice::LISTS
                                                         : Label_choice::NONE;
  if(o.label_choice == Label_choice::NONE)
    o.voxels = labels_option(option, text, o, one_selection);
  const std::string lists = o.label_choice == Label_choice::FREESURFER ? freesurfer_labels : text;
  if(lists.find('=') == std::string::npos)
    return;
  for(const auto& [name, voxels] : labels_option(option, lists, o, named_labels)) {
    if(!is_subdomain_name(name))
      throw CLI::ValidationError(option, what_a_name_is);
    o.labels.push_back({name, "", voxels});
  }
}

// The option of a region by labels, with a weight after a colon.
Region_option region_of_labels(const std::string& text, const Input_options& o)
{
  const std::string option = "--region-labels " + text;
  const std::size_t colon = text.find(':');
  return {"", colon == std::string::npos ? 1 : weight_option(option, text.substr(colon + 1)),
          labels_option(option, text.substr(0, colon), o, one_selection)};
}

// The option of labels that become one.
Merge_option merge_option(const std::string& text)
{
  const std::size_t equals = text.find('=');
  Merge_option merge{text.substr(0, equals), {}};
  if(equals != std::string::npos)
    boost::algorithm::split(merge.parts, text.substr(equals + 1), [](char c) { return c == '+'; });
  if(merge.parts.size() < 2)
    throw CLI::ValidationError("--merge " + text, "expected NAME=A+B, as in tissue=white_matter+gray_matter");
  if(!is_subdomain_name(merge.name))
    throw CLI::ValidationError("--merge " + text, what_a_name_is);
  return merge;
}

// The option of a label that grows, or of one for holes if the text has no distance.
Layer_option layer_option(const std::string& option, const std::string& text, bool has_distance)
{
  const std::size_t equals = has_distance ? text.find('=') : std::string::npos;
  Layer_option layer{text.substr(0, equals), std::nullopt};
  double distance = 0;
  if(has_distance
     && (equals == std::string::npos || !CLI::detail::lexical_cast(text.substr(equals + 1), distance)
         || !(distance > 0 && std::isfinite(distance))))
    throw CLI::ValidationError(option + ' ' + text,
                               "expected NAME=MM, as in fluid=2, with MM greater than 0");
  if(has_distance)
    layer.distance = distance;
  if(!is_subdomain_name(layer.name))
    throw CLI::ValidationError(option + ' ' + text, what_a_name_is);
  return layer;
}

// Adds an option that can be given several times; `add` takes one of its texts.
CLI::Option* add_several(CLI::App& app, const char* name, const char* what,
                         const std::function<void(const std::string&)>& add)
{
  return app
    .add_option_function<std::vector<std::string>>(
      name,
      [add](const std::vector<std::string>& texts) {
        for(const std::string& text : texts)
          add(text);
      },
      what)
    ->allow_extra_args(false);
}

// Adds the options that choose components of the domain.
void add_components(CLI::App& app, Input_options& o)
{
  app.add_flag("--largest", o.completion.keep_largest,
               "Keep only the largest component of the domain SURFACE, with its cavities");
  app
    .add_option("--drop-below", o.completion.least_volume,
                "Drop components of the domain with less volume, cavities of a surface as well: in ml if "
                "SURFACE is an image, else in the cube of its unit")
    ->check(number("greater than 0", [](double x) { return x > 0; }))
    ->type_name("V");
}

// Adds the options for a domain and regions from a segmentation.
void add_labels(CLI::App& app, Input_options& o)
{
  const char* const group = "Options of images";
  // The table is read before the options that use its names: options are parsed in the order in which they
  // are added.
  app
    .add_option_function<std::string>(
      "--label-table", [&o](const std::string& path) { o.label_table = Label_table(path); },
      "Names of labels: a color table of FreeSurfer or 3D Slicer, or the labels of ITK-SNAP; the names can "
      "stand instead of numbers in --labels and --region-labels, and name the parts of --labels each")
    ->type_name("FILE")
    ->group(group);
  CLI::Option* const labels =
    app
      .add_option_function<std::string>(
        "--labels", [&o](const std::string& text) { set_labels(text, o); },
        "Labels of the domain in the image SURFACE (default: all but 0). With names, "
        "as in brain=1-189,tumor=200, each list becomes a subdomain, numbered from 1; 'each': each label "
        "but 0 becomes one, with its number, and the name label_NUMBER; 'freesurfer': white_matter, "
        "gray_matter, ventricles, fluid and brain_stem of FreeSurfer's aseg and of SynthSeg")
      ->type_name("LIST")
      ->group(group);
  app
    .add_option_function<double>(
      "--threshold", [&o](double t) { o.voxels = threshold_selection(t); },
      "The domain is where the image SURFACE has at least that value")
    ->check(number("that is finite", [](double) { return true; }))
    ->type_name("T")
    ->excludes(labels)
    ->group(group);
  add_several(
    app, "--region-labels",
    "Labels of a region of interest in the image SURFACE, with a weight as that of --region; can be given "
    "several times",
    [&o](const std::string& text) { o.regions.push_back(region_of_labels(text, o)); })
    ->type_name("LIST[:W]")
    ->group(group);
  app
    .add_option(
      "--smoothing", o.smoothing,
      "Standard deviation, in mm, of the Gaussian that smoothes labels before their surface is made; "
      "0: none (default: the largest distance between voxels)")
    ->check(number("of at least 0", [](double x) { return x >= 0; }))
    ->type_name("MM")
    ->group(group);
  app
    .add_option(
      "--close", o.completion.closing_radius,
      "Close gaps, grooves and openings of the domain that a ball of this radius does not fit into; "
      "what that adds to several labels is of the one with most voxels")
    ->check(number("greater than 0", [](double x) { return x > 0; }))
    ->type_name("MM")
    ->group(group);
  add_several(
    app, "--merge",
    "Make one subdomain NAME of several of --labels, as in tissue=white_matter+gray_matter; it has the "
    "smallest of their numbers. Before --close, --hull and --grow; can be given several times",
    [&o](const std::string& text) { o.merges.push_back(merge_option(text)); })
    ->type_name("NAME=A+B")
    ->group(group);
  add_several(
    app, "--grow",
    "Give what is 0 in the image, up to MM from the label NAME of --labels, to that label; a new NAME "
    "is a layer around all labels, as in fluid=2. After --close and --hull; can be given several times",
    [&o](const std::string& text) { o.label_layers.push_back(layer_option("--grow", text, true)); })
    ->type_name("NAME=MM")
    ->group(group);
  app
    .add_option_function<std::string>(
      "--fill",
      [&o](const std::string& text) { o.label_layers.push_back(layer_option("--fill", text, false)); },
      "Give what is 0 in the image, and enclosed by the labels of --labels, to the label NAME, a new one or "
      "not; after --grow")
    ->type_name("NAME")
    ->group(group);
  app.add_flag("--fill-holes", o.completion.fill_holes, "Add to the domain what it encloses")->group(group);
  app
    .add_flag(
      "--hull", o.completion.is_hull,
      "The solid organ out of an atlas or a parcellation: --close (by 13 % of the edge of a cube of its "
      "volume, 15 mm for a brain, if no other radius is given), --fill-holes and --largest")
    ->group(group);
}

void add_files(CLI::App& app, Meshing_options& o)
{
  app
    .add_option("SURFACE", o.surface,
                "Closed surface of the domain: .off, .obj, .stl, .ply, .vtp, .vtk, .gii, or a binary surface "
                "of FreeSurfer; or an image of labels: .nii, .nii.gz, .mgh, .mgz")
    ->required();
  add_surface_options(app, o.surface_options);
  add_components(app, o);
  add_several(
    app, "--region",
    "Closed surface of a region of interest, in the same coordinates; an error counts W times as much "
    "there as in a region without weight. Can be given several times (default: refine everywhere)",
    [&o](const std::string& text) { o.regions.push_back(region_option(text)); })
    ->type_name("FILE[:W]");
  add_several(
    app, "--subdomain",
    "Closed surface of a part of the domain, such as a tumor, that gets elements, a label and an "
    "interface of its own: SURFACE is 1, the parts are 2, 3, ... Can be given several times. A point "
    "is in the innermost surface around it; where surfaces cross, the earlier one counts",
    [&o](const std::string& text) { o.subdomains.push_back(subdomain_option("--subdomain", text)); })
    ->type_name("[NAME=]FILE");
  add_several(app, "--cavity", "Closed surface of a part that is not meshed; can be given several times",
              [&o](const std::string& file) { o.cavities.push_back(file); })
    ->type_name("FILE");
  add_several(app, "--sheet",
              "Surface inside the domain that need not enclose anything, such as the falx: faces of the mesh "
              "are brought onto it, and written as a facet set. Can be given several times",
              [&o](const std::string& text) { o.sheets.push_back(subdomain_option("--sheet", text)); })
    ->type_name("[NAME=]FILE");
  app.add_flag("--slit", o.slit,
               "Double the vertices on sheets, so that both sides can come apart; the copies are not counted "
               "in the budget");
}

void add_budget(CLI::App& app, Meshing_options& o)
{
  constexpr std::size_t most = 1000000000; // the limit is that of 32-bit indices in files
  app
    .add_option_function<std::string>(
      "--vertices",
      [&o](const std::string& text) {
        o.fewest_vertices = text == automatic_vertices;
        o.vertices = o.fewest_vertices ? most_automatic_vertices : std::stoul(text);
      },
      "Vertex budget: the mesh has at most that many vertices; auto: as few as --tolerance allows, found by "
      "meshes with five to ten budgets of up to 200,000 (default: 2000)")
    ->check(CLI::Validator(
      [](std::string& text) { return text == automatic_vertices ? std::string() : count(most)(text); }, ""))
    ->type_name("N|auto");
  app.add_flag(
    "--best-effort", o.best_effort,
    "Go on where the budget is less than two fifths of what the layers of several subdomains take");
  app
    .add_option(
      "--nodes", o.nodes,
      "Budget in nodes instead: files have at most that many at their --order, of order 2 vertices and "
      "edges; found by up to three meshes")
    ->check(count(most))
    ->type_name("N")
    ->excludes("--vertices");
}

void add_outputs(CLI::App& app, Output_options& o)
{
  app
    .add_option("--output", o.outputs,
                "Mesh files: .vtu (VTK, ParaView), .msh (Gmsh), .mesh (Medit), .inp (Abaqus), .feb "
                "(FEBio); can be given several times")
    ->type_name("FILE")
    ->allow_extra_args(false);
  add_several(
    app, "--patch",
    "Patch of the boundary, written as a facet set and a node set of that name: the faces whose center "
    "is inside sphere:X,Y,Z,R, box:X0,Y0,Z0,X1,Y1,Z1, or the file of a closed surface, or on "
    "plane:X,Y,Z,NX,NY,NZ or beyond, where the normal points to. Can be given several times",
    [&o](const std::string& text) { o.patches.push_back(patch_option(text)); })
    ->type_name("NAME=WHERE");
  add_several(
    app, "--extract",
    "Write only these subdomains of --subdomain or --labels, as in skull,brain: their elements, whose "
    "interfaces with others become boundary; the mesh is that of all, which the budget and the checks are "
    "for",
    [&o](const std::string& text) {
      std::vector<std::string> names;
      boost::algorithm::split(names, text, [](char c) { return c == ','; });
      o.extract.insert(o.extract.end(), names.begin(), names.end());
    })
    ->type_name("NAMES");
  app.add_option("--report", o.report, "Report with counts, quality, checks, times and memory")
    ->type_name("FILE.json");
  app
    .add_option(
      "--page", o.page,
      "Page for a browser, in one file that needs no network: the mesh in 3D, to turn and to cut open, "
      "quality, checks and warnings with their places")
    ->type_name("FILE.html");
}

// Returns the option that those of Algorithm 1 need.
CLI::Option* add_fit(CLI::App& app, Meshing_options& o)
{
  app
    .add_option("--base-level", o.base_level,
                "Octree level of the whole domain; cells are 2^L times smaller than the root "
                "at least (default: 3; coarser or finer as the budget says)")
    ->check(CLI::Range(0, 10))
    ->type_name("L");
  app
    .add_option(
      "--grading", o.grading,
      "How gently cells grow with the distance from the region, as a share of its mean radius; 0: only "
      "the region is refined, as in the paper")
    ->check(number("from 0 to 100", [](double x) { return x >= 0 && x <= 100; }))
    ->type_name("G")
    ->capture_default_str();
  app.add_flag("--no-simplification", o.no_simplification,
               "Keep all vertices of the octree: else a finer mesh is made first, and loses vertices by edge "
               "collapses; elements at the surface are tetrahedra then, and all are without a region");
  CLI::Option* no_fit = app.add_flag("--no-fit", o.no_fit,
                                     "Leave boundary vertices where the octree has them");
  CLI::Option* no_optimize =
    app
      .add_flag("--no-optimize", o.no_optimize,
                "Carry the boundary onto the surface as the paper does (Algorithm 1), without optimization")
      ->excludes(no_fit);
  app
    .add_option("--tolerance", o.tolerance,
                "How far boundary and surface may be from each other, in the unit of SURFACE: part of the "
                "budget is spent outside the region for that (default: as the budget allows)")
    ->check(number("greater than 0", [](double x) { return x > 0; }))
    ->type_name("D")
    ->excludes(no_fit)
    ->excludes(no_optimize);
  app
    .add_option_function<std::string>(
      "--max-arc", [&o](const std::string& text) { set_largest_arc(text, o); },
      "Largest aspect-ratio coefficient of an element: boundary vertices that would need a larger one "
      "stay off the surface, unless a thin wall has room for flatter elements only; strict: even then "
      "(default: 3.2; 0 or none: no bound)")
    ->type_name("ARC[,strict]")
    ->excludes(no_fit)
    ->excludes(no_optimize);
  app
    .add_option(
      "--sharp-angle", o.given_sharp_angle,
      "Edges of SURFACE between facets whose normals differ by more are kept: edges of the mesh lie on "
      "them, and vertices at their corners, if they are long and not only noise; a surface that is "
      "perpendicular to the axes gets cells between its planes (default: 50, or 0 for several subdomains of "
      "an image, whose surfaces are smooth; 0: neither)")
    ->check(number("from 0 to 180", [](double x) { return x >= 0 && x <= 180; }))
    ->type_name("DEGREES");
  app.add_flag_callback(
    "--no-sharp", [&o] { o.given_sharp_angle = 0; }, "The same as --sharp-angle 0");
  return no_optimize;
}

void add_stages(CLI::App& app, Meshing_options& o)
{
  const std::map<std::string, mm3::Boundary_mode> modes{{"default", mm3::Boundary_mode::VERTEX_ORDER},
                                                        {"paper", mm3::Boundary_mode::PAPER}};
  const std::map<std::string, mm3::Root_cell> roots{{"cube", mm3::Root_cell::CUBE},
                                                    {"box", mm3::Root_cell::BOX}};
  const std::map<std::string, mm3::Transition_templates_choice> templates{
    {"fewest", mm3::Transition_templates_choice::FEWEST_VERTICES},
    {"centered", mm3::Transition_templates_choice::CENTERED}};
  app.add_option("--mode", o.mode, "Boundary stage: default, or paper (tetrahedra by parity)")
    ->transform(CLI::CheckedTransformer(modes, CLI::ignore_case).description("{default,paper}"))
    ->type_name("MODE");
  app.add_option("--root", o.root, "Root cell: cube (default), or box (the bounding box, as the paper)")
    ->transform(CLI::CheckedTransformer(roots, CLI::ignore_case).description("{cube,box}"))
    ->type_name("ROOT");
  app
    .add_option("--templates", o.templates,
                "Transition templates: fewest (vertices, default), or centered (a vertex in each)")
    ->transform(CLI::CheckedTransformer(templates, CLI::ignore_case).description("{fewest,centered}"))
    ->type_name("CHOICE");
}

// Adds the options of Algorithm 1, which need --no-optimize.
void add_algorithm_1(CLI::App& app, Relaxation_options& o, CLI::Option* no_optimize)
{
  const std::map<std::string, Solver> solvers{{"cg", Solver::CG}, {"ldlt", Solver::LDLT}};
  const auto at_least_1 = number("of at least 1", [](double x) { return x >= 1; });
  std::vector<CLI::Option*> options{
    app.add_option("--steps", o.steps, "Steps to the surface, the paper's MAX_STEP")
      ->check(CLI::Range(1, 1000))
      ->type_name("N")
      ->capture_default_str(),
    app.add_option("--poisson-ratio", o.poisson_ratio, "Poisson's ratio of the elastic medium")
      ->check(poisson_ratio())
      ->type_name("NU")
      ->capture_default_str(),
    app
      .add_option("--stiffness-factor", o.stiffness_factor,
                  "By how much an element of bad quality is stiffened at a time")
      ->check(number("greater than 1", [](double x) { return x > 1; }))
      ->type_name("F")
      ->capture_default_str(),
    app
      .add_option("--max-stiffness", o.maximal_stiffness,
                  "Largest stiffness, as a multiple of that at the start, the paper's Y_MAX")
      ->check(at_least_1)
      ->type_name("Y")
      ->capture_default_str(),
    app
      .add_option("--acceptable-quality", o.acceptable_quality,
                  "Elements of a larger aspect-ratio coefficient are stiffened")
      ->check(at_least_1)
      ->type_name("ARC")
      ->capture_default_str(),
    app
      .add_option("--solver", o.solver,
                  "Linear solver: cg (conjugate gradients), or ldlt (Eigen's simplicial factorization)")
      ->transform(CLI::CheckedTransformer(solvers, CLI::ignore_case).description("{cg,ldlt}"))
      ->type_name("SOLVER")
      ->default_str("cg")};
  options.push_back(app
                      .add_option("--layers", o.layers,
                                  "Only vertices within so many layers of elements from the boundary move "
                                  "(default: all of a mesh of up to 3,000 vertices, 4 of a larger one)")
                      ->check(CLI::Range(0, CGAL::Mixed_mesh_fit_criteria_3::all_layers))
                      ->type_name("L"));
  for(CLI::Option* option : options)
    option->needs(no_optimize)->group("Options of --no-optimize");
}

void set_up(CLI::App& app, Options& o)
{
  add_files(app, o);
  add_budget(app, o);
  add_outputs(app, o);
  CLI::Option* const no_optimize = add_fit(app, o);
  add_stages(app, o);
  add_labels(app, o);
  app.add_flag("--msh2", o.msh2, "Write .msh files in Gmsh's format 2.2 instead of 4.1");
  app.add_flag("--tetrahedra", o.tetrahedra,
               "Split all elements to tetrahedra, for solvers without the other kinds");
  app
    .add_option(
      "--order", o.order,
      "Order of the elements in files, 1 or 2: with 2, a node in the middle of each edge (.vtu, .msh, "
      ".feb; .inp without pyramids)")
    ->check(CLI::Range(1, 2))
    ->type_name("1|2");
  app
    .add_option(
      "--time-limit", o.time_limit,
      "Seconds after which the best mesh so far is checked and written, with exit status 4; as after "
      "Ctrl-C (default: none)")
    ->check(number("greater than 0", [](double x) { return x > 0; }))
    ->type_name("S");
  app.add_flag("--quiet", o.quiet, "Print errors and warnings only");
  app
    .add_option("--threads", o.threads,
                "Threads for queries on the surface and moves of vertices; the mesh is the same")
    ->check(CLI::Range(1, 256))
    ->type_name("T");
  add_algorithm_1(app, o, no_optimize);
  app.set_version_flag("--version", "mixed_mesh_3 0.1 (CGAL " CGAL_VERSION_STR ")");
  app.footer("Lengths are in the unit of SURFACE. Example:\n"
             "  mixed_mesh_3 data/brain.off --region data/region.off --vertices 660 --output brain.vtu");
}

// The names of labels after merges; of each label, which the image tells, those of merges only.
std::vector<std::string> names_of_labels(const Input_options& o)
{
  std::vector<std::string> names;
  for(const Subdomain_option& s : o.labels)
    names.push_back(s.name);
  for(const Merge_option& merge : o.merges) {
    const std::vector<std::string> before = names;
    for(const std::string& part : merge.parts) {
      const auto found = std::find_if(names.begin(), names.end(), [&part](const std::string& name) {
        return boost::iequals(name, part);
      });
      if(found != names.end())
        names.erase(found);
      else if(o.label_choice != Label_choice::EACH)
        throw CLI::ValidationError(merge.text() + ": " + part, sentence_on_no_subdomain(before));
    }
    names.push_back(merge.name);
  }
  return names;
}

// The names of subdomains, except those of each label, and of what is around all.
std::vector<std::string> names_of_subdomains(const Input_options& o)
{
  const std::vector<std::string> labels = names_of_labels(o);
  std::vector<std::string> names = labels;
  for(const Subdomain_option& s : o.subdomains)
    names.push_back(s.name);
  const auto has_name = [](const std::string& name) {
    return [&name](const auto& other) { return boost::iequals(other.name, name); };
  };
  const auto is_label = [&labels](const std::string& name) {
    return std::any_of(labels.begin(), labels.end(),
                       [&name](const std::string& label) { return boost::iequals(label, name); });
  };
  for(auto layer = o.label_layers.begin(); layer != o.label_layers.end();
      ++layer) // others are of labels and layers
    if(!is_label(layer->name) && std::none_of(o.label_layers.begin(), layer, has_name(layer->name)))
      names.push_back(layer->name);
  return names;
}

// Checks that names differ, and that options for a single subdomain are not used with several.
void check_subdomains(const Meshing_options& o)
{
  std::vector<std::string> names = names_of_subdomains(o);
  if(names.empty() && o.cavities.empty() && o.label_choice == Label_choice::NONE)
    return;
  if(o.label_choice == Label_choice::NONE)
    names.push_back(surrounding_name(o));
  for(const Subdomain_option& sheet : o.sheets)
    names.push_back(sheet.name);
  for(auto name = names.begin(); name != names.end(); ++name) // some formats ignore upper and lower case
    if(std::any_of(names.begin(), name, [&](const std::string& s) { return boost::iequals(s, *name); })
       || boost::iequals(*name, "outside"))
      throw CLI::ValidationError("--subdomain " + *name, "the name is taken, give NAME=FILE");
  if(o.mode == mm3::Boundary_mode::PAPER || o.no_optimize)
    throw CLI::ValidationError(o.no_optimize ? "--no-optimize" : "--mode paper",
                               "knows neither subdomains nor cavities");
}

void check_sheets(const Meshing_options& o)
{
  if(o.slit && o.sheets.empty())
    throw CLI::ValidationError("--slit", "needs --sheet");
  for(std::size_t i = 0; i < o.sheets.size(); ++i)
    for(std::size_t j = 0; j < i; ++j)
      if(o.sheets[i].name == o.sheets[j].name)
        throw CLI::ValidationError("--sheet " + o.sheets[i].name, "the name is taken, give NAME=FILE");
  if(!o.sheets.empty() && (o.mode == mm3::Boundary_mode::PAPER || o.no_optimize))
    throw CLI::ValidationError(o.no_optimize ? "--no-optimize" : "--mode paper", "knows no sheets");
}

void check_patches(const Output_options& o)
{
  for(std::size_t i = 0; i < o.patches.size(); ++i)
    for(std::size_t j = 0; j < i; ++j) // some formats ignore upper and lower case
      if(boost::iequals(o.patches[i].name, o.patches[j].name))
        throw CLI::ValidationError(o.patches[i].text(), "the name is taken");
}

// Checks names as far as they are known before the image is read.
void check_extract(const Options& o)
{
  if(o.extract.empty())
    return;
  if(o.subdomains.empty() && o.label_choice == Label_choice::NONE)
    throw CLI::ValidationError("--extract",
                               "needs --subdomain, or --labels with names, as in brain=1-189, or "
                               "each, or freesurfer");
  if(o.label_choice == Label_choice::EACH)
    return;
  std::vector<std::string> names = names_of_subdomains(o);
  if(o.label_choice == Label_choice::NONE)
    names.push_back(surrounding_name(o));
  for(const std::string& name : o.extract)
    if(std::none_of(names.begin(), names.end(),
                    [&name](const std::string& other) { return boost::iequals(other, name); }))
      throw CLI::ValidationError("--extract " + name, sentence_on_no_subdomain(names));
}

// Checks combinations of options, and options that this program was built without: these are wrong use.
void check_options(Options& o)
{
  if(o.threads > 1 && !Thread_limit::has_threads)
    throw CLI::ValidationError("--threads", "this program was built without TBB");
  if(o.no_optimize && !has_eigen)
    throw CLI::ValidationError("--no-optimize", "this program was built without Eigen");
  if(o.fewest_vertices && o.tolerance == 0)
    throw CLI::ValidationError("--vertices auto", "needs a --tolerance");
  if(o.nodes > 0)
    o.vertices = first_vertex_budget(o.nodes, o.order);
  const bool has_image = is_image(o.surface);
  for(Region_option& r : o.regions)
    if(r.file.empty())
      r.file = o.surface;
  if(!has_image && (o.completion.closing_radius || o.completion.fill_holes || o.completion.is_hull))
    throw CLI::ValidationError(o.surface, std::string("--close, --fill-holes and --hull need an image: ")
                                            + image_endings + "; --wrap closes a surface");
  if(!has_image
     && (!o.voxels.ranges.empty() || o.label_choice != Label_choice::NONE
         || std::any_of(o.regions.begin(), o.regions.end(),
                        [](const Region_option& r) { return !r.voxels.ranges.empty(); })))
    throw CLI::ValidationError(o.surface,
                               std::string("labels and thresholds need an image: ") + image_endings);
  const char* const labels_needed = "needs --labels with names, as in brain=1-189, or each, or freesurfer";
  if(!o.merges.empty() && o.label_choice == Label_choice::NONE)
    throw CLI::ValidationError("--merge", labels_needed);
  if(!o.label_layers.empty() && o.label_choice == Label_choice::NONE)
    throw CLI::ValidationError(o.label_layers[0].distance ? "--grow" : "--fill", labels_needed);
  check_subdomains(o);
  check_sheets(o);
  check_patches(o);
  check_extract(o);
}

} // namespace

std::optional<int> parse_command_line(int argc, char** argv, Options& options)
{
  CLI::App app("Makes a mixed-element (hexahedra, prisms, pyramids, tetrahedra) finite-element mesh of the "
               "domain inside a closed surface, fine in a region of interest, within a vertex budget.");
  set_up(app, options);
  options.command = command_of("mixed_mesh_3", argc, argv);
  return parse("mixed_mesh_3", app, argc, argv, [&] { check_options(options); });
}

std::vector<std::string> inputs_of(const Options& o)
{
  std::vector<std::string> inputs{o.surface};
  if(!o.label_table.path().empty())
    inputs.push_back(o.label_table.path());
  for(const Region_option& r : o.regions)
    inputs.push_back(r.file);
  for(const auto& parts : {o.subdomains, o.sheets})
    for(const Subdomain_option& s : parts)
      inputs.push_back(s.file);
  inputs.insert(inputs.end(), o.cavities.begin(), o.cavities.end());
  for(const Patch_option& p : o.patches)
    if(!patch_shape(p.place))
      inputs.push_back(p.place);
  return inputs;
}

std::vector<std::string> outputs_of(const Output_options& o)
{
  std::vector<std::string> outputs = o.outputs;
  for(const std::string& path : {o.report, o.page})
    if(!path.empty())
      outputs.push_back(path);
  return outputs;
}

void check_feasible(const Options& o)
{
  // A temporary file exists while the program tests whether a file can be written.
  const Deferred_signals deferred({SIGINT, SIGTERM, SIGHUP}, Deferred_signals::Second::DEFERRED);
  Output_paths outputs(inputs_of(o));
  for(const std::string& path : o.outputs)
    require([&](std::string* error) { return mm3::IO::check_output_path(path, error, o.order); });
  for(const std::string& path : {o.report, o.page})
    if(!path.empty())
      require([&](std::string* error) { return mm3::IO::check_output_directory(path, error); });
  for(const std::string& path : outputs_of(o))
    outputs.add(path);
  // The number is more than measured with 100,000 and 200,000 vertices; a direct solver takes more.
  const double bytes_per_vertex = o.fit() == Fit::ALGORITHM_1 ? 3000 : o.tetrahedra ? 1500 : 1100;
  check_memory(o.budget() + ":", double(o.vertices) * bytes_per_vertex);
  if((o.tetrahedra || o.order == 2) && o.vertices > 500000000u)
    throw std::runtime_error(o.budget() + ": more than the 32-bit indices of the files allow");
}
