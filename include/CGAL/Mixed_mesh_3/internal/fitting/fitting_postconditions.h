// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Postconditions of the optimization, of the simplification and of Algorithm 1, for assertions.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_FITTING_POSTCONDITIONS_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_FITTING_POSTCONDITIONS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/Core_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/fitting/Surface_projection.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Strata.h>
#include <CGAL/Mixed_mesh_3/internal/moves/Working_mesh.h>
#include <CGAL/Mixed_mesh_3/mesh_defects.h>
#include <CGAL/Mixed_mesh_fit_result_3.h>
#include <CGAL/Mixed_mesh_optimization_result_3.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Whether a mesh has no kind of defect that its start did not have, and all elements are positive: a start
/// from a file may be nonconforming, or have unused vertices, but a stage adds no such defect. The number of
/// defects of one kind may grow, as bisected edges that are no manifold become two.
inline bool has_no_new_defects(const Mesh_defects& start, const Core_mesh& mesh)
{
  const Mesh_defects end = find_defects(mesh);
  return end.positive() && (end.conforming() || !start.conforming())
         && (end.closed_manifold_boundary() || !start.closed_manifold_boundary())
         && (end.unused_vertices == 0 || start.unused_vertices > 0);
}

/// Whether each vertex has the stratum of the interfaces that its faces are on, or is on sharp edges. The
/// faces are those of the changed mesh, as the working mesh looks for faces only where strata say so.
inline bool are_strata_of_faces(const Working_mesh& mesh, const Core_mesh& changed, Strata& strata)
{
  const std::vector<Stratum> expected = strata.of_vertices(changed.number_of_vertices(),
                                                           strata.sorted_faces(changed));
  std::vector<std::uint8_t> is_merged(mesh.points.size(), 0);
  for(Vertex_index v : mesh.merged)
    is_merged[v] = 1;
  std::vector<Stratum> present; // without those of vertices that are gone
  for(Vertex_index v = 0; v < mesh.points.size(); ++v)
    if(!is_merged[v])
      present.push_back(mesh.strata[v]);
  return std::equal(expected.begin(), expected.end(), present.begin(), present.end(),
                    [](Stratum of_faces, Stratum s) {
                      return s == of_faces || (s >= first_sharp_stratum && of_faces != free_stratum);
                    });
}

/// Whether the numbers of boundary vertices, and of those that have arrived, are those of the mesh.
inline bool are_counts_of_mesh(const Mixed_mesh_optimization_result_3& result, const Working_mesh& mesh,
                               const std::vector<std::uint8_t>& is_arrived)
{
  std::size_t boundary = 0, arrived = 0;
  for(Vertex_index v = 0; v < mesh.points.size(); ++v)
    if(mesh.is_on_boundary(v)) {
      ++boundary;
      arrived += is_arrived[v] != 0;
    }
  return result.number_of_boundary_vertices == boundary && result.number_of_arrived_vertices == arrived;
}

/// Whether the result counts all boundary vertices, has no more arrived than there are, and says that all of
/// the boundary is on the surface only if all have arrived.
inline bool are_counts_of_strata(const Mixed_mesh_fit_result_3& result, const std::vector<Stratum>& strata)
{
  const std::size_t boundary = strata.size()
                               - std::size_t(std::count(strata.begin(), strata.end(), free_stratum));
  return result.number_of_boundary_vertices == boundary && result.number_of_arrived_vertices <= boundary
         && (!result.is_on_surface() || result.number_of_arrived_vertices == boundary);
}

/// Whether a vertex is on all surfaces of its stratum, within rounding. Where several surfaces meet, their
/// common point is found by iteration, and does not tell.
inline bool is_on_surfaces(const Vec3& p, Stratum stratum, const Surface_projection& project)
{
  return project.is_reached(p, stratum) && (!project.is_concurrent(stratum) || project.is_there(p, stratum));
}

/// Whether all boundary vertices that have arrived are on their surfaces.
inline bool are_arrived_on_surfaces(const Working_mesh& mesh, const std::vector<std::uint8_t>& is_arrived,
                                    const Surface_projection& project)
{
  for(Vertex_index v = 0; v < mesh.points.size(); ++v)
    if(mesh.is_on_boundary(v) && is_arrived[v] && !is_on_surfaces(mesh.points[v], mesh.strata[v], project))
      return false;
  return true;
}

/// Whether all vertices of a stratum are on their surfaces.
inline bool are_all_on_surfaces(const std::vector<Vec3>& points, const std::vector<Stratum>& strata,
                                const Surface_projection& project)
{
  for(std::size_t v = 0; v < points.size(); ++v)
    if(strata[v] != free_stratum && !is_on_surfaces(points[v], strata[v], project))
      return false;
  return true;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_FITTING_POSTCONDITIONS_H
