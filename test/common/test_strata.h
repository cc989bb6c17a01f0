// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A boundary without subdomains, as the optimization sees it.

#ifndef MIXED_MESH_3_TEST_STRATA_H
#define MIXED_MESH_3_TEST_STRATA_H

#include <CGAL/Mixed_mesh_3/internal/fitting/Surface_tolerances.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Working_mesh.h>

#include <cstddef>
#include <utility>
#include <vector>

inline CGAL::Mixed_meshes_3::internal::Interface_faces
interface_faces(const std::vector<CGAL::Mixed_meshes_3::Face>& boundary)
{
  using namespace CGAL::Mixed_meshes_3::internal;
  return {boundary, std::vector<Stratum>(boundary.size(), boundary_stratum)};
}

template <class Mesh>
CGAL::Mixed_meshes_3::internal::Working_mesh
working_mesh(const Mesh& mesh, const std::vector<CGAL::Mixed_meshes_3::Face>& boundary)
{
  using namespace CGAL::Mixed_meshes_3::internal;
  std::vector<Stratum> strata(mesh.number_of_vertices(), free_stratum);
  for(const auto& face : boundary)
    for(auto v : face.vertices())
      strata[v] = boundary_stratum;
  return Working_mesh(mesh, std::move(strata));
}

inline std::vector<CGAL::Mixed_meshes_3::internal::Surface_sample>
with_tolerance(const std::vector<CGAL::Mixed_meshes_3::Vec3>& points, double tolerance)
{
  std::vector<CGAL::Mixed_meshes_3::internal::Surface_sample> samples;
  for(const auto& p : points)
    samples.push_back({p, tolerance});
  return samples;
}

// Any function of a point and a hint as a projection onto one surface.
template <class Function>
struct Test_projection
{
  Function function;

  using Vec3 = CGAL::Mixed_meshes_3::Vec3;
  using Stratum = CGAL::Mixed_meshes_3::internal::Stratum;
  Vec3 operator()(const Vec3& p, const Vec3& hint, Stratum) const { return function(p, hint); }
  Vec3 operator()(const Vec3& p, Stratum) const { return function(p, p); }
  bool is_reached(const Vec3&, Stratum) const { return true; }
  bool is_concurrent(Stratum) const { return true; }
};
template <class Function>
Test_projection(Function) -> Test_projection<Function>;

#endif // MIXED_MESH_3_TEST_STRATA_H
