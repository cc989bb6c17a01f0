// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces from files.

#ifndef MIXED_MESH_3_APPS_CORE_READ_SURFACE_H
#define MIXED_MESH_3_APPS_CORE_READ_SURFACE_H

#include "core/facts.h"
#include "core/types.h"

#include <CGAL/Mixed_mesh_image_3/IO/Read_anatomical_surface_options.h>
#include <CGAL/Surface_mesh.h>

#include <string>
#include <vector>

using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

/// Reads a closed surface. \param warnings lines; repairs are appended
/// \throw std::runtime_error a line naming the file and the defect
Surface read_surface(const std::string& path,
                     const CGAL::Mixed_meshes_3::IO::Read_anatomical_surface_options& options,
                     Surface_facts& facts, std::vector<std::string>& warnings);

/// Reads a surface that need not be closed; without a volume.
Surface read_sheet(const std::string& path,
                   const CGAL::Mixed_meshes_3::IO::Read_anatomical_surface_options& options,
                   Surface_facts& facts, std::vector<std::string>& warnings);

#endif // MIXED_MESH_3_APPS_CORE_READ_SURFACE_H
