// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes of tetrahedra of any topology, from cells of a grid.

#ifndef CGAL_MIXED_MESH_3_TEST_CELLS_H
#define CGAL_MIXED_MESH_3_TEST_CELLS_H

#include "test_fitting.h"

#include <CGAL/Mixed_mesh_3/Element_attributes.h>

#include <array>
#include <cstddef>
#include <functional>
#include <random>
#include <vector>

namespace cells {

using namespace CGAL::Mixed_meshes_3;

using Cell = std::array<int, 3>;

// The cells of a grid of tetrahedra that belong to a subdomain other than 0.
inline Mesh cells_of_grid(int n, unsigned seed, const std::function<Subdomain_index(const Cell&)>& subdomain)
{
  Mesh all = grid(n, TETRAHEDRON);
  distort(all, 0.1 / n, seed);
  Mesh mesh;
  std::vector<Vertex_index> numbers(all.number_of_vertices(), internal::no_vertex);
  for(Element_index e = 0; e < all.number_of_elements(); ++e) {
    const int cell = int(e) / 6;
    const Subdomain_index index = subdomain({cell % n, cell / n % n, cell / n / n});
    if(index == 0)
      continue;
    std::array<Vertex_index, 4> v{};
    for(int i = 0; i < 4; ++i) {
      Vertex_index& number = numbers[all.element(e)[i]];
      if(number == internal::no_vertex)
        number = mesh.add_vertex(all.point(all.element(e)[i]));
      v[std::size_t(i)] = number;
    }
    Element_attributes attributes;
    attributes.subdomain_index = index;
    mesh.add_element(TETRAHEDRON, v, attributes);
  }
  return mesh;
}

// The cells of a grid of three along each axis, but some at random: there are bodies, handles and cavities,
// if the boundary is a manifold.
inline Mesh random_cells(unsigned seed, std::mt19937& random)
{
  std::array<bool, 27> is_there{};
  for(bool& b : is_there)
    b = random() % 8 != 0;
  return cells_of_grid(3, seed, [&](const Cell& c) {
    return is_there[std::size_t(c[0] + 3 * c[1] + 9 * c[2])] ? 1 : 0;
  });
}

} // namespace cells

#endif // CGAL_MIXED_MESH_3_TEST_CELLS_H
