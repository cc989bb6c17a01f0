// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Warnings on a mesh for the user, or the reason why there is no mesh.

#ifndef MIXED_MESH_3_APPS_MIXED_MESH_3_VERDICT_H
#define MIXED_MESH_3_APPS_MIXED_MESH_3_VERDICT_H

#include "mixed_mesh_3/meshing_options.h"
#include "mixed_mesh_3/outcome.h"

#include <cstddef>
#include <stdexcept>
#include <vector>

/// The mesh failed a check: a defect of the program, not of the input.
struct Invalid_mesh : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// Throws if there is no mesh.
void refuse(const CGAL::Mixed_mesh_result_3& result, const Meshing_options& options);

/// \param self_intersections number of pairs of faces of the boundary; 0 if these were not searched for
/// \throw Invalid_mesh if a check does not hold
void require_all(const std::vector<Check>& checks, std::size_t self_intersections);

/// Throws if a fitted mesh does not represent the surface: with less than half its volume, or half more.
void require_volume(const Meshing_options& options, const Outcome& outcome);

/// Adds warnings on a valid mesh for the user.
void add_warnings(const Meshing_options& options, Outcome& outcome);

#endif // MIXED_MESH_3_APPS_MIXED_MESH_3_VERDICT_H
