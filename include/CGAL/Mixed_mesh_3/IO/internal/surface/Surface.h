// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_SURFACE_H
#define CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_SURFACE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>

#include <CGAL/Surface_mesh.h>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {
namespace internal {

/// The surface that is read: predicates on it are exact.
using Surface = CGAL::Surface_mesh<Predicates_kernel::Point_3>;

} // namespace internal
} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_INTERNAL_SURFACE_SURFACE_H
