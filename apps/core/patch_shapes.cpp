// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/patch_shapes.h"

#include "core/comparison.h"
#include "core/misfit.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <sstream>
#include <vector>

namespace mm3 = CGAL::Mixed_meshes_3;

namespace {

using Point = std::array<double, 3>;

// The finite numbers in a text, separated by commas; empty if the text is anything else.
std::vector<double> numbers_in(const std::string& text)
{
  std::vector<double> numbers;
  for(const std::string& word : CLI::detail::split(text + ',', ',')) // which ends at the last comma
    if(!CLI::detail::lexical_cast(word, numbers.emplace_back()) || !std::isfinite(numbers.back()))
      return {};
  return numbers;
}

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
  const char* prefix;
  const char* numbers;
  std::size_t number_of_numbers;
  Patch_shape (*make)(const std::vector<double>&);
};

constexpr Shape_kind kinds[] = {{"sphere:", "X,Y,Z,R", 4, sphere},
                                {"box:", "X0,Y0,Z0,X1,Y1,Z1", 6, box},
                                {"plane:", "X,Y,Z,NX,NY,NZ", 6, half_space}};

} // namespace

std::optional<Patch_shape> patch_shape(const std::string& text)
{
  for(const Shape_kind& kind : kinds) {
    const std::string prefix = kind.prefix;
    if(text.rfind(prefix, 0) != 0)
      continue;
    const std::vector<double> numbers = numbers_in(text.substr(prefix.size()));
    return numbers.size() == kind.number_of_numbers
             ? kind.make(numbers)
             : Patch_shape{"expected numbers as in " + prefix + kind.numbers, nullptr};
  }
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

std::string place_of_mesh(const Mesh& mesh)
{
  const CGAL::Bbox_3 b = box_of(coordinates_of(mesh.points()));
  std::ostringstream text;
  text << "the mesh is in box:" << b.xmin() << ',' << b.ymin() << ',' << b.zmin() << ',' << b.xmax() << ','
       << b.ymax() << ',' << b.zmax();
  return text.str();
}
