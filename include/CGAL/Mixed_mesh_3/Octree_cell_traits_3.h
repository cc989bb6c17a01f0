// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Conversion from the integer lattice of the octree to points: models of `OctreeCellTraits_3`.

#ifndef CGAL_MIXED_MESH_3_OCTREE_CELL_TRAITS_3_H
#define CGAL_MIXED_MESH_3_OCTREE_CELL_TRAITS_3_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Lattice_point.h>
#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_3/options.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

namespace internal {

// The granularity of lattice coordinates, which shall be exact doubles, so that cells that share a vertex, an
// edge or a face do so exactly: all coordinates are multiples of a power of two that is at least 2^-52 of the
// largest one.
inline double lattice_granularity(double largest_coordinate)
{
  return std::ldexp(1., std::ilogb(largest_coordinate) - 51);
}

// The side of a lattice cell, rounded up so that multiples of it are exact doubles: 20 significant
// bits, fewer very far from the origin.
inline double lattice_unit(double root_side, double granularity)
{
  const double unit = root_side / lattice_root_side;
  const double g = (std::max)(granularity, std::ldexp(1., std::ilogb(unit) - 19));
  return (std::max)(1., std::ceil(unit / g)) * g;
}

} // namespace internal

/*!
\ingroup PkgMixedMesh3Octree

\brief Model of `OctreeCellTraits_3`: cells are boxes parallel to the axes.

Every lattice point is an exact double, unless planes are given.

\cgalModels{OctreeCellTraits_3}
*/
class Axis_aligned_octree_cell_traits_3
{
public:
  /// The type of points.
  using Point_3 = Predicates_kernel::Point_3;
  /// The type of triangles.
  using Triangle_3 = Predicates_kernel::Triangle_3;

  /// A cell as the domain and the region see it.
  class Cell
  {
    Bbox_3 m_bbox;
    Point_3 m_center;

  public:
    /// Constructs a cell from its box and its center.
    Cell(const Bbox_3& bbox, const Point_3& center) : m_bbox(bbox), m_center(center) {}
    const Bbox_3& bbox() const { return m_bbox; }
    const Point_3& center() const { return m_center; }
    /// Whether the closed cell meets the triangle; exact.
    bool do_intersect(const Triangle_3& t) const
    {
      for(int i = 0; i < 3; ++i) // triangles are often smaller than cells
        if(CGAL::do_overlap(m_bbox, t[i].bbox()))
          return true;
      return CGAL::do_intersect(t, m_bbox);
    }
  };

  /// Constructs an octree around `bbox`.
  /// \param bbox box to be covered. \pre the three extents of the box are positive and finite
  /// \param root cube (default) or the box itself
  explicit Axis_aligned_octree_cell_traits_3(const Bbox_3& bbox, Root_cell root = Root_cell::CUBE)
  {
    const double longest = (std::max)({bbox.x_span(), bbox.y_span(), bbox.z_span()});
    CGAL_precondition((std::min)({bbox.x_span(), bbox.y_span(), bbox.z_span()}) > 0
                      && std::isfinite(longest));
    // The margin keeps surfaces parallel to the axes off the faces of the cells.
    const double cube_side = longest * (1 + 1. / 64);
    double largest = cube_side;
    for(int k = 0; k < 3; ++k)
      largest = (std::max)(
        {largest, std::abs((bbox.min)(k)) + cube_side, std::abs((bbox.max)(k)) + cube_side});
    const double granularity = internal::lattice_granularity(largest);
    for(int k = 0; k < 3; ++k) {
      const double extent = (bbox.max)(k) - (bbox.min)(k);
      const double center = (bbox.min)(k) + extent / 2;
      // The rounded root without a margin may miss the box by a digit: a larger unit is taken then.
      for(double side = root == Root_cell::CUBE ? cube_side : extent;; side *= 1 + std::ldexp(1., -18)) {
        m_unit[k] = internal::lattice_unit(side, granularity);
        m_origin[k] = std::floor((center - m_unit[k] * (internal::lattice_root_side / 2)) / granularity)
                      * granularity;
        if(m_origin[k] <= (bbox.min)(k) && coordinate(k, internal::lattice_root_side) >= (bbox.max)(k))
          break;
      }
    }
  }

  /// Planes perpendicular to an axis: their positions on the lattice, from 0 on, and their coordinates; both
  /// are ascending.
  using Lattice_planes = std::vector<std::pair<std::uint32_t, double>>;

  /// Constructs an octree with given planes, whose coordinates lattice points in the planes have exactly;
  /// between two planes, and behind the last ones, lattice planes are at equal distances up to rounding.
  /// \param axes \pre at least two planes for each axis
  /// \param level level of the coarsest cells between the planes
  /// \param is_uniform whether there shall be no smaller cells
  Axis_aligned_octree_cell_traits_3(const std::array<Lattice_planes, 3>& axes, int level, bool is_uniform)
    : m_planes(axes), m_level_on_surface(level), m_is_uniform(is_uniform)
  {
    for(int k = 0; k < 3; ++k) {
      CGAL_precondition(m_planes[k].size() > 1 && m_planes[k].front().first == 0);
      m_unit[k] = std::numeric_limits<double>::infinity();
      for(auto p = m_planes[k].begin(); p + 1 != m_planes[k].end(); ++p)
        m_unit[k] = (std::min)(m_unit[k], unit_behind(p));
    }
  }

  /// The level from which on cells have all planes that were given; 0 without planes.
  int level_on_surface() const { return m_level_on_surface; }
  /// Whether there shall be no cells smaller than those of `level_on_surface()`.
  bool is_uniform() const { return m_is_uniform; }

  /// The position of a lattice point.
  Point_3 point(const Lattice_point& p) const
  {
    return {coordinate(0, p[0]), coordinate(1, p[1]), coordinate(2, p[2])};
  }

  /// The cell of the given lattice side whose smallest corner is `corner`.
  Cell cell(const Lattice_point& corner, std::uint32_t side) const
  {
    const std::uint32_t half = side / 2;
    return {Bbox_3(coordinate(0, corner[0]), coordinate(1, corner[1]), coordinate(2, corner[2]),
                   coordinate(0, corner[0] + side), coordinate(1, corner[1] + side),
                   coordinate(2, corner[2] + side)),
            point({corner[0] + half, corner[1] + half, corner[2] + half})};
  }

  /// The length of the shortest edge of the cells of the given lattice side.
  double length(std::uint32_t side) const { return side * (std::min)({m_unit[0], m_unit[1], m_unit[2]}); }

private:
  // The coordinate of a lattice plane, an ascending function, so that cells that share a vertex, an edge or a
  // face do so exactly.
  double coordinate(int k, std::uint32_t i) const
  {
    const Lattice_planes& planes = m_planes[k];
    if(planes.empty())
      return m_origin[k] + i * m_unit[k];
    auto plane = std::upper_bound(planes.begin(), planes.end(), i,
                                  [](std::uint32_t j, const auto& p) { return j < p.first; })
                 - 1;
    if(plane->first == i)
      return plane->second;
    const double origin = plane->second;
    const std::uint32_t distance = i - plane->first;
    if(plane + 1 == planes.end())
      --plane;
    return origin + distance * unit_behind(plane);
  }

  // The distance of lattice planes between a given plane and the next.
  static double unit_behind(Lattice_planes::const_iterator plane)
  {
    return (plane[1].second - plane[0].second) / (plane[1].first - plane[0].first);
  }

  std::array<double, 3> m_origin{}, m_unit; // with planes: no origin, and the least unit
  std::array<Lattice_planes, 3> m_planes;
  int m_level_on_surface = 0;
  bool m_is_uniform = false;
};

/*!
\ingroup PkgMixedMesh3Octree

\brief Model of `OctreeCellTraits_3`: cubes whose third axis has a given direction, for example that
from the tumor to the skull opening.

The frame comes from a quaternion of small integers, so that it is exactly orthogonal and lattice
points are exact doubles; its axis is within 4 degrees of the wanted one.

\cgalModels{OctreeCellTraits_3}
*/
class Rotated_octree_cell_traits_3
{
public:
  /// The type of points.
  using Point_3 = Predicates_kernel::Point_3;
  /// The type of triangles.
  using Triangle_3 = Predicates_kernel::Triangle_3;

  /// A cell as the domain and the region see it.
  class Cell
  {
    std::array<Point_3, 8> m_vertices;
    Point_3 m_center;
    Bbox_3 m_bbox;

  public:
    /// Constructs a cell from its vertices, in the order of lattice coordinates, and its center.
    Cell(const std::array<Point_3, 8>& vertices, const Point_3& center)
      : m_vertices(vertices), m_center(center)
    {
      for(const Point_3& p : m_vertices)
        m_bbox += p.bbox();
    }
    const Bbox_3& bbox() const { return m_bbox; }
    const Point_3& center() const { return m_center; }
    bool do_intersect(const Triangle_3& t) const
    {
      if(!CGAL::do_overlap(m_bbox, t.bbox()))
        return false;
      static constexpr int tetrahedra[5][4] = {
        {0, 3, 5, 6}, {1, 0, 5, 3}, {2, 0, 3, 6}, {4, 0, 6, 5}, {7, 3, 6, 5}};
      for(const auto& i : tetrahedra)
        if(CGAL::do_intersect(t, Predicates_kernel::Tetrahedron_3(m_vertices[i[0]], m_vertices[i[1]],
                                                                  m_vertices[i[2]], m_vertices[i[3]])))
          return true;
      return false;
    }
  };

  /// Constructs an octree around a range of points.
  /// \param points range of points, of any CGAL kernel, that do not all lie in a plane
  /// \param axis direction of the third axis of the cells; not zero
  template <class PointRange, class Vector>
  Rotated_octree_cell_traits_3(const PointRange& points, const Vector& axis)
  {
    set_frame(CGAL::to_double(axis.x()), CGAL::to_double(axis.y()), CGAL::to_double(axis.z()));
    // The extent along the axes is in multiples of 1 / norm.
    std::array<double, 3> lower, upper;
    lower.fill(std::numeric_limits<double>::infinity());
    upper.fill(-std::numeric_limits<double>::infinity());
    double largest = 0;
    for(const auto& p : points) {
      const double x[3] = {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
      for(int k = 0; k < 3; ++k) {
        const double c = x[0] * m_axes[k][0] + x[1] * m_axes[k][1] + x[2] * m_axes[k][2];
        lower[k] = (std::min)(lower[k], c);
        upper[k] = (std::max)(upper[k], c);
        largest = (std::max)(largest, std::abs(x[k]));
      }
    }
    double longest = 0; // times norm
    for(int k = 0; k < 3; ++k)
      longest = (std::max)(longest, upper[k] - lower[k]);
    CGAL_precondition(longest > 0 && std::isfinite(longest));
    longest *= 1 + 1. / 64;
    const double granularity = internal::lattice_granularity(largest + 2 * longest / m_norm);
    m_unit = internal::lattice_unit(longest / (m_norm * m_norm), granularity);
    for(int k = 0; k < 3; ++k) {
      double center = 0;
      for(int a = 0; a < 3; ++a)
        center += m_axes[a][k] * (lower[a] + upper[a]) / 2 / (m_norm * m_norm);
      const double half = m_unit * (internal::lattice_root_side / 2);
      m_origin[k] = std::floor((center - half * (m_axes[0][k] + m_axes[1][k] + m_axes[2][k])) / granularity)
                    * granularity;
    }
  }

  Point_3 point(const Lattice_point& p) const
  {
    return {coordinate(0, p), coordinate(1, p), coordinate(2, p)};
  }

  Cell cell(const Lattice_point& c, std::uint32_t side) const
  {
    std::array<Point_3, 8> vertices;
    for(std::uint32_t i = 0; i < 8; ++i)
      vertices[i] = point({c[0] + (i & 1) * side, c[1] + (i >> 1 & 1) * side, c[2] + (i >> 2) * side});
    return {vertices, point({c[0] + side / 2, c[1] + side / 2, c[2] + side / 2})};
  }

  /// The length of the edges of a cell of the given lattice side.
  double length(std::uint32_t side) const { return side * m_unit * m_norm; }

private:
  // The rotation that takes z to the axis, as a quaternion (a, b, c, 0) rounded to integers.
  void set_frame(double x, double y, double z)
  {
    const double length = std::sqrt(x * x + y * y + z * z);
    CGAL_precondition(length > 0 && std::isfinite(length));
    double a = 1 + z / length, b = -y / length, c = x / length;
    if(a < 1e-3)
      a = 0, b = 1, c = 0; // opposite to z: half a turn about x
    const double scale = 31 / std::sqrt(a * a + b * b + c * c);
    a = std::round(a * scale), b = std::round(b * scale), c = std::round(c * scale);
    m_norm = a * a + b * b + c * c;
    m_axes[0] = {a * a + b * b - c * c, 2 * b * c, -2 * a * c};
    m_axes[1] = {2 * b * c, a * a - b * b + c * c, 2 * a * b};
    m_axes[2] = {2 * a * c, -2 * a * b, a * a - b * b - c * c};
  }

  double coordinate(int k, const Lattice_point& p) const
  {
    return m_origin[k] + m_unit * (p[0] * m_axes[0][k] + p[1] * m_axes[1][k] + p[2] * m_axes[2][k]);
  }

  std::array<double, 3> m_origin;
  std::array<std::array<double, 3>, 3> m_axes; // integers, orthogonal, each of length m_norm
  double m_norm, m_unit;
};

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_OCTREE_CELL_TRAITS_3_H
