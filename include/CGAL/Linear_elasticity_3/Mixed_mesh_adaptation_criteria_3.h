// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_LINEAR_ELASTICITY_3_MIXED_MESH_ADAPTATION_CRITERIA_3_H
#define CGAL_LINEAR_ELASTICITY_3_MIXED_MESH_ADAPTATION_CRITERIA_3_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <CGAL/Mixed_mesh_3/Index.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <CGAL/assertions.h>

#include <limits>
#include <map>

namespace CGAL {

namespace Mixed_meshes_3 {

/// \ingroup PkgLinearElasticity3Ref
/// A load case of `adapt_mixed_mesh_3()`: the displacements of some vertices, in mm. The other vertices are
/// free.
using Prescribed_displacements = std::map<Vertex_index, Vec3>;

} // namespace Mixed_meshes_3

/*!
\ingroup PkgLinearElasticity3Ref

\brief Criteria for adapting a mesh to load cases. Each setter returns the object, so that calls can be
chained.
*/
class Mixed_mesh_adaptation_criteria_3
{
  double m_quality_bound = 3.2, m_least_gain = 0.01, m_guard_weight = 0.3;
  int m_maximal_number_of_solves = 20;

public:
  /// Sets the largest aspect-ratio coefficient (ARC) that an element may get; the ARC of an element above the
  /// bound does not grow above its initial value. 0, or infinity: no bound. Default: 3.2, as in the
  /// optimization of the mesher. \pre 0, or at least 1
  Mixed_mesh_adaptation_criteria_3& quality_bound(double bound)
  {
    CGAL_precondition(bound == 0 || bound >= 1);
    m_quality_bound = bound == 0 ? std::numeric_limits<double>::infinity() : bound;
    return *this;
  }
  /// The value set, or the default; infinity if there is no bound.
  double quality_bound() const { return m_quality_bound; }

  /// Sets the least gain. The adaptation ends after three steps in a row each of which gains less than this
  /// share of the gain of all steps. Default: 0.01. \pre in [0, 1]
  Mixed_mesh_adaptation_criteria_3& least_gain(double share)
  {
    CGAL_precondition(share >= 0 && share <= 1);
    m_least_gain = share;
    return *this;
  }
  /// The value set, or the default.
  double least_gain() const { return m_least_gain; }

  /// Sets the weight of the guard loads in the functional, where the load cases have the weight 1; see
  /// `adapt_mixed_mesh_3()`. 0: no guard loads. Default: 0.3; with 1, errors of smooth loads were larger in
  /// meshes of 660 vertices, with 0.1, those of standard elements were. \pre finite, and at least 0
  Mixed_mesh_adaptation_criteria_3& guard_weight(double weight)
  {
    CGAL_precondition(weight >= 0 && weight < std::numeric_limits<double>::infinity());
    m_guard_weight = weight;
    return *this;
  }
  /// The value set, or the default.
  double guard_weight() const { return m_guard_weight; }

  /// Sets how often the load cases are solved at most, the first time on the initial mesh. Default: 20.
  /// \pre at least 1
  Mixed_mesh_adaptation_criteria_3& maximal_number_of_solves(int number)
  {
    CGAL_precondition(number >= 1);
    m_maximal_number_of_solves = number;
    return *this;
  }
  /// The value set, or the default.
  int maximal_number_of_solves() const { return m_maximal_number_of_solves; }
};

} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_MIXED_MESH_ADAPTATION_CRITERIA_3_H
