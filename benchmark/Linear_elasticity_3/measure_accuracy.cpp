// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The error of brain shift in the region of interest, on meshes from files, against quadratic elements on a
// fine mesh. Prints a JSON object a line. compare_accuracy.py runs it.

#include "common/resources.h"

#include "standard_elasticity.h"
#include "Quadratic_reference.h"
#include "test_cases.h"

#include <CGAL/Linear_elasticity_3.h>
#include <CGAL/Mixed_mesh_3/IO/read_mixed_mesh.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace {

constexpr std::size_t number_of_points = 2000;
constexpr double least_depth = 3; // mm, below the surface of the brain

double root_mean_square(const std::vector<Vector>& u, const std::vector<Vector>& v)
{
  double sum = 0;
  for(std::size_t i = 0; i < u.size(); ++i)
    for(int k = 0; k < 3; ++k)
      sum += (u[i][k] - v[i][k]) * (u[i][k] - v[i][k]);
  return std::sqrt(sum / double(u.size()));
}

std::vector<Vector> at_points(const Mesh& mesh, const std::vector<Vector>& displacements,
                              const std::vector<Vector>& points)
{
  using namespace mm3::internal;
  const mm3::Element_locator_3<Mesh> locator(mesh);
  std::vector<Vector> values;
  for(const Vector& p : points) {
    const mm3::Element_location_3 l = locator.nearest(p);
    Vector u{};
    for(int i = 0; i < mesh.element(l.element).size(); ++i)
      u = u + l.weights[i] * displacements[mesh.element(l.element)[i]];
    values.push_back(u);
  }
  return values;
}

// By Linear_elasticity_3, and by standard elements.
std::pair<std::vector<Vector>, std::vector<Vector>> solve(const Mesh& mesh, const Brain& brain,
                                                          Boundary_displacement boundary,
                                                          const mm3::Elastic_material& material)
{
  CGAL::Linear_elasticity_3<Mesh> elasticity(mesh, material);
  std::vector<bool> is_prescribed = boundary_vertices(mesh);
  std::vector<Vector> displacements(mesh.number_of_vertices(), Vector{});
  for(mm3::Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
    if(is_prescribed[v]) {
      const auto u = boundary(mm3::to_vec3(mesh.point(v)), brain);
      is_prescribed[v] = u.has_value();
      if(u) {
        elasticity.prescribe(v, *u);
        displacements[v] = *u;
      }
    }
  auto result = elasticity.factor();
  if(result.is_success())
    result = elasticity.solve();
  if(!result.is_success())
    throw std::runtime_error(result.description());
  return {elasticity.displacements(), standard_solution(mesh, material, is_prescribed, displacements)};
}

// A reference takes minutes: it is kept in a file, a line for each point.
std::vector<Vector> reference(const std::string& file, const Mesh* mesh, const Brain& brain,
                              Boundary_displacement boundary, const mm3::Elastic_material& material,
                              const std::vector<Vector>& points)
{
  std::vector<Vector> values(points.size());
  if(mesh == nullptr) {
    std::ifstream in(file);
    for(Vector& u : values)
      in >> u[0] >> u[1] >> u[2];
    if(!in)
      throw std::runtime_error(file + ": no reference there: make it by --reference-mesh");
    return values;
  }
  const Quadratic_reference quadratic(*mesh, brain, boundary, material);
  std::cerr << file << ": " << quadratic.number_of_nodes() << " nodes\n";
  values = quadratic.at(points);
  std::ofstream out(file);
  out.precision(17);
  for(const Vector& u : values)
    out << u[0] << ' ' << u[1] << ' ' << u[2] << '\n';
  if(!out)
    throw std::runtime_error(file + ": cannot be written");
  return values;
}

} // namespace

int main(int argc, char* argv[])
{
  std::string surface, region, directory = ".", reference_mesh;
  std::vector<std::string> files;
  mm3::Elastic_material material;
  CLI::App app{"Measures the error of brain shift in the region, on meshes from files."};
  app.add_option("surface", surface, "closed surface of the brain")->required();
  app.add_option("region", region, "closed surface of the region of interest")->required();
  app.add_option("meshes", files, ".vtu or .msh");
  app.add_option("--poisson-ratio", material.poisson_ratio, "")->capture_default_str();
  app.add_option("--references", directory, "where the references are kept")->capture_default_str();
  app.add_option("--reference-mesh", reference_mesh, "tetrahedra to make them from");
  CLI11_PARSE(app, argc, argv);
  try {
    const Brain brain(surface, region);
    const std::vector<Vector> points = brain.points_to_compare(number_of_points, least_depth);
    Mesh fine;
    if(!reference_mesh.empty())
      require([&](std::string* error) { return mm3::IO::read_mixed_mesh(reference_mesh, fine, error); });
    const std::pair<std::string, Boundary_displacement> cases[] = {{"bump", bump_displacement},
                                                                   {"smooth", smooth_displacement}};
    for(const auto& [name, boundary] : cases) {
      const std::vector<Vector> exact = reference(directory + "/" + name + ".txt",
                                                  reference_mesh.empty() ? nullptr : &fine, brain, boundary,
                                                  material, points);
      const double size = root_mean_square(exact, std::vector<Vector>(points.size(), Vector{}));
      for(const std::string& file : files) {
        Mesh mesh;
        require([&](std::string* error) { return mm3::IO::read_mixed_mesh(file, mesh, error); });
        const auto [ours, standard] = solve(mesh, brain, boundary, material);
        std::cout << nlohmann::json{{"mesh", file},
                                    {"case", name},
                                    {"vertices", mesh.number_of_vertices()},
                                    {"elements", mesh.number_of_elements()},
                                    {"rms displacement, mm", size},
                                    {"error", root_mean_square(at_points(mesh, ours, points), exact) / size},
                                    {"error of standard elements",
                                     root_mean_square(at_points(mesh, standard, points), exact) / size}}
                  << std::endl;
      }
    }
  } catch(const std::exception& e) {
    std::cerr << "measure_accuracy: error: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
  return boost::report_errors();
}
