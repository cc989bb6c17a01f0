// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Patches of the boundary that the user names, where boundary conditions hold.

#ifndef MIXED_MESH_3_APPS_MIXED_MESH_3_PATCHES_H
#define MIXED_MESH_3_APPS_MIXED_MESH_3_PATCHES_H

#include "core/boundary_patches.h"
#include "mixed_mesh_3/meshing_options.h"
#include "mixed_mesh_3/outcome.h"
#include "mixed_mesh_3/subdomains.h"

#include <CGAL/Mixed_mesh_3/IO/Facet_set.h>

#include <string>
#include <vector>

/// A patch of the boundary: a shape such as "sphere:0,0,0,5", or a file of a closed surface.
struct Patch_option
{
  std::string name, place;

  /// The option, with its value.
  std::string text() const { return "--patch " + name + '=' + place; }
};

/// The files that are written, and what is in them.
struct Output_options
{
  std::vector<std::string> outputs; // meshes
  std::string report, page;
  std::vector<Patch_option> patches;
  std::vector<std::string> extract; // names of the subdomains that are written; empty: all
  bool msh2 = false;
};

/// A patch, and the test whether the center of a face is inside.
struct Patch
{
  Patch_option option;
  Patch_test contains;
};

/// Reads the patches of the options.
/// \throw std::runtime_error if a surface cannot be read, if a name is that of another set of the files, or
/// if faces are certain to be in two sets of a file that has one for each face
std::vector<Patch> read_patches(const Input_options& inputs, const Output_options& outputs,
                                const std::vector<Subdomain>& subdomains, std::vector<std::string>& warnings);

/// Finds the boundary faces of each patch.
/// \throw std::runtime_error if a patch has no face
std::vector<CGAL::Mixed_meshes_3::IO::Facet_set>
examine_patches(const Mesh& mesh, const std::vector<Patch>& patches, Outcome& outcome);

#endif // MIXED_MESH_3_APPS_MIXED_MESH_3_PATCHES_H
