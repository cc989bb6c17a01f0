// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Parts of the domain that a fitted mesh has lost: cells without elements, unless the boundary is near.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_UNREACHED_CELLS_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_UNREACHED_CELLS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Core_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Located_octree.h>
#include <CGAL/Mixed_mesh_3/internal/octree/Octree.h>
#include <CGAL/Mixed_mesh_3/internal/surface/hausdorff_distance.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The leaves of `lost` with a part of the surface that is farther from the boundary of the mesh than `size`,
/// and than the width of the leaf: a tip on which a vertex has arrived is not lost, though the octree has
/// small cells there. The tested points are the points of the surface nearest to corners and center. Each
/// point takes one query to the domain, and one to a tree of the faces of the boundary.
/// \param size size below which parts do not count as missing
inline std::vector<Octree::Node_index> unreached_cells(const Located_octree& octree,
                                                       const std::vector<Octree::Node_index>& lost,
                                                       const Core_mesh& mesh, double size)
{
  using Point_3 = Predicates_kernel::Point_3;
  if(lost.empty() || mesh.number_of_elements() == 0)
    return lost;
  const Nearest_triangle boundary(boundary_triangles(mesh));

  std::vector<Octree::Node_index> unreached;
  for(Octree::Node_index n : lost) {
    const Bbox_3 box = octree.domain().cell_box(octree.octree().corner(n), octree.octree().side(n));
    const double far = (std::max)({box.x_span(), box.y_span(), box.z_span(), size});
    const auto is_unreached = [&](const Point_3& p) {
      const Point_3 q = octree.domain().closest_point(p, octree.surface_part(n));
      return CGAL::do_overlap(q.bbox(), box) && boundary(q).distance > far;
    };
    bool is_any = is_unreached(CGAL::midpoint(Point_3(box.xmin(), box.ymin(), box.zmin()),
                                              Point_3(box.xmax(), box.ymax(), box.zmax())));
    for(int i = 0; i < 8; ++i)
      is_any = is_any
               || is_unreached(Point_3((i & 1) != 0 ? box.xmax() : box.xmin(),
                                       (i & 2) != 0 ? box.ymax() : box.ymin(),
                                       (i & 4) != 0 ? box.zmax() : box.zmin()));
    if(is_any)
      unreached.push_back(n);
  }
  return unreached;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_UNREACHED_CELLS_H
