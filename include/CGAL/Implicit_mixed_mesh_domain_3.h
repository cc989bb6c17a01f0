// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_IMPLICIT_MIXED_MESH_DOMAIN_3_H
#define CGAL_IMPLICIT_MIXED_MESH_DOMAIN_3_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_regions_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace CGAL {

/*!
\ingroup PkgMixedMesh3Domains

\brief The domain where a function is positive.

The function is like that of `Implicit_mixed_mesh_region_3`: positive inside, and it must not change faster
than the distance. The gradient near the surface must not be near zero; the signed distance is best. Closest
points are found by descent along the gradient (finite differences), until the value is below 1e-12 of the
diagonal of the box, or after 100 steps; they are as near as the function resembles a distance.

\cgalModels{MixedMeshDomain_3}
*/
class Implicit_mixed_mesh_domain_3 : public Implicit_mixed_mesh_region_3
{
  using Vec3 = Mixed_meshes_3::Vec3;

  Bbox_3 m_bbox;
  double m_diagonal;

  static constexpr int maximal_number_of_steps = 100;
  static constexpr double accuracy = 1e-12, step_of_differences = 1e-6; // in diagonals

  double value(const Vec3& p) const { return depth(Point_3(p[0], p[1], p[2])); }

  Vec3 gradient(const Vec3& p) const
  {
    Vec3 g;
    for(int k = 0; k < 3; ++k) {
      const double h = step_of_differences * m_diagonal;
      Vec3 a = p, b = p;
      a[k] -= h;
      b[k] += h;
      g[k] = (value(b) - value(a)) / (2 * h);
    }
    return g;
  }

public:
  /// \param depth function object `double(Point_3)`, positive inside, of Lipschitz constant 1
  /// \param bbox box that contains the domain. \pre the three extents of the box are positive and finite
  Implicit_mixed_mesh_domain_3(std::function<double(const Point_3&)> depth, const Bbox_3& bbox)
    : Implicit_mixed_mesh_region_3(std::move(depth)), m_bbox(bbox),
      m_diagonal(Mixed_meshes_3::norm({bbox.x_span(), bbox.y_span(), bbox.z_span()}))
  {
    CGAL_precondition((std::min)({bbox.x_span(), bbox.y_span(), bbox.z_span()}) > 0
                      && std::isfinite(m_diagonal));
  }

  const Bbox_3& bbox() const { return m_bbox; }

  Bounded_side bounded_side(const Point_3& p, const Surface_part&) const
  {
    const double d = depth(p);
    return d > 0 ? ON_BOUNDED_SIDE : d < 0 ? ON_UNBOUNDED_SIDE : ON_BOUNDARY;
  }

  Point_3 closest_point(const Point_3& p) const
  {
    Vec3 q = Mixed_meshes_3::to_vec3(p);
    for(int i = 0; i < maximal_number_of_steps; ++i) {
      const double d = value(q);
      if(!(std::abs(d) > accuracy * m_diagonal))
        break;
      Vec3 g = gradient(q);
      if(!(dot(g, g) > 1e-6)) // equally near to several sides: any direction is right
        g = {1, 0, 0};
      q = q - (d / dot(g, g)) * g;
    }
    return {q[0], q[1], q[2]};
  }
  Point_3 closest_point(const Point_3& p, const Surface_part&) const { return closest_point(p); }
  Point_3 closest_point(const Point_3& p, const Point_3&) const { return closest_point(p); }

  /// The points closest to the centers of the cells of a grid that the surface may meet.
  /// \par Complexity
  /// Complexity of a grid with cells of `spacing`, but at most 200 in each direction
  std::vector<Point_3> surface_samples(double spacing) const
  {
    std::vector<Point_3> samples;
    std::array<int, 3> n;
    for(int k = 0; k < 3; ++k)
      n[k] = int((std::min)(std::ceil(((m_bbox.max)(k) - (m_bbox.min)(k)) / spacing), 200.));
    const Vec3 cell{m_bbox.x_span() / n[0], m_bbox.y_span() / n[1], m_bbox.z_span() / n[2]};
    for(int x = 0; x < n[0]; ++x)
      for(int y = 0; y < n[1]; ++y)
        for(int z = 0; z < n[2]; ++z) {
          const Point_3 center((m_bbox.xmin)() + (x + 0.5) * cell[0], (m_bbox.ymin)() + (y + 0.5) * cell[1],
                               (m_bbox.zmin)() + (z + 0.5) * cell[2]);
          if(std::abs(depth(center)) <= norm(cell) / 2)
            samples.push_back(closest_point(center));
        }
    return samples;
  }
};

} // namespace CGAL

#endif // CGAL_IMPLICIT_MIXED_MESH_DOMAIN_3_H
