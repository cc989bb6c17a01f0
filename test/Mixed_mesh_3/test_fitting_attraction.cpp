// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Attraction of boundary vertices: remembered distances compared with new measurements; distances of samples,
// compared with all triangles.

#include "test_fitting.h"
#include "test_strata.h"

#include <CGAL/Mixed_mesh_3/internal/fitting/Surface_projection.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Working_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/surface_attraction.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/surface_targets.h>
#include <CGAL/Polyhedral_mixed_mesh_domain_3.h>

#include <CGAL/squared_distance_3.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <utility>
#include <vector>

namespace test_fitting_attraction {

using namespace CGAL::Mixed_meshes_3;
using CGAL::Polyhedral_mixed_mesh_domain_3;
using internal::Surface_attraction;
using internal::Working_mesh;
using Project = internal::Surface_projection;

const Vec3 center{0.5, 0.5, 0.5};
constexpr double radius = 0.8;

// A cube of elements of one kind, with its boundary vertices on a sphere.
Mesh inscribed(Element_kind kind, int n)
{
  Mesh mesh = grid(n, kind);
  const std::vector<bool> is_boundary = is_on_boundary(mesh);
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
    if(is_boundary[v]) {
      const Vec3 d = to_vec3(mesh.point(v)) - center;
      const Vec3 p = center + (radius / norm(d)) * d;
      mesh.points()[v] = {p[0], p[1], p[2]};
    }
  return mesh;
}

Test_point point(const Vec3& p) { return {p[0], p[1], p[2]}; }

std::vector<Test_kernel::Triangle_3> triangles(const Working_mesh& mesh, const std::vector<Face>& boundary)
{
  std::vector<Test_kernel::Triangle_3> result;
  for(const Face& f : boundary)
    for(int i = 2; i < f.vertices().size(); ++i)
      result.emplace_back(point(mesh.points[f.vertices()[0]]), point(mesh.points[f.vertices()[i - 1]]),
                          point(mesh.points[f.vertices()[i]]));
  return result;
}

// The distance of the sample that is farthest from all triangles.
double farthest(const std::vector<Vec3>& samples, const std::vector<Test_kernel::Triangle_3>& boundary)
{
  double result = 0;
  for(const Vec3& s : samples) {
    double nearest = 1e9;
    for(const auto& t : boundary)
      nearest = (std::min)(nearest, std::sqrt(CGAL::to_double(CGAL::squared_distance(point(s), t))));
    result = (std::max)(result, nearest);
  }
  return result;
}

// Returns whether any place draws.
template <class Attraction>
bool compare(Attraction remembering, Attraction fresh, double tolerance)
{
  // Copies are compared, as the call strengthens the attraction.
  const auto a = remembering.attractions(1), b = fresh.attractions(1);
  BOOST_TEST_EQ(a.size(), b.size());
  bool draws = false;
  for(std::size_t v = 0; v < a.size(); ++v) {
    BOOST_TEST_LE(std::abs(a[v].weight - b[v].weight), 1e-12 * (1 + b[v].weight));
    BOOST_TEST_LE(norm(a[v].place - b[v].place), 1e-12);
    draws = draws || b[v].weight > 0;
  }
  const double exact = fresh.largest_distance();
  BOOST_TEST_GE(remembering.largest_distance(), exact - 1e-14);
  if(exact > tolerance / 2)
    BOOST_TEST_LE(std::abs(remembering.largest_distance() - exact), 1e-14);
  else
    BOOST_TEST_LE(remembering.largest_distance(), tolerance / 2 + 1e-14);

  const auto& p = remembering.far_points();
  const auto& q = fresh.far_points();
  BOOST_TEST_EQ(p.size(), q.size());
  for(std::size_t i = 0; i < (std::min)(p.size(), q.size()); ++i)
    BOOST_TEST(std::abs(p[i].first - q[i].first) < 1e-12 && norm(p[i].second - q[i].second) < 1e-12
               && q[i].first > 1);
  const auto near = remembering.far_edges(), anew = fresh.far_edges();
  BOOST_TEST_EQ(near.size(), anew.size());
  for(const auto& [edge, distance] : anew)
    BOOST_TEST(near.count(edge) && std::abs(near.at(edge) - distance) < 1e-12 && distance > tolerance);
  return draws;
}

// Some vertices move a lot, some a little, most not at all; and some faces leave the boundary and return.
void test_remembered()
{
  const Test_surface surface = sphere({center[0], center[1], center[2]}, radius, 16);
  const Polyhedral_mixed_mesh_domain_3 domain(surface);
  const internal::Surface_reference any_surface(domain);
  const internal::Strata strata(any_surface);
  const Project project(any_surface, strata);
  std::vector<Vec3> samples;
  for(const auto& p : domain.surface_samples(0.1))
    samples.push_back(to_vec3(p));
  BOOST_TEST_GT(samples.size(), 500u);
  std::size_t number_drawing = 0, number_near = 0;
  for(Element_kind kind : {TETRAHEDRON, HEXAHEDRON})
    for(double tolerance : {0.02, 0.07, 0.2}) {
      const Mesh mesh = inscribed(kind, 4);
      const std::vector<Face> boundary = boundary_faces(mesh);
      const std::vector<Vertex_index> vertices = vertices_of(boundary);
      Working_mesh working = working_mesh(mesh, boundary);
      const auto drawing = with_tolerance(samples, tolerance);
      const auto same = [=](internal::Stratum) { return tolerance; };
      Surface_attraction remembering(working, project, drawing);
      remembering.set_boundary(interface_faces(boundary), same);
      std::mt19937 random(9);
      std::uniform_real_distribution<double> uniform(-1, 1);
      for(int round = 0; round < 25; ++round) {
        std::vector<Face> faces = boundary;
        if(round % 3 != 0) { // others, in another order
          std::shuffle(faces.begin(), faces.end(), random);
          faces.erase(faces.end() - std::ptrdiff_t(random() % 4), faces.end());
          remembering.set_boundary(interface_faces(faces), same);
        }
        remembering.measure();
        Surface_attraction fresh(working, project, drawing);
        fresh.set_boundary(interface_faces(faces), same);
        fresh.measure();
        number_drawing += compare(remembering, fresh, tolerance);
        number_near += fresh.largest_distance() <= tolerance / 2;
        BOOST_TEST_GE(fresh.largest_distance(), farthest(samples, triangles(working, faces)) - 1e-12);
        remembering.set_boundary(interface_faces(boundary), same);
        for(Vertex_index v : vertices) {
          const double share = random() % 50 == 0 ? 1.5 : random() % 3 == 0 ? 0.1 : 0;
          for(double& x : working.points[v])
            x += share * tolerance * uniform(random);
          if(round % 8 == 7) { // back to the sphere
            const Vec3 d = working.points[v] - center;
            working.points[v] = center + (radius / norm(d)) * d;
          }
        }
      }
    }
  BOOST_TEST_GT(number_drawing, 50u);
  BOOST_TEST_GT(number_near, 2u);
}

// A triangle that grows by next to nothing gets more samples, one of them farther than those before.
void test_more_samples()
{
  constexpr double tolerance = 0.1, length = 2 * tolerance * (1 - 1e-9), sphere_radius = 1.3 * tolerance;
  const double across = length / std::sqrt(3.),
               height = std::sqrt(sphere_radius * sphere_radius - across * across);
  const Test_projection project{[](const Vec3& p, const Vec3&) { return (sphere_radius / norm(p)) * p; }};
  Mesh mesh;
  for(int i = 0; i < 3; ++i)
    mesh.add_vertex({across * std::cos(2 * CGAL_PI * i / 3), across * std::sin(2 * CGAL_PI * i / 3), height});
  mesh.add_vertex({0, 0, height + 1});
  mesh.add_element(TETRAHEDRON, {0, 1, 2, 3});
  BOOST_TEST(is_positive(mesh));
  std::vector<Face> bottom;
  for(const Face& f : boundary_faces(mesh))
    if(std::count(f.vertices().begin(), f.vertices().end(), 3u) == 0)
      bottom.push_back(f);
  BOOST_TEST_EQ(bottom.size(), 1u);
  Working_mesh working = working_mesh(mesh, bottom);
  const std::vector<internal::Surface_sample> no_samples;
  const auto same = [](internal::Stratum) { return tolerance; };
  Surface_attraction remembering(working, project, no_samples);
  remembering.set_boundary(interface_faces(bottom), same);
  remembering.measure();
  BOOST_TEST_LT(remembering.largest_distance(), tolerance / 2);
  for(int i = 0; i < 3; ++i)
    for(double& x : working.points[Vertex_index(i)])
      x *= 1 + 1e-8;
  remembering.measure();
  Surface_attraction fresh(working, project, no_samples);
  fresh.set_boundary(interface_faces(bottom), same);
  fresh.measure();
  BOOST_TEST(compare(remembering, fresh, tolerance));
}

// The distances from the surface alone are those of its samples; another boundary is measured anew.
void test_samples()
{
  const Test_surface surface = sphere({center[0], center[1], center[2]}, radius, 16);
  const Polyhedral_mixed_mesh_domain_3 domain(surface);
  const Test_projection is_anywhere{
    [](const Vec3& p, const Vec3&) { return p; }}; // the boundary is on the surface
  const Mesh mesh = inscribed(TETRAHEDRON, 3);
  const std::vector<Face> boundary = boundary_faces(mesh);
  const Working_mesh working = working_mesh(mesh, boundary);
  std::vector<Vec3> samples;
  for(const auto& p : domain.surface_samples(0.15))
    samples.push_back(to_vec3(p));
  for(double tolerance : {0.05, 0.1}) {
    const auto drawing = with_tolerance(samples, tolerance);
    const auto same = [=](internal::Stratum) { return tolerance; };
    Surface_attraction attraction(working, is_anywhere, drawing);
    attraction.set_boundary(interface_faces(boundary), same);
    attraction.measure();
    const auto all = triangles(working, boundary);
    BOOST_TEST_LE(std::abs(attraction.largest_distance() - farthest(samples, all)), 1e-12);
    std::size_t count = 0;
    for(const Vec3& s : samples)
      count += farthest({s}, all) > tolerance;
    BOOST_TEST_EQ(attraction.far_points().size(), count);
    for(const auto& [distance, p] : attraction.far_points())
      BOOST_TEST_LE(std::abs(distance * tolerance - farthest({p}, all)), 1e-12);

    std::vector<Face> half(boundary.begin(), boundary.begin() + std::ptrdiff_t(boundary.size() / 2));
    attraction.set_boundary(interface_faces(half), same);
    attraction.measure();
    BOOST_TEST_LE(std::abs(attraction.largest_distance() - farthest(samples, triangles(working, half))),
                  1e-12);
  }
}

int run(int, char*[])
{
  test_remembered();
  test_more_samples();
  test_samples();
  return boost::report_errors();
}

} // namespace test_fitting_attraction
