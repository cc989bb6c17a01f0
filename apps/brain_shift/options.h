// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The options of the program.

#ifndef MIXED_MESH_3_APPS_BRAIN_SHIFT_OPTIONS_H
#define MIXED_MESH_3_APPS_BRAIN_SHIFT_OPTIONS_H

#include "brain_shift/images.h"
#include "brain_shift/patches.h"
#include "brain_shift/simulate.h"
#include "brain_shift/subdomains.h"

#include <CGAL/Mixed_mesh_3/Elastic_material.h>
#include <CGAL/Mixed_mesh_image_3/IO/Read_anatomical_surface_options.h>

#include <optional>
#include <string>
#include <vector>

/// The options of each stage, and those of the program itself.
struct Options
{
  Model_options model;
  Patch_options patches;
  Image_options images;
  CGAL::Mixed_meshes_3::IO::Read_anatomical_surface_options surface_options;
  CGAL::Mixed_meshes_3::Elastic_material material; // material of subdomains without one of their own
  std::vector<Labeled_material> materials;
  std::string tumor, tumor_label, report, page, febio, command;
  std::vector<std::string> outputs, deformed_outputs;
  double density = 1.04; // g/cm^3
  int output_order = 1;  // order of the elements of --output
  bool adapt = false, quiet = false;
  bool uses_petsc = false; // whether PETSc is the solver

  // Texts of values above.
  std::string up = "z", gravity = "0,0,0";
  std::vector<std::string> material_texts;
};

/// Returns the exit status if the program ends with its command line: help, the version, or wrong use.
/// \param has_petsc whether the program is brain_shift_petsc, which is the same one for --solver petsc
std::optional<int> parse_command_line(int argc, char** argv, bool has_petsc, Options& options);

/// All files that are read.
std::vector<std::string> inputs_of(const Options& options);

/// All files that are written.
std::vector<std::string> outputs_of(const Options& options);

/// Whether the format has values at vertices.
bool can_hold_displacements(const std::string& path);

/// Throws if files cannot be written.
void check_feasible(const Options& options);

#endif // MIXED_MESH_3_APPS_BRAIN_SHIFT_OPTIONS_H
