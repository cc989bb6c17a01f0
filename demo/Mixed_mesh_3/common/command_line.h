// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the programs for the command line have in common: checks of options, memory, numbers in messages.

#ifndef MIXED_MESH_3_EXAMPLES_COMMAND_LINE_H
#define MIXED_MESH_3_EXAMPLES_COMMAND_LINE_H

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <functional>
#include <iomanip>
#include <limits>
#include <sstream>
#include <string>

#include <unistd.h>

// Accepts numbers for which `is_valid` holds, NaN never.
inline CLI::Validator number(const std::string& wanted, const std::function<bool(double)>& is_valid)
{
  return CLI::Validator(
    [=](const std::string& text) {
      double x;
      return CLI::detail::lexical_cast(text, x) && is_valid(x) && std::isfinite(x)
               ? std::string() : "expected a number " + wanted + ", not " + text;
    },
    "");
}

// A number as a message shows it.
inline std::string rounded(double x)
{
  std::ostringstream text;
  text << std::setprecision(3) << x;
  return text.str();
}

// Physical memory, or the limit of the control group if that is less. Unknown: infinite.
inline double available_memory()
{
  const double pages = double(sysconf(_SC_PHYS_PAGES)), page = double(sysconf(_SC_PAGE_SIZE));
  double bytes = pages > 0 && page > 0 ? pages * page : std::numeric_limits<double>::infinity(), limit;
  if(std::ifstream("/sys/fs/cgroup/memory.max") >> limit && limit > 0)
    bytes = (std::min)(bytes, limit);
  return bytes;
}

// Rounded up.
inline std::string gibibytes(double bytes) { return std::to_string(std::size_t(bytes / (1 << 30)) + 1); }

#endif // MIXED_MESH_3_EXAMPLES_COMMAND_LINE_H
