// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_SURFACE_DESCRIPTION_H
#define CGAL_MIXED_MESH_3_SURFACE_DESCRIPTION_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMesh3Domains
/// What a closed surface is like, in numbers. A domain may tell them by `MixedMeshDomain_3::shells()`.
struct Shell_counts
{
  std::size_t number_of_shells = 0;        ///< connected components: bodies and cavities
  std::ptrdiff_t euler_characteristic = 0; ///< two a shell, less two a handle
  /// Of the shells, those around cavities, if that is known: in nothing else, two bodies differ from a body
  /// with a cavity.
  std::optional<std::size_t> number_of_cavities = std::nullopt;
  /// Whether all numbers are equal that both have.
  bool operator==(const Shell_counts& s) const
  {
    return number_of_shells == s.number_of_shells && euler_characteristic == s.euler_characteristic
           && (!number_of_cavities || !s.number_of_cavities || number_of_cavities == s.number_of_cavities);
  }
  bool operator!=(const Shell_counts& s) const { return !(*this == s); } ///< or not
};

/// \ingroup PkgMixedMesh3Domains
/// Edges of a surface that are sharp, each once, between positions of points. Edges that share a point make
/// polylines. A domain may tell them by `MixedMeshDomain_3::sharp_edges()`.
struct Sharp_edges
{
  std::vector<Vec3> points;                      ///< on the surface
  std::vector<std::array<std::size_t, 2>> edges; ///< the positions of their ends in `points`
  double diagonal = 0;                           ///< of the box of the whole surface; 0: not known
  double area = 0;                               ///< of the whole surface; 0: not known
};

/// \ingroup PkgMixedMesh3Domains
/// Where a point is relative to a sheet.
struct Sheet_location
{
  Vec3 closest;   ///< the closest point of the sheet
  double height;  ///< above the plane tangent there; positive in front, where the sheet is seen
                  ///< counter-clockwise
  bool is_at_rim; ///< whether the closest point is on the border of the sheet
};

/// \ingroup PkgMixedMesh3Domains
/// The planes perpendicular to each axis that a surface lies in: their coordinates, with the areas in them. A
/// domain may tell them by `MixedMeshDomain_3::axis_parallel_planes()`.
using Axis_parallel_planes = std::array<std::map<double, double>, 3>;

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_SURFACE_DESCRIPTION_H
