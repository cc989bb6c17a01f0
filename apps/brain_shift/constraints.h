// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Linear equations for displacements, solved for one displacement each.

#ifndef MIXED_MESH_3_APPS_BRAIN_SHIFT_CONSTRAINTS_H
#define MIXED_MESH_3_APPS_BRAIN_SHIFT_CONSTRAINTS_H

#include "brain_shift/outcome.h"

#include <CGAL/Mixed_mesh_3/IO/FEB_model.h>
#include <CGAL/Mixed_mesh_3/Index.h>

#include <vector>

/// Supports and control points in the form of FEBio.
struct Explicit_constraints
{
  std::vector<CGAL::Mixed_meshes_3::Vertex_index> fixed_vertices;
  std::vector<CGAL::Mixed_meshes_3::IO::FEB_constraint> supports, controls;
};

/// Solves the equations for displacements: Gauss-Jordan elimination, in each equation of the displacement
/// with the largest factor. Equations that follow from others are left out. No equation contradicts the
/// others: otherwise there would have been no solution.
/// \par Complexity
/// Nearly linear, if few equations have displacements in common
Explicit_constraints solve_for_displacements(const Motion_constraints& constraints);

#endif // MIXED_MESH_3_APPS_BRAIN_SHIFT_CONSTRAINTS_H
