// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A page for a browser, in one file that needs no network: the mesh to turn and to cut open, and what
// the report says.

#ifndef MIXED_MESH_3_DEMO_PAGE_PAGE_H
#define MIXED_MESH_3_DEMO_PAGE_PAGE_H

#include "common/report_json.h"
#include "common/types.h"

#include <CGAL/Mixed_mesh_3/IO/Subdomain_names.h>

#include <string>
#include <vector>

/// What a page shows besides mesh and report.
struct Page_data
{
  /// A state that the mesh can be deformed to.
  struct Step
  {
    std::string name;
    std::vector<double> displacements; // x, y, z of each vertex
    std::vector<bool> is_removed = {}; // each element; empty: none
  };

  std::string command;
  CGAL::Mixed_meshes_3::IO::Subdomain_names subdomain_names = {};
  /// Whether the coordinates are known to be to the right, anterior and superior, in mm. If not, the page
  /// says that it takes them to be.
  bool is_in_patient_space = false;
  std::vector<Step> steps = {};
};

/// The text of the page. What differs from run to run, times and memory, is left out of the report, so that
/// the same command has the same bytes.
/// \param report as the program writes it
std::string page(const Mesh& mesh, const Page_data& data, Json report);

#endif // MIXED_MESH_3_DEMO_PAGE_PAGE_H
