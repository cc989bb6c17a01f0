// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Simulation, from control points to displacements.

#ifndef MIXED_MESH_3_APPS_BRAIN_SHIFT_SIMULATE_H
#define MIXED_MESH_3_APPS_BRAIN_SHIFT_SIMULATE_H

#include "brain_shift/landmarks.h"
#include "brain_shift/locate.h"
#include "brain_shift/outcome.h"
#include "brain_shift/patches.h"
#include "brain_shift/resection.h"
#include "brain_shift/supports.h"
#include "core/Stage_log.h"
#include "core/types.h"

#include <array>
#include <limits>
#include <string>
#include <vector>

/// The density of 1 g/cm^3, the unit of the options.
inline constexpr double kg_per_mm3 = 1e-6;

/// Where displacements are quadratic: nowhere, everywhere, in the region of interest, or where the program
/// decides.
enum class Displacement_order { DEFAULT, LINEAR, QUADRATIC, REGION };

/// The mechanical model, except materials and patches.
struct Model_options
{
  std::string mesh; // file
  Point_options points;
  Landmark_options landmarks; // those without a file are none
  Support_options supports;
  std::array<double, 3> acceleration{}; // mm/s^2
  double fluid_density = 1;             // g/cm^3
  double fluid_level = std::numeric_limits<double>::infinity();
  Displacement_order order = Displacement_order::DEFAULT;
  std::string option_of_order_1; // can only be had with linear displacements; empty: there is none
  bool corotational = false, leave_one_out = false;
  bool keeps_constraints = false; // whether the outcome has those of the last shift
};

/// Computes the shift, and with a tumor its resection and the shift after it.
/// \param patches patches of the boundary
/// \return the removed elements, true for each
std::vector<bool> simulate(const Mesh& mesh, const Tumor& tumor, const Boundary_patches& patches,
                           const Model_options& options, Stage_log& log, Outcome& outcome);

#endif // MIXED_MESH_3_APPS_BRAIN_SHIFT_SIMULATE_H
