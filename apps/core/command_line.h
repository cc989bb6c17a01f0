// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Options that both programs have in common.

#ifndef MIXED_MESH_3_APPS_CORE_COMMAND_LINE_H
#define MIXED_MESH_3_APPS_CORE_COMMAND_LINE_H

#include <CGAL/Mixed_mesh_image_3/IO/Read_anatomical_surface_options.h>

#include <CLI/CLI.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

/// Accepts numbers for which `is_valid` holds, NaN never.
CLI::Validator number(const std::string& wanted, const std::function<bool(double)>& is_valid);

/// Accepts whole numbers from 1 on, written without a fraction or an exponent.
CLI::Validator count(std::size_t largest);

/// The command line, as a shell takes it.
std::string command_of(const char* name, int argc, const char* const* argv);

/// Accepts Poisson's ratios: the difference of larger ones from 1/2 is lost in rounding errors.
CLI::Validator poisson_ratio();
/// Adds the options of programs that read surfaces: --space, and the treatment of surfaces that enclose no
/// solid.
void add_surface_options(CLI::App& app, CGAL::Mixed_meshes_3::IO::Read_anatomical_surface_options& options);

/// Parses, then calls `check`, which throws a `CLI::ParseError` for wrong use that the parser does not
/// detect. The defect becomes one line, as does a `std::runtime_error` of a file that an option reads.
/// Returns the exit status if the program ends there: help, the version, wrong use, or a file with a defect.
std::optional<int> parse(const char* name, CLI::App& app, int argc, char** argv,
                         const std::function<void()>& check);

#endif // MIXED_MESH_3_APPS_CORE_COMMAND_LINE_H
