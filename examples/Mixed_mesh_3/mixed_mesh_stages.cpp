// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stages of the mesher, each called alone: between two of them, or instead of one, there may be code of
// one's own. A stage passes a mesh on to the next one, and no other data.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Mixed_mesh_3/surface_distance.h>
#include <CGAL/Mixed_mesh_3/validation.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/make_mixed_mesh_3.h>
#include <CGAL/optimize_mixed_mesh_3.h>
#include <CGAL/simplify_mixed_mesh_3.h>

#include <cstdlib>
#include <iostream>

namespace mm3 = CGAL::Mixed_meshes_3;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Mesh = CGAL::Mixed_mesh_3<Kernel>;

// Prints what a stage has made. Returns whether the mesh is valid.
bool print(const char* stage, const Mesh& mesh, const Surface& surface)
{
  std::cout << stage << ": " << mesh.number_of_vertices() << " vertices, "
            << mm3::hausdorff_distance(mesh, surface).distance() << " mm from the surface, largest cost "
            << mm3::quality_statistics(mesh).back().maximum << '\n';
  return mm3::find_defects(mesh).none();
}

int main()
{
  Surface brain;
  if(!mm3::IO::read_closed_surface(CGAL::data_file_path("brain.off"), brain))
    return EXIT_FAILURE;
  const CGAL::Polyhedral_mixed_mesh_domain_3 domain(brain); // made once for all stages

  // Octree, transitions and boundary: a mesh of tetrahedra near to the surface, with vertices on a lattice.
  Mesh fine;
  const auto criteria = CGAL::Mixed_mesh_criteria_3(6000).fit_to_surface(false).only_tetrahedra(true);
  if(!CGAL::make_mixed_mesh_3(domain, criteria, fine).has_mesh() || !print("octree", fine, brain))
    return EXIT_FAILURE;

  // Onto the surface. fit_mixed_mesh_to_surface() would do that with Algorithm 1 of the paper.
  CGAL::optimize_mixed_mesh_3(fine, domain);
  if(!print("on the surface", fine, brain))
    return EXIT_FAILURE;

  // Fewer vertices, and better elements.
  Mesh mesh = fine;
  auto result = CGAL::simplify_mixed_mesh_3(mesh, domain, 2000);
  if(result.status != CGAL::Mixed_mesh_simplification_status::SUCCESS || !print("2000 vertices", mesh, brain))
    return EXIT_FAILURE;
  CGAL::optimize_mixed_mesh_3(mesh, domain);
  if(!print("better elements", mesh, brain))
    return EXIT_FAILURE;

  // As few vertices as a distance allows: no vertex of the fine mesh is farther from the boundary.
  for(const double distance : {0.5, 1., 2.}) {
    mesh = fine;
    const auto limits = CGAL::Mixed_mesh_simplification_criteria_3(0).distance(distance);
    result = CGAL::simplify_mixed_mesh_3(mesh, domain, limits);
    std::cout << distance << " mm from the fine mesh: " << result.number_of_vertices << " vertices, "
              << result.number_of_collapses << " edges collapsed\n";
    if(!mm3::find_defects(mesh).none())
      return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
