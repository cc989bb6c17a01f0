// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Operations on meshes for the tests of the fitting stage.

#ifndef MIXED_MESH_3_TEST_FITTING_H
#define MIXED_MESH_3_TEST_FITTING_H

#include "test_grids.h"
#include "test_surfaces.h"

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/certificate.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <set>
#include <vector>

using CGAL::Mixed_meshes_3::Jacobian_sign;

inline bool is_positive(const Mesh& mesh)
{
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
    if(CGAL::Mixed_meshes_3::jacobian_sign(mesh, e) != Jacobian_sign::POSITIVE)
      return false;
  return true;
}

inline bool is_same(const Mesh& a, const Mesh& b)
{
  return a.points() == b.points() && a.elements().kinds() == b.elements().kinds()
         && a.elements().connectivity() == b.elements().connectivity();
}

using Polygon = std::vector<Vertex_index>;

// The polygons of the boundary from the smallest vertex on, with their orientation.
inline std::set<Polygon> boundary_of(const Mesh& mesh)
{
  std::set<Polygon> result;
  for(const auto& f : CGAL::Mixed_meshes_3::boundary_faces(mesh)) {
    Polygon v(f.vertices().begin(), f.vertices().end());
    std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
    result.insert(v);
  }
  return result;
}

// Moves inner vertices as far as all elements stay valid.
inline void distort(Mesh& mesh, double amplitude, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-amplitude, amplitude);
  const std::vector<bool> is_fixed = is_on_boundary(mesh);
  for(int round = 0; round < 3; ++round)
    for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
      if(!is_fixed[v]) {
        const Test_point old = mesh.point(v);
        const double x = uniform(random), y = uniform(random), z = uniform(random); // in this order
        mesh.points()[v] = old + Test_kernel::Vector_3(x, y, z);
        if(!is_positive(mesh))
          mesh.points()[v] = old;
      }
}

#endif // MIXED_MESH_3_TEST_FITTING_H
