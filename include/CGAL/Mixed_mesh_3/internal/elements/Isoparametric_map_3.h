// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Map from the reference element to an element, and its inverse.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_ISOPARAMETRIC_MAP_3_H
#define CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_ISOPARAMETRIC_MAP_3_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Mixed_element_traits_3.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/with_kind.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

// The reference element is the set where `a + b . (r,s,t) >= 0` for all half-spaces, one for each face.
struct Half_space
{
  double a;
  Vec3 b;
  double operator()(const Vec3& r) const { return a + dot(b, r); }
};

struct Half_spaces
{
  int size;
  Half_space rows[6];
};

inline constexpr Half_spaces reference_half_spaces[number_of_element_kinds] = {
  {4, {{0, {1, 0, 0}}, {0, {0, 1, 0}}, {0, {0, 0, 1}}, {1, {-1, -1, -1}}}},
  {5, {{0, {0, 0, 1}}, {1, {1, 0, -1}}, {1, {-1, 0, -1}}, {1, {0, 1, -1}}, {1, {0, -1, -1}}}},
  {5, {{0, {1, 0, 0}}, {0, {0, 1, 0}}, {1, {-1, -1, 0}}, {1, {0, 0, 1}}, {1, {0, 0, -1}}}},
  {6, {{1, {1, 0, 0}}, {1, {-1, 0, 0}}, {1, {0, 1, 0}}, {1, {0, -1, 0}}, {1, {0, 0, 1}}, {1, {0, 0, -1}}}}};

/// Depth of a point inside the reference element; negative outside.
inline double depth(Element_kind kind, const Vec3& r)
{
  const Half_spaces& faces = reference_half_spaces[kind];
  double least = faces.rows[0](r);
  for(int f = 1; f < faces.size; ++f)
    least = (std::min)(least, faces.rows[f](r));
  return least;
}

/// Bound of the error of reference coordinates of points found by iteration, and of points on faces:
/// 10^7 roundings of 2^-53, as coordinates may be a million times as large as the edges of an element.
inline constexpr double reference_tolerance = 1e-9;

/*!
A field given at the vertices, as a polynomial of the reference coordinates (for the pyramid: a rational
function), which is several times cheaper than summing shape functions:

\f[ x = c_0 + c_1 r + c_2 s + c_3 t + \sum_k c_{4+k} m_k(r,s,t) \f]

where the tetrahedron has no m, the pyramid has `rs/(1-t)`, the prism has `rt, st`, and the hexahedron has
`rs, st, tr, rst`: the absolute value of each is at most 1 in the reference element.
*/
template <Element_kind Kind>
struct Element_field
{
  static_assert(Kind == TETRAHEDRON || Kind == PYRAMID || Kind == PRISM || Kind == HEXAHEDRON,
                "add the new kind");
  static constexpr int size = Kind == TETRAHEDRON ? 0 : Kind == PYRAMID ? 1 : Kind == PRISM ? 2 : 4;
  std::array<Vec3, 4 + size> c;

  explicit Element_field(const Vec3* p)
  {
    if constexpr(Kind == TETRAHEDRON) {
      c = {p[0], p[1] - p[0], p[2] - p[0], p[3] - p[0]};
    } else if constexpr(Kind == PRISM) {
      Vec3 mean[3], half[3];
      for(int i = 0; i < 3; ++i) {
        mean[i] = 0.5 * (p[i] + p[i + 3]);
        half[i] = 0.5 * (p[i + 3] - p[i]);
      }
      c = {mean[0], mean[1] - mean[0], mean[2] - mean[0], half[0], half[1] - half[0], half[2] - half[0]};
    } else {
      // The products of the signs of the vertices are orthogonal.
      constexpr int n = Kind == PYRAMID ? 4 : 8;
      c.fill(Vec3{});
      for(int i = 0; i < n; ++i) {
        const auto& v = reference_elements[Kind].coordinates[i];
        const Vec3 q = (1. / n) * p[i];
        c[0] = c[0] + q;
        c[1] = c[1] + double(v[0]) * q;
        c[2] = c[2] + double(v[1]) * q;
        c[4] = c[4] + double(v[0] * v[1]) * q;
        if constexpr(Kind == HEXAHEDRON) {
          c[3] = c[3] + double(v[2]) * q;
          c[5] = c[5] + double(v[1] * v[2]) * q;
          c[6] = c[6] + double(v[2] * v[0]) * q;
          c[7] = c[7] + double(v[0] * v[1] * v[2]) * q;
        }
      }
      if constexpr(Kind == PYRAMID)
        c[3] = p[4] - c[0];
    }
  }

  Vec3 operator()(const Vec3& r) const
  {
    const Vec3 x = c[0] + r[0] * c[1] + r[1] * c[2] + r[2] * c[3];
    if constexpr(Kind == TETRAHEDRON)
      return x;
    else if constexpr(Kind == PYRAMID)
      return r[2] < 1 ? x + r[0] * r[1] / (1 - r[2]) * c[4] : x;
    else if constexpr(Kind == PRISM)
      return x + r[2] * (r[0] * c[4] + r[1] * c[5]);
    else if constexpr(Kind == HEXAHEDRON)
      return x + r[0] * r[1] * c[4] + r[1] * r[2] * c[5] + r[2] * r[0] * c[6] + r[0] * r[1] * r[2] * c[7];
  }

  /// Derivatives by r, s and t. \pre not the pyramid's apex
  std::array<Vec3, 3> derivatives(const Vec3& r) const
  {
    if constexpr(Kind == TETRAHEDRON) {
      return {c[1], c[2], c[3]};
    } else if constexpr(Kind == PYRAMID) {
      const double a = r[0] / (1 - r[2]), b = r[1] / (1 - r[2]);
      return {c[1] + b * c[4], c[2] + a * c[4], c[3] + a * b * c[4]};
    } else if constexpr(Kind == PRISM) {
      return {c[1] + r[2] * c[4], c[2] + r[2] * c[5], c[3] + r[0] * c[4] + r[1] * c[5]};
    } else if constexpr(Kind == HEXAHEDRON) {
      return {c[1] + r[1] * c[4] + r[2] * c[6] + r[1] * r[2] * c[7],
              c[2] + r[0] * c[4] + r[2] * c[5] + r[2] * r[0] * c[7],
              c[3] + r[1] * c[5] + r[0] * c[6] + r[0] * r[1] * c[7]};
    }
  }

  /// Value and derivatives by r, s and t. \pre not the pyramid's apex
  std::pair<Vec3, std::array<Vec3, 3>> value_and_derivatives(const Vec3& r) const
  {
    return {(*this)(r), derivatives(r)};
  }

  /// A bound for the contribution of the nonlinear part to `dot(v, x)` in the element.
  double deviation(const Vec3& v) const
  {
    double sum = 0;
    for(int k = 0; k < size; ++k)
      sum += std::abs(dot(v, c[4 + k]));
    return sum;
  }
};

/// The rows of the inverse of the matrix with columns `m`; infinite or not a number if the matrix is
/// singular.
inline std::array<Vec3, 3> inverse_rows(const std::array<Vec3, 3>& m)
{
  const Vec3 yz = cross(m[1], m[2]);
  const double f = 1 / dot(m[0], yz);
  return {f * yz, f * cross(m[2], m[0]), f * cross(m[0], m[1])};
}

inline Vec3 product(const std::array<Vec3, 3>& rows, const Vec3& x)
{
  return {dot(rows[0], x), dot(rows[1], x), dot(rows[2], x)};
}

/*!
The map from the reference element to an element, with its inverse.

Positions are relative to the first vertex, so that no digits are lost far from the origin.

\tparam Field field of positions: `Element_field`, or a class derived from `Element_field`
*/
template <Element_kind Kind, class Field = Element_field<Kind>>
class Isoparametric_map_3
{
  Vec3 m_origin;
  Field m_field;
  std::array<Vec3, 3> m_linear; // inverse of the linear part
  // Each half-space of the reference element, for the coordinates that `m_linear` gives instead of the true
  // ones, and made wider by the bound for the remaining part.
  Half_spaces m_half_spaces;
  bool m_is_affine = true;

  template <class... Parameters>
  static Field local_field(const Vec3* p, const Parameters&... parameters)
  {
    Vec3 local[8];
    for(int i = 0; i < reference_elements[Kind].number_of_vertices; ++i)
      local[i] = p[i] - p[0];
    return Field(local, parameters...);
  }

  // Restricts the points of Newton's iteration to places not far from the reference element, and away from
  // the apex of the pyramid, where the map has no derivative. Toward the apex the restriction is the same at
  // all scales.
  static Vec3 restricted(Vec3 r)
  {
    if constexpr(Kind == PYRAMID) {
      r[2] = (std::max)(-0.5, (std::min)(r[2], 1 - 1e-13));
      const double w = 1.5 * (1 - r[2]);
      for(int i = 0; i < 2; ++i)
        r[i] = (std::max)(-w, (std::min)(r[i], w));
    } else {
      for(int i = 0; i < 3; ++i) {
        const double lower = Kind == PRISM && i < 2 ? -0.5 : -1.5;
        r[i] = (std::max)(lower, (std::min)(r[i], 1.5));
      }
    }
    return r;
  }

  // Outside the element the polynomial may return to points that it also has in the element: the orientation
  // there is the opposite one.
  bool is_beyond_fold(const Vec3& r) const
  {
    if(depth(Kind, r) >= -reference_tolerance)
      return false;
    const std::array<Vec3, 3> d = m_field.derivatives(restricted(r));
    return determinant(d[0], d[1], d[2]) * determinant(m_linear[0], m_linear[1], m_linear[2]) <= 0;
  }

public:
  /// \param p positions of the element's vertices
  /// \param parameters further arguments of the constructor of the field
  template <class... Parameters>
  explicit Isoparametric_map_3(const Vec3* p, const Parameters&... parameters)
    : m_origin(p[0]), m_field(local_field(p, parameters...)),
      m_linear(inverse_rows({m_field.c[1], m_field.c[2], m_field.c[3]})),
      m_half_spaces(reference_half_spaces[Kind])
  {
    for(int f = 0; f < m_half_spaces.size; ++f) {
      const Vec3& b = m_half_spaces.rows[f].b;
      m_half_spaces.rows[f].a += m_field.deviation(b[0] * m_linear[0]
                                                   + (b[1] * m_linear[1] + b[2] * m_linear[2]));
    }
    for(const Vec3& row : m_linear)
      m_is_affine = m_is_affine && m_field.deviation(row) < 1e-14;
  }

  bool is_affine() const { return m_is_affine; }

  Vec3 operator()(const Vec3& r) const { return m_origin + m_field(r); }

  /// Reference coordinates of a point, and of a vector, for the linear part of the map only.
  Vec3 linear_inverse(const Vec3& p) const { return product(m_linear, p - m_origin - m_field.c[0]); }
  Vec3 linear_inverse_of_vector(const Vec3& v) const { return product(m_linear, v); }

  /// Half-spaces of `linear_inverse(p)`: a point that is not in all of them is not in the element.
  const Half_spaces& necessary_half_spaces() const { return m_half_spaces; }

  bool may_contain(const Vec3& linear_coordinates) const
  {
    for(int f = 0; f < m_half_spaces.size; ++f)
      if(!(m_half_spaces.rows[f](linear_coordinates) >= -reference_tolerance))
        return false;
    return true;
  }

  /*!
  Newton's iteration for the reference coordinates of a point.
  \param p the point
  \param r start of the iteration; the result
  \param accuracy bound of the length of the last step; the error is about its square
  \return whether the iteration came to an end
  */
  bool improve(const Vec3& p, Vec3& r, double accuracy) const
  {
    const Vec3 x = p - m_origin;
    r = restricted(r);
    for(int iteration = 0; iteration < 20; ++iteration) {
      const auto [value, derivatives] = m_field.value_and_derivatives(r);
      const Vec3 step = product(inverse_rows(derivatives), x - value);
      const double height = r[2];
      r = restricted(r + step);
      // A step must not cross the apex: only the direction from the apex counts, and would be the opposite
      // one.
      if(Kind == PYRAMID && 1 - r[2] < 0.01 * (1 - height))
        r = restricted({r[0], r[1], 1 - 0.01 * (1 - height)});
      const double length = (std::max)({std::abs(step[0]), std::abs(step[1]), std::abs(step[2])});
      // The derivative changes faster the nearer the point is to the apex of a pyramid.
      if(length < (Kind == PYRAMID ? accuracy * (std::max)(1e-4, 1 - r[2]) : accuracy))
        return true;
      if(!(length < 1e6)) // a singular derivative
        return false;
    }
    return false;
  }

  /// The rows of the inverse of the derivative.
  std::array<Vec3, 3> inverse_derivatives(const Vec3& r) const
  {
    return inverse_rows(m_field.derivatives(restricted(r)));
  }

  /*!
  Simplified Newton's iteration, with the derivative at a place nearby, which halves the cost.
  \param rows `inverse_derivatives()` there
  \param p the point
  \param r start of the iteration; the result
  \param accuracy bound of the length of the last step; the error is a small part of it
  \return whether the last of a few steps is that short, and the result is in the element
  */
  bool improve(const std::array<Vec3, 3>& rows, const Vec3& p, Vec3& r, double accuracy) const
  {
    const Vec3 x = p - m_origin;
    for(int iteration = 0; iteration < 3; ++iteration) {
      const Vec3 step = product(rows, x - m_field(r));
      r = r + step;
      if((std::max)({std::abs(step[0]), std::abs(step[1]), std::abs(step[2])}) < accuracy)
        return depth(Kind, r) >= 0;
    }
    return false;
  }

  /*!
  The reference coordinates of a point, if it is in the element.
  \param p the point
  \param start first guess, for example the result for a point nearby
  \param accuracy bound as in `improve()`
  */
  std::optional<Vec3> inverse(const Vec3& p, const Vec3& start, double accuracy = 1e-8) const
  {
    Vec3 r = start;
    if(!m_is_affine && (!improve(p, r, accuracy) || is_beyond_fold(r))) {
      // The start is too far away for Newton's method: other starts are tried. None converges for a point
      // outside.
      const Reference_element& reference = reference_elements[Kind];
      Vec3 center{};
      for(int i = 0; i < reference.number_of_vertices; ++i)
        for(int k = 0; k < 3; ++k)
          center[k] += double(reference.coordinates[i][k]) / reference.number_of_vertices;
      bool is_found = improve(p, r = center, accuracy) && depth(Kind, r) >= -reference_tolerance;
      for(int i = 0; i < reference.number_of_vertices && !is_found; ++i) {
        for(int k = 0; k < 3; ++k)
          r[k] = 0.25 * center[k] + 0.75 * reference.coordinates[i][k];
        is_found = improve(p, r, accuracy) && depth(Kind, r) >= -reference_tolerance;
      }
      if(!is_found)
        return std::nullopt;
    }
    return depth(Kind, r) >= -reference_tolerance ? std::optional<Vec3>(r) : std::nullopt;
  }

  std::optional<Vec3> inverse(const Vec3& p) const
  {
    const Vec3 r = linear_inverse(p);
    return may_contain(r) ? inverse(p, r) : std::nullopt;
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_ISOPARAMETRIC_MAP_3_H
