// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The image before and after; needs nifti_clib.

#ifndef MIXED_MESH_3_APPS_BRAIN_SHIFT_IMAGES_H
#define MIXED_MESH_3_APPS_BRAIN_SHIFT_IMAGES_H

#include "brain_shift/outcome.h"
#include "brain_shift/resection.h"
#include "core/Stage_log.h"
#include "core/types.h"

#include <CGAL/Mixed_mesh_3/IO/write_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/Recovered_displacement_3.h>
#include <CGAL/Mixed_mesh_image_3/IO/Field_format.h>
#include <CGAL/Mixed_mesh_image_3/Voxel_image_3.h>

#include <string>
#include <vector>

/// The images that are read and written; empty names if there are none.
struct Image_options
{
  std::string file, labels, output; // the last one is the start of names
  std::vector<CGAL::Mixed_meshes_3::IO::Field_format> field_formats;
  CGAL::Mixed_meshes_3::Displacement_interpolation interpolation =
    CGAL::Mixed_meshes_3::Displacement_interpolation::RECOVERED;

  /// The label image that is written.
  std::string labels_output() const { return output + "_labels.nii.gz"; }
};

/// Reads the image. \throw std::runtime_error a line naming the file and the defect, for example if the image
/// does not overlap the mesh
CGAL::Mixed_meshes_3::Voxel_image_3 read_image(const std::string& file, const Mesh& mesh,
                                               const std::string& mesh_file, Outcome& outcome);

/// Reads the labels. \throw std::runtime_error a line naming the file and the defect: the file must have the
/// voxels of the image, and integers
CGAL::Mixed_meshes_3::Voxel_image_3 read_labels(const Image_options& options,
                                                const CGAL::Mixed_meshes_3::Voxel_grid_3& grid);

/// Deforms the image with the mesh.
/// \param labels labels; empty if there are none
void write_images(CGAL::Mixed_meshes_3::IO::Output_files& files,
                  const CGAL::Mixed_meshes_3::Voxel_image_3& image,
                  const CGAL::Mixed_meshes_3::Voxel_image_3& labels, const Mesh& mesh, const Tumor& tumor,
                  const std::vector<bool>& is_removed, const Image_options& options, Stage_log& log,
                  Outcome& outcome);

#endif // MIXED_MESH_3_APPS_BRAIN_SHIFT_IMAGES_H
