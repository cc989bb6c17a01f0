// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Input and output with exact numbers: a surface with coordinates like 1/3, and a mesh whose volume, summed
// over its elements and over its boundary, is the same to the last bit.

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/split_to_tetrahedra.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/make_mixed_mesh_3.h>

#include <array>
#include <cstdlib>
#include <iostream>

namespace mm3 = CGAL::Mixed_meshes_3;
using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point_3 = Kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point_3>;
using Mesh = CGAL::Mixed_mesh_3<Kernel>;

int main()
{
  // An octahedron whose vertices are no doubles. The domain rounds the vertices, once; from then on all
  // predicates are exact.
  const Kernel::FT a = Kernel::FT(1) / 3;
  const std::array<Point_3, 6> p = {Point_3(a, 0, 0),  Point_3(0, a, 0), Point_3(-a, 0, 0),
                                    Point_3(0, -a, 0), Point_3(0, 0, a), Point_3(0, 0, -a)};
  Surface surface;
  for(const Point_3& point : p)
    surface.add_vertex(point);
  using V = Surface::Vertex_index;
  for(unsigned i = 0; i < 4; ++i) {
    surface.add_face(V(i), V((i + 1) % 4), V(4));
    surface.add_face(V((i + 1) % 4), V(i), V(5));
  }

  // Regions have no kernel of their own: the region is the upper tip, a ball about a point that is also
  // rounded.
  const CGAL::Polyhedral_mixed_mesh_domain_3 domain(surface);
  const CGAL::Ball_mixed_mesh_region_3 tip(p[4], 0.15);
  Mesh mesh;
  if(!CGAL::make_mixed_mesh_3(domain, tip, 1000, mesh).has_mesh())
    return EXIT_FAILURE;

  // Vertices are doubles, so exact arithmetic on vertices has no error.
  const Mesh tetrahedra = mm3::split_to_tetrahedra(mesh);
  Kernel::FT inside = 0, through_boundary = 0;
  for(mm3::Element_index e = 0; e < tetrahedra.number_of_elements(); ++e) {
    const auto t = tetrahedra.element(e);
    inside += CGAL::volume(tetrahedra.point(t[0]), tetrahedra.point(t[1]), tetrahedra.point(t[2]),
                           tetrahedra.point(t[3]));
    inside.exact(); // evaluates the sum, so that its terms need not be stored
  }
  for(const mm3::Face& face : mm3::boundary_faces(tetrahedra)) {
    const auto& v = face.vertices();
    through_boundary += CGAL::volume(Point_3(0, 0, 0), tetrahedra.point(v[0]), tetrahedra.point(v[1]),
                                     tetrahedra.point(v[2]));
    through_boundary.exact();
  }
  std::cout << mesh.number_of_vertices() << " vertices, volume " << inside.exact() << '\n'
            << (inside == through_boundary ? "equals" : "differs from") << " the flux through the boundary\n";
  return inside == through_boundary ? EXIT_SUCCESS : EXIT_FAILURE;
}
