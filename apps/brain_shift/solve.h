// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The elastic model with control points: steps common to control points and landmarks.

#ifndef MIXED_MESH_3_APPS_BRAIN_SHIFT_SOLVE_H
#define MIXED_MESH_3_APPS_BRAIN_SHIFT_SOLVE_H

#include "brain_shift/locate.h"
#include "core/types.h"

#include <CGAL/Linear_elasticity_3.h>
#if MIXED_MESH_3_HAS_PETSC
#include <CGAL/Mixed_mesh_petsc/Petsc_solver_traits.h>
#endif

#if MIXED_MESH_3_HAS_PETSC
using Elasticity = CGAL::Linear_elasticity_3<Mesh, CGAL::Mixed_meshes_3::Petsc_solver_traits>;
#else
using Elasticity = CGAL::Linear_elasticity_3<Mesh>;
#endif

/// Throws the defect of a result, if there is one.
/// \throw std::runtime_error a line naming the file and the defect
void check(const CGAL::Linear_elasticity_result_3& result, const Controls& controls);

/// Sets the control points. \throw std::runtime_error like `check()`
void set_control_points(Elasticity& elasticity, const Controls& controls);

/// Whether the result of `Elasticity::solve()` is a solution: with finite rotations, a solution may invert
/// elements.
bool is_solution(const Elasticity& elasticity, const CGAL::Linear_elasticity_result_3& result);

/// Solves for the displacements of the control points that are set.
/// \throw std::runtime_error like `check()`
void solve(Elasticity& elasticity, const Controls& controls);

#endif // MIXED_MESH_3_APPS_BRAIN_SHIFT_SOLVE_H
