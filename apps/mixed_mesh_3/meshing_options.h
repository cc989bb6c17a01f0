// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The options that the stages of the mesher take.

#ifndef MIXED_MESH_3_APPS_MIXED_MESH_3_MESHING_OPTIONS_H
#define MIXED_MESH_3_APPS_MIXED_MESH_3_MESHING_OPTIONS_H

#include "core/read_label_surface.h"
#include "core/voxel_selection.h"

#include <CGAL/Mixed_mesh_image_3/IO/Read_anatomical_surface_options.h>
#include <CGAL/Mixed_mesh_3/options.h>
#include <CGAL/Mixed_mesh_criteria_3.h>

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

/// The way in which the boundary gets onto the surface.
enum class Fit { NONE, OPTIMIZATION, ALGORITHM_1 };

/// A closed surface of a region of interest, and the factor by which an error counts more in the region.
struct Region_option
{
  std::string file;
  double weight;
  Voxel_selection voxels = {}; // voxels of an image
};

/// A part of the domain with a label of its own.
struct Subdomain_option
{
  std::string name, file;
  Voxel_selection voxels = {}; // voxels of an image
};

/// The choice of labels that become subdomains.
enum class Label_choice { NONE, LISTS, EACH, FREESURFER };

/// Subdomains of labels that become one.
struct Merge_option
{
  std::string name;
  std::vector<std::string> parts;

  /// The option, with its value.
  std::string text() const;
};

/// A change of an image before it is meshed: voxels near a label, or those that labels enclose, get a label.
struct Layer_option
{
  std::string name;
  std::optional<double> distance; // in mm; none: holes
};

/// The surfaces and images, and how they are read.
struct Input_options
{
  std::string surface;
  std::vector<Region_option> regions;
  std::vector<Subdomain_option> subdomains;       // inside the surface; earlier ones count where they overlap
  Label_choice label_choice = Label_choice::NONE; // labels of an image instead of voxels
  std::vector<Subdomain_option> labels;           // the choice, except of each label
  std::vector<Merge_option> merges;               // of labels, in their order
  std::vector<Layer_option> label_layers;         // in their order, after merges
  Label_table label_table;
  std::vector<std::string> cavities;
  std::vector<Subdomain_option> sheets; // surfaces inside that need not enclose anything
  Voxel_selection voxels;               // voxels of an image, the domain
  Label_completion completion;          // completion of the domain
  std::optional<double> smoothing;
  CGAL::Mixed_meshes_3::IO::Read_anatomical_surface_options surface_options;
  std::size_t vertices = 2000; // surfaces of images are no finer than the mesh can follow

  /// Whether the surface's file, or the user, says that coordinates are those of the patient, in mm.
  bool is_in_patient_space() const;
};

/// The options that decide which mesh is made of the inputs.
struct Meshing_options : Input_options
{
  using Templates = CGAL::Mixed_meshes_3::Transition_templates_choice;

  bool fewest_vertices = false; // at most `vertices`, the fewest that the tolerance allows
  int base_level = CGAL::Mixed_mesh_criteria_3::automatic;
  CGAL::Mixed_meshes_3::Boundary_mode mode = CGAL::Mixed_meshes_3::Boundary_mode::VERTEX_ORDER;
  CGAL::Mixed_meshes_3::Root_cell root = CGAL::Mixed_meshes_3::Root_cell::CUBE;
  Templates templates = Templates::FEWEST_VERTICES;
  bool slit = false, best_effort = false, no_simplification = false, no_fit = false, no_optimize = false,
       tetrahedra = false;
  double tolerance = 0; // automatic
  double grading = 0.35;
  double time_limit = std::numeric_limits<double>::infinity();                          // seconds
  double largest_arc = CGAL::Mixed_mesh_optimization_criteria_3::default_quality_bound; // 0: any
  bool is_arc_strict = false;
  std::optional<double> given_sharp_angle; // degrees; 0: no sharp edges
  unsigned threads = 1;
  int order = 1;         // of the elements in files
  std::size_t nodes = 0; // budget in nodes of that order; 0: the budget is in vertices

  /// The angle of sharp edges. The surfaces of voxels are smooth: their sharp edges are noise, which is told
  /// from edges of parts by its arrangement where there is one subdomain, and not where labels have many.
  double sharp_angle() const
  {
    const bool is_smooth = is_image(surface)
                           && (label_choice != Label_choice::NONE || !subdomains.empty() || !sheets.empty());
    return given_sharp_angle.value_or(
      is_smooth ? 0 : CGAL::Mixed_mesh_optimization_criteria_3::default_sharp_angle);
  }

  /// The option of the budget, with its value.
  std::string budget() const
  {
    return nodes > 0 ? "--nodes " + std::to_string(nodes) : "--vertices " + std::to_string(vertices);
  }
  bool has_quality_bound() const { return fit() == Fit::OPTIMIZATION && largest_arc > 0; }
  Fit fit() const { return no_fit ? Fit::NONE : no_optimize ? Fit::ALGORITHM_1 : Fit::OPTIMIZATION; }
};

/// Whether a text is a name of a subdomain in files.
bool is_subdomain_name(const std::string& name);
/// The length that such a name has at most: two names are parts of the name of an interface.
inline constexpr std::size_t longest_subdomain_name = 24;

/// The name of the subdomain around all others: the name of its file, if that is a valid name.
std::string surrounding_name(const Input_options& options);

/// What is wrong with a name that is not among those of the subdomains.
std::string sentence_on_no_subdomain(const std::vector<std::string>& names);

#endif // MIXED_MESH_3_APPS_MIXED_MESH_3_MESHING_OPTIONS_H
