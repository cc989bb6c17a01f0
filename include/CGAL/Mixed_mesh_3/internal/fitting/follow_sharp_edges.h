// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sharp edges of the surface: paths of edges of the boundary are laid along sharp edges, given up where paths
// do not fit, and measured in the end.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_FOLLOW_SHARP_EDGES_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_FOLLOW_SHARP_EDGES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/fitting/Fitting_state.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/feature_paths.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/surface_targets.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Chooses the paths of edges that are to follow the sharp edges.
template <class Quality>
void choose_feature_paths(Fitting_state<Quality>& s)
{
  const Surface_targets targets = surface_targets(s.boundary.faces, s.mesh.points, s.project, s.mesh.strata);
  s.feature_places = s.mesh.points;
  for(std::size_t i = 0; i < targets.vertices.size(); ++i)
    s.feature_places[targets.vertices[i]] = targets.positions[i];
  Feature_paths paths(s.mesh, s.quality, *s.features, s.strata, s.boundary, s.feature_places, s.is_held,
                      (std::min)(s.largest_cost_of_half, s.intermediate_bound()),
                      s.criteria.number_of_bisections());
  paths();
  s.feature_places = paths.places();
  const std::size_t number = paths.bisected().size();
  s.result.number_of_bisections += number;
  s.add_vertices(false);
  for(Vertex_index v = Vertex_index(s.mesh.points.size() - number); v < s.mesh.points.size(); ++v) {
    s.saved_points.push_back(s.mesh.points[v]);
    s.moves.fix(v);
  }
  s.update_boundary();
}

/// Gives up features that vertices do not reach: these vertices shall be on the surface at least.
/// \param beside whether to include vertices that have reached their sharp edge, if a neighbor does not
/// arrive
template <class Quality>
void give_up_features(Fitting_state<Quality>& s, bool beside)
{
  for(const auto& [v, target] : s.underway)
    if(s.mesh.strata[v] >= first_sharp_stratum)
      s.leave_feature(v);
    else if(beside)
      for(Element_index e : s.mesh.incident[v])
        for(Vertex_index u : s.mesh.elements[e])
          if(s.mesh.strata[u] >= first_sharp_stratum)
            s.leave_feature(u);
  s.choose_new_targets();
}

/// An interval of arc lengths of a polyline.
using Arc = std::pair<double, double>;

/// The parts of its polyline that an edge is near to.
/// \pre both ends have arrived
template <class Quality>
std::vector<Arc> arcs_kept(const Fitting_state<Quality>& s, const Working_mesh::Edge& edge,
                           const Feature_polyline& polyline)
{
  constexpr int samples = 16;
  constexpr double near_enough = 0.05; // in lengths of the edge: 16 edges for a circle
  const Vec3 &p = s.mesh.points[edge.first], along = s.mesh.points[edge.second] - p;
  const auto arc_length = [&](Vertex_index v) {
    return s.features->arc_length(s.mesh.points[v], s.mesh.strata[v] - first_sharp_stratum, polyline);
  };
  const auto [first, last] = std::minmax({arc_length(edge.first), arc_length(edge.second)});
  std::vector<Arc> arcs;
  for(int i = 0; i < samples; ++i) {
    const auto at = [&, first = first, last = last](double k) {
      return first + k / samples * (last - first);
    };
    const Vec3 q = polyline.at(at(i + 0.5)) - p;
    const double share = (std::min)((std::max)(dot(q, along) / dot(along, along), 0.), 1.);
    if(norm(q - share * along) <= near_enough * norm(along))
      arcs.emplace_back(at(i), at(i + 1));
  }
  return arcs;
}

/// The parts of a polyline between others.
inline std::vector<std::vector<Vec3>> parts_between(const Feature_polyline& polyline, std::vector<Arc> arcs)
{
  constexpr double least = 1e-6; // in lengths of the polyline: 1e10 roundings of 2^-53
  std::sort(arcs.begin(), arcs.end());
  arcs.emplace_back(polyline.length(), polyline.length());
  std::vector<std::vector<Vec3>> parts;
  double end = 0;
  for(const auto& [first, last] : arcs) {
    if(first - end > least * polyline.length())
      parts.push_back(polyline.part(end, first));
    end = (std::max)(end, last);
  }
  return parts;
}

/// Measures the sharp edges and corners that the mesh has kept, for the result.
template <class Quality>
void measure_features(Fitting_state<Quality>& s)
{
  const auto& polylines = s.features->polylines();
  Mixed_mesh_optimization_result_3& result = s.result;
  result.length_of_sharp_edges = s.features->length();
  result.length_of_sharp_edges_kept = 0;
  result.lost_sharp_edges.clear();
  std::vector<std::vector<Arc>> kept(polylines.size());
  for(const auto& [edge, stratum] : s.mesh.sharp_edges)
    if(s.is_arrived[edge.first] && s.is_arrived[edge.second])
      for(const Arc& arc : arcs_kept(s, edge, polylines[stratum - first_sharp_stratum])) {
        result.length_of_sharp_edges_kept += arc.second - arc.first;
        kept[stratum - first_sharp_stratum].push_back(arc);
      }
  for(std::size_t i = 0; i < polylines.size(); ++i)
    for(std::vector<Vec3>& part : parts_between(polylines[i], std::move(kept[i])))
      result.lost_sharp_edges.push_back(std::move(part));
  result.number_of_corners = s.features->number_of_real_corners();
  result.number_of_corners_kept = 0;
  const std::size_t first_corner = first_sharp_stratum + polylines.size();
  for(Vertex_index v = 0; v < s.mesh.points.size(); ++v)
    if(s.mesh.strata[v] >= first_corner && s.is_arrived[v])
      result.number_of_corners_kept += s.features->is_real_corner(s.mesh.strata[v] - first_corner);
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_FOLLOW_SHARP_EDGES_H
