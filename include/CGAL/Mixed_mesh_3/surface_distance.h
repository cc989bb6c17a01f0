// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Distance between the boundary of a mesh and a surface.

#ifndef CGAL_MIXED_MESH_3_SURFACE_DISTANCE_H
#define CGAL_MIXED_MESH_3_SURFACE_DISTANCE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/surface/hausdorff_distance.h>
#include <CGAL/Mixed_mesh_3/internal/surface/boundary_self_intersections.h>
#include <CGAL/Mixed_mesh_3/internal/surface/Triangle_soup.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Named_function_parameters.h>
#include <CGAL/assertions.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

namespace internal {

/// The length of the diagonal of the box of the triangles; a soup may have points without triangles.
inline double diagonal(const Triangle_soup& soup)
{
  Bbox_3 b;
  for(const auto& t : soup.triangles)
    for(std::size_t v : t)
      b += soup.points[v].bbox();
  return norm({b.x_span(), b.y_span(), b.z_span()});
}

/// Number of points farther than that from a surface.
inline std::size_t number_of_points_off(const Triangle_soup& soup, const Nearest_triangle& nearest,
                                        double tolerance)
{
  return std::size_t(std::count_if(soup.points.begin(), soup.points.end(),
                                   [&](const auto& p) { return nearest(p).distance > tolerance; }));
}

} // namespace internal

/// \ingroup PkgMixedMesh3Validity
/// The distance between the boundary of a mesh and a surface.
struct Hausdorff_distance
{
  One_sided_distance from_mesh;    ///< the point of the boundary that is farthest from the surface
  One_sided_distance from_surface; ///< the point of the surface that is farthest from the boundary

  /// The larger one of both distances.
  double distance() const { return (std::max)(from_mesh.distance, from_surface.distance); }
};

namespace internal {

inline Hausdorff_distance hausdorff_distance(const Triangle_soup& boundary, const Triangle_soup& surface,
                                             const Nearest_triangle& nearest_of_surface, double maximal_error)
{
  return {one_sided_distance(boundary, nearest_of_surface, maximal_error),
          one_sided_distance(surface, Nearest_triangle(boundary), maximal_error)};
}

/// The results of `hausdorff_distance()` and `number_of_vertices_off_surface()`, by one tree of the surface.
struct Distances_from_surface
{
  Hausdorff_distance distance;
  std::size_t number_of_vertices_off;
};

/// \param boundary boundary of the mesh
/// \param tree tree of the surface; if null, it is built
template <class FaceListGraph>
Distances_from_surface distances_from_surface(const Triangle_soup& boundary, const FaceListGraph& surface,
                                              double relative_error, double relative_tolerance,
                                              std::shared_ptr<const Triangle_tree> tree = nullptr)
{
  const Triangle_soup triangles = surface_triangles(surface, parameters::default_values());
  const Nearest_triangle nearest = tree ? Nearest_triangle(std::move(tree)) : Nearest_triangle(triangles);
  const double size = diagonal(triangles);
  return {hausdorff_distance(boundary, triangles, nearest, relative_error * size),
          number_of_points_off(boundary, nearest, relative_tolerance * size)};
}

} // namespace internal

/*!
\ingroup PkgMixedMesh3Validity

\brief Computes the Hausdorff distance between the boundary of a mesh and a surface, both ways.

The distance is not sampled: a bound on the error is proved, up to rounding. Quadrilaterals on the boundary
are split into two triangles, through their vertex of smallest index.

\tparam Mesh a `Mixed_mesh_3`
\tparam FaceListGraph a model of `FaceListGraph`, with points of any CGAL kernel
\param mesh the mesh. \pre not empty
\param surface the surface. \pre triangulated, and not empty
\param relative_error largest error by which a distance may be too small, relative to the diagonal of the box
of `surface`. Where large triangles coincide with thousands of small ones, the error can be larger;
`One_sided_distance::error` tells.
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those below

\cgalNamedParamsBegin
  \cgalParamNBegin{vertex_point_map}
    \cgalParamDescription{the points of `surface`}
    \cgalParamType{a model of `ReadablePropertyMap` with the vertices as keys and points as values}
    \cgalParamDefault{`get_const_property_map(CGAL::vertex_point, surface)`}
  \cgalParamNEnd
\cgalNamedParamsEnd

\par Complexity
About O(n log n) for n triangles, if the distances are not all the same; at most some seconds more
*/
template <class Mesh, class FaceListGraph, class NamedParameters = parameters::Default_named_parameters>
Hausdorff_distance hausdorff_distance(const Mesh& mesh, const FaceListGraph& surface,
                                      double relative_error = 1e-4,
                                      const NamedParameters& np = parameters::default_values())
{
  CGAL_precondition(relative_error > 0);
  const internal::Triangle_soup boundary = internal::boundary_triangles(mesh);
  const internal::Triangle_soup triangles = internal::surface_triangles(surface, np);
  CGAL_precondition(!triangles.triangles.empty());
  const double maximal_error = relative_error * internal::diagonal(triangles);
  return internal::hausdorff_distance(boundary, triangles, internal::Nearest_triangle(triangles),
                                      maximal_error);
}

/*!
\ingroup PkgMixedMesh3Validity

Number of vertices on the boundary of a mesh that are not on a surface.

\param mesh the mesh. \pre not empty
\param surface a model of `FaceListGraph`. \pre triangulated, and not empty
\param relative_tolerance the distance beyond which a vertex is not on the surface, relative to the
       diagonal of the box of `surface`
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those below

\cgalNamedParamsBegin
  \cgalParamNBegin{vertex_point_map}
    \cgalParamDescription{the points of `surface`}
    \cgalParamType{a model of `ReadablePropertyMap` with the vertices as keys and points as values}
    \cgalParamDefault{`get_const_property_map(CGAL::vertex_point, surface)`}
  \cgalParamNEnd
\cgalNamedParamsEnd
*/
template <class Mesh, class FaceListGraph, class NamedParameters = parameters::Default_named_parameters>
std::size_t number_of_vertices_off_surface(const Mesh& mesh, const FaceListGraph& surface,
                                           double relative_tolerance = 1e-9,
                                           const NamedParameters& np = parameters::default_values())
{
  const internal::Triangle_soup boundary = internal::boundary_triangles(mesh);
  const internal::Triangle_soup triangles = internal::surface_triangles(surface, np);
  CGAL_precondition(!triangles.triangles.empty());
  const internal::Nearest_triangle nearest(triangles);
  return internal::number_of_points_off(boundary, nearest,
                                        relative_tolerance * internal::diagonal(triangles));
}

/// \ingroup PkgMixedMesh3Validity
/// Number of pairs of triangles of the boundary that intersect other than in a common edge or vertex, by
/// exact predicates. A degenerate triangle counts as a pair with itself; where the boundary is not manifold,
/// triangles that touch count as well.
/// \param mesh the mesh. \pre not empty
template <class Mesh>
std::size_t number_of_boundary_self_intersections(const Mesh& mesh)
{
  return internal::number_of_self_intersections(internal::boundary_triangles(mesh));
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_SURFACE_DISTANCE_H
