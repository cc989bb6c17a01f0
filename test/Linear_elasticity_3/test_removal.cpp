// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Linear_elasticity_3 after elements have been removed; in pieces, with hinges, with an inverted element; and
// with each solver.

#include "elasticity_test.h"

#include <CGAL/Mixed_mesh_3/resect.h>

#include <CGAL/Eigen_solver_traits.h>

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <iostream>
#include <utility>
#include <vector>

namespace test_removal {

using namespace elasticity_test;

void test_removal(int kind)
{
  const Mesh mesh = any_grid(4, kind, 0.1);
  const std::vector<Vec3> points{{0.2, 0.3, 0.3}, {0.8, 0.2, 0.4}, {0.3, 0.3, 0.12}};
  const Field wanted{{0.1, 0, 0}, {0, 0.05, 0.05}, {0, 0, -0.1}};
  const auto prepared = [&](Elasticity& problem) {
    const Mesh& m = problem.mesh();
    prescribe(problem, vertices_where(m, [](const Vec3& p) { return p[0] < 0.08; }), linear_field);
    for(Vertex_index v = 0; v < m.number_of_vertices(); ++v)
      if(position(m, v)[1] < 0.08)
        problem.slide(v, {0.1, 1, 0.2});
    BOOST_TEST(is_success(problem.factor()));
    problem.set_gravity({0, 1e4, -1e5});
    BOOST_TEST(is_success(problem.set_control_points(points)));
  };
  const std::vector<bool> first = elements_where(mesh,
                                                 [](const Vec3& p) { return p[2] > 0.75 && p[0] > 0.3; });
  const std::vector<bool> second = elements_where(mesh,
                                                  [](const Vec3& p) { return p[2] > 0.55 && p[1] > 0.5; });
  std::vector<bool> both = first;
  for(Element_index e = 0; e < both.size(); ++e)
    both[e] = first[e] || second[e];
  const auto removed = [&](std::initializer_list<std::vector<bool>> steps, double tolerance = 1e-8) {
    Elasticity problem(mesh);
    prepared(problem);
    problem.set_iteration_tolerance(tolerance);
    BOOST_TEST(is_success(problem.solve(wanted)));
    for(const std::vector<bool>& step : steps) {
      BOOST_TEST(is_success(problem.remove_elements(step)));
      BOOST_TEST_EQ(problem.number_of_control_points(), points.size());
      BOOST_TEST(is_success(problem.solve(wanted)));
      if(tolerance > 1e-12) // beyond, rounding may make the model factor
        BOOST_TEST(problem.is_iterative() && problem.number_of_iterations() > 0);
      for(std::size_t i = 0; i < points.size(); ++i)
        BOOST_TEST_LT(norm(interpolated(mesh, problem.displacements(), points[i]) - wanted[i]), 1e-9);
    }
    BOOST_TEST(problem.removed_elements() == both);
    return problem.displacements();
  };
  const Field u = removed({both});
  BOOST_TEST_LT(difference(removed({first, second}), u), 1e-6 * largest(u));
  BOOST_TEST_LT(difference(removed({second, first}), u), 1e-6 * largest(u));
  BOOST_TEST_LT(difference(removed({first, second, both, first}), u), 1e-6 * largest(u));

  BOOST_TEST_LT(difference(removed({first, second}, 1e-3), u), 1e-2 * largest(u)); // the default

  // Another problem has only the remaining elements. Patches keep the remaining ones of their elements, while
  // patches of another problem are chosen anew.
  std::vector<Vertex_index> vertices;
  const Mesh rest = remaining_mesh(mesh, both, &vertices);
  Elasticity fresh(rest);
  prepared(fresh);
  BOOST_TEST(is_success(fresh.solve(wanted)));
  Field expected(mesh.number_of_vertices(), Vec3{});
  for(Vertex_index v = 0; v < vertices.size(); ++v)
    expected[vertices[v]] = fresh.displacements()[v];
  const double error = difference(u, expected) / largest(expected);
  std::cout << "  removal, " << name_of(kind) << ": relative difference " << error << '\n';
  BOOST_TEST_LT(error, kind == HEXAHEDRON ? 1e-6 : 0.2);

  // A new factorization of the remaining elements gives the results of another problem.
  Elasticity again(mesh);
  prepared(again);
  again.set_iteration_tolerance(1e-8);
  BOOST_TEST(is_success(again.remove_elements(both)));
  prepared(again);
  BOOST_TEST(!again.is_iterative());
  BOOST_TEST(is_success(again.solve(wanted)));
  BOOST_TEST_LT(difference(again.displacements(), expected), 1e-9 * largest(expected));

  // Iterations reach the displacements of a direct solution of the same stiffness, with the same patches: new
  // control points make the model factor it. Some displacements of supports are not zero.
  Elasticity factored(mesh);
  prepared(factored);
  BOOST_TEST(is_success(factored.remove_elements(both)));
  BOOST_TEST(is_success(factored.set_control_points(points)));
  BOOST_TEST(!factored.is_iterative());
  BOOST_TEST(is_success(factored.solve(wanted)));
  BOOST_TEST_LT(difference(removed({both}, 1e-11), factored.displacements()), 1e-9 * largest(expected));
  BOOST_TEST_LT(difference(removed({first, second}, 1e-11), factored.displacements()),
                1e-9 * largest(expected));
  // Two problems of the same steps have the same bytes.
  BOOST_TEST(removed({first, second}) == removed({first, second}));

  // Nothing changes if no element is removed; a control point in removed elements is outside.
  BOOST_TEST(is_success(again.remove_elements(std::vector<bool>(mesh.number_of_elements(), false))));
  BOOST_TEST(is_success(again.solve(wanted)));
  BOOST_TEST_LT(difference(again.displacements(), expected), 1e-9 * largest(expected));
  const auto outside = again.remove_elements(elements_where(mesh, [](const Vec3& p) { return p[2] < 0.25; }));
  BOOST_TEST(outside.status == Status::CONTROL_POINT_OUTSIDE);
  BOOST_TEST_EQ(outside.control_point, 2u);
  BOOST_TEST(again.is_factored());

  const auto nothing_left = again.remove_elements(std::vector<bool>(mesh.number_of_elements(), true));
  BOOST_TEST(nothing_left.status == Status::NO_ELEMENTS);
  BOOST_TEST(!again.is_factored());
  BOOST_TEST(again.factor().status == Status::NO_ELEMENTS);
}

void test_pieces()
{
  const Mesh nothing;
  BOOST_TEST(Elasticity(nothing).factor().status == Status::NO_ELEMENTS);

  // There are two pieces, one of which is not held: it is reported, and then held by control points.
  const Mesh mesh = any_grid(4, HEXAHEDRON, 0.1);
  Elasticity problem(mesh);
  prescribe(problem, vertices_where(mesh, [](const Vec3& p) { return p[2] < 0.1; }), rigid_motion);
  BOOST_TEST(is_success(problem.factor()));
  BOOST_TEST(is_success(problem.solve()));
  BOOST_TEST_LT(difference(problem.displacements(), at_vertices(mesh, rigid_motion)), 1e-9);
  BOOST_TEST(is_success(
    problem.remove_elements(elements_where(mesh, [](const Vec3& p) { return p[2] > 0.5 && p[2] < 0.75; }))));
  const auto result = problem.solve();
  BOOST_TEST(result.status == Status::FREE_RIGID_MOTION);
  BOOST_TEST_EQ(result.number_of_free_motions, 6);
  const std::vector<Vec3> points{{0.2, 0.3, 0.9}, {0.8, 0.2, 0.85}, {0.3, 0.7, 0.9}};
  BOOST_TEST(is_success(problem.set_control_points(points)));
  Field wanted;
  for(const Vec3& p : points)
    wanted.push_back(rigid_motion(p));
  BOOST_TEST(is_success(problem.solve(wanted)));
  BOOST_TEST_LT(difference(problem.displacements(), at_vertices(mesh, rigid_motion)), 1e-9);

  // A hinge consists of two cubes with a common edge, or a common vertex. The stiffness is singular except
  // for rounding: a factor of it may exist.
  for(double z : {0., 1.}) {
    Mesh hinge;
    for(const Vec3& origin : {Vec3{0, 0, 0}, Vec3{1, 1, z}}) {
      std::array<Vertex_index, 8> v{};
      for(int i = 0; i < 8; ++i) {
        const auto& c = reference_elements[HEXAHEDRON].coordinates[i];
        const Test_point p(origin[0] + (c[0] + 1) / 2, origin[1] + (c[1] + 1) / 2,
                           origin[2] + (c[2] + 1) / 2);
        const auto found = std::find(hinge.points().begin(), hinge.points().end(), p);
        v[i] = found == hinge.points().end() ? hinge.add_vertex(p)
                                             : Vertex_index(found - hinge.points().begin());
      }
      hinge.add_element(HEXAHEDRON, v);
    }
    BOOST_TEST_EQ(hinge.number_of_vertices(), z == 0 ? 14u : 15u);
    const auto result_with = [&](auto problem) {
      prescribe(problem, vertices_where(hinge, [](const Vec3& p) { return p[0] == 0; }),
                Field(hinge.number_of_vertices(), Vec3{}));
      return problem.factor().status;
    };
    BOOST_TEST(result_with(Elasticity(hinge)) == Status::SOLVER_FAILED);
    BOOST_TEST(result_with(CGAL::Linear_elasticity_3<Mesh, Simplicial_solver_traits>(hinge))
               == Status::SOLVER_FAILED);
  }

  // An inverted element is reported.
  Mesh inverted = any_grid(2, TETRAHEDRON);
  std::array<Vertex_index, 4> v;
  std::copy(inverted.element(7).begin(), inverted.element(7).end(), v.begin());
  std::swap(v[0], v[1]);
  Mesh bad;
  bad.points() = inverted.points();
  for(Element_index e = 0; e < inverted.number_of_elements(); ++e)
    if(e == 7)
      bad.add_element(TETRAHEDRON, v);
    else
      bad.add_element(TETRAHEDRON, inverted.element(e).begin());
  Elasticity of_bad(bad);
  const auto found = of_bad.factor();
  BOOST_TEST(found.status == Status::INVERTED_ELEMENT);
  BOOST_TEST_EQ(found.element, 7u);
  BOOST_TEST(!of_bad.is_factored());
}

// ---- solvers -----------------------------------------------------------------------------------

template <class Solver>
Field solved_with(const Mesh& mesh)
{
  CGAL::Linear_elasticity_3<Mesh, Solver> problem(mesh);
  prescribe(problem, vertices_where(mesh, [](const Vec3& p) { return p[0] < 0.1; }),
            at_vertices(mesh, linear_field));
  BOOST_TEST(is_success(problem.factor()));
  problem.set_gravity({0, 0, -9810});
  BOOST_TEST(is_success(problem.set_control_points(std::vector<Vec3>{{0.7, 0.6, 0.5}, {0.4, 0.3, 0.8}})));
  BOOST_TEST(is_success(problem.solve(Field{{0.1, 0, 0}, {0, 0.1, 0.1}})));
  problem.set_iteration_tolerance(1e-8);
  BOOST_TEST(
    is_success(problem.remove_elements(elements_where(mesh, [](const Vec3& p) { return p[2] < 0.25; }))));
  BOOST_TEST(is_success(problem.solve(Field{{0.1, 0, 0}, {0, 0.1, 0.1}})));
  return problem.displacements();
}

void test_solvers()
{
  const Mesh mesh = any_grid(4, number_of_element_kinds, 0.1);
  const Field u = solved_with<Simplicial_solver_traits>(mesh);
  const double bound = 1e-7 * largest(u); // after a removal, which iterates
  BOOST_TEST(solved_with<Simplicial_solver_traits>(mesh) == u);
  using Matrix = Eigen::SparseMatrix<double>;
  BOOST_TEST_LT(difference(solved_with<CGAL::Eigen_solver_traits<Eigen::SimplicialLDLT<Matrix>>>(mesh), u),
                bound);
#ifdef CGAL_MIXED_MESH_3_USE_CHOLMOD
  const Field v = solved_with<Cholmod_solver_traits>(mesh);
  BOOST_TEST_LT(difference(v, u), bound);
  BOOST_TEST(solved_with<Cholmod_solver_traits>(mesh) == v);
#endif
}

int run(int, char*[])
{
  for(int kind = 0; kind <= number_of_element_kinds; ++kind)
    test_removal(kind);
  test_pieces();
  test_solvers();
  return boost::report_errors();
}

} // namespace test_removal
