// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The solver of PETSc compared with the direct one: supports that fix and slide, gravity, control points,
// removal, free bodies; systems that cannot be solved. The test runs alone, and in two processes by mpirun.

#include "elasticity_test.h"

#include <CGAL/Mixed_mesh_petsc/Petsc_solver_traits.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

namespace {

using namespace elasticity_test;
using Iterative = CGAL::Linear_elasticity_3<Mesh, Petsc_solver_traits>;

// The bottom is fixed, one side slides, and two points of the top are displaced. Then a corner is removed.
template <class Problem>
std::vector<Field> solutions(Problem& problem)
{
  const Mesh& mesh = problem.mesh();
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v) {
    const Vec3 p = position(mesh, v);
    if(p[2] == 0)
      problem.prescribe(v, Vec3{0.01 * p[0], 0, 0});
    else if(p[0] == 0)
      problem.slide(v, {1, 0, 0});
  }
  std::vector<Field> result;
  const auto solve = [&](const Field& displacements) {
    BOOST_TEST(is_success(problem.solve(displacements)));
    result.push_back(problem.displacements());
  };
  BOOST_TEST(is_success(problem.factor()));
  problem.set_gravity({0, 1000, -9810});
  solve({});
  BOOST_TEST(is_success(problem.set_control_points(Field{{0.3, 0.3, 1}, {0.8, 0.6, 1}})));
  solve({{0, 0.1, -0.2}, {0.1, 0, 0}});
  BOOST_TEST(is_success(problem.remove_elements(
    elements_where(mesh, [](const Vec3& p) { return p[0] > 0.7 && p[1] > 0.7 && p[2] > 0.7; }))));
  BOOST_TEST(problem.is_iterative());
  problem.set_iteration_tolerance(1e-10);
  solve({{0, 0.1, -0.2}, {0.1, 0, 0}});
  return result;
}

void test_beside_direct(int n, int kind, double nu)
{
  const Mesh mesh = any_grid(n, kind, 0.15, Moved::INNER);
  Elasticity direct(mesh, Elastic_material{3, nu});
  Iterative iterative(mesh, Elastic_material{3, nu});
  iterative.solver().set_tolerance(1e-11);
  const std::vector<Field> expected = solutions(direct), found = solutions(iterative);
  for(std::size_t i = 0; i < expected.size(); ++i)
    BOOST_TEST_LT(difference(expected[i], found[i]), 1e-7 * largest(expected[i]));
  BOOST_TEST_LT(iterative.solver().largest_number_of_iterations(), 100);
  std::cout << name_of(kind) << ", nu = " << nu << ": up to "
            << iterative.solver().largest_number_of_iterations() << " iterations\n";
}

// Bodies held by control points alone make rigid motions. There are two bodies at once, each with its matrix.
void test_free_bodies()
{
  const Mesh mesh = any_grid(4, HEXAHEDRON), other = any_grid(2, TETRAHEDRON);
  Iterative one(mesh), two(other);
  const Field points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for(Iterative* problem : {&one, &two}) {
    BOOST_TEST(is_success(problem->factor()));
    BOOST_TEST(is_success(problem->set_control_points(points)));
  }
  for(Iterative* problem : {&one, &two, &one}) {
    BOOST_TEST(is_success(
      problem->solve(Field{rigid_motion(points[0]), rigid_motion(points[1]), rigid_motion(points[2])})));
    BOOST_TEST_LT(difference(problem->displacements(), at_vertices(problem->mesh(), rigid_motion)), 1e-7);
  }
}

Petsc_solver_traits::Matrix matrix_of(const std::vector<double>& diagonal)
{
  Petsc_solver_traits::Matrix matrix(int(diagonal.size()));
  for(std::size_t i = 0; i < diagonal.size(); ++i)
    matrix.set_coef(i, i, diagonal[i], true);
  matrix.assemble_matrix();
  return matrix;
}

// The concept of CGAL, with matrices that have nothing to do with elasticity, as small as one unknown.
void test_concept()
{
  for(std::size_t n : {1, 2, 7}) {
    std::vector<double> diagonal(n);
    Petsc_solver_traits::Vector b(n), x(n);
    for(std::size_t i = 0; i < n; ++i) {
      diagonal[i] = double(i + 1);
      b[i] = double(i * i) - 2;
    }
    Petsc_solver_traits solver;
    double denominator = 0;
    BOOST_TEST(solver.linear_solver(matrix_of(diagonal), b, x, denominator));
    for(std::size_t i = 0; i < n; ++i)
      BOOST_TEST_LT(std::abs(diagonal[i] * x[i] / denominator - b[i]), 1e-9);
    for(double bad : {0., -1., std::numeric_limits<double>::quiet_NaN()}) {
      diagonal[n / 2] = bad;
      BOOST_TEST(!solver.factor(matrix_of(diagonal), denominator));
    }
  }
}

// Two halves connected by an edge only; no convergence.
void test_failures()
{
  Mesh hinge = any_grid(2, HEXAHEDRON);
  const std::vector<bool> is_removed = elements_where(hinge, [](const Vec3& p) {
    return (p[0] < 0.5) == (p[1] < 0.5);
  });
  Iterative problem(hinge);
  for(Vertex_index v = 0; v < hinge.number_of_vertices(); ++v)
    if(position(hinge, v)[0] == 0)
      problem.prescribe(v);
  BOOST_TEST(is_success(problem.factor()));
  BOOST_TEST(!problem.remove_elements(is_removed).is_success() || !problem.factor().is_success());

  if(internal::petsc_size() > 1) // the option would be that of one process only
    return;
  const Mesh mesh = any_grid(3, HEXAHEDRON);
  Iterative hasty(mesh);
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
    if(position(mesh, v)[2] == 0)
      hasty.prescribe(v);
  PetscOptionsSetValue(nullptr, "-ksp_max_it", "2");
  BOOST_TEST(hasty.factor().status == Status::SOLVER_FAILED);
  PetscOptionsClearValue(nullptr, "-ksp_max_it");
  BOOST_TEST(is_success(hasty.factor()));
}

} // namespace

int main(int argc, char** argv)
{
  Petsc_session session;
  if(!session.is_first()) {
    session.serve();
    return 0;
  }
  BOOST_TEST_EQ(session.number_of_processes(), argc > 1 ? std::atoi(argv[1]) : 1);
  for(int kind = 0; kind <= number_of_element_kinds; ++kind)
    test_beside_direct(4, kind, 0.45);
  test_beside_direct(8, number_of_element_kinds, 0.49);
  test_free_bodies();
  test_concept();
  test_failures();
  return boost::report_errors();
}
