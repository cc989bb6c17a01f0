// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Closed surfaces from segmentations; needs nifti_clib.

#ifndef MIXED_MESH_3_APPS_CORE_READ_LABEL_SURFACE_H
#define MIXED_MESH_3_APPS_CORE_READ_LABEL_SURFACE_H

#include "core/read_surface.h"
#include "core/voxel_selection.h"

#include <CGAL/Mixed_mesh_image_3/Label_change_3.h>
#include <CGAL/Mixed_mesh_image_3/label_thickness.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// The options for making a surface.
struct Label_surface_options
{
  std::optional<double> smoothing; // deviation in mm; default: the largest spacing of voxels
  std::size_t vertices = 0;        // approximate number of vertices of the surface
  double wrap_diameter = 0;        // in mm; 0: no wrap
};

/// The options for completing the voxels of a label, in mm and ml.
struct Label_completion
{
  std::optional<double> closing_radius; // default: none, or that of a hull
  double least_volume = 0;
  bool fill_holes = false, keep_largest = false;
  bool is_hull = false; // closed, filled, and the largest component

  bool is_needed() const
  {
    return closing_radius || least_volume > 0 || fill_holes || keep_largest || is_hull;
  }
};

/// A label image, read once for all its labels.
class Label_image
{
public:
  /// \throw std::runtime_error a line naming the file and the defect
  explicit Label_image(const std::string& path);
  Label_image(Label_image&&);
  ~Label_image();

  /// The same image with the selected voxels completed: new voxels get the commonest of the values that
  /// `filling` selects, which are selected, too.
  /// \throw std::runtime_error if no voxel is left, or completion takes too much memory
  Label_image completed(const Voxel_selection& selection, const Voxel_selection& filling,
                        const Label_completion& completion, Completion_facts& facts) const;

  /// The same image in which voxels get a value: those of 0 up to a distance, in mm, from the label; without
  /// a distance, those of 0 that the label encloses. Voxels of the domain never change.
  /// \throw std::runtime_error if the distance is too large
  Label_image with_layer(const Voxel_selection& label, const Voxel_selection& domain,
                         const std::optional<double>& distance, float value, std::size_t& number) const;

  /// The value of most voxels of a selection.
  /// \throw std::runtime_error if there are no such voxels
  float commonest_value(const Voxel_selection& selection) const;
  /// A value that is no label, and that no voxel has.
  float unused_value() const;
  /// Whether selected voxels are at the border of the image.
  bool is_at_border(const Voxel_selection& selection) const;

  std::size_t number_of_voxels(const Voxel_selection& selection) const;
  double volume_of_voxel() const;

  /// All labels but 0, ascending.
  /// \throw std::runtime_error if a label is no whole number from 1 to 2,000,000,000, or there are none or
  /// more than 60,000
  std::vector<std::uint32_t> labels() const;

  /// The surface of selected voxels. \return an empty surface if smoothing leaves nothing of the voxels
  /// \throw std::runtime_error as above, also if there are no such voxels
  Surface surface_of(const Voxel_selection& selection, const Label_surface_options& options,
                     Surface_facts& facts, std::vector<std::string>& warnings) const;

  /// The surface around all of several selections, then those of each, which have common triangles where
  /// selections touch. A voxel is of the first selection that has it. \return empty surfaces of selections
  /// that have no voxels
  /// \param changes changes of topology between voxels and surfaces
  /// \throw std::runtime_error as above
  std::vector<Surface> surfaces_of(const std::vector<Voxel_selection>& selections,
                                   const Label_surface_options& options, std::vector<Surface_facts>& facts,
                                   std::vector<CGAL::Mixed_meshes_3::Label_change_3>& changes) const;

  /// How thin the background between several selections is, then each of these. A voxel is of the first
  /// selection that has it.
  std::vector<CGAL::Mixed_meshes_3::Label_thickness_3>
  thickness_of(const std::vector<Voxel_selection>& selections) const;

private:
  void check_box(const std::string& what, const std::string& option, double radius) const;
  double smoothing(const Label_surface_options& options) const;
  struct Data;
  Label_image(const std::string& path, std::unique_ptr<const Data> data);

  const std::string m_path;
  std::unique_ptr<const Data> m_data;
};

#endif // MIXED_MESH_3_APPS_CORE_READ_LABEL_SURFACE_H
