// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where CGAL::data_file_path() looks when a tutorial starts.

#include <cstdlib>

[[maybe_unused]] static const int is_set = setenv("CGAL_DATA_DIR", MIXED_MESH_3_DATA_DIR, 1);
