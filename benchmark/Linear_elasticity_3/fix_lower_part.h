// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The supports of the benchmarks of time and memory.

#ifndef MIXED_MESH_3_BENCHMARK_FIX_LOWER_PART_H
#define MIXED_MESH_3_BENCHMARK_FIX_LOWER_PART_H

#include <CGAL/Linear_elasticity_3.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>

inline void check(const CGAL::Linear_elasticity_result_3& result)
{
  if(!result.is_success())
    throw std::runtime_error(result.description());
}

/// Fixes the boundary vertices of the lower 30 % of the mesh.
/// \return the number of free vertices
template <class Elasticity>
std::size_t fix_lower_part(Elasticity& elasticity)
{
  const auto& mesh = elasticity.mesh();
  double lowest = mesh.point(0).z(), highest = lowest;
  for(const auto& p : mesh.points()) {
    lowest = (std::min)(lowest, p.z());
    highest = (std::max)(highest, p.z());
  }
  std::size_t free = mesh.number_of_vertices();
  for(CGAL::Mixed_meshes_3::Vertex_index v : CGAL::Mixed_meshes_3::boundary_vertices(mesh))
    if(mesh.point(v).z() < lowest + 0.3 * (highest - lowest)) {
      elasticity.prescribe(v);
      --free;
    }
  return free;
}

#endif // MIXED_MESH_3_BENCHMARK_FIX_LOWER_PART_H
