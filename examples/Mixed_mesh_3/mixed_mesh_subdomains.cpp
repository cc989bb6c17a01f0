// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A brain with a tumor: elements of both, and a conforming interface between them on the tumor's surface.
//
//   mixed_mesh_subdomains [BRAIN [TUMOR [VERTICES]]]

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Labeled_polyhedral_mixed_mesh_domain_3.h>
#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Mixed_mesh_3/IO/write_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/interfaces.h>
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
  Surface brain, tumor;
  std::string error;
  if(!mm3::IO::read_closed_surface(argc > 1 ? argv[1] : CGAL::data_file_path("brain.off"), brain, &error)
     || !mm3::IO::read_closed_surface(argc > 2 ? argv[2] : CGAL::data_file_path("tumour.off"), tumor,
                                      &error)) {
    std::cerr << error << '\n';
    return EXIT_FAILURE;
  }

  // Where surfaces overlap, the first one counts: the tumor, then the brain around it.
  CGAL::Labeled_polyhedral_mixed_mesh_domain_3 domain;
  domain.add(tumor, 2);
  domain.add(brain, 1);

  // The tumor is also the region of interest: elements are small there.
  Mesh mesh;
  const CGAL::Mixed_mesh_result_3 result = CGAL::make_mixed_mesh_3(
    domain, CGAL::Polyhedral_mixed_mesh_region_3(tumor), argc > 3 ? std::stoul(argv[3]) : 1000, mesh);
  if(!result.has_mesh()) {
    std::cerr << mm3::description(result.status) << '\n';
    return EXIT_FAILURE;
  }
  for(const auto& [index, volume] : mm3::volumes_of_subdomains(mesh))
    std::cout << "subdomain " << index << ": " << volume / 1000 << " cm^3\n";

  // Interfaces are written as named faces, for boundary conditions in a finite-element program.
  mm3::IO::Write_options options;
  for(const mm3::Subdomain_interface& one : mm3::find_interfaces(mesh)) {
    std::cout << "between " << one.first << " and " << one.second << ": " << one.faces.size() << " faces, "
              << one.area << " mm^2, " << (one.is_manifold() ? "a manifold, " : "no manifold, ")
              << mm3::number_of_vertices_off_interface(mesh, one, domain) << " vertices off its surface\n";
    if(one.second != 0)
      options.facet_sets.push_back({"tumor_surface", one.faces});
  }
  if(!mm3::IO::write_mixed_mesh("subdomains.msh", mesh, options, &error)) {
    std::cerr << error << '\n';
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
} catch(const std::exception& e) {
  std::cerr << e.what() << '\n';
  return EXIT_FAILURE;
}
