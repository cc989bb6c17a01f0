// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Brain shift with finite rotations compared with small ones: the bump of measure_accuracy. CPU times,
// iterations, and inverted elements. Prints a JSON object in each line.

#include "test_cases.h"

#include "core/resources.h"

#include <CGAL/Linear_elasticity_3.h>
#include <CGAL/Mixed_mesh_3/IO/read_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/certificate.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <ctime>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

namespace {

using Elasticity = CGAL::Linear_elasticity_3<Mesh>;

std::size_t number_of_inverted_elements(const Mesh& mesh, const std::vector<Vector>& displacements)
{
  std::size_t inverted = 0;
  for(mm3::Element_index e = 0; e < mesh.number_of_elements(); ++e)
    inverted += mm3::jacobian_sign(mesh.element(e),
                                   [&](mm3::Vertex_index v) {
                                     return mm3::to_vec3(mesh.point(v)) + displacements[v];
                                   })
                != mm3::Jacobian_sign::POSITIVE;
  return inverted;
}

nlohmann::json solve(Elasticity& elasticity)
{
  const std::clock_t start = std::clock();
  const CGAL::Linear_elasticity_result_3 result = elasticity.solve();
  nlohmann::json report{{"status", result.description()},
                        {"CPU ms", 1000. * double(std::clock() - start) / CLOCKS_PER_SEC}};
  if(!elasticity.displacements().empty())
    report["inverted"] = number_of_inverted_elements(elasticity.mesh(), elasticity.displacements());
  return report;
}

nlohmann::json measure(const Mesh& mesh, const Boundary_displacement& bump)
{
  Elasticity elasticity(mesh);
  for(mm3::Vertex_index v : mm3::boundary_vertices(mesh))
    if(const auto u = bump(mm3::to_vec3(mesh.point(v))))
      elasticity.prescribe(v, *u);
  nlohmann::json report{{"vertices", mesh.number_of_vertices()}};
  const std::clock_t start = std::clock();
  if(const auto result = elasticity.factor(); !result.is_success())
    throw std::runtime_error(result.description());
  report["factor, CPU ms"] = 1000. * double(std::clock() - start) / CLOCKS_PER_SEC;
  report["small"] = solve(elasticity);
  elasticity.set_corotational(true);
  report["finite"] = solve(elasticity);
  report["finite"]["iterations"] = elasticity.number_of_iterations();
  report["finite"]["steps"] = elasticity.residuals().size();
  return report;
}

} // namespace

int main(int argc, char* argv[])
{
  std::string surface, openings_file;
  std::vector<std::string> files;
  CLI::App app{"Finite rotations beside small ones: a bump of 10 mm at each opening."};
  app.add_option("surface", surface, "closed surface of the brain")->required();
  app.add_option("openings", openings_file, "openings.json")->required();
  app.add_option("meshes", files, ".vtu or .msh")->required();
  CLI11_PARSE(app, argc, argv);
  try {
    const Brain brain(surface);
    for(const std::string& file : files) {
      Mesh mesh;
      require([&](std::string* error) { return mm3::IO::read_mixed_mesh(file, mesh, error); });
      for(const Opening& o : read_openings(openings_file)) {
        nlohmann::json report = measure(mesh, bump_displacement(o, brain));
        report["opening"] = o.name;
        std::cout << report << std::endl;
      }
    }
    return EXIT_SUCCESS;
  } catch(const std::exception& e) {
    std::cerr << "measure_rotations: error: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
}
