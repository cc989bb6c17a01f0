// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What guards the adaptation of a mesh: smooth loads around the given ones, and vertices at the border of
// supports that stay. Without them, a mesh that gets better for its load cases gets worse for other loads.

#ifndef CGAL_LINEAR_ELASTICITY_3_INTERNAL_GUARD_LOADS_H
#define CGAL_LINEAR_ELASTICITY_3_INTERNAL_GUARD_LOADS_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <CGAL/Linear_elasticity_3/Mixed_mesh_adaptation_criteria_3.h>
#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/for_each_face.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Whether each vertex is on the boundary of the mesh.
inline std::vector<bool> boundary_flags(const Element_list& elements, std::size_t number_of_vertices)
{
  std::vector<bool> is_on_boundary(number_of_vertices, false);
  for_each_face(elements, number_of_vertices, [&](const auto& group) {
    const Face face = group[0];
    if(group.size() != 2)
      for(Vertex_index v : face.vertices())
        is_on_boundary[v] = true;
  });
  return is_on_boundary;
}

/*!
Displacements of the whole boundary that are smooth and largest where the load cases are: Gaussians of the
distance from the center of the loads, along each axis, of two widths. With weights \f$ |u|^2 \f$, the center
is the mean of the loaded vertices, and the widths are multiples of their root mean square distance from the
center, the radius of the loads. Of the narrow Gaussian, most of the energy is within a few radii: there,
elements stay good for smooth loads. Of the wide Gaussian, the energy is in the whole mesh.

\return no load if the load cases displace nothing, or a single vertex only
*/
inline std::vector<Prescribed_displacements> guard_loads(const std::vector<Vec3>& points,
                                                         const std::vector<bool>& is_on_boundary,
                                                         const std::vector<Prescribed_displacements>& cases)
{
  // Widths in radii. With widths of 2 and 5 only, errors of smooth loads increased in deep tumors.
  constexpr double widths[] = {2, 10};
  double sum = 0, squared_radius = 0;
  Vec3 center{};
  for(const Prescribed_displacements& displacements : cases)
    for(const auto& [v, u] : displacements) {
      sum += dot(u, u);
      center = center + dot(u, u) * points[v];
    }
  if(!(sum > 0))
    return {};
  center = (1 / sum) * center;
  const auto squared_distance = [&](Vertex_index v) { return dot(points[v] - center, points[v] - center); };
  for(const Prescribed_displacements& displacements : cases)
    for(const auto& [v, u] : displacements)
      squared_radius += dot(u, u) / sum * squared_distance(v);
  if(!(squared_radius > 0))
    return {};
  std::vector<Prescribed_displacements> guards;
  for(double width : widths)
    for(std::size_t axis = 0; axis < 3; ++axis) {
      Prescribed_displacements& guard = guards.emplace_back();
      for(Vertex_index v = 0; v < points.size(); ++v)
        if(is_on_boundary[v])
          guard[v][axis] = std::exp(-squared_distance(v) / (2 * width * width * squared_radius));
    }
  return guards;
}

/// Marks the vertices of elements at the border of the supports: elements with vertices whose displacement a
/// case prescribes, and vertices of the boundary that are free in this case. At the border, the exact
/// solution is singular, and the mesh knows its place only to within an element: so energy that is gained
/// there is mostly that of the discrete border, and elements that follow it increase the displacement far
/// away.
inline std::vector<bool> vertices_at_borders(const Element_list& elements,
                                             const std::vector<bool>& is_on_boundary,
                                             const std::vector<Prescribed_displacements>& cases)
{
  std::vector<bool> is_at_border(is_on_boundary.size(), false);
  for(const Prescribed_displacements& displacements : cases) {
    std::vector<bool> is_prescribed(is_on_boundary.size(), false);
    for(const auto& one : displacements)
      is_prescribed[one.first] = true;
    for(Element_index e = 0; e < elements.size(); ++e) {
      const Element_view element = elements[e];
      if(std::any_of(element.begin(), element.end(), [&](Vertex_index v) { return is_prescribed[v]; })
         && std::any_of(element.begin(), element.end(),
                        [&](Vertex_index v) { return is_on_boundary[v] && !is_prescribed[v]; }))
        for(Vertex_index v : element)
          is_at_border[v] = true;
    }
  }
  return is_at_border;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_INTERNAL_GUARD_LOADS_H
