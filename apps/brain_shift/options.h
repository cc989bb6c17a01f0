// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The options of the program.

#ifndef MIXED_MESH_3_APPS_BRAIN_SHIFT_OPTIONS_H
#define MIXED_MESH_3_APPS_BRAIN_SHIFT_OPTIONS_H

#include <CGAL/Mixed_mesh_3/Elastic_material.h>
#include <CGAL/Mixed_mesh_image_3/IO/Read_anatomical_surface_options.h>
#include <CGAL/Mixed_mesh_3/Recovered_displacement_3.h>
#include <CGAL/Mixed_mesh_image_3/IO/Field_format.h>

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

/// Names of patches: the lower part of the height, and all of the boundary.
inline constexpr const char *base_patch = "base", *skull_patch = "skull";

/// The density of 1 g/cm^3, the unit of the options.
inline constexpr double kg_per_mm3 = 1e-6;

/// The label of a patch such as "label:3"; nothing if the patch is no label.
std::optional<int> label_of(const std::string& patch);

/// A material, and the label of its subdomain as given on the command line.
struct Labeled_material
{
  std::string label;
  CGAL::Mixed_meshes_3::Elastic_material material;
};

/// Where displacements are quadratic: nowhere, everywhere, in the region of interest, or where the program
/// decides.
enum class Displacement_order { DEFAULT, LINEAR, QUADRATIC, REGION };

struct Options
{
  std::string mesh, control_points, control_points_after, landmarks, landmarks_after, tumor, tumor_label,
    image, labels, output_image, report, page, febio, command, up = "z", gravity = "0,0,0";
  std::vector<std::string> outputs, deformed_outputs, material_texts;
  double fixed_below = 0.3, slide_below = 0, slide_beyond = std::numeric_limits<double>::infinity();
  // Patches of the boundary: closed surfaces, labels, and the names below.
  std::vector<std::string> fixed_patches, sliding_patches, touching_patches, openings;
  double density = 1.04, fluid_density = 1; // g/cm^3
  double fluid_level = std::numeric_limits<double>::infinity();
  double max_distance = 5, compliance = 0, landmark_compliance = 0, control_radius = 0;
  std::size_t landmarks_given = 0; // the outermost ones; 0: the default number
  bool corotational = false, leave_one_out = false, adapt = false;
  Displacement_order order = Displacement_order::DEFAULT;
  int output_order = 1;                            // order of the elements of --output
  CGAL::Mixed_meshes_3::Elastic_material material; // material of subdomains without one of their own
  CGAL::Mixed_meshes_3::Displacement_interpolation interpolation =
    CGAL::Mixed_meshes_3::Displacement_interpolation::RECOVERED;
  std::vector<CGAL::Mixed_meshes_3::IO::Field_format> field_formats;
  CGAL::Mixed_meshes_3::IO::Read_anatomical_surface_options surface_options;
  bool quiet = false;
  bool uses_petsc = false;                   // whether PETSc is the solver
  bool are_landmarks_control_points = false; // whether there are no others

  // Values of the texts above.
  std::array<double, 3> up_direction{}, acceleration{};
  std::vector<Labeled_material> materials;

  bool has_patches() const
  {
    return !fixed_patches.empty() || !sliding_patches.empty() || !touching_patches.empty()
           || !openings.empty();
  }

  // Whether a control point itself has exactly the requested displacement.
  bool is_exact() const { return compliance == 0 && control_radius == 0; }
};

/// Returns the exit status if the program ends with its command line: help, the version, or wrong use.
/// \param has_petsc whether the program is brain_shift_petsc, which is the same one for --solver petsc
std::optional<int> parse_command_line(int argc, char** argv, bool has_petsc, Options& options);

/// The option that can only be had with linear displacements; empty if there is none.
std::string option_of_order_1(const Options& options);

/// The label image that is written.
std::string labels_output(const Options& options);

/// The images that are written.
std::vector<std::string> image_outputs(const Options& options);

/// All files that are read.
std::vector<std::string> inputs_of(const Options& options);

/// All files that are written.
std::vector<std::string> outputs_of(const Options& options);

/// Whether the format has values at vertices.
bool can_hold_displacements(const std::string& path);

/// Throws if files cannot be written.
void check_feasible(const Options& options);

#endif // MIXED_MESH_3_APPS_BRAIN_SHIFT_OPTIONS_H
