// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The solver of PETSc compared with the direct one: a body under gravity, whose lower 30 % are fixed. Prints
// wall times, iterations, the memory of the first process and the difference of the displacements, as a JSON
// object. Run it by mpirun for several processes.

#include "fix_lower_part.h"

#include "core/Stage_log.h"
#include "core/resources.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Linear_elasticity_3.h>
#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/IO/read_mixed_mesh.h>
#include <CGAL/Mixed_mesh_petsc/Petsc_solver_traits.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

namespace mm3 = CGAL::Mixed_meshes_3;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Mixed_mesh_3<Kernel>;
using Vector = mm3::Vec3;

namespace {

template <class Elasticity>
std::vector<Vector> displacements(Elasticity& elasticity, const std::string& name, Stage_log& log,
                                  nlohmann::json& report)
{
  report["unknowns"] = 3 * fix_lower_part(elasticity);
  log(name + ": factor", [&] { check(elasticity.factor()); });
  elasticity.set_gravity({0, 0, -9810});
  log(name + ": solve", [&] { check(elasticity.solve()); });
  for(const Stage_cost& cost : log.costs())
    if(cost.name.rfind(name + ": ", 0) == 0)
      report[cost.name] = {{"s", cost.seconds}, {"peak MiB", double(cost.peak_bytes) / (1 << 20)}};
  return elasticity.displacements();
}

nlohmann::json measure(const std::string& file, const mm3::Elastic_material& material, double tolerance,
                       bool with_direct)
{
  nlohmann::json report;
  Stage_log log(false);
  Mesh mesh;
  require([&](std::string* error) { return mm3::IO::read_mixed_mesh(file, mesh, error); });
  report["vertices"] = mesh.number_of_vertices();
  report["MiB before"] = double(log.peak_bytes()) / (1 << 20);
  std::vector<Vector> found;
  {
    CGAL::Linear_elasticity_3<Mesh, mm3::Petsc_solver_traits> elasticity(mesh, material);
    elasticity.solver().set_tolerance(tolerance);
    found = displacements(elasticity, "PETSc", log, report);
    report["processes"] = elasticity.solver().number_of_processes();
    report["iterations"] = elasticity.solver().number_of_iterations();
  }
  if(with_direct) {
    CGAL::Linear_elasticity_3<Mesh> elasticity(mesh, material);
    const std::vector<Vector> exact = displacements(elasticity, "direct", log, report);
    double difference = 0, largest = 0;
    for(std::size_t v = 0; v < exact.size(); ++v) {
      difference = (std::max)(difference, mm3::norm(found[v] - exact[v]));
      largest = (std::max)(largest, mm3::norm(exact[v]));
    }
    report["largest difference, relative"] = difference / largest;
  }
  return report;
}

} // namespace

int main(int argc, char* argv[])
{
  std::string file;
  mm3::Elastic_material material;
  double tolerance = 1e-8;
  bool without_direct = false;
  CLI::App app{"The solver of PETSc beside the direct one, under gravity."};
  app.add_option("mesh", file, "any that read_mixed_mesh() reads")->required();
  app.add_option("--tolerance", tolerance, "of the energy norm")->capture_default_str();
  app.add_option("--poisson-ratio", material.poisson_ratio, "of the tissue")->capture_default_str();
  app.add_flag("--without-direct", without_direct, "for meshes that are too large for it");
  CLI11_PARSE(app, argc, argv);
  try {
    mm3::Petsc_session session;
    if(session.is_first())
      std::cout << measure(file, material, tolerance, !without_direct).dump(2) << '\n';
    else
      session.serve();
    return EXIT_SUCCESS;
  } catch(const std::exception& e) {
    std::cerr << "measure_petsc: error: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
}
