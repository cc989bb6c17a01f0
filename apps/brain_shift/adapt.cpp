// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "brain_shift/adapt.h"

#include "brain_shift/subdomains.h"
#include "core/messages.h"

#include <CGAL/Linear_elasticity_3/adapt_mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace mm3 = CGAL::Mixed_meshes_3;

namespace {

// A disk of the boundary around the control points, about as large as the opening in which they were
// measured.
struct Opening_disk
{
  Vector center{};
  double radius = 0;
};

// The disk around the control points. The outermost points are halfway to the border, where a bump has half
// its height; or as far from the border as the radius over which control points are averaged.
Opening_disk disk_around(const Mesh& mesh, double control_radius, const Outcome& outcome)
{
  Opening_disk disk;
  std::vector<Vector> points; // points in the mesh
  for(const auto& location : outcome.locations) {
    Vector p{};
    for(int i = 0; i < mesh.element(location.element).size(); ++i)
      p = p + location.weights[std::size_t(i)] * mm3::to_vec3(mesh.point(mesh.element(location.element)[i]));
    points.push_back(p);
    disk.center = disk.center + (1 / double(outcome.locations.size())) * p;
  }
  double farthest = 0;
  for(const Vector& p : points)
    farthest = (std::max)(farthest, norm(p - disk.center));
  disk.radius = farthest + (std::max)(farthest, control_radius);
  return disk;
}

// The mean normal of the boundary in the disk, and two directions perpendicular to the normal.
std::array<Vector, 3> directions_at(const Mesh& mesh, const Opening_disk& disk)
{
  Vector normal{};
  for(const mm3::Face& face : mm3::boundary_faces(mesh)) {
    const auto vertices = face.vertices();
    if(std::any_of(vertices.begin(), vertices.end(), [&](mm3::Vertex_index v) {
         return norm(mm3::to_vec3(mesh.point(v)) - disk.center) < disk.radius;
       }))
      normal = normal + mm3::vector_area(mesh, face);
  }
  if(!(norm(normal) > 0)) // the disk may be a whole closed boundary
    return {Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, 0, 1}};
  normal = (1 / norm(normal)) * normal;
  Vector axis{};
  const auto is_smaller = [](double x, double y) { return std::abs(x) < std::abs(y); };
  axis[std::size_t(std::min_element(normal.begin(), normal.end(), is_smaller) - normal.begin())] = 1;
  Vector tangent = cross(normal, axis);
  tangent = (1 / norm(tangent)) * tangent;
  return {normal, tangent, cross(normal, tangent)};
}

} // namespace

void adapt(Mesh& mesh, const std::string& mesh_file, const Boundary_patches& patches,
           const Support_options& options, double radius, Outcome& outcome)
{
  const Supports supports = find_supports(mesh, patches, options, outcome.points);
  const Opening_disk disk = disk_around(mesh, radius, outcome);
  const std::array<Vector, 3> directions = directions_at(mesh, disk);
  std::vector<mm3::Prescribed_displacements> cases(directions.size());
  std::size_t loaded = 0;
  for(mm3::Vertex_index v : mm3::boundary_vertices(mesh)) {
    const double distance = norm(mm3::to_vec3(mesh.point(v)) - disk.center);
    const bool is_free = supports.of_vertices[v] == Support::FREE,
               is_loaded = is_free && distance < disk.radius;
    loaded += is_loaded;
    const double height = is_loaded ? (1 + std::cos(M_PI * distance / disk.radius)) / 2 : 0;
    for(std::size_t i = 0; i < cases.size() && (is_loaded || !is_free); ++i)
      cases[i][v] = height * directions[i];
  }
  // Least number of loaded vertices: three hold rigid motions if no support does.
  constexpr std::size_t least_loaded = 3;
  if(loaded < least_loaded)
    throw std::runtime_error(
      "--adapt: there is nothing to adapt to: " + counted(loaded, "vertex", "vertices")
      + " of the boundary within " + rounded(disk.radius)
      + " mm of the center of the control points can move; with --control-radius it is a "
        "larger distance");
  std::vector<mm3::Elastic_material> materials = materials_of_elements(mesh, outcome.subdomains);
  // Largest Poisson's ratio. Standard elements lock if the material is nearly incompressible, unlike elements
  // of the simulation: their energy would be that of locking. 0.3 was best among 0, 0.3, 0.4 and 0.45; see
  // the manual.
  constexpr double largest_poisson_ratio = 0.3;
  for(mm3::Elastic_material& m : materials)
    m.poisson_ratio = (std::min)(m.poisson_ratio, largest_poisson_ratio);
  outcome.adaptation = CGAL::adapt_mixed_mesh_3(mesh, materials, cases);
  using Status = CGAL::Mixed_mesh_adaptation_status;
  const Status status = outcome.adaptation->status;
  if(status != Status::CONVERGED && status != Status::SOLVES_EXHAUSTED)
    throw std::runtime_error("--adapt: " + mesh_file + " cannot be adapted: " + mm3::description(status));
}
