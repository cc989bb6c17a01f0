// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "brain_shift/options.h"

#include "brain_shift/read_control_points.h"
#include "core/Deferred_signals.h"
#include "core/command_line.h"
#include "core/patch_shapes.h"
#include "core/resources.h"
#include "core/voxel_selection.h"

#include <CGAL/Mixed_mesh_3/IO/write_mixed_mesh.h>
#include <CGAL/version.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mm3 = CGAL::Mixed_meshes_3;

namespace {

// Whether CMakeLists.txt found nifti_clib; without nifti_clib, there are no images, and everything else
// works.
#if MIXED_MESH_3_HAS_NIFTI
constexpr bool has_nifti = true;
#else
constexpr bool has_nifti = false;
#endif

CLI::Validator fraction()
{
  return number("from 0 to 1", [](double x) { return x >= 0 && x <= 1; });
}
CLI::Validator young_modulus()
{
  return number("from 1e-9 to 1e12", [](double x) { return x >= 1e-9 && x <= 1e12; });
}
CLI::Validator not_negative()
{
  return number("of at least 0", [](double x) { return x >= 0; });
}

void add_landmarks(CLI::App& app, Options& o)
{
  CLI::Option* const landmarks =
    app
      .add_option(
        "--landmarks", o.model.landmarks.file,
        "Pairs of points measured before and after the shift, in mm: tag points of MNI for two volumes, "
        ".tag; "
        "fiducials of 3D Slicer before, .fcsv or .mrk.json; or a table with the header "
        "x,y,z,x_after,y_after,z_after, with one column more, name, if you like, or x,y,z,dx,dy,dz. Tells "
        "the "
        "target registration error (mean, median, maximum) of no registration, rigid, affine, thin-plate "
        "spline, and the model: at each landmark by the others, and at the others by the outermost")
      ->type_name("FILE");
  app
    .add_option("--landmarks-after", o.model.landmarks.file_after,
                "Where the fiducials of --landmarks are after, in the same order: .fcsv or .mrk.json")
    ->needs(landmarks)
    ->type_name("FILE");
  app
    .add_option("--landmarks-given", o.model.landmarks.number_given,
                "How many landmarks are given for the others to be predicted: those nearest to the boundary "
                "(default: 8, but at most half of them, and at least 4)")
    ->check(number("from 4 to 1000000", [](double k) { return k >= 4 && k <= 1e6 && k == std::floor(k); }))
    ->needs(landmarks)
    ->type_name("K");
}

// Returns the option that those of images need.
CLI::Option* add_inputs(CLI::App& app, Options& o)
{
  app.add_option("MESH", o.model.mesh, "Mesh of the brain, in mm: .vtu, .msh, .mesh, .ele or .vol")
    ->required();
  app
    .add_option(
      "--control-points", o.model.points.file,
      "Table of points with given displacements, in mm: a header x,y,z,dx,dy,dz, then a line for "
      "each, with one column more, weight, if you like; or a list of fiducials before, .fcsv or .mrk.json "
      "(default: the points of --landmarks)")
    ->type_name("FILE.csv");
  app
    .add_option("--control-points-after", o.model.points.file_after,
                "Where the fiducials of --control-points are after, in the same order: .fcsv or .mrk.json")
    ->type_name("FILE");
  add_landmarks(app, o);
  CLI::Option* const tumor =
    app
      .add_option("--tumor,--tumour", o.tumor,
                  "Closed surface: elements whose centroid is inside are removed, after the shift")
      ->type_name("SURFACE");
  app
    .add_option("--tumor-label,--tumour-label", o.tumor_label,
                "Number or name of a subdomain of the mesh: its elements are removed, after the shift")
    ->excludes(tumor)
    ->type_name("LABEL");
  add_surface_options(app, o.surface_options);
  CLI::Option* image = app
                         .add_option("--image", o.images.file,
                                     std::string("Image before the shift: ") + image_endings)
                         ->type_name("IMAGE");
  app
    .add_option("--labels", o.images.labels,
                std::string(
                  "Label image on the voxels of --image: is deformed with it, by the nearest voxel: ")
                  + image_endings)
    ->needs(image)
    ->type_name("IMAGE");
  return image;
}

void add_supports(CLI::App& app, Options& o)
{
  app.add_option("--up", o.up, "Direction of height: x, y, z, -x, -y, -z, or three numbers")
    ->type_name("X,Y,Z")
    ->capture_default_str();
  app
    .add_option("--fixed-below", o.model.supports.fixed_below,
                "Boundary vertices in that lower part of the height are fixed; 0: none. With --fixed: 0 by "
                "default, unless base is among the patches")
    ->check(fraction())
    ->type_name("FRACTION")
    ->capture_default_str();
  CLI::Option* slide_below =
    app
      .add_option("--slide-below", o.model.supports.slide_below,
                  "Boundary vertices in that lower part of the height that are not fixed slide along the "
                  "boundary without friction (default: 0, none)")
      ->check(fraction())
      ->type_name("FRACTION");
  app
    .add_option("--slide-beyond", o.model.supports.slide_beyond,
                "Boundary vertices farther than that from all control points slide, unless fixed: the skull "
                "holds the brain but at the opening (default: none)")
    ->check(not_negative())
    ->excludes(slide_below)
    ->type_name("MM");
  const auto add_patches = [&app](const char* name, std::vector<std::string>& patches, const char* what) {
    app.add_option(name, patches, what)->type_name("PATCH")->allow_extra_args(false);
  };
  add_patches(
    "--fixed", o.patches.fixed,
    "Patch of the boundary that is fixed: faces whose center is inside a closed surface, sphere:X,Y,Z,R, "
    "box:X0,Y0,Z0,X1,Y1,Z1 or plane:X,Y,Z,NX,NY,NZ (on the plane or beyond, where the normal points to), "
    "label:N (faces of elements of subdomain N), or base (that of --fixed-below); can be given several "
    "times");
  add_patches(
    "--slide", o.patches.sliding,
    "Patch that slides, unless fixed: as that of --fixed, without base, or skull (all of the boundary); can "
    "be given several times");
  add_patches(
    "--contact", o.patches.touching,
    "Patch that touches the skull without friction, and can leave it, unless fixed or sliding: as that of "
    "--slide; can be given several times");
  add_patches(
    "--opening", o.patches.openings,
    "Patch that is free, whatever other options say: as that of --fixed, without base; can be given "
    "several times");
}

void add_physics(CLI::App& app, Options& o)
{
  app.add_option("--young-modulus", o.material.young_modulus, "Young's modulus")
    ->check(young_modulus())
    ->type_name("KPA")
    ->capture_default_str();
  app.add_option("--poisson-ratio", o.material.poisson_ratio, "Poisson's ratio")
    ->check(poisson_ratio())
    ->type_name("NU")
    ->capture_default_str();
  app
    .add_option(
      "--material", o.material_texts,
      "Material of the subdomain with a number or name: Young's modulus in kPa, Poisson's ratio, and, if you "
      "like, density in g/cm^3; can be given several times. Other subdomains have that of "
      "--young-modulus, --poisson-ratio and --density")
    ->type_name("LABEL=E,NU[,RHO]")
    ->allow_extra_args(false);
  CLI::Option* const gravity =
    app
      .add_option(
        "--gravity", o.gravity,
        "Acceleration in mm/s^2, for example 0,0,-9810; it acts on the tissue less the fluid that it "
        "displaces")
      ->type_name("X,Y,Z")
      ->capture_default_str();
  app.add_option("--density", o.density, "Density of the tissue, for --gravity")
    ->check(not_negative())
    ->type_name("G/CM3")
    ->capture_default_str();
  app
    .add_option("--fluid-density", o.model.fluid_density,
                "Density of the fluid around the tissue; 0: there is none")
    ->check(not_negative())
    ->type_name("G/CM3")
    ->capture_default_str();
  app
    .add_option(
      "--fluid-level", o.model.fluid_level,
      "Height of the fluid's surface, in the direction against gravity (the coordinate z if gravity is "
      "0,0,-9810): tissue above has its whole weight (default: all of it is in the fluid)")
    ->check(number("of a height", [](double x) { return std::isfinite(x); }))
    ->needs(gravity)
    ->type_name("MM");
}

void add_control(CLI::App& app, Options& o)
{
  app
    .add_option("--max-distance", o.model.points.max_distance,
                "Control points up to so far outside the mesh are taken to its boundary")
    ->check(not_negative())
    ->type_name("MM")
    ->capture_default_str();
  app
    .add_option("--control-radius", o.model.points.radius,
                "A control point has the mean displacement of the boundary within so far, mm; 0: that of "
                "the point itself, which a force then dents, the deeper the finer the mesh")
    ->check(not_negative())
    ->type_name("MM")
    ->capture_default_str();
  app
    .add_option(
      "--control-compliance", o.model.points.compliance,
      "How far a control point gives way to a force, for measurements that are noisy, in mm/mN; "
      "0: they are exact. It is divided by the weight of a point that has one (default: 0 for "
      "--control-points; for --landmarks, which are measured, 1 divided by --young-modulus, as on 22 "
      "public cases this predicted landmarks to 1.28 mm, and going through them to 1.35 mm)")
    ->check(not_negative())
    ->type_name("C");
  app.add_flag(
    "--leave-one-out", o.model.leave_one_out,
    "How well the other control points predict each of them, in mm: the error to be expected where "
    "there is none, in the report");
}

void add_method(CLI::App& app, Options& o)
{
  const std::vector<std::pair<std::string, Displacement_order>> orders{{"1", Displacement_order::LINEAR},
                                                                       {"2", Displacement_order::QUADRATIC},
                                                                       {"region",
                                                                        Displacement_order::REGION}};
  app
    .add_option(
      "--order", o.model.order,
      "Displacements in elements: 1, linear; 2, quadratic, many times as accurate on the same mesh, and "
      "slower; region: quadratic in the region of the mesh and 4 mm around. 2 and region not with --contact, "
      "--corotational or petsc, region not with --febio (default: 2 up to 3000 vertices with "
      "--control-radius and without these, if it inverts no element, else 1)")
    ->transform(CLI::CheckedTransformer(orders).description("{1,2,region}"))
    ->type_name("ORDER");
  app.add_flag(
    "--corotational", o.model.corotational,
    "Finite rotations: elements that turn with the tissue, by Newton's method; strains should still be "
    "small (default: small rotations)");
  app.add_flag(
    "--adapt", o.adapt,
    "Moves inner vertices of the mesh first, so that elements have less energy, and less error, where the "
    "boundary around the control points is displaced; what is written is on that mesh");
  const std::vector<std::pair<std::string, bool>> solvers{{"direct", false}, {"petsc", true}};
  app
    .add_option(
      "--solver", o.uses_petsc,
      "direct: factors the system (default); petsc: conjugate gradients and multigrid of PETSc, for "
      "10^5 vertices and more, in all processes of mpirun")
    ->transform(CLI::CheckedTransformer(solvers).description("{direct,petsc}"))
    ->type_name("SOLVER");
}

void add_outputs(CLI::App& app, Options& o, CLI::Option* image)
{
  app
    .add_option(
      "--output", o.outputs,
      "Mesh as it was, with the point data `displacement`, and in .vtu the cell data `resected`: .vtu, "
      ".msh, .feb; can be given several times")
    ->type_name("FILE")
    ->allow_extra_args(false);
  app
    .add_option("--output-order", o.output_order,
                "Order of the elements of --output: with 2, they have nodes in the middle of edges, and the "
                "displacements there, too")
    ->check(CLI::IsMember({1, 2}))
    ->type_name("ORDER")
    ->capture_default_str();
  app
    .add_option("--output-deformed", o.deformed_outputs,
                "Mesh that is left, deformed: .vtu, .msh, .mesh, .inp, .feb; can be given several times")
    ->type_name("FILE")
    ->allow_extra_args(false);
  app
    .add_option(
      "--febio", o.febio,
      "The simulation as a model that FEBio 4 runs as it is, .feb: mesh (after a resection what is left), "
      "materials, supports, control points and weight; not with --contact or --fluid-level")
    ->type_name("FILE.feb");
  CLI::Option* output_image =
    app
      .add_option("--output-image", o.images.output,
                  "Start of the names of images: PREFIX.nii.gz (deformed), PREFIX_mask.nii.gz (1 tissue, "
                  "2 resected), PREFIX_labels.nii.gz with --labels, and the fields of --field")
      ->needs(image)
      ->type_name("PREFIX");
  image->needs(output_image);
  const std::vector<std::pair<std::string, mm3::IO::Field_format>> formats{
    {"itk", mm3::IO::Field_format::ITK},
    {"nifti", mm3::IO::Field_format::NIFTI},
    {"nrrd", mm3::IO::Field_format::NRRD}};
  app
    .add_option(
      "--field", o.images.field_formats,
      "Displacement fields, PREFIX_backward... to deform images with and PREFIX_forward... for points: "
      "itk (NIfTI with LPS vectors for ITK, ANTs, plastimatch; ..._itk.nii.gz), nifti (RAS vectors; "
      "....nii.gz), nrrd (3D Slicer; ....nrrd); can be given several times")
    ->transform(CLI::CheckedTransformer(formats, CLI::ignore_case).description("{itk,nifti,nrrd}"))
    ->needs(output_image)
    ->type_name("FORMAT")
    ->allow_extra_args(false);
  using Interpolation = mm3::Displacement_interpolation;
  const std::vector<std::pair<std::string, Interpolation>> interpolations{{"linear", Interpolation::LINEAR},
                                                                          {"recovered",
                                                                           Interpolation::RECOVERED}};
  app
    .add_option("--interpolation", o.images.interpolation,
                "Displacement between vertices, for the image: recovered, by shape functions and gradients, "
                "or with --order 2 as it was computed (default); or linear, between vertices only")
    ->transform(CLI::CheckedTransformer(interpolations, CLI::ignore_case).description("{linear,recovered}"))
    ->type_name("HOW");
  app.add_option("--report", o.report, "Report with counts, displacements, forces, parameters and times")
    ->type_name("FILE.json");
  app
    .add_option(
      "--page", o.page,
      "Page for a browser, in one file that needs no network: the mesh in 3D before and after, to turn and "
      "to cut open, displacements, control points and quality")
    ->type_name("FILE.html");
}

void set_up(CLI::App& app, Options& o)
{
  CLI::Option* const image = add_inputs(app, o);
  add_supports(app, o);
  add_physics(app, o);
  add_control(app, o);
  add_method(app, o);
  add_outputs(app, o, image);
  app.add_flag("--quiet", o.quiet, "Print errors and warnings only");
  app.set_version_flag("--version", "brain_shift 0.1 (CGAL " CGAL_VERSION_STR ")");
  app.footer("Lengths are in mm. Example:\n"
             "  brain_shift brain.vtu --control-points data/control_points.csv --control-radius 14 "
             "--tumor data/tumour.off --output shift.vtu");
}

// Three numbers with commas between them.
std::array<double, 3> vector_of(const char* option, const std::string& text)
{
  const auto columns = control_points::columns(text);
  std::array<double, 3> v{};
  bool is_valid = columns.size() == 3;
  for(std::size_t i = 0; is_valid && i < 3; ++i)
    is_valid = control_points::read_number(columns[i], v[i]).empty() && std::abs(v[i]) < 1e9;
  if(!is_valid)
    throw CLI::ValidationError(option, "expected three numbers with commas between them, not "
                                         + control_points::quoted(text));
  return v;
}

// Checks names of patches: names that an option does not know are names of files.
void check_patches(const CLI::App& app, Options& o)
{
  const auto check = [](const char* option, const std::vector<std::string>& patches, const char* foreign) {
    for(const std::string& patch : patches)
      if(patch == foreign || (patch.rfind(label_prefix, 0) == 0 && !label_of(patch)))
        throw CLI::ValidationError(option, control_points::quoted(patch) + " is no patch for this option");
      else if(const auto shape = patch_shape(patch); shape && !shape->defect.empty())
        throw CLI::ValidationError(option + (' ' + patch), shape->defect);
  };
  check("--fixed", o.patches.fixed, skull_patch);
  check("--slide", o.patches.sliding, base_patch);
  check("--contact", o.patches.touching, base_patch);
  check("--opening", o.patches.openings, base_patch);
  check("--opening", o.patches.openings, skull_patch);
  const bool has_base = std::count(o.patches.fixed.begin(), o.patches.fixed.end(), base_patch) != 0;
  if(!o.patches.fixed.empty() && !has_base && app.count("--fixed-below") == 0)
    o.model.supports.fixed_below = 0;
}

// The material in a text: a label, and two or three numbers.
Labeled_material material_of(const std::string& text, const mm3::Elastic_material& other)
{
  const std::size_t end = text.rfind('=');
  const auto columns = control_points::columns(end == text.npos ? ""
                                                                : std::string_view(text).substr(end + 1));
  if(end == text.npos || end == 0 || columns.size() < 2 || columns.size() > 3)
    throw CLI::ValidationError("--material",
                               "expected LABEL=E,NU or LABEL=E,NU,RHO, not " + control_points::quoted(text));
  const auto read = [&](std::size_t i, const char* what, const CLI::Validator& check) {
    double x = 0;
    std::string number(columns[i]), defect = control_points::read_number(number, x);
    if(defect.empty())
      defect = check(number);
    if(!defect.empty())
      throw CLI::ValidationError("--material", control_points::quoted(text) + ": " + what + ": " + defect);
    return x;
  };
  Labeled_material result{text.substr(0, end), other};
  result.material.young_modulus = read(0, "Young's modulus", young_modulus());
  result.material.poisson_ratio = read(1, "Poisson's ratio", poisson_ratio());
  if(columns.size() == 3)
    result.material.density = kg_per_mm3 * read(2, "density", not_negative());
  return result;
}

// Checks options that FEBio's model can not represent: contact is with a rigid body there, and a force by
// mass does not act on tissue without mass, nor from a height upwards.
void check_febio(const Options& o)
{
  const auto refuse = [](const char* option, const std::string& why) {
    throw CLI::ValidationError(option, "cannot be written to a model of FEBio (--febio): " + why);
  };
  if(mm3::IO::format_of(o.febio) != mm3::IO::Format::FEB)
    throw CLI::ValidationError("--febio", control_points::quoted(o.febio) + " does not end in .feb");
  if(!o.patches.touching.empty())
    refuse("--contact", "contact is with another body there, not with the boundary as it was");
  const bool has_weight = o.model.acceleration != std::array<double, 3>{};
  if(has_weight && std::isfinite(o.model.fluid_level))
    refuse("--fluid-level", "forces of FEBio are by mass, the same in all of a subdomain");
  const bool is_massless = o.density == 0
                           || std::any_of(o.materials.begin(), o.materials.end(),
                                          [](const auto& m) { return m.material.density == 0; });
  if(has_weight && o.model.fluid_density > 0 && is_massless)
    refuse("--density", "forces of FEBio are by mass, and tissue without mass would float");
}

void check_fiducials(const char* option, const std::string& before, const std::string& after)
{
  if(is_fiducials(before) != !after.empty())
    throw CLI::ValidationError(option, after.empty() ? "fiducials are needed before and after"
                                                     : "is for fiducials, .fcsv or .mrk.json, only");
}

// Checks options of points. Landmarks are the control points if there are no others. Displacements depend on
// the product of the compliance of control points and the stiffness of the tissue: the compliance that was
// found with 1 kPa is divided by Young's modulus.
void check_points(const CLI::App& app, Options& o)
{
  constexpr double compliance_at_1_kPa = 1;
  check_fiducials("--control-points-after", o.model.points.file, o.model.points.file_after);
  check_fiducials("--landmarks-after", o.model.landmarks.file, o.model.landmarks.file_after);
  if(o.model.points.file.empty() && o.model.landmarks.file.empty())
    throw CLI::RequiredError("--control-points or --landmarks");
  const bool has_compliance = app.count("--control-compliance") != 0;
  Point_options& points = o.model.points;
  Landmark_options& landmarks = o.model.landmarks;
  landmarks.max_distance = points.max_distance;
  landmarks.radius = points.radius;
  landmarks.compliance = has_compliance ? points.compliance : compliance_at_1_kPa / o.material.young_modulus;
  landmarks.are_control_points = points.file.empty();
  if(landmarks.are_control_points)
    points = landmarks;
}

// The option that can only be had with linear displacements; empty if there is none.
std::string option_of_order_1(const Options& o)
{
  return !o.patches.touching.empty() ? "--contact"
         : o.model.corotational      ? "--corotational"
         : o.uses_petsc              ? "--solver petsc"
                                     : "";
}

// Checks conditions that the parser does not check.
void check_use(const CLI::App& app, bool has_petsc, Options& o)
{
  check_points(app, o);
  const std::string axes = "xyz";
  const bool is_downwards = o.up.size() == 2 && o.up[0] == '-';
  const std::size_t axis = o.up.size() == 1 || is_downwards ? axes.find(o.up.back()) : axes.npos;
  if(axis != axes.npos)
    o.model.supports.up[axis] = is_downwards ? -1 : 1;
  else
    o.model.supports.up = vector_of("--up", o.up);
  const auto& u = o.model.supports.up;
  const double length = std::sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
  if(!(length > 0))
    throw CLI::ValidationError("--up", "is not a direction");
  for(double& x : o.model.supports.up)
    x *= 1 / length;
  o.model.acceleration = vector_of("--gravity", o.gravity);
  o.material.density = o.density * kg_per_mm3;
  for(const std::string& text : o.material_texts)
    o.materials.push_back(material_of(text, o.material));
  check_patches(app, o);
  o.model.keeps_constraints = !o.febio.empty();
  if(!o.febio.empty())
    check_febio(o);
  if(o.uses_petsc != has_petsc)
    throw CLI::ValidationError("--solver", has_petsc ? "this program is for petsc only"
                                                     : "this program was built without PETSc");
  const std::string& other = o.model.option_of_order_1 = option_of_order_1(o);
  if((o.model.order == Displacement_order::QUADRATIC || o.model.order == Displacement_order::REGION)
     && !other.empty())
    throw CLI::ValidationError("--order", "only order 1 can be had with " + other);
  if(o.model.order == Displacement_order::REGION && !o.febio.empty())
    throw CLI::ValidationError("--order",
                               "elements of a model of FEBio (--febio) have order 1 or 2 everywhere");
  if(!o.images.file.empty() && !has_nifti)
    throw CLI::ValidationError("--image", "this program was built without nifti_clib");
}

// The images that are written. The names are those of `write_warped_image()`, and that of the labels.
std::vector<std::string> image_outputs(const Image_options& o)
{
  std::vector<std::string> paths;
  if(o.output.empty())
    return paths;
  for(const char* name : {"", "_mask"})
    paths.push_back(o.output + name + ".nii.gz");
  if(!o.labels.empty())
    paths.push_back(o.labels_output());
  for(mm3::IO::Field_format format : o.field_formats)
    for(const char* name : {"_forward", "_backward"})
      paths.push_back(o.output + name + mm3::IO::end_of_field_name(format));
  return paths;
}

} // namespace

std::optional<int> parse_command_line(int argc, char** argv, bool has_petsc, Options& options)
{
  CLI::App app(
    "Computes how a brain shifts from the displacements of some points, before and after a tumor "
    "is resected, and deforms the image with it. Linear elasticity, small strain; small rotations, or "
    "finite ones.");
  set_up(app, options);
  options.command = command_of("brain_shift", argc, argv);
  return parse("brain_shift", app, argc, argv, [&] { check_use(app, has_petsc, options); });
}

bool can_hold_displacements(const std::string& path)
{
  using mm3::IO::Format;
  const std::optional<Format> format = mm3::IO::format_of(path);
  return format == Format::VTU || format == Format::MSH_4_1 || format == Format::MSH_2_2
         || format == Format::FEB;
}

std::vector<std::string> outputs_of(const Options& o)
{
  std::vector<std::string> outputs;
  for(const auto& paths : {o.outputs, o.deformed_outputs, image_outputs(o.images)})
    outputs.insert(outputs.end(), paths.begin(), paths.end());
  for(const std::string& path : {o.report, o.page, o.febio})
    if(!path.empty())
      outputs.push_back(path);
  return outputs;
}

std::vector<std::string> inputs_of(const Options& o)
{
  std::vector<std::string> inputs{o.model.mesh,
                                  o.model.points.file,
                                  o.model.points.file_after,
                                  o.model.landmarks.file,
                                  o.model.landmarks.file_after,
                                  o.tumor,
                                  o.images.file,
                                  o.images.labels};
  for(const auto& patches : {o.patches.fixed, o.patches.sliding, o.patches.touching, o.patches.openings})
    inputs.insert(inputs.end(), patches.begin(), patches.end());
  return inputs;
}

void check_feasible(const Options& o)
{
  // A temporary file exists while the program tests whether a file can be written.
  const Deferred_signals deferred({SIGINT, SIGTERM, SIGHUP}, Deferred_signals::Second::DEFERRED);
  std::vector<std::string> outputs = o.outputs;
  for(const std::string& path : o.outputs)
    if(!can_hold_displacements(path))
      throw std::runtime_error(path + ": displacements can be written to .vtu, .msh and .feb only");
  for(const std::string& path : o.deformed_outputs) {
    require([&](std::string* error) { return mm3::IO::check_output_path(path, error); });
    outputs.push_back(path);
  }
  for(const std::string& path : image_outputs(o.images))
    outputs.push_back(path);
  for(const std::string& path : {o.report, o.page, o.febio})
    if(!path.empty())
      outputs.push_back(path);
  Output_paths paths(inputs_of(o));
  for(const std::string& path : outputs) {
    require([&](std::string* error) { return mm3::IO::check_output_directory(path, error); });
    paths.add(path);
  }
}
