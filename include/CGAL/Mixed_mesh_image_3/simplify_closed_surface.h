// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces out of images have several vertices for each voxel: far more than a mesh can follow.

#ifndef CGAL_MIXED_MESH_IMAGE_3_SIMPLIFY_CLOSED_SURFACE_H
#define CGAL_MIXED_MESH_IMAGE_3_SIMPLIFY_CLOSED_SURFACE_H

#include <CGAL/Bbox_3.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Constrained_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

namespace internal {

struct Stop_at_number_of_edges
{
  std::size_t number;

  template <class FT, class Profile>
  bool operator()(const FT&, const Profile&, std::size_t, std::size_t edges) const
  {
    return edges <= number;
  }
};

template <class Point>
class Surface_simplifier
{
  using Surface = Surface_mesh<Point>;
  using Edge_index = typename Surface::Edge_index;
  using Face_index = typename Surface::Face_index;
  using Is_kept = typename Surface::template Property_map<Edge_index, bool>;

  static constexpr const char* is_kept_name = "e:CGAL::Mixed_meshes_3::is_kept";
  static constexpr int attempts = 8, factor = 4;

  Surface& m_surface;

public:
  explicit Surface_simplifier(Surface& surface) : m_surface(surface) {}

  void operator()(std::size_t wanted)
  {
    std::size_t next = wanted;
    while(factor * next < m_surface.number_of_vertices())
      next *= factor;
    Is_kept is_kept = m_surface.template add_property_map<Edge_index, bool>(is_kept_name, false).first;
    while(next >= wanted && next < m_surface.number_of_vertices() && reach(next))
      next /= factor;
    is_kept = m_surface.template add_property_map<Edge_index, bool>(is_kept_name, false).first;
    m_surface.remove_property_map(is_kept);
  }

private:
  // Where faces cut each other afterwards, edges are kept, and it is tried again.
  bool reach(std::size_t number_of_vertices)
  {
    for(int i = 0; i < attempts; ++i) {
      Surface simplified = m_surface;
      collapse(simplified, number_of_vertices);
      std::vector<std::pair<Face_index, Face_index>> crossing;
      Polygon_mesh_processing::self_intersections(simplified, std::back_inserter(crossing));
      if(crossing.empty()) {
        simplified.collect_garbage();
        m_surface = std::move(simplified);
        return true;
      }
      if(!keep_edges_around(crossing, simplified))
        return false;
    }
    return false;
  }

  static void collapse(Surface& surface, std::size_t number_of_vertices)
  {
    namespace SMS = Surface_mesh_simplification;
    using Placement = SMS::Constrained_placement<SMS::LindstromTurk_placement<Surface>, Is_kept>;
    const Is_kept is_kept = surface.template add_property_map<Edge_index, bool>(is_kept_name, false).first;
    // a face that would turn over would lie on another one
    SMS::edge_collapse(surface, Stop_at_number_of_edges{3 * number_of_vertices},
                       parameters::edge_is_constrained_map(is_kept)
                         .get_placement(Placement(is_kept))
                         .filter(SMS::Bounded_normal_change_filter<>()));
  }

  // Whether there are any that were not kept before.
  bool keep_edges_around(const std::vector<std::pair<Face_index, Face_index>>& crossing,
                         const Surface& simplified)
  {
    std::vector<Bbox_3> boxes;
    for(const auto& [f, g] : crossing)
      for(Face_index face : {f, g}) {
        const Bbox_3 b = Polygon_mesh_processing::face_bbox(face, simplified);
        const double margin = (std::max)({b.x_span(), b.y_span(), b.z_span()}) / 2;
        boxes.emplace_back(b.xmin() - margin, b.ymin() - margin, b.zmin() - margin, b.xmax() + margin,
                           b.ymax() + margin, b.zmax() + margin);
      }
    const Is_kept is_kept = m_surface.template add_property_map<Edge_index, bool>(is_kept_name, false).first;
    bool has_new = false;
    for(Edge_index e : m_surface.edges()) {
      const Bbox_3 b = Polygon_mesh_processing::edge_bbox(e, m_surface);
      if(!is_kept[e]
         && std::any_of(boxes.begin(), boxes.end(), [&](const Bbox_3& box) { return do_overlap(b, box); }))
        is_kept[e] = has_new = true;
    }
    return has_new;
  }
};

} // namespace internal

/*!
\ingroup PkgMixedMeshImage3Ref

\brief Simplifies a surface to a number of vertices, about, by the collapse of the edges that change its
volume and shape least (Lindstrom, Turk: Fast and memory efficient polygonal simplification, 1998).

The topology stays. Where the result would cut itself, edges are kept as they are; if that does not help, the
surface gets more vertices, up to those it has. So what does not cut itself at the start does not in the end.

\param surface a closed triangulated surface that does not cut itself
\param number_of_vertices how many vertices are wanted
\par Complexity
\f$ O(n \log n) \f$
*/
template <class Point>
void simplify_closed_surface(Surface_mesh<Point>& surface, std::size_t number_of_vertices)
{
  internal::Surface_simplifier<Point> simplify(surface);
  simplify((std::max)(number_of_vertices, std::size_t(4)));
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_SIMPLIFY_CLOSED_SURFACE_H
