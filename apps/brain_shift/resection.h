// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The tumor, and the mesh without it.

#ifndef MIXED_MESH_3_APPS_BRAIN_SHIFT_RESECTION_H
#define MIXED_MESH_3_APPS_BRAIN_SHIFT_RESECTION_H

#include "brain_shift/outcome.h"
#include "core/Closed_surface.h"
#include "core/types.h"

#include <CGAL/Mixed_mesh_3/Element_attributes.h>
#include <CGAL/Mixed_mesh_image_3/IO/Read_anatomical_surface_options.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

/// Reads a closed surface, and checks that it is where the mesh is.
std::unique_ptr<const Closed_surface>
read_beside_mesh(const std::string& path,
                 const CGAL::Mixed_meshes_3::IO::Read_anatomical_surface_options& options, const Mesh& mesh,
                 const std::string& mesh_file, Surface_facts& facts, std::vector<std::string>& warnings);

/// The resected tissue: the inside of a surface, or a subdomain, or nothing.
struct Tumor
{
  std::unique_ptr<const Closed_surface> surface; // null without a surface
  std::optional<CGAL::Mixed_meshes_3::Subdomain_index> subdomain;
  std::string name; // for messages

  bool is_given() const { return surface != nullptr || subdomain; }
};

/// The elements that are removed with the tumor, true for each.
/// \throw std::runtime_error if no element is left to compute with
std::vector<bool> resect(const Mesh& mesh, const Tumor& tumor, Outcome& outcome);

/// The mesh that is left.
struct Remaining_mesh
{
  Mesh mesh;
  std::vector<Mesh::Vertex_index> vertices; // former numbers of the vertices
};

/// The mesh that is left; also noted in `outcome`, if there was a resection.
Remaining_mesh remaining_mesh(const Mesh& mesh, const std::vector<bool>& is_removed, Outcome& outcome);

#endif // MIXED_MESH_3_APPS_BRAIN_SHIFT_RESECTION_H
