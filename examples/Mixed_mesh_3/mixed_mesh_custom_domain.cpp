// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A domain without a surface mesh, by a user-defined class: a solid ring, given by its signed distance.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mixed_mesh_3/IO/write_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/make_mixed_mesh_3.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <vector>

namespace mm3 = CGAL::Mixed_meshes_3;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Mixed_mesh_3<Kernel>;

// Model of MixedMeshDomain_3: the points within `r` of a circle of radius `R` about the z-axis.
class Ring_domain
{
  static constexpr double R = 3, r = 1;

public:
  using Point_3 = Kernel::Point_3;

  // The data about the surface in a cell. A formula needs no such data.
  struct Surface_part
  {
  };
  Surface_part surface_part() const { return {}; }

  CGAL::Bbox_3 bbox() const { return {-R - r, -R - r, -r, R + r, R + r, r}; }

  // The signed distance, positive outside.
  double signed_distance(const Point_3& p) const
  {
    return std::hypot(std::hypot(p.x(), p.y()) - R, p.z()) - r;
  }

  // A cell is off the surface if its circumscribed ball is. Too many answers ON_BOUNDARY cost time; too few
  // would lose parts of the domain.
  template <class Cell>
  CGAL::Bounded_side locate(const Cell& cell, const Surface_part&, Surface_part&) const
  {
    const CGAL::Bbox_3 b = cell.bbox();
    const double radius = std::hypot(b.x_span(), b.y_span(), b.z_span()) / 2;
    const double d = signed_distance(cell.center());
    return d > radius ? CGAL::ON_UNBOUNDED_SIDE : d < -radius ? CGAL::ON_BOUNDED_SIDE : CGAL::ON_BOUNDARY;
  }

  CGAL::Bounded_side bounded_side(const Point_3& p, const Surface_part&) const
  {
    const double d = signed_distance(p);
    return d > 0 ? CGAL::ON_UNBOUNDED_SIDE : d < 0 ? CGAL::ON_BOUNDED_SIDE : CGAL::ON_BOUNDARY;
  }

  // The point of the surface on the ray from the nearest point of the circle through `p`. On the axis, and on
  // the circle, all directions are equivalent.
  Point_3 closest_point(const Point_3& p) const
  {
    const double d = std::hypot(p.x(), p.y());
    const Point_3 q = d > 0 ? Point_3(R / d * p.x(), R / d * p.y(), 0) : Point_3(R, 0, 0);
    const double distance = std::hypot(d - R, p.z());
    return distance > 0 ? q + r / distance * (p - q) : q + Kernel::Vector_3(0, 0, r);
  }
  // The same, with a hint: the data about the surface in a cell, or a point of the surface near `p`.
  Point_3 closest_point(const Point_3& p, const Surface_part&) const { return closest_point(p); }
  Point_3 closest_point(const Point_3& p, const Point_3&) const { return closest_point(p); }

  // A grid of that spacing, along the circle and around it. With a tolerance, distances are measured there.
  std::vector<Point_3> surface_samples(double spacing) const
  {
    std::vector<Point_3> samples;
    const int m = int(std::ceil(2 * CGAL_PI * (R + r) / spacing));
    const int n = int(std::ceil(2 * CGAL_PI * r / spacing));
    for(int i = 0; i < m; ++i)
      for(int j = 0; j < n; ++j) {
        const double a = 2 * CGAL_PI * i / m, b = 2 * CGAL_PI * j / n, d = R + r * std::cos(b);
        samples.emplace_back(d * std::cos(a), d * std::sin(a), r * std::sin(b));
      }
    return samples;
  }
};

int main()
{
  // The mesh is fine in a ball at one side of the ring.
  const Ring_domain ring;
  const CGAL::Ball_mixed_mesh_region_3 ball({3, 0, 0}, 1.5);
  Mesh mesh;
  // No cell is larger than a quarter of the ring's thickness.
  const auto criteria = CGAL::Mixed_mesh_criteria_3(5000).base_level(4);
  const auto result = CGAL::make_mixed_mesh_3(ring, ball, criteria, mesh);
  if(result.status != CGAL::Mixed_mesh_status::SUCCESS)
    return EXIT_FAILURE;

  // The boundary consists of triangles. Its Euler characteristic is 0, as of a torus, if the hole exists.
  const std::vector<mm3::Face> boundary = mm3::boundary_faces(mesh);
  const std::vector<mm3::Vertex_index> boundary_vertices = mm3::vertices_of(boundary);
  double farthest = 0; // distance of the boundary's vertices from the surface
  for(mm3::Vertex_index v : boundary_vertices)
    farthest = (std::max)(farthest, std::abs(ring.signed_distance(mesh.point(v))));
  const std::size_t triangles = boundary.size(), edges = triangles * 3 / 2;
  const long characteristic = long(boundary_vertices.size()) - long(edges) + long(triangles);
  std::cout << mesh.number_of_vertices() << " vertices, " << mesh.number_of_elements()
            << " elements; Euler characteristic of the boundary: " << characteristic
            << "; its vertices are on the surface to " << farthest << '\n';

  std::string error;
  if(!mm3::IO::write_mixed_mesh("mixed_mesh_custom_domain.vtu", mesh, {}, &error)) {
    std::cerr << error << '\n';
    return EXIT_FAILURE;
  }
  return characteristic == 0 && farthest < 1e-12 ? EXIT_SUCCESS : EXIT_FAILURE;
}
