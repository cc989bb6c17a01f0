// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Exact queries on a closed triangulated surface, made fast by locality: the part of the surface that meets a
// cell is passed on to its children, and the side of a point follows from a point of known side in the same
// cell.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_SURFACE_SURFACE_ORACLE_3_H
#define CGAL_MIXED_MESH_3_INTERNAL_SURFACE_SURFACE_ORACLE_3_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Surface_description.h>
#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/surface/Triangle_soup.h>
#include <CGAL/Mixed_mesh_3/internal/surface/visible_sharp_edges.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/assertions.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

class Triangle_tree;

class Surface_oracle_3
{
public:
  using Kernel = Predicates_kernel;
  using Point_3 = Kernel::Point_3;
  using Triangle_3 = Kernel::Triangle_3;

  /// The facets that meet a cell, and a point of the cell with its side.
  struct Surface_part
  {
    std::vector<std::uint32_t> facets;
    Point_3 reference = ORIGIN;
    Bounded_side reference_side = ON_UNBOUNDED_SIDE;
  };

  template <class FaceListGraph, class NamedParameters>
  Surface_oracle_3(const FaceListGraph& surface, const NamedParameters& np)
  {
    CGAL_precondition(CGAL::is_closed(surface));
    build(surface_triangles(surface, np));
  }

  const Bbox_3& bbox() const { return m_bbox; }
  double area() const;
  double volume() const;
  std::size_t number_of_facets() const { return m_facets.size(); }
  /// A facet, by the number of the surface's face.
  Triangle_3 facet(std::size_t f) const
  {
    const std::array<std::uint32_t, 3>& v = m_facets[f];
    return Triangle_3(m_points[v[0]], m_points[v[1]], m_points[v[2]]);
  }
  /// The shells of the whole surface.
  const Shell_counts& shells() const { return m_shells; }

  /// The edges between facets whose normals differ by more than an angle, in degrees.
  Sharp_edges sharp_edges(double angle) const { return surface_edges(angle).edges; }
  Surface_edges surface_edges(double angle) const;

  /// The shares of a segment at which it crosses facets; none for facets parallel to it.
  std::vector<double> crossings(const Vec3& p, const Vec3& q) const;

  /// The coordinates of the planes of the facets, with the area in each plane, for each axis, if each facet
  /// is perpendicular to an axis; else nothing.
  Axis_parallel_planes axis_parallel_planes() const;

  /// The whole surface, with a point outside as reference: the paper's P_out.
  Surface_part surface_part() const
  {
    Surface_part part;
    part.facets.resize(number_of_facets());
    std::iota(part.facets.begin(), part.facets.end(), 0);
    const Bbox_3& b = bbox();
    // The reference may be anywhere outside, but segments to it must not be parallel to the axes; the side
    // that follows is the same for every reference.
    const double margin = 0.1 * (std::max)({b.x_span(), b.y_span(), b.z_span()});
    part.reference = Point_3((b.xmax)() + 0.7 * b.x_span() + margin, (b.ymax)() + 0.9 * b.y_span() + margin,
                             (b.zmax)() + b.z_span() + margin);
    return part;
  }

  /// The location of a cell: `ON_BOUNDARY` iff the cell meets the surface, else the side of all its points.
  /// \param parent the part for a cell that contains this one
  /// \param part filled if the cell meets the surface
  template <class Cell>
  Bounded_side locate(const Cell& cell, const Surface_part& parent, Surface_part& part) const
  {
    part.facets.clear();
    for(std::uint32_t f : parent.facets)
      if(m_boxes[f].may_overlap(cell.bbox()) && cell.do_intersect(facet(f)))
        part.facets.push_back(f);
    part.reference = cell.center();
    part.reference_side = bounded_side(cell.center(), parent);
    return part.facets.empty() ? part.reference_side : ON_BOUNDARY;
  }

  /// The side of a point of the cell of `part`: parity of the facets between the reference and it.
  Bounded_side bounded_side(const Point_3& p, const Surface_part& part) const
  {
    if(part.facets.empty())
      return part.reference_side;
    if(part.reference_side == ON_BOUNDARY)
      return bounded_side(p);
    const Point_3& q = part.reference;
    const Bbox_3 segment = p.bbox() + q.bbox();
    bool odd = false;
    for(std::uint32_t f : part.facets) {
      if(!m_boxes[f].may_overlap(segment))
        continue;
      const Triangle_3 t = facet(f);
      const Orientation side_p = orientation(t[0], t[1], t[2], p);
      const Orientation side_q = orientation(t[0], t[1], t[2], q);
      if(side_p == side_q && side_p != COPLANAR)
        continue;
      const Orientation o0 = orientation(p, q, t[0], t[1]), o1 = orientation(p, q, t[1], t[2]);
      if(o0 * o1 == -1)
        continue;
      const Orientation o2 = orientation(p, q, t[2], t[0]);
      if(o0 * o2 == -1 || o1 * o2 == -1)
        continue;
      if(side_p == COPLANAR || side_q == COPLANAR || o0 == COPLANAR || o1 == COPLANAR || o2 == COPLANAR)
        return bounded_side(p); // the segment touches an edge or a vertex, or ends on the surface
      odd = !odd;
    }
    return odd ? opposite(part.reference_side) : part.reference_side;
  }

  /// The side of any point, from a ray through the AABB tree.
  Bounded_side bounded_side(const Point_3& p) const;

  /// The closest point of the surface; faster if `part` has facets near `p`, which is not required.
  Point_3 closest_point(const Point_3& p, const Surface_part& part) const
  {
    if(part.facets.empty())
      return closest_point(p);
    Point_3 hint = p;
    double nearest = std::numeric_limits<double>::infinity();
    for(std::uint32_t f : part.facets)
      for(std::uint32_t v : m_facets[f]) {
        const Point_3& q = m_points[v];
        const double d = CGAL::squared_distance(p, q);
        if(d < nearest) {
          nearest = d;
          hint = q;
        }
      }
    return closest_point(p, hint);
  }

  /// The closest point of the surface; faster if `hint`, a point of the surface, is near.
  Point_3 closest_point(const Point_3& p, const Point_3& hint) const;

  /// The closest point of the surface.
  Point_3 closest_point(const Point_3& p) const;

  /// The tree of the facets' closest points.
  std::shared_ptr<const Triangle_tree> tree_of_closest_points() const { return m_closest; }

  /// Points of the surface, such that no point of the surface is farther than about `spacing` from one of
  /// them: all vertices, and a grid on larger triangles.
  std::vector<Point_3> surface_samples(double spacing) const;

private:
  // The box of a facet, in half the memory, a little larger: boxes of all facets are tested for each cell.
  class Facet_box
  {
    std::array<float, 3> m_low, m_high;

  public:
    explicit Facet_box(const Bbox_3& box)
    {
      constexpr float infinity = std::numeric_limits<float>::infinity();
      for(int k = 0; k < 3; ++k) {
        m_low[std::size_t(k)] = std::nextafter(float((box.min)(k)), -infinity);
        m_high[std::size_t(k)] = std::nextafter(float((box.max)(k)), infinity);
      }
    }

    bool may_overlap(const Bbox_3& box) const
    {
      return double(m_low[0]) <= (box.xmax)() && (box.xmin)() <= double(m_high[0])
             && double(m_low[1]) <= (box.ymax)() && (box.ymin)() <= double(m_high[1])
             && double(m_low[2]) <= (box.zmax)() && (box.zmin)() <= double(m_high[2]);
    }
  };

  struct Side_tree; // AABB tree: defined where it is used
  struct Delete_side_tree
  {
    void operator()(Side_tree* tree) const;
  };

  static Bounded_side opposite(Bounded_side side) { return Bounded_side(-int(side)); }

  void build(Triangle_soup soup);
  void count_shells(const std::vector<std::array<std::size_t, 3>>& triangles);

  // Vertices and facets without the links of a mesh, as a surface may have millions.
  std::vector<Point_3> m_points;
  std::vector<std::array<std::uint32_t, 3>> m_facets;
  std::vector<Facet_box> m_boxes;
  Bbox_3 m_bbox;
  Shell_counts m_shells;
  std::shared_ptr<const Triangle_tree> m_closest;
  std::unique_ptr<Side_tree, Delete_side_tree> m_side_tree;
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#ifndef CGAL_MIXED_MESH_3_COMPILED
#include <CGAL/Mixed_mesh_3/internal/surface/Surface_oracle_3_impl.h>
#endif

#endif // CGAL_MIXED_MESH_3_INTERNAL_SURFACE_SURFACE_ORACLE_3_H
