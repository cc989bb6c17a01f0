// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// CPU times of operations that a surgeon waits for: new control points, a resection, a warped image; and of
// the same work with a new factorization by Eigen's LDLT. Medians, minima and maxima, in milliseconds. There
// is one thread, if OMP_NUM_THREADS=1 limits CHOLMOD to it.

#include "fix_lower_part.h"

#include "core/resources.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Linear_elasticity_3.h>
#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Mixed_mesh_3/IO/read_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/resect.h>
#include <CGAL/Mixed_mesh_image_3/warp_image.h>
#include <CGAL/Surface_mesh.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace mm3 = CGAL::Mixed_meshes_3;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Mixed_mesh_3<Kernel>;
using Vector = std::array<double, 3>;

namespace {

int runs = 5;
nlohmann::json report;

template <class F>
void measure(const std::string& name, const F& f, int repetitions = 1)
{
  std::vector<double> times;
  for(int run = 0; run < runs; ++run) {
    const std::clock_t start = std::clock();
    for(int i = 0; i < repetitions; ++i)
      f();
    times.push_back(1000. * double(std::clock() - start) / CLOCKS_PER_SEC / repetitions);
  }
  std::sort(times.begin(), times.end());
  report[name] = {{"median", times[times.size() / 2]}, {"min", times.front()}, {"max", times.back()}};
}

} // namespace

int main(int argc, char* argv[])
{
  std::string mesh_file, tumor_file;
  bool with_image = false, with_ldlt = false;
  CLI::App app{"Times of brain shift and resection, CPU milliseconds."};
  app.add_option("mesh", mesh_file, ".vtu or .msh")->required();
  app.add_option("tumor", tumor_file, "closed surface")->required();
  app.add_option("--runs", runs, "of which medians are taken")->capture_default_str();
  app.add_flag("--image", with_image, "also warp an image of 181 x 217 x 181 voxels");
  app.add_flag("--ldlt", with_ldlt, "also factor by Eigen's LDLT");
  CLI11_PARSE(app, argc, argv);
  try {
    Mesh mesh;
    require([&](std::string* error) { return mm3::IO::read_mixed_mesh(mesh_file, mesh, error); });
    CGAL::Surface_mesh<Kernel::Point_3> tumor;
    require([&](std::string* error) { return mm3::IO::read_closed_surface(tumor_file, tumor, error); });
    const std::vector<Vector> points{{43.633, 24.044, 49.096},
                                     {35.245, 31.664, 49.283},
                                     {29.646, 24.914, 57.660},
                                     {38.404, 17.573, 58.562}};
    std::vector<Vector> displacements(points.size(), Vector{-3.132, -2.349, -9.202});
    constexpr double largest_distance = 10;

    using Elasticity = CGAL::Linear_elasticity_3<Mesh>;
    Elasticity elasticity(mesh);
    fix_lower_part(elasticity);
    measure("factor", [&] { check(elasticity.factor()); });
    measure("control points at new places", [&] {
      check(elasticity.set_control_points(points, largest_distance));
      check(elasticity.solve(displacements));
    });
    measure(
      "control points with new displacements",
      [&] {
        displacements[0][0] += 0.1;
        check(elasticity.solve(displacements));
      },
      20);

    mm3::Resection_3 resection;
    measure("elements to remove", [&] { resection = mm3::resect(mesh, tumor); });
    report["elements removed"] = std::count(resection.is_removed.begin(), resection.is_removed.end(), true);
    // Each run starts from the factor of the whole.
    std::vector<double> times;
    for(int run = 0; run < runs; ++run) {
      Elasticity whole(mesh);
      fix_lower_part(whole);
      check(whole.factor());
      check(whole.set_control_points(points, largest_distance));
      const std::clock_t start = std::clock();
      check(whole.remove_elements(resection.is_removed));
      check(whole.solve(displacements));
      times.push_back(1000. * double(std::clock() - start) / CLOCKS_PER_SEC);
      report["iterations"] = whole.number_of_iterations();
      if(run + 1 == runs)
        measure("factor of what is left", [&] {
          check(whole.factor());
          check(whole.solve(displacements));
        });
    }
    std::sort(times.begin(), times.end());
    report["resection"] = {{"median", times[times.size() / 2]},
                           {"min", times.front()},
                           {"max", times.back()}};

    if(with_ldlt) {
      CGAL::Linear_elasticity_3<Mesh, mm3::Simplicial_solver_traits> simplicial(mesh);
      fix_lower_part(simplicial);
      measure("LDLT: factor, control points, solve", [&] {
        check(simplicial.factor());
        check(simplicial.set_control_points(points, largest_distance));
        check(simplicial.solve(displacements));
      });
    }
    if(with_image) {
      mm3::Voxel_image_3 image;
      image.grid.size = {181, 217, 181};
      image.grid.index_to_world = {{{1, 0, 0, -90}, {0, 1, 0, -126}, {0, 0, 1, -72}}};
      image.values.resize(image.grid.number_of_voxels());
      for(std::size_t i = 0; i < image.values.size(); ++i)
        image.values[i] = float(i % 251);
      check(elasticity.solve(displacements));
      measure("warped image",
              [&] { mm3::warp_image(image, mesh, elasticity.displacements(), mm3::Warp_options()); });
    }
    report["vertices"] = mesh.number_of_vertices();
    std::cout << report.dump(2) << '\n';
  } catch(const std::exception& e) {
    std::cerr << "benchmark_elasticity: error: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
}
