// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Brain shift in six steps, from three surfaces and four measured points to the brain after the resection of
// a tumor: section 6.2 of Lobos, Bucki, Hitschfeld, Payan: "Mixed-element mesh for an intra-operative
// modeling of the brain tumor extraction". All lengths are in mm.
//
//   elasticity_of_brain_shift [VERTICES]

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Linear_elasticity_3.h>
#include <CGAL/Mixed_mesh_3/IO/read_closed_surface.h>
#include <CGAL/Mixed_mesh_3/IO/write_mixed_mesh.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/resect.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/make_mixed_mesh_3.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace mm3 = CGAL::Mixed_meshes_3;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Mesh = CGAL::Mixed_mesh_3<Kernel>;
using Elasticity = CGAL::Linear_elasticity_3<Mesh>;
using Vector = mm3::Vec3;

Surface read(const std::string& name)
{
  Surface surface;
  std::string error;
  if(!mm3::IO::read_closed_surface(CGAL::data_file_path(name), surface, &error))
    throw std::runtime_error(error);
  return surface;
}

void check(const CGAL::Linear_elasticity_result_3& result)
{
  if(!result.is_success())
    throw std::runtime_error(result.description());
}

double largest(const std::vector<Vector>& displacements)
{
  double length = 0;
  for(const Vector& u : displacements)
    length = (std::max)(length, std::hypot(u[0], u[1], u[2]));
  return length;
}

int main(int argc, char** argv)
try {
  // 1. The mesh is fine on the path from the opening in the skull to the tumor.
  const Surface brain = read("brain.off"), path = read("region.off"), tumor = read("tumour.off");
  Mesh mesh;
  if(!CGAL::make_mixed_mesh_3(brain, path, argc > 1 ? std::stoul(argv[1]) : 2000, mesh).has_mesh())
    throw std::runtime_error("no mesh with so few vertices");
  std::cout << "mesh: " << mesh.number_of_vertices() << " vertices, " << mesh.number_of_elements()
            << " elements\n";

  // 2. The boundary conditions: the brain rests on the base of the skull; the rest of its surface is free.
  //    Young's modulus is 1 kPa, Poisson's ratio 0.45: the defaults.
  Elasticity elasticity(mesh);
  const CGAL::Bbox_3 box = CGAL::Polygon_mesh_processing::bbox(brain);
  for(mm3::Vertex_index v : mm3::boundary_vertices(mesh))
    if(mesh.point(v).z() < box.zmin() + 0.3 * (box.zmax() - box.zmin()))
      elasticity.prescribe(v);

  // 3. The factorization: all computations that depend on the mesh only, before surgery.
  check(elasticity.factor());

  // 4. Surgery: the skull is open. Four points of the cortex are measured before and after the shift, here 10
  //    mm inwards on the path to the tumor. The points need not be vertices; they may be up to 5 mm outside
  //    the mesh. The first call sets the points; the second call, which takes little time, sets their
  //    displacements, and can be repeated when these change.
  const std::vector<Vector> points{{43.633, 24.044, 49.096},
                                   {35.245, 31.664, 49.283},
                                   {29.646, 24.914, 57.660},
                                   {38.404, 17.573, 58.562}};
  const std::vector<Vector> measured(points.size(), Vector{-3.132, -2.349, -9.202});
  check(elasticity.set_control_points(points, 5));
  check(elasticity.solve(measured));
  const std::vector<Vector> shift = elasticity.displacements();
  std::cout << "shift: up to " << largest(shift) << " mm\n";

  // 5. The resection: elements in the tumor are removed, and the mesh is solved without them. Supports and
  //    control points stay.
  const mm3::Resection_3 resection = mm3::resect(mesh, tumor);
  if(resection.status != mm3::Resection_status::SUCCESS)
    throw std::runtime_error(mm3::description(resection.status));
  check(elasticity.remove_elements(resection.is_removed));
  check(elasticity.solve(measured));
  std::cout << "resection: " << resection.volume / 1000 << " ml; shift: up to "
            << largest(elasticity.displacements()) << " mm\n";

  // 6. The file for ParaView has the displacements of vertices, and the elements that are removed.
  std::vector<double> displacements, is_removed(resection.is_removed.begin(), resection.is_removed.end());
  for(const Vector& u : elasticity.displacements())
    displacements.insert(displacements.end(), u.begin(), u.end());
  mm3::IO::Write_options data;
  data.vertex_data = {{"displacement", &displacements, 3}};
  data.element_data = {{"resected", &is_removed}};
  std::string error;
  if(!mm3::IO::write_mixed_mesh("elasticity_of_brain_shift.vtu", mesh, data, &error))
    throw std::runtime_error(error);
  return EXIT_SUCCESS;
} catch(const std::exception& e) {
  std::cerr << e.what() << '\n';
  return EXIT_FAILURE;
}
