// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Run of the program, from the options to the files.

#ifndef MIXED_MESH_3_APPS_BRAIN_SHIFT_RUN_H
#define MIXED_MESH_3_APPS_BRAIN_SHIFT_RUN_H

#include "brain_shift/options.h"

/// Runs the program. \throw std::runtime_error in a line, the defect of the input, or of a file
void run(const Options& options);

#endif // MIXED_MESH_3_APPS_BRAIN_SHIFT_RUN_H
