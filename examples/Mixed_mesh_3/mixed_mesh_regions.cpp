// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Regions of interest: a path given by a surface and a second target given as a ball, where errors count
// half as much; cells parallel to the axes, then turned so that they are parallel to the path.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Mixed_mesh_3/IO/write_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/make_mixed_mesh_3.h>

#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <utility>

namespace mm3 = CGAL::Mixed_meshes_3;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Mesh = CGAL::Mixed_mesh_3<Kernel>;

template <class CellTraits, class Region>
bool mesh_and_report(const CGAL::Polyhedral_mixed_mesh_domain_3& brain, const Region& region,
                     const CellTraits& cell_traits, const std::string& name)
{
  Mesh mesh;
  const auto result = CGAL::make_mixed_mesh_3(brain, region, 2000, cell_traits, mesh);
  std::size_t in_region = 0;
  for(mm3::Element_index e = 0; e < mesh.number_of_elements(); ++e)
    in_region += mesh.is_in_region(e);
  std::cout << name << ": " << mesh.number_of_vertices() << " vertices, " << mesh.number_of_elements()
            << " elements, " << in_region << " of them meet the region; smallest cells "
            << cell_traits.length(1u << (21 - result.deepest_level)) << " mm\n";
  std::string error;
  if(!mm3::IO::write_mixed_mesh("regions_" + name + ".vtu", mesh, {}, &error)) {
    std::cerr << error << '\n';
    return false;
  }
  return result.has_mesh();
}

int main(int argc, char** argv)
try {
  Surface brain_surface, path_surface;
  std::string error;
  if(!mm3::IO::read_closed_surface(argc > 1 ? argv[1] : CGAL::data_file_path("brain.off"), brain_surface,
                                   &error)
     || !mm3::IO::read_closed_surface(argc > 2 ? argv[2] : CGAL::data_file_path("region.off"), path_surface,
                                      &error)) {
    std::cerr << error << '\n';
    return EXIT_FAILURE;
  }

  const CGAL::Polyhedral_mixed_mesh_domain_3 brain(brain_surface);
  const CGAL::Weighted_mixed_mesh_region_3 second(CGAL::Ball_mixed_mesh_region_3({-30, -20, 30}, 12), 0.5);
  const CGAL::Union_mixed_mesh_region_3 region(CGAL::Polyhedral_mixed_mesh_region_3(path_surface), second);

  // The axis from the tumor to the skull opening; the frame of the cells is exactly orthogonal, its third
  // axis within a few degrees of the given one.
  const Kernel::Point_3 tumor(28, 18, 24), opening(45, 30, 76);
  const mm3::Axis_aligned_octree_cell_traits_3 aligned(brain.bbox());
  const mm3::Rotated_octree_cell_traits_3 rotated(brain_surface.points(), opening - tumor);

  return mesh_and_report(brain, region, aligned, "axis_aligned")
             && mesh_and_report(brain, region, rotated, "along_the_path")
           ? EXIT_SUCCESS
           : EXIT_FAILURE;
} catch(const std::exception& e) {
  std::cerr << e.what() << '\n';
  return EXIT_FAILURE;
}
