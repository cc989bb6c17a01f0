// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shape functions of the edges: together with those of the vertices, they make an element quadratic.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_EDGE_FUNCTIONS_H
#define CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_EDGE_FUNCTIONS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Mixed_element_traits_3.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <array>
#include <cstddef>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The value and the gradient of a function of the reference coordinates.
struct Differentiated
{
  double value;
  Vec3 gradient;
};

inline Differentiated operator*(const Differentiated& f, const Differentiated& g)
{
  return {f.value * g.value, f.value * g.gradient + g.value * f.gradient};
}

inline Differentiated operator*(double c, const Differentiated& f) { return {c * f.value, c * f.gradient}; }

/// The largest number of edges of an element: of a hexahedron, four in each direction.
inline constexpr int largest_number_of_edges = 12;

/*!
The shape function of each edge, in the order of `Reference_element::edges`: 1 in the middle of its edge, 0 on
the other edges. With the shape functions N of the vertices, and the ends i and j,

    tetrahedron    4 N_i N_j
    pyramid        4 N_i N_j for an edge to the apex; (1 - t)^2 (1 - a^2) (1 +- b) / 2 for an edge along a,
                   with a = r / (1 - t), b = s / (1 - t), or the other way around
    prism          4 l_i l_j (1 +- t) / 2 for edges of triangles, l barycentric; l_i (1 - t^2) for the others
    hexahedron     (1 - r^2) (1 +- s) (1 +- t) / 4, and the same along s and t

On a triangle, these are 4 l_i l_j for the edges of the triangle, and zero for others; on a quadrilateral with
coordinates x and y in [-1,1], they are (1 - x^2) (1 +- y) / 2 and (1 - y^2) (1 +- x) / 2. So a field is
continuous whatever the kinds of elements are, also where edges take no part. On elements with affine maps,
all quadratic polynomials are among the fields: elements are the serendipity elements of 10, 13, 15 and 20
nodes (pyramid: G. Bedrosian, "Shape functions and integration formulas for three-dimensional finite element
analysis", Int. J. Numer. Meth. Engng 35, 1992).

Gradients are not defined at the pyramid's apex.
*/
template <Element_kind Kind>
std::array<Differentiated, largest_number_of_edges> edge_functions(const Vec3& r)
{
  std::array<Differentiated, largest_number_of_edges> functions{};
  const Reference_element& reference = reference_elements[Kind];
  [[maybe_unused]] const auto& coordinates = reference.coordinates;
  // Half of 1 + x or 1 - x, for a coordinate x.
  [[maybe_unused]] const auto half = [&](int axis, int sign) {
    Differentiated f{(1 + sign * r[axis]) / 2, Vec3{}};
    f.gradient[axis] = 0.5 * sign;
    return f;
  };
  // Barycentric coordinates of a triangle.
  [[maybe_unused]] const std::array<Differentiated, 3> l{
    {{1 - r[0] - r[1], {-1, -1, 0}}, {r[0], {1, 0, 0}}, {r[1], {0, 1, 0}}}};
  [[maybe_unused]] const auto vertex_functions = [&] {
    const auto values = Mixed_element_traits_3<Kind>::shape_functions(r[0], r[1], r[2]);
    const auto gradients = Mixed_element_traits_3<Kind>::shape_gradients(r[0], r[1], r[2]);
    std::array<Differentiated, Mixed_element_traits_3<Kind>::number_of_vertices> n;
    for(std::size_t i = 0; i < n.size(); ++i)
      n[i] = {values[i], gradients[i]};
    return n;
  };
  for(int e = 0; e < reference.number_of_edges; ++e) {
    const int i = reference.edges[e][0], j = reference.edges[e][1];
    Differentiated& f = functions[std::size_t(e)];
    if constexpr(Kind == TETRAHEDRON) {
      const auto n = vertex_functions();
      f = 4 * (n[std::size_t(i)] * n[std::size_t(j)]);
    } else if constexpr(Kind == PYRAMID) {
      const double d = 1 - r[2];
      if(!(d > 0)) // at the apex
        continue;
      if(j == 4) {
        const auto n = vertex_functions();
        f = 4 * (n[std::size_t(i)] * n[4]);
        continue;
      }
      const int along = coordinates[i][0] != coordinates[j][0] ? 0 : 1, across = 1 - along;
      const auto to_face = [&](int axis, int sign) { // zero on the opposite triangle
        Differentiated g{d + sign * r[axis], {0, 0, -1}};
        g.gradient[axis] = sign;
        return g;
      };
      const Differentiated inverse{1 / d, {0, 0, 1 / (d * d)}};
      f = 0.5 * (to_face(along, 1) * to_face(along, -1) * to_face(across, coordinates[i][across]) * inverse);
    } else if constexpr(Kind == PRISM) {
      f = i % 3 == j % 3 ? 4 * (l[std::size_t(i % 3)] * half(2, 1) * half(2, -1))
                         : 4 * (l[std::size_t(i % 3)] * l[std::size_t(j % 3)] * half(2, coordinates[i][2]));
    } else {
      static_assert(Kind == HEXAHEDRON, "the functions of the edges of this kind are missing");
      f = {4, Vec3{}};
      for(int axis = 0; axis < 3; ++axis)
        f = coordinates[i][axis] == coordinates[j][axis] ? f * half(axis, coordinates[i][axis])
                                                         : f * half(axis, 1) * half(axis, -1);
    }
  }
  return functions;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_EDGE_FUNCTIONS_H
