// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The simulation as a model of FEBio.

#ifndef MIXED_MESH_3_APPS_BRAIN_SHIFT_FEBIO_H
#define MIXED_MESH_3_APPS_BRAIN_SHIFT_FEBIO_H

#include "brain_shift/outcome.h"
#include "brain_shift/resection.h"
#include "brain_shift/simulate.h"

#include <CGAL/Mixed_mesh_3/IO/Facet_set.h>
#include <CGAL/Mixed_mesh_3/IO/Subdomain_names.h>
#include <CGAL/Mixed_mesh_3/IO/write_mixed_mesh.h>

#include <string>
#include <vector>

/// Writes the last simulation: the one after the resection, if there is one.
/// \param remaining mesh of the simulation
/// \param facet_sets facet sets of that mesh
/// \throw std::runtime_error a line naming the file and the error
void write_febio(CGAL::Mixed_meshes_3::IO::Output_files& files, const std::string& path,
                 const Remaining_mesh& remaining, std::vector<CGAL::Mixed_meshes_3::IO::Facet_set> facet_sets,
                 const CGAL::Mixed_meshes_3::IO::Subdomain_names& subdomain_names,
                 const Model_options& options, const Outcome& outcome);

#endif // MIXED_MESH_3_APPS_BRAIN_SHIFT_FEBIO_H
