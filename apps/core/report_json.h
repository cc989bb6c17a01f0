// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Parts that the reports of both programs have in common.

#ifndef MIXED_MESH_3_APPS_CORE_REPORT_JSON_H
#define MIXED_MESH_3_APPS_CORE_REPORT_JSON_H

#include "core/Stage_log.h"
#include "core/facts.h"

#include <CGAL/Mixed_mesh_image_3/IO/Read_anatomical_surface_options.h>

#include <nlohmann/json.hpp>

#include <string>

using Json = nlohmann::ordered_json;

/// The program and the libraries that it was built with.
Json describe_program(const char* name);

/// Adds the number of elements of each kind.
void add_kinds(const Mesh_facts& mesh, Json& report);

/// The costs of the stages.
/// \param unit unit of the times, as in their keys: `seconds` or `ms`
/// \param per_second number of units in a second
Json describe_stages(const Stage_log& log, const std::string& unit, double per_second);

double mebibytes(std::size_t bytes);

/// The text that is written to a file.
/// \param indent indent of each level; -1: all in one line
std::string text_of(const Json& report, int indent = 2);

/// The space that surfaces are read in: "RAS" or "LPS"; null if files decide.
Json space_of(const CGAL::Mixed_meshes_3::IO::Read_anatomical_surface_options& options);

#endif // MIXED_MESH_3_APPS_CORE_REPORT_JSON_H
