// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Simulation, from control points to displacements.

#ifndef MIXED_MESH_3_APPS_BRAIN_SHIFT_SIMULATE_H
#define MIXED_MESH_3_APPS_BRAIN_SHIFT_SIMULATE_H

#include "brain_shift/options.h"
#include "brain_shift/outcome.h"
#include "brain_shift/patches.h"
#include "brain_shift/resection.h"
#include "core/Stage_log.h"
#include "core/types.h"

#include <vector>

/// Computes the shift, and with a tumor its resection and the shift after it.
/// \param patches patches of the boundary
/// \return the removed elements, true for each
std::vector<bool> simulate(const Mesh& mesh, const Tumor& tumor, const Boundary_patches& patches,
                           const Options& options, Stage_log& log, Outcome& outcome);

#endif // MIXED_MESH_3_APPS_BRAIN_SHIFT_SIMULATE_H
