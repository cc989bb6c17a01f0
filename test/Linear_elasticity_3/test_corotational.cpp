// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Linear_elasticity_3 with finite rotations: derivatives compared with differences, rotations without energy,
// constant strain, small loads, bent bars compared with a total Lagrangian solution, supports and control
// points, removals, and cases without convergence.

#include "Total_lagrangian_reference.h"
#include "elasticity_test.h"

#include <CGAL/Linear_elasticity_3/internal/Corotational_elements.h>
#include <CGAL/Linear_elasticity_3/internal/Elastic_stiffness.h>
#include <CGAL/Mixed_mesh_3/Elastic_material.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <vector>

namespace test_corotational {

using namespace elasticity_test;

const double pi = std::acos(-1.);

Function rotation(const Vec3& axis, double angle, const Vec3& center = Vec3{0.3, 0.6, 0.2})
{
  const Eigen::Matrix3d r = Eigen::AngleAxisd(angle, Eigen::Vector3d(axis.data()).normalized())
                              .toRotationMatrix();
  return [=](const Vec3& p) {
    const Vec3 d = p - center;
    const Eigen::Vector3d x = r * Eigen::Vector3d(d.data());
    return Vec3{x[0], x[1], x[2]} - d;
  };
}

Eigen::VectorXd flat(const Field& u)
{
  Eigen::VectorXd x(3 * Eigen::Index(u.size()));
  for(std::size_t v = 0; v < u.size(); ++v)
    for(int k = 0; k < 3; ++k)
      x[Eigen::Index(3 * v) + k] = u[v][k];
  return x;
}

Elastic_stiffness stiffness_of(const Mesh& mesh, const Elastic_material& material)
{
  Elastic_stiffness stiffness(mesh.elements(), at_vertices(mesh, [](const Vec3& p) { return p; }),
                              {material});
  stiffness.assemble();
  return stiffness;
}

// Forces are the gradient of the energy, and the tangent is that of the forces, symmetric; also for elements
// that are turned, and squeezed.
void test_derivatives(int kind)
{
  const Mesh mesh = any_grid(4, kind, 0.1);
  const Elastic_material material{2, 0.45};
  const Elastic_stiffness stiffness = stiffness_of(mesh, material);
  Corotational_elements elements(stiffness);
  Noise noise;
  const Function turn = rotation({1, 2, -1}, 2.5);
  Field u = at_vertices(mesh, turn), d, e;
  for(Vec3& x : u) {
    x = x + 0.05 * noise.vector();
    d.push_back(noise.vector());
    e.push_back(noise.vector());
  }
  const Eigen::VectorXd x = flat(u), p = flat(d), q = flat(e);
  const double step = 1e-5;
  elements.move(x);
  const double slope = elements.forces().dot(p), energy = elements.energy();
  const Eigen::VectorXd tangent = elements.product(p);
  BOOST_TEST_GT(energy, 0);
  BOOST_TEST_LT(std::abs(tangent.dot(q) - elements.product(q).dot(p)), 1e-12 * tangent.norm() * q.norm());
  elements.move(x + step * p);
  const double above = elements.energy();
  const Eigen::VectorXd forces_above = elements.forces();
  elements.move(x - step * p);
  BOOST_TEST_LT(std::abs((above - elements.energy()) / (2 * step) - slope), 1e-6 * std::abs(slope));
  BOOST_TEST_LT(((forces_above - elements.forces()) / (2 * step) - tangent).norm(), 1e-5 * tangent.norm());
  // The tangent at rest is the matrix of small rotations.
  elements.move(0 * x);
  BOOST_TEST_LT((elements.product(p) - stiffness.product(p)).norm(), 1e-12 * tangent.norm());
}

void test_rotations(int kind)
{
  const Mesh mesh = any_grid(4, kind, 0.15);
  const Elastic_material material{3, 0.45};
  const Elastic_stiffness stiffness = stiffness_of(mesh, material);
  Corotational_elements elements(stiffness);
  for(double angle : {0.1, 0.8, pi / 2, 2.4, pi - 1e-9, 5.}) {
    const Field u = at_vertices(mesh, rotation({0.3, -1, 0.6}, angle));
    elements.move(flat(u));
    BOOST_TEST_LT(elements.forces().lpNorm<Eigen::Infinity>(), 1e-12);
    BOOST_TEST_LT(elements.energy(), 1e-24);
    BOOST_TEST_GT(stiffness.product(flat(u)).norm(), 1e-3); // where the linear one has forces
  }
  // The inside turns with the boundary.
  for(double angle : {0.5, 1.5}) {
    const Function turn = rotation({0.3, -1, 0.6}, angle);
    Elasticity problem(mesh, material);
    prescribe(problem, is_on_boundary(mesh), turn);
    BOOST_TEST(is_success(problem.factor()));
    problem.set_corotational(true);
    problem.set_iteration_tolerance(1e-9);
    BOOST_TEST(is_success(problem.solve()));
    BOOST_TEST_LT(difference(problem.displacements(), at_vertices(mesh, turn)), 1e-6);
    BOOST_TEST_LT(problem.energy(), 1e-12);
  }
}

// The same stretch everywhere, then a rotation: the energy is that of the stretch.
void test_patch(int kind)
{
  const Mesh mesh = any_grid(4, kind, 0.15, Moved::INNER);
  const Elastic_material material{3, 0.4};
  const Vec3 stretch{0.1, -0.04, 0.03};
  const Function turn = rotation({1, 1, 0.2}, 1.2);
  const Function map = [&](const Vec3& p) {
    const Vec3 s{stretch[0] * p[0], stretch[1] * p[1], stretch[2] * p[2]};
    return s + turn(p + s);
  };
  Elasticity problem(mesh, material);
  prescribe(problem, is_on_boundary(mesh), map);
  BOOST_TEST(is_success(problem.factor()));
  problem.set_corotational(true);
  problem.set_iteration_tolerance(1e-9);
  BOOST_TEST(is_success(problem.solve()));
  BOOST_TEST_LT(difference(problem.displacements(), at_vertices(mesh, map)), 1e-8);
  const double trace = stretch[0] + stretch[1] + stretch[2];
  const double energy = material.mu() * dot(stretch, stretch) + material.lambda() / 2 * trace * trace;
  BOOST_TEST_LT(std::abs(problem.energy() - energy), 1e-9 * energy);
  BOOST_TEST_LT(problem.residuals().back(), 1e-9);
}

void fix_where(Elasticity& problem, const std::function<bool(const Vec3&)>& where)
{
  prescribe(problem, vertices_where(problem.mesh(), where), [](const Vec3&) { return Vec3{}; });
}

// Small loads of all kinds give the same as small rotations, up to the square of the displacement.
void test_small_loads(int kind)
{
  const Mesh mesh = any_grid(4, kind, 0.1, Moved::INNER);
  double last = 0;
  for(double size : {1e-3, 1e-5}) {
    Elasticity problem(mesh);
    problem.slide_along_boundary([&](Vertex_index v) { return position(mesh, v)[1] == 0; });
    fix_where(problem, [](const Vec3& p) { return p[2] == 0; });
    for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
      if(position(mesh, v)[0] == 1 && position(mesh, v)[2] > 0.7)
        problem.prescribe(v, size * Vec3{-0.5, 0.2, 1});
    BOOST_TEST(is_success(problem.factor()));
    problem.set_body_force(size * Vec3{0.1, 0.2, -0.3});
    BOOST_TEST(is_success(problem.set_control_points(std::vector<Vec3>{{0.3, 0.4, 0.8}})));
    const Field wanted{size * Vec3{1, -0.5, 0.4}};
    BOOST_TEST(is_success(problem.solve(wanted)));
    const Field linear = problem.displacements();
    const Vec3 force = problem.control_forces()[0];
    problem.set_corotational(true);
    problem.set_iteration_tolerance(1e-9);
    BOOST_TEST(is_success(problem.solve(wanted)));
    const double error = difference(problem.displacements(), linear) / size;
    BOOST_TEST_LT(norm(problem.control_forces()[0] - force), 20 * size * norm(force));
    BOOST_TEST_LT(error, 10 * size);
    BOOST_TEST_GT(error, 1e-9);
    if(last > 0)
      BOOST_TEST_LT(error, 0.02 * last);
    last = error;
    problem.set_corotational(false);
    BOOST_TEST(is_success(problem.solve(wanted)));
    BOOST_TEST(problem.displacements() == linear); // the same bytes
  }
}

// A bar along x, from hexahedra, or of all kinds; clamped at x = 0.
Mesh bar(int n, int kind, const Vec3& size)
{
  Mesh mesh;
  const int cells[3] = {n * int(std::lround(size[0] / size[1])), n, n};
  const auto place = [&](double x, double y, double z) {
    return Test_point(size[0] * x / cells[0], size[1] * y / n, size[2] * z / n);
  };
  for(int z = 0; z <= n; ++z)
    for(int y = 0; y <= n; ++y)
      for(int x = 0; x <= cells[0]; ++x)
        mesh.add_vertex(place(x, y, z));
  for(int z = 0; z < n; ++z)
    for(int y = 0; y < n; ++y)
      for(int x = 0; x < cells[0]; ++x) {
        std::array<Vertex_index, 8> v{};
        for(int i = 0; i < 8; ++i) {
          const auto& c = reference_elements[HEXAHEDRON].coordinates[i];
          v[i] = Vertex_index(x + (c[0] + 1) / 2
                              + (cells[0] + 1) * (y + (c[1] + 1) / 2 + (n + 1) * (z + (c[2] + 1) / 2)));
        }
        add_cell(mesh, v, Element_kind(kind), [&] { return place(x + 0.5, y + 0.5, z + 0.5); });
      }
  BOOST_TEST(find_defects(mesh).positive());
  return mesh;
}

double tip_angle(const Mesh& mesh, const Field& u, double length)
{
  Vec3 along{};
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v) {
    const Vec3 p = position(mesh, v);
    if(p[0] == length)
      along = along + (1 - 2 * p[2]) * u[v];
  }
  double sum = 0;
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v) {
    const Vec3 p = position(mesh, v);
    if(p[0] == length)
      sum += (1 - 2 * p[2]) * (1 - 2 * p[2]);
  }
  along = (-2 / sum) * along; // the derivative of the displacement by height
  return std::atan2(-along[0], 1 + along[2]);
}

// A bar is bent by a force by volume, such that the tip turns by 45 and by 90 degrees.
void test_bar(int n, int kind, double force, double degrees)
{
  const double length = 20;
  const Mesh mesh = bar(n, kind, {length, 1, 1});
  const Elastic_material material{100, 0.3};
  const Vec3 load = force * Vec3{-0.6, 0, -0.8};
  const auto is_clamped = [](const Vec3& p) { return p[0] == 0; };
  Elasticity problem(mesh, material);
  fix_where(problem, is_clamped);
  BOOST_TEST(is_success(problem.factor()));
  problem.set_body_force(load);
  BOOST_TEST(is_success(problem.solve()));
  const auto tip = [&](const Field& u) {
    return u[std::size_t(std::lround(length)) * n];
  }; // end of the first row
  Field linear = problem.displacements();
  static Field linear_expected, expected; // of hexahedra, which come first
  if(kind == HEXAHEDRON)
    linear_expected = linear;
  // A bar of other elements is stiffer, with small rotations as well: the load is increased accordingly.
  problem.set_body_force((norm(tip(linear_expected)) / norm(tip(linear))) * load);
  linear = linear_expected;
  problem.set_corotational(true);
  problem.set_iteration_tolerance(1e-6);
  BOOST_TEST(is_success(problem.solve()));
  const Mesh hexahedra = bar(n, HEXAHEDRON, {length, 1, 1});
  if(kind == HEXAHEDRON)
    expected = total_lagrangian_solution(hexahedra, material, vertices_where(hexahedra, is_clamped), load);
  Vec3 a = tip(problem.displacements());
  const Vec3 b = tip(expected);
  // Elements are stiffer on one side of a diagonal: they bend a bar sideways, too, with small rotations as
  // well.
  if(kind == TETRAHEDRON || kind == PRISM)
    a[1] = b[1];
  const double angle = -tip_angle(hexahedra, expected, length) * 180 / pi;
  std::cout << "  bar of " << name_of(kind) << ": tip at " << a[0] << ' ' << a[2] << ", total Lagrangian "
            << b[0] << ' ' << b[2] << ", " << angle << " degrees: " << 100 * norm(a - b) / norm(b)
            << " %; linear " << 100 * norm(tip(linear) - b) / norm(b) << " %; " << problem.residuals().size()
            << " steps, " << problem.number_of_iterations() << " iterations\n";
  BOOST_TEST_LT(norm(a - b), 0.01 * norm(b));
  BOOST_TEST_GT(norm(tip(linear) - b), 0.1 * norm(b));
  BOOST_TEST_LT(std::abs(angle - degrees), 2);
}

// The old factor suffices after a removal: the solution is that of a model that never had the elements. A
// body held by control points alone, some of them compliant, can turn as a whole.
void test_removal_and_controls()
{
  const Mesh mesh = any_grid(4, HEXAHEDRON, 0.1, Moved::INNER); // others would get other patches
  const std::vector<bool> is_removed = elements_where(mesh,
                                                      [](const Vec3& p) { return p[0] > 0.5 && p[2] > 0.7; });
  const std::vector<Vec3> points{{0.2, 0.3, 0.9}, {0.3, 0.8, 0.8}};
  const Field wanted{{0.15, 0, -0.05}, {0.12, 0.02, -0.05}};
  Field after[2];
  for(bool at_once : {false, true}) {
    Elasticity problem(mesh);
    problem.slide_along_boundary([&](Vertex_index v) { return position(mesh, v)[1] == 0; });
    fix_where(problem, [](const Vec3& p) { return p[2] == 0; });
    problem.set_corotational(true);
    problem.set_iteration_tolerance(1e-8);
    BOOST_TEST(is_success(problem.factor()));
    if(at_once) {
      BOOST_TEST(is_success(problem.remove_elements(is_removed)));
      BOOST_TEST(is_success(problem.factor()));
    }
    BOOST_TEST(is_success(problem.set_control_points(points)));
    problem.set_body_force({0.05, 0, 0});
    BOOST_TEST(is_success(problem.solve(wanted)));
    for(std::size_t i = 0; i < points.size() && !at_once; ++i)
      BOOST_TEST_LT(norm(interpolated(mesh, problem.displacements(), points[i]) - wanted[i]), 1e-10);
    if(!at_once) {
      BOOST_TEST(is_success(problem.remove_elements(is_removed)));
      BOOST_TEST(problem.is_iterative());
      BOOST_TEST(is_success(problem.solve(wanted)));
    }
    after[at_once] = problem.displacements();
  }
  BOOST_TEST_LT(difference(after[0], after[1]), 1e-5);

  const Function turn = rotation({1, -1, 0.5}, 0.9);
  std::vector<Vec3> corners;
  for(const Vec3& p : {Vec3{0.1, 0.1, 0.1}, {0.9, 0.1, 0.2}, {0.2, 0.9, 0.2}, {0.1, 0.2, 0.9}})
    corners.push_back(p);
  Field turned;
  for(const Vec3& p : corners)
    turned.push_back(turn(p));
  const Mesh mixed = any_grid(4, number_of_element_kinds, 0.1);
  for(double compliance : {0., 0.3}) {
    Elasticity problem(mixed);
    problem.set_corotational(true);
    problem.set_iteration_tolerance(1e-8);
    BOOST_TEST(is_success(problem.factor()));
    BOOST_TEST(is_success(problem.set_control_points(corners, 0, compliance)));
    BOOST_TEST(is_success(problem.solve(turned)));
    BOOST_TEST_LT(difference(problem.displacements(), at_vertices(mixed, turn)), 1e-6);
    BOOST_TEST_LT(problem.energy(), 1e-10);
    if(compliance > 0) { // springs with a load give way by what they bear
      problem.set_body_force({0, 0.02, -0.05});
      BOOST_TEST(is_success(problem.solve(turned)));
      Vec3 sum{};
      for(std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 force = problem.control_forces()[i];
        const Vec3 u = interpolated(mixed, problem.displacements(), corners[i]);
        BOOST_TEST_LT(norm(turned[i] - u - compliance * force), 1e-10);
        sum = sum + force;
      }
      double total = 0;
      for(Element_index e = 0; e < mixed.number_of_elements(); ++e)
        total += volume(mixed, e);
      BOOST_TEST_LT(norm(sum - total * Vec3{0, -0.02, 0.05}), 1e-7);
    }
  }
}

// A body pressed flat beyond what an element can bear: the status says so, and the next problem is solved.
void test_too_much()
{
  const Mesh mesh = any_grid(4, HEXAHEDRON);
  Elasticity problem(mesh);
  fix_where(problem, [](const Vec3& p) { return p[2] == 0; });
  const auto is_top = [](const Vec3& p) { return p[2] == 1; };
  prescribe(problem, vertices_where(mesh, is_top), [](const Vec3&) { return Vec3{0, 0, -1.2}; });
  BOOST_TEST(is_success(problem.factor()));
  problem.set_corotational(true);
  const auto result = problem.solve();
  std::cout << "  pressed through its base: " << result.description() << '\n';
  BOOST_TEST(result.status == Status::INVERTED_ELEMENT);
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
    if(is_top(position(mesh, v)))
      problem.set_support_displacement(v, {0, 0, -0.1});
  BOOST_TEST(is_success(problem.solve()));
}

int run(int, char*[])
{
  for(int kind = 0; kind <= number_of_element_kinds; ++kind) {
    test_derivatives(kind);
    test_rotations(kind);
    test_patch(kind);
    test_small_loads(kind);
  }
  test_removal_and_controls();
  test_too_much();
  for(const auto& [force, degrees] : {std::pair(0.0051, 45.), std::pair(0.0131, 90.)})
    for(int kind : {HEXAHEDRON, PRISM, PYRAMID, TETRAHEDRON})
      test_bar(2, kind, force, degrees);
  return boost::report_errors();
}

} // namespace test_corotational
