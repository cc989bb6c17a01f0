// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_OPTIMIZE_BOUNDED_IMPL_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_OPTIMIZE_BOUNDED_IMPL_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/compiled.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Bounded_optimization.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/optimize_bounded.h>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

CGAL_MIXED_MESH_3_INLINE Mixed_mesh_optimization_result_3 optimize_bounded(
  Core_mesh& mesh, const Any_surface& surface,
  const With_threads<Mixed_mesh_optimization_criteria_3>& criteria, const Aspect_ratio_quality_3& quality,
  const std::function<bool()>& go_on, const Fitting_estimate& estimate, Followed_features* followed)
{
  return optimize_bounded<Aspect_ratio_quality_3>(mesh, surface, criteria, quality, go_on, estimate,
                                                  followed);
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_OPTIMIZE_BOUNDED_IMPL_H
