// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From an image of labels to a mesh: the domain consists of all voxels with a label, and one label is the
// region of interest. `IO::read_voxel_image()` reads images; this program makes an image of an ellipsoid
// with a ball in it.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mixed_mesh_3/IO/write_mixed_mesh.h>
#include <CGAL/Mixed_mesh_image_3/make_label_surface.h>
#include <CGAL/Mixed_mesh_image_3/simplify_closed_surface.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/make_mixed_mesh_3.h>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>

namespace mm3 = CGAL::Mixed_meshes_3;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

constexpr float brain = 1, tumor = 2;

mm3::Voxel_image_3 make_image()
{
  mm3::Voxel_image_3 image;
  image.grid.size = {45, 38, 35};
  image.grid.index_to_world = {{{4, 0, 0, -90}, {0, 4, 0, -75}, {0, 0, 4, -70}}}; // voxels of 4 mm
  for(std::size_t k = 0; k < image.grid.size[2]; ++k)
    for(std::size_t j = 0; j < image.grid.size[1]; ++j)
      for(std::size_t i = 0; i < image.grid.size[0]; ++i) {
        const std::array<double, 3> index{double(i), double(j), double(k)};
        const auto p = mm3::transform(image.grid.index_to_world, index);
        const auto square = [](double x) { return x * x; };
        const bool is_brain = square(p[0] / 80) + square(p[1] / 65) + square(p[2] / 60) < 1;
        const bool is_tumor = square(p[0] - 30) + square(p[1]) + square(p[2] - 20) < square(14);
        image.values.push_back(is_tumor ? tumor : is_brain ? brain : 0);
      }
  return image;
}

int main()
try {
  const mm3::Voxel_image_3 image = make_image();

  // A Gaussian of one voxel smooths the indicator of the labels: closed surfaces without steps.
  const double smoothing = 4; // mm
  Surface domain, region;
  mm3::make_label_surface(
    image, [](float label) { return label != 0; }, smoothing, domain);
  mm3::make_label_surface(
    image, [](float label) { return label == tumor; }, smoothing, region);
  std::cout << "surface of " << domain.number_of_vertices() << " vertices, simplified to ";
  mm3::simplify_closed_surface(domain, 3000); // several times the vertices that the mesh can follow
  std::cout << domain.number_of_vertices() << '\n';

  CGAL::Mixed_mesh_3<Kernel> mesh;
  const auto result = CGAL::make_mixed_mesh_3(domain, region, 2000, mesh);
  std::cout << mm3::description(result.status) << ": " << mesh.number_of_vertices() << " vertices, "
            << result.number_of_vertices_in_region << " of them in the tumor\n";
  std::string error;
  if(!mm3::IO::write_mixed_mesh("mixed_mesh_of_a_segmentation.vtu", mesh, {}, &error)) {
    std::cerr << error << '\n';
    return EXIT_FAILURE;
  }
  return result.has_mesh() ? EXIT_SUCCESS : EXIT_FAILURE;
} catch(const std::exception& e) {
  std::cerr << e.what() << '\n';
  return EXIT_FAILURE;
}
