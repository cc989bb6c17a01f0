// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Queries on a triangulated surface that need not enclose anything: it has a front and a back near by only.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_SURFACE_SHEET_ORACLE_3_H
#define CGAL_MIXED_MESH_3_INTERNAL_SURFACE_SHEET_ORACLE_3_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Surface_description.h>
#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/surface/Triangle_soup.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/assertions.h>
#include <CGAL/boost/graph/helpers.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

namespace internal {

class Sheet_oracle_3
{
public:
  using Kernel = Predicates_kernel;
  using Point_3 = Kernel::Point_3;

  template <class FaceListGraph, class NamedParameters>
  Sheet_oracle_3(const FaceListGraph& surface, const NamedParameters& np)
  {
    CGAL_precondition(num_faces(surface) > 0);
    build(surface_triangles(surface, np));
  }

  const Bbox_3& bbox() const { return m_bbox; }
  double area() const;
  std::size_t number_of_facets() const { return m_triangles.size(); }

  /// Whether a part of the sheet may meet a box: a fast test for what is far away.
  bool may_intersect(const Bbox_3& box) const;
  /// Whether the sheet meets a closed segment, exactly.
  bool do_intersect(const Point_3& p, const Point_3& q) const;

  /// The shares of a segment at which it crosses the sheet; none for triangles parallel to it.
  std::vector<double> crossings(const Vec3& p, const Vec3& q) const;

  Point_3 closest_point(const Point_3& p) const;
  /// The closest point of the sheet; faster if `hint`, a point of the sheet, is near.
  Point_3 closest_point(const Point_3& p, const Point_3& hint) const;

  /// Location of a point. The normal is weighted by angles where the closest point is on an edge or a vertex,
  /// so that the sign of the height is right (Baerentzen and Aanaes, 2005).
  Sheet_location locate(const Point_3& p) const;

  /// Points of the sheet in the middle of equal shares of its triangles, about `number` points, and the area
  /// that each point stands for.
  std::vector<std::pair<Point_3, double>> area_samples(std::size_t number) const;

private:
  struct Trees; // AABB trees: defined where they are used
  struct Delete_trees
  {
    void operator()(Trees* trees) const;
  };

  // A triangle with the normals of the places of a closest point: inside, on the edge opposite to a corner,
  // or at a corner.
  struct Triangle
  {
    std::array<Vec3, 3> points;
    Vec3 normal;
    std::array<Vec3, 3> normals_at_edges, normals_at_corners;
    std::array<bool, 3> is_edge_at_rim, is_corner_at_rim;
  };

  void build(const Triangle_soup& soup);

  std::vector<Triangle> m_triangles;
  Bbox_3 m_bbox;
  std::unique_ptr<Trees, Delete_trees> m_trees;
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#ifndef CGAL_MIXED_MESH_3_COMPILED
#include <CGAL/Mixed_mesh_3/internal/surface/Sheet_oracle_3_impl.h>
#endif

#endif // CGAL_MIXED_MESH_3_INTERNAL_SURFACE_SHEET_ORACLE_3_H
