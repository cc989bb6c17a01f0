// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Measures of one element, from its kind and points. Their definitions are documented in quality.h.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_ELEMENT_MEASURES_H
#define CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_ELEMENT_MEASURES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/Mixed_element_traits_3.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/element_points.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

// Volume with each quadrilateral as a bilinear patch, whose flux is the mean of the fluxes of the two
// triangulations. Points are relative to a vertex, because digits would be lost far from the origin.
inline double volume(Element_kind kind, const Element_points& p)
{
  const Reference_element& reference = reference_elements[kind];
  double six_volumes = 0;
  for(int f = 0; f < reference.number_of_faces; ++f) {
    const Element_face& face = reference.faces[f];
    const Vec3 a = p[face.vertices[0]] - p[0], b = p[face.vertices[1]] - p[0], c = p[face.vertices[2]] - p[0];
    if(face.size == 3) {
      six_volumes += determinant(a, b, c);
    } else {
      const Vec3 d = p[face.vertices[3]] - p[0];
      six_volumes += 0.5
                     * (determinant(a, b, c) + determinant(a, c, d) + determinant(a, b, d)
                        + determinant(b, c, d));
    }
  }
  return six_volumes / 6;
}

// Verdict's tet_scaled_jacobian: at each of the four corners the determinant is the same.
inline double scaled_jacobian_of_tetrahedron(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  const double ab = norm(b - a), ac = norm(c - a), ad = norm(d - a), bc = norm(c - b), bd = norm(d - b),
               cd = norm(d - c);
  const double largest = (std::max)({ab * ac * ad, ab * bc * bd, ac * bc * cd, ad * bd * cd});
  return largest > 0 ? std::sqrt(2.) * determinant(b - a, c - a, d - a) / largest : 0;
}

inline double scaled_jacobian(Element_kind kind, const Element_points& p)
{
  const Reference_element& reference = reference_elements[kind];
  const auto smallest = [&](const auto& measure) {
    double least = std::numeric_limits<double>::infinity();
    for(int i = 0; i < reference.number_of_corners; ++i) {
      const auto& v = reference.corners[i];
      least = (std::min)(least, measure(p[v[0]], p[v[1]], p[v[2]], p[v[3]]));
    }
    return least;
  };
  const auto of_edges = [](const Vec3& o, const Vec3& x, const Vec3& y, const Vec3& z) {
    const Vec3 a = x - o, b = y - o, c = z - o;
    const double lengths = norm(a) * norm(b) * norm(c);
    return lengths > 0 ? determinant(a, b, c) / lengths : 0;
  };
  switch(kind) {
  case TETRAHEDRON: return smallest(scaled_jacobian_of_tetrahedron);
  case PYRAMID: {
    const double scaled = smallest(scaled_jacobian_of_tetrahedron) * std::sqrt(2.);
    return (std::min)(scaled, 2 - scaled); // some irregular pyramids reach 1.14
  }
  case PRISM: return smallest(of_edges) * 2 / std::sqrt(3.);
  case HEXAHEDRON: return smallest(of_edges);
  }
  return 0;
}

constexpr double degrees_per_radian = 180 / CGAL_PI; // half a turn is 180 degrees

/// Twice the vector area: normal to a triangle, the mean normal of a quadrilateral; outwards.
inline Vec3 face_normal(const Element_face& face, const Element_points& p)
{
  const Vec3 &a = p[face.vertices[0]], &b = p[face.vertices[1]], &c = p[face.vertices[2]];
  return face.size == 3 ? cross(b - a, c - a) : cross(c - a, p[face.vertices[3]] - b);
}

struct Angle_range
{
  double smallest, largest;
};

inline Angle_range dihedral_angles(Element_kind kind, const Element_points& p)
{
  const Reference_element& reference = reference_elements[kind];
  std::array<Vec3, 6> normals;
  std::uint8_t face_left_of[8][8]; // face at the edge from one vertex to another, seen from outside
  for(int f = 0; f < reference.number_of_faces; ++f) {
    const Element_face& face = reference.faces[f];
    normals[f] = face_normal(face, p);
    for(int i = 0; i < face.size; ++i)
      face_left_of[face.vertices[i]][face.vertices[(i + 1) % face.size]] = std::uint8_t(f);
  }
  Angle_range angles{360, 0};
  for(int i = 0; i < reference.number_of_edges; ++i) {
    const auto& e = reference.edges[i];
    const Vec3 &left = normals[face_left_of[e[0]][e[1]]], &right = normals[face_left_of[e[1]][e[0]]];
    const Vec3 edge = p[e[1]] - p[e[0]];
    const double length = norm(edge);
    const double sine = length > 0 ? dot(cross(left, right), edge) / length : 0;
    const double angle = 180 - std::atan2(sine, dot(left, right)) * degrees_per_radian;
    angles.smallest = (std::min)(angles.smallest, angle);
    angles.largest = (std::max)(angles.largest, angle);
  }
  return angles;
}

inline double smallest_dihedral_angle(Element_kind kind, const Element_points& p)
{
  return dihedral_angles(kind, p).smallest;
}

inline double largest_dihedral_angle(Element_kind kind, const Element_points& p)
{
  return dihedral_angles(kind, p).largest;
}

// The normals, not of unit length, of the two triangles of a quadrilateral on either side of a diagonal:
// diagonal 0 goes through the first vertex, diagonal 1 is the other one.
inline std::array<Vec3, 2> triangle_normals(const Element_face& face, int diagonal, const Element_points& p)
{
  const auto at = [&](int i) -> const Vec3& { return p[face.vertices[(i + diagonal) % 4]]; };
  const Vec3 b = at(1) - at(0), c = at(2) - at(0), d = at(3) - at(0);
  return {cross(b, c), cross(c, d)};
}

inline double quad_warp(Element_kind kind, const Element_points& p)
{
  const Reference_element& reference = reference_elements[kind];
  double largest = 0;
  for(int f = 0; f < reference.number_of_faces; ++f) {
    const Element_face& face = reference.faces[f];
    for(int diagonal = 0; face.size == 4 && diagonal < 2; ++diagonal) {
      const auto [left, right] = triangle_normals(face, diagonal, p);
      largest = (std::max)(largest, std::atan2(norm(cross(left, right)), dot(left, right)));
    }
  }
  return largest * degrees_per_radian;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_ELEMENT_MEASURES_H
