// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One atlas, two subjects: the mesh of one brain is fitted to others, such that vertices and elements have
// the same numbers in all of them.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Mixed_mesh_3/IO/write_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/certify_mesh.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/fit_mixed_mesh_to_surface.h>
#include <CGAL/make_mixed_mesh_3.h>
#include <CGAL/optimize_mixed_mesh_3.h>

#include <cstdlib>
#include <iostream>
#include <string>

namespace mm3 = CGAL::Mixed_meshes_3;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point>;
using Mesh = CGAL::Mixed_mesh_3<Kernel>;

bool fit(Mesh mesh, const Surface& subject, const std::string& file)
{
  // Algorithm 1 moves all vertices at once; then the optimization without flips keeps the elements.
  const auto fitted = CGAL::fit_mixed_mesh_to_surface(mesh, subject);
  const auto optimized = CGAL::optimize_mixed_mesh_3(mesh, subject,
                                                     CGAL::Mixed_mesh_optimization_criteria_3().flips(false));
  std::cout << file << ": " << fitted.number_of_arrived_vertices << ", then "
            << optimized.number_of_arrived_vertices << " of " << optimized.number_of_boundary_vertices
            << " boundary vertices on the surface; ARC up to " << mm3::quality_statistics(mesh).back().maximum
            << '\n';
  std::string error;
  if(!mm3::IO::write_mixed_mesh(file, mesh, {}, &error)) {
    std::cerr << error << '\n';
    return false;
  }
  return mm3::certify_mesh(mesh).is_valid()
         && optimized.number_of_arrived_vertices == optimized.number_of_boundary_vertices;
}

int main()
{
  Surface brain;
  Mesh atlas;
  if(!mm3::IO::read_closed_surface(CGAL::data_file_path("brain.off"), brain)
     || !CGAL::make_mixed_mesh_3(brain, 660, atlas).has_mesh())
    return EXIT_FAILURE;

  // The subjects: a wider and shorter brain, and a bent one. They have the position of the atlas; other
  // subjects must first be registered, because the fit is to the nearest points of the surface.
  Surface wide = brain, bent = brain;
  for(const auto v : brain.vertices()) {
    const Point& p = brain.point(v);
    wide.point(v) = Point(1.1 * p.x(), 0.92 * p.y(), 1.05 * p.z());
    bent.point(v) = Point(p.x() + 0.002 * p.y() * p.y(), p.y(), p.z() - 5);
  }
  return fit(atlas, wide, "atlas_wide.vtu") && fit(atlas, bent, "atlas_bent.vtu") ? EXIT_SUCCESS
                                                                                  : EXIT_FAILURE;
}
