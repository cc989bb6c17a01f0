// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sharp edges of a surface as polylines between corners.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_SURFACE_SHARP_FEATURES_H
#define CGAL_MIXED_MESH_3_INTERNAL_SURFACE_SHARP_FEATURES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_attributes.h>
#include <CGAL/Mixed_mesh_3/Surface_description.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// A chain of sharp edges between two corners.
class Feature_polyline
{
  std::vector<Vec3> m_points;
  std::vector<double> m_lengths;                // arc lengths from the first point
  static constexpr std::size_t group = 16;      // the fewest balls and segments, together, of a chain of 256
  std::vector<std::pair<Vec3, double>> m_balls; // balls around groups of segments: center, radius

public:
  std::array<std::size_t, 2> corners; ///< corners at the ends; they differ

  struct Position
  {
    Vec3 point;
    double length; ///< arc length along the polyline
  };

  Feature_polyline(std::vector<Vec3> points, const std::array<std::size_t, 2>& ends)
    : m_points(std::move(points)), m_lengths(1, 0.), corners(ends)
  {
    for(std::size_t i = 1; i < m_points.size(); ++i)
      m_lengths.push_back(m_lengths.back() + norm(m_points[i] - m_points[i - 1]));
    for(std::size_t i = 0; i + 1 < m_points.size(); i += group) {
      const std::size_t last = (std::min)(i + group, m_points.size() - 1);
      const Vec3 center = 0.5 * (m_points[i] + m_points[last]);
      double radius = 0;
      for(std::size_t j = i; j <= last; ++j)
        radius = (std::max)(radius, norm(m_points[j] - center));
      m_balls.emplace_back(center, radius);
    }
  }

  double length() const { return m_lengths.back(); }

  Position closest(const Vec3& p) const
  {
    Position best{m_points[0], 0};
    double nearest = norm(p - m_points[0]);
    for(std::size_t g = 0; g < m_balls.size(); ++g) {
      if(norm(p - m_balls[g].first) > nearest + m_balls[g].second)
        continue;
      const std::size_t last = (std::min)((g + 1) * group, m_points.size() - 1);
      for(std::size_t i = g * group; i < last; ++i) {
        const Vec3 along = m_points[i + 1] - m_points[i];
        const double square = dot(along, along);
        const double share = square > 0 ? (std::min)((std::max)(dot(p - m_points[i], along) / square, 0.), 1.)
                                        : 0;
        const Vec3 q = share == 1 ? m_points[i + 1] : m_points[i] + share * along;
        const double d = norm(p - q);
        if(d < nearest) {
          nearest = d;
          best = {q, m_lengths[i] + share * (m_lengths[i + 1] - m_lengths[i])};
        }
      }
    }
    return best;
  }

  /// Arc lengths of the vertices where the direction changes by an angle whose cosine is less than given.
  std::vector<double> turns(double cosine) const
  {
    std::vector<double> lengths;
    for(std::size_t i = 1; i + 1 < m_points.size(); ++i) {
      const Vec3 a = m_points[i] - m_points[i - 1], b = m_points[i + 1] - m_points[i];
      if(dot(a, b) < cosine * norm(a) * norm(b))
        lengths.push_back(m_lengths[i]);
    }
    return lengths;
  }

  /// The points of the part between two arc lengths, of which the first one is less.
  std::vector<Vec3> part(double first, double last) const
  {
    std::vector<Vec3> points{at(first)};
    for(std::size_t i = 0; i < m_points.size(); ++i)
      if(m_lengths[i] > first && m_lengths[i] < last)
        points.push_back(m_points[i]);
    points.push_back(at(last));
    return points;
  }

  /// Whether the part between two arc lengths is near to an edge from a to b, compared with the length of the
  /// edge.
  bool is_near(const Vec3& a, double length_at_a, const Vec3& b, double length_at_b) const
  {
    constexpr int samples = 8;           // seven places, one of which is the middle, where an arc is farthest
    constexpr double near_enough = 0.04; // 20 edges for a circle
    const Vec3 along = b - a;
    const double square = dot(along, along);
    for(int i = 1; i < samples; ++i) {
      const Vec3 q = at(length_at_a + (length_at_b - length_at_a) * i / samples) - a;
      const double share = (std::min)((std::max)(dot(q, along) / square, 0.), 1.);
      const Vec3 off = q - share * along;
      if(!(dot(off, off) <= near_enough * near_enough * square))
        return false;
    }
    return true;
  }

  Vec3 at(double length) const
  {
    const auto after = std::upper_bound(m_lengths.begin(), m_lengths.end(), length);
    if(after == m_lengths.end())
      return m_points.back();
    const std::size_t i = std::size_t((std::max)(after - m_lengths.begin(), std::ptrdiff_t(1)));
    const double share = (length - m_lengths[i - 1]) / (m_lengths[i] - m_lengths[i - 1]);
    return m_points[i - 1] + share * (m_points[i] - m_points[i - 1]);
  }
};

/*!
Polylines end where other than two polylines meet, and where a polyline turns sharply. Closed polylines, and
polylines with both ends at one corner, are cut into three; places of cuts count as corners for users of the
polylines.

Some edges of nearly every surface of measured data are sharp, in furrows and where there is noise. Such edges
are no features of the body, and are recognized by their arrangement: connected edges that are shorter than
elements are left out; and there are no features at all if they are shorter than the surface is wide, too
dense for the elements to follow, or if many of them have a free end: edges of machine parts end where others
begin.
*/
class Sharp_features
{
public:
  using Subdomains = std::vector<Subdomain_index>; // ascending

  static constexpr double sharp_turn = 45; // degrees: half a right angle
  // Least length of connected polylines altogether, in sizes of elements.
  static constexpr double least_length = 2;
  // Least total length in diagonals of the surface; a brain has 0.3, a cube 7, machine parts 9 to 12.
  static constexpr double least_total = 1;
  // Largest share of the elements at the surface that would have a feature. Noise of 2 mm on a brain has 4 at
  // 2,000 vertices, machine parts up to 0.5.
  static constexpr double largest_density = 0.8;
  // Largest share of the length of polylines with a free end: noisy or coarse brains have 0.4 and more,
  // machine parts less than 0.1.
  static constexpr double largest_share_of_free = 0.25;

  Sharp_features() = default;

  /// \param size approximate size of elements: smaller features can not be followed
  Sharp_features(const Sharp_edges& sharp, double size) : m_sharp(&sharp), m_around(sharp.points.size())
  {
    for(std::size_t e = 0; e < sharp.edges.size(); ++e)
      for(std::size_t v : sharp.edges[e])
        m_around[v].push_back(e);
    leave_out_short_ones(least_length * size);
    trace();
    const double sum = length();
    if(sum < least_total * sharp.diagonal || (sharp.area > 0 && sum * size > largest_density * sharp.area)
       || m_length_of_free > largest_share_of_free * sum) {
      m_polylines.clear();
      m_corners.clear();
      m_is_real.clear();
    }
  }

  bool empty() const { return m_polylines.empty(); }
  const std::vector<Feature_polyline>& polylines() const { return m_polylines; }
  const std::vector<Vec3>& corners() const { return m_corners; }
  /// Whether a corner is a real one, and not a place where a polyline is cut.
  bool is_real_corner(std::size_t c) const { return m_is_real[c] != 0; }
  std::size_t number_of_real_corners() const
  {
    return m_is_real.size() - std::size_t(std::count(m_is_real.begin(), m_is_real.end(), 0));
  }

  /// The arc length of a point along a polyline that the point is on.
  /// \param number of the feature that the point belongs to: polylines are numbered first, then corners
  double arc_length(const Vec3& p, std::size_t number, const Feature_polyline& polyline) const
  {
    const std::size_t first_corner = m_polylines.size();
    return number < first_corner                          ? polyline.closest(p).length
           : number - first_corner == polyline.corners[0] ? 0
                                                          : polyline.length();
  }

  /// The subdomains around a feature, as `Sharp_edges` lists them.
  /// \param number of the feature: polylines are numbered first, then corners
  const Subdomains& subdomains(std::size_t number) const
  {
    const std::size_t first_corner = m_polylines.size();
    return number < first_corner ? m_at_polylines[number] : m_at_corners[number - first_corner];
  }

  double length() const
  {
    double sum = 0;
    for(const Feature_polyline& p : m_polylines)
      sum += p.length();
    return sum;
  }

private:
  const Sharp_edges* m_sharp = nullptr; // null once the polylines are made
  std::vector<std::vector<std::size_t>> m_around;
  std::vector<Feature_polyline> m_polylines;
  std::vector<Vec3> m_corners;
  std::vector<std::uint8_t> m_is_real;
  std::vector<Subdomains> m_at_polylines, m_at_corners; // subdomains around
  double m_length_of_free = 0;

  const Vec3& point(std::size_t v) const { return m_sharp->points[v]; }
  std::size_t other_end(std::size_t e, std::size_t v) const
  {
    return m_sharp->edges[e][0] == v ? m_sharp->edges[e][1] : m_sharp->edges[e][0];
  }

  Subdomains around_edge(std::size_t e) const
  {
    return m_sharp->subdomains.empty() ? Subdomains() : m_sharp->subdomains[e];
  }

  Subdomains around_corner(std::size_t v) const
  {
    std::set<Subdomain_index> all;
    for(std::size_t e : m_around[v])
      for(Subdomain_index i : around_edge(e))
        all.insert(i);
    if(const auto found = m_sharp->crossings.find(v); found != m_sharp->crossings.end())
      all.insert(found->second.begin(), found->second.end());
    return {all.begin(), all.end()};
  }

  bool is_corner(std::size_t v) const
  {
    if(m_around[v].size() != 2)
      return !m_around[v].empty();
    if(m_sharp->crossings.count(v) > 0 || around_edge(m_around[v][0]) != around_edge(m_around[v][1]))
      return true;
    const Vec3 a = point(v) - point(other_end(m_around[v][0], v)),
               b = point(other_end(m_around[v][1], v)) - point(v);
    return dot(a, b) < std::cos(sharp_turn * M_PI / 180) * norm(a) * norm(b);
  }

  void leave_out_short_ones(double least)
  {
    std::vector<std::uint8_t> is_seen(m_around.size(), 0);
    for(std::size_t start = 0; start < m_around.size(); ++start) {
      if(is_seen[start] || m_around[start].empty())
        continue;
      std::vector<std::size_t> component{start};
      is_seen[start] = 1;
      double twice_length = 0;
      for(std::size_t i = 0; i < component.size(); ++i)
        for(std::size_t e : m_around[component[i]]) {
          const std::size_t u = other_end(e, component[i]);
          twice_length += norm(point(u) - point(component[i]));
          if(!is_seen[u])
            component.push_back(u);
          is_seen[u] = 1;
        }
      if(twice_length < 2 * least)
        for(std::size_t v : component)
          m_around[v].clear();
    }
  }

  std::size_t add_corner(const Vec3& p, bool is_real, Subdomains around)
  {
    m_corners.push_back(p);
    m_is_real.push_back(is_real);
    m_at_corners.push_back(std::move(around));
    return m_corners.size() - 1;
  }

  void trace()
  {
    constexpr std::size_t none = std::size_t(-1);
    std::vector<std::size_t> corners(m_around.size(), none);
    for(std::size_t v = 0; v < m_around.size(); ++v)
      if(is_corner(v))
        corners[v] = add_corner(point(v), true, around_corner(v));
    std::vector<std::uint8_t> is_done(m_sharp->edges.size(), 0);
    const auto follow = [&](std::size_t v, std::size_t e) {
      std::vector<Vec3> points{point(v)};
      const std::size_t first = v;
      const Subdomains around = around_edge(e);
      do {
        is_done[e] = 1;
        v = other_end(e, v);
        points.push_back(point(v));
        if(corners[v] == none)
          e = m_around[v][m_around[v][0] == e ? 1 : 0];
      } while(corners[v] == none && v != first);
      add(std::move(points), corners[first], corners[v], around);
      m_at_polylines.resize(m_polylines.size(), around);
      if(m_around[first].size() == 1 || m_around[v].size() == 1)
        m_length_of_free += m_polylines.back().length();
    };
    for(std::size_t v = 0; v < m_around.size(); ++v)
      if(corners[v] != none)
        for(std::size_t e : m_around[v])
          if(!is_done[e])
            follow(v, e);
    for(std::size_t v = 0; v < m_around.size(); ++v)
      if(corners[v] == none && !m_around[v].empty() && !is_done[m_around[v][0]]) {
        corners[v] = add_corner(point(v), false, around_corner(v));
        follow(v, m_around[v][0]);
      }
    m_around.clear();
    m_sharp = nullptr;
  }

  void add(std::vector<Vec3> points, std::size_t first, std::size_t last, const Subdomains& around)
  {
    if(first != last) {
      m_polylines.emplace_back(std::move(points), std::array<std::size_t, 2>{first, last});
      return;
    }
    const Feature_polyline whole(points, {first, last});
    std::size_t begin = 0, begin_corner = first;
    double length = 0;
    for(std::size_t i = 1, cut = 1; i < points.size(); ++i) {
      length += norm(points[i] - points[i - 1]);
      const bool is_last = i + 1 == points.size();
      if(!is_last && (cut > 2 || length < (double(cut) / 3 - 1e-9) * whole.length()))
        continue;
      const std::size_t corner = is_last ? last : add_corner(points[i], false, around);
      m_polylines.emplace_back(std::vector<Vec3>(points.begin() + std::ptrdiff_t(begin),
                                                 points.begin() + std::ptrdiff_t(i) + 1),
                               std::array<std::size_t, 2>{begin_corner, corner});
      begin = i;
      begin_corner = corner;
      ++cut;
    }
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_SURFACE_SHARP_FEATURES_H
