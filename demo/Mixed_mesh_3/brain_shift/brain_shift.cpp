// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Brain shift on the command line: from a mesh and some points with measured displacements to the
// displacement of the whole, before and after a resection, and to the image as it looks then. Section 6.2 of
// Lobos, Bucki, Hitschfeld, Payan: "Mixed-element mesh for an intra-operative modeling of the brain tumor
// extraction". Exit status: 0 all went well; 1 bad input, or no solution for it, or a file that cannot be
// written; 2 wrong use.

#include "brain_shift/options.h"
#include "brain_shift/run.h"
#include "brain_shift/use_one_thread.h"
#include "common/messages.h"

#include <exception>
#include <iostream>
#include <new>
#include <string>

int main(int argc, char** argv)
{
  Options options;
  if(const auto status = parse_command_line(argc, argv, options))
    return *status;
  const auto fail = [](const std::string& what) {
    std::cerr << "brain_shift: error: " << printable(what) << '\n';
    return 1;
  };
  use_one_thread();
  try {
    run(options);
    return 0;
  } catch(const std::bad_alloc&) {
    return fail("out of memory");
  } catch(const std::exception& e) {
    return fail(e.what());
  }
}
