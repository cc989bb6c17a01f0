// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Simplification of surfaces from images, which have several vertices for each voxel: far more than a mesh
// can follow.

#ifndef CGAL_MIXED_MESH_IMAGE_3_SIMPLIFY_CLOSED_SURFACE_H
#define CGAL_MIXED_MESH_IMAGE_3_SIMPLIFY_CLOSED_SURFACE_H

#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_image_3/internal/Quadric_collapses.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Constrained_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/assertions.h>
#include <CGAL/boost/graph/helpers.h>

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
  using Vertex_index = typename Surface::Vertex_index;
  using Index = Quadric_collapses::Index;
  using Triangle = Quadric_collapses::Triangle;
  using Is_kept = typename Surface::template Property_map<Edge_index, bool>;

  static constexpr const char* is_kept_name = "e:CGAL::Mixed_meshes_3::is_kept";
  static constexpr int attempts = 8, factor = 4;
  // Multiple of the wanted number of vertices from which the collapse by volume and shape starts.
  static constexpr std::size_t start = 16;

  Surface& m_surface;

public:
  explicit Surface_simplifier(Surface& surface) : m_surface(surface) {}

  void operator()(std::size_t wanted)
  {
    if(m_surface.has_garbage())
      m_surface.collect_garbage();
    if(is_closed(m_surface))
      approach(start * wanted, [this](std::size_t n) { return coarsen(n); });
    add_kept_edges();
    approach(wanted, [this](std::size_t n) { return reach(n); });
    Is_kept is_kept = add_kept_edges();
    m_surface.remove_property_map(is_kept);
  }

private:
  // Approaches the number in steps, so that a repeated attempt is not the whole way.
  template <class Reach>
  void approach(std::size_t wanted, const Reach& reach)
  {
    std::size_t next = wanted;
    while(factor * next < m_surface.number_of_vertices())
      next *= factor;
    while(next >= wanted && next < m_surface.number_of_vertices() && reach(next))
      next /= factor;
  }

  // Adds the map of kept edges, with no edge kept if there was no such map before.
  Is_kept add_kept_edges()
  {
    return m_surface.template add_property_map<Edge_index, bool>(is_kept_name, false).first;
  }

  // Collapses edges by quadrics. If faces cut each other afterwards, edges are kept, and the collapse is
  // repeated; if that does not help, the surface stays as it is.
  // \return whether the surface was coarsened
  bool coarsen(std::size_t number_of_vertices)
  {
    Is_kept is_kept = add_kept_edges();
    for(int i = 0; i < attempts; ++i) {
      Surface coarse = collapsed_by_quadrics(number_of_vertices, is_kept);
      std::vector<std::pair<Face_index, Face_index>> crossing;
      Polygon_mesh_processing::self_intersections(coarse, std::back_inserter(crossing));
      if(crossing.empty()) {
        m_surface = std::move(coarse);
        return true;
      }
      if(!keep_edges_around(crossing, coarse, 0))
        break;
    }
    m_surface.remove_property_map(is_kept);
    return false;
  }

  Surface collapsed_by_quadrics(std::size_t number_of_vertices, const Is_kept& is_kept) const
  {
    const Vec3 origin = to_vec3(m_surface.point(*m_surface.vertices().begin())); // squares stay small
    std::vector<Vec3> points;
    for(Vertex_index v : m_surface.vertices())
      points.push_back(to_vec3(m_surface.point(v)) - origin);
    std::vector<Triangle> triangles;
    std::vector<Index> number(m_surface.number_of_halfedges()), opposite;
    std::vector<bool> is_fixed(points.size(), false);
    for(Face_index f : m_surface.faces()) {
      Triangle& t = triangles.emplace_back();
      auto h = m_surface.halfedge(f);
      for(std::size_t i = 0; i < 3; ++i, h = m_surface.next(h)) {
        t[i] = Index(m_surface.source(h));
        number[h] = Index(3 * triangles.size() - 3 + i);
        if(is_kept[m_surface.edge(h)])
          is_fixed[t[i]] = true;
      }
    }
    for(Face_index f : m_surface.faces())
      for(auto h : m_surface.halfedges_around_face(m_surface.halfedge(f)))
        opposite.push_back(number[m_surface.opposite(h)]);
    const auto number_of_fixed = std::size_t(std::count(is_fixed.begin(), is_fixed.end(), true));
    Quadric_collapses collapses(std::move(points), triangles, std::move(opposite), std::move(is_fixed));
    // The fixed vertices are added to the number: otherwise the others would have to compensate for them.
    collapses(number_of_vertices + number_of_fixed);
    return surface_of(collapses.result(), origin);
  }

  static Surface surface_of(const std::pair<std::vector<Vec3>, std::vector<Triangle>>& soup,
                            const Vec3& origin)
  {
    Surface surface;
    for(const Vec3& p : soup.first) {
      const Vec3 q = p + origin;
      surface.add_vertex(Point(q[0], q[1], q[2]));
    }
    for(const Triangle& t : soup.second) {
      const Face_index face = surface.add_face(Vertex_index(t[0]), Vertex_index(t[1]), Vertex_index(t[2]));
      CGAL_assertion(face != Surface::null_face());
      CGAL_USE(face);
    }
    return surface;
  }

  // Collapses edges. If faces cut each other afterwards, edges are kept, and the collapse is repeated.
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
      if(!keep_edges_around(crossing, simplified, 0.5))
        return false;
    }
    return false;
  }

  static void collapse(Surface& surface, std::size_t number_of_vertices)
  {
    namespace SMS = Surface_mesh_simplification;
    using Placement = SMS::Constrained_placement<SMS::LindstromTurk_placement<Surface>, Is_kept>;
    const Is_kept is_kept = surface.template add_property_map<Edge_index, bool>(is_kept_name, false).first;
    // The filter prevents a face that would turn over from lying on another one.
    std::size_t kept = 0; // added to the number
    for(Edge_index e : surface.edges())
      kept += is_kept[e];
    SMS::edge_collapse(surface, Stop_at_number_of_edges{3 * number_of_vertices + kept},
                       parameters::edge_is_constrained_map(is_kept)
                         .get_placement(Placement(is_kept))
                         .filter(SMS::Bounded_normal_change_filter<>()));
  }

  // Keeps edges at crossing faces. \param share share of the faces' size to which edges around them are kept,
  // too
  // \return whether there are any edges that were not kept before
  bool keep_edges_around(const std::vector<std::pair<Face_index, Face_index>>& crossing,
                         const Surface& simplified, double share)
  {
    std::vector<Bbox_3> boxes;
    for(const auto& [f, g] : crossing)
      for(Face_index face : {f, g}) {
        const Bbox_3 b = Polygon_mesh_processing::face_bbox(face, simplified);
        const double margin = share * (std::max)({b.x_span(), b.y_span(), b.z_span()});
        boxes.emplace_back(b.xmin() - margin, b.ymin() - margin, b.zmin() - margin, b.xmax() + margin,
                           b.ymax() + margin, b.zmax() + margin);
      }
    const Is_kept is_kept = add_kept_edges();
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

\brief Simplifies a surface to approximately a number of vertices, by the collapse of the edges that change
its volume and shape least (Lindstrom, Turk: Fast and memory efficient polygonal simplification, 1998).

If a surface has more than sixteen times as many vertices, edges are collapsed down to that number by quadric
errors first (Garland, Heckbert: Surface simplification using quadric error metrics, 1997), which takes much
less time and moves the surface much less than the other collapses.

The topology is kept. Where the result would cut itself, edges are kept as they are; if that does not help,
the surface gets more vertices, up to their initial number. So a surface that does not cut itself at the start
does not cut itself in the end.

\param surface closed triangulated surface that does not cut itself
\param number_of_vertices wanted number of vertices
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
