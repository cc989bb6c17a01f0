// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One run of the mesher without files, from surfaces in memory to a checked mesh. Prints a line of JSON.
//
//   benchmark_make_mixed_mesh_3 SURFACE.off REGION.off VERTICES [THREADS [optimize|relax|none]]
//
// The boundary gets onto the surface by the optimization, by Algorithm 1 alone, or not at all.

#include "core/Stage_log.h"
#include "core/Thread_limit.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/validation.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/fit_mixed_mesh_to_surface.h>
#include <CGAL/make_mixed_mesh_3.h>

#include <nlohmann/json.hpp>

#include <ctime>
#include <functional>
#include <iostream>
#include <string>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

int main(int argc, char** argv)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  Surface surface, region_surface;
  if(argc < 4 || !PMP::IO::read_polygon_mesh(argv[1], surface)
     || !PMP::IO::read_polygon_mesh(argv[2], region_surface)) {
    std::cerr
      << "usage: benchmark_make_mixed_mesh_3 SURFACE REGION VERTICES [THREADS [optimize|relax|none]]\n";
    return 2;
  }
  const Thread_limit limit(argc > 4 ? std::stoul(argv[4]) : 1);
  const auto criteria = CGAL::Mixed_mesh_criteria_3(std::stoul(argv[3]))
                          .fit_to_surface(argc <= 5 || std::string(argv[5]) == "optimize");
  const bool relaxes = argc > 5 && std::string(argv[5]) == "relax";
  Stage_log log(false);
  const std::size_t memory_before = log.peak_bytes();
  const std::clock_t start = std::clock();
  const auto domain = log("AABB trees", [&] { return CGAL::Polyhedral_mixed_mesh_domain_3(surface); });
  const auto region = log("AABB trees", [&] { return CGAL::Polyhedral_mixed_mesh_region_3(region_surface); });
  CGAL::Mixed_mesh_3<Kernel> mesh;
  const auto result = CGAL::make_mixed_mesh_3<CGAL::Parallel_if_available_tag>(domain, region, criteria, mesh,
                                                                               CGAL::parameters::visitor(
                                                                                 std::ref(log)));
  if(relaxes)
    log("Algorithm 1",
        [&] { return CGAL::fit_mixed_mesh_to_surface(mesh, domain, CGAL::Mixed_mesh_fit_criteria_3()); });
  const auto defects = log("checks", [&] { return CGAL::Mixed_meshes_3::find_defects(mesh); });
  const double cpu = double(std::clock() - start) / CLOCKS_PER_SEC, seconds = log.seconds();
  const bool is_valid = defects.none();
  const bool is_success = is_valid && result.status == CGAL::Mixed_mesh_status::SUCCESS;

  const double n = double(mesh.number_of_vertices());
  const auto quality = CGAL::Mixed_meshes_3::quality_statistics(mesh).back();
  nlohmann::ordered_json line = {{"budget", criteria.maximal_number_of_vertices()},
                                 {"vertices", mesh.number_of_vertices()},
                                 {"elements", mesh.number_of_elements()},
                                 {"status SUCCESS, no defects", is_success},
                                 {"vertices inserted by transition templates",
                                  result.number_of_transition_vertices},
                                 {"vertices inserted by boundary stage",
                                  result.number_of_boundary_vertices_inserted},
                                 {"seconds", seconds},
                                 {"CPU seconds", cpu},
                                 {"vertices per CPU second", n / cpu},
                                 {"bytes per vertex", double(log.peak_bytes() - memory_before) / n},
                                 {"peak MiB", double(log.peak_bytes()) / (1 << 20)},
                                 {"octrees tried", result.number_of_trials},
                                 {"ARC mean", quality.mean},
                                 {"ARC max", quality.maximum}};
  for(const Stage_cost& cost : log.costs())
    line["stages"][cost.name] = cost.cpu_seconds;
  std::cout << line << '\n';
  return is_valid ? 0 : 1;
}
