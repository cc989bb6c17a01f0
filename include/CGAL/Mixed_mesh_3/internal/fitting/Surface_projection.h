// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_SURFACE_PROJECTION_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_SURFACE_PROJECTION_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Strata.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Working_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/Any_surface.h>
#include <CGAL/Mixed_mesh_3/internal/surface/Sharp_features.h>

#include <algorithm>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Points of the surfaces of a domain near given points: the closest ones, if a stratum is on one interface.
/// Several threads may project at once where `is_concurrent()`.
class Surface_projection
{
  using Point_3 = Any_surface::Point_3;

  const Any_surface* m_domain;
  const Strata* m_strata;
  const Sharp_features* m_features = nullptr;
  int m_maximal_number_of_cycles = 20;
  // The last point found on each interface, by its subdomains: a query is mostly near to the one before. For
  // several subdomains only.
  mutable std::map<std::pair<Subdomain_index, Subdomain_index>, Vec3> m_last;

  static constexpr double accuracy = 1e-9; // in diagonals: of a head of 200 mm, 0.2 nm
  // The search ends soon where surfaces do not meet: there, a cycle leaves all of the distance; where they
  // meet nearly none, and at angles of less than 13 degrees, without extrapolation, 0.95 of it.
  static constexpr double least_progress = 0.7;

  static Point_3 point(const Vec3& p) { return Point_3(p[0], p[1], p[2]); }

public:
  /// \param strata strata, to be kept by the caller
  Surface_projection(const Any_surface& domain, const Strata& strata) : m_domain(&domain), m_strata(&strata)
  {
  }

  /// Sets the features: strata from `first_sharp_stratum` on are on their polylines, or at their corners,
  /// then. The caller has to keep the features.
  void set_features(const Sharp_features& features) { m_features = &features; }

  /// Limits projections to one cycle where several interfaces meet: the point found is then near the place
  /// where the interfaces meet, rather than there. For estimates.
  void set_approximate() { m_maximal_number_of_cycles = 1; }

  Vec3 operator()(const Vec3& p, Stratum stratum) const
  {
    if(stratum >= first_sharp_stratum)
      return on_feature(p, stratum);
    if(!m_domain->is_labeled())
      return to_vec3(m_domain->closest_point(point(p)));
    const std::vector<Interface>& interfaces = m_strata->interfaces(stratum);
    return interfaces.size() == 1 ? closest(p, interfaces[0]) : junction(p, interfaces);
  }

  /// Projects a point; faster if `hint`, a point of the same stratum, is near.
  Vec3 operator()(const Vec3& p, const Vec3& hint, Stratum stratum) const
  {
    if(stratum >= first_sharp_stratum)
      return on_feature(p, stratum);
    if(!m_domain->is_labeled())
      return to_vec3(m_domain->closest_point(point(p), point(hint)));
    const std::vector<Interface>& interfaces = m_strata->interfaces(stratum);
    return interfaces.size() == 1 ? closest(p, hint, interfaces[0]) : junction(p, interfaces);
  }

  /// The positions of a mesh, with boundary vertices where they should be: on their surfaces. Vertices that
  /// are there already keep their positions.
  std::vector<Vec3> places(const Working_mesh& mesh) const
  {
    std::vector<Vec3> result = mesh.points;
    const double on_surface = accuracy * diagonal();
    for(Vertex_index v = 0; v < result.size(); ++v)
      if(mesh.is_on_boundary(v)) {
        const Vec3 q = (*this)(mesh.points[v], mesh.strata[v]);
        if(norm(q - mesh.points[v]) > on_surface)
          result[v] = q;
      }
    return result;
  }

  /// Whether a vertex of a stratum is where it should be.
  bool is_there(const Vec3& p, Stratum stratum) const
  {
    return norm((*this)(p, stratum) - p) <= accuracy * diagonal();
  }

  /// Whether several threads may ask for points of that stratum at the same time.
  bool is_concurrent(Stratum stratum) const
  {
    return stratum >= first_sharp_stratum || m_strata->interfaces(stratum).size() < 2;
  }

  /// Whether a projected point is on all interfaces: where several interfaces meet, the point need not be.
  bool is_reached(const Vec3& p, Stratum stratum) const
  {
    if(stratum >= first_sharp_stratum || !m_domain->is_labeled())
      return true;
    const std::vector<Interface>& interfaces = m_strata->interfaces(stratum);
    return interfaces.size() == 1
           || std::all_of(interfaces.begin(), interfaces.end(), [&](const Interface& i) {
                return norm(closest(p, i) - p) <= accuracy * diagonal();
              });
  }

private:
  double diagonal() const
  {
    const Bbox_3 box = m_domain->bbox();
    return norm({box.x_span(), box.y_span(), box.z_span()});
  }

  Vec3 on_feature(const Vec3& p, Stratum stratum) const
  {
    const std::size_t i = stratum - first_sharp_stratum, n = m_features->polylines().size();
    return i < n ? m_features->polylines()[i].closest(p).point : m_features->corners()[i - n];
  }

  Vec3 closest(const Vec3& p, const Interface& i) const
  {
    if(i.is_sheet())
      return closest_of_sheets([&](const Any_sheet& sheet) { return sheet.closest_point(point(p)); }, p);
    if(m_domain->subdomain_indices().size() == 1)
      return to_vec3(m_domain->closest_point(point(p), i.first, i.second));
    const auto [last, is_first] = m_last.try_emplace({i.first, i.second});
    last->second = to_vec3(is_first
                             ? m_domain->closest_point(point(p), i.first, i.second)
                             : m_domain->closest_point(point(p), point(last->second), i.first, i.second));
    return last->second;
  }

  Vec3 closest(const Vec3& p, const Vec3& hint, const Interface& i) const
  {
    if(i.is_sheet()) // the hint is on one of the sheets only
      return m_domain->sheets().size() > 1
               ? closest(p, i)
               : to_vec3(m_domain->sheets().front()->closest_point(point(p), point(hint)));
    return to_vec3(m_domain->closest_point(point(p), point(hint), i.first, i.second));
  }

  template <class Closest>
  Vec3 closest_of_sheets(const Closest& closest_of_one, const Vec3& p) const
  {
    Vec3 nearest = to_vec3(closest_of_one(*m_domain->sheets().front()));
    for(const auto& sheet : m_domain->sheets()) {
      const Vec3 q = to_vec3(closest_of_one(*sheet));
      if(norm(q - p) < norm(nearest - p))
        nearest = q;
    }
    return nearest;
  }

  // Common point of several surfaces, by alternating projections. Between two planes each cycle is shorter
  // than the one before by the square of the cosine of their angle, so that one cycle tells the limit. If
  // surfaces do not meet nearby, the result is the mean of the closest points on each surface.
  Vec3 junction(const Vec3& start, const std::vector<Interface>& interfaces) const
  {
    Vec3 p = closest(start, interfaces[0]);
    double last = std::numeric_limits<double>::infinity();
    for(int cycle = 0; cycle < m_maximal_number_of_cycles; ++cycle) {
      Vec3 q = p;
      for(auto i = interfaces.begin() + 1; i != interfaces.end(); ++i)
        q = closest(q, *i);
      const double there = norm(q - p);
      if(there <= 0.1 * accuracy * diagonal())
        return p;
      if(there > least_progress * last)
        break;
      last = there;
      const Vec3 back = closest(q, interfaces[0]);
      const double ratio = norm(back - q) / there, share = 1 - ratio * ratio;
      // The extrapolation is for steep angles only: it would lead far away where surfaces touch.
      p = closest(share > 0.05 ? p + (1 / share) * (back - p) : back, interfaces[0]);
    }
    if(m_maximal_number_of_cycles == 1)
      return p;
    Vec3 sum{};
    for(const Interface& i : interfaces)
      sum = sum + closest(start, i);
    return (1. / double(interfaces.size())) * sum;
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_SURFACE_PROJECTION_H
