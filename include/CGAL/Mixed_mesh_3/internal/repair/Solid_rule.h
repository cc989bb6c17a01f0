// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_REPAIR_SOLID_RULE_H
#define CGAL_MIXED_MESH_3_INTERNAL_REPAIR_SOLID_RULE_H

#include <CGAL/license/Mixed_mesh_3.h>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The rule by which a place is solid.
enum class Solid_rule {
  WINDING, ///< triangles are oriented: they wind around the place more often outwards than inwards
  PARITY,  ///< a ray from the place crosses an odd number of triangles: for triangles that are not oriented
  ENCLOSED ///< no path leads out of the place: for edges of an odd number of triangles, as walls have
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_REPAIR_SOLID_RULE_H
