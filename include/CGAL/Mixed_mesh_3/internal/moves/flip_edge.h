// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Better tetrahedra between the same vertices, in the place of an edge and its ring of tetrahedra.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MOVES_FLIP_EDGE_H
#define CGAL_MIXED_MESH_3_INTERNAL_MOVES_FLIP_EDGE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/moves/Flip_context.h>

#include <boost/container/static_vector.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The largest number of tetrahedra around an edge that is flipped. A ring of 7 vertices has 42
/// triangulations, with 10 tetrahedra instead of 7; one of 8 has 132, with 12 instead of 8.
inline constexpr int largest_ring = 7;

// Vertices of a ring, and the tetrahedra around an edge: short arrays, without allocation.
using Ring = boost::container::static_vector<Vertex_index, largest_ring + 1>;
using Ring_links = boost::container::static_vector<std::array<Vertex_index, 2>, largest_ring>;
using Ring_elements = boost::container::static_vector<Element_index, largest_ring>;

/// The ring of an edge in a flat place of the boundary, beside which there are sharp edges. An edge of the
/// boundary between the ends of the ring will replace the edge.
inline Ring open_ring(const Working_mesh& mesh, Vertex_index a, Vertex_index b, const Ring_links& links)
{
  constexpr double flat = 1e-9; // volume divided by the third power of the longest edge
  if(mesh.sharp_edges.empty() || mesh.is_sharp(a, b) || links.size() >= std::size_t(largest_ring))
    return {};
  const auto first = std::find_if(links.begin(), links.end(), [&](const auto& l) {
    return std::none_of(links.begin(), links.end(), [&](const auto& m) { return m[1] == l[0]; });
  });
  if(first == links.end())
    return {};
  Ring ring{(*first)[0]};
  for(auto next = first; next != links.end() && ring.size() <= links.size();
      next = std::find_if(links.begin(), links.end(), [&](const auto& l) { return l[0] == ring.back(); }))
    ring.push_back((*next)[1]);
  if(ring.size() != links.size() + 1)
    return {};
  const Vertex_index c = ring.front(), d = ring.back();
  const Vec3 x = mesh.points[b] - mesh.points[a], y = mesh.points[c] - mesh.points[a],
             z = mesh.points[d] - mesh.points[a];
  const double longest = (std::max)({norm(x), norm(y), norm(z)});
  if(mesh.are_on_one_sharp_line(c, d) || mesh.has_element_with(c, d)
     || std::abs(determinant(x, y, z)) > flat * longest * longest * longest)
    return {};
  return ring;
}

/// The other vertices of the tetrahedra around an edge, in order such that (a, b, r[i], r[i + 1]) is
/// positive. Empty unless all elements of the edge are tetrahedra, and the edge is inside or can be flipped
/// on the boundary: the ring of a boundary edge is open.
/// \param elements gets tetrahedra around the edge: all, if the ring is not empty
inline Ring ring_of(const Working_mesh& mesh, Vertex_index a, Vertex_index b, Ring_elements& elements)
{
  Ring_links links;
  for(Element_index e : mesh.incident[a]) {
    const Working_mesh::Element& element = mesh.elements[e];
    const int j = element.position(b);
    if(j == element.size())
      continue;
    if(element.kind != TETRAHEDRON || links.size() == std::size_t(largest_ring))
      return {};
    elements.push_back(e);
    // The permutation (a, b, c, d) has the sign of the element.
    const int i = element.position(a);
    int k = 0;
    while(k == i || k == j)
      ++k;
    const int l = 6 - i - j - k;
    const bool is_even = ((i < j) + (i < k) + (i < l) + (j < k) + (j < l) + (k < l)) % 2 == 0;
    const Vertex_index c = element.vertices[std::size_t(k)], d = element.vertices[std::size_t(l)];
    links.push_back(is_even ? std::array<Vertex_index, 2>{c, d} : std::array<Vertex_index, 2>{d, c});
  }
  if(links.size() < 3)
    return links.size() == 2 ? open_ring(mesh, a, b, links) : Ring();
  Ring ring{links[0][0]};
  while(ring.size() <= links.size()) {
    const auto next = std::find_if(links.begin(), links.end(),
                                   [&](const auto& l) { return l[0] == ring.back(); });
    if(next == links.end())
      return open_ring(mesh, a, b, links); // the edge is on the boundary
    if((*next)[1] == ring.front()) {
      if(ring.size() != links.size())
        ring.clear();
      return ring;
    }
    ring.push_back((*next)[1]);
  }
  return {};
}

/// Removes an edge by the best triangulation of its ring (Klincsek), in a transaction that is ended if the
/// edge is removed; each triangle gets a tetrahedron to either end of the edge.
template <class Quality>
bool flip_edge(Flip_context<Quality>& context, Transaction& transaction, Vertex_index a, Vertex_index b)
{
  Ring_elements old;
  const Ring ring = ring_of(context.mesh, a, b, old);
  const int n = int(ring.size());
  if(n < 3) {
    if(context.mesh.sharp_edges.empty()) // else it may depend on elements farther away
      context.note_in_vain(old, a, b);
    return false;
  }
  const auto [limit, most] = context.limits(old);
  std::array<std::array<double, largest_ring>, largest_ring> best{};
  std::array<std::array<int, largest_ring>, largest_ring> middle{};
  for(int length = 2; length < n; ++length)
    for(int i = 0; i + length < n; ++i) {
      const int k = i + length;
      best[i][k] = context.infinity;
      for(int j = i + 1; j < k; ++j) {
        double sum = best[i][j] + best[j][k];
        if(sum < limit)
          sum += context.cost({ring[i], ring[j], ring[k], b}, most);
        if(sum < limit)
          sum += context.cost({ring[k], ring[j], ring[i], a}, most);
        if(sum < limit && sum < best[i][k]) {
          best[i][k] = sum;
          middle[i][k] = j;
        }
      }
    }
  if(!(best[0][n - 1] < limit)) {
    context.note_in_vain(old, a, b);
    return false;
  }
  // Where a boundary cuts itself, a new edge or face may be there already.
  bool is_new = n > 3 || !context.mesh.has_element_with(ring[0], ring[1], ring[2]);
  std::vector<Tetrahedron> tetrahedra;
  const auto collect = [&](const auto& self, int i, int k) -> void {
    if(k - i < 2)
      return;
    is_new = is_new && (k - i == n - 1 || !context.mesh.has_element_with(ring[i], ring[k]));
    const int j = middle[i][k];
    tetrahedra.push_back({ring[i], ring[j], ring[k], b});
    tetrahedra.push_back({ring[k], ring[j], ring[i], a});
    self(self, i, j);
    self(self, j, k);
  };
  collect(collect, 0, n - 1);
  if(!is_new || !context.replace(transaction, old, tetrahedra))
    return false;
  context.number_of_removals += ring.size() > old.size(); // the boundary has other faces
  return true;
}

/// Flips the first edge of a tetrahedron that can be flipped.
template <class Quality>
bool flip_edges(Flip_context<Quality>& context, Element_index e)
{
  Transaction transaction(context.mesh);
  const auto v = context.mesh.elements[e].vertices;
  for(int i = 0; i < 4; ++i)
    for(int j = i + 1; j < 4; ++j)
      if(!context.is_in_vain(e, i, j)
         && flip_edge(context, transaction, v[std::size_t(i)], v[std::size_t(j)]))
        return true;
  return false;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MOVES_FLIP_EDGE_H
