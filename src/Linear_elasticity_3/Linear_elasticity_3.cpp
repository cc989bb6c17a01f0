// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The library Linear_elasticity_3_compiled: the method of elasticity, for any mesh and solver.

#include <CGAL/Linear_elasticity_3/internal/Elasticity_model_impl.h>

#ifndef CGAL_LINEAR_ELASTICITY_3_COMPILED
#error "build this file with CGAL_LINEAR_ELASTICITY_3_COMPILED defined"
#endif
