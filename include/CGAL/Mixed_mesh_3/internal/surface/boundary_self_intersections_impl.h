// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_SURFACE_BOUNDARY_SELF_INTERSECTIONS_IMPL_H
#define CGAL_MIXED_MESH_3_INTERNAL_SURFACE_BOUNDARY_SELF_INTERSECTIONS_IMPL_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/compiled.h>
#include <CGAL/Mixed_mesh_3/internal/elements/is_polygon_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/surface/boundary_self_intersections.h>

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

CGAL_MIXED_MESH_3_INLINE std::size_t number_of_self_intersections(Triangle_soup soup)
{
  namespace PMP = Polygon_mesh_processing;
  using Surface = CGAL::Surface_mesh<Predicates_kernel::Point_3>;
  if(!is_polygon_mesh(soup.triangles, soup.points.size()))
    PMP::orient_polygon_soup(soup.points, soup.triangles); // duplicates vertices that are not manifold
  Surface surface;
  PMP::polygon_soup_to_polygon_mesh(soup.points, soup.triangles, surface);
  std::vector<std::pair<Surface::Face_index, Surface::Face_index>> pairs;
  PMP::self_intersections(surface, std::back_inserter(pairs));
  return pairs.size();
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_SURFACE_BOUNDARY_SELF_INTERSECTIONS_IMPL_H
