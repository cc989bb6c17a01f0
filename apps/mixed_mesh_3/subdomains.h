// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Parts of the domain that have labels of their own, and their elements in the mesh.

#ifndef MIXED_MESH_3_APPS_MIXED_MESH_3_SUBDOMAINS_H
#define MIXED_MESH_3_APPS_MIXED_MESH_3_SUBDOMAINS_H

#include "core/read_surface.h"
#include "core/types.h"
#include "mixed_mesh_3/meshing_options.h"
#include "mixed_mesh_3/outcome.h"

#include <CGAL/Labeled_polyhedral_mixed_mesh_domain_3.h>
#include <CGAL/Mixed_mesh_3/IO/Facet_set.h>
#include <CGAL/Polyhedral_mixed_mesh_domain_3.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

/// A surface around a part of the domain; where several overlap, earlier ones count.
struct Subdomain
{
  std::string name;
  CGAL::Mixed_meshes_3::Subdomain_index index; // 0: a cavity
  std::shared_ptr<const Surface> surface;
  Surface_facts facts;
  std::optional<double> volume; // volume of the voxels of a label, if known
  std::string voxels;           // which ones, in words; empty for a surface from a file
  // The volume without subdomains that are inside, where the surfaces of no two cross, and the area of the
  // surfaces around it.
  std::optional<double> visible_volume = {};
  double visible_area = 0;
  std::shared_ptr<const CGAL::Polyhedral_mixed_mesh_domain_3> solid = {}; // of several surfaces, each
};

/// The name of what is around all subdomains, which no subdomain has.
inline constexpr const char* outside = "outside";

/// The name of a subdomain, or of what is outside.
std::string name_of(const std::vector<Subdomain>& subdomains, CGAL::Mixed_meshes_3::Subdomain_index index);

/// \param subdomains surfaces; where some overlap, the first one counts
CGAL::Labeled_polyhedral_mixed_mesh_domain_3 make_domain(const std::vector<Subdomain>& subdomains);

/// Builds the search trees of several surfaces that have none; the functions below and the domain share them.
void build_solids(std::vector<Subdomain>& subdomains);

/// Lets a subdomain that is inside another one come before it, so that a point is in the innermost one around
/// it; where surfaces cross, the order stays, with a warning. Cavities stay where they are.
void order_by_nesting(std::vector<Subdomain>& subdomains, std::vector<std::string>& warnings);

/// Sets the volumes and areas of the visible parts of several subdomains, which come after those inside them.
void measure_visible_parts(std::vector<Subdomain>& subdomains);

/// Examines volumes, quality and interfaces of subdomains that the user has named, with warnings for defects;
/// and sets a status for parts that the mesh does not have. Those lost before come last.
void examine_subdomains(const Mesh& mesh, const CGAL::Labeled_polyhedral_mixed_mesh_domain_3& domain,
                        const std::vector<Subdomain>& subdomains, const Meshing_options& options,
                        Outcome& outcome);

/// The interfaces between two subdomains, such as `interface_tumor_brain`; with several subdomains, also the
/// boundary of each subdomain, such as `outside_brain`.
std::vector<CGAL::Mixed_meshes_3::IO::Facet_set> interfaces_of(const Mesh& mesh,
                                                               const std::vector<Subdomain>& subdomains);

#endif // MIXED_MESH_3_APPS_MIXED_MESH_3_SUBDOMAINS_H
