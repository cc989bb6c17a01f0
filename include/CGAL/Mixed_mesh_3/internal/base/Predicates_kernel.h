// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_BASE_PREDICATES_KERNEL_H
#define CGAL_MIXED_MESH_3_INTERNAL_BASE_PREDICATES_KERNEL_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace CGAL {
namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMesh3Domains
/// The kernel that decides geometry: exact predicates on doubles, whatever kernel the user has. Domains and
/// regions are asked about points of this kernel. The headers of domains and regions include the header of
/// the kernel.
using Predicates_kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_BASE_PREDICATES_KERNEL_H
