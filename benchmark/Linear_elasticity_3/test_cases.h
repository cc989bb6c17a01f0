// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Brain shift with known boundary displacements, and the points of comparison: the displacement at points of
// the region.

#ifndef MIXED_MESH_3_BENCHMARK_TEST_CASES_H
#define MIXED_MESH_3_BENCHMARK_TEST_CASES_H

#include "Opening.h"

#include "core/resources.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_regions_3.h>
#include <CGAL/Polyhedral_mixed_mesh_region_3.h>
#include <CGAL/Polyhedral_mixed_mesh_domain_3.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace mm3 = CGAL::Mixed_meshes_3;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Mixed_mesh_3<Kernel>;
using Vector = mm3::Vec3;

/// A brain and its extent in height; millimeters.
struct Brain
{
  CGAL::Surface_mesh<Kernel::Point_3> surface;
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;

  explicit Brain(const std::string& file)
  {
    require([&](std::string* error) { return mm3::IO::read_closed_surface(file, surface, error); });
    for(auto v : surface.vertices()) {
      lowest = (std::min)(lowest, surface.point(v).z());
      highest = (std::max)(highest, surface.point(v).z());
    }
  }
};

/// Points inside the region, at least `depth` below the surface of the brain; always the same.
inline std::vector<Vector> points_to_compare(const CGAL::Polyhedral_mixed_mesh_region_3& inside_brain,
                                             const CGAL::Surface_mesh<Kernel::Point_3>& region,
                                             std::size_t number, double depth)
{
  const CGAL::Polyhedral_mixed_mesh_region_3 inside_region(region);
  const CGAL::Bbox_3 box = CGAL::Polyhedral_mixed_mesh_domain_3(region).bbox();
  std::mt19937 generator(1);
  const auto between = [&](double a, double b) { return a + (b - a) * (double(generator()) / 4294967296.); };
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

/// The prescribed displacement of a boundary vertex, if there is one.
using Boundary_displacement = std::function<std::optional<Vector>(const Vector&)>;

inline constexpr double push = 10; // millimeters towards the tumor

struct Opening_coordinates
{
  double depth, from_axis, from_opening;

  Opening_coordinates(const Vector& p, const Opening& o)
  {
    depth = dot(p - o.center, o.axis);
    from_axis = norm(p - o.center - depth * o.axis);
    from_opening = norm(p - o.center);
  }
};

/// Whether a point of the surface is as near to the axis as the opening's border, and on its side.
inline bool is_in_patch(const Vector& p, const Opening& o)
{
  const Opening_coordinates c(p, o);
  return c.from_axis < o.radius && c.depth < o.length;
}

/// The surface below the opening is pushed by a bump of 10 mm; the lower 30 % of the brain are fixed; the
/// rest is free.
inline Boundary_displacement bump_displacement(const Opening& o, const Brain& brain)
{
  constexpr double fixed_share = 0.3;
  const double fixed_below = brain.lowest + fixed_share * (brain.highest - brain.lowest);
  return [=](const Vector& p) -> std::optional<Vector> {
    if(p[2] < fixed_below)
      return Vector{};
    if(!is_in_patch(p, o))
      return std::nullopt;
    return (push * (1 + std::cos(M_PI * Opening_coordinates(p, o).from_axis / o.radius)) / 2) * o.axis;
  };
}

/// All of the boundary is prescribed, smoothly: a Gaussian around the opening.
inline Boundary_displacement smooth_displacement(const Opening& o)
{
  constexpr double width = 25;
  return [=](const Vector& p) -> std::optional<Vector> {
    const double distance = Opening_coordinates(p, o).from_opening;
    return (push * std::exp(-distance * distance / (2 * width * width))) * o.axis;
  };
}

inline std::vector<bool> boundary_vertices(const Mesh& mesh)
{
  std::vector<bool> is_on_boundary(mesh.number_of_vertices(), false);
  for(mm3::Vertex_index v : mm3::boundary_vertices(mesh))
    is_on_boundary[v] = true;
  return is_on_boundary;
}

#endif // MIXED_MESH_3_BENCHMARK_TEST_CASES_H
