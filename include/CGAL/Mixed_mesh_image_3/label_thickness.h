// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How thin labels are, and gaps between them, before any surface is made: from the lengths of rows of voxels.

#ifndef CGAL_MIXED_MESH_IMAGE_3_LABEL_THICKNESS_H
#define CGAL_MIXED_MESH_IMAGE_3_LABEL_THICKNESS_H

#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>

#include <CGAL/assertions.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMeshImage3Ref
/// The shape of a label as a layer.
struct Label_thickness_3
{
  double volume = 0; ///< of its voxels, in cubic millimeters
  double area = 0;   ///< of its surface, on both sides of a layer, in square millimeters, about
  /// The integral of \f$ 1 / h^2 \f$ over the surface, where the label has the thickness \f$ h \f$, about. A
  /// mesh with edges of \f$ k h \f$ has this number, by \f$ k^2 \sqrt 3 / 2 \f$, of vertices at the surface.
  double thinness = 0;

  /// The mean thickness of a layer, in millimeters. \pre the label has voxels
  double thickness() const { return 2 * volume / area; }
};

/*!
\ingroup PkgMixedMeshImage3Ref
\brief measures how thin labels are.

A plane layer of the area \f$ A \f$ and the thickness \f$ h \f$, whose normal has the component
\f$ n \f$ along an axis of the image, has \f$ |n| A \f$ rows of voxels along this axis for each unit of
area, which are \f$ h / |n| \f$ long. Over all directions, the mean of \f$ |n| \f$ is 1/2, and that of
\f$ |n|^3 \f$ is 1/4: so the ends of the rows along the three axes are 3/2 of the area of the surface, and
the sum of the inverse squares of their lengths is \f$ 3 A / (4 h^2) \f$.

\param image segmentation. Its `index_to_world` may be oblique
\param number_of_labels the number of labels
\param label `std::size_t(float)`: label of a value, from 1; 0 for the background
\return the thickness of the background between labels, which is that of gaps, without volume and area; then
that of each label

\par Complexity
Linear in the number of voxels
*/
template <class Label>
std::vector<Label_thickness_3> label_thickness(const Voxel_image_3& image, std::size_t number_of_labels,
                                               const Label& label)
{
  std::vector<Label_thickness_3> result(number_of_labels + 1);
  if(image.values.empty())
    return result;
  std::vector<std::uint32_t> labels;
  labels.reserve(image.values.size());
  for(std::size_t v = 0; v < image.values.size(); ++v)
    labels.push_back(v > 0 && image.values[v] == image.values[v - 1] ? labels.back()
                                                                     : std::uint32_t(label(image.values[v])));
  const std::array<std::size_t, 3>& size = image.grid.size;
  const std::array<double, 3> spacing = voxel_spacing(image.grid);
  const double volume = std::abs(determinant(image.grid.index_to_world));
  for(std::size_t axis = 0; axis < 3; ++axis) {
    const double area = volume / spacing[axis]; // of a face of a voxel
    const auto add = [&](std::uint32_t l, std::size_t number_of_voxels, bool is_between) {
      if(l == 0 && !is_between)
        return;
      Label_thickness_3& t = result[l];
      const double length = double(number_of_voxels) * spacing[axis];
      t.thinness += 8. / 3 * area / (length * length);
      if(l > 0) {
        t.area += 2. / 3 * 2 * area;
        t.volume += axis == 0 ? double(number_of_voxels) * volume : 0;
      }
    };
    const std::array<std::size_t, 3> steps{1, size[0], size[0] * size[1]};
    const std::size_t n = size[axis], step = steps[axis], second = steps[(axis + 1) % 3],
                      third = steps[(axis + 2) % 3];
    for(std::size_t k = 0; k < size[(axis + 2) % 3]; ++k)
      for(std::size_t j = 0; j < size[(axis + 1) % 3]; ++j) {
        const std::uint32_t* const row = labels.data() + j * second + k * third;
        for(std::size_t begin = 0, end; begin < n; begin = end) {
          for(end = begin + 1; end < n && row[end * step] == row[begin * step];)
            ++end;
          add(row[begin * step], end - begin, begin > 0 && end < n);
        }
      }
  }
  return result;
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_LABEL_THICKNESS_H
