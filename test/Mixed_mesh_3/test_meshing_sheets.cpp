// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sheets inside domains: faces of the mesh are on sheets, between two sides; and slits along the faces.

#include "test_meshing.h"

#include <CGAL/Labeled_polyhedral_mixed_mesh_domain_3.h>
#include <CGAL/Mixed_mesh_3/interfaces.h>
#include <CGAL/Mixed_mesh_3/sheets.h>
#include <CGAL/Mixed_mesh_3/split_along_faces.h>

#include <boost/core/lightweight_test.hpp>

#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <utility>
#include <vector>

using Domain = CGAL::Labeled_polyhedral_mixed_mesh_domain_3;

namespace test_meshing_sheets {

// A grid of n x n squares, moved from the unit square by a function.
Surface grid(int n, const std::function<Point_3(double, double)>& place)
{
  Surface s;
  std::vector<Surface::Vertex_index> v;
  for(int j = 0; j <= n; ++j)
    for(int i = 0; i <= n; ++i)
      v.push_back(s.add_vertex(place(double(i) / n, double(j) / n)));
  const auto at = [&](int i, int j) { return v[std::size_t(j * (n + 1) + i)]; };
  for(int j = 0; j < n; ++j)
    for(int i = 0; i < n; ++i) {
      s.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      s.add_face(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  return s;
}

// The part of the plane a x + b y + z = c above a square.
Surface plane(double a, double b, double c, double from, double to, int n = 4)
{
  return grid(n, [=](double s, double t) {
    const double x = from + s * (to - from), y = from + t * (to - from);
    return Point_3(x, y, c - a * x - b * y);
  });
}

// Components of elements connected by faces.
std::vector<std::size_t> components(const Mesh& mesh)
{
  std::vector<std::size_t> parent(mesh.number_of_elements());
  std::iota(parent.begin(), parent.end(), std::size_t(0));
  const auto root = [&](std::size_t e) {
    while(parent[e] != e)
      e = parent[e];
    return e;
  };
  internal::for_each_face(mesh.elements(), mesh.number_of_vertices(), [&](const auto& group) {
    if(group.size() == 2)
      parent[root(group.element(0))] = root(group.element(1));
  });
  for(std::size_t e = 0; e < parent.size(); ++e)
    parent[e] = root(e);
  return parent;
}

std::map<std::size_t, double> volumes(const Mesh& mesh)
{
  const std::vector<std::size_t> of = components(mesh);
  std::map<std::size_t, double> result;
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
    result[of[e]] += volume(mesh, e);
  return result;
}

// The Euler characteristic V - E + F of the boundary.
int euler_characteristic(const Mesh& mesh)
{
  const std::vector<Face> faces = boundary_faces(mesh);
  std::set<std::pair<Vertex_index, Vertex_index>> edges;
  for(const Face& face : faces)
    for(int i = 0; i < face.vertices().size(); ++i)
      edges.insert(std::minmax(face.vertices()[i], face.vertices()[(i + 1) % face.vertices().size()]));
  return int(vertices_of(faces).size()) - int(edges.size()) + int(faces.size());
}

// Checks conditions that hold for any sheet; returns the sheet.
Sheet_in_mesh check_sheet(const Mesh& mesh, const Domain& domain, const Mixed_mesh_result_3& result)
{
  const Sheet_in_mesh sheet = find_sheets(mesh, domain)[0];
  BOOST_TEST_EQ(sheet.number_of_bad_edges, 0u);
  BOOST_TEST_LE(sheet.number_of_vertices_off, result.optimization.number_of_boundary_vertices
                                                - result.optimization.number_of_arrived_vertices);
  const std::vector<Face> boundary = boundary_faces(mesh);
  const std::set<Face> outside(boundary.begin(), boundary.end());
  for(const Face& face : sheet.faces)
    BOOST_TEST(outside.count(face) == 0);
  return sheet;
}

Mixed_mesh_result_3 mesh_domain(const Domain& domain, std::size_t n, Mesh& mesh)
{
  return run(domain, CGAL::Everywhere_mixed_mesh_region_3(), Mixed_mesh_criteria_3(n), mesh);
}

// Slits all faces, and checks conditions that hold for any slit. \return the slit
Slit slit(Mesh& mesh, const std::vector<Face>& faces)
{
  const Mesh before = mesh;
  const Slit slit = split_along_faces(mesh, faces);
  const Mesh_defects d = find_defects(mesh);
  BOOST_TEST(d.conforming() && d.positive() && d.closed_manifold_boundary());
  BOOST_TEST_EQ(d.duplicate_vertices, slit.origins.size());
  BOOST_TEST_EQ(mesh.number_of_vertices(), before.number_of_vertices() + slit.origins.size());
  for(std::size_t i = 0; i < slit.origins.size(); ++i)
    BOOST_TEST(mesh.point(Vertex_index(before.number_of_vertices() + i)) == before.point(slit.origins[i]));
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
    for(int i = 0; i < mesh.element(e).size(); ++i)
      BOOST_TEST(mesh.point(mesh.element(e)[i]) == before.point(before.element(e)[i]));
  BOOST_TEST_EQ(boundary_faces(mesh).size(), boundary_faces(before).size() + 2 * slit.faces.size());
  BOOST_TEST_EQ(faces.size(), slit.faces.size() + slit.number_of_faces_left);
  for(const auto& [front, behind] : slit.faces) {
    BOOST_TEST(front.element() != behind.element());
    BOOST_TEST_LE(std::abs(area(mesh, front) - area(mesh, behind)), 1e-12 * area(mesh, front));
  }
  return slit;
}

// A ball of radius 1 cut by the plane at a height: the area of the disc, and the volumes of both sides.
void test_cut_ball()
{
  const Surface ball = sphere({0, 0, 0}, 1, 16);
  for(double height : {0.13, -0.4}) {
    Domain domain;
    domain.add(ball, 1);
    const double a = 0.2, b = -0.35;
    domain.add_sheet(plane(a, b, height * std::sqrt(1 + a * a + b * b), -2, 2));
    Mesh mesh;
    const Mixed_mesh_result_3 result = mesh_domain(domain, 1500, mesh);
    const auto& fit = result.optimization;
    const bool all_arrived = fit.number_of_arrived_vertices == fit.number_of_boundary_vertices;
    BOOST_TEST(result.status == (all_arrived ? Status::SUCCESS : Status::NOT_ALL_ARRIVED));
    const Sheet_in_mesh sheet = check_sheet(mesh, domain, result);
    const double disc = CGAL_PI * (1 - height * height);
    BOOST_TEST_LE(std::abs(area_inside(*domain.sheets()[0], domain) / disc - 1), 0.04);
    BOOST_TEST_LE(std::abs(sheet.area / disc - 1), 0.06);
    BOOST_TEST_EQ(volumes(mesh).size(), 1u);
    BOOST_TEST_EQ(find_sheet_faces(mesh).size(), sheet.faces.size());
    double reversed = 0; // area seen from in front, except where a vertex has not arrived
    for(const Face& face : sheet.faces)
      if(const Vec3 n = vector_area(mesh, face); n[0] * a + n[1] * b + n[2] >= 0)
        reversed += norm(n);
    BOOST_TEST_LE(reversed, 0.01 * sheet.area);

    const double whole = volume(mesh);
    const Slit s = slit(mesh, sheet.faces);
    BOOST_TEST_EQ(s.origins.size(), vertices_of(sheet.faces).size());
    BOOST_TEST_EQ(s.number_of_faces_left, 0u);
    const std::map<std::size_t, double> sides = volumes(mesh);
    BOOST_TEST_EQ(sides.size(), 2u);
    BOOST_TEST_EQ(euler_characteristic(mesh), 4);
    const double cap = CGAL_PI * (1 - height) * (1 - height) * (2 + height) / 3 / (4. / 3 * CGAL_PI) * whole;
    double nearest = whole;
    for(const auto& [component, v] : sides)
      nearest = (std::min)(nearest, std::abs(v - cap));
    BOOST_TEST_LE(nearest, 0.03 * whole);
  }
}

// A sheet that ends inside: a notch of the boundary when the sheet is slit, or a cavity without volume.
void test_ends_inside()
{
  for(bool reaches_boundary : {true, false}) {
    Domain domain;
    domain.add(box({0, 0, 0}, {4, 4, 4}), 1);
    const double width = reaches_boundary ? 5 : 2.6;
    domain.add_sheet(grid(6, [&](double s, double t) {
      return Point_3(2.1 + 0.1 * s, 2 + width * (s - 0.5),
                     reaches_boundary ? 1.9 + 3 * t : 2 + width * (t - 0.5));
    }));
    Mesh mesh;
    const Mixed_mesh_result_3 result = mesh_domain(domain, 1500, mesh);
    const Sheet_in_mesh sheet = check_sheet(mesh, domain, result);
    const double inside = area_inside(*domain.sheets()[0], domain);
    BOOST_TEST_LE(std::abs(sheet.area / inside - 1), 0.15);
    std::set<Vertex_index> of_sheet;
    for(Vertex_index v : vertices_of(sheet.faces))
      of_sheet.insert(v);
    const Slit s = slit(mesh, sheet.faces);
    BOOST_TEST_GT(s.origins.size(), 0u);
    BOOST_TEST_LT(s.origins.size(), of_sheet.size()); // the rim stays single
    BOOST_TEST_EQ(volumes(mesh).size(), 1u);
    BOOST_TEST_EQ(euler_characteristic(mesh), reaches_boundary ? 2 : 4);
  }
}

// The cap of a sphere in a ball, with several subdomains.
void test_curved()
{
  Domain domain;
  domain.add(sphere({0.3, 0, 0}, 0.45, 12), 2);
  domain.add(sphere({0, 0, 0}, 1, 16), 1);
  const double r = 1.5;
  domain.add_sheet(grid(20, [&](double s, double t) {
    const double x = 2.4 * (s - 0.5), y = 2.4 * (t - 0.5);
    return Point_3(x, y, std::sqrt((std::max)(r * r - x * x - y * y, 0.)) - r + 0.2);
  }));
  Mesh mesh;
  const Mixed_mesh_result_3 result = mesh_domain(domain, 4000, mesh);
  const Sheet_in_mesh sheet = check_sheet(mesh, domain, result);
  BOOST_TEST_LE(double(sheet.number_of_vertices_off), 0.15 * double(sheet.number_of_vertices));
  BOOST_TEST_LE(std::abs(sheet.area / area_inside(*domain.sheets()[0], domain) - 1), 0.1);
  std::set<Subdomain_index> met;
  for(const Face& face : sheet.faces)
    met.insert(mesh.subdomain_index(face.element()));
  BOOST_TEST_EQ(met.size(), 2u);
  for(const Subdomain_interface& i : find_interfaces(mesh))
    BOOST_TEST(i.is_manifold());
}

// Two sheets that meet in a line: a vertex there has three sides.
void test_two_sheets()
{
  Domain domain;
  domain.add(sphere({0, 0, 0}, 1, 16), 1);
  domain.add_sheet(plane(0.1, 0, 0, -2, 2));
  domain.add_sheet(grid(4, [](double s, double t) { return Point_3(0.05, 4 * s - 2, 2 * t - 0.02); }));
  Mesh mesh;
  mesh_domain(domain, 2000, mesh);
  const std::vector<Sheet_in_mesh> sheets = find_sheets(mesh, domain);
  BOOST_TEST_EQ(sheets.size(), 2u);
  BOOST_TEST_LE(std::abs(sheets[0].area / CGAL_PI - 1), 0.1);
  BOOST_TEST_LE(std::abs(sheets[1].area / (CGAL_PI / 2) - 1), 0.25);
  BOOST_TEST_EQ(sheets[0].faces.size() + sheets[1].faces.size(), find_sheet_faces(mesh).size());
}

void test_outside()
{
  Domain without, with;
  for(Domain* d : {&without, &with})
    d->add(sphere({0, 0, 0}, 1, 8), 1);
  with.add_sheet(plane(0, 0, 5, -1, 1));
  Mesh a, b;
  const Mixed_mesh_result_3 first = mesh_domain(without, 500, a), second = mesh_domain(with, 500, b);
  BOOST_TEST_EQ(first.number_of_lost_sheets, 0u);
  BOOST_TEST_EQ(second.number_of_lost_sheets, 1u);
  BOOST_TEST(first.status != Status::PARTS_LOST);
  BOOST_TEST(second.status == Status::PARTS_LOST);
  BOOST_TEST(find_defects(b).none());
  BOOST_TEST(find_sheet_faces(b).empty());
}

// Any plane, any rim: the mesh is valid, and its sheet vertices are on the sheet.
void test_random()
{
  std::mt19937 random(3);
  std::uniform_real_distribution<> number(-1, 1);
  const Surface ball = sphere({0, 0, 0}, 1, 12);
  for(int i = 0; i < 6; ++i) {
    const Vec3 o{number(random), number(random), number(random)},
      u{number(random), number(random), number(random)}, v{number(random), number(random), number(random)},
      w = cross(u, v);
    Domain domain;
    domain.add(ball, 1);
    domain.add_sheet(grid(5, [&](double s, double t) {
      const Vec3 p = 0.3 * o + ((2 * s - 1) * u + ((2 * t - 1) * v + (0.2 * std::sin(3 * s + 2 * t)) * w));
      return Point_3(p[0], p[1], p[2]);
    }));
    Mesh mesh;
    const Mixed_mesh_result_3 result = mesh_domain(domain, 600, mesh);
    const Sheet_in_mesh sheet = check_sheet(mesh, domain, result);
    slit(mesh, sheet.faces);
  }
}

int run(int, char*[])
{
  test_cut_ball();
  test_ends_inside();
  test_curved();
  test_two_sheets();
  test_outside();
  test_random();
  return boost::report_errors();
}

} // namespace test_meshing_sheets
