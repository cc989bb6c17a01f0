// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How the report names what the library returns.

#ifndef MIXED_MESH_3_DEMO_MIXED_MESH_3_STATUS_NAMES_H
#define MIXED_MESH_3_DEMO_MIXED_MESH_3_STATUS_NAMES_H

#include <CGAL/Mixed_mesh_fit_result_3.h>
#include <CGAL/Mixed_mesh_result_3.h>

inline const char* name_of(CGAL::Mixed_mesh_status status)
{
  using Status = CGAL::Mixed_mesh_status;
  switch(status) {
  case Status::SUCCESS: return "success";
  case Status::BUDGET_NOT_FILLED: return "budget not filled";
  case Status::TOLERANCE_NOT_REACHED: return "tolerance not reached";
  case Status::NOT_ALL_ARRIVED: return "not all arrived";
  case Status::PARTS_LOST: return "parts lost";
  case Status::BUDGET_TOO_SMALL: return "budget too small";
  case Status::EMPTY: return "empty";
  case Status::REGION_NOT_MET: return "region not met";
  case Status::BOUNDARY_NOT_MANIFOLD: return "boundary not manifold";
  case Status::STOPPED: return "stopped";
  }
  return "";
}

inline const char* name_of(CGAL::Mixed_mesh_fit_status status)
{
  using Status = CGAL::Mixed_mesh_fit_status;
  switch(status) {
  case Status::SUCCESS: return "success";
  case Status::CAP_REACHED: return "cap reached";
  case Status::NOT_ALL_ARRIVED: return "not all arrived";
  case Status::SOLVER_FAILED: return "solver failed";
  case Status::STOPPED: return "stopped";
  case Status::INVALID_MESH: return "invalid mesh";
  case Status::EMPTY: return "empty";
  }
  return "";
}

inline const char* name_of(CGAL::Mixed_mesh_optimization_status status)
{
  using Status = CGAL::Mixed_mesh_optimization_status;
  switch(status) {
  case Status::SUCCESS: return "success";
  case Status::TOLERANCE_NOT_REACHED: return "tolerance not reached";
  case Status::NOT_ALL_ARRIVED: return "not all arrived";
  case Status::STOPPED: return "stopped";
  case Status::INVALID_MESH: return "invalid mesh";
  case Status::EMPTY: return "empty";
  }
  return "";
}

#endif // MIXED_MESH_3_DEMO_MIXED_MESH_3_STATUS_NAMES_H
