// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes surfaces as a user of the library does, with default criteria, for test_drivers.py.
//
//   mesh_surface VERTICES FOLDER SURFACE...    writes FOLDER/NAME.vtu, and prints "NAME: status"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Mixed_mesh_3/IO/write_mixed_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/make_mixed_mesh_3.h>

#include <filesystem>
#include <iostream>
#include <string>

namespace mm3 = CGAL::Mixed_meshes_3;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

int main(int argc, char* argv[])
{
  const std::filesystem::path folder = argv[2];
  for(int i = 3; i < argc; ++i) {
    CGAL::Surface_mesh<Kernel::Point_3> surface;
    std::string error;
    if(!mm3::IO::read_closed_surface(argv[i], surface, &error)) {
      std::cerr << error << '\n';
      return 1;
    }
    CGAL::Mixed_mesh_3<Kernel> mesh;
    const CGAL::Mixed_mesh_criteria_3 criteria(std::stoul(argv[1]));
    const CGAL::Mixed_mesh_result_3 result = CGAL::make_mixed_mesh_3(surface, criteria, mesh);
    const std::string name = std::filesystem::path(argv[i]).stem().string();
    if(result.has_mesh() && !mm3::IO::write_mixed_mesh((folder / (name + ".vtu")).string(), mesh)) {
      std::cerr << name << ": cannot be written\n";
      return 1;
    }
    std::cout << name << ": " << (result.has_mesh() ? mm3::description(result.status) : "none") << '\n';
  }
  return 0;
}
