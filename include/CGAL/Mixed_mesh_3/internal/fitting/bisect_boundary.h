// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pass that bisects edges of the boundary where one more vertex gains most.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_BISECT_BOUNDARY_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_BISECT_BOUNDARY_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/fitting/Fitting_state.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/bisect_boundary_edges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

using Edge_apexes = std::array<Vertex_index, 2>; // of the triangles beside an edge of the boundary

/// Bisects the edges that gain most.
/// \param gain `double(Vertex_index a, Vertex_index b, const Edge_apexes&, Stratum)`; at most 0: none
template <class Quality, class Gain>
void bisect_edges(Fitting_state<Quality>& s, std::size_t number, const Gain& gain)
{
  const auto is_arrived = [&](Vertex_index v) { return v >= s.is_arrived.size() || s.is_arrived[v]; };
  const auto gain_if_arrived = [&](Vertex_index a, Vertex_index b, const Edge_apexes& apexes,
                                   Stratum stratum) {
    return is_arrived(a) && is_arrived(b) ? gain(a, b, apexes, stratum) : 0.;
  };
  Boundary_bisector bisector(s.mesh, s.quality, s.project, gain_if_arrived, s.boundary,
                             (std::min)(s.largest_cost_of_half, s.intermediate_bound()));
  const auto bisected = bisector(number);
  Vertex_index v = Vertex_index(s.is_arrived.size());
  s.result.number_of_bisections += bisected.size();
  s.result.number_of_boundary_vertices += bisected.size();
  s.add_vertices(true);
  for(const auto& [edge, is_underway, target] : bisected) {
    s.saved_points.push_back(0.5 * (s.saved_points[edge.first] + s.saved_points[edge.second]));
    if(is_underway)
      s.set_underway(v, target);
    else
      ++s.result.number_of_arrived_vertices;
    ++v;
  }
  s.update_boundary();
}

/// The way from the middle of an edge to the surface.
template <class Quality>
Vec3 way_to_surface(const Fitting_state<Quality>& s, Vertex_index a, Vertex_index b, Stratum stratum)
{
  const Vec3 middle = 0.5 * (s.mesh.points[a] + s.mesh.points[b]);
  return (s.mesh.strata[a] == stratum ? s.project(middle, s.mesh.points[a], stratum)
                                      : s.project(middle, stratum))
         - middle;
}

/// Twice the area of the two triangles beside an edge.
inline double doubled_area_beside(const std::vector<Vec3>& p, Vertex_index a, Vertex_index b,
                                  const Edge_apexes& apexes)
{
  return norm(cross(p[b] - p[a], p[apexes[0]] - p[a])) + norm(cross(p[b] - p[a], p[apexes[1]] - p[a]));
}

/// For each subdomain but the outermost, the volume between its faces and its surface that is tolerated; none
/// if there is only one.
template <class Quality>
std::map<Subdomain_index, double> tolerated_losses(const Fitting_state<Quality>& s)
{
  // Of the volume of a subdomain within, times the number of vertices to the power of 2/3: 3.5 % with 2,000
  // vertices, 1.2 % with 10,000.
  constexpr double tolerated_loss = 5.5;
  std::map<Subdomain_index, double> tolerated;
  const double share = tolerated_loss * std::pow(double(s.mesh.points.size()), -2. / 3);
  for(const Working_mesh::Element& element : s.mesh.elements)
    if(!element.is_removed)
      tolerated[element.attributes.subdomain_index] += share
                                                       * volume(element.kind,
                                                                s.mesh.relative_points(element));
  if(tolerated.size() < 2)
    return {};
  tolerated.erase(s.domain.subdomain_indices().back());
  return tolerated;
}

/// Small subdomains lose most: between the faces of a subdomain within and its surface there is as much,
/// nearly, as their edges gain by bisection, each by the two tetrahedra on the faces beside it. The largest
/// gains are taken until all but a tolerated share of the volume is left.
template <class Quality>
void bisect_subdomains(Fitting_state<Quality>& s, std::size_t most)
{
  const std::map<Subdomain_index, double> tolerated = tolerated_losses(s);
  const std::vector<Vec3>& p = s.mesh.points;
  std::map<Subdomain_index, std::map<Working_mesh::Edge, double>> gains;
  for(std::size_t f = 0; f < s.boundary.faces.size() && !tolerated.empty(); ++f) {
    const Face_vertices& v = s.boundary.faces[f].vertices();
    const Stratum stratum = s.boundary.strata[f];
    const Subdomain_index first = s.first_subdomain(stratum);
    if(v.size() == 3 && tolerated.count(first) > 0)
      for(int i = 0; i < 3; ++i) {
        const Vertex_index a = v[i], b = v[(i + 1) % 3], apex = v[(i + 2) % 3];
        gains[first][std::minmax(a, b)] += dot(way_to_surface(s, a, b, stratum),
                                               cross(p[b] - p[a], p[apex] - p[a]))
                                           / 6;
      }
  }
  for(const auto& [subdomain, of_edges] : gains) {
    const Subdomain_index index = subdomain; // which a lambda may capture
    double loss = -tolerated.at(index);
    std::vector<double> largest;
    for(const auto& [edge, gain] : of_edges) {
      loss += gain;
      largest.push_back(gain);
    }
    std::sort(largest.begin(), largest.end(), std::greater<double>());
    std::size_t number = 0;
    for(; number < largest.size() && largest[number] > 0 && loss > 0; ++number)
      loss -= largest[number];
    bisect_edges(s, (std::min)(number, most - s.result.number_of_bisections),
                 [&](Vertex_index a, Vertex_index b, const Edge_apexes& apexes, Stratum stratum) {
                   return s.first_subdomain(stratum) == index
                            ? norm(way_to_surface(s, a, b, stratum)) * doubled_area_beside(p, a, b, apexes)
                            : 0.;
                 });
  }
}

/// The sharp edges that are farthest from their polylines, in lengths of edges.
template <class Quality>
void bisect_sharp_edges(Fitting_state<Quality>& s, std::size_t number)
{
  constexpr double near_enough = 0.04; // 20 edges for a circle
  bisect_edges(s, number, [&](Vertex_index a, Vertex_index b, const Edge_apexes&, Stratum) {
    if(!s.mesh.is_sharp(a, b))
      return 0.;
    const Vec3 &p = s.mesh.points[a], &q = s.mesh.points[b], middle = 0.5 * (p + q);
    const double share = norm(s.project(middle, s.mesh.sharp_stratum(a, b)) - middle) / norm(q - p);
    return share > near_enough ? share * norm(q - p) : 0;
  });
}

/// Edges by the area of the faces beside them, and a power of the distance: with 1, it is the volume between
/// that counts, with a high one the largest distance. The smaller a tolerance is, the more it counts.
template <class Quality>
void bisect_far_edges(Fitting_state<Quality>& s, std::size_t number, double power)
{
  if(number == 0)
    return;
  if(s.mode.is_without_attraction)
    s.attraction.measure();
  const auto far_edges = s.attraction.far_edges();
  bisect_edges(s, number, [&](Vertex_index a, Vertex_index b, const Edge_apexes& apexes, Stratum stratum) {
    const auto far = far_edges.find(std::minmax(a, b));
    const double distance = (std::max)(norm(way_to_surface(s, a, b, stratum)),
                                       far == far_edges.end() ? 0. : far->second);
    return std::pow(distance, power) * s.tolerances.weight(s.first_subdomain(stratum))
           * doubled_area_beside(s.mesh.points, a, b, apexes);
  });
}

/// Edges at small subdomains, then in the region the longest ones, then those that are far from the surface.
template <class Quality>
void bisect_boundary(Fitting_state<Quality>& s)
{
  // Of edges in the region. With a half, errors of a bump are larger by 4 %, with all, as there may be with
  // few vertices, distances are larger by a tenth.
  constexpr double share_in_region = 2. / 3;
  // With 2, largest distances of 30 brains of 660 to 4,000 vertices are larger by a twentieth.
  constexpr double power = 4;
  const std::size_t all = s.criteria.number_of_bisections(),
                    early = all - std::size_t(s.effort.share_of_late_bisections * double(all));
  bisect_subdomains(s, all);
  const auto rest = [&] { return early - (std::min)(early, s.result.number_of_bisections); };
  if(s.features)
    bisect_sharp_edges(s, rest());
  bisect_edges(s, std::size_t(share_in_region * double(rest())),
               [&](Vertex_index a, Vertex_index b, const Edge_apexes&, Stratum) {
                 return s.mesh.is_edge_in_region(a, b) ? norm(s.mesh.points[a] - s.mesh.points[b]) : 0;
               });
  bisect_far_edges(s, rest(), power);
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_BISECT_BOUNDARY_H
