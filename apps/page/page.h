// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A page for a browser, in one file that needs no network: the mesh to turn and to cut open, and the content
// of the report.

#ifndef MIXED_MESH_3_APPS_PAGE_PAGE_H
#define MIXED_MESH_3_APPS_PAGE_PAGE_H

#include "core/report_json.h"
#include "core/types.h"

#include <CGAL/Mixed_mesh_3/IO/Subdomain_names.h>

#include <string>
#include <vector>

/// The content of a page besides mesh and report.
struct Page_data
{
  /// A state that the mesh can be deformed to.
  struct Step
  {
    std::string name;
    std::vector<double> displacements; // x, y, z of each vertex
    std::vector<bool> is_removed = {}; // one value for each element; empty: none
  };

  std::string command;
  CGAL::Mixed_meshes_3::IO::Subdomain_names subdomain_names = {};
  /// Whether the coordinates are known to be to the right, anterior and superior, in mm. If not, the page
  /// says that it assumes so.
  bool is_in_patient_space = false;
  std::vector<Step> steps = {};
  /// The files of the command: the page has their names, without folders, which may name a patient.
  std::vector<std::string> files = {};
};

/// The text of the page. Times and memory, which differ from run to run, are left out of the report, so that
/// the same command gives the same bytes.
/// \param report report as the program writes it
std::string page(const Mesh& mesh, const Page_data& data, Json report);

#endif // MIXED_MESH_3_APPS_PAGE_PAGE_H
