// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes that several tests start from.

#ifndef MIXED_MESH_3_TEST_MESHES_H
#define MIXED_MESH_3_TEST_MESHES_H

#include <CGAL/Mixed_mesh_3.h>

#include <array>

// n^3 cells, of elements of one kind.
// place: Mesh::Point_3(double, double, double), from coordinates in cells; called for each vertex once, in
// the order of the vertices
template <class Mesh, class Place>
Mesh grid_of_cells(int n, CGAL::Mixed_meshes_3::Element_kind kind, const Place& place)
{
  using namespace CGAL::Mixed_meshes_3;
  Mesh mesh;
  for(int z = 0; z <= n; ++z)
    for(int y = 0; y <= n; ++y)
      for(int x = 0; x <= n; ++x)
        mesh.add_vertex(place(x, y, z));
  const auto vertex = [&](int x, int y, int z) { return Vertex_index(x + (n + 1) * (y + (n + 1) * z)); };
  for(int z = 0; z < n; ++z)
    for(int y = 0; y < n; ++y)
      for(int x = 0; x < n; ++x) {
        std::array<Vertex_index, 8> v{};
        for(int i = 0; i < 8; ++i) {
          const auto& c = reference_elements[HEXAHEDRON].coordinates[i];
          v[i] = vertex(x + (c[0] + 1) / 2, y + (c[1] + 1) / 2, z + (c[2] + 1) / 2);
        }
        if(kind == HEXAHEDRON) {
          mesh.add_element(kind, v);
        } else if(kind == PRISM) {
          mesh.add_element(kind, {v[0], v[1], v[2], v[4], v[5], v[6]});
          mesh.add_element(kind, {v[0], v[2], v[3], v[4], v[6], v[7]});
        } else if(kind == PYRAMID) {
          const Vertex_index center = mesh.add_vertex(place(x + 0.5, y + 0.5, z + 0.5));
          for(const Element_face& f : reference_elements[HEXAHEDRON].faces) // seen from inside: reversed
            mesh.add_element(kind,
                             {v[f.vertices[3]], v[f.vertices[2]], v[f.vertices[1]], v[f.vertices[0]], center});
        } else { // around the diagonal, the same in each cell
          static constexpr int path[6][2] = {{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}};
          for(const auto& p : path)
            mesh.add_element(kind, {v[0], v[p[0]], v[p[1]], v[6]});
        }
      }
  return mesh;
}

#endif // MIXED_MESH_3_TEST_MESHES_H
