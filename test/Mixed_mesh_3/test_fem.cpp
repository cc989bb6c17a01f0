// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Element matrices: linear fields, which they must reproduce; and the solvers of their systems.

#include "test_grids.h"

#include <CGAL/Mixed_mesh_3/Elastic_material.h>
#include <CGAL/Mixed_mesh_3/Symmetric_solver_traits.h>
#include <CGAL/Mixed_mesh_3/internal/fem/Elasticity_system.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/validation.h>

#include <boost/core/lightweight_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace test_fem {

using namespace CGAL::Mixed_meshes_3;
using namespace CGAL::Mixed_meshes_3::internal;

// ---- elasticity --------------------------------------------------------------------------------

constexpr Elastic_material soft{1, 0.45};

Vec3 linear_field(const Vec3& p)
{
  return {0.1 + 0.3 * p[0] - 0.2 * p[1], -0.2 + 0.5 * p[2] + 0.1 * p[1], 0.4 * p[0] - 0.1 * p[2]};
}

Vec3 rotation(const Vec3& p) { return Vec3{0.3, 0.1, -0.2} + cross(Vec3{0.2, -0.5, 0.7}, p); }

// Solves for the inner nodes with the field prescribed on the boundary.
template <class Solver>
double error_of_field(const Mesh& mesh, Vec3 (*field)(const Vec3&), Solver solver)
{
  const std::vector<bool> is_boundary = is_on_boundary(mesh);
  std::vector<bool> is_free = is_boundary;
  is_free.flip();
  std::vector<Vec3> u;
  for(const Vec3& p : positions(mesh))
    u.push_back(field(p));
  Elasticity_system system(mesh.elements(), is_free);
  BOOST_TEST(system.number_of_unknowns() > 0);
  for(Element_index e : system.active_elements())
    system.add(e, soft, positions(mesh), u);
  const auto matrix = make_matrix<typename Solver::Matrix>(system.starts(), system.rows(), system.values());
  const std::size_t n = std::size_t(system.number_of_unknowns());
  typename Solver::Vector b(n), x(n);
  for(int i = 0; i < system.number_of_unknowns(); ++i)
    b[i] = system.right_hand_side()[i];
  double denominator;
  BOOST_TEST(solver.factor(matrix, denominator));
  BOOST_TEST(solver.linear_solver(b, x));
  double error = 0;
  for(std::size_t i = 0; i < system.free_vertices().size(); ++i)
    for(int k = 0; k < 3; ++k)
      error = (std::max)(error, std::abs(x[int(3 * i) + k] - u[system.free_vertices()[i]][k]));
  return error;
}

void test_elasticity()
{
  for(Element_kind kind : element_kinds) {
    const Mesh mesh = grid(3, kind, 0.15);
    BOOST_TEST(find_defects(mesh).positive());
    BOOST_TEST_LT(error_of_field(mesh, linear_field, Simplicial_solver_traits()), 1e-12);

    // Quadrature gives the volume; rigid motions cause no force, other displacements some energy.
    const Element_view element = mesh.element(0);
    std::array<Vec3, 8> p{};
    for(int i = 0; i < element.size(); ++i)
      p[i] = position(mesh, element[i]);
    double sum = 0;
    for(int q = 0; q < quadrature_rule(kind).number_of_points; ++q)
      sum += strain_operator(kind, p, q).volume;
    BOOST_TEST_LT(std::abs(sum - CGAL::Mixed_meshes_3::volume(mesh, 0)), 1e-14);
    // The energy of a constant strain is volume times stress times strain.
    const double trace = 0.3 + 0.1 - 0.1, strain_squared = 0.09 + 0.01 + 0.01 + (0.04 + 0.16 + 0.25) / 2;
    const double expected = sum * (soft.lambda() * trace * trace + 2 * soft.mu() * strain_squared);
    // The dilatation is its own mean.
    for(Dilatation dilatation : {Dilatation::POINTWISE, Dilatation::MEAN}) {
      Element_stiffness stiffness;
      compute_element_stiffness(kind, p, soft, dilatation, stiffness);
      double rigid = 0, energy = 0;
      for(int a = 0; a < element.size(); ++a) {
        Vec3 force{}, force_of_field{};
        for(int b = 0; b < element.size(); ++b)
          for(int i = 0; i < 3; ++i)
            for(int j = 0; j < 3; ++j) {
              const double k = b <= a ? stiffness[a][b][i][j] : stiffness[b][a][j][i];
              force[i] += k * rotation(p[b])[j];
              force_of_field[i] += k * linear_field(p[b])[j];
            }
        rigid = (std::max)(rigid, norm(force));
        energy += dot(force_of_field, linear_field(p[a]));
      }
      BOOST_TEST_LT(rigid, 1e-14);
      BOOST_TEST_LT(std::abs(energy - expected), 1e-12 * expected);
    }
  }
}
// Tests a solver by itself, with another matrix of the same pattern, and with one of another pattern.
void test_solver()
{
  Simplicial_solver_traits solver;
  for(double diagonal : {2., 4., 3.}) {
    Simplicial_solver_traits::Matrix matrix(2);
    matrix.set_coef(0, 0, diagonal, true);
    matrix.set_coef(1, 1, diagonal, true);
    if(diagonal == 3)
      matrix.set_coef(1, 0, 1, true);
    Simplicial_solver_traits::Vector b(2), x(2);
    b[0] = b[1] = 12;
    double denominator;
    BOOST_TEST(solver.linear_solver(matrix, b, x, denominator));
    BOOST_TEST_LT(std::abs(x[0] - (diagonal == 3 ? 3 : 12 / diagonal)), 1e-14);
    BOOST_TEST_LT(std::abs(x[1] - x[0]), 1e-14);
  }
}

int run(int, char*[])
{
  test_elasticity();
  test_solver();
  return boost::report_errors();
}

} // namespace test_fem
