// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Elements that would be flat once their vertices are on the surface.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_SPLIT_FLAT_ELEMENTS_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_SPLIT_FLAT_ELEMENTS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/fitting/Fitting_state.h>
#include <CGAL/Mixed_mesh_3/internal/moves/bisect_edge.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Whether a tetrahedron would be above the bound, or inverted.
template <class Quality>
bool would_be_bad(const Fitting_state<Quality>& s, const Working_mesh::Element& element,
                  const std::vector<Vec3>& targets)
{
  const auto at_target = [&](Vertex_index v) -> const Vec3& { return targets[v]; };
  return !(s.quality(TETRAHEDRON, relative_points(element, at_target)) <= s.final_bound())
         || jacobian_sign(element, at_target) != Jacobian_sign::POSITIVE;
}

/*!
Bisects edges inside of tetrahedra whose vertices are all on the boundary or on interfaces, beside a sharp
edge or a curve where interfaces meet, and that would be above the bound with their vertices at their targets:
the surface of a subdomain is flat there, or turns inwards. The middle is free to move away from the surface.
Flips remove such tetrahedra elsewhere, but have to keep sharp edges and curves. Of 24 meshes of boxes and
cylinders that cross or stand on each other, 649 vertices do not arrive without this, 290 with it.

\pre no vertex has moved since `set_targets()`
*/
template <class Quality>
void split_flat_elements(Fitting_state<Quality>& s)
{
  using Edge = Working_mesh::Edge;
  if(s.mesh.sharp_edges.empty() && s.domain.subdomain_indices().size() == 1)
    return;
  std::map<Edge, Stratum> outer; // edges of the boundary and of interfaces
  std::vector<std::uint8_t> is_beside_curve(s.mesh.points.size(), 0);
  for(std::size_t f = 0; f < s.boundary.faces.size(); ++f) {
    const Face_vertices& v = s.boundary.faces[f].vertices();
    for(int i = 0; i < v.size(); ++i) {
      const Vertex_index a = v[i], b = v[(i + 1) % v.size()];
      const Stratum stratum = outer.try_emplace(std::minmax(a, b), s.boundary.strata[f]).first->second;
      if(stratum != s.boundary.strata[f] || s.mesh.is_sharp(a, b))
        is_beside_curve[a] = is_beside_curve[b] = 1;
    }
  }
  std::vector<Vec3> targets = s.mesh.points;
  for(const auto& [v, target] : s.underway)
    targets[v] = target;
  std::vector<std::pair<double, Edge>> inner; // the longest one of each element
  for(const Working_mesh::Element& element : s.mesh.elements) {
    if(element.is_removed || element.kind != TETRAHEDRON
       || !std::all_of(element.begin(), element.end(),
                       [&](Vertex_index v) { return s.mesh.is_on_boundary(v); })
       || std::none_of(element.begin(), element.end(),
                       [&](Vertex_index v) { return is_beside_curve[v] != 0; })
       || !would_be_bad(s, element, targets))
      continue;
    std::pair<double, Edge> longest;
    for(Vertex_index a : element)
      for(Vertex_index b : element)
        if(a < b && outer.count({a, b}) == 0)
          longest = (std::max)(longest, {norm(targets[a] - targets[b]), {a, b}});
    if(longest.first > 0)
      inner.push_back(longest);
  }
  std::sort(inner.begin(), inner.end());
  inner.erase(std::unique(inner.begin(), inner.end()), inner.end());
  // A fine mesh has no budget: vertices are removed later.
  for(auto longest = inner.rbegin();
      longest != inner.rend()
      && (s.mode.leaves_rest || s.result.number_of_bisections < s.criteria.number_of_bisections());
      ++longest) {
    const auto& [a, b] = longest->second;
    const Vec3 middle = 0.5 * (s.mesh.points[a] + s.mesh.points[b]);
    if(bisect_edge(s.mesh, s.quality, a, b, middle, free_stratum, s.intermediate_bound())) {
      s.saved_points.push_back(middle);
      ++s.result.number_of_bisections;
    }
  }
  s.add_vertices(false);
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_SPLIT_FLAT_ELEMENTS_H
