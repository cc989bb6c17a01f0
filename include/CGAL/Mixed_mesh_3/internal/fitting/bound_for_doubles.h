// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_BOUND_FOR_DOUBLES_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_BOUND_FOR_DOUBLES_H

#include <CGAL/license/Mixed_mesh_3.h>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// A quality bound, slightly reduced: a cost within the reduced bound in doubles is within the bound exactly.
/// The relative error of the cost of an element near to the default bound is some 1e-13.
inline double bound_for_doubles(double quality_bound) { return (1 - 1e-10) * quality_bound; }

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_BOUND_FOR_DOUBLES_H
