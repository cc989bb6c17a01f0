// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A material for each subdomain, a mesh from a file, and a user-defined solver: a stiff tumor bends less.

#include <CGAL/Eigen_solver_traits.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Labeled_polyhedral_mixed_mesh_domain_3.h>
#include <CGAL/Linear_elasticity_3.h>
#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Mixed_mesh_3/IO/read_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/IO/write_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/make_mixed_mesh_3.h>
#include <Eigen/IterativeLinearSolvers>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <vector>

namespace mm3 = CGAL::Mixed_meshes_3;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Mixed_mesh_3<Kernel>;
// Any model of SparseLinearAlgebraWithFactorTraits_d suffices. This one needs little memory, but iterates.
using Solver = CGAL::Eigen_solver_traits<
  Eigen::ConjugateGradient<CGAL::Eigen_sparse_symmetric_matrix<double>::EigenType, Eigen::Lower>>;

// The largest relative change of length of an edge of the tumor's elements.
double strain(const Mesh& mesh, const std::vector<mm3::Vec3>& u)
{
  double largest = 0;
  for(mm3::Element_index e = 0; e < mesh.number_of_elements(); ++e)
    for(int i = 0; mesh.subdomain_index(e) == 2 && i < mesh.element(e).reference().number_of_edges; ++i) {
      const auto& edge = mesh.element(e).reference().edges[i];
      const mm3::Vertex_index a = mesh.element(e)[edge[0]], b = mesh.element(e)[edge[1]];
      const Kernel::Vector_3 d = mesh.point(b) - mesh.point(a);
      const Kernel::Vector_3 change(u[b][0] - u[a][0], u[b][1] - u[a][1], u[b][2] - u[a][2]);
      largest = (std::max)(largest, std::abs(d * change) / d.squared_length());
    }
  return largest;
}

int main()
{
  // The mesh with two subdomains comes from a file with labels, as read_mixed_mesh() reads of Gmsh or TetGen.
  CGAL::Surface_mesh<Kernel::Point_3> brain, tumor;
  Mesh made, mesh;
  CGAL::Labeled_polyhedral_mixed_mesh_domain_3 domain;
  if(!mm3::IO::read_closed_surface(CGAL::data_file_path("brain.off"), brain)
     || !mm3::IO::read_closed_surface(CGAL::data_file_path("tumour.off"), tumor))
    return EXIT_FAILURE;
  domain.add(tumor, 2);
  domain.add(brain, 1);
  if(!CGAL::make_mixed_mesh_3(domain, tumor, 800, made).has_mesh()
     || !mm3::IO::write_mixed_mesh("materials.msh", made) || !mm3::IO::read_mixed_mesh("materials.msh", mesh))
    return EXIT_FAILURE;
  double strains[2];
  for(const bool is_stiff : {false, true}) {
    const mm3::Elastic_material tissue, stiff{100, 0.45}; // 1 and 100 kPa
    CGAL::Linear_elasticity_3<Mesh, Solver> elasticity(
      mesh, mm3::materials_of_elements(mesh, {{1, tissue}, {2, is_stiff ? stiff : tissue}}));
    elasticity.solver().solver().setTolerance(1e-8);
    for(const mm3::Vertex_index v : mm3::boundary_vertices(mesh))
      if(mesh.point(v).z() < -20)
        elasticity.prescribe(v);
    elasticity.set_gravity({0, 0, -400}); // mm/s^2: 4 % of the weight; buoyancy balances the rest
    if(!elasticity.factor().is_success() || !elasticity.solve().is_success())
      return EXIT_FAILURE;
    strains[is_stiff] = strain(mesh, elasticity.displacements());
    std::cout << (is_stiff ? "stiff" : "as the rest") << ": strain in the tumor up to " << strains[is_stiff]
              << '\n';
  }
  return strains[1] < strains[0] / 5 ? EXIT_SUCCESS : EXIT_FAILURE;
}
