// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files that appear together, when all of them are complete; a failure is an exception.

#ifndef MIXED_MESH_3_APPS_CORE_WRITE_FILES_H
#define MIXED_MESH_3_APPS_CORE_WRITE_FILES_H

#include "core/types.h"

#include <CGAL/Mixed_mesh_3/IO/write_mixed_mesh.h>

#include <string>

void write_mesh(CGAL::Mixed_meshes_3::IO::Output_files& files, const std::string& path, const Mesh& mesh,
                const CGAL::Mixed_meshes_3::IO::Write_options& options = {});

void write_text(CGAL::Mixed_meshes_3::IO::Output_files& files, const std::string& path,
                const std::string& text);

#endif // MIXED_MESH_3_APPS_CORE_WRITE_FILES_H
