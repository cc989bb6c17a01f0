// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Background that labels enclose becomes a label, such as the fluid of ventricles.

#ifndef CGAL_MIXED_MESH_IMAGE_3_FILL_LABEL_HOLES_H
#define CGAL_MIXED_MESH_IMAGE_3_FILL_LABEL_HOLES_H

#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>
#include <CGAL/Mixed_mesh_image_3/internal/Voxel_box.h>
#include <CGAL/Mixed_mesh_image_3/internal/voxel_components.h>
#include <CGAL/Mixed_mesh_image_3/label_extents.h>

#include <cstddef>

namespace CGAL {
namespace Mixed_meshes_3 {

/*!
\ingroup PkgMixedMeshImage3Ref

\brief Gives a value to the voxels of the background that a label encloses.

The label may be the union of several ones. A voxel without the label is enclosed if no chain of neighbors
without the label leads from the voxel to the border of the image. Two voxels are neighbors as in
`complete_label()`: if their centers share an edge of Kuhn's tetrahedra.

\tparam HasLabel `bool(float)`
\tparam IsBackground `bool(float)`
\param image segmentation
\param has_label whether voxels of a value have the label
\param is_background whether voxels of a value get the new value if they are enclosed; others never change
\param value new value

\return the number of voxels that got the value

\par Complexity
Linear in the number of voxels of the image
*/
template <class HasLabel, class IsBackground>
std::size_t fill_label_holes(Voxel_image_3& image, const HasLabel& has_label,
                             const IsBackground& is_background, float value)
{
  using namespace internal;
  // Margin of the box: no label is at its border, and the voxels outside the label are connected.
  const Labeled_box box = box_of_label(image, has_label, {2, 2, 2}, whole_extent(image.grid));
  const Voxel_components components = voxel_components(box);
  const auto is_enclosed = [&](std::size_t v) { return !box.has_label[v] && components.numbers[v] != 0; };
  return set_background(image, box, is_enclosed, is_background, value);
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_FILL_LABEL_HOLES_H
