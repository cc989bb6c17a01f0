// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_BASE_PLANE_QUADRIC_H
#define CGAL_MIXED_MESH_3_INTERNAL_BASE_PLANE_QUADRIC_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <algorithm>
#include <cmath>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The sum of the squared distances of a point from planes, weighted by areas, as a quadratic form (Garland
/// and Heckbert, Surface simplification using quadric error metrics, 1997).
class Plane_quadric
{
  // The quadratic form is p^T A p + 2 b p + c.
  double m_xx = 0, m_xy = 0, m_xz = 0, m_yy = 0, m_yz = 0, m_zz = 0; // A
  Vec3 m_b{0, 0, 0};
  double m_c = 0;
  double m_area = 0;

public:
  /// Adds the plane through a point. \param normal normal of the length 1
  void add(const Vec3& point, const Vec3& normal, double area)
  {
    const Vec3 n = area * normal;
    const double d = -dot(normal, point);
    m_xx += n[0] * normal[0], m_xy += n[0] * normal[1], m_xz += n[0] * normal[2];
    m_yy += n[1] * normal[1], m_yz += n[1] * normal[2], m_zz += n[2] * normal[2];
    m_b = m_b + d * n;
    m_c += area * d * d;
    m_area += area;
  }

  /// Adds the plane of a triangle, with a third of its area.
  /// \param factor of the area
  void add(const Vec3& a, const Vec3& b, const Vec3& c, double factor = 1)
  {
    const Vec3 normal = cross(b - a, c - a);
    const double doubled_area = norm(normal);
    if(doubled_area > 0)
      add(a, (1 / doubled_area) * normal, factor * doubled_area / 6);
  }

  Plane_quadric& operator+=(const Plane_quadric& q)
  {
    m_xx += q.m_xx, m_xy += q.m_xy, m_xz += q.m_xz, m_yy += q.m_yy, m_yz += q.m_yz, m_zz += q.m_zz;
    m_b = m_b + q.m_b;
    m_c += q.m_c;
    m_area += q.m_area;
    return *this;
  }

  double area() const { return m_area; }

  /// The sum of squared distances.
  double operator()(const Vec3& p) const
  {
    const double sum = m_xx * p[0] * p[0] + 2 * m_xy * p[0] * p[1] + 2 * m_xz * p[0] * p[2]
                       + 2 * m_b[0] * p[0] + m_yy * p[1] * p[1] + 2 * m_yz * p[1] * p[2] + 2 * m_b[1] * p[1]
                       + m_zz * p[2] * p[2] + 2 * m_b[2] * p[2] + m_c;
    return (std::max)(sum, 0.);
  }

  /// The volume between the planes and a point in their place: their area times the root mean square of the
  /// distances.
  double volume(const Vec3& p) const { return std::sqrt((*this)(p)*m_area); }

  /// The minimum of the quadric; near a given point in directions in which the quadric hardly changes.
  Vec3 minimum_near(const Vec3& p) const
  {
    constexpr double share = 1e-3; // share of the area for that point: the condition is 1,001 at most
    const double pull = share * m_area;
    if(!(pull > 0))
      return p;
    const double a = m_xx + pull, d = m_yy + pull, f = m_zz + pull;
    const Vec3 right = pull * p - m_b;
    const Vec3 u{d * f - m_yz * m_yz, m_xz * m_yz - m_xy * f, m_xy * m_yz - m_xz * d}; // cofactors
    const Vec3 v{u[1], a * f - m_xz * m_xz, m_xy * m_xz - a * m_yz};
    const Vec3 w{u[2], v[2], a * d - m_xy * m_xy};
    const double determinant = a * u[0] + m_xy * u[1] + m_xz * u[2];
    return 1 / determinant * Vec3{dot(u, right), dot(v, right), dot(w, right)};
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_BASE_PLANE_QUADRIC_H
