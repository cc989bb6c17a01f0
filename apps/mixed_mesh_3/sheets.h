// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sheets inside the domain, such as the falx, and their faces in the mesh.

#ifndef MIXED_MESH_3_APPS_MIXED_MESH_3_SHEETS_H
#define MIXED_MESH_3_APPS_MIXED_MESH_3_SHEETS_H

#include "core/facts.h"
#include "core/types.h"
#include "mixed_mesh_3/meshing_options.h"
#include "mixed_mesh_3/outcome.h"

#include <CGAL/Labeled_polyhedral_mixed_mesh_domain_3.h>
#include <CGAL/Mixed_mesh_3/IO/Facet_set.h>

#include <memory>
#include <string>
#include <vector>

/// A surface that need not enclose anything.
struct Sheet
{
  std::string name;
  std::shared_ptr<const CGAL::Mixed_mesh_sheet_3> surface;
  Surface_facts facts;
};

/// Reads the sheets of the options, and adds the sheets to the domain.
std::vector<Sheet> add_sheets(const Input_options& options,
                              CGAL::Labeled_polyhedral_mixed_mesh_domain_3& domain,
                              std::vector<std::string>& warnings);

/// Examines faces, areas and vertices of each sheet, with warnings for defects. If the options say so, the
/// mesh is then slit along the sheets.
/// \return the faces of each sheet; for a slit, both sides, `NAME_front` and `NAME_behind`
std::vector<CGAL::Mixed_meshes_3::IO::Facet_set>
examine_sheets(Mesh& mesh, const CGAL::Labeled_polyhedral_mixed_mesh_domain_3& domain,
               const std::vector<Sheet>& sheets, const Meshing_options& options, Outcome& outcome);

#endif // MIXED_MESH_3_APPS_MIXED_MESH_3_SHEETS_H
