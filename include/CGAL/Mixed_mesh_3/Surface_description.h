// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_SURFACE_DESCRIPTION_H
#define CGAL_MIXED_MESH_3_SURFACE_DESCRIPTION_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_attributes.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMesh3Domains
/// The numbers that describe a closed surface. A domain may return them by `MixedMeshDomain_3::shells()`. The
/// domains of this package leave out specks, shells of less than 10^-6 of the volume of the largest one.
struct Shell_counts
{
  std::size_t number_of_shells = 0;        ///< connected components: bodies and cavities
  std::ptrdiff_t euler_characteristic = 0; ///< two for each shell, minus two for each handle
  /// The number of shells around cavities, if known: only this number distinguishes two bodies from a body
  /// with a cavity.
  std::optional<std::size_t> number_of_cavities = std::nullopt;
  /// The volumes that the shells enclose, ascending, negative around cavities; empty if they are not known,
  /// or if there is one shell.
  std::vector<double> volumes = {};
  /// Whether all numbers that both have are equal.
  bool operator==(const Shell_counts& s) const
  {
    return number_of_shells == s.number_of_shells && euler_characteristic == s.euler_characteristic
           && (!number_of_cavities || !s.number_of_cavities || number_of_cavities == s.number_of_cavities);
  }
  bool operator!=(const Shell_counts& s) const { return !(*this == s); } ///< Whether some differ.
};

/// \ingroup PkgMixedMesh3Domains
/// Sharp edges of a surface, each once, between positions of points. Edges that share a point make polylines.
/// A domain may return them by `MixedMeshDomain_3::sharp_edges()`.
///
/// With several subdomains, the edges of the mesh that follow a sharp edge lie between the same subdomains.
/// Lists of subdomains ascend; 0 is the outside, and `sheets` are the sheets.
struct Sharp_edges
{
  /// Stands for the sheets in lists of subdomains.
  static constexpr Subdomain_index sheets = -1;

  std::vector<Vec3> points;                      ///< points of the surface
  std::vector<std::array<std::size_t, 2>> edges; ///< the positions of their ends in `points`
  double diagonal = 0;                           ///< diagonal of the box of the whole surface; 0: not known
  double area = 0;                               ///< area of the whole surface; 0: not known
  /// The subdomains around each edge; empty if there is only one.
  std::vector<std::vector<Subdomain_index>> subdomains = {};
  /// The subdomains around points where edges meet another surface, beside those around their edges.
  std::map<std::size_t, std::vector<Subdomain_index>> crossings = {};
};

/// \ingroup PkgMixedMesh3Domains
/// The location of a point relative to a sheet.
struct Sheet_location
{
  Vec3 closest;   ///< the closest point of the sheet
  double height;  ///< height above the tangent plane; positive in front, where the sheet is seen
                  ///< counter-clockwise
  bool is_at_rim; ///< whether the closest point is on the border of the sheet
};

/// \ingroup PkgMixedMesh3Domains
/// The planes perpendicular to each axis that a surface lies in: their coordinates, with the areas in them. A
/// domain may return them by `MixedMeshDomain_3::axis_parallel_planes()`.
using Axis_parallel_planes = std::array<std::map<double, double>, 3>;

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_SURFACE_DESCRIPTION_H
