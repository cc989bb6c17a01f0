// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Topology and validity of meshes of all kinds of elements, by brute force.

#ifndef MIXED_MESH_3_TEST_TOPOLOGY_H
#define MIXED_MESH_3_TEST_TOPOLOGY_H

#include "test_grids.h"

#include <CGAL/Exact_rational.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

namespace brute_force {

using namespace CGAL::Mixed_meshes_3;

using Vertices = std::vector<Vertex_index>; // sorted
using Betti_numbers = std::array<int, 4>;

inline Vertices sorted(Vertices v)
{
  std::sort(v.begin(), v.end());
  return v;
}

// The faces of an element, each as its vertices in order.
inline std::vector<Vertices> polygons(const Element_view& element)
{
  const Reference_element& reference = reference_elements[element.kind()];
  std::vector<Vertices> result(std::size_t(reference.number_of_faces));
  for(std::size_t f = 0; f < result.size(); ++f)
    for(int i = 0; i < reference.faces[f].size; ++i)
      result[f].push_back(element[reference.faces[f].vertices[i]]);
  return result;
}

// The cells of each dimension, which are known by their vertices, with the cells of their boundaries.
class Complex
{
  struct Cell
  {
    int number;
    std::vector<int> boundary; // descending
  };
  std::array<std::map<Vertices, Cell>, 4> m_cells;

  int add(std::size_t dimension, const Vertices& v, std::vector<int> boundary)
  {
    std::map<Vertices, Cell>& cells = m_cells[dimension];
    std::sort(boundary.rbegin(), boundary.rend());
    return cells.emplace(v, Cell{int(cells.size()), std::move(boundary)}).first->second.number;
  }

public:
  int add_edge(Vertex_index a, Vertex_index b)
  {
    return add(1, sorted({a, b}), {add(0, {a}, {}), add(0, {b}, {})});
  }

  // \param polygon vertices in order around a face
  int add_face(const Vertices& polygon)
  {
    std::vector<int> edges;
    for(std::size_t i = 0; i < polygon.size(); ++i)
      edges.push_back(add_edge(polygon[i], polygon[(i + 1) % polygon.size()]));
    return add(2, sorted(polygon), edges);
  }

  void add_element(const Element_view& element)
  {
    std::vector<int> faces;
    for(const Vertices& polygon : polygons(element))
      faces.push_back(add_face(polygon));
    add(3, sorted({element.begin(), element.end()}), faces);
  }

  // Betti numbers over Z/2: the numbers of cells, minus the ranks of the boundary maps.
  Betti_numbers betti_numbers() const
  {
    std::array<int, 5> ranks{};
    for(std::size_t d = 1; d < 4; ++d) {
      std::vector<std::vector<int>> reduced(m_cells[d - 1].size()); // by the last row
      for(const auto& [v, cell] : m_cells[d]) {
        std::vector<int> column = cell.boundary;
        while(!column.empty() && !reduced[std::size_t(column.front())].empty()) {
          std::vector<int> sum;
          const std::vector<int>& other = reduced[std::size_t(column.front())];
          std::set_symmetric_difference(column.begin(), column.end(), other.begin(), other.end(),
                                        std::back_inserter(sum), std::greater<int>());
          column.swap(sum);
        }
        if(!column.empty()) {
          ++ranks[d];
          reduced[std::size_t(column.front())] = column;
        }
      }
    }
    Betti_numbers betti{};
    for(std::size_t d = 0; d < 4; ++d)
      betti[d] = int(m_cells[d].size()) - ranks[d] - ranks[d + 1];
    return betti;
  }
};

// Betti numbers of a mesh, or of one of its subdomains, and of its boundary.
inline std::array<Betti_numbers, 2> topology(const Mesh& mesh, Subdomain_index subdomain = 0)
{
  Complex elements, boundary;
  std::map<Vertices, std::pair<int, Vertices>> faces; // by sorted vertices: number of elements, polygon
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
    if(subdomain == 0 || mesh.attributes(e).subdomain_index == subdomain) {
      elements.add_element(mesh.element(e));
      for(const Vertices& polygon : polygons(mesh.element(e))) {
        auto& [number, first] = faces[sorted(polygon)];
        ++number;
        first = polygon;
      }
    }
  for(const auto& [vertices, face] : faces)
    if(face.first == 1)
      boundary.add_face(face.second);
  return {elements.betti_numbers(), boundary.betti_numbers()};
}

// Whether each face belongs to at most two elements, which are on its two sides, and each edge of the
// boundary to an even number of faces.
inline bool is_conforming(const Mesh& mesh)
{
  std::map<Vertices, std::vector<Vertices>> faces; // seen from each element, from the smallest vertex on
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
    for(Vertices v : polygons(mesh.element(e))) {
      std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
      faces[sorted(v)].push_back(v);
    }
  std::map<Vertices, int> edges;
  for(auto& [vertices, seen] : faces) {
    if(seen.size() > 2)
      return false;
    Vertices& v = seen.front();
    if(seen.size() == 2) {
      std::reverse(v.begin() + 1, v.end());
      if(v != seen.back())
        return false;
    } else {
      for(std::size_t i = 0; i < v.size(); ++i)
        ++edges[sorted({v[i], v[(i + 1) % v.size()]})];
    }
  }
  return std::all_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.second % 2 == 0; });
}

// Whether the Jacobians are positive at the corners of an element, by rationals: for tetrahedra, whether they
// are positive.
inline bool has_positive_corners(const Mesh& mesh, Element_index e)
{
  using Q = CGAL::Exact_rational;
  const Element_view element = mesh.element(e);
  const Reference_element& reference = reference_elements[element.kind()];
  std::array<std::array<Q, 3>, 8> p;
  for(int i = 0; i < element.size(); ++i)
    for(int k = 0; k < 3; ++k)
      p[std::size_t(i)][std::size_t(k)] = Q(mesh.point(element[i])[k]);
  const int corners = element.kind() == TETRAHEDRON ? 1 : reference.number_of_corners;
  for(int c = 0; c < corners; ++c) {
    const auto& corner = reference.corners[c];
    const auto d = [&](int i, std::size_t k) { return Q(p[corner[i]][k] - p[corner[0]][k]); };
    const Q volume = d(1, 0) * (d(2, 1) * d(3, 2) - d(2, 2) * d(3, 1))
                     - d(1, 1) * (d(2, 0) * d(3, 2) - d(2, 2) * d(3, 0))
                     + d(1, 2) * (d(2, 0) * d(3, 1) - d(2, 1) * d(3, 0));
    if(!(volume > 0))
      return false;
  }
  return true;
}

inline bool has_positive_corners(const Mesh& mesh)
{
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e)
    if(!has_positive_corners(mesh, e))
      return false;
  return true;
}

} // namespace brute_force

#endif // MIXED_MESH_3_TEST_TOPOLOGY_H
