// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The error of brain shift in the region of interest, on meshes from files, compared with quadratic elements
// on a fine mesh. Prints a JSON object in each line. compare_accuracy.py runs the program.

#include "core/resources.h"

#include "standard_elasticity.h"
#include "Quadratic_reference.h"
#include "Springs.h"
#include "test_cases.h"

#include <CGAL/Linear_elasticity_3.h>
#include <CGAL/Linear_elasticity_3/adapt_mixed_mesh_3.h>
#include <CGAL/Linear_elasticity_3/internal/Control_points.h>
#include <CGAL/Mixed_mesh_3/IO/read_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/Recovered_displacement_3.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <fstream>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace {

constexpr std::size_t number_of_points = 2000;
constexpr double least_depth = 3; // mm, below the surface of the brain

// The root mean square over the points of a subset.
double root_mean_square(const std::vector<Vector>& u, const std::vector<bool>& is_in_subset)
{
  double sum = 0;
  for(std::size_t i = 0; i < u.size(); ++i)
    if(is_in_subset[i])
      sum += mm3::dot(u[i], u[i]);
  return std::sqrt(sum / double(std::count(is_in_subset.begin(), is_in_subset.end(), true)));
}

double relative_error(const std::vector<Vector>& u, const std::vector<Vector>& exact,
                      const std::vector<bool>& is_in_subset)
{
  std::vector<Vector> difference;
  for(std::size_t i = 0; i < u.size(); ++i)
    difference.push_back(u[i] - exact[i]);
  return root_mean_square(difference, is_in_subset) / root_mean_square(exact, is_in_subset);
}

// The displacement at points of a mesh, by shape functions.
std::vector<Vector> at_points(const Mesh& mesh, const std::vector<Vector>& displacements,
                              const std::vector<mm3::Element_location_3>& points)
{
  std::vector<Vector> values;
  for(const mm3::Element_location_3& l : points) {
    Vector u{};
    for(int i = 0; i < mesh.element(l.element).size(); ++i)
      u = u + l.weights[i] * displacements[mesh.element(l.element)[i]];
    values.push_back(u);
  }
  return values;
}

// The displacement at points of a mesh, by shape functions and recovered gradients.
std::vector<Vector> recovered_at_points(const Mesh& mesh, const std::vector<Vector>& displacements,
                                        const std::vector<mm3::Element_location_3>& points)
{
  const mm3::Recovered_displacement_3<Mesh> recovered(mesh, displacements);
  std::vector<Vector> values;
  for(const mm3::Element_location_3& l : points)
    values.push_back(recovered(l));
  return values;
}

mm3::Prescribed_displacements prescribed_displacements(const Mesh& mesh,
                                                       const Boundary_displacement& boundary)
{
  mm3::Prescribed_displacements displacements;
  for(mm3::Vertex_index v : mm3::boundary_vertices(mesh))
    if(const auto u = boundary(mm3::to_vec3(mesh.point(v))))
      displacements[v] = *u;
  return displacements;
}

double cpu_seconds_since(std::clock_t start) { return double(std::clock() - start) / CLOCKS_PER_SEC; }

// Adapts a mesh to one load, like brain_shift: with a Poisson's ratio at which standard elements do not lock.
nlohmann::ordered_json adapt(Mesh& mesh, const Boundary_displacement& load, mm3::Elastic_material material)
{
  material.poisson_ratio = (std::min)(material.poisson_ratio, 0.3);
  const std::clock_t start = std::clock();
  const CGAL::Mixed_mesh_adaptation_result_3 result = CGAL::adapt_mixed_mesh_3(
    mesh, {material}, {prescribed_displacements(mesh, load)});
  return {{"status", mm3::description(result.status)},
          {"steps", result.number_of_steps},
          {"solves", result.number_of_solves},
          {"energy after / before", result.functional},
          {"worst ARC before", result.worst_aspect_ratio_before},
          {"worst ARC after", result.worst_aspect_ratio_after},
          {"CPU seconds", cpu_seconds_since(start)}};
}

// Solves by Linear_elasticity_3, and by standard elements.
std::pair<std::vector<Vector>, std::vector<Vector>>
solve(const Mesh& mesh, const Boundary_displacement& boundary, const mm3::Elastic_material& material)
{
  CGAL::Linear_elasticity_3<Mesh> elasticity(mesh, material);
  std::vector<bool> is_prescribed(mesh.number_of_vertices(), false);
  std::vector<Vector> displacements(mesh.number_of_vertices(), Vector{});
  for(const auto& [v, u] : prescribed_displacements(mesh, boundary)) {
    elasticity.prescribe(v, u);
    is_prescribed[v] = true;
    displacements[v] = u;
  }
  auto result = elasticity.factor();
  if(result.is_success())
    result = elasticity.solve();
  if(!result.is_success())
    throw std::runtime_error(result.description());
  return {elasticity.displacements(), standard_solution(mesh, material, is_prescribed, displacements)};
}

// Checks springs with a solution that is known: a boundary whose springs rest in a rigid motion moves
// rigidly. The springs of a triangle resist a translation by stiffness times area.
void check_springs(const Mesh& mesh, const mm3::internal::Element_nodes& nodes,
                   const mm3::Elastic_material& material)
{
  const auto motion = [](const Vector& p) { return Vector{1, 2, -3} + cross(Vector{0.01, -0.02, 0.03}, p); };
  const Springs rigid = [&](const Vector& p) {
    const double stiffness = 1 + 0.5 * std::sin(0.05 * p[0]);
    return Spring{stiffness, stiffness * motion(p)};
  };
  const std::vector<Vector> values = solve_with_springs(mesh, nodes, material, rigid);
  double largest = 0;
  for(std::size_t i = 0; i < values.size(); ++i)
    largest = (std::max)(largest, norm(i < mesh.number_of_vertices()
                                         ? values[i] - motion(mm3::to_vec3(mesh.point(mm3::Vertex_index(i))))
                                         : values[i]));
  BOOST_TEST_LT(largest, 1e-8);
  const Springs uniform = [](const Vector&) { return Spring{2, Vector{}}; };
  for_each_face_with_springs(uniform, mesh, [&](const Springs_of_face& of_face, const mm3::Face& face) {
    if(face.vertices().size() == 3)
      BOOST_TEST_LT(std::abs(of_face.matrix.topLeftCorner(3, 3).sum() / mm3::area(mesh, face) - 2), 1e-12);
  });
}

// A region, and the points of comparison in the region.
struct Test_case
{
  Opening opening;
  CGAL::Surface_mesh<Kernel::Point_3> region;
  std::vector<Vector> points;
  std::vector<bool> is_in_tumor; // of points
  std::vector<std::pair<std::string, Boundary_displacement>> loads;
  Springs springs; // a third load

  Test_case(const Opening& o, const std::string& work, const Brain& brain,
            const CGAL::Polyhedral_mixed_mesh_region_3& inside_brain)
    : opening(o), loads{{"bump", bump_displacement(o, brain)}, {"smooth", smooth_displacement(o)}},
      springs(::springs(o, brain))
  {
    require([&](std::string* error) {
      return mm3::IO::read_closed_surface(work + "/regions/" + o.name + ".off", region, error);
    });
    points = points_to_compare(inside_brain, region, number_of_points, least_depth);
    for(const Vector& p : points)
      is_in_tumor.push_back(norm(p - o.tumor) < o.tumor_radius);
  }
};

std::string reference_file(const std::string& work, const Test_case& c, const std::string& load)
{
  return work + "/ref/" + c.opening.name + "_" + load + ".txt";
}

void write_reference(const std::string& file, const std::vector<Vector>& values)
{
  std::ofstream out(file);
  out.precision(17);
  for(const Vector& u : values)
    out << u[0] << ' ' << u[1] << ' ' << u[2] << '\n';
  if(!out)
    throw std::runtime_error(file + ": cannot be written");
}

std::vector<Vector> read_reference(const std::string& file)
{
  std::ifstream in(file);
  std::vector<Vector> values(number_of_points);
  for(Vector& u : values)
    in >> u[0] >> u[1] >> u[2];
  if(!in)
    throw std::runtime_error(file + ": no reference there: make it by --reference-mesh");
  return values;
}

// Makes the references. All loads that prescribe the whole boundary share a matrix.
void make_references(const std::string& mesh_file, const std::string& work,
                     const std::vector<Test_case>& cases, const mm3::Elastic_material& material)
{
  Mesh mesh;
  require([&](std::string* error) { return mm3::IO::read_mixed_mesh(mesh_file, mesh, error); });
  Quadratic_reference quadratic(mesh, material);
  std::cerr << mesh_file << ": " << quadratic.number_of_nodes() << " nodes\n";
  std::vector<Boundary_displacement> smooth_loads;
  for(const Test_case& c : cases)
    smooth_loads.push_back(smooth_displacement(c.opening));
  const auto smooth = quadratic.solve(smooth_loads);
  for(std::size_t i = 0; i < cases.size(); ++i)
    write_reference(reference_file(work, cases[i], "smooth"), quadratic.at(cases[i].points, smooth[i]));
  for(const Test_case& c : cases) {
    const auto bump = quadratic.solve({c.loads.front().second});
    write_reference(reference_file(work, c, "bump"), quadratic.at(c.points, bump.front()));
    write_reference(reference_file(work, c, "springs"), quadratic.at(c.points, quadratic.solve(c.springs)));
  }
}

// Solves by Linear_elasticity_3 with displacements of order 1, 2, or 2 in the region, and measures times.
struct Solution_of_order
{
  const Mesh& mesh;
  CGAL::Linear_elasticity_3<Mesh> model;
  mm3::internal::Element_nodes nodes;
  double factor_time = 0, solution_time = 0; // CPU seconds
  std::vector<Vector> values;                // of the nodes: displacements, then coefficients of edges

  Solution_of_order(const Mesh& m, const std::string& order, const mm3::Elastic_material& material)
    : mesh(m), model(m, material), nodes(mesh.elements(), mesh.number_of_vertices())
  {
    constexpr double width = 4; // mm around the region, as in brain_shift
    if(order == "region")
      model.order_2_within(width);
    else
      model.order(std::stoi(order));
    nodes = nodes_of(model);
  }

  void solve(const Springs& springs, const mm3::Elastic_material& material)
  {
    values = solve_with_springs(mesh, nodes, material, springs);
  }

  // The time of a solution is that for new displacements of the supports, without a new factorization: the
  // least of several, as the first one touches new memory.
  void solve(const Boundary_displacement& boundary)
  {
    model.prescribe_boundary(boundary);
    std::clock_t start = std::clock();
    auto result = model.factor();
    factor_time = cpu_seconds_since(start);
    const auto supports = prescribed_displacements(mesh, boundary);
    for(int i = 0; i < 5 && result.is_success(); ++i) {
      model.set_support_displacement(supports.begin()->first, supports.begin()->second);
      start = std::clock();
      result = model.solve();
      const double time = cpu_seconds_since(start);
      solution_time = i == 0 ? time : (std::min)(solution_time, time);
    }
    if(!result.is_success())
      throw std::runtime_error(result.description());
    values = model.displacements();
    values.insert(values.end(), model.edge_coefficients().begin(), model.edge_coefficients().end());
  }

  std::vector<Vector> at(const std::vector<mm3::Element_location_3>& points) const
  {
    std::vector<Vector> result;
    for(const mm3::Element_location_3& l : points) {
      Vector u{};
      for(const auto& [node, weight] :
          mm3::internal::node_weights(mesh.element(l.element), nodes[l.element], l))
        u = u + weight * values[node];
      result.push_back(u);
    }
    return result;
  }
};

double share_of_vertices_in_region(const Mesh& mesh, const Test_case& c)
{
  const CGAL::Polyhedral_mixed_mesh_region_3 inside_region(c.region);
  std::size_t inside = 0;
  for(const auto& p : mesh.points())
    inside += inside_region.depth({p.x(), p.y(), p.z()}) > 0;
  return double(inside) / double(mesh.number_of_vertices());
}

nlohmann::ordered_json measure(const std::string& file, const std::string& work, const Test_case& c,
                               const mm3::Elastic_material& material, bool is_adapted,
                               const std::vector<std::string>& orders)
{
  Mesh mesh;
  require([&](std::string* error) { return mm3::IO::read_mixed_mesh(file, mesh, error); });
  const nlohmann::ordered_json adaptation = is_adapted ? adapt(mesh, c.loads.front().second, material)
                                                       : nlohmann::ordered_json();
  const std::vector<mm3::Vertex_index> boundary = mm3::boundary_vertices(mesh);
  nlohmann::ordered_json line{{"mesh", file},
                              {"region", c.opening.name},
                              {"vertices", mesh.number_of_vertices()},
                              {"elements", mesh.number_of_elements()},
                              {"share of vertices in region", share_of_vertices_in_region(mesh, c)},
                              {"boundary vertices in patch",
                               std::count_if(boundary.begin(), boundary.end(), [&](mm3::Vertex_index v) {
                                 return is_in_patch(mm3::to_vec3(mesh.point(v)), c.opening);
                               })}};
  if(is_adapted)
    line["adaptation"] = adaptation;
  const std::vector<bool> everywhere(c.points.size(), true);
  const mm3::Element_locator_3<Mesh> locator(mesh);
  std::vector<mm3::Element_location_3> points;
  for(const Vector& p : c.points)
    points.push_back(locator.nearest(p));
  const auto add = [&](const std::string& load, const std::vector<Vector>& ours,
                       const std::vector<Vector>& standard, const auto& solve_in_order) {
    const std::vector<Vector> exact = read_reference(reference_file(work, c, load));
    nlohmann::ordered_json& of_load = line[load];
    of_load["rms displacement, mm"] = root_mean_square(exact, everywhere);
    const auto add_errors = [&](nlohmann::ordered_json& to, const std::string& key,
                                const std::vector<Vector>& u) {
      to[key] = relative_error(u, exact, everywhere);
      to[key + " in tumor"] = relative_error(u, exact, c.is_in_tumor);
    };
    add_errors(of_load, "error", at_points(mesh, ours, points));
    add_errors(of_load, "error of standard elements", at_points(mesh, standard, points));
    add_errors(of_load, "error of recovered displacements", recovered_at_points(mesh, ours, points));
    for(const std::string& order : orders) {
      Solution_of_order solution(mesh, order, material);
      if(load == "springs")
        check_springs(mesh, solution.nodes, material);
      solve_in_order(solution);
      nlohmann::ordered_json& to = of_load["orders"][order];
      to["nodes"] = solution.nodes.number_of_nodes();
      add_errors(to, "error", solution.at(points));
      if(solution.factor_time > 0) {
        to["factor, CPU seconds"] = solution.factor_time;
        to["solution, CPU seconds"] = solution.solution_time;
      }
    }
  };
  for(const auto& [name, load] : c.loads) {
    const auto [ours, standard] = solve(mesh, load, material);
    add(name, ours, standard, [&, &load = load](Solution_of_order& s) { s.solve(load); });
  }
  const mm3::internal::Element_nodes vertices(mesh.elements(), mesh.number_of_vertices());
  add("springs", solve_with_springs(mesh, vertices, material, c.springs),
      standard_solution_with_springs(mesh, material, c.springs),
      [&](Solution_of_order& s) { s.solve(c.springs, material); });
  return line;
}

} // namespace

int main(int argc, char* argv[])
{
  std::string surface, openings_file, work, reference_mesh;
  std::vector<std::string> names, files, orders;
  mm3::Elastic_material material;
  CLI::App app{"Measures the error of brain shift in regions of interest, on meshes from files."};
  app.add_option("surface", surface, "closed surface of the brain")->required();
  app.add_option("openings", openings_file, "openings.json")->required();
  app.add_option("work", work, "has regions/NAME.off and the references, ref/NAME_{bump,smooth,springs}.txt")
    ->required();
  app.add_option("meshes", files, ".vtu or .msh");
  app.add_option("--regions", names, "names of openings (default: all)");
  app.add_option("--poisson-ratio", material.poisson_ratio, "")->capture_default_str();
  app.add_option("--reference-mesh", reference_mesh, "tetrahedra to make the references from");
  app.add_option("--orders", orders, "of displacements, to be measured in addition")
    ->check(CLI::IsMember({"1", "2", "region"}));
  bool is_adapted = false;
  app.add_flag("--adapt", is_adapted, "adapts each mesh to the bump first");
  CLI11_PARSE(app, argc, argv);
  try {
    const Brain brain(surface);
    const CGAL::Polyhedral_mixed_mesh_region_3 inside_brain(brain.surface);
    std::vector<Test_case> cases;
    for(const Opening& o : read_openings(openings_file))
      if(names.empty() || std::find(names.begin(), names.end(), o.name) != names.end())
        cases.emplace_back(o, work, brain, inside_brain);
    if(!reference_mesh.empty())
      make_references(reference_mesh, work, cases, material);
    for(const Test_case& c : cases)
      for(const std::string& file : files)
        std::cout << measure(file, work, c, material, is_adapted, orders) << std::endl;
  } catch(const std::exception& e) {
    std::cerr << "measure_accuracy: error: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
  return boost::report_errors();
}
