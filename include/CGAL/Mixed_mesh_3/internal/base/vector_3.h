// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Plain doubles for measures (lengths, volumes, quality). Decisions use the kernel's predicates.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_BASE_VECTOR_3_H
#define CGAL_MIXED_MESH_3_INTERNAL_BASE_VECTOR_3_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/double.h>
#include <CGAL/number_utils.h>

#include <array>
#include <cmath>

namespace CGAL {

/// \cond not public
template <class ET>
class Lazy_exact_nt;
/// \endcond

namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMesh3Elements
/// A vector, or a position, in doubles: displacements, forces, vertices of elements. The type is an array,
/// `v[0]` to `v[2]`, and a type of our own, so that argument-dependent lookup finds the operators. Headers
/// that use the type include its header.
struct Vec3 : std::array<double, 3>
{
  /// `Vec3{}` is zero; without braces the coordinates are undefined.
  Vec3() = default;
  /// Constructs a vector from coordinates.
  constexpr Vec3(double x, double y, double z) : std::array<double, 3>{x, y, z} {}
  /// Converts an array.
  constexpr Vec3(const std::array<double, 3>& a) : std::array<double, 3>(a) {}
};

/// \cond not public
// A lazy number that is not made exact rounds to a double that depends on the earlier uses of the number.
template <class FT>
double rounded(const FT& x)
{
  return CGAL::to_double(x);
}

template <class ET>
double rounded(const CGAL::Lazy_exact_nt<ET>& x)
{
  return CGAL::to_double(x.exact());
}

/// \endcond

/// \ingroup PkgMixedMesh3Elements
/// The coordinates of a point of any kernel, rounded to double.
template <class Point>
Vec3 to_vec3(const Point& p)
{
  return {rounded(p.x()), rounded(p.y()), rounded(p.z())};
}

namespace internal {

/// The components `[0]`, `[1]`, `[2]` of a triple of any type, rounded to double.
template <class Triple>
Vec3 components(const Triple& p)
{
  return {rounded(p[0]), rounded(p[1]), rounded(p[2])};
}

} // namespace internal

/// \ingroup PkgMixedMesh3Elements
/// The sum.
inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
/// \ingroup PkgMixedMesh3Elements
/// The difference.
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
/// \ingroup PkgMixedMesh3Elements
/// The multiple by a number.
inline Vec3 operator*(double s, const Vec3& a) { return {s * a[0], s * a[1], s * a[2]}; }
/// \ingroup PkgMixedMesh3Elements
/// The scalar product.
inline double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
/// \ingroup PkgMixedMesh3Elements
/// The length.
inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }
/// \ingroup PkgMixedMesh3Elements
/// The vector product.
inline Vec3 cross(const Vec3& a, const Vec3& b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// \ingroup PkgMixedMesh3Elements
/// The volume that three vectors span, positive if they are right-handed.
inline double determinant(const Vec3& a, const Vec3& b, const Vec3& c) { return dot(cross(a, b), c); }

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_BASE_VECTOR_3_H
