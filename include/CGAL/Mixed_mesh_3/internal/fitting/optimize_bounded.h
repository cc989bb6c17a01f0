// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The optimization as a function that is compiled once.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_OPTIMIZE_BOUNDED_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_OPTIMIZE_BOUNDED_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Aspect_ratio_quality_3.h>
#include <CGAL/Mixed_mesh_3/internal/base/Concurrency.h>
#include <CGAL/Mixed_mesh_3/internal/base/Core_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Followed_features.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Optimization_effort.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/Any_surface.h>
#include <CGAL/Mixed_mesh_optimization_criteria_3.h>
#include <CGAL/Mixed_mesh_optimization_result_3.h>

#include <functional>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Runs `Bounded_optimization`; the cost of an element is its aspect-ratio coefficient.
/// \param go_on function that is asked before each round
/// \param estimate what suffices, if not all of the boundary needs to arrive
/// \param followed sharp features, with the vertices that follow them if they are chosen already; those of
/// the result in the end
Mixed_mesh_optimization_result_3
optimize_bounded(Core_mesh& mesh, const Any_surface& surface,
                 const With_threads<Mixed_mesh_optimization_criteria_3>& criteria,
                 const Aspect_ratio_quality_3& quality, const std::function<bool()>& go_on,
                 const Fitting_estimate& estimate = {}, Followed_features* followed = nullptr);

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#ifndef CGAL_MIXED_MESH_3_COMPILED
#include <CGAL/Mixed_mesh_3/internal/fitting/optimize_bounded_impl.h>
#endif

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_OPTIMIZE_BOUNDED_H
