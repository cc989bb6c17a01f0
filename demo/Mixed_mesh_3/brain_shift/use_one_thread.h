// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef MIXED_MESH_3_DEMO_BRAIN_SHIFT_USE_ONE_THREAD_H
#define MIXED_MESH_3_DEMO_BRAIN_SHIFT_USE_ONE_THREAD_H

/// Makes the BLAS that CHOLMOD uses, and OpenMP, use one thread, whatever the environment says: several may
/// add up in another order, and results differ in their last digits.
void use_one_thread();

#endif // MIXED_MESH_3_DEMO_BRAIN_SHIFT_USE_ONE_THREAD_H
