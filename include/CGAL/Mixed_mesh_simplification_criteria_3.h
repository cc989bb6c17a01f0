// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_SIMPLIFICATION_CRITERIA_3_H
#define CGAL_MIXED_MESH_SIMPLIFICATION_CRITERIA_3_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_optimization_criteria_3.h>

#include <CGAL/assertions.h>

#include <cstddef>
#include <limits>

namespace CGAL {

/*!
\ingroup PkgMixedMesh3Optimization

\brief Criteria for simplifying a mixed mesh: the number of vertices, and the limits that no collapse exceeds.
Each setter returns the object, so that calls can be chained.
*/
class Mixed_mesh_simplification_criteria_3
{
public:
  /// Constructs criteria with the default limits; a number converts to them.
  /// \param number_of_vertices number at which the simplification ends. 0: it ends when each further collapse
  /// would exceed a limit, so that the mesh has as few vertices as the limits allow
  Mixed_mesh_simplification_criteria_3(std::size_t number_of_vertices)
    : m_number_of_vertices(number_of_vertices)
  {
  }

  /// The number of vertices at which the simplification ends.
  std::size_t number_of_vertices() const { return m_number_of_vertices; }

  /// Sets the distance, in the mesh's unit, from the boundary within which each place stays that a vertex of
  /// the boundary has left; the same for interfaces of subdomains. Vertices that stay have a distance of 0.
  /// Default: infinity, no limit. \pre at least 0
  Mixed_mesh_simplification_criteria_3& distance(double largest)
  {
    CGAL_precondition(largest >= 0);
    m_distance = largest;
    return *this;
  }
  /// The value set, or the default.
  double distance() const { return m_distance; }

  /// Sets the largest cost of new elements. Elements that cost more at the start lose vertices before others;
  /// what takes their places is not worse. 0, or infinity: no bound. Default: 3.2, as for the optimization.
  /// \pre 0, or at least 1
  Mixed_mesh_simplification_criteria_3& quality_bound(double cost)
  {
    CGAL_precondition(cost == 0 || cost >= 1);
    m_quality_bound = cost == 0 ? std::numeric_limits<double>::infinity() : cost;
    return *this;
  }
  /// The value set, or the default; infinity if there is no bound.
  double quality_bound() const { return m_quality_bound; }

  /// Sets the angle between the normals of two facets, in degrees, from which on their edge is sharp:
  /// vertices of the mesh on sharp edges go along these, and those at their corners stay. 0: no edge is
  /// sharp. Default: 50, as for the optimization. \pre in [0, 180]
  Mixed_mesh_simplification_criteria_3& sharp_angle(double degrees)
  {
    CGAL_precondition(degrees >= 0 && degrees <= 180);
    m_sharp_angle = degrees;
    return *this;
  }
  /// The value set, or the default.
  double sharp_angle() const { return m_sharp_angle; }

  /// Sets the distance r over which the mesh gets coarser around the elements in the region
  /// (`Element_attributes::is_in_region`): at a distance d from these, edges are longer by a factor of some
  /// (1 + d / r)^1.2. Vertices in the region, and within a fifth of r, stay, unless they are off the surface
  /// or have an element above the quality bound. 0: elements in the region are as others. Default: 0.
  /// \pre at least 0
  Mixed_mesh_simplification_criteria_3& region_radius(double r)
  {
    CGAL_precondition(r >= 0);
    m_region_radius = r;
    return *this;
  }
  /// The value set, or the default.
  double region_radius() const { return m_region_radius; }

private:
  std::size_t m_number_of_vertices;
  double m_distance = std::numeric_limits<double>::infinity();
  double m_quality_bound = Mixed_mesh_optimization_criteria_3::default_quality_bound;
  double m_sharp_angle = Mixed_mesh_optimization_criteria_3::default_sharp_angle;
  double m_region_radius = 0;
};

} // namespace CGAL

#endif // CGAL_MIXED_MESH_SIMPLIFICATION_CRITERIA_3_H
