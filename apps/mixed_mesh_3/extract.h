// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The subdomains that are written, if the user wants only some of them.

#ifndef MIXED_MESH_3_APPS_MIXED_MESH_3_EXTRACT_H
#define MIXED_MESH_3_APPS_MIXED_MESH_3_EXTRACT_H

#include "core/types.h"
#include "mixed_mesh_3/outcome.h"
#include "mixed_mesh_3/subdomains.h"

#include <CGAL/Mixed_mesh_3/IO/Facet_set.h>

#include <string>
#include <vector>

/// Checks, before there is a mesh, that there are subdomains of the names that the user gave.
/// \throw std::runtime_error if there is none of a name
void check_names_to_extract(const std::vector<std::string>& names, const std::vector<Subdomain>& subdomains);

/// Reduces a mesh, and facet sets of it, to the subdomains of some names, if there are any; facets that two
/// elements have in common stay as long as one of the two does.
/// \param order order of the elements in files
/// \param budget the option of the budget, with its value
/// \throw std::runtime_error if the mesh has no element of one of them
void extract(const std::vector<std::string>& names, int order, const std::string& budget,
             const std::vector<Subdomain>& subdomains, Mesh& mesh,
             std::vector<CGAL::Mixed_meshes_3::IO::Facet_set>& facet_sets, Outcome& outcome);

#endif // MIXED_MESH_3_APPS_MIXED_MESH_3_EXTRACT_H
