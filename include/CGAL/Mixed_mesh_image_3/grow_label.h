// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Growth of a label into the background, such as a layer of fluid around a brain.

#ifndef CGAL_MIXED_MESH_IMAGE_3_GROW_LABEL_H
#define CGAL_MIXED_MESH_IMAGE_3_GROW_LABEL_H

#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>
#include <CGAL/Mixed_mesh_image_3/internal/Voxel_box.h>
#include <CGAL/Mixed_mesh_image_3/internal/distance_transform.h>
#include <CGAL/Mixed_mesh_image_3/label_extents.h>

#include <CGAL/assertions.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

/*!
\ingroup PkgMixedMeshImage3Ref

\brief Gives a value to the voxels of the background near a label.

A segmentation often lacks the fluid around an organ, or has a layer that is too thin. The voxels of the
background up to a distance from the label get a value: that of the label, which grows, or a new one, for a
layer around the label. Distances are exact Euclidean distances between the centers of voxels (Felzenszwalb
and Huttenlocher, 2012), for any spacing along each axis. Distances are straight: the growth passes through
other labels that are thinner than the distance. The growth ends at the border of the image.

\tparam HasLabel `bool(float)`
\tparam IsBackground `bool(float)`
\param image segmentation whose axes are perpendicular, or nearly: distances are measured along the axes
\param has_label whether voxels of a value have the label
\param is_background whether voxels of a value get the new value if they are near; others never change
\param distance largest distance, in millimeters, between the centers of voxels
\param value new value

\return the number of voxels that got the value
\pre `distance` is finite and not negative, the determinant of `image.grid.index_to_world` is not 0

\par Complexity
Linear in the number of voxels of the image, and of the box around the label with the distance on each side
*/
template <class HasLabel, class IsBackground>
std::size_t grow_label(Voxel_image_3& image, const HasLabel& has_label, const IsBackground& is_background,
                       double distance, float value)
{
  using namespace internal;
  CGAL_precondition(distance >= 0 && std::isfinite(distance));
  CGAL_precondition(determinant(image.grid.index_to_world) != 0);
  const std::array<double, 3> spacing = voxel_spacing(image.grid);
  const double most = squared_reach(distance);
  std::array<std::size_t, 3> margin;
  for(int i = 0; i < 3; ++i)
    margin[i] = std::size_t(std::sqrt(most) / spacing[i]) + 1;
  const Labeled_box box = box_of_label(image, has_label, margin, whole_extent(image.grid));
  const std::vector<float> to_label = squared_distances(box, 1, spacing);
  return set_background(
    image, box, [&](std::size_t v) { return to_label[v] <= most; }, is_background, value);
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_GROW_LABEL_H
