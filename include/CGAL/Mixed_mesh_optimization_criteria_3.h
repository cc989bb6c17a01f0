// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_OPTIMIZATION_CRITERIA_3_H
#define CGAL_MIXED_MESH_OPTIMIZATION_CRITERIA_3_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/assertions.h>

#include <cstddef>
#include <limits>

namespace CGAL {

/*!
\ingroup PkgMixedMesh3Optimization

\brief Criteria for optimizing a mixed mesh. Each setter returns the object, so that calls can be chained.
*/
class Mixed_mesh_optimization_criteria_3
{
public:
  /// The least aspect-ratio coefficient, rounded up, that no mesh of cubic cells exceeds before its boundary
  /// is fitted: 3.1918.
  static constexpr double default_quality_bound = 3.2;

  /// The default sharp angle: less than the 60 degrees of a hexagonal prism, more than most smooth surfaces
  /// of few facets have.
  static constexpr double default_sharp_angle = 50;

  /// Sets the largest distance between boundary and surface, either way, in the mesh's unit: boundary
  /// vertices slide toward places that are farther. 0: vertices have to be on the surface, without further
  /// conditions. Default: 0. \pre at least 0
  Mixed_mesh_optimization_criteria_3& tolerance(double distance)
  {
    CGAL_precondition(distance >= 0);
    m_tolerance = distance;
    return *this;
  }
  /// The value set, or the default.
  double tolerance() const { return m_tolerance; }

  /// Sets the number of rounds of moves and flips. Default: 4, or 12 with a tolerance, whatever the number of
  /// vertices: with 3 instead of 12, a brain of 22,000 vertices is half as far again from its surface, and a
  /// ninth faster.
  /// \pre at least 1
  Mixed_mesh_optimization_criteria_3& number_of_rounds(int rounds)
  {
    CGAL_precondition(rounds > 0);
    m_number_of_rounds = rounds;
    return *this;
  }
  /// The value set, or the default.
  int number_of_rounds() const
  {
    return m_number_of_rounds > 0 ? m_number_of_rounds : m_tolerance > 0 ? 12 : 4;
  }

  /// Sets the cost of an element above which boundary vertices slide on the surface: free sliding would lose
  /// volume. Default: 2.25. \pre at least 1
  Mixed_mesh_optimization_criteria_3& sliding_threshold(double cost)
  {
    CGAL_precondition(cost >= 1);
    m_sliding_threshold = cost;
    return *this;
  }
  /// The value set, or the default.
  double sliding_threshold() const { return m_sliding_threshold; }

  /// Sets whether tetrahedra may be flipped, and boundary vertices that can not arrive be merged or removed;
  /// else the elements stay the same. Default: yes.
  Mixed_mesh_optimization_criteria_3& flips(bool allowed)
  {
    m_flips = allowed;
    return *this;
  }
  /// The value set, or the default.
  bool flips() const { return m_flips; }

  /// Sets the number of edges of the boundary that may be bisected, each for one more vertex on the surface.
  /// Nearly half of them are edges of elements in the region of interest (`Element_attributes`), the longest
  /// first; the other edges are where boundary and surface are far from each other. No new tetrahedron costs
  /// more than 3.2, or than the quality bound. Default: 0.
  Mixed_mesh_optimization_criteria_3& number_of_bisections(std::size_t number)
  {
    m_number_of_bisections = number;
    return *this;
  }
  /// The value set, or the default.
  std::size_t number_of_bisections() const { return m_number_of_bisections; }

  /// Sets the largest cost that an element may get. Where elements cost more already, none gets worse than
  /// the worst of the elements that are changed with it; so if no element costs more than the bound, none
  /// ever will. Boundary vertices that would need worse elements do not arrive on the surface. By default,
  /// costs are aspect-ratio coefficients, or above them. 0, or infinity: no bound; elements may get worse the
  /// longer a vertex does not arrive. Default: 3.2.
  /// \pre 0, or at least 1
  Mixed_mesh_optimization_criteria_3& quality_bound(double cost)
  {
    CGAL_precondition(cost == 0 || cost >= 1);
    m_quality_bound = cost == 0 ? std::numeric_limits<double>::infinity() : cost;
    return *this;
  }
  /// The value set, or the default; infinity if there is no bound.
  double quality_bound() const { return m_quality_bound; }

  /// Sets the angle between the normals of two facets, in degrees, from which on their edge is sharp: paths
  /// of edges of the boundary, and vertices at the corners, are brought to sharp edges and stay there. 0: no
  /// edge is sharp. Default: 50. \pre in [0, 180]
  Mixed_mesh_optimization_criteria_3& sharp_angle(double degrees)
  {
    CGAL_precondition(degrees >= 0 && degrees <= 180);
    m_sharp_angle = degrees;
    return *this;
  }
  /// The value set, or the default.
  double sharp_angle() const { return m_sharp_angle; }

private:
  std::size_t m_number_of_bisections = 0;
  double m_sharp_angle = default_sharp_angle;
  double m_tolerance = 0;
  int m_number_of_rounds = 0;
  double m_sliding_threshold = 2.25;
  double m_quality_bound = default_quality_bound;
  bool m_flips = true;
};

} // namespace CGAL

#endif // CGAL_MIXED_MESH_OPTIMIZATION_CRITERIA_3_H
