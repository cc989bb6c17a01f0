// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The options of the mesher.

#ifndef MIXED_MESH_3_APPS_MIXED_MESH_3_OPTIONS_H
#define MIXED_MESH_3_APPS_MIXED_MESH_3_OPTIONS_H

#include "mixed_mesh_3/algorithm_1.h"
#include "mixed_mesh_3/meshing_options.h"
#include "mixed_mesh_3/patches.h"

#include <optional>
#include <string>
#include <vector>

/// The options of the stages, and those of the program itself.
struct Options : Meshing_options, Relaxation_options, Output_options
{
  std::string command; // the command with all options
  bool quiet = false;
};

/// Returns the exit status if the program ends with its command line: help, the version, or wrong use.
std::optional<int> parse_command_line(int argc, char** argv, Options& options);

/// The surfaces and images, and the files that are written.
std::vector<std::string> inputs_of(const Options& options);
std::vector<std::string> outputs_of(const Output_options& options);

/// Throws if files cannot be written, or if the mesh would not fit into memory.
void check_feasible(const Options& options);

#endif // MIXED_MESH_3_APPS_MIXED_MESH_3_OPTIONS_H
