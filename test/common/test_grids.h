// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Distorted grids, and conditions on a mesh for tests.

#ifndef MIXED_MESH_3_TEST_GRIDS_H
#define MIXED_MESH_3_TEST_GRIDS_H

#include "test_meshes.h"
#include "test_surfaces.h"

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <cstdint>
#include <vector>

using CGAL::Mixed_meshes_3::Element_kind;
using CGAL::Mixed_meshes_3::Vec3;
using CGAL::Mixed_meshes_3::Vertex_index;

using Mesh = CGAL::Mixed_mesh_3<Test_kernel>;

// Numbers in [-1,1], the same everywhere.
class Noise
{
  std::uint32_t m_state = 1;

public:
  double operator()()
  {
    m_state = m_state * 1664525u + 1013904223u;
    return double(m_state >> 8) / double(1 << 23) - 1;
  }
};

// n^3 cells in [0,1]^3, of elements of one kind; vertices moved by up to `noise` cells.
inline Mesh grid(int n, Element_kind kind, double noise = 0)
{
  Noise random;
  return grid_of_cells<Mesh>(n, kind, [&](double x, double y, double z) {
    const double dx = noise * random(), dy = noise * random(), dz = noise * random(); // in this order
    return Test_point((x + dx) / n, (y + dy) / n, (z + dz) / n);
  });
}

inline Vec3 position(const Mesh& mesh, Vertex_index v)
{
  return CGAL::Mixed_meshes_3::to_vec3(mesh.point(v));
}

inline std::vector<Vec3> positions(const Mesh& mesh)
{
  std::vector<Vec3> p;
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v)
    p.push_back(position(mesh, v));
  return p;
}

inline std::vector<bool> is_on_boundary(const Mesh& mesh)
{
  std::vector<bool> result(mesh.number_of_vertices());
  for(Vertex_index v : CGAL::Mixed_meshes_3::boundary_vertices(mesh))
    result[v] = true;
  return result;
}

#endif // MIXED_MESH_3_TEST_GRIDS_H
