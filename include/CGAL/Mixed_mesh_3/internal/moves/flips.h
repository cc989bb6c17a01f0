// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Replacement of tetrahedra by better ones between the same vertices: 2-3 flips, the removal of an edge with
// its ring of tetrahedra, and the removal of flat tetrahedra that lie on the boundary.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MOVES_FLIPS_H
#define CGAL_MIXED_MESH_3_INTERNAL_MOVES_FLIPS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/moves/Working_mesh.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
Flips tetrahedra if the sum of the powers of their costs falls, and none gets a cost above the bound, or, if
one is above the bound already, above the worst one. The new tetrahedra fill the space of the old ones, and
are positive by exact orientation, so conformity and validity are kept; the boundary changes only where flat
tetrahedra with two faces on it are removed, and where an edge in a flat place is flipped, if there are sharp
edges.

\tparam Quality a model of `MixedMeshQuality_3`
*/
template <class Quality>
class Tetrahedron_flipper
{
  using Tetrahedron = std::array<Vertex_index, 4>;

  Working_mesh& m_mesh;
  const Quality& m_quality;
  const double m_bound;
  double m_power = 4;
  std::size_t m_number_of_removals = 0;

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr int largest_ring = 7;
  // Cost above which tetrahedra on the boundary are removed if they can not be flipped.
  static constexpr double least_cost_to_remove = 3;
  // Least relative gain: flips that gain less are not worth the time, and might go round in circles.
  static constexpr double least_gain = 1e-6;

public:
  /// \param bound largest cost that a tetrahedron may get
  Tetrahedron_flipper(Working_mesh& mesh, const Quality& quality, double bound)
    : m_mesh(mesh), m_quality(quality), m_bound(bound)
  {
  }

  /// Tries all tetrahedra of a cost above `worst`, including new ones. Calls `changed(v)` for the vertices of
  /// new and removed tetrahedra, and returns the number of flips.
  template <class Changed>
  std::size_t run(double exponent, double worst, const Changed& changed)
  {
    m_power = exponent;
    const double least = power(worst, exponent);
    std::size_t flips = 0;
    for(Element_index e = 0; e < m_mesh.elements.size(); ++e)
      if(is_tetrahedron(e) && cost(m_mesh.elements[e].vertices.data()) > least) {
        const std::size_t first_new = m_mesh.elements.size();
        const std::array<Vertex_index, 8> vertices = m_mesh.elements[e].vertices;
        if(!try_edges(e) && !try_faces(e)) {
          if(!remove_from_boundary(e))
            continue;
          std::for_each_n(vertices.begin(), 4, changed);
        }
        ++flips;
        for(std::size_t n = first_new; n < m_mesh.elements.size(); ++n)
          for(Vertex_index v : m_mesh.elements[n])
            changed(v);
      }
    return flips;
  }

  /// The number of tetrahedra removed from the boundary or from their subdomain, and of edges removed from
  /// flat places of the boundary.
  std::size_t number_of_removals() const { return m_number_of_removals; }

private:
  bool is_tetrahedron(Element_index e) const
  {
    return !m_mesh.elements[e].is_removed && m_mesh.elements[e].kind == TETRAHEDRON;
  }

  double cost(const Vertex_index* v) const
  {
    return power(m_quality(TETRAHEDRON, m_mesh.relative_points(Element_view(TETRAHEDRON, v))), m_power);
  }

  // The cost of a new tetrahedron: infinity if it is above `most`.
  double cost(const Tetrahedron& t, double most) const
  {
    const double c = cost(t.data());
    return c <= most ? c : infinity;
  }

  // Replaces elements if the new tetrahedra are positive.
  bool replace(const std::vector<Element_index>& old, const std::vector<Tetrahedron>& tetrahedra)
  {
    Element_attributes attributes = m_mesh.elements[old.front()].attributes;
    for(Element_index e : old) {
      const Element_attributes& a = m_mesh.elements[e].attributes;
      if(a.subdomain_index != attributes.subdomain_index || are_beside_sheet(a, attributes))
        return false; // interfaces and sheets stay
      attributes.compartment = (std::max)(attributes.compartment, a.compartment);
      attributes.is_in_region = attributes.is_in_region || a.is_in_region;
    }
    if(attributes.compartment != 0 && std::any_of(old.begin(), old.end(), [&](Element_index e) {
         return would_meet_sheet(e, attributes);
       }))
      return false;
    std::vector<Working_mesh::Element> elements;
    for(const Tetrahedron& t : tetrahedra) {
      Working_mesh::Element element{TETRAHEDRON, attributes, false, {}};
      std::copy(t.begin(), t.end(), element.vertices.begin());
      if(!m_mesh.is_positive(element))
        return false;
      elements.push_back(element);
    }
    for(Element_index e : old)
      m_mesh.remove(e);
    for(const Working_mesh::Element& element : elements)
      m_mesh.add(element);
    return true;
  }

  // Whether a face of an element without compartment would be on a sheet if the element had these attributes.
  bool would_meet_sheet(Element_index e, const Element_attributes& attributes) const
  {
    if(m_mesh.elements[e].attributes.compartment != 0)
      return false;
    for(const Element_face& face : reference_elements[TETRAHEDRON].faces) {
      if(face.size == 0)
        continue;
      const auto v = [&](int i) { return m_mesh.elements[e].vertices[face.vertices[i]]; };
      if(const Working_mesh::Element* behind = element_behind(e, {v(0), v(1), v(2)});
         behind != nullptr && are_beside_sheet(behind->attributes, attributes))
        return true;
    }
    return false;
  }

  bool try_edges(Element_index e)
  {
    const auto v = m_mesh.elements[e].vertices;
    for(int i = 0; i < 4; ++i)
      for(int j = i + 1; j < 4; ++j)
        if(remove_edge(v[i], v[j]))
          return true;
    return false;
  }

  // The tetrahedra around an edge, and their other vertices, in order such that (a, b, r[i], r[i + 1]) is
  // positive. Empty unless all elements of the edge are tetrahedra, and the edge is inside or can be flipped
  // on the boundary: the ring of a boundary edge is open.
  std::vector<Vertex_index> ring_of(Vertex_index a, Vertex_index b,
                                    std::vector<Element_index>& elements) const
  {
    std::vector<std::array<Vertex_index, 2>> links;
    for(Element_index e : m_mesh.incident[a]) {
      const auto& element = m_mesh.elements[e];
      const int j = element.position(b);
      if(element.begin() + j == element.end())
        continue;
      if(element.kind != TETRAHEDRON || links.size() == std::size_t(largest_ring))
        return {};
      // The permutation (a, b, c, d) has the sign of the element.
      const int i = element.position(a);
      int k = 0;
      while(k == i || k == j)
        ++k;
      const int l = 6 - i - j - k;
      const bool is_even = ((i < j) + (i < k) + (i < l) + (j < k) + (j < l) + (k < l)) % 2 == 0;
      const Vertex_index c = element.vertices[std::size_t(k)], d = element.vertices[std::size_t(l)];
      links.push_back(is_even ? std::array<Vertex_index, 2>{c, d} : std::array<Vertex_index, 2>{d, c});
      elements.push_back(e);
    }
    if(links.size() < 3)
      return links.size() == 2 ? open_ring(a, b, links) : std::vector<Vertex_index>();
    std::vector<Vertex_index> ring{links[0][0]};
    while(ring.size() <= links.size()) {
      const auto next = std::find_if(links.begin(), links.end(),
                                     [&](const auto& l) { return l[0] == ring.back(); });
      if(next == links.end())
        return open_ring(a, b, links); // the edge is on the boundary
      if((*next)[1] == ring.front())
        return ring.size() == links.size() ? ring : std::vector<Vertex_index>();
      ring.push_back((*next)[1]);
    }
    return {};
  }

  // The ring of an edge in a flat place of the boundary, beside which there are sharp edges. An edge of the
  // boundary between the ends of the ring will replace the edge.
  std::vector<Vertex_index> open_ring(Vertex_index a, Vertex_index b,
                                      const std::vector<std::array<Vertex_index, 2>>& links) const
  {
    constexpr double flat = 1e-9; // volume divided by the third power of the longest edge
    if(m_mesh.sharp_edges.empty() || m_mesh.is_sharp(a, b) || links.size() >= std::size_t(largest_ring))
      return {};
    const auto first = std::find_if(links.begin(), links.end(), [&](const auto& l) {
      return std::none_of(links.begin(), links.end(), [&](const auto& m) { return m[1] == l[0]; });
    });
    if(first == links.end())
      return {};
    std::vector<Vertex_index> ring{(*first)[0]};
    for(auto next = first; next != links.end() && ring.size() <= links.size();
        next = std::find_if(links.begin(), links.end(), [&](const auto& l) { return l[0] == ring.back(); }))
      ring.push_back((*next)[1]);
    if(ring.size() != links.size() + 1)
      return {};
    const Vertex_index c = ring.front(), d = ring.back();
    const bool are_on_one_line = m_mesh.strata[c] == m_mesh.strata[d]
                                 && m_mesh.strata[c] >= first_sharp_stratum;
    const bool are_joined = std::any_of(m_mesh.incident[c].begin(), m_mesh.incident[c].end(),
                                        [&](Element_index e) {
                                          const Working_mesh::Element& element = m_mesh.elements[e];
                                          return element.position(d) < element.size();
                                        });
    const Vec3 x = m_mesh.points[b] - m_mesh.points[a], y = m_mesh.points[c] - m_mesh.points[a],
               z = m_mesh.points[d] - m_mesh.points[a];
    const double longest = (std::max)({norm(x), norm(y), norm(z)});
    if(are_on_one_line || are_joined || std::abs(determinant(x, y, z)) > flat * longest * longest * longest)
      return {};
    return ring;
  }

  // Removes an edge by the best triangulation of its ring (Klincsek); each triangle gets a tetrahedron to
  // either end of the edge.
  bool remove_edge(Vertex_index a, Vertex_index b)
  {
    std::vector<Element_index> old;
    const std::vector<Vertex_index> ring = ring_of(a, b, old);
    const int n = int(ring.size());
    if(n < 3)
      return false;
    double before = 0, most = power(m_bound, m_power);
    for(Element_index e : old) {
      const double c = cost(m_mesh.elements[e].vertices.data());
      before += c;
      most = (std::max)(most, c);
    }
    const double limit = (1 - least_gain) * before;
    std::array<std::array<double, largest_ring>, largest_ring> best{};
    std::array<std::array<int, largest_ring>, largest_ring> middle{};
    for(int length = 2; length < n; ++length)
      for(int i = 0; i + length < n; ++i) {
        const int k = i + length;
        best[i][k] = infinity;
        for(int j = i + 1; j < k; ++j) {
          double sum = best[i][j] + best[j][k];
          if(sum < limit)
            sum += cost({ring[i], ring[j], ring[k], b}, most);
          if(sum < limit)
            sum += cost({ring[k], ring[j], ring[i], a}, most);
          if(sum < limit && sum < best[i][k]) {
            best[i][k] = sum;
            middle[i][k] = j;
          }
        }
      }
    if(!(best[0][n - 1] < limit))
      return false;
    std::vector<Tetrahedron> tetrahedra;
    const auto collect = [&](const auto& self, int i, int k) -> void {
      if(k - i < 2)
        return;
      const int j = middle[i][k];
      tetrahedra.push_back({ring[i], ring[j], ring[k], b});
      tetrahedra.push_back({ring[k], ring[j], ring[i], a});
      self(self, i, j);
      self(self, j, k);
    };
    collect(collect, 0, n - 1);
    if(!replace(old, tetrahedra))
      return false;
    m_number_of_removals += ring.size() > old.size(); // the boundary has other faces
    return true;
  }

  // Whether there is neither an interface nor a sheet between two elements.
  static bool are_on_one_side(const Element_attributes& a, const Element_attributes& b)
  {
    return a.subdomain_index == b.subdomain_index && !are_beside_sheet(a, b);
  }

  // Whether another element on the same side has all of some vertices.
  bool is_shared(Element_index e, std::initializer_list<Vertex_index> vertices) const
  {
    const std::vector<Element_index>& around = m_mesh.incident[*vertices.begin()];
    const Element_attributes& mine = m_mesh.elements[e].attributes;
    return std::any_of(around.begin(), around.end(), [&](Element_index other) {
      const Working_mesh::Element& element = m_mesh.elements[other];
      return other != e && are_on_one_side(element.attributes, mine)
             && std::all_of(vertices.begin(), vertices.end(), [&](Vertex_index v) {
                  return std::find(element.begin(), element.end(), v) != element.end();
                });
    });
  }

  // Whether the edge belongs to a face of only one element.
  bool is_edge_of_boundary(Vertex_index a, Vertex_index b) const
  {
    for(Element_index e : m_mesh.incident[a]) {
      const Working_mesh::Element& element = m_mesh.elements[e];
      const Reference_element& reference = element.reference();
      for(int f = 0; f < reference.number_of_faces; ++f) {
        const Element_face& face = reference.faces[f];
        const auto v = [&](int i) { return element.vertices[face.vertices[i % face.size]]; };
        for(int i = 0; i < face.size; ++i)
          if(((v(i) == a && v(i + 1) == b) || (v(i) == b && v(i + 1) == a))
             && !is_shared(e, {v(0), v(1), v(2)}))
            return true;
      }
    }
    return false;
  }

  // Removes a tetrahedron with two faces on the boundary of its subdomain, which meet in the edge ab: the
  // other two faces replace them. The boundary stays a manifold if the edge between the other two faces is
  // not on it yet. On the boundary of the mesh the tetrahedron is removed; on an interface or a sheet the
  // tetrahedron goes to the other side if the edge can be flipped there.
  bool remove_from_boundary(Element_index e)
  {
    if(cost(m_mesh.elements[e].vertices.data()) < power(least_cost_to_remove, m_power))
      return false;
    const std::array<Vertex_index, 8> v = m_mesh.elements[e].vertices;
    if(!std::all_of(v.begin(), v.begin() + 4, [this](Vertex_index u) { return m_mesh.is_on_boundary(u); }))
      return false;
    constexpr int edges[6][4] = {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2},
                                 {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}};
    for(const auto& k : edges) {
      const Vertex_index a = v[k[0]], b = v[k[1]], c = v[k[2]], d = v[k[3]];
      if(is_shared(e, {a, b}) || !is_shared(e, {a, c, d}) || !is_shared(e, {b, c, d})
         || is_edge_of_boundary(c, d))
        continue;
      if(m_mesh.is_sharp(a, b)
         || (m_mesh.strata[c] == m_mesh.strata[d] && m_mesh.strata[c] >= first_sharp_stratum))
        continue; // two points of a sharp edge would be joined past those between
      const Working_mesh::Element *first = element_behind(e, {a, b, c}),
                                  *second = element_behind(e, {a, b, d});
      if(first == nullptr && second == nullptr) {
        m_mesh.remove(e);
        ++m_number_of_removals;
        return true;
      }
      if(first == nullptr || second == nullptr
         || first->attributes.subdomain_index != second->attributes.subdomain_index
         || first->attributes.compartment != second->attributes.compartment)
        continue;
      Element_attributes there = m_mesh.elements[e].attributes;
      there.subdomain_index = first->attributes.subdomain_index;
      there.compartment = first->attributes.compartment;
      const Element_attributes before = std::exchange(m_mesh.elements[e].attributes, there);
      if(remove_edge(a, b)) {
        ++m_number_of_removals;
        return true;
      }
      m_mesh.elements[e].attributes = before;
    }
    return false;
  }

  // The other element of a face; null if there is none.
  const Working_mesh::Element* element_behind(Element_index e, const std::array<Vertex_index, 3>& face) const
  {
    for(Element_index other : m_mesh.incident[face[0]]) {
      const Working_mesh::Element& element = m_mesh.elements[other];
      if(other != e && element.position(face[1]) < element.size()
         && element.position(face[2]) < element.size())
        return &element;
    }
    return nullptr;
  }

  bool try_faces(Element_index e)
  {
    const Reference_element& reference = reference_elements[TETRAHEDRON];
    for(int i = 0; i < 4; ++i) {
      const auto v = m_mesh.elements[e].vertices;
      // The face is opposite to vertex 3 - i.
      const auto& f = reference.faces[i].vertices;
      const Vertex_index a = v[f[0]], b = v[f[1]], c = v[f[2]];
      const Vertex_index d = v[std::size_t(6 - f[0] - f[1] - f[2])];
      for(Element_index other : m_mesh.incident[a])
        if(other != e && is_tetrahedron(other)) {
          const auto& o = m_mesh.elements[other];
          if(o.position(b) == 4 || o.position(c) == 4)
            continue;
          const Vertex_index apex =
            o.vertices[std::size_t(6 - o.position(a) - o.position(b) - o.position(c))];
          // The face (a, b, c) is seen counter-clockwise from outside, where the apex is.
          const std::vector<Tetrahedron> tetrahedra{{a, b, d, apex}, {b, c, d, apex}, {c, a, d, apex}};
          const double first = cost(v.data()), second = cost(o.vertices.data());
          const double limit = (1 - least_gain) * (first + second);
          const double most = (std::max)({power(m_bound, m_power), first, second});
          double sum = 0;
          for(const Tetrahedron& t : tetrahedra)
            if(sum < limit)
              sum += cost(t, most);
          if(sum < limit && replace({e, other}, tetrahedra))
            return true;
          break;
        }
    }
    return false;
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MOVES_FLIPS_H
