// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef MIXED_MESH_3_TEST_LABELS_H
#define MIXED_MESH_3_TEST_LABELS_H

#include <CGAL/Mixed_mesh_image_3/label_extents.h>
#include <CGAL/Mixed_mesh_image_3/make_label_surfaces.h>

#include <cstddef>
#include <functional>
#include <vector>

// The surface around labels 1 to n, then that of each.
template <class Surface>
std::vector<Surface> surfaces_of_labels(const CGAL::Mixed_meshes_3::Voxel_image_3& image, int n,
                                        double smoothing, std::size_t vertices = 0,
                                        std::vector<CGAL::Mixed_meshes_3::Label_change_3>* changes = nullptr)
{
  using namespace CGAL::Mixed_meshes_3;
  const auto extent_of_values = label_extents(image);
  std::vector<std::function<bool(float)>> has_label;
  std::vector<Label_extent_3> extents;
  for(int l = 1; l <= n; ++l) {
    has_label.emplace_back([l](float value) { return value == float(l); });
    const auto found = extent_of_values.find(float(l));
    extents.push_back(found == extent_of_values.end() ? Label_extent_3() : found->second);
  }
  return make_label_surfaces<Surface>(image, has_label, extents, smoothing, vertices, changes);
}

#endif // MIXED_MESH_3_TEST_LABELS_H
