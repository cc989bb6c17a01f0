// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes the brain's mesh and its displacements under a push at the opening, for test_getfem.py: with the
// elements of Linear_elasticity_3, with standard ones, and on the mesh split to tetrahedra with both. A tumor
// is a subdomain, ten times as stiff, and of another Poisson's ratio.
//
//   solve_brain DATA_DIRECTORY VERTICES POISSON_RATIO fitted|unfitted|tumor FILE

#include "standard_elasticity.h"
#include "test_surfaces.h"

#include <CGAL/Labeled_polyhedral_mixed_mesh_domain_3.h>
#include <CGAL/Linear_elasticity_3.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/split_to_tetrahedra.h>
#include <CGAL/make_mixed_mesh_3.h>

#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

namespace {

using namespace CGAL::Mixed_meshes_3;
using namespace CGAL::Mixed_meshes_3::internal;
using Mesh = CGAL::Mixed_mesh_3<Test_kernel>;
using Field = std::vector<Vec3>;

constexpr Subdomain_index tumor_index = 1, brain_index = 2;

Test_surface read_surface(const std::string& path)
{
  Test_surface surface;
  BOOST_TEST(CGAL::IO::read_polygon_mesh(path, surface));
  return surface;
}

Mesh brain(const std::string& data, std::size_t vertices, const std::string& how)
{
  const CGAL::Polyhedral_mixed_mesh_region_3 region(read_surface(data + "/region.off"));
  const auto criteria = CGAL::Mixed_mesh_criteria_3(vertices).fit_to_surface(how != "unfitted");
  Mesh mesh;
  if(how == "tumor") {
    CGAL::Labeled_polyhedral_mixed_mesh_domain_3 domain;
    domain.add(read_surface(data + "/tumour.off"), tumor_index);
    domain.add(read_surface(data + "/brain.off"), brain_index);
    BOOST_TEST(CGAL::make_mixed_mesh_3(domain, region, criteria, mesh).has_mesh());
  } else {
    const CGAL::Polyhedral_mixed_mesh_domain_3 domain(read_surface(data + "/brain.off"));
    BOOST_TEST(CGAL::make_mixed_mesh_3(domain, region, criteria, mesh).has_mesh());
  }
  return mesh;
}

std::vector<Elastic_material> materials_of(const Mesh& mesh, const Elastic_material& material, bool has_tumor)
{
  if(!has_tumor)
    return materials_of_elements(mesh, {}, material);
  return materials_of_elements(mesh, {{tumor_index, {10, material.poisson_ratio / 2}}}, material);
}

Field solution(const Mesh& mesh, const std::vector<Elastic_material>& materials,
               const std::vector<bool>& is_prescribed, const Field& u)
{
  CGAL::Linear_elasticity_3<Mesh> problem(mesh, materials);
  for(Vertex_index v = 0; v < u.size(); ++v)
    if(is_prescribed[v])
      problem.prescribe(v, u[v]);
  const auto factored = problem.factor();
  const auto solved = factored.is_success() ? problem.solve() : factored;
  if(!solved.is_success())
    std::cout << solved.description() << '\n';
  return problem.displacements();
}

void write(std::ostream& out, const char* name, const Field& u)
{
  out << name << ' ' << u.size() << '\n';
  for(const Vec3& x : u)
    out << x[0] << ' ' << x[1] << ' ' << x[2] << '\n';
}

} // namespace

int main(int argc, char** argv)
{
  if(argc != 6) {
    std::cerr << "usage: solve_brain DATA_DIRECTORY VERTICES POISSON_RATIO fitted|unfitted|tumor FILE\n";
    return 2;
  }
  const bool has_tumor = std::string(argv[4]) == "tumor";
  const Mesh mesh = brain(argv[1], std::stoul(argv[2]), argv[4]);
  const Elastic_material material{1, std::stod(argv[3])};
  const std::vector<Elastic_material> materials = materials_of(mesh, material, has_tumor);

  // The lower 30 % is fixed; around the opening, the boundary is pushed in by 10 mm, less toward the rim.
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  Field points;
  for(const auto& p : mesh.points()) {
    points.push_back(to_vec3(p));
    lowest = (std::min)(lowest, points.back()[2]);
    highest = (std::max)(highest, points.back()[2]);
  }
  const Vec3 opening{44, 30, 75};
  const double radius = 30;
  std::vector<bool> is_prescribed(points.size(), false);
  Field u(points.size(), Vec3{});
  for(Vertex_index v = 0; v < points.size(); ++v)
    is_prescribed[v] = points[v][2] < lowest + 0.3 * (highest - lowest);
  std::size_t pushed = 0;
  for(const Face& face : boundary_faces(mesh))
    for(Vertex_index v : face.vertices()) {
      const double r = norm(points[v] - opening) / radius;
      if(r < 1 && !is_prescribed[v]) {
        is_prescribed[v] = true;
        u[v] = (-10 * (1 - r * r) * (1 - r * r) / norm(opening)) * opening;
        ++pushed;
      }
    }
  BOOST_TEST_GT(pushed, 0u);

  std::ofstream out(argv[5]);
  out.precision(17);
  write(out, "points", points);
  out << "elements " << mesh.number_of_elements() << '\n';
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e) {
    out << int(mesh.element(e).kind());
    for(Vertex_index v : mesh.element(e))
      out << ' ' << v;
    out << '\n';
  }
  out << "materials " << materials.size() << '\n';
  for(const Elastic_material& m : materials)
    out << m.young_modulus << ' ' << m.poisson_ratio << '\n';
  out << "prescribed " << std::count(is_prescribed.begin(), is_prescribed.end(), true) << '\n';
  for(Vertex_index v = 0; v < points.size(); ++v)
    if(is_prescribed[v])
      out << v << ' ' << u[v][0] << ' ' << u[v][1] << ' ' << u[v][2] << '\n';
  write(out, "ours", solution(mesh, materials, is_prescribed, u));
  write(out, "standard", standard_solution(mesh, materials, is_prescribed, u));
  write(out, "standard_of_one_material", standard_solution(mesh, material, is_prescribed, u));
  const Mesh tetrahedra = split_to_tetrahedra(mesh);
  const std::vector<Elastic_material> of_tetrahedra = materials_of(tetrahedra, material, has_tumor);
  write(out, "ours_on_tetrahedra", solution(tetrahedra, of_tetrahedra, is_prescribed, u));
  write(out, "standard_on_tetrahedra", standard_solution(tetrahedra, of_tetrahedra, is_prescribed, u));
  return boost::report_errors();
}
