// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "brain_shift/supports.h"

#include <CGAL/Mixed_mesh_3/boundary_faces.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace mm3 = CGAL::Mixed_meshes_3;

Supports find_supports(const Mesh& mesh, const Boundary_patches& patches, const Support_options& o,
                       const std::vector<Control_point>& points)
{
  const std::vector<mm3::Vertex_index> boundary = mm3::boundary_vertices(mesh);
  const auto position = [&mesh](mm3::Vertex_index v) { return mm3::to_vec3(mesh.point(v)); };
  const auto height = [&](mm3::Vertex_index v) { return dot(position(v), Vector(o.up)); };
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for(mm3::Vertex_index v : boundary) {
    lowest = (std::min)(lowest, height(v));
    highest = (std::max)(highest, height(v));
  }
  const auto is_below = [&](mm3::Vertex_index v, double part) {
    return height(v) < lowest + part * (highest - lowest);
  };
  const auto is_held = [&](mm3::Vertex_index v) {
    double distance = std::numeric_limits<double>::infinity();
    for(const Control_point& point : points)
      distance = (std::min)(distance, norm(Vector(point.position) - position(v)));
    return is_below(v, o.slide_below) || distance > o.slide_beyond;
  };
  Supports supports{boundary.size(), 0, 0, 0, std::vector<Support>(mesh.number_of_vertices(), Support::FREE)};
  for(mm3::Vertex_index v : boundary) {
    const Patch patch = patches.of_vertices[v];
    if(patch == Patch::FIXED || (patch != Patch::OPENING && is_below(v, o.fixed_below))) {
      supports.of_vertices[v] = Support::FIXED;
      ++supports.fixed;
    } else if(patch == Patch::SLIDING || (patch != Patch::OPENING && is_held(v))) {
      supports.of_vertices[v] = Support::SLIDING;
      ++supports.sliding;
    } else if(patch == Patch::TOUCHING) {
      supports.of_vertices[v] = Support::TOUCHING;
      ++supports.touching;
    }
  }
  return supports;
}
