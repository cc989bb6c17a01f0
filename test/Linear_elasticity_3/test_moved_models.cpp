// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Models of Linear_elasticity_3 that are moved: into a new one, into one that has been used, within a
// std::vector. The source is destroyed; further results are those without the move, bit by bit.

#include "elasticity_test.h"

#include <CGAL/Eigen_solver_traits.h>

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <new>
#include <random>
#include <set>
#include <type_traits>
#include <utility>
#include <vector>

namespace test_moved_models {

using namespace elasticity_test;

// A solver that can be neither moved nor copied, like those of Eigen.
struct Fixed_solver_traits : Simplicial_solver_traits
{
  Fixed_solver_traits() = default;
  Fixed_solver_traits(const Fixed_solver_traits&) = delete;
};

template <class Solver>
using Model = CGAL::Linear_elasticity_3<Mesh, Solver>;

template <class Type>
constexpr bool is_movable = std::is_nothrow_move_constructible_v<Type>&&
  std::is_nothrow_move_assignable_v<Type>;
template <class Type>
constexpr bool is_copyable = std::is_copy_constructible_v<Type>&& std::is_copy_assignable_v<Type>;

// A factorization cannot be copied: Eigen's solvers are not copyable. A factorization that copies shared
// would change for all of them with the next `factor()`.
static_assert(
  is_movable<
    Elasticity> && !std::is_copy_constructible_v<Elasticity> && !std::is_copy_assignable_v<Elasticity>);
static_assert(is_movable<Model<Simplicial_solver_traits>> && is_movable<Model<Fixed_solver_traits>>);
static_assert(!std::is_move_constructible_v<Fixed_solver_traits>);
// A locator refers to the mesh only, which is the caller's.
static_assert(std::is_move_constructible_v<Element_locator_3<Mesh>> && is_copyable<Element_locator_3<Mesh>>);

const std::vector<Vec3> points{{0.2, 0.3, 0.9}, {0.8, 0.2, 0.7}, {0.3, 0.7, 0.6}, {0.55, 0.6, 0.95}};
const Field wanted{{0.1, 0, 0}, {0, 0.05, 0.05}, {0, 0, -0.1}, {0, 0.02, 0}};

enum class Progress { NEW, SUPPORTED, FACTORED, CONTROLLED, SOLVED, REMOVED };

// Steps before the move.
template <class Problem>
void advance(Problem& problem, Progress progress)
{
  const Mesh& mesh = problem.mesh();
  problem.set_gravity({0, 1e4, -1e5});
  problem.set_iteration_tolerance(1e-6);
  if(progress >= Progress::SUPPORTED)
    prescribe(problem, vertices_where(mesh, [](const Vec3& p) { return p[2] < 0.08; }),
              at_vertices(mesh, linear_field));
  if(progress >= Progress::FACTORED)
    BOOST_TEST(is_success(problem.factor()));
  if(progress >= Progress::CONTROLLED)
    BOOST_TEST(is_success(problem.set_control_points(points)));
  if(progress >= Progress::SOLVED)
    BOOST_TEST(is_success(problem.solve(wanted)));
  if(progress >= Progress::REMOVED)
    BOOST_TEST(is_success(problem.remove_elements(
      elements_where(mesh, [](const Vec3& p) { return p[0] > 0.75 && p[2] > 0.75; }))));
}

// Steps after the move: all results.
template <class Problem>
std::vector<Field> finish(Problem& problem, Progress progress)
{
  const Mesh& mesh = problem.mesh();
  std::vector<Field> results;
  const auto solve = [&](const Field& displacements) {
    const Linear_elasticity_result_3 result = problem.solve(displacements);
    BOOST_TEST(is_success(result));
    results.push_back(problem.displacements());
    results.push_back(problem.control_forces());
    results.push_back({{problem.energy(), double(problem.number_of_iterations()), 0}});
  };
  if(progress < Progress::FACTORED) {
    prescribe(problem, vertices_where(mesh, [](const Vec3& p) { return p[2] < 0.08; }),
              at_vertices(mesh, linear_field));
    BOOST_TEST(is_success(problem.factor()));
  }
  if(progress >= Progress::SOLVED)
    results.push_back(problem.displacements());
  if(progress >= Progress::CONTROLLED)
    solve(wanted);
  BOOST_TEST(is_success(problem.set_control_points(points)));
  solve(wanted);
  BOOST_TEST(is_success(problem.set_control_points(points, 0.1, 0, 0.4)));
  solve(wanted);
  problem.set_body_force({0, 1e-3, 0});
  solve(wanted);
  BOOST_TEST(is_success(
    problem.remove_elements(elements_where(mesh, [](const Vec3& p) { return p[0] < 0.25 && p[2] > 0.75; }))));
  solve(wanted);
  BOOST_TEST(is_success(problem.set_control_points(std::vector<Vec3>(points.begin() + 2, points.end()))));
  solve(Field(wanted.begin() + 2, wanted.end()));
  return results;
}

template <class Solver>
void test_moved(const Mesh& mesh)
{
  using Problem = Model<Solver>;
  for(Progress progress : {Progress::NEW, Progress::SUPPORTED, Progress::FACTORED, Progress::CONTROLLED,
                           Progress::SOLVED, Progress::REMOVED}) {
    Problem unmoved(mesh);
    advance(unmoved, progress);
    const std::vector<Field> expected = finish(unmoved, progress);

    auto source = std::make_unique<Problem>(mesh);
    advance(*source, progress);
    Problem constructed(std::move(*source));
    source.reset();
    BOOST_TEST_EQ(&constructed.mesh(), &mesh);
    BOOST_TEST(finish(constructed, progress) == expected);

    const Mesh other_mesh = any_grid(2, HEXAHEDRON);
    source = std::make_unique<Problem>(mesh);
    advance(*source, progress);
    Problem assigned(other_mesh);
    advance(assigned, Progress::FACTORED);
    assigned = std::move(*source);
    source.reset();
    BOOST_TEST_EQ(&assigned.mesh(), &mesh);
    BOOST_TEST(finish(assigned, progress) == expected);
  }
}

void test_vector(const Mesh& mesh)
{
  std::vector<Elasticity> models;
  std::size_t number_of_moves = 0;
  for(int i = 0; i < 6; ++i) {
    const std::size_t capacity = models.capacity();
    models.emplace_back(mesh, Elastic_material{1. + i, 0.3 + 0.03 * i});
    number_of_moves += i > 0 && models.capacity() != capacity;
    advance(models.back(), Progress::CONTROLLED);
  }
  BOOST_TEST_GT(number_of_moves, 0u);
  models.erase(models.begin() + 1);
  std::swap(models[0], models[2]);
  const int order[] = {3, 2, 0, 4, 5};
  for(std::size_t k = 0; k < models.size(); ++k) {
    Elasticity unmoved(mesh, Elastic_material{1. + order[k], 0.3 + 0.03 * order[k]});
    advance(unmoved, Progress::CONTROLLED);
    BOOST_TEST(finish(models[k], Progress::CONTROLLED) == finish(unmoved, Progress::CONTROLLED));
  }
}

// Copies of the traits are one solver: each copy has to know the pattern that was analyzed.
template <class Solver>
void test_copied_solver()
{
  using Matrix = typename Solver::Matrix;
  const auto is_solved = [](Solver& solver, const Matrix& matrix, std::size_t n) {
    double denominator = 0;
    typename Solver::Vector b(n), x(n);
    for(std::size_t i = 0; i < n; ++i)
      b[Eigen::Index(i)] = 1 + double(i);
    if(!solver.linear_solver(matrix, b, x, denominator))
      return false;
    const Eigen::VectorXd product = matrix.eigen_object().template selfadjointView<Eigen::Lower>() * x;
    return (product - b).norm() < 1e-12;
  };
  const Matrix chain({0, 2, 4, 5}, {0, 1, 1, 2, 2}, {4, 1, 4, 1, 4});
  const Matrix arrow({0, 4, 5, 6, 7}, {0, 1, 2, 3, 1, 2, 3}, {8, 1, 1, 1, 4, 4, 4});
  Solver one;
  BOOST_TEST(is_solved(one, chain, 3));
  Solver other = one;
  BOOST_TEST(is_solved(other, arrow, 4));
  BOOST_TEST(is_solved(one, chain, 3));
  Solver moved = std::move(other);
  BOOST_TEST(is_solved(moved, arrow, 4));
}

// The factor of a graph without small separators is nearly dense: here it has more entries than an `int`
// counts.
#ifdef CGAL_MIXED_MESH_3_USE_CHOLMOD
void test_large_factor()
{
  const int n = 90000;
  std::mt19937 random(1);
  std::uniform_int_distribution<int> any(0, n - 1);
  std::vector<std::set<int>> columns(n);
  for(int i = 0; i < n; ++i) {
    columns[std::size_t(i)].insert(i);
    for(int k = 0; k < 6; ++k) {
      const int j = any(random);
      columns[std::size_t((std::min)(i, j))].insert((std::max)(i, j));
    }
  }
  std::vector<int> starts{0}, rows;
  for(const std::set<int>& column : columns) {
    rows.insert(rows.end(), column.begin(), column.end());
    starts.push_back(int(rows.size()));
  }
  const Cholmod_solver_traits::Matrix large(starts, rows, std::vector<double>(rows.size(), 1)),
    small({0, 2, 3}, {0, 1, 1}, {2, 1, 2});
  Cholmod_solver_traits solver;
  double denominator = 0;
  BOOST_TEST(solver.factor(small, denominator));
  for(int i = 0; i < 2; ++i)
    BOOST_TEST_THROWS(solver.factor(large, denominator), std::bad_alloc);
  BOOST_TEST(solver.factor(small, denominator));
}
#endif

int run(int, char*[])
{
  const Mesh mesh = any_grid(4, number_of_element_kinds, 0.1);
  test_moved<Simplicial_solver_traits>(mesh);
  test_moved<Fixed_solver_traits>(mesh);
  test_moved<CGAL::Eigen_solver_traits<Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>>>(mesh);
#ifdef CGAL_MIXED_MESH_3_USE_CHOLMOD
  test_moved<Cholmod_solver_traits>(mesh);
  test_copied_solver<Cholmod_solver_traits>();
  test_large_factor();
#endif
  test_vector(mesh);
  test_copied_solver<Simplicial_solver_traits>();
  return boost::report_errors();
}

} // namespace test_moved_models
