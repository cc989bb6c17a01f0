// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Conversion of a segmentation to a closed surface: a level of the label's indicator, smoothed.

#ifndef CGAL_MIXED_MESH_IMAGE_3_MAKE_LABEL_SURFACE_H
#define CGAL_MIXED_MESH_IMAGE_3_MAKE_LABEL_SURFACE_H

#include <CGAL/Mixed_mesh_3/internal/base/Concurrency.h>
#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>
#include <CGAL/Mixed_mesh_image_3/internal/Marching_tetrahedra.h>
#include <CGAL/Mixed_mesh_image_3/internal/smooth_indicator.h>
#include <CGAL/Mixed_mesh_image_3/label_extents.h>

#include <CGAL/assertions.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>

namespace CGAL {
namespace Mixed_meshes_3 {

/*!
\ingroup PkgMixedMeshImage3Ref

\brief The closed surface around the voxels that have a label.

The indicator of these voxels, 1 in them and 0 elsewhere and outside the image, is smoothed by a Gaussian. The
surface is a level of the indicator, by marching tetrahedra: each cube between eight centers of voxels is
split into six tetrahedra (Kuhn). So the surface is a closed oriented 2-manifold that does not cut itself, for
every image.

The level is chosen such that as many centers of voxels are inside as have the label; it is nearly one half.
So the volume is kept, where one half would remove a layer of \f$ \sigma^2 / R \f$ from a ball of radius \f$ R
\f$, and the whole of a small one. Small or thin parts beside the rest of the label get smaller, or are lost.
Without voxels that have the label, the surface is empty.

\tparam HasLabel `bool(float)`
\tparam Surface_mesh_ a `CGAL::Surface_mesh` with points that can be made of three `double`
\param image segmentation. Its `index_to_world` may be oblique, or mirror
\param has_label whether voxels of a value have the label
\param smoothing standard deviation of the Gaussian, in millimeters; with 0, the surface has the steps of the
voxels. The largest spacing of voxels is a good choice
\param surface the result, in millimeters, outward oriented; cleared first
\param number_of_vertices number to which the surface will be simplified, if that is known. If the surface
would have some 20 times as many, every second voxel's center along each index is enough, if `smoothing` is
about a voxel (wherever the surface crosses an edge between two centers, the error is at most a tenth of a
voxel then): a quarter of the vertices, and of the time that the simplification takes
\param extent box of voxels that contains all voxels with the label: voxels outside the box are not examined.
If there are many labels, `label_extents()` finds all boxes at once. By default, the box is the whole image
\tparam ConcurrencyTag enables sequential versus parallel smoothing. The result does not depend on it.
        Possible values are `Sequential_tag`, `Parallel_tag`, and `Parallel_if_available_tag`
\pre `smoothing >= 0`, the determinant of `image.grid.index_to_world` is not 0

\par Complexity
Linear in the number of voxels of the box around the label, times the width of the Gaussian in voxels
*/
template <class ConcurrencyTag = Sequential_tag, class HasLabel, class Surface_mesh_>
void make_label_surface(const Voxel_image_3& image, const HasLabel& has_label, double smoothing,
                        Surface_mesh_& surface, std::size_t number_of_vertices = 0,
                        const std::optional<Label_extent_3>& extent = std::nullopt)
{
  CGAL_precondition(smoothing >= 0 && determinant(image.grid.index_to_world) != 0);
  surface.clear();
  std::array<double, 3> deviations = voxel_spacing(image.grid);
  for(double& d : deviations)
    d = smoothing / d;
  internal::Indicator indicator = internal::smooth_indicator(image, has_label, deviations,
                                                             extent.value_or(whole_extent(image.grid)),
                                                             internal::number_of_threads<ConcurrencyTag>());
  if(indicator.values.empty())
    return;
  constexpr std::size_t many_crossings = 8; // crossings of edges along the axes: there are more vertices
  if(number_of_vertices > 0 && *std::min_element(deviations.begin(), deviations.end()) >= 0.9
     && internal::number_of_crossings(indicator) > many_crossings * number_of_vertices)
    indicator = internal::every_second(indicator);
  using Point = typename Surface_mesh_::Point;
  using Vertex = typename Surface_mesh_::Vertex_index;
  const auto add_point = [&](const std::array<double, 3>& p) {
    std::array<double, 3> index;
    for(int i = 0; i < 3; ++i)
      index[i] = double(indicator.step) * p[i] + double(indicator.first[i]);
    const std::array<double, 3> q = transform(image.grid.index_to_world, index);
    surface.add_vertex(Point(q[0], q[1], q[2]));
  };
  const bool is_mirrored = determinant(image.grid.index_to_world) < 0;
  const auto add_triangle = [&](std::size_t a, std::size_t b, std::size_t c) {
    if(is_mirrored)
      std::swap(b, c);
    using Index = typename Vertex::size_type;
    const auto face = surface.add_face(Vertex(Index(a)), Vertex(Index(b)), Vertex(Index(c)));
    CGAL_assertion(face != Surface_mesh_::null_face());
    CGAL_USE(face);
  };
  internal::Marching_tetrahedra march(indicator.size, indicator.values, indicator.level);
  march(add_point, add_triangle);
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_MAKE_LABEL_SURFACE_H
