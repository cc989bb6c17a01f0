// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The components of a surface: which are cavities, and their orientation.

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_ORIENT_COMPONENTS_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_ORIENT_COMPONENTS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/IO/internal/surface/surface_crossings.h>

#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Bbox_3.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/enum.h>
#include <CGAL/number_utils.h>

#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

// The volume with points relative to a vertex: far from the origin, digits would be lost.
inline double enclosed_volume(const Surface& mesh)
{
  const Surface::Point origin = mesh.point(*vertices(mesh).first);
  double volume = 0;
  for(Surface::Face_index face : faces(mesh)) {
    const Triangle_view t(face, mesh);
    volume += CGAL::volume(origin, t.points[0], t.points[1], t.points[2]);
  }
  return volume;
}

struct Component_counts
{
  std::size_t all = 0, cavities = 0, reversed = 0;
};

// Orients the components such that the solid is on their inner side. A component that cuts another one is not
// inside it. PMP::orient_to_bound_a_volume() looks at one vertex of a component only; where components touch,
// that vertex may be in both.
inline Component_counts orient_components(Surface& mesh, const std::vector<Face_pair>& crossings = {})
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  using Side = CGAL::Side_of_triangle_mesh<Surface, Predicates_kernel>;
  struct Component
  {
    std::vector<Surface::Face_index> faces;
    Bbox_3 bbox;
    double volume = 0;
    bool is_cavity = false;
  };

  const auto component_map = get(CGAL::dynamic_face_property_t<std::size_t>(), mesh);
  std::vector<Component> components(PMP::connected_components(mesh, component_map));
  for(Surface::Face_index face : faces(mesh))
    components[get(component_map, face)].faces.push_back(face);
  for(Component& c : components) {
    const Surface::Point origin = Triangle_view(c.faces.front(), mesh).points[0];
    for(Surface::Face_index face : c.faces) {
      const Triangle_view t(face, mesh);
      for(const auto& p : t.points)
        c.bbox += p.bbox();
      c.volume += CGAL::to_double(CGAL::volume(origin, t.points[0], t.points[1], t.points[2]));
    }
  }

  std::set<std::pair<std::size_t, std::size_t>> cutting;
  for(const Face_pair& pair : crossings) {
    const std::size_t c = get(component_map, pair.first), d = get(component_map, pair.second);
    cutting.insert({c, d});
    cutting.insert({d, c});
  }

  for(const Component& outer : components) {
    std::vector<Component*> candidates;
    for(Component& c : components) {
      bool is_within = &c != &outer
                       && cutting.count(
                            {std::size_t(&c - components.data()), std::size_t(&outer - components.data())})
                            == 0;
      for(int k = 0; k < 3; ++k)
        is_within = is_within && outer.bbox.min(k) <= c.bbox.min(k) && c.bbox.max(k) <= outer.bbox.max(k);
      if(is_within)
        candidates.push_back(&c);
    }
    if(candidates.empty())
      continue;
    const Side::AABB_tree tree(outer.faces.begin(), outer.faces.end(), mesh, get(CGAL::vertex_point, mesh));
    const Side side(tree);
    for(Component* c : candidates) {
      Bounded_side s = ON_BOUNDARY;
      for(std::size_t i = 0; i < c->faces.size() && s == ON_BOUNDARY; ++i)
        for(const auto& p : Triangle_view(c->faces[i], mesh).points)
          if(s == ON_BOUNDARY)
            s = side(p);
      c->is_cavity ^= s == ON_BOUNDED_SIDE;
    }
  }
  Component_counts counts{components.size(), 0, 0};
  for(const Component& c : components) {
    counts.cavities += c.is_cavity;
    if((c.volume < 0) != c.is_cavity) {
      PMP::reverse_face_orientations(c.faces, mesh);
      ++counts.reversed;
    }
  }
  return counts;
}

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_ORIENT_COMPONENTS_H
