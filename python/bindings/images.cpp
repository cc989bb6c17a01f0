// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces from images of labels, and images that follow a displacement.

#include "arrays.h"

#include <CGAL/Mixed_mesh_image_3/IO/read_voxel_image.h>
#include <CGAL/Mixed_mesh_image_3/complete_label.h>
#include <CGAL/Mixed_mesh_image_3/make_label_surface.h>
#include <CGAL/Mixed_mesh_image_3/simplify_closed_surface.h>
#include <CGAL/Mixed_mesh_image_3/warp_image.h>

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

namespace {

// Values with the first index running fastest, as in files.
using Voxels = py::array_t<float, py::array::f_style | py::array::forcecast>;

mm3::Voxel_image_3 image_of(const Voxels& values, const Doubles& affine)
{
  if(values.ndim() != 3 || values.size() == 0)
    throw std::invalid_argument("image: expected an array of three dimensions");
  if(affine.ndim() != 2 || affine.shape(0) != 4 || affine.shape(1) != 4)
    throw std::invalid_argument("affine: expected an array of shape (4, 4)");
  mm3::Voxel_image_3 image;
  for(int i = 0; i < 3; ++i) {
    image.grid.size[std::size_t(i)] = std::size_t(values.shape(i));
    for(int j = 0; j < 4; ++j)
      image.grid.index_to_world[std::size_t(i)][std::size_t(j)] = affine.at(i, j);
  }
  const double d = mm3::determinant(image.grid.index_to_world);
  if(!(std::abs(d) > 0 && std::isfinite(d)))
    throw std::invalid_argument("affine: has no inverse");
  image.values.assign(values.data(), values.data() + values.size());
  return image;
}

py::array_t<float, py::array::f_style> values_of(const mm3::Voxel_image_3& image)
{
  const auto& n = image.grid.size;
  py::array_t<float, py::array::f_style> array({n[0], n[1], n[2]});
  std::copy(image.values.begin(), image.values.end(), array.mutable_data());
  return array;
}

// (i, j, k, 3)
py::array_t<float> values_of(const mm3::Displacement_field_3& field)
{
  const auto& n = field.grid.size;
  py::array_t<float> array({n[0], n[1], n[2], std::size_t(3)});
  auto values = array.mutable_unchecked<4>();
  for(std::size_t k = 0; k < n[2]; ++k)
    for(std::size_t j = 0; j < n[1]; ++j)
      for(std::size_t i = 0; i < n[0]; ++i)
        for(std::size_t c = 0; c < 3; ++c)
          values(py::ssize_t(i), py::ssize_t(j), py::ssize_t(k),
                 py::ssize_t(c)) = field.vectors[field.grid.offset(i, j, k)][c];
  return array;
}

// Voxels with one of the given values, completed.
py::array complete_label(const Voxels& values, const Doubles& affine, const std::set<float>& labels,
                         std::optional<double> radius, bool fill_holes, bool keep_largest,
                         double least_volume, bool is_hull)
{
  const mm3::Voxel_image_3 image = image_of(values, affine);
  const auto has_label = [&](float value) { return labels.count(value) > 0; };
  const double volume = double(std::count_if(image.values.begin(), image.values.end(), has_label))
                        * std::abs(mm3::determinant(image.grid.index_to_world));
  mm3::Label_completion_options options;
  if(is_hull)
    options = mm3::hull_completion(volume);
  options.closing_radius = radius.value_or(options.closing_radius);
  options.fill_holes |= fill_holes;
  options.keep_largest |= keep_largest;
  options.least_volume = 1000 * least_volume; // ml
  const auto spacing = mm3::voxel_spacing(image.grid);
  const double most = 100 * *std::min_element(spacing.begin(), spacing.end());
  if(!(options.closing_radius >= 0 && options.closing_radius <= most))
    throw std::invalid_argument("close: expected at most the width of 100 voxels, in mm");
  if(!(least_volume >= 0 && std::isfinite(least_volume)))
    throw std::invalid_argument("drop_below: expected a volume in ml");
  mm3::Voxel_image_3 mask;
  {
    const py::gil_scoped_release release;
    mask = mm3::complete_label(image, has_label, options);
  }
  return values_of(mask);
}

// The surface of voxels with one of the given values, simplified; empty if smoothing removes all voxels.
py::tuple label_surface(const Voxels& values, const Doubles& affine, const std::set<float>& labels,
                        std::optional<double> smoothing, std::size_t vertices)
{
  const mm3::Voxel_image_3 image = image_of(values, affine);
  const auto spacing = mm3::voxel_spacing(image.grid);
  const double deviation = smoothing.value_or(*std::max_element(spacing.begin(), spacing.end()));
  if(!(deviation >= 0 && deviation <= 100 * *std::min_element(spacing.begin(), spacing.end())))
    throw std::invalid_argument("smoothing: expected at most the width of 100 voxels, in mm");
  Surface surface;
  {
    const py::gil_scoped_release release;
    mm3::make_label_surface(
      image, [&](float value) { return labels.count(value) > 0; }, deviation, surface, vertices);
    if(!surface.is_empty())
      mm3::simplify_closed_surface(surface, vertices);
    surface.collect_garbage();
  }
  return arrays_of(surface);
}

py::tuple warp(const Voxels& values, const Doubles& affine, const Mesh& mesh, const Doubles& displacements,
               const std::optional<Marks>& removed, bool is_of_labels,
               const std::vector<std::array<std::uint32_t, 2>>& edges, const Doubles& edge_coefficients)
{
  const mm3::Voxel_image_3 image = image_of(values, affine);
  const std::vector<Vector> vectors = vectors_of(displacements, "displacements");
  if(vectors.size() != mesh.number_of_vertices())
    throw std::invalid_argument("displacements: expected one for each vertex");
  mm3::Warp_options options;
  options.image_interpolation = is_of_labels ? mm3::Image_interpolation::NEAREST
                                             : mm3::Image_interpolation::LINEAR;
  options.edge_coefficients = vectors_of(edge_coefficients, "edge_coefficients");
  if(options.edge_coefficients.size() != edges.size())
    throw std::invalid_argument("edge_coefficients: expected one for each edge");
  for(const auto& [v, w] : edges) {
    if(!(v < w && w < mesh.number_of_vertices()))
      throw std::invalid_argument("edges: expected pairs of vertices, the smaller one first");
    options.quadratic_edges.push_back({mm3::Vertex_index(v), mm3::Vertex_index(w)});
  }
  if(removed)
    options.resected_elements = marks_of(*removed, mesh.number_of_elements(), "removed");
  mm3::Warped_image_3 warped;
  {
    const py::gil_scoped_release release;
    warped = mm3::warp_image(image, mesh, vectors, options);
  }
  return py::make_tuple(values_of(warped.image), values_of(warped.forward), values_of(warped.backward),
                        values_of(warped.mask));
}

// The values of an image, and its affine map.
py::tuple read_image(const std::string& path)
{
  mm3::Voxel_image_3 image;
  std::string error;
  bool is_read;
  {
    const py::gil_scoped_release release;
    is_read = mm3::IO::read_voxel_image(path, image, &error);
  }
  if(!is_read)
    throw std::invalid_argument(error);
  py::array_t<double> affine({4, 4});
  for(int i = 0; i < 4; ++i)
    for(int j = 0; j < 4; ++j)
      affine.mutable_at(i, j) = i < 3 ? image.grid.index_to_world[i][j] : double(j == 3);
  return py::make_tuple(values_of(image), affine);
}

} // namespace

void add_images(py::module_& module)
{
  module.def("complete_label", &complete_label);
  module.def("label_surface", &label_surface);
  module.def("read_image", &read_image);
  module.def("warp", &warp);
}
