// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A mesh of CGAL's Mesh_3, with slivers: it is certified, improved, and used for elasticity.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Linear_elasticity_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/cells_in_complex_3_to_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/certify_mesh.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Polyhedral_mesh_domain_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/make_mesh_3.h>
#include <CGAL/optimize_mixed_mesh_3.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>

namespace mm3 = CGAL::Mixed_meshes_3;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Mesh = CGAL::Mixed_mesh_3<Kernel>;
using Domain = CGAL::Polyhedral_mesh_domain_3<Surface, Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

void print(const char* when, const Mesh& mesh)
{
  const mm3::Quality_statistics all = mm3::quality_statistics(mesh).back();
  std::cout << when << ": " << mesh.number_of_elements() << " tetrahedra, aspect-ratio coefficient "
            << all.mean << " in the mean, " << all.maximum << " at most\n";
}

int main()
try {
  Surface brain;
  std::string error;
  if(!mm3::IO::read_closed_surface(CGAL::data_file_path("brain.off"), brain, &error))
    throw std::runtime_error(error);

  // Sizes are in mm. The mesh is made without perturbation and exudation.
  const Domain domain(brain);
  const Criteria criteria(Criteria::Facet_criteria(25, 20, 4), Criteria::Cell_criteria(2, 20));
  const auto complex = CGAL::make_mesh_3<Complex>(domain, criteria, CGAL::parameters::no_perturb(),
                                                  CGAL::parameters::no_exude());
  Mesh mesh;
  CGAL::cells_in_complex_3_to_mixed_mesh(complex, mesh);
  print("Mesh_3", mesh);

  // Vertices move and tetrahedra are flipped; no tetrahedron is inverted at any time.
  CGAL::optimize_mixed_mesh_3(mesh, brain, CGAL::Mixed_mesh_optimization_criteria_3());
  print("optimized", mesh);
  if(!mm3::certify_mesh(mesh).is_valid())
    throw std::runtime_error("the mesh is not valid");

  // It rests on its lower part, and weighs 4 % more than the fluid around it: 0.39 Pa per mm. E is 1 kPa.
  CGAL::Linear_elasticity_3<Mesh> elasticity(mesh);
  for(const mm3::Vertex_index v : mm3::boundary_vertices(mesh))
    if(mesh.point(v).z() < -20)
      elasticity.prescribe(v);
  if(!elasticity.factor().is_success())
    throw std::runtime_error("the stiffness matrix cannot be factored");
  elasticity.set_body_force({0, 0, -3.9e-4});
  elasticity.solve();
  double largest = 0;
  for(const mm3::Vec3& u : elasticity.displacements())
    largest = (std::max)(largest, std::hypot(u[0], u[1], u[2]));
  std::cout << "it sinks by up to " << largest << " mm\n";
  return EXIT_SUCCESS;
} catch(const std::exception& e) {
  std::cerr << e.what() << '\n';
  return EXIT_FAILURE;
}
