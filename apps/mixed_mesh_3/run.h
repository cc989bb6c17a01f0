// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Run of the mesher, from the options to the files.

#ifndef MIXED_MESH_3_APPS_MIXED_MESH_3_RUN_H
#define MIXED_MESH_3_APPS_MIXED_MESH_3_RUN_H

#include "mixed_mesh_3/options.h"

/// Runs the mesher. \throw Invalid_mesh if the mesh failed a check; nothing is written then
/// \throw std::runtime_error in a line, the defect of the input, or of a file
/// \return whether the run was completed, without being stopped
bool run(Options options);

#endif // MIXED_MESH_3_APPS_MIXED_MESH_3_RUN_H
