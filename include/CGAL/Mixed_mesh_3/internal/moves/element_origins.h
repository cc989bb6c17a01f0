// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Elements that the elements of a changed mesh come from, for data of the user.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MOVES_ELEMENT_ORIGINS_H
#define CGAL_MIXED_MESH_3_INTERNAL_MOVES_ELEMENT_ORIGINS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_attributes.h>
#include <CGAL/Mixed_mesh_3/Element_locator_3.h>
#include <CGAL/Mixed_mesh_3/Index.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <cstddef>
#include <map>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// For each element that is present, in their order, the element of the start that it comes from: itself, or,
/// of an element that was added or has got another subdomain, the one at its center in that subdomain.
/// Vertices are taken where they were at the start: elements have their data with them when vertices move.
/// \param start mesh before the changes
/// \param elements elements of a working mesh: those of the start, present or removed, then those added.
/// \pre each subdomain is one of the start
/// \param old_points places of their vertices in the start
template <class Mesh, class Element>
std::vector<Element_index> element_origins(const Mesh& start, const std::vector<Element>& elements,
                                           const std::vector<Vec3>& old_points)
{
  std::vector<Element_index> origins;
  std::map<Subdomain_index, std::vector<std::size_t>> places; // in `origins`, of those that are to be located
  std::vector<Vec3> centers;                                  // of all elements present
  for(std::size_t e = 0; e < elements.size(); ++e) {
    const Element& element = elements[e];
    if(element.is_removed)
      continue;
    const Subdomain_index subdomain = element.attributes.subdomain_index;
    if(e >= start.number_of_elements() || start.subdomain_index(Element_index(e)) != subdomain)
      places[subdomain].push_back(origins.size());
    Vec3 center{};
    for(Vertex_index v : element)
      center = center + old_points[v];
    centers.push_back((1. / element.size()) * center);
    origins.push_back(Element_index(e));
  }
  for(const auto& [subdomain, some] : places) {
    Mesh part;
    std::vector<Element_index> elements_of_part;
    part.points() = start.points();
    for(Element_index e = 0; e < start.number_of_elements(); ++e)
      if(start.subdomain_index(e) == subdomain) {
        part.add_element(start.element(e).kind(), start.element(e).begin());
        elements_of_part.push_back(e);
      }
    const Element_locator_3<Mesh> locator(part);
    for(std::size_t place : some)
      origins[place] = elements_of_part[locator.nearest(centers[place]).element];
  }
  return origins;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MOVES_ELEMENT_ORIGINS_H
