// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Makes a mesh of mixed elements and measures it as benchmark_mesh_3 does its peer's. Prints a line of
// JSON; `--help` tells the options.

#include "mesh_measures.h"

#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Mixed_mesh_3/validation.h>
#include <CGAL/make_mixed_mesh_3.h>

#include <CLI/CLI.hpp>

#include <cstddef>
#include <ctime>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>

namespace mm3 = CGAL::Mixed_meshes_3;
using Mesh_measures::Kernel;
using Mesh_measures::Surface;

int main(int argc, char** argv)
try {
  CLI::App app("Makes a mesh of mixed elements and measures it.");
  std::string surface_file, region_file, output_file;
  std::size_t number_of_vertices = 0;
  double tolerance = CGAL::Mixed_mesh_criteria_3::automatic;
  bool only_time = false;
  app.add_option("surface", surface_file, "closed surface of the domain")->required();
  app.add_option("region", region_file, "closed surface of the region of interest")->required();
  app.add_option("vertices", number_of_vertices, "vertex budget")->required()->check(CLI::PositiveNumber);
  app
    .add_option("--tolerance", tolerance,
                "how far the boundary may be from the surface; 0: any (default: as the budget allows)")
    ->check(CLI::NonNegativeNumber);
  app.add_option("--output", output_file, "also write the mesh, to a .vtu file for example");
  app.add_flag("--only-time", only_time, "measure the time only");
  CLI11_PARSE(app, argc, argv);

  Surface surface, region_surface;
  require([&](std::string* error) { return mm3::IO::read_closed_surface(surface_file, surface, error); });
  require(
    [&](std::string* error) { return mm3::IO::read_closed_surface(region_file, region_surface, error); });

  CGAL::Mixed_mesh_3<Kernel> mesh;
  const std::clock_t start = std::clock();
  const auto result = CGAL::make_mixed_mesh_3(
    CGAL::Polyhedral_mixed_mesh_domain_3(surface), CGAL::Polyhedral_mixed_mesh_region_3(region_surface),
    CGAL::Mixed_mesh_criteria_3(number_of_vertices).tolerance(tolerance), mesh);
  if(!mm3::find_defects(mesh).none())
    throw std::runtime_error("the mesh has defects");
  const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
  if(!result.has_mesh())
    throw std::runtime_error("no mesh with that many vertices");

  nlohmann::ordered_json line = {{"mesher", "Mixed_mesh_3"},
                                 {"wanted vertices", number_of_vertices},
                                 {"vertices", mesh.number_of_vertices()},
                                 {"tolerance", result.tolerance},
                                 {"vertices for tolerance", result.number_of_vertices_for_tolerance},
                                 {"CPU seconds", seconds}};
  Mesh_measures::finish(line, mesh, surface, region_surface, only_time, output_file);
  return 0;
} catch(const std::exception& e) {
  std::cerr << "measure_mesh: " << e.what() << '\n';
  return 1;
}
