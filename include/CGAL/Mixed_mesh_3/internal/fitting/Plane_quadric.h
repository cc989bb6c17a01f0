// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_PLANE_QUADRIC_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_PLANE_QUADRIC_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The sum of the squared distances of a point from planes, weighted by areas, as a quadratic form (Garland
/// and Heckbert, Surface simplification using quadric error metrics, 1997).
class Plane_quadric
{
  std::array<double, 10> m_form{}; // upper triangle of a symmetric matrix, row by row
  double m_area = 0;

public:
  /// Adds the plane of a triangle, with a third of its area.
  /// \param factor of the area
  void add(const Vec3& a, const Vec3& b, const Vec3& c, double factor = 1)
  {
    const Vec3 normal = cross(b - a, c - a);
    const double doubled_area = norm(normal);
    if(!(doubled_area > 0))
      return;
    const Vec3 n = (1 / doubled_area) * normal;
    const double plane[4] = {n[0], n[1], n[2], -dot(n, a)}, weight = factor * doubled_area / 6;
    std::size_t k = 0;
    for(int i = 0; i < 4; ++i)
      for(int j = i; j < 4; ++j)
        m_form[k++] += weight * plane[i] * plane[j];
    m_area += weight;
  }

  Plane_quadric& operator+=(const Plane_quadric& q)
  {
    for(std::size_t k = 0; k < m_form.size(); ++k)
      m_form[k] += q.m_form[k];
    m_area += q.m_area;
    return *this;
  }

  /// The volume between the planes and a point in their place: their area times the root mean square of the
  /// distances.
  double volume(const Vec3& p) const
  {
    const double x[4] = {p[0], p[1], p[2], 1};
    double sum = 0;
    std::size_t k = 0;
    for(int i = 0; i < 4; ++i)
      for(int j = i; j < 4; ++j, ++k)
        sum += (i == j ? 1 : 2) * m_form[k] * x[i] * x[j];
    return std::sqrt((std::max)(sum, 0.) * m_area);
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_PLANE_QUADRIC_H
