// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_FIT_CRITERIA_3_H
#define CGAL_MIXED_MESH_FIT_CRITERIA_3_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/assertions.h>

#include <limits>

namespace CGAL {

/*!
\ingroup PkgMixedMesh3Optimization

\brief Criteria for fitting a mixed mesh to a surface. Each setter returns the object, so that calls can be
chained.
*/
class Mixed_mesh_fit_criteria_3
{
public:
  /// Value for the default, where the default depends on the mesh.
  static constexpr int automatic = -1;
  /// Value of `number_of_layers()` for which all vertices move.
  static constexpr int all_layers = std::numeric_limits<int>::max();

  /// Sets the number of steps in which the boundary goes to the surface, the paper's MAX_STEP; steps that
  /// fail are halved. Default: 4. \pre at least 1
  Mixed_mesh_fit_criteria_3& number_of_steps(int steps)
  {
    CGAL_precondition(steps > 0);
    m_number_of_steps = steps;
    return *this;
  }
  /// The value set, or the default.
  int number_of_steps() const { return m_number_of_steps; }

  /// Sets Poisson's ratio of the elastic medium, without unit: the larger, the better volumes are kept; the
  /// smaller, the more an element gives way. Default: 0.3, as in the paper.
  /// \pre at least 0, below 0.5
  Mixed_mesh_fit_criteria_3& poisson_ratio(double ratio)
  {
    CGAL_precondition(ratio >= 0 && ratio < 0.5);
    m_poisson_ratio = ratio;
    return *this;
  }
  /// The value set, or the default.
  double poisson_ratio() const { return m_poisson_ratio; }

  /// Sets the factor by which an element of bad quality is stiffened before its step is repeated, without
  /// unit. Default: 2, as in the paper. \pre greater than 1
  Mixed_mesh_fit_criteria_3& stiffness_factor(double factor)
  {
    CGAL_precondition(factor > 1);
    m_stiffness_factor = factor;
    return *this;
  }
  /// The value set, or the default.
  double stiffness_factor() const { return m_stiffness_factor; }

  /// Sets the largest stiffness of an element, the paper's Y_MAX, as a multiple of its stiffness at the
  /// start, without unit: with 1, no element is stiffened. Default: 256. \pre at least 1
  Mixed_mesh_fit_criteria_3& maximal_stiffness(double stiffness)
  {
    CGAL_precondition(stiffness >= 1);
    m_maximal_stiffness = stiffness;
    return *this;
  }
  /// The value set, or the default.
  double maximal_stiffness() const { return m_maximal_stiffness; }

  /// Sets the aspect-ratio coefficient up to which an element is of acceptable quality, without unit.
  /// Default: 7, as in the paper. \pre at least 1
  Mixed_mesh_fit_criteria_3& acceptable_aspect_ratio(double coefficient)
  {
    CGAL_precondition(coefficient >= 1);
    m_acceptable_aspect_ratio = coefficient;
    return *this;
  }
  /// The value set, or the default.
  double acceptable_aspect_ratio() const { return m_acceptable_aspect_ratio; }

  /// Sets the number of layers of elements from the boundary within which vertices move; 0 moves boundary
  /// vertices only. Default: all layers of a mesh of up to 3,000 vertices, 4 layers of a larger one.
  /// \pre `automatic`, or at least 0
  Mixed_mesh_fit_criteria_3& number_of_layers(int layers)
  {
    CGAL_precondition(layers == automatic || layers >= 0);
    m_number_of_layers = layers;
    return *this;
  }
  /// The value set, or the default.
  int number_of_layers() const { return m_number_of_layers; }

private:
  int m_number_of_steps = 4;
  double m_poisson_ratio = 0.3;
  double m_stiffness_factor = 2;
  double m_maximal_stiffness = 256;
  double m_acceptable_aspect_ratio = 7;
  int m_number_of_layers = automatic;
};

} // namespace CGAL

#endif // CGAL_MIXED_MESH_FIT_CRITERIA_3_H
