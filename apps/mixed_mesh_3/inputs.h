// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surfaces of the domain, of its subdomains and of regions, from files and images.

#ifndef MIXED_MESH_3_APPS_MIXED_MESH_3_INPUTS_H
#define MIXED_MESH_3_APPS_MIXED_MESH_3_INPUTS_H

#include "core/Stage_log.h"
#include "core/read_surface.h"
#include "mixed_mesh_3/meshing_options.h"
#include "mixed_mesh_3/outcome.h"
#include "mixed_mesh_3/subdomains.h"

#include <memory>
#include <vector>

struct Inputs
{
  std::vector<Subdomain> subdomains;
  std::shared_ptr<const Surface> boundary; // that of the subdomain, if there is only one
  std::vector<Surface> regions;
};

/// Reads all surfaces but sheets, each image once.
/// \throw std::runtime_error a line naming the file and the defect
Inputs read_inputs(const Meshing_options& options, Stage_log& log, Outcome& outcome);

#endif // MIXED_MESH_3_APPS_MIXED_MESH_3_INPUTS_H
