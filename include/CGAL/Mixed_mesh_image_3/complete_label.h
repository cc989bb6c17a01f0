// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Conversion of the voxels of an atlas or a segmentation to those of a solid organ.

#ifndef CGAL_MIXED_MESH_IMAGE_3_COMPLETE_LABEL_H
#define CGAL_MIXED_MESH_IMAGE_3_COMPLETE_LABEL_H

#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>
#include <CGAL/Mixed_mesh_image_3/internal/Voxel_box.h>
#include <CGAL/Mixed_mesh_image_3/internal/distance_transform.h>
#include <CGAL/Mixed_mesh_image_3/internal/voxel_components.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMeshImage3Ref
/// The steps of `complete_label()`, in their order. By default, there are none.
struct Label_completion_options
{
  /// The radius of the ball of the morphological closing, in millimeters: gaps, grooves and openings that
  /// this ball does not fit into get the label; 0: no closing.
  double closing_radius = 0;
  /// Whether the label gets the voxels that it encloses.
  bool fill_holes = false;
  /// Whether only the largest connected component keeps the label; of equally large components, the first.
  bool keep_largest = false;
  /// The least volume, in cubic millimeters, of a connected component that keeps the label.
  double least_volume = 0;
};

/// \ingroup PkgMixedMeshImage3Ref
/// The steps that make a solid organ from an atlas or a parcellation of the organ: a closing by 13 % of the
/// edge of a cube of the label's volume, 15 mm for a brain; holes filled; the largest component. Gaps between
/// regions are closed then, also where the ventricles of a cortex are open below; the volume of a brain is 1
/// % more than with 10 mm.
/// \param volume volume of the label, in cubic millimeters
inline Label_completion_options hull_completion(double volume)
{
  return {std::round(1.3 * std::cbrt(volume)) / 10, true, true, 0};
}

/// \ingroup PkgMixedMeshImage3Ref
/// The result of `complete_label()`, in voxels.
struct Label_completion_result
{
  std::size_t number_of_voxels = 0;             ///< voxels that had the label
  std::size_t number_of_closed_voxels = 0;      ///< voxels that got the label by closing
  std::size_t number_of_filled_voxels = 0;      ///< voxels that got the label as they were enclosed
  std::size_t number_of_removed_voxels = 0;     ///< voxels that lost the label, with their components
  std::size_t number_of_removed_components = 0; ///< components of these voxels
};

namespace internal {

inline std::size_t number_with_label(const Labeled_box& box)
{
  return std::size_t(std::count(box.has_label.begin(), box.has_label.end(), 1));
}

/// Gives the label to the voxels that are not covered by any ball that avoids the label. Distances are
/// distances between centers.
/// \param margin margin of the box, which is larger than the radius: closing adds nothing there
inline void close_label(Labeled_box& box, double radius, const std::array<double, 3>& spacing,
                        const std::array<std::size_t, 3>& margin)
{
  const double most = squared_reach(radius);
  const std::vector<float> to_label = squared_distances(box, 1, spacing);
  Labeled_box dilated = box;
  for(std::size_t v = 0; v < to_label.size(); ++v)
    dilated.has_label[v] = to_label[v] <= most;
  const std::vector<float> to_rest = squared_distances(dilated, 0, spacing);
  std::array<std::size_t, 3> p;
  for(p[2] = margin[2]; p[2] + margin[2] < box.size[2]; ++p[2])
    for(p[1] = margin[1]; p[1] + margin[1] < box.size[1]; ++p[1])
      for(p[0] = margin[0]; p[0] + margin[0] < box.size[0]; ++p[0])
        box.has_label[box.offset(p)] = to_rest[box.offset(p)] > most;
}

/// Gives the label to the voxels that it encloses.
inline void fill_holes(Labeled_box& box)
{
  const Voxel_components components = voxel_components(box);
  for(std::size_t v = 0; v < box.has_label.size(); ++v)
    box.has_label[v] = components.numbers[v] != 0;
}

/// Removes the label from all components but the largest one, or from components with fewer voxels.
/// \return the number of these components
inline std::size_t remove_components(Labeled_box& box, bool keep_largest, double least_number_of_voxels)
{
  const Voxel_components components = voxel_components(box);
  const std::size_t n = components.sizes.size();
  std::size_t largest = n;
  for(std::size_t c = 0; c < n; ++c)
    if(components.has_label[c] && (largest == n || components.sizes[c] > components.sizes[largest]))
      largest = c;
  const auto is_kept = [&](std::size_t c) {
    return components.has_label[c] && (!keep_largest || c == largest)
           && double(components.sizes[c]) >= least_number_of_voxels;
  };
  std::size_t number_removed = 0;
  for(std::size_t c = 0; c < n; ++c)
    number_removed += components.has_label[c] && !is_kept(c);
  for(std::size_t v = 0; v < box.has_label.size(); ++v)
    box.has_label[v] = is_kept(components.numbers[v]);
  return number_removed;
}

} // namespace internal

/*!
\ingroup PkgMixedMeshImage3Ref

\brief The voxels of a label, with gaps closed, holes filled, and small components removed.

An atlas has gaps between its regions, and a segmentation has specks: their surface is not that of an organ.
The steps, each of them optional, are: a morphological closing by a ball, by exact Euclidean distances between
the centers of voxels (Felzenszwalb and Huttenlocher, 2012), for any spacing along each axis, as if the image
went on without label; holes filled; the largest component, or components of a least volume, kept. Two voxels
are connected if the surface of `make_label_surface()` connects them: if their centers share an edge of Kuhn's
tetrahedra.

\tparam HasLabel `bool(float)`
\param image segmentation whose axes are perpendicular, or nearly: distances are measured along the axes
\param has_label whether voxels of a value have the label
\param options steps to be done
\param result the result, if given

\return an image of the same grid: 1 in voxels that have the label afterwards, 0 in others
\pre lengths and volumes of the options are finite and not negative, the determinant of
     `image.grid.index_to_world` is not 0

\par Complexity
Linear in the number of voxels of the image, and of the box around the label with the radius on each side
*/
template <class HasLabel>
Voxel_image_3 complete_label(const Voxel_image_3& image, const HasLabel& has_label,
                             const Label_completion_options& options,
                             Label_completion_result* result = nullptr)
{
  using namespace internal;
  CGAL_precondition(options.closing_radius >= 0 && std::isfinite(options.closing_radius));
  CGAL_precondition(options.least_volume >= 0 && std::isfinite(options.least_volume));
  CGAL_precondition(determinant(image.grid.index_to_world) != 0);
  const std::array<double, 3> spacing = voxel_spacing(image.grid);
  std::array<std::size_t, 3> margin;
  for(int i = 0; i < 3; ++i) // covers balls beyond the label, and a voxel at the border
    margin[i] = std::size_t(std::ceil(options.closing_radius / spacing[i])) + 2;
  Labeled_box box = box_of_label(image, has_label, margin, whole_extent(image.grid));
  Label_completion_result done;
  std::size_t number = done.number_of_voxels = number_with_label(box);
  // The growth of the number of voxels that have the label.
  const auto growth = [&box, &number] {
    const std::size_t before = number;
    return (number = number_with_label(box)) - before;
  };
  if(number > 0) {
    if(options.closing_radius > 0) {
      close_label(box, options.closing_radius, spacing, margin);
      done.number_of_closed_voxels = growth();
    }
    if(options.fill_holes) {
      fill_holes(box);
      done.number_of_filled_voxels = growth();
    }
    if(options.keep_largest || options.least_volume > 0) {
      const double volume = std::abs(determinant(image.grid.index_to_world));
      const std::size_t before = number;
      done.number_of_removed_components = remove_components(box, options.keep_largest,
                                                            options.least_volume / volume);
      done.number_of_removed_voxels = before - number_with_label(box);
    }
  }
  Voxel_image_3 completed{image.grid, std::vector<float>(image.grid.number_of_voxels(), 0.f),
                          Voxel_type::UINT8};
  for_each_in_image(box, image.grid, [&](std::size_t in_box, std::size_t in_image) {
    completed.values[in_image] = box.has_label[in_box];
  });
  if(result != nullptr)
    *result = done;
  return completed;
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_IMAGE_3_COMPLETE_LABEL_H
