// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The standard finite elements of degree 1, with the dilatation at each point of the quadrature, as other
// programs have them: they lock.

#ifndef MIXED_MESH_3_TEST_STANDARD_ELASTICITY_H
#define MIXED_MESH_3_TEST_STANDARD_ELASTICITY_H

#include <CGAL/Mixed_mesh_3/Symmetric_solver_traits.h>
#include <CGAL/Mixed_mesh_3/internal/fem/Elasticity_system.h>

#include <boost/core/lightweight_test.hpp>

#include <cstddef>
#include <vector>

// Displacements of all vertices, from those of some vertices, with a material for each element.
template <class Mesh>
std::vector<CGAL::Mixed_meshes_3::Vec3>
standard_solution(const Mesh& mesh, const std::vector<CGAL::Mixed_meshes_3::Elastic_material>& materials,
                  std::vector<bool> is_prescribed, std::vector<CGAL::Mixed_meshes_3::Vec3> displacements)
{
  using namespace CGAL::Mixed_meshes_3::internal;
  using CGAL::Mixed_meshes_3::Vec3;
  using Solver = CGAL::Mixed_meshes_3::Direct_solver_traits;
  is_prescribed.flip();
  Elasticity_system system(mesh.elements(), is_prescribed);
  system.clear();
  std::vector<Vec3> points;
  for(const auto& p : mesh.points())
    points.push_back(CGAL::Mixed_meshes_3::to_vec3(p));
  for(auto e : system.active_elements())
    system.add(e, materials[e], points, displacements, Dilatation::POINTWISE);
  const auto matrix = make_matrix<Solver::Matrix>(system.starts(), system.rows(), system.values());
  const std::size_t n = std::size_t(system.number_of_unknowns());
  Solver::Vector b(n), x(n);
  for(std::size_t i = 0; i < n; ++i)
    b[Eigen::Index(i)] = system.right_hand_side()[i];
  double denominator;
  BOOST_TEST(Solver().linear_solver(matrix, b, x, denominator));
  for(std::size_t i = 0; i < system.free_vertices().size(); ++i)
    for(std::size_t k = 0; k < 3; ++k)
      displacements[system.free_vertices()[i]][k] = x[Eigen::Index(3 * i + k)];
  return displacements;
}

template <class Mesh>
std::vector<CGAL::Mixed_meshes_3::Vec3>
standard_solution(const Mesh& mesh, const CGAL::Mixed_meshes_3::Elastic_material& material,
                  const std::vector<bool>& is_prescribed,
                  const std::vector<CGAL::Mixed_meshes_3::Vec3>& displacements)
{
  const std::vector<CGAL::Mixed_meshes_3::Elastic_material> materials(mesh.number_of_elements(), material);
  return standard_solution(mesh, materials, is_prescribed, displacements);
}

#endif // MIXED_MESH_3_TEST_STANDARD_ELASTICITY_H
