// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Makes a mesh of mixed elements, or reads a mesh of any mesher, and measures it. Prints a line of JSON;
// `--help` tells the options.

#include "mesh_measures.h"

#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Mixed_mesh_3/IO/read_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/validation.h>
#include <CGAL/fit_mixed_mesh_to_surface.h>
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
using Mesh = CGAL::Mixed_mesh_3<Kernel>;

struct Options
{
  std::string surface, region, mesh, output;
  std::size_t vertices = 0;
  double tolerance = CGAL::Mixed_mesh_criteria_3::automatic;
  double step = 1;
  bool is_regular = false, is_papers = false, only_time = false;
};

Surface read_surface(const std::string& file)
{
  Surface surface;
  require([&](std::string* error) { return mm3::IO::read_closed_surface(file, surface, error); });
  return surface;
}

template <class Region>
CGAL::Mixed_mesh_result_3 make_mesh(const CGAL::Polyhedral_mixed_mesh_domain_3& domain, const Region& region,
                                    const Options& o, Mesh& mesh)
{
  auto criteria = CGAL::Mixed_mesh_criteria_3(o.vertices).tolerance(o.tolerance);
  if(!o.is_papers)
    return CGAL::make_mixed_mesh_3(domain, region, criteria, mesh);
  criteria.grading(0).tolerance(0).share_of_bisections(0).fit_to_surface(false);
  criteria.boundary_mode(CGAL::Mixed_meshes_3::Boundary_mode::PAPER);
  const auto result = CGAL::make_mixed_mesh_3(domain, region, criteria, mesh);
  if(result.has_mesh())
    CGAL::fit_mixed_mesh_to_surface(mesh, domain, CGAL::Mixed_mesh_fit_criteria_3());
  return result;
}

// Makes a checked mesh from surfaces in memory.
nlohmann::ordered_json make_mesh(const Surface& surface, const Surface& region_surface, const Options& o,
                                 Mesh& mesh)
{
  const std::clock_t start = std::clock();
  const CGAL::Polyhedral_mixed_mesh_domain_3 domain(surface);
  const auto result = o.is_regular
                        ? make_mesh(domain, CGAL::Everywhere_mixed_mesh_region_3(), o, mesh)
                        : make_mesh(domain, CGAL::Polyhedral_mixed_mesh_region_3(region_surface), o, mesh);
  if(!result.has_mesh())
    throw std::runtime_error("no mesh with that many vertices");
  if(!mm3::find_defects(mesh).none())
    throw std::runtime_error("the mesh has defects");
  const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
  return {{"mesher", "Mixed_mesh_3"},
          {"wanted vertices", o.vertices},
          {"vertices", mesh.number_of_vertices()},
          {"tolerance", result.tolerance},
          {"vertices for tolerance", result.number_of_vertices_for_tolerance},
          {"CPU seconds", seconds}};
}

int main(int argc, char** argv)
try {
  CLI::App app("Makes a mesh of mixed elements, or reads a mesh, and measures it.");
  Options o;
  app.add_option("surface", o.surface, "closed surface of the domain")->required();
  app.add_option("region", o.region, "closed surface of the region of interest")->required();
  auto* const vertices = app.add_option("vertices", o.vertices, "vertex budget")->check(CLI::PositiveNumber);
  app
    .add_option("--mesh", o.mesh,
                "measure this mesh: .vtu, .msh (Gmsh), .mesh (Medit), .ele (TetGen) or .vol (Netgen)")
    ->excludes(vertices);
  app
    .add_option("--tolerance", o.tolerance,
                "how far the boundary may be from the surface; 0: any (default: as the budget allows)")
    ->check(CLI::NonNegativeNumber);
  app.add_flag("--regular", o.is_regular, "refine everywhere alike");
  app.add_flag("--paper", o.is_papers, "only the region is refined; Algorithm 1 instead of the optimization");
  app.add_option("--output", o.output, "also write the mesh, to a .vtu file for example");
  app.add_option("--step", o.step, "between samples, for distances")
    ->capture_default_str()
    ->check(CLI::PositiveNumber);
  app.add_flag("--only-time", o.only_time, "measure the time only");
  CLI11_PARSE(app, argc, argv);
  if(o.mesh.empty() && o.vertices == 0)
    throw std::runtime_error("expected a number of vertices, or --mesh");

  const Surface surface = read_surface(o.surface), region = read_surface(o.region);
  Mesh mesh;
  nlohmann::ordered_json line;
  if(o.mesh.empty())
    line = make_mesh(surface, region, o, mesh);
  else
    require([&](std::string* error) { return mm3::IO::read_mixed_mesh(o.mesh, mesh, error); });
  line["vertices"] = mesh.number_of_vertices();
  Mesh_measures::finish(line, mesh, surface, region, o.only_time, o.output, o.step);
  return 0;
} catch(const std::exception& e) {
  std::cerr << "measure_mesh: " << e.what() << '\n';
  return 1;
}
