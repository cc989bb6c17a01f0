// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Brain shift with known boundary displacements, and what is compared: the displacement at points of the
// region.

#ifndef MIXED_MESH_3_BENCHMARK_TEST_CASES_H
#define MIXED_MESH_3_BENCHMARK_TEST_CASES_H

#include "common/resources.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_regions_3.h>
#include <CGAL/Polyhedral_mixed_mesh_domain_3.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace mm3 = CGAL::Mixed_meshes_3;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Mixed_mesh_3<Kernel>;
using Vector = mm3::Vec3;

/// The bundled brain's; millimeters.
struct Brain
{
  CGAL::Surface_mesh<Kernel::Point_3> surface, region;
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;

  Brain(const std::string& surface_file, const std::string& region_file)
  {
    require([&](std::string* error) { return mm3::IO::read_closed_surface(surface_file, surface, error); });
    require([&](std::string* error) { return mm3::IO::read_closed_surface(region_file, region, error); });
    for(auto v : surface.vertices()) {
      lowest = (std::min)(lowest, surface.point(v).z());
      highest = (std::max)(highest, surface.point(v).z());
    }
  }

  /// Points inside the region, at least `depth` below the surface of the brain; always the same.
  std::vector<Vector> points_to_compare(std::size_t number, double depth) const
  {
    const CGAL::Polyhedral_mixed_mesh_domain_3 domain(surface);
    const CGAL::Polyhedral_mixed_mesh_region_3 inside_brain(surface), inside_region(region);
    const CGAL::Bbox_3 box = CGAL::Polyhedral_mixed_mesh_domain_3(region).bbox();
    std::mt19937 generator(1);
    const auto between = [&](double a, double b) {
      return a + (b - a) * (double(generator()) / 4294967296.);
    };
    std::vector<Vector> points;
    while(points.size() < number) {
      Vector p;
      for(int k : {2, 1, 0})
        p[k] = between((box.min)(k), (box.max)(k));
      const CGAL::Polyhedral_mixed_mesh_region_3::Point_3 q(p[0], p[1], p[2]);
      if(inside_region.depth(q) > 0 && inside_brain.depth(q) >= depth)
        points.push_back(p);
    }
    return points;
  }
};

/// What a boundary vertex is prescribed, if it is.
using Boundary_displacement = std::optional<Vector> (*)(const Vector& p, const Brain& brain);

inline constexpr Vector opening{44, 30, 75}, tumor{28, 18, 28}; // centers; see data/README.md
inline constexpr double push = 10;                              // millimeters towards the tumor

struct Opening_coordinates
{
  Vector axis; // of length 1, inwards
  double depth, from_axis, from_opening, length;

  explicit Opening_coordinates(const Vector& p)
  {
    using namespace mm3::internal;
    length = norm(tumor - opening);
    axis = (1 / length) * (tumor - opening);
    depth = dot(p - opening, axis);
    from_axis = norm(p - opening - depth * axis);
    from_opening = norm(p - opening);
  }
};

/// The surface within 20 mm of the axis, on the opening's side, is pushed by a bump of 10 mm; the lower 30 %
/// of the brain are fixed; the rest is free.
inline std::optional<Vector> bump_displacement(const Vector& p, const Brain& brain)
{
  using namespace mm3::internal;
  constexpr double radius = 20, fixed_share = 0.3;
  const Opening_coordinates c(p);
  if(p[2] < brain.lowest + fixed_share * (brain.highest - brain.lowest))
    return Vector{};
  if(c.from_axis < radius && c.depth < c.length)
    return (push * (1 + std::cos(M_PI * c.from_axis / radius)) / 2) * c.axis;
  return std::nullopt;
}

/// All of the boundary is prescribed, smoothly: a Gaussian around the opening.
inline std::optional<Vector> smooth_displacement(const Vector& p, const Brain&)
{
  using namespace mm3::internal;
  constexpr double width = 25;
  const Opening_coordinates c(p);
  return (push * std::exp(-c.from_opening * c.from_opening / (2 * width * width))) * c.axis;
}

inline std::vector<bool> boundary_vertices(const Mesh& mesh)
{
  std::vector<bool> is_on_boundary(mesh.number_of_vertices(), false);
  for(mm3::Vertex_index v : mm3::boundary_vertices(mesh))
    is_on_boundary[v] = true;
  return is_on_boundary;
}

#endif // MIXED_MESH_3_BENCHMARK_TEST_CASES_H
