// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Output of the mesher: a file for programs, and some lines for people.

#ifndef MIXED_MESH_3_APPS_MIXED_MESH_3_REPORT_H
#define MIXED_MESH_3_APPS_MIXED_MESH_3_REPORT_H

#include "core/Stage_log.h"
#include "core/report_json.h"
#include "mixed_mesh_3/options.h"
#include "mixed_mesh_3/outcome.h"

/// The report.
Json report(const Options& options, const Outcome& outcome, const Stage_log& log);

/// Prints a few lines on the standard output.
void print_summary(const Options& options, const Outcome& outcome);

#endif // MIXED_MESH_3_APPS_MIXED_MESH_3_REPORT_H
