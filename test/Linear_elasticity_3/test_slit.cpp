// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes that are slit along faces: two bodies, or one body whose sides part.

#include "elasticity_test.h"

#include <CGAL/Mixed_mesh_3/split_along_faces.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <vector>

namespace test_slit {

using namespace elasticity_test;

Vec3 middle(const Mesh& mesh, const Element_view& element)
{
  Vec3 sum{};
  for(Vertex_index v : element)
    sum = sum + position(mesh, v);
  return (1. / element.size()) * sum;
}

bool is_left(const Mesh& mesh, Element_index e) { return middle(mesh, mesh.element(e))[0] < 0.5; }

// Faces in the plane x = 1/2, seen from the left.
std::vector<Face> faces_in_plane(const Mesh& mesh, double lowest)
{
  std::vector<Face> faces;
  for_each_face(mesh.elements(), mesh.number_of_vertices(), [&](const auto& group) {
    const Face_vertices v = group[0].vertices();
    if(group.size() == 2 && std::all_of(v.begin(), v.end(), [&](Vertex_index u) {
         return position(mesh, u)[0] == 0.5 && position(mesh, u)[2] >= lowest;
       }))
      faces.push_back(group[is_left(mesh, group.element(0)) ? 0 : 1]);
  });
  return faces;
}

// The elements of one side as a mesh of their own, in the same order.
Mesh side_of(const Mesh& mesh, bool left, std::vector<Vertex_index>& origins)
{
  Mesh side;
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
    if(is_left(mesh, e) == left)
      origins.insert(origins.end(), mesh.element(e).begin(), mesh.element(e).end());
  std::sort(origins.begin(), origins.end());
  origins.erase(std::unique(origins.begin(), origins.end()), origins.end());
  for(Vertex_index v : origins)
    side.add_vertex(mesh.point(v));
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e) {
    if(is_left(mesh, e) != left)
      continue;
    std::vector<Vertex_index> vertices;
    for(Vertex_index v : mesh.element(e))
      vertices.push_back(Vertex_index(std::lower_bound(origins.begin(), origins.end(), v) - origins.begin()));
    side.add_element(mesh.element(e).kind(), vertices);
  }
  return side;
}

// Solves for a body that is held at both ends, and drawn apart.
Field solve(const Mesh& mesh, double& energy)
{
  Elasticity problem(mesh, Elastic_material{3, 0.4});
  prescribe(problem, vertices_where(mesh, [](const Vec3& p) { return p[0] == 0 || p[0] == 1; }),
            [](const Vec3&) { return Vec3{}; });
  std::vector<Vec3> forces;
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
    forces.push_back(is_left(mesh, e) ? Vec3{-1, 0.3, 0} : Vec3{1, 0, 0.2});
  problem.set_body_forces(forces);
  BOOST_TEST(is_success(problem.factor()));
  BOOST_TEST(is_success(problem.solve()));
  energy = problem.energy();
  return problem.displacements();
}

void test_two_bodies(int kind)
{
  Mesh mesh = any_grid(4, kind);
  const Slit slit = split_along_faces(mesh, faces_in_plane(mesh, 0));
  BOOST_TEST_EQ(slit.number_of_faces_left, 0u);
  BOOST_TEST_GE(slit.origins.size(), 25u);
  const Mesh_defects d = find_defects(mesh);
  BOOST_TEST(d.conforming() && d.closed_manifold_boundary() && d.positive());
  double energy = 0, energy_of_sides = 0;
  const Field u = solve(mesh, energy);
  for(bool left : {true, false}) {
    std::vector<Vertex_index> origins;
    const Mesh side = side_of(mesh, left, origins);
    double energy_of_side = 0;
    const Field v = solve(side, energy_of_side);
    energy_of_sides += energy_of_side;
    double most = 0;
    for(std::size_t i = 0; i < origins.size(); ++i)
      most = (std::max)(most, norm(u[origins[i]] - v[i]));
    BOOST_TEST_LT(most, 1e-10 * largest(u));
  }
  BOOST_TEST_LT(std::abs(energy - energy_of_sides), 1e-10 * std::abs(energy));
}

// A body slit down to the middle: the rim stays single, above it the sides part, the farther the higher.
void test_half(int kind)
{
  Mesh mesh = any_grid(4, kind);
  double energy_of_whole = 0, energy = 0;
  solve(mesh, energy_of_whole);
  const std::size_t n = mesh.number_of_vertices();
  const Slit slit = split_along_faces(mesh, faces_in_plane(mesh, 0.5));
  BOOST_TEST_EQ(slit.number_of_faces_left, 0u);
  const Mesh_defects d = find_defects(mesh);
  BOOST_TEST(d.conforming() && d.closed_manifold_boundary() && d.positive());
  const Field u = solve(mesh, energy);
  BOOST_TEST_GT(std::abs(energy), std::abs(energy_of_whole)); // it gives way farther
  double lowest = 1, at_half = 0, at_top = 0;
  std::set<Vertex_index> left;
  for(const auto& [front, behind] : slit.faces)
    left.insert(front.vertices().begin(), front.vertices().end());
  for(std::size_t i = 0; i < slit.origins.size(); ++i) {
    const Vertex_index a = slit.origins[i], b = Vertex_index(n + i);
    const double gap = (left.count(a) > 0 ? 1 : -1) * (u[b][0] - u[a][0]), z = position(mesh, a)[2];
    BOOST_TEST_GT(gap, 0);
    lowest = (std::min)(lowest, z);
    if(z == 0.75)
      at_half = (std::max)(at_half, gap);
    if(z == 1)
      at_top = (std::max)(at_top, gap);
  }
  BOOST_TEST_GT(lowest, 0.5);
  BOOST_TEST_GT(at_top, at_half);
}

int run(int, char*[])
{
  for(int kind = 0; kind <= number_of_element_kinds; ++kind) {
    test_two_bodies(kind);
    test_half(kind);
  }
  return boost::report_errors();
}

} // namespace test_slit
