// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Input of meshes that are valid for computations.

#ifndef MIXED_MESH_3_APPS_BRAIN_SHIFT_READ_MESH_H
#define MIXED_MESH_3_APPS_BRAIN_SHIFT_READ_MESH_H

#include "core/types.h"

#include <CGAL/Mixed_mesh_3/IO/Subdomain_names.h>

#include <string>
#include <vector>

/// Reads a mesh. \param warnings lines; a line is appended for each harmless defect
/// \throw std::runtime_error a line naming the file and the defect
Mesh read_mesh(const std::string& path, CGAL::Mixed_meshes_3::IO::Subdomain_names& subdomain_names,
               std::vector<std::string>& warnings);

#endif // MIXED_MESH_3_APPS_BRAIN_SHIFT_READ_MESH_H
