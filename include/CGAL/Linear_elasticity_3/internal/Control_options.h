// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_LINEAR_ELASTICITY_3_INTERNAL_CONTROL_OPTIONS_H
#define CGAL_LINEAR_ELASTICITY_3_INTERNAL_CONTROL_OPTIONS_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <CGAL/Mixed_mesh_3/Index.h>

#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The weights of the nodes whose weighted sum of displacements is that of a control point: the weights of
/// vertices, which are first, add up to 1.
using Control_weights = std::vector<std::pair<Vertex_index, double>>;

/// The options of control points; see `Linear_elasticity_3::set_control_points()`.
struct Control_options
{
  double largest_distance = 0, compliance = 0, radius = 0;
  std::vector<double> weights; // weights of the points; empty: 1
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_INTERNAL_CONTROL_OPTIONS_H
