// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A closed surface around arbitrary triangles.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_REPAIR_WRAP_H
#define CGAL_MIXED_MESH_3_INTERNAL_REPAIR_WRAP_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>

#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
Returns triangles that wrap the given triangles: closed, manifold, without self-intersections, oriented
outwards. Places that a ball of that diameter can not enter are solid.

\par Complexity
Complexity of `CGAL::alpha_wrap_3()`
*/
void wrap(double diameter, std::vector<Predicates_kernel::Point_3>& points,
          std::vector<std::array<std::size_t, 3>>& triangles);

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#ifndef CGAL_MIXED_MESH_3_COMPILED
#include <CGAL/Mixed_mesh_3/internal/repair/wrap_impl.h>
#endif

#endif // CGAL_MIXED_MESH_3_INTERNAL_REPAIR_WRAP_H
