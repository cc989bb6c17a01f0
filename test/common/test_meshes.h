// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes for several tests.

#ifndef MIXED_MESH_3_TEST_MESHES_H
#define MIXED_MESH_3_TEST_MESHES_H

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/quality.h>

#include <boost/core/lightweight_test.hpp>

#include <array>
#include <cstddef>
#include <random>
#include <vector>

// Adds a cell of hexahedra, or divided into elements of another kind. \param center point of the cell, for
// pyramids
template <class Mesh, class Center>
void add_cell(Mesh& mesh, const std::array<CGAL::Mixed_meshes_3::Vertex_index, 8>& v,
              CGAL::Mixed_meshes_3::Element_kind kind, const Center& center)
{
  using namespace CGAL::Mixed_meshes_3;
  if(kind == HEXAHEDRON) {
    mesh.add_element(kind, v);
  } else if(kind == PRISM) {
    mesh.add_element(kind, {v[0], v[1], v[2], v[4], v[5], v[6]});
    mesh.add_element(kind, {v[0], v[2], v[3], v[4], v[6], v[7]});
  } else if(kind == PYRAMID) {
    const Vertex_index apex = mesh.add_vertex(center());
    for(const Element_face& f : reference_elements[HEXAHEDRON].faces) // reversed, because seen from inside
      mesh.add_element(kind, {v[f.vertices[3]], v[f.vertices[2]], v[f.vertices[1]], v[f.vertices[0]], apex});
  } else { // around the diagonal, which is the same in each cell
    static constexpr int path[6][2] = {{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}};
    for(const auto& p : path)
      mesh.add_element(kind, {v[0], v[p[0]], v[p[1]], v[6]});
  }
}

// A grid of n^3 cells, of elements of one kind.
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
        add_cell(mesh, v, kind, [&] { return place(x + 0.5, y + 0.5, z + 0.5); });
      }
  return mesh;
}

// A conforming mesh with an element of each kind, in [0, 2] x [0, 1] x [0, 2].
template <class Mesh>
Mesh four_kinds(double scale, const CGAL::Mixed_meshes_3::Vec3& origin, double perturbation = 0)
{
  using namespace CGAL::Mixed_meshes_3;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-perturbation, perturbation);
  Mesh mesh;
  for(const Vec3& p : {Vec3{0, 0, 0},
                       {1, 0, 0},
                       {1, 1, 0},
                       {0, 1, 0},
                       {0, 0, 1},
                       {1, 0, 1},
                       {1, 1, 1},
                       {0, 1, 1},
                       {0.5, 0.5, 2},
                       {2, 0, 0},
                       {2, 1, 0},
                       {1.7, 0.5, 1.8}}) {
    const Vec3 q = origin + scale * (p + Vec3{uniform(random), uniform(random), uniform(random)});
    mesh.add_vertex({q[0], q[1], q[2]});
  }
  mesh.add_element(HEXAHEDRON, {0, 1, 2, 3, 4, 5, 6, 7});
  mesh.add_element(PRISM, {2, 10, 6, 1, 9, 5});
  mesh.add_element(PYRAMID, {4, 5, 6, 7, 8});
  mesh.add_element(TETRAHEDRON, {5, 6, 8, 11});
  for(std::size_t e = 0; e < 4; ++e)
    BOOST_TEST(volume(mesh, e) > 0);
  return mesh;
}

// The position of a point of a displaced mesh.
template <class Mesh, class Location>
CGAL::Mixed_meshes_3::Vec3
position(const Mesh& mesh, const std::vector<CGAL::Mixed_meshes_3::Vec3>& displacements, const Location& l)
{
  using namespace CGAL::Mixed_meshes_3;
  Vec3 x{};
  for(int i = 0; i < mesh.element(l.element).size(); ++i) {
    const Vertex_index v = mesh.element(l.element)[i];
    x = x + l.weights[i] * (to_vec3(mesh.point(v)) + displacements[v]);
  }
  return x;
}

#endif // MIXED_MESH_3_TEST_MESHES_H
