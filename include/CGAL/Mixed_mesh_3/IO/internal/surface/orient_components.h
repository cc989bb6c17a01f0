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

struct Surface_component
{
  std::vector<Surface::Face_index> faces;
  Bbox_3 bbox;
  double volume = 0;
  std::vector<std::size_t> around; // components that it is inside of

  bool is_cavity() const { return around.size() % 2 == 1; }

  bool has_box_within(const Bbox_3& box) const
  {
    bool is_within = true;
    for(int k = 0; k < 3; ++k)
      is_within = is_within && box.min(k) <= bbox.min(k) && bbox.max(k) <= box.max(k);
    return is_within;
  }
};

// The components, numbered as the map says.
template <class ComponentMap>
std::vector<Surface_component> components_of(const Surface& mesh, std::size_t number,
                                             const ComponentMap& component_map)
{
  std::vector<Surface_component> components(number);
  for(Surface::Face_index face : faces(mesh))
    components[get(component_map, face)].faces.push_back(face);
  for(Surface_component& c : components) {
    const Surface::Point origin = Triangle_view(c.faces.front(), mesh).points[0];
    for(Surface::Face_index face : c.faces) {
      const Triangle_view t(face, mesh);
      for(const auto& p : t.points)
        c.bbox += p.bbox();
      c.volume += CGAL::to_double(CGAL::volume(origin, t.points[0], t.points[1], t.points[2]));
    }
  }
  return components;
}

// Finds the components that are inside others. A component that cuts another one is not inside it.
// \param cutting pairs of components that cut each other, both ways
inline void nest_components(const Surface& mesh, const std::set<std::pair<std::size_t, std::size_t>>& cutting,
                            std::vector<Surface_component>& components)
{
  using Side = CGAL::Side_of_triangle_mesh<Surface, Predicates_kernel>;
  for(std::size_t o = 0; o < components.size(); ++o) {
    const Surface_component& outer = components[o];
    std::vector<Surface_component*> candidates;
    for(std::size_t c = 0; c < components.size(); ++c)
      if(c != o && components[c].has_box_within(outer.bbox) && cutting.count({c, o}) == 0)
        candidates.push_back(&components[c]);
    if(candidates.empty())
      continue;
    const Side::AABB_tree tree(outer.faces.begin(), outer.faces.end(), mesh, get(CGAL::vertex_point, mesh));
    const Side side(tree);
    for(Surface_component* c : candidates) {
      Bounded_side s = ON_BOUNDARY;
      for(std::size_t i = 0; i < c->faces.size() && s == ON_BOUNDARY; ++i)
        for(const auto& p : Triangle_view(c->faces[i], mesh).points)
          if(s == ON_BOUNDARY)
            s = side(p);
      if(s == ON_BOUNDED_SIDE)
        c->around.push_back(o);
    }
  }
}

// Orients the components such that the solid is on their inner side. PMP::orient_to_bound_a_volume() looks at
// one vertex of a component only; where components touch, that vertex may be in both.
inline Component_counts orient_components(Surface& mesh, const std::vector<Face_pair>& crossings = {})
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  const auto component_map = get(CGAL::dynamic_face_property_t<std::size_t>(), mesh);
  const std::size_t number = PMP::connected_components(mesh, component_map);
  std::vector<Surface_component> components = components_of(mesh, number, component_map);
  std::set<std::pair<std::size_t, std::size_t>> cutting;
  for(const Face_pair& pair : crossings) {
    const std::size_t c = get(component_map, pair.first), d = get(component_map, pair.second);
    cutting.insert({c, d});
    cutting.insert({d, c});
  }
  nest_components(mesh, cutting, components);
  Component_counts counts{components.size(), 0, 0};
  for(const Surface_component& c : components) {
    counts.cavities += c.is_cavity();
    if((c.volume < 0) != c.is_cavity()) {
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
