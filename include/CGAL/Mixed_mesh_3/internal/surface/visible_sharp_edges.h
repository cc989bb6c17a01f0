// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sharp edges of several surfaces and sheets, as far as they lie between subdomains.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_SURFACE_VISIBLE_SHARP_EDGES_H
#define CGAL_MIXED_MESH_3_INTERNAL_SURFACE_VISIBLE_SHARP_EDGES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_attributes.h>
#include <CGAL/Mixed_mesh_3/Surface_description.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Sharp edges of one surface, and for each the third corners of the two facets beside it.
struct Surface_edges
{
  Sharp_edges edges;
  std::vector<std::array<Vec3, 2>> apexes;
};

/*!
Collects the sharp edges of surfaces. Edges that several surfaces have are one edge. An edge is cut where it
crosses other surfaces, and a part is left out that other surfaces hide.

\tparam Subdomain_at function object, the subdomain of a point; 0 outside
*/
template <class Subdomain_at>
class Visible_sharp_edges
{
  using Subdomains = std::set<Subdomain_index>;

  const Subdomain_at& m_subdomain_at;
  Sharp_edges m_all;
  std::map<std::array<double, 3>, std::size_t> m_numbers; // of points
  std::map<std::array<std::size_t, 2>, Subdomains> m_edges;
  std::vector<std::pair<Vec3, Subdomains>> m_crossings;

public:
  explicit Visible_sharp_edges(const Subdomain_at& subdomain_at) : m_subdomain_at(subdomain_at) {}

  /// Adds the edges of a surface.
  /// \param shares_at_surfaces,shares_at_sheets shares of a segment at which it crosses other surfaces, and
  /// sheets
  template <class Shares_at_surfaces, class Shares_at_sheets>
  void add(const Surface_edges& surface, const Shares_at_surfaces& shares_at_surfaces,
           const Shares_at_sheets& shares_at_sheets)
  {
    m_all.diagonal = (std::max)(m_all.diagonal, surface.edges.diagonal);
    m_all.area += surface.edges.area;
    for(std::size_t e = 0; e < surface.edges.edges.size(); ++e) {
      const Vec3 &p = surface.edges.points[surface.edges.edges[e][0]],
                 &q = surface.edges.points[surface.edges.edges[e][1]];
      const std::vector<double> at_sheets = shares_at_sheets(p, q);
      for(double share : at_sheets)
        m_crossings.emplace_back(place(p, q, share), Subdomains{Sharp_edges::sheets});
      std::vector<double> cuts = shares_at_surfaces(p, q);
      cuts.insert(cuts.end(), at_sheets.begin(), at_sheets.end());
      cut(p, q, surface.apexes[e], std::move(cuts));
    }
  }

  Sharp_edges operator()() &&
  {
    for(const auto& [edge, subdomains] : m_edges) {
      m_all.edges.push_back(edge);
      m_all.subdomains.emplace_back(subdomains.begin(), subdomains.end());
    }
    std::map<std::size_t, Subdomains> crossings;
    for(const auto& [point, subdomains] : m_crossings)
      if(const auto found = m_numbers.find({point[0], point[1], point[2]}); found != m_numbers.end())
        crossings[found->second].insert(subdomains.begin(), subdomains.end());
    for(const auto& [point, subdomains] : crossings)
      m_all.crossings[point].assign(subdomains.begin(), subdomains.end());
    return std::move(m_all);
  }

private:
  // Cuts nearer to an end, in lengths of the edge, are at the end: crossings are computed in doubles,
  // whose rounding of 2^-53 counts a million times where edges are a millionth of the coordinates.
  static constexpr double at_end = 1e-9;

  static Vec3 place(const Vec3& p, const Vec3& q, double share)
  {
    return share < at_end ? p : share > 1 - at_end ? q : p + share * (q - p);
  }

  std::size_t number(const Vec3& p)
  {
    const auto [found, is_new] = m_numbers.try_emplace({p[0], p[1], p[2]}, m_all.points.size());
    if(is_new)
      m_all.points.push_back(p);
    return found->second;
  }

  void cut(const Vec3& p, const Vec3& q, const std::array<Vec3, 2>& apexes, std::vector<double> cuts)
  {
    cuts.insert(cuts.end(), {0, 1});
    std::sort(cuts.begin(), cuts.end());
    double first = 0;
    for(double last : cuts) {
      if(last - first < at_end || first > 1 - at_end)
        continue;
      const Vec3 a = place(p, q, first), b = place(p, q, last);
      const auto [around, is_visible] = subdomains_around(a, b, apexes);
      if(is_visible) {
        const auto [i, j] = std::minmax({number(a), number(b)});
        m_edges[{i, j}].insert(around.begin(), around.end());
      } else {
        m_crossings.emplace_back(a, around);
        m_crossings.emplace_back(b, around);
      }
      first = last;
    }
  }

  // The subdomains around the middle of an edge, and whether the edge is visible: not if both facets are
  // hidden, or if one is, and the interface goes on beyond the edge in the plane of the other.
  std::pair<Subdomains, bool> subdomains_around(const Vec3& a, const Vec3& b,
                                                const std::array<Vec3, 2>& apexes) const
  {
    // Distances from the edge, in its length or in the height of the facet, and from the facet: as small as
    // exact sides of rounded points allow, 10^8 roundings of a coordinate.
    constexpr double from_edge = 1e-5, from_facet = 1e-8;
    const Vec3 middle = 0.5 * (a + b), along = b - a;
    Subdomains all;
    int number_visible = 0;
    bool goes_on = false;
    for(const Vec3& apex : apexes) {
      const Vec3 to_apex = apex - a;
      const Vec3 height = to_apex - (dot(to_apex, along) / dot(along, along)) * along;
      const Vec3 normal = cross(along, height);
      const double least = (std::min)(norm(along), norm(height));
      const Vec3 in_facet = (from_edge * least / norm(height)) * height,
                 off = (from_facet * least / norm(normal)) * normal;
      const auto sides_at = [&](const Vec3& p) {
        const std::pair<Subdomain_index, Subdomain_index> sides(m_subdomain_at(p - off),
                                                                m_subdomain_at(p + off));
        all.insert({sides.first, sides.second});
        return sides;
      };
      const auto sides = sides_at(middle + in_facet), sides_beyond = sides_at(middle - in_facet);
      if(sides.first != sides.second) {
        ++number_visible;
        goes_on = sides == sides_beyond;
      }
    }
    return {std::move(all), number_visible == 2 || (number_visible == 1 && !goes_on)};
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_SURFACE_VISIBLE_SHARP_EDGES_H
