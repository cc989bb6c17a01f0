// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Errors of the model's prediction of landmarks.

#ifndef MIXED_MESH_3_APPS_BRAIN_SHIFT_LANDMARK_MODEL_H
#define MIXED_MESH_3_APPS_BRAIN_SHIFT_LANDMARK_MODEL_H

#include "brain_shift/outcome.h"
#include "brain_shift/solve.h"

/// Moves the mesh by the outermost landmarks, and measures the errors at the other landmarks. The
/// factorization stays: each given landmark takes three solutions of the system. Other control points have to
/// be set again.
/// \param landmarks all landmarks, as control points
/// \pre the system is factored, and loads are set
void measure_by_outermost(Elasticity& elasticity, const Controls& landmarks, Outcome& outcome);

/// Measures the error at each landmark when it is left out, without solving a system.
/// \pre the mesh was moved by all landmarks; `measure_by_outermost()` was called before
void measure_left_out(const Elasticity& elasticity, Outcome& outcome);

/// Measures the errors at the landmarks after the shift by control points that are not landmarks.
void measure_shift(const Elasticity& elasticity, Outcome& outcome);

#endif // MIXED_MESH_3_APPS_BRAIN_SHIFT_LANDMARK_MODEL_H
