// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Adaptation of the mesh to the loads that the opening of the skull may cause, by --adapt.

#ifndef MIXED_MESH_3_APPS_BRAIN_SHIFT_ADAPT_H
#define MIXED_MESH_3_APPS_BRAIN_SHIFT_ADAPT_H

#include "brain_shift/outcome.h"
#include "brain_shift/patches.h"
#include "brain_shift/supports.h"
#include "core/types.h"

#include <string>

/// Moves inner vertices of the mesh. The loads are unit bumps of the boundary around the control points, in
/// the direction of its normal and in two tangential ones; vertices that the run supports in any way are
/// fixed.
/// \param radius radius over which control points are averaged
/// \throw std::runtime_error if there are no loads for the adaptation
void adapt(Mesh& mesh, const std::string& mesh_file, const Boundary_patches& patches,
           const Support_options& options, double radius, Outcome& outcome);

#endif // MIXED_MESH_3_APPS_BRAIN_SHIFT_ADAPT_H
