// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/boundary_patches.h"

#include "core/comparison.h"
#include "core/misfit.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace mm3 = CGAL::Mixed_meshes_3;

namespace {

using Point = std::array<double, 3>;

Patch_shape sphere(const std::vector<double>& n)
{
  const double radius = n[3];
  return {radius > 0 ? "" : "the radius of the sphere is not positive",
          [center = Point{n[0], n[1], n[2]}, radius](const Point& p, double tolerance) {
            return std::hypot(p[0] - center[0], p[1] - center[1], p[2] - center[2]) <= radius + tolerance;
          }};
}

Patch_shape box(const std::vector<double>& n)
{
  const bool is_ordered = n[0] <= n[3] && n[1] <= n[4] && n[2] <= n[5];
  return {is_ordered ? "" : "the corners of the box are not the lower and the upper one",
          [n](const Point& p, double tolerance) {
            bool is_inside = true;
            for(std::size_t i = 0; i < 3; ++i)
              is_inside = is_inside && p[i] >= n[i] - tolerance && p[i] <= n[i + 3] + tolerance;
            return is_inside;
          }};
}

Patch_shape half_space(const std::vector<double>& n)
{
  const double length = std::hypot(n[3], n[4], n[5]);
  return {length > 0 ? "" : "the normal of the plane is zero", [n, length](const Point& p, double tolerance) {
            double height = 0;
            for(std::size_t i = 0; i < 3; ++i)
              height += (p[i] - n[i]) * (n[i + 3] / length);
            return height >= -tolerance;
          }};
}

struct Shape_kind
{
  const char* name;
  const char* numbers;
  std::size_t number_of_numbers;
  Patch_shape (*make)(const std::vector<double>&);
};

constexpr Shape_kind kinds[] = {{"sphere", "X,Y,Z,R", 4, sphere},
                                {"box", "X0,Y0,Z0,X1,Y1,Z1", 6, box},
                                {"plane", "X,Y,Z,NX,NY,NZ", 6, half_space}};

} // namespace

std::optional<Patch_shape> patch_shape(const std::string& name, const std::vector<double>& numbers)
{
  for(const Shape_kind& kind : kinds)
    if(kind.name == name)
      return numbers.size() == kind.number_of_numbers
                 && std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); })
               ? kind.make(numbers)
               : Patch_shape{"expected numbers as in " + name + ':' + kind.numbers, nullptr};
  return std::nullopt;
}

Point center_of(const Mesh& mesh, const mm3::Face& face)
{
  mm3::Vec3 sum{};
  for(mm3::Vertex_index v : face.vertices())
    sum = sum + mm3::to_vec3(mesh.point(v));
  return 1. / face.vertices().size() * sum;
}

double patch_tolerance(const Mesh& mesh)
{
  const CGAL::Bbox_3 b = box_of(coordinates_of(mesh.points()));
  return on_surface * std::hypot(b.x_span(), b.y_span(), b.z_span());
}

std::vector<std::size_t> faces_in_patch(const Mesh& mesh, const std::vector<mm3::Face>& faces,
                                        const Patch_test& contains)
{
  const double tolerance = patch_tolerance(mesh);
  std::vector<std::size_t> positions;
  for(std::size_t i = 0; i < faces.size(); ++i)
    if(contains(center_of(mesh, faces[i]), tolerance))
      positions.push_back(i);
  return positions;
}

std::string place_of_mesh(const Mesh& mesh)
{
  const CGAL::Bbox_3 b = box_of(coordinates_of(mesh.points()));
  std::ostringstream text;
  text << "the mesh is in box:" << b.xmin() << ',' << b.ymin() << ',' << b.zmin() << ',' << b.xmax() << ','
       << b.ymax() << ',' << b.zmax();
  return text.str();
}

std::string sentence_on_empty_patch(const Mesh& mesh)
{
  return "no face of the boundary has its center inside; " + place_of_mesh(mesh);
}
