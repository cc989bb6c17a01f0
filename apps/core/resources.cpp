// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/resources.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <system_error>

#include <unistd.h>

namespace {

// The available memory; infinite if unknown.
double available_memory()
{
  const double pages = double(sysconf(_SC_PHYS_PAGES)), page = double(sysconf(_SC_PAGE_SIZE));
  double bytes = pages > 0 && page > 0 ? pages * page : std::numeric_limits<double>::infinity(), limit;
  if(std::ifstream("/sys/fs/cgroup/memory.max") >> limit && limit > 0)
    bytes = (std::min)(bytes, limit);
  return bytes;
}

} // namespace

std::string gibibytes(double bytes) { return std::to_string(std::size_t(bytes / (1 << 30)) + 1) + " GiB"; }

void Output_paths::add(const std::string& path)
{
  std::error_code ignored;
  for(const std::string& input : m_inputs)
    if(std::filesystem::equivalent(path, input, ignored))
      throw std::runtime_error(path + ": is given twice, as input and as output");
  if(!m_outputs.insert(std::filesystem::weakly_canonical(path, ignored).string()).second)
    throw std::runtime_error(path + ": is given twice as output");
}

void check_memory(const std::string& what, double needed)
{
  const double available = available_memory();
  if(needed > available)
    throw std::runtime_error(what + " would need about " + gibibytes(needed) + " of memory, of "
                             + gibibytes(available));
}
