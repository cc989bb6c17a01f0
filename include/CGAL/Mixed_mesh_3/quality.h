// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Measures of elements and of meshes: volume, and the aspect-ratio coefficient (ARC) of
// Lobos, Bucki, Hitschfeld, Payan: "Mixed-element mesh for an intra-operative modeling of the
// brain tumor extraction", section 5.3.

#ifndef CGAL_MIXED_MESH_3_QUALITY_H
#define CGAL_MIXED_MESH_3_QUALITY_H

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/internal/vector_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace CGAL {
namespace Mixed_meshes_3 {

namespace internal {

using Element_points = std::array<Vec3, 8>;

// Positions relative to the element's first vertex, so that no digits are lost far from the origin.
template <class Mesh>
Element_points element_points(const Mesh& mesh, const Element_view& element)
{
  Element_points p{};
  const Vec3 origin = to_vec3(mesh.point(element[0]));
  for(int i = 1; i < element.size(); ++i)
    p[i] = to_vec3(mesh.point(element[i])) - origin;
  return p;
}

inline Vec3 middle(const Vec3& a, const Vec3& b) { return 0.5 * (a + b); }

// A quadrilateral as a bilinear patch: its flux is the mean of the two triangulations'.
inline double volume(Element_kind kind, const Element_points& p)
{
  const Reference_element& reference = reference_elements[kind];
  double six_volumes = 0;
  for(int f = 0; f < reference.number_of_faces; ++f) {
    const Element_face& face = reference.faces[f];
    const Vec3 &a = p[face.vertices[0]], &b = p[face.vertices[1]], &c = p[face.vertices[2]];
    if(face.size == 3) {
      six_volumes += determinant(a, b, c);
    } else {
      const Vec3& d = p[face.vertices[3]];
      six_volumes += 0.5 * (determinant(a, b, c) + determinant(a, c, d) + determinant(a, b, d)
                            + determinant(b, c, d));
    }
  }
  return six_volumes / 6;
}

inline double ratio_of_longest_to_shortest(double a, double b, double c)
{
  const double shortest = (std::min)({a, b, c});
  return shortest > 0 ? (std::max)({a, b, c}) / shortest
                      : std::numeric_limits<double>::infinity();
}

inline double aspect_ratio_coefficient(Element_kind kind, const Element_points& p)
{
  const Reference_element& reference = reference_elements[kind];
  switch(kind) {
  case TETRAHEDRON: {
    double sum = 0;
    for(const auto& e : reference.edges)
      if(e[0] != e[1]) {
        const Vec3 d = p[e[1]] - p[e[0]];
        sum += dot(d, d);
      }
    const double v = volume(kind, p), l2 = sum / 6;
    return v > 0 ? l2 * std::sqrt(l2) / (8.47867 * v) : std::numeric_limits<double>::infinity();
  }
  case PYRAMID: {
    const Vec3 normal = cross(p[2] - p[0], p[3] - p[1]);
    const Vec3 centre = 0.25 * (p[0] + p[1] + p[2] + p[3]);
    const double area = norm(normal);
    const double height = area > 0 ? dot(normal, p[4] - centre) / area : 0;
    return ratio_of_longest_to_shortest(norm(middle(p[2], p[3]) - middle(p[0], p[1])),
                                        norm(middle(p[1], p[2]) - middle(p[3], p[0])), height);
  }
  case PRISM: {
    double worst = 1;
    for(int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const Vec3 mi = middle(p[i], p[i + 3]), mj = middle(p[j], p[j + 3]),
                 mk = middle(p[k], p[k + 3]);
      const double width = norm(mj - mi);
      const double length = norm(middle(p[i + 3], p[j + 3]) - middle(p[i], p[j]));
      const double height = width > 0 ? norm(cross(mj - mi, mk - mi)) / width : 0;
      worst = (std::max)(worst, ratio_of_longest_to_shortest(width, length, height));
    }
    return worst;
  }
  default: {
    Vec3 centres[6];
    for(int f = 0; f < 6; ++f) {
      const auto& v = reference.faces[f].vertices;
      centres[f] = 0.25 * (p[v[0]] + p[v[1]] + p[v[2]] + p[v[3]]);
    }
    return ratio_of_longest_to_shortest(norm(centres[1] - centres[0]),
                                        norm(centres[3] - centres[2]),
                                        norm(centres[5] - centres[4]));
  }
  }
}

} // namespace internal

/// Volume of element `e` in the cube of the mesh's unit. Quadrilateral faces are bilinear patches.
template <class Mesh>
double volume(const Mesh& mesh, std::size_t e)
{
  const Element_view element = mesh.element(e);
  return internal::volume(element.kind(), internal::element_points(mesh, element));
}

/// Sum of the volumes of all elements.
template <class Mesh>
double volume(const Mesh& mesh)
{
  double sum = 0;
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
    sum += volume(mesh, e);
  return sum;
}

/*!
Aspect-ratio coefficient of element `e`: 1 is ideal, infinity degenerate (section 5.3 of the paper).

- tetrahedron: `(sum l_i^2 / 6)^(3/2) / (8.47867 V)` over the six edge lengths;
- hexahedron: longest / shortest segment between centres of opposite faces;
- pyramid: longest / shortest of the two segments between midpoints of opposite base edges, and the
  height over the base's mean plane;
- prism: for a quadrilateral face its two midpoint segments and the height of the mean triangle;
  the worst of the three faces.
*/
template <class Mesh>
double aspect_ratio_coefficient(const Mesh& mesh, std::size_t e)
{
  const Element_view element = mesh.element(e);
  return internal::aspect_ratio_coefficient(element.kind(),
                                            internal::element_points(mesh, element));
}

/// Mean, maximum and share of acceptable values of a measure over some elements.
struct Quality_statistics
{
  std::size_t count = 0;
  double mean = 0;
  double maximum = 0;
  double share_at_most_7 = 0; ///< share of elements with ARC at most 7, the paper's bound
};

/// The paper's Table 1: the aspect-ratio coefficient for each kind, and for all elements (last).
template <class Mesh>
std::array<Quality_statistics, number_of_element_kinds + 1> quality_statistics(const Mesh& mesh)
{
  std::array<Quality_statistics, number_of_element_kinds + 1> rows;
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e) {
    const double arc = aspect_ratio_coefficient(mesh, e);
    for(int row : {int(mesh.element(e).kind()), number_of_element_kinds}) {
      Quality_statistics& r = rows[row];
      ++r.count;
      r.mean += arc;
      r.maximum = (std::max)(r.maximum, arc);
      r.share_at_most_7 += arc <= 7;
    }
  }
  for(Quality_statistics& r : rows)
    if(r.count != 0) {
      r.mean /= double(r.count);
      r.share_at_most_7 /= double(r.count);
    }
  return rows;
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_QUALITY_H
