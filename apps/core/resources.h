// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Checks before long computations: files that cannot be written, or data that do not fit into memory.

#ifndef MIXED_MESH_3_APPS_CORE_RESOURCES_H
#define MIXED_MESH_3_APPS_CORE_RESOURCES_H

#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/// The files that a program has to write, each of them once, and none of them an input.
class Output_paths
{
public:
  explicit Output_paths(std::vector<std::string> inputs) : m_inputs(std::move(inputs)) {}

  /// \throw std::runtime_error if the file is an input, or an output that was added before
  void add(const std::string& path);

private:
  std::vector<std::string> m_inputs;
  std::set<std::string> m_outputs;
};

/// Calls `io(&error)`, a function of the library that reads or writes, and throws the error.
template <class Io>
void require(const Io& io)
{
  std::string error;
  if(!io(&error))
    throw std::runtime_error(error);
}

/// A number of bytes, rounded up, as in "2 GiB".
std::string gibibytes(double bytes);

/// Throws if `needed` bytes are more than available: physical memory, or the limit of the control group if
/// that is less.
/// \param what beginning of the message: the object that needs the bytes
void check_memory(const std::string& what, double needed);

#endif // MIXED_MESH_3_APPS_CORE_RESOURCES_H
