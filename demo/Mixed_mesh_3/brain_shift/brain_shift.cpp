// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Brain shift on the command line: from a mesh and some points with measured displacements to the
// displacement of the whole, before and after a resection, and to the image as it looks then. Section 6.2 of
// Lobos, Bucki, Hitschfeld, Payan: "Mixed-element mesh for an intra-operative modeling of the brain tumor
// extraction". Exit status: 0 all went well; 1 bad input, or no solution for it, or a file that cannot be
// written; 2 wrong use.

#include "common/Stage_log.h"
#include "common/command_line.h"
#include "read_control_points.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Linear_elasticity_3.h>
#include <CGAL/Mixed_mesh_3/Element_locator_3.h>
#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Mixed_mesh_3/IO/read_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/IO/write_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/certificate.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/resect.h>
#include <CGAL/Mixed_mesh_3/validation.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/version.h>

// CMakeLists.txt defines it if nifti_clib was found; without, there are no images, and all else works.
#ifndef MIXED_MESH_3_HAS_NIFTI
#define MIXED_MESH_3_HAS_NIFTI 0
#endif
#if MIXED_MESH_3_HAS_NIFTI
#include <CGAL/Mixed_mesh_image_3/IO/NIFTI.h>
#include <CGAL/Mixed_mesh_image_3/warp_image.h>
#endif

#include <CLI/CLI.hpp>
#include <boost/version.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>
#include <limits>
#include <new>
#include <optional>
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
using Elasticity = CGAL::Linear_elasticity_3<Mesh>;
using Elasticity_status = CGAL::Linear_elasticity_status;
using Vector = mm3::Vec3;
using Json = nlohmann::ordered_json;
using mm3::dot;
using mm3::norm;

struct Options
{
  std::string mesh, control_points, tumor, image, output_image, report, up = "z", gravity = "0,0,0";
  std::vector<std::string> outputs, deformed_outputs;
  double fixed_below = 0.3, slide_below = 0, slide_beyond = std::numeric_limits<double>::infinity();
  double max_distance = 5, compliance = 0, control_radius = 0;
  mm3::Elastic_material material;
  bool quiet = false;

  // of the two texts
  Vector up_direction{}, acceleration{};

  // Whether a control point itself has just the displacement asked for.
  bool is_exact() const { return compliance == 0 && control_radius == 0; }
};

void set_up(CLI::App& app, Options& o)
{
  const auto fraction = number("from 0 to 1", [](double x) { return x >= 0 && x <= 1; });
  const auto positive = number("greater than 0", [](double x) { return x > 0; });
  const auto not_negative = number("of at least 0", [](double x) { return x >= 0; });
  app.add_option("MESH", o.mesh, "Mesh of the brain, in mm: .vtu or .msh")->required();
  app.add_option("--control-points", o.control_points,
                 "Table of points with given displacements, in mm: a header x,y,z,dx,dy,dz, then a line for "
                 "each")
    ->required()
    ->type_name("FILE.csv");
  app.add_option("--tumor,--tumour", o.tumor,
                 "Closed surface: elements whose centroid is inside are removed, after the shift")
    ->type_name("SURFACE");
  CLI::Option* image = app.add_option("--image", o.image, "Image before the shift: .nii or .nii.gz")
                         ->type_name("IMAGE");
  app.add_option("--up", o.up, "Direction of height: x, y, z, -x, -y, -z, or three numbers")
    ->type_name("X,Y,Z")
    ->capture_default_str();
  app.add_option("--fixed-below", o.fixed_below,
                 "Boundary vertices in that lower part of the height are fixed; 0: none")
    ->check(fraction)
    ->type_name("FRACTION")
    ->capture_default_str();
  CLI::Option* slide_below =
    app.add_option("--slide-below", o.slide_below,
                   "Boundary vertices in that lower part of the height that are not fixed slide along the "
                   "boundary without friction (default: 0, none)")
      ->check(fraction)
      ->type_name("FRACTION");
  app.add_option("--slide-beyond", o.slide_beyond,
                 "Boundary vertices farther than that from all control points slide, unless fixed: the skull "
                 "holds the brain but at the opening (default: none)")
    ->check(not_negative)
    ->excludes(slide_below)
    ->type_name("MM");
  app.add_option("--young-modulus", o.material.young_modulus, "Young's modulus")
    ->check(positive)
    ->type_name("KPA")
    ->capture_default_str();
  app.add_option("--poisson-ratio", o.material.poisson_ratio, "Poisson's ratio")
    ->check(number("of at least 0 and below 0.5", [](double x) { return x >= 0 && x < 0.5; }))
    ->type_name("NU")
    ->capture_default_str();
  app.add_option("--gravity", o.gravity,
                 "Acceleration in mm/s^2, for example 0,0,-9810; tissue weighs 1 kg/l")
    ->type_name("X,Y,Z")
    ->capture_default_str();
  app.add_option("--max-distance", o.max_distance,
                 "Control points up to so far outside the mesh are taken to its boundary")
    ->check(not_negative)
    ->type_name("MM")
    ->capture_default_str();
  app.add_option("--control-radius", o.control_radius,
                 "A control point has the mean displacement of the boundary within so far, mm; 0: that of the "
                 "point itself, which a force then dents, the deeper the finer the mesh")
    ->check(not_negative)
    ->type_name("MM")
    ->capture_default_str();
  app.add_option("--control-compliance", o.compliance,
                 "How far a control point gives way to a force, for measurements that are noisy, in mm/mN; "
                 "0: they are exact")
    ->check(not_negative)
    ->type_name("C")
    ->capture_default_str();
  app.add_option("--output", o.outputs,
                 "Mesh as it was, with the point data `displacement` and the cell data `resected`: .vtu; can "
                 "be given several times")
    ->type_name("FILE.vtu")
    ->allow_extra_args(false);
  app.add_option("--output-deformed", o.deformed_outputs,
                 "Mesh that is left, deformed: .vtu, .msh, .mesh, .inp, .feb; can be given several times")
    ->type_name("FILE")
    ->allow_extra_args(false);
  CLI::Option* output_image =
    app.add_option("--output-image", o.output_image,
                   "Start of the names of images: PREFIX.nii.gz (deformed), PREFIX_forward.nii.gz, "
                   "PREFIX_backward.nii.gz (displacements), PREFIX_mask.nii.gz (1 tissue, 2 resected)")
      ->needs(image)
      ->type_name("PREFIX");
  image->needs(output_image);
  app.add_option("--report", o.report, "Report with counts, displacements, forces, parameters and times")
    ->type_name("FILE.json");
  app.add_flag("--quiet", o.quiet, "Print errors and warnings only");
  app.set_version_flag("--version", "brain_shift 0.1 (CGAL " CGAL_VERSION_STR ")");
  app.footer("Lengths are in mm. Example:\n"
             "  brain_shift brain.vtu --control-points data/control_points.csv --tumor data/tumour.off "
             "--output shift.vtu");
}

// Three numbers with commas between them.
Vector vector_of(const char* option, const std::string& text)
{
  const auto columns = control_points::columns(text);
  Vector v{};
  bool is_valid = columns.size() == 3;
  for(std::size_t i = 0; is_valid && i < 3; ++i)
    is_valid = control_points::read_number(columns[i], v[i]).empty() && std::abs(v[i]) < 1e9;
  if(!is_valid)
    throw CLI::ValidationError(option, "expected three numbers with commas between them, not "
                                         + control_points::quoted(text));
  return v;
}

// What the parser does not check.
void check_use(Options& o)
{
  const std::string axes = "xyz";
  const bool is_downwards = o.up.size() == 2 && o.up[0] == '-';
  const std::size_t axis = o.up.size() == 1 || is_downwards ? axes.find(o.up.back()) : axes.npos;
  if(axis != axes.npos)
    o.up_direction[axis] = is_downwards ? -1 : 1;
  else
    o.up_direction = vector_of("--up", o.up);
  if(!(norm(o.up_direction) > 0))
    throw CLI::ValidationError("--up", "is not a direction");
  o.up_direction = (1 / norm(o.up_direction)) * o.up_direction;
  o.acceleration = vector_of("--gravity", o.gravity);
  if(!o.image.empty() && !MIXED_MESH_3_HAS_NIFTI)
    throw CLI::ValidationError("--image", "this program was built without nifti_clib");
}

std::string place(const Vector& p)
{
  std::ostringstream text;
  text << '(' << p[0] << ", " << p[1] << ", " << p[2] << ')';
  return text.str();
}

std::string counted(std::size_t n, const char* one, const char* many)
{
  return std::to_string(n) + ' ' + (n == 1 ? one : many);
}

// The images that are written: the names are those of `write_warped_image()`.
std::vector<std::string> image_outputs(const Options& o)
{
  std::vector<std::string> paths;
  if(!o.output_image.empty())
    for(const char* name : {"", "_forward", "_backward", "_mask"})
      paths.push_back(o.output_image + name + ".nii.gz");
  return paths;
}

// Before anything takes time: what can not be written.
void check_feasible(const Options& o)
{
  std::vector<std::string> outputs = o.outputs;
  for(const std::string& path : o.outputs)
    if(mm3::IO::format_of(path) != mm3::IO::Format::VTU)
      throw std::runtime_error(path + ": displacements can be written to .vtu only");
  for(const std::string& path : o.deformed_outputs) {
    if(const auto error = mm3::IO::check_output_path(path))
      throw std::runtime_error(*error);
    outputs.push_back(path);
  }
  for(const std::string& path : image_outputs(o))
    outputs.push_back(path);
  if(!o.report.empty())
    outputs.push_back(o.report);
  std::set<std::filesystem::path> seen;
  for(const std::string& path : outputs) {
    if(const auto error = mm3::IO::check_output_directory(path))
      throw std::runtime_error(*error);
    std::error_code ignored;
    for(const std::string& input : {o.mesh, o.control_points, o.tumor, o.image})
      if(std::filesystem::equivalent(path, input, ignored))
        throw std::runtime_error(path + ": is given twice, as input and as output");
    if(!seen.insert(std::filesystem::weakly_canonical(path, ignored)).second)
      throw std::runtime_error(path + ": is given twice as output");
  }
}

// The response of each vertex and control point to each control point: 3 x 3 numbers.
void check_memory(const Options& o, const Mesh& mesh, std::size_t number_of_points)
{
  const double n = double(number_of_points), needed = 72 * n * (double(mesh.number_of_vertices()) + 2 * n);
  if(needed > available_memory())
    throw std::runtime_error(o.control_points + ": " + std::to_string(number_of_points)
                             + " control points would need about " + gibibytes(needed) + " GiB of memory, of "
                             + gibibytes(available_memory()) + " GiB");
}

// A mesh that can be computed with, or an exception.
Mesh read_mesh(const std::string& path, std::vector<std::string>& warnings)
{
  Mesh mesh;
  mm3::IO::read_mixed_mesh(path, mesh);
  const mm3::Mesh_defects d = mm3::find_defects(mesh);
  const auto refuse = [&path](const std::string& defect) { throw std::runtime_error(path + ": " + defect); };
  if(d.invalid_elements != 0)
    refuse(counted(d.invalid_elements, "element has", "elements have")
           + " a vertex twice, or one that does not exist");
  if(!d.positive()) {
    std::size_t first = 0;
    while(mm3::jacobian_sign(mesh, first) == mm3::Jacobian_sign::POSITIVE)
      ++first;
    refuse(counted(d.nonpositive_elements + d.undecided_elements, "element is", "elements are")
           + " inverted, the first is element " + std::to_string(first));
  }
  if(!d.conforming())
    refuse(counted(d.nonconforming_faces, "face does", "faces do") + " not fit together");
  if(!d.closed_manifold_boundary())
    refuse("its boundary is not a manifold: " + counted(d.nonmanifold_boundary_edges, "edge", "edges")
           + " and " + counted(d.nonmanifold_boundary_vertices, "vertex", "vertices")
           + " where it touches itself; parts would hang on by a hinge");
  if(d.unused_vertices != 0)
    warnings.push_back(path + ": " + counted(d.unused_vertices, "vertex is", "vertices are")
                       + " in no element");
  if(d.duplicate_vertices != 0)
    warnings.push_back(path + ": " + counted(d.duplicate_vertices, "vertex is", "vertices are")
                       + " at the place of another one: elements are not joined there");
  return mesh;
}

Json describe(const Mesh& mesh, const std::string& path)
{
  Json report = {{"file", path},
                 {"vertices", mesh.number_of_vertices()},
                 {"elements", mesh.number_of_elements()}};
  const auto counts = mesh.elements().counts();
  for(int k = 0; k < mm3::number_of_element_kinds; ++k)
    report[mm3::reference_elements[k].plural] = counts[std::size_t(k)];
  report["volume"] = mm3::volume(mesh);
  return report;
}

Surface read_surface(const std::string& path, Json& report, std::vector<std::string>& warnings)
{
  Surface surface;
  const mm3::IO::Surface_input input = mm3::IO::read_closed_surface(path, surface);
  for(const std::string& warning : input.warnings)
    warnings.push_back(path + ": " + warning);
  report = {{"file", path}, {"triangles", surface.number_of_faces()}, {"volume", input.volume}};
  return surface;
}

#if MIXED_MESH_3_HAS_NIFTI

mm3::Voxel_image_3 read_image(const Options& o, const Mesh& mesh, Json& report,
                              std::vector<std::string>& warnings)
{
  mm3::Voxel_image_3 image = mm3::IO::read_NIFTI(o.image);
  const mm3::Voxel_grid_3& grid = image.grid;
  const mm3::Affine_map_3 to_index = mm3::inverse(grid.index_to_world);
  const auto limits = std::minmax_element(image.values.begin(), image.values.end());
  std::size_t inside = 0;
  CGAL::Bbox_3 box;
  for(const auto& p : mesh.points()) {
    const Vector index = mm3::transform(to_index, mm3::to_vec3(p));
    bool is_inside = true;
    for(int k = 0; k < 3; ++k)
      is_inside = is_inside && index[k] >= -0.5 && index[k] <= double(grid.size[k]) - 0.5;
    inside += is_inside;
    box += p.bbox();
  }
  const double overlap = double(inside) / double(mesh.number_of_vertices());
  if(inside == 0) {
    Vector middle;
    for(int k = 0; k < 3; ++k)
      middle[k] = 0.5 * double(grid.size[k] - 1);
    throw std::runtime_error(o.image + ": the image does not overlap the mesh " + o.mesh
                             + ": its center is at " + place(mm3::transform(grid.index_to_world, middle))
                             + ", the mesh's at "
                             + place({(box.xmin() + box.xmax()) / 2, (box.ymin() + box.ymax()) / 2,
                                      (box.zmin() + box.zmax()) / 2}) + ", in mm");
  }
  if(inside != mesh.number_of_vertices())
    warnings.push_back(o.image + ": only " + std::to_string(inside) + " of "
                       + std::to_string(mesh.number_of_vertices()) + " vertices of " + o.mesh
                       + " are in the image: are both in the same coordinates?");
  report = {{"file", o.image},
            {"voxels", grid.size},
            {"volume of a voxel", std::abs(mm3::determinant(grid.index_to_world))},
            {"world (NIfTI's number)", grid.world},
            {"smallest value", *limits.first},
            {"largest value", *limits.second},
            {"share of the mesh's vertices inside", overlap}};
  return image;
}

#endif

/// Where a control point is in the mesh.
using Locations = std::vector<mm3::Element_location_3>;

[[noreturn]] void refuse(const CGAL::Linear_elasticity_result_3& result, const Options& o,
                         const std::vector<Control_point>& points)
{
  const auto at_line = [&] {
    return o.control_points + ": line " + std::to_string(points[result.control_point].line) + ": ";
  };
  switch(result.status) {
  case Elasticity_status::CONTROL_POINT_OUTSIDE:
    throw std::runtime_error(at_line() + "the control point is " + rounded(result.distance) + " mm outside "
                             + o.mesh + "; --max-distance is " + rounded(o.max_distance) + " mm");
  case Elasticity_status::CONTRADICTORY_CONTROL_POINTS:
    throw std::runtime_error(at_line() + "the displacement contradicts those of other control points, or "
                             "supports, in the same element: it is missed by " + rounded(result.distance)
                             + " mm; see --control-compliance, --fixed-below");
  case Elasticity_status::FREE_RIGID_MOTION:
    throw std::runtime_error(o.mesh + ": " + result.description()
                             + ", and the control points do not hold it; see --fixed-below");
  default:
    throw std::runtime_error(o.mesh + ": " + result.description());
  }
}

Locations locate(const Mesh& mesh, const Options& o, const std::vector<Control_point>& points)
{
  const mm3::Element_locator_3<Mesh> locator(mesh);
  Locations locations;
  for(const Control_point& point : points) {
    locations.push_back(locator.nearest(point.position));
    if(!(locations.back().distance <= o.max_distance)) {
      CGAL::Linear_elasticity_result_3 result;
      result.status = Elasticity_status::CONTROL_POINT_OUTSIDE;
      result.control_point = locations.size() - 1;
      result.distance = locations.back().distance;
      refuse(result, o, points);
    }
  }
  return locations;
}

// Says which vertices of the boundary are fixed, and which slide.
Json set_supports(Elasticity& elasticity, const Options& o, const std::vector<Control_point>& points)
{
  const Mesh& mesh = elasticity.mesh();
  std::set<mm3::Vertex_index> boundary;
  for(const auto& f : mesh.boundary_faces())
    for(mm3::Vertex_index v : mm3::internal::face_vertices(mesh.element(f.element), f.local_face))
      if(v != mm3::internal::no_vertex)
        boundary.insert(v);
  const auto position = [&mesh](mm3::Vertex_index v) { return mm3::to_vec3(mesh.point(v)); };
  const auto height = [&](mm3::Vertex_index v) { return dot(position(v), o.up_direction); };
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for(mm3::Vertex_index v : boundary) {
    lowest = (std::min)(lowest, height(v));
    highest = (std::max)(highest, height(v));
  }
  const auto is_below = [&](mm3::Vertex_index v, double part) {
    return height(v) < lowest + part * (highest - lowest);
  };
  std::size_t fixed = 0, sliding = 0;
  for(mm3::Vertex_index v : boundary)
    if(is_below(v, o.fixed_below)) {
      elasticity.prescribe(v);
      ++fixed;
    }
  elasticity.slide_along_boundary([&](mm3::Vertex_index v) {
    double distance = std::numeric_limits<double>::infinity();
    for(const Control_point& point : points)
      distance = (std::min)(distance, norm(point.position - position(v)));
    const bool is_sliding =
      !is_below(v, o.fixed_below) && (is_below(v, o.slide_below) || distance > o.slide_beyond);
    sliding += is_sliding;
    return is_sliding;
  });
  return {{"boundary vertices", boundary.size()}, {"fixed", fixed}, {"sliding", sliding}};
}

// Elements that the displacement inverts; their Jacobian is zero or negative somewhere.
std::vector<std::size_t> find_inverted_elements(const Mesh& mesh, const std::vector<Vector>& displacements,
                                                const std::vector<bool>& is_removed)
{
  std::vector<std::size_t> inverted;
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
    if(!is_removed[e]
       && mm3::jacobian_sign(mesh.element(e), [&](mm3::Vertex_index v) {
            return mm3::to_vec3(mesh.point(v)) + displacements[v];
          }) != mm3::Jacobian_sign::POSITIVE)
      inverted.push_back(e);
  return inverted;
}

/// A displacement of the mesh, and what is to be said of it.
struct Shift
{
  std::vector<Vector> displacements; // of vertices
  Json report;
  double largest = 0;
};

// \param is_used of each control point
// \param is_exact whether control points have the displacements that were asked for, or a spring gives way
Shift shift_of(const Elasticity& elasticity, const std::vector<Control_point>& points,
               const Locations& locations, const std::vector<bool>& is_used, const std::string& when,
               bool is_exact, std::vector<std::string>& warnings)
{
  const Mesh& mesh = elasticity.mesh();
  Shift shift{elasticity.displacements(), Json(), 0};
  mm3::Vertex_index farthest = 0;
  for(mm3::Vertex_index v = 0; v < mesh.number_of_vertices(); ++v) {
    const double length = norm(shift.displacements[v]);
    if(!std::isfinite(length))
      throw std::runtime_error("the displacement is not finite");
    if(length > shift.largest) {
      shift.largest = length;
      farthest = v;
    }
  }
  const std::vector<std::size_t> inverted =
    find_inverted_elements(mesh, shift.displacements, elasticity.removed_elements());
  if(!inverted.empty())
    warnings.push_back(when + ": " + counted(inverted.size(), "element is", "elements are")
                       + " inverted, the first near "
                       + place(mm3::to_vec3(mesh.point(mesh.element(inverted.front())[0])))
                       + ": too much is asked of the elements there; --control-radius, or "
                         "--control-compliance, would spread it");

  const std::vector<Vector> forces = elasticity.control_forces();
  Json controls = Json::array();
  double largest_miss = 0;
  for(std::size_t i = 0, used = 0; i < points.size(); ++i) {
    Json control = {{"line", points[i].line}, {"used", bool(is_used[i])}};
    if(is_used[i]) {
      const auto element = mesh.element(locations[i].element);
      Vector reached{};
      for(int k = 0; k < element.size(); ++k)
        reached = reached + locations[i].weights[k] * shift.displacements[element[k]];
      const double miss = norm(reached - points[i].displacement);
      largest_miss = (std::max)(largest_miss, miss);
      control["displacement"] = reached;
      control["missed by"] = miss;
      control["force"] = forces[used++];
    }
    controls.push_back(control);
  }
  if(is_exact && largest_miss > 1e-6 * (1 + shift.largest)) // our fault
    throw std::logic_error(when + ": control points are missed by up to " + rounded(largest_miss) + " mm");
  shift.report = {{"largest displacement", shift.largest},
                  {"at", mm3::to_vec3(mesh.point(farthest))},
                  {"energy", elasticity.energy()},
                  {"inverted elements", inverted.size()},
                  {"control points", controls},
                  {"control points missed by at most", largest_miss}};
  return shift;
}

// A face that is warped counts as the mean of its two splits.
double area_of(const Mesh& mesh, const Mesh::Boundary_face& face)
{
  const auto v = mm3::internal::face_vertices(mesh.element(face.element), face.local_face);
  const auto triangle = [&](int i, int j, int k) {
    const Vector p = mm3::to_vec3(mesh.point(v[std::size_t(i)]));
    return norm(mm3::cross(mm3::to_vec3(mesh.point(v[std::size_t(j)])) - p,
                                     mm3::to_vec3(mesh.point(v[std::size_t(k)])) - p)) / 2;
  };
  return v[3] == mm3::internal::no_vertex
           ? triangle(0, 1, 2)
           : (triangle(0, 1, 2) + triangle(0, 2, 3) + triangle(1, 2, 3) + triangle(1, 3, 0)) / 2;
}

Json describe(const mm3::Resection_3& resection, const Mesh& mesh, const Mesh& remaining)
{
  double cavity = 0;
  for(const auto& face : mm3::cavity_faces(mesh, resection.is_removed))
    cavity += area_of(remaining, face);
  Json floating = Json::array();
  for(const mm3::Floating_piece_3& piece : resection.floating)
    floating.push_back({{"elements", piece.elements.size()}, {"volume", piece.volume}});
  return {{"status", mm3::description(resection.status)},
          {"elements removed", std::count(resection.is_removed.begin(), resection.is_removed.end(), true)},
          {"elements inside", resection.number_of_asked_elements},
          {"of which stay, or a vertex would be pinched", resection.number_of_restored_elements},
          {"removed besides, as they came loose", resection.number_of_floating_elements},
          {"removed besides, or a vertex would be pinched", resection.number_of_pinch_elements},
          {"floating pieces", floating},
          {"cavity volume", resection.volume},
          {"cavity area", cavity},
          {"vertices left", remaining.number_of_vertices()},
          {"elements left", remaining.number_of_elements()}};
}

Json costs_of(const Stage_log& log)
{
  Json stages = Json::array();
  for(const Stage_cost& c : log.costs())
    stages.push_back({{"stage", c.name},
                      {"ms", 1000 * c.seconds},
                      {"CPU ms", 1000 * c.cpu_seconds},
                      {"peak memory MiB", double(c.peak_bytes) / (1 << 20)}});
  return stages;
}

Json parameters_of(const Options& o)
{
  const auto quantity = [](const Json& value, const char* unit) {
    return Json{{"value", value}, {"unit", unit}};
  };
  return {{"Young's modulus", quantity(o.material.young_modulus, "kPa")},
          {"Poisson's ratio", quantity(o.material.poisson_ratio, "1")},
          {"density", quantity(o.material.density, "kg/mm^3")},
          {"gravity", quantity(o.acceleration, "mm/s^2")},
          {"up", quantity(o.up_direction, "1")},
          {"fixed below", quantity(o.fixed_below, "height")},
          {"slide below", quantity(o.slide_below, "height")},
          {"slide beyond", quantity(std::isfinite(o.slide_beyond) ? Json(o.slide_beyond) : Json(), "mm")},
          {"largest distance of control points", quantity(o.max_distance, "mm")},
          {"compliance of control points", quantity(o.compliance, "mm/mN")},
          {"radius of control points", quantity(o.control_radius, "mm")}};
}

/// All that is computed, before it is written.
struct Story
{
  Mesh mesh;
  std::vector<Control_point> points;
  Shift before, after; // the resection
  mm3::Resection_3 resection;
  Mesh remaining;
  std::vector<mm3::Vertex_index> remaining_vertices; // their numbers in `mesh`

  bool is_resected() const { return resection.status == mm3::Resection_status::SUCCESS; }
  const Shift& last() const { return is_resected() ? after : before; }
};

void check(const CGAL::Linear_elasticity_result_3& result, const Options& o,
           const std::vector<Control_point>& points)
{
  if(!result.is_success())
    refuse(result, o, points);
}

std::vector<Vector> displacements_of(const std::vector<Control_point>& points)
{
  std::vector<Vector> displacements;
  for(const Control_point& point : points)
    displacements.push_back(point.displacement);
  return displacements;
}

void set_control_points(Elasticity& elasticity, const Options& o, const std::vector<Control_point>& points)
{
  std::vector<Vector> positions;
  for(const Control_point& point : points)
    positions.push_back(point.position);
  check(elasticity.set_control_points(positions, o.max_distance, o.compliance, o.control_radius), o, points);
}

// What is removed, and how the rest moves then.
void resect(Elasticity& elasticity, const Options& o, const mm3::Resection_3& resection,
            const Locations& locations, Story& story, Stage_log& log, std::vector<std::string>& warnings)
{
  // Points in tissue that is removed move nothing.
  std::vector<Control_point> left;
  std::vector<bool> is_used;
  for(std::size_t i = 0; i < story.points.size(); ++i) {
    is_used.push_back(!resection.is_removed[locations[i].element]);
    if(is_used.back()) {
      left.push_back(story.points[i]);
    } else {
      warnings.push_back(o.control_points + ": line " + std::to_string(story.points[i].line)
                         + ": the control point is in tissue removed: it is not used after the resection");
    }
  }
  if(left.size() != story.points.size())
    log("control points", [&] { set_control_points(elasticity, o, left); });
  log("remove elements", [&] { check(elasticity.remove_elements(resection.is_removed), o, left); });
  log("solve after resection", [&] { check(elasticity.solve(displacements_of(left)), o, left); });
  story.after = log("checks", [&] {
    return shift_of(elasticity, story.points, locations, is_used, "shift after resection", o.is_exact(), warnings);
  });
}

mm3::Resection_3 find_resection(const Mesh& mesh, const CGAL::Polyhedral_mixed_mesh_domain_3& tumor,
                                const Options& o, std::vector<std::string>& warnings)
{
  const mm3::Resection_3 resection = mm3::resect(mesh, tumor);
  if(resection.status != mm3::Resection_status::SUCCESS)
    throw std::runtime_error(o.tumor + ": " + mm3::description(resection.status));
  if(!resection.floating.empty())
    warnings.push_back(o.tumor + ": tissue outside comes loose, and is removed: "
                       + counted(resection.floating.size(), "piece", "pieces"));
  return resection;
}

void print_summary(const Options& o, const Story& story, const Json& report)
{
  const auto ms = [&report](const std::string& stage) {
    for(const Json& cost : report["stages"])
      if(cost["stage"] == stage)
        return rounded(cost["ms"]) + " ms";
    return std::string();
  };
  std::cout << story.mesh.number_of_vertices() << " vertices, " << story.mesh.number_of_elements()
            << " elements; " << report["supports"]["fixed"] << " vertices fixed, "
            << report["supports"]["sliding"] << " sliding; "
            << counted(story.points.size(), "control point", "control points") << '\n'
            << "before surgery: factor " << ms("factor") << ", control points " << ms("control points")
            << '\n'
            << "shift: up to " << rounded(story.before.largest) << " mm; " << ms("solve") << '\n';
  if(story.is_resected())
    std::cout << "resection: " << report["resection"]["elements removed"] << " elements, "
              << rounded(double(report["resection"]["cavity volume"]) / 1000) << " ml; shift up to "
              << rounded(story.after.largest) << " mm; " << ms("remove elements") << " and "
              << ms("solve after resection") << '\n';
  if(!o.image.empty())
    std::cout << "image: " << ms("warp image") << '\n';
  for(const Json& path : report["outputs"])
    std::cout << "wrote " << std::string(path) << '\n';
}

void run(const Options& o)
{
  check_feasible(o);
  Stage_log log(!o.quiet && isatty(STDERR_FILENO));
  std::vector<std::string> warnings;
  Story story;
  Json tumor_report, image_report;

  story.points = read_control_points(o.control_points);
  story.mesh = log("read mesh", [&] { return read_mesh(o.mesh, warnings); });
  check_memory(o, story.mesh, story.points.size());
  const Locations locations =
    log("locate control points", [&] { return locate(story.mesh, o, story.points); });
  std::optional<CGAL::Polyhedral_mixed_mesh_domain_3> tumor;
  if(!o.tumor.empty())
    log("read tumor", [&] { tumor.emplace(read_surface(o.tumor, tumor_report, warnings)); });
#if MIXED_MESH_3_HAS_NIFTI
  mm3::Voxel_image_3 image;
  if(!o.image.empty())
    image = log("read image", [&] { return read_image(o, story.mesh, image_report, warnings); });
#endif
  Json report;
  report["program"] = {{"name", "brain_shift"},
                       {"version", "0.1"},
                       {"CGAL", CGAL_VERSION_STR},
                       {"Boost", BOOST_LIB_VERSION}};
  report["inputs"] = {{"mesh", describe(story.mesh, o.mesh)},
                      {"control points", {{"file", o.control_points}, {"number", story.points.size()}}},
                      {"tumor", tumor_report},
                      {"image", image_report}};
  report["parameters"] = parameters_of(o);
  report["units"] = {{"lengths", "mm"}, {"areas", "mm^2"}, {"volumes", "mm^3"}, {"forces", "mN"},
                     {"energy", "microjoule"}, {"times", "ms"}, {"heights", "height of the mesh"}};

  Elasticity elasticity(story.mesh, o.material);
  report["supports"] = set_supports(elasticity, o, story.points);
  Json controls = Json::array();
  for(std::size_t i = 0; i < story.points.size(); ++i)
    controls.push_back({{"line", story.points[i].line},
                        {"position", story.points[i].position},
                        {"displacement", story.points[i].displacement},
                        {"element", locations[i].element},
                        {"distance to the mesh", locations[i].distance}});
  report["control points"] = controls;

  // Before surgery the mesh is factored; then each measurement is a matter of milliseconds.
  log("factor", [&] { check(elasticity.factor(), o, story.points); });
  elasticity.set_gravity(o.acceleration);
  log("control points", [&] { set_control_points(elasticity, o, story.points); });
  log("solve", [&] { check(elasticity.solve(displacements_of(story.points)), o, story.points); });
  story.before = log("checks", [&] {
    return shift_of(elasticity, story.points, locations, std::vector<bool>(story.points.size(), true),
                    "shift", o.is_exact(), warnings);
  });
  report["shift"] = story.before.report;

  std::vector<bool> is_removed(story.mesh.number_of_elements(), false);
  if(tumor) {
    story.resection = log("resect", [&] { return find_resection(story.mesh, *tumor, o, warnings); });
    is_removed = story.resection.is_removed;
    resect(elasticity, o, story.resection, locations, story, log, warnings);
  }
  story.remaining = mm3::remaining_mesh(story.mesh, is_removed, &story.remaining_vertices);
  report["resection"] = tumor ? describe(story.resection, story.mesh, story.remaining) : Json();
  report["shift after resection"] = tumor ? story.after.report : Json();

  mm3::IO::Output_files files; // appear together, at the end
  const auto check_write = [](const mm3::IO::Write_error& error) {
    if(error)
      throw std::runtime_error(*error);
  };
#if MIXED_MESH_3_HAS_NIFTI
  if(!o.image.empty()) {
    mm3::Warp_options warp;
    if(tumor) {
      warp.resected_elements = is_removed;
      warp.is_resected = [&tumor](const Vector& p) {
        return tumor->bounded_side(Kernel::Point_3(p[0], p[1], p[2])) == CGAL::ON_BOUNDED_SIDE;
      };
    }
    const mm3::Warped_image_3 warped = log("warp image", [&] {
      return mm3::warp_image(image, story.mesh, story.last().displacements, warp);
    });
    const auto& mask = warped.mask.values;
    report["image"] = {{"voxels of tissue", std::count(mask.begin(), mask.end(), 1.f)},
                       {"voxels resected", std::count(mask.begin(), mask.end(), 2.f)}};
    if(!o.output_image.empty())
      log("write images", [&] {
        check_write(mm3::IO::write_warped_image(files, o.output_image + ".nii.gz", warped));
      });
  }
#endif

  log("write meshes", [&] {
    const auto flat = [](const std::vector<Vector>& vectors) {
      std::vector<double> values;
      for(const Vector& u : vectors)
        values.insert(values.end(), u.begin(), u.end());
      return values;
    };
    const std::vector<double> last = flat(story.last().displacements),
                              before = flat(story.before.displacements),
                              resected(is_removed.begin(), is_removed.end());
    mm3::IO::Write_options data;
    data.vertex_data.push_back({"displacement", &last, 3});
    if(tumor)
      data.vertex_data.push_back({"displacement_before_resection", &before, 3});
    data.element_data.push_back({"resected", &resected});
    for(const std::string& path : o.outputs)
      check_write(mm3::IO::write_mixed_mesh(files, path, story.mesh, data));

    Mesh deformed = story.remaining;
    for(std::size_t v = 0; v < deformed.number_of_vertices(); ++v) {
      const Vector& u = story.last().displacements[story.remaining_vertices[v]];
      deformed.points()[v] = deformed.points()[v] + Kernel::Vector_3(u[0], u[1], u[2]);
    }
    for(const std::string& path : o.deformed_outputs)
      check_write(mm3::IO::write_mixed_mesh(files, path, deformed));
  });

  Json outputs = Json::array();
  for(const auto& paths : {o.outputs, o.deformed_outputs, image_outputs(o)})
    for(const std::string& path : paths)
      outputs.push_back(path);
  if(!o.report.empty())
    outputs.push_back(o.report);
  report["outputs"] = outputs;
  report["warnings"] = warnings;
  report["stages"] = costs_of(log);
  report["ms"] = 1000 * log.seconds();
  report["peak memory MiB"] = double(log.peak_bytes()) / (1 << 20);
  if(!o.report.empty())
    check_write(files.write(o.report, [&](std::ostream& stream) {
      // file names need not be UTF-8
      return bool(stream << report.dump(2, ' ', false, Json::error_handler_t::replace) << '\n');
    }));
  check_write(files.commit());
  log.finish_progress();
  for(const std::string& warning : warnings)
    std::cerr << "warning: " << warning << '\n';
  if(!o.quiet)
    print_summary(o, story, report);
}

int main(int argc, char** argv)
{
  Options options;
  CLI::App app("Computes how a brain shifts from the displacements of some points, before and after a tumor "
               "is resected, and deforms the image with it. Linear elasticity, small strain.");
  set_up(app, options);
  try {
    app.parse(argc, argv);
    check_use(options);
  } catch(const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }
  const auto fail = [](const std::string& what) {
    std::cerr << "brain_shift: error: " << what << '\n';
    return 1;
  };
  try {
    run(options);
    return 0;
  } catch(const std::bad_alloc&) {
    return fail("out of memory");
  } catch(const std::exception& e) {
    return fail(e.what());
  }
}
