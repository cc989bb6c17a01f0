// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The subdomains of a mesh, by their labels, for --material and --tumor-label.

#ifndef MIXED_MESH_3_APPS_BRAIN_SHIFT_SUBDOMAINS_H
#define MIXED_MESH_3_APPS_BRAIN_SHIFT_SUBDOMAINS_H

#include "brain_shift/outcome.h"
#include "core/types.h"

#include <CGAL/Mixed_mesh_3/Elastic_material.h>
#include <CGAL/Mixed_mesh_3/IO/Subdomain_names.h>

#include <string>
#include <vector>

/// A material, and the label of its subdomain as given on the command line.
struct Labeled_material
{
  std::string label;
  CGAL::Mixed_meshes_3::Elastic_material material;
};

/// The subdomains of the mesh with their materials, in the order of their indices.
/// \param material material of subdomains without one of their own
/// \throw std::runtime_error if the mesh lacks a label of --material, or if a label has two materials
std::vector<Subdomain_facts> find_subdomains(const Mesh& mesh, const std::string& mesh_file,
                                             const CGAL::Mixed_meshes_3::IO::Subdomain_names& names,
                                             const CGAL::Mixed_meshes_3::Elastic_material& material,
                                             const std::vector<Labeled_material>& materials);

/// The subdomain with a label of the command line.
/// \throw std::runtime_error if there is no such subdomain
const Subdomain_facts& find_subdomain(const std::vector<Subdomain_facts>& subdomains,
                                      const std::string& label, const std::string& mesh_file);

/// The material of each element.
std::vector<CGAL::Mixed_meshes_3::Elastic_material>
materials_of_elements(const Mesh& mesh, const std::vector<Subdomain_facts>& subdomains);

#endif // MIXED_MESH_3_APPS_BRAIN_SHIFT_SUBDOMAINS_H
