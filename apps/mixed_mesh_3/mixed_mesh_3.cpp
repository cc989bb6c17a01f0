// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The command-line mesher: makes mesh files and a report from a surface, a region of interest and a vertex
// budget. Exit status: 0 all checks hold; 1 bad input, or no mesh for the input, or a file that cannot be
// written; 2 wrong use; 3 the mesh failed a check (nothing is written); 4 stopped, the mesh so far is
// written.

#include "core/messages.h"
#include "mixed_mesh_3/options.h"
#include "mixed_mesh_3/run.h"
#include "mixed_mesh_3/verdict.h"

#include <exception>
#include <iostream>
#include <new>
#include <stdexcept>

int main(int argc, char** argv)
{
  Options options;
  if(const auto status = parse_command_line(argc, argv, options))
    return *status;
  const auto fail = [](const std::exception& e, int status) {
    std::cerr << "mixed_mesh_3: error: " << printable(e.what()) << '\n';
    return status;
  };
  try {
    return run(options) ? 0 : 4;
  } catch(const Invalid_mesh& e) {
    return fail(e, 3);
  } catch(const std::bad_alloc&) {
    return fail(std::runtime_error("out of memory; try a smaller --vertices"), 1);
  } catch(const std::exception& e) {
    return fail(e, 1);
  }
}
