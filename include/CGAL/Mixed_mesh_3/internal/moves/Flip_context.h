// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What flips have in common: costs, and the replacement of tetrahedra by others that fill their space.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MOVES_FLIP_CONTEXT_H
#define CGAL_MIXED_MESH_3_INTERNAL_MOVES_FLIP_CONTEXT_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/moves/Transaction.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

using Tetrahedron = std::array<Vertex_index, 4>;

/// The mesh, and the costs by which flips are chosen, which are powers of those of the quality.
template <class Quality>
struct Flip_context
{
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  // Least relative gain: flips that gain less are not worth the time, and might go round in circles.
  // It is 1e10 roundings of 2^-53, and costs are sums of fewer terms.
  static constexpr double least_gain = 1e-6;

  Working_mesh& mesh;
  const Quality& quality;
  const double bound; ///< largest cost that a tetrahedron may get
  double exponent = 4;
  std::size_t number_of_removals = 0; ///< see `Tetrahedron_flipper::number_of_removals()`
  /// Bits for the edges of each tetrahedron that were tried in vain: until something around an edge changes,
  /// it need not be tried from each of the tetrahedra around it.
  std::vector<std::uint8_t> edges_in_vain = {};
  /// Costs of the first elements, if they are tetrahedra: each is asked for from all of its edges and faces.
  /// Elements keep their vertices, and vertices their positions, while flips run.
  std::vector<double> costs = {};

  bool is_tetrahedron(Element_index e) const
  {
    return !mesh.elements[e].is_removed && mesh.elements[e].kind == TETRAHEDRON;
  }

  double cost(const Vertex_index* v) const
  {
    return power(quality(TETRAHEDRON, mesh.relative_points(Element_view(TETRAHEDRON, v))), exponent);
  }

  /// The cost of a tetrahedron of the mesh.
  double cost_of(Element_index e) const
  {
    return e < costs.size() ? costs[e] : cost(mesh.elements[e].vertices.data());
  }

  /// Computes the costs of elements that the mesh has more than before.
  void add_costs()
  {
    for(Element_index e = Element_index(costs.size()); e < mesh.elements.size(); ++e)
      costs.push_back(is_tetrahedron(e) ? cost(mesh.elements[e].vertices.data()) : 0);
  }

  /// Whether the edge of the vertices i and j of a tetrahedron was tried in vain. \pre i < j
  bool is_in_vain(Element_index e, int i, int j) const
  {
    return e < edges_in_vain.size() && (edges_in_vain[e] & bit_of_edge(i, j)) != 0;
  }

  /// Notes that an edge of these tetrahedra was tried in vain.
  template <class Elements>
  void note_in_vain(const Elements& tetrahedra, Vertex_index a, Vertex_index b)
  {
    for(Element_index e : tetrahedra)
      if(e < edges_in_vain.size()) {
        const auto [i, j] = std::minmax({mesh.elements[e].position(a), mesh.elements[e].position(b)});
        edges_in_vain[e] = std::uint8_t(edges_in_vain[e] | bit_of_edge(i, j));
      }
  }

  /// Forgets what was tried in vain around a vertex of a tetrahedron that has changed.
  void forget_around(Vertex_index v)
  {
    edges_in_vain.resize(mesh.elements.size(), 0);
    for(Element_index e : mesh.incident[v])
      edges_in_vain[e] = 0;
  }

  /// The cost of a new tetrahedron: infinity if it is above `most`.
  double cost(const Tetrahedron& t, double most) const
  {
    const double c = cost(t.data());
    return c <= most ? c : infinity;
  }

  /// The limits of new tetrahedra: of the sum of their costs, and of each.
  struct Limits
  {
    double sum, each;
  };

  template <class Elements>
  Limits limits(const Elements& old) const
  {
    double before = 0, most = power(bound, exponent);
    for(Element_index e : old) {
      const double c = cost_of(e);
      before += c;
      most = (std::max)(most, c);
    }
    return {(1 - least_gain) * before, most};
  }

  /// Replaces tetrahedra by others that fill the same space, and ends the transaction.
  template <class Elements, class Tetrahedra>
  bool replace(Transaction& transaction, const Elements& old, const Tetrahedra& tetrahedra) const
  {
    Element_attributes attributes = mesh.elements[*old.begin()].attributes;
    for(Element_index e : old) {
      const Element_attributes& a = mesh.elements[e].attributes;
      if(a.subdomain_index != attributes.subdomain_index || are_beside_sheet(a, attributes))
        return false; // interfaces and sheets stay
      attributes.compartment = (std::max)(attributes.compartment, a.compartment);
      attributes.is_in_region = attributes.is_in_region || a.is_in_region;
    }
    if(attributes.compartment != 0 && std::any_of(old.begin(), old.end(), [&](Element_index e) {
         return would_meet_sheet(e, attributes);
       }))
      return false;
    for(Element_index e : old)
      transaction.remove(e);
    for(const Tetrahedron& t : tetrahedra)
      transaction.add({TETRAHEDRON, false, attributes, {t[0], t[1], t[2], t[3]}});
    return transaction.accept(quality, (std::max)(bound, transaction.worst_before(quality)));
  }

  /// The other element of a face; null if there is none.
  const Working_mesh::Element* element_behind(Element_index e, const std::array<Vertex_index, 3>& face) const
  {
    for(Element_index other : mesh.incident[face[0]])
      if(other != e && mesh.elements[other].has(face[1]) && mesh.elements[other].has(face[2]))
        return &mesh.elements[other];
    return nullptr;
  }

private:
  static unsigned bit_of_edge(int i, int j) { return 1u << (i == 0 ? j - 1 : i + j); }

  // Whether a face of an element without compartment would be on a sheet if the element had these attributes.
  bool would_meet_sheet(Element_index e, const Element_attributes& attributes) const
  {
    if(mesh.elements[e].attributes.compartment != 0)
      return false;
    for(const Element_face& face : reference_elements[TETRAHEDRON].faces) {
      if(face.size == 0)
        continue;
      const auto v = [&](int i) { return mesh.elements[e].vertices[face.vertices[i]]; };
      if(const Working_mesh::Element* behind = element_behind(e, {v(0), v(1), v(2)});
         behind != nullptr && are_beside_sheet(behind->attributes, attributes))
        return true;
    }
    return false;
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MOVES_FLIP_CONTEXT_H
