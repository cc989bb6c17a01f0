// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The library Mixed_mesh_3_compiled: the method but for the optimization.

#include <CGAL/Mixed_mesh_3/internal/meshing/mesh_domain_impl.h>

#ifndef CGAL_MIXED_MESH_3_COMPILED
#error "build this file with CGAL_MIXED_MESH_3_COMPILED defined"
#endif
