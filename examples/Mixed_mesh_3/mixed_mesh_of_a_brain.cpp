// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The ten lines: from two surfaces and a number of vertices to a finite-element mesh in a file.
//
//   mixed_mesh_of_a_brain [SURFACE [REGION [VERTICES]]]

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

namespace mm3 = CGAL::Mixed_meshes_3;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Mesh = CGAL::Mixed_mesh_3<Kernel>;

int main(int argc, char** argv)
try {
  // The domain, and the path from the skull opening to the tumor. Both surfaces have to be closed; the reader
  // repairs minor defects, and reports the others.
  Surface brain, path;
  std::string error;
  if(!mm3::IO::read_closed_surface(argc > 1 ? argv[1] : CGAL::data_file_path("brain.off"), brain, &error)
     || !mm3::IO::read_closed_surface(argc > 2 ? argv[2] : CGAL::data_file_path("region.off"), path,
                                      &error)) {
    std::cerr << error << '\n';
    return EXIT_FAILURE;
  }

  // The budget bounds the number of vertices of the final mesh. The boundary of the mesh is on the surface.
  const std::size_t budget = argc > 3 ? std::stoul(argv[3]) : 660;
  Mesh mesh;
  const CGAL::Mixed_mesh_result_3 result = CGAL::make_mixed_mesh_3(brain, path, budget, mesh);
  if(!result.has_mesh()) {
    std::cerr << mm3::description(result.status) << ": no mesh with " << budget << " vertices; one with "
              << result.number_of_vertices_needed << " has been tried\n";
    return EXIT_FAILURE;
  }

  // Table 1 of the paper: the aspect-ratio coefficient, 1 for an ideal element.
  std::cout << mesh.number_of_vertices() << " vertices\n";
  const auto rows = mm3::quality_statistics(mesh);
  for(mm3::Element_kind kind : mm3::element_kinds)
    std::cout << rows[kind].count << ' ' << mm3::reference_elements[kind].plural << ", ARC "
              << rows[kind].mean << " (at most " << rows[kind].maximum << ")\n";

  // A file for ParaView; the extension determines the format.
  if(!mm3::IO::write_mixed_mesh("mixed_mesh_of_a_brain.vtu", mesh, {}, &error)) {
    std::cerr << error << '\n';
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
} catch(const std::exception& e) {
  std::cerr << e.what() << '\n';
  return EXIT_FAILURE;
}
