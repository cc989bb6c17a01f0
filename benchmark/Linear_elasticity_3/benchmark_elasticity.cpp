// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// CPU times of operations that a surgeon waits for: new control points, a resection, a warped image; and of
// the same work with a new factorization by Eigen's LDLT; with displacements of order 1 or 2. Medians, minima
// and maxima, in milliseconds; those of an element matrix, of a location in the mesh with the displacement
// there, and of a voxel, in nanoseconds. There is one thread, if OMP_NUM_THREADS=1 limits CHOLMOD to it.

#include "fix_lower_part.h"

#include "core/resources.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Linear_elasticity_3.h>
#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/Element_locator_3.h>
#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Mixed_mesh_3/IO/read_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/elements/element_points.h>
#include <CGAL/Mixed_mesh_3/internal/fem/element_stiffness.h>
#include <CGAL/Mixed_mesh_3/resect.h>
#include <CGAL/Mixed_mesh_image_3/warp_image.h>
#include <CGAL/Surface_mesh.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
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

using Elasticity = CGAL::Linear_elasticity_3<Mesh>;

int runs = 5;
nlohmann::json report;

// \param unit of the times, in seconds
template <class F>
void measure(const std::string& name, const F& f, double repetitions = 1, double unit = 1e-3)
{
  std::vector<double> times;
  for(int run = 0; run < runs; ++run) {
    const std::clock_t start = std::clock();
    for(int i = 0; i < repetitions; ++i)
      f();
    times.push_back(double(std::clock() - start) / CLOCKS_PER_SEC / repetitions / unit);
  }
  std::sort(times.begin(), times.end());
  report[name] = {{"median", times[times.size() / 2]}, {"min", times.front()}, {"max", times.back()}};
}

// Measures an operation that does something a number of times, in nanoseconds each.
template <class F>
void measure_each(const std::string& name, std::size_t number, const F& f)
{
  measure(name, f, 1, 1e-9 * double(number));
}

void measure_kernels(const Mesh& mesh, const Elasticity& elasticity)
{
  using namespace mm3::internal;
  double sum = 0; // of what is computed, so that nothing is left out
  measure_each("element matrix, ns", mesh.number_of_elements(), [&] {
    Element_stiffness stiffness;
    for(mm3::Element_index e = 0; e < mesh.number_of_elements(); ++e) {
      const auto element = mesh.element(e);
      const auto points = relative_points(element,
                                          [&](mm3::Vertex_index v) { return mm3::to_vec3(mesh.point(v)); });
      compute_element_stiffness(quadrature_rule(element.kind(), elasticity.order()), points,
                                mm3::Elastic_material(), Dilatation::POINTWISE, stiffness);
      sum += stiffness[0][0][0][0];
    }
  });
  const mm3::Element_locator_3<Mesh> locator(mesh);
  std::vector<mm3::Vec3> centroids;
  for(mm3::Element_index e = 0; e < mesh.number_of_elements(); ++e) {
    const auto element = mesh.element(e);
    mm3::Vec3 p{};
    for(mm3::Vertex_index v : element)
      p = p + (1. / element.size()) * mm3::to_vec3(mesh.point(v));
    centroids.push_back(p);
  }
  measure_each("location of a point and its displacement, ns", centroids.size(), [&] {
    for(const mm3::Vec3& p : centroids)
      sum += elasticity.displacement(locator.nearest(p))[0];
  });
  if(!std::isfinite(sum))
    throw std::runtime_error("a matrix or a displacement is not finite");
}

// The largest difference of displacements of nodes, relative to the largest displacement.
double difference(const Elasticity& a, const Elasticity& b)
{
  double difference = 0, scale = 0;
  const auto add = [&](const std::vector<mm3::Vec3>& u, const std::vector<mm3::Vec3>& v) {
    for(std::size_t i = 0; i < u.size(); ++i) {
      difference = (std::max)(difference, mm3::norm(u[i] - v[i]));
      scale = (std::max)(scale, mm3::norm(v[i]));
    }
  };
  add(a.displacements(), b.displacements());
  add(a.middle_displacements(), b.middle_displacements());
  return difference / scale;
}

} // namespace

int main(int argc, char* argv[])
{
  std::string mesh_file, tumor_file;
  bool with_image = false, with_ldlt = false;
  int order = 1;
  double iteration_tolerance = 1e-3;
  CLI::App app{"Times of brain shift and resection, CPU milliseconds."};
  app.add_option("mesh", mesh_file, ".vtu or .msh")->required();
  app.add_option("tumor", tumor_file, "closed surface")->required();
  app.add_option("--runs", runs, "of which medians are taken")->capture_default_str();
  app.add_option("--order", order, "of displacements")->check(CLI::IsMember({1, 2}))->capture_default_str();
  app
    .add_option("--iteration-tolerance", iteration_tolerance,
                "of a solution after a resection, see Linear_elasticity_3::set_iteration_tolerance()")
    ->check(CLI::PositiveNumber)
    ->capture_default_str();
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

    Elasticity elasticity(mesh);
    elasticity.order(order);
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
    measure_kernels(mesh, elasticity);

    mm3::Resection_3 resection;
    measure("elements to remove", [&] { resection = mm3::resect(mesh, tumor); });
    report["elements removed"] = std::count(resection.is_removed.begin(), resection.is_removed.end(), true);
    // Each run starts from the factor of the whole.
    std::vector<double> times;
    for(int run = 0; run < runs; ++run) {
      Elasticity whole(mesh);
      whole.order(order);
      whole.set_iteration_tolerance(iteration_tolerance);
      fix_lower_part(whole);
      check(whole.factor());
      check(whole.set_control_points(points, largest_distance));
      const std::clock_t start = std::clock();
      check(whole.remove_elements(resection.is_removed));
      check(whole.solve(displacements));
      times.push_back(1000. * double(std::clock() - start) / CLOCKS_PER_SEC);
      report["iterations"] = whole.number_of_iterations();
      if(run + 1 < runs)
        continue;
      Elasticity left(mesh);
      left.order(order);
      fix_lower_part(left);
      check(left.factor());
      check(left.set_control_points(points, largest_distance));
      check(left.remove_elements(resection.is_removed));
      measure("factor of what is left", [&] {
        check(left.factor());
        check(left.solve(displacements));
      });
      report["difference of the resection to a new factor"] = difference(whole, left);
    }
    std::sort(times.begin(), times.end());
    report["resection"] = {{"median", times[times.size() / 2]},
                           {"min", times.front()},
                           {"max", times.back()}};

    if(with_ldlt) {
      CGAL::Linear_elasticity_3<Mesh, mm3::Simplicial_solver_traits> simplicial(mesh);
      simplicial.order(order);
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
      mm3::Warp_options options;
      options.quadratic_edges = elasticity.quadratic_edges();
      options.edge_coefficients = elasticity.edge_coefficients();
      const auto warp = [&] { return mm3::warp_image(image, mesh, elasticity.displacements(), options); };
      measure("warped image", warp);
      const auto mask = warp().mask;
      measure_each("warped voxel of the brain, ns",
                   std::size_t(std::count(mask.values.begin(), mask.values.end(), 1.f)), warp);
    }
    report["vertices"] = mesh.number_of_vertices();
    report["nodes"] = mesh.number_of_vertices() + elasticity.quadratic_edges().size();
    std::cout << report.dump(2) << '\n';
  } catch(const std::exception& e) {
    std::cerr << "benchmark_elasticity: error: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
}
