// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes the brain in tetrahedra of order 2, as Abaqus has them, and its displacements of order 2 under a
// push at the opening, for test_order_2_elsewhere.py.
//
//   solve_order_2 DATA_DIRECTORY VERTICES POISSON_RATIO FILE.inp FILE.txt

#include "test_surfaces.h"

#include <CGAL/Linear_elasticity_3.h>
#include <CGAL/Mixed_mesh_3/IO/INP.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/split_to_tetrahedra.h>
#include <CGAL/make_mixed_mesh_3.h>

#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <iostream>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace {

using namespace CGAL::Mixed_meshes_3;
using Mesh = CGAL::Mixed_mesh_3<Test_kernel>;

Test_surface read_surface(const std::string& path)
{
  Test_surface surface;
  BOOST_TEST(CGAL::IO::read_polygon_mesh(path, surface));
  return surface;
}

Mesh brain(const std::string& data, std::size_t vertices)
{
  const CGAL::Polyhedral_mixed_mesh_region_3 region(read_surface(data + "/region.off"));
  const CGAL::Polyhedral_mixed_mesh_domain_3 domain(read_surface(data + "/brain.off"));
  Mesh mesh;
  BOOST_TEST(CGAL::make_mixed_mesh_3(domain, region, CGAL::Mixed_mesh_criteria_3(vertices), mesh).has_mesh());
  return split_to_tetrahedra(mesh);
}

// The edges of the boundary, the smaller end first.
std::set<std::array<Vertex_index, 2>> boundary_edges(const Mesh& mesh)
{
  std::set<std::array<Vertex_index, 2>> edges;
  for(const Face& face : boundary_faces(mesh))
    for(int i = 0; i < face.vertices().size(); ++i) {
      const auto [a,
                  b] = std::minmax({face.vertices()[i], face.vertices()[(i + 1) % face.vertices().size()]});
      edges.insert({a, b});
    }
  return edges;
}

} // namespace

int main(int argc, char** argv)
{
  if(argc != 6) {
    std::cerr << "usage: solve_order_2 DATA_DIRECTORY VERTICES POISSON_RATIO FILE.inp FILE.txt\n";
    return 2;
  }
  const Mesh mesh = brain(argv[1], std::stoul(argv[2]));
  const std::size_t n = mesh.number_of_vertices();
  std::vector<Vec3> points;
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for(const auto& p : mesh.points()) {
    points.push_back(to_vec3(p));
    lowest = (std::min)(lowest, points.back()[2]);
    highest = (std::max)(highest, points.back()[2]);
  }

  // The lower 30 % is fixed; around the opening, the boundary is pushed in by 10 mm, less toward the rim.
  const auto push = [&](const Vec3& p) -> std::optional<Vec3> {
    const Vec3 opening{44, 30, 75};
    const double r = norm(p - opening) / 30;
    if(p[2] < lowest + 0.3 * (highest - lowest))
      return Vec3{};
    if(r < 1)
      return (-10 * (1 - r * r) * (1 - r * r) / norm(opening)) * opening;
    return std::nullopt;
  };
  CGAL::Linear_elasticity_3<Mesh> problem(mesh, Elastic_material{1, std::stod(argv[3])});
  problem.order(2);
  problem.prescribe_boundary(push);
  BOOST_TEST(problem.factor().is_success());
  BOOST_TEST(problem.solve().is_success());
  std::vector<Vec3> displacements = problem.displacements();
  const std::vector<Vec3> middles = problem.middle_displacements();
  displacements.insert(displacements.end(), middles.begin(), middles.end());

  // The prescribed nodes: also middles of edges of the boundary, whether both ends are or not.
  std::vector<bool> is_prescribed(n + middles.size(), false);
  for(Vertex_index v : boundary_vertices(mesh))
    is_prescribed[v] = push(points[v]).has_value();
  const auto edges = boundary_edges(mesh);
  for(std::size_t i = 0; i < middles.size(); ++i) {
    const auto& [a, b] = problem.quadratic_edges()[i];
    points.push_back(0.5 * (points[a] + points[b]));
    is_prescribed[n + i] = edges.count({a, b}) != 0 && push(points.back()).has_value();
  }

  std::ofstream inp(argv[4]);
  BOOST_TEST(IO::write_INP(inp, mesh, {}, {}, 2));
  std::ofstream out(argv[5]);
  out.precision(17);
  for(std::size_t node = 0; node < points.size(); ++node) {
    out << is_prescribed[node];
    for(double x : points[node])
      out << ' ' << x;
    for(double x : is_prescribed[node] ? *push(points[node]) : Vec3{})
      out << ' ' << x;
    for(double x : displacements[node])
      out << ' ' << x;
    out << '\n';
  }
  return boost::report_errors();
}
