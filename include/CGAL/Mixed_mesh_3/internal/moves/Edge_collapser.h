// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Edge collapses: a vertex is removed, and all of its elements get the other end of one of its edges instead.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MOVES_EDGE_COLLAPSER_H
#define CGAL_MIXED_MESH_3_INTERNAL_MOVES_EDGE_COLLAPSER_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/moves/Transaction.h>

#include <boost/container/static_vector.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
Collapses edges if all elements stay positive and good enough; whether the topology is kept is asked before.

The tetrahedra at an edge vw are removed, and w replaces v in all other elements of v. The topology is kept if
the links of both vertices have exactly the link of the edge in common (link condition; Dey, Edelsbrunner,
Guha, Nekhayev: Topology preserving edge contraction, 1999), in the mesh and on the boundary of the subdomain
of v, to which all elements of v have to belong. The elements at the edge must be tetrahedra. There must be no
sheets.

\tparam Quality a model of `MixedMeshQuality_3`
*/
template <class Quality>
class Edge_collapser
{
  Working_mesh& m_mesh;
  const Quality& m_quality;
  using Share = boost::container::static_vector<Vertex_index, 8>;
  // Kept as members to reuse their memory: the time at which each vertex was marked, and of elements the
  // vertices in the link of the edge.
  std::vector<std::uint32_t> m_marks;
  std::uint32_t m_time = 0;
  std::vector<Share> m_shares;

  static constexpr double infinity = std::numeric_limits<double>::infinity();

public:
  /// The vertices of a face, sorted, with `no_vertex` as the fourth vertex of a triangle.
  using Face_key = std::array<Vertex_index, 4>;

  Edge_collapser(Working_mesh& mesh, const Quality& quality) : m_mesh(mesh), m_quality(quality) {}

  bool is_in_one_subdomain(Vertex_index v) const
  {
    const auto around = m_mesh.incident[v];
    return std::all_of(around.begin(), around.end(),
                       [&](Element_index e) { return subdomain(e) == subdomain(around.front()); });
  }

  /// The faces at a vertex that belong to only one element of a subdomain, sorted.
  std::vector<Face_key> boundary_faces_at(Vertex_index v, Subdomain_index index) const
  {
    std::vector<Face_key> all, alone;
    for(Element_index e : m_mesh.incident[v]) {
      if(subdomain(e) != index)
        continue;
      const Working_mesh::Element& element = m_mesh.elements[e];
      const Reference_element& reference = element.reference();
      for(int f = 0; f < reference.number_of_faces; ++f) {
        Face_key key;
        key.fill(no_vertex);
        for(int i = 0; i < reference.faces[f].size; ++i)
          key[std::size_t(i)] = element.vertices[std::size_t(reference.faces[f].vertices[i])];
        std::sort(key.begin(), key.end());
        if(std::find(key.begin(), key.end(), v) != key.end())
          all.push_back(key);
      }
    }
    std::sort(all.begin(), all.end());
    for(std::size_t i = 0; i < all.size(); ++i)
      if((i == 0 || all[i - 1] != all[i]) && (i + 1 == all.size() || all[i + 1] != all[i]))
        alone.push_back(all[i]);
    return alone;
  }

  /// The boundary faces of the subdomain of the vertex.
  /// \pre `is_in_one_subdomain(v)`
  std::vector<Face_key> boundary_faces_at(Vertex_index v) const
  {
    return boundary_faces_at(v, subdomain(m_mesh.incident[v].front()));
  }

  /// The vertices that share a boundary edge with a vertex of these faces, if the edge is between two
  /// triangles.
  static std::vector<Vertex_index> ends_of_edges(Vertex_index v, const std::vector<Face_key>& faces)
  {
    std::vector<Vertex_index> ends = neighbors(v, faces);
    ends.erase(std::remove_if(ends.begin(), ends.end(),
                              [&](Vertex_index w) {
                                int triangles = 0;
                                for(const Face_key& face : faces)
                                  if(std::find(face.begin(), face.end(), w) != face.end())
                                    triangles += face[3] == no_vertex ? 1 : 3;
                                return triangles != 2;
                              }),
               ends.end());
    return ends;
  }

  /// Whether the topological types of the mesh and of its boundary are kept.
  /// \pre `is_in_one_subdomain(v)`
  /// \param faces_at_v `boundary_faces_at(v)`; if there are any, w is one of `ends_of_edges()`
  bool keeps_topology(Vertex_index v, Vertex_index w, const std::vector<Face_key>& faces_at_v)
  {
    return is_link_of_edge(v, w)
           && (faces_at_v.empty()
               || is_link_of_boundary_edge(v, w, faces_at_v,
                                           boundary_faces_at(w, subdomain(m_mesh.incident[v].front()))));
  }

  /// The link condition in the mesh. All elements at the edge are tetrahedra.
  bool is_link_of_edge(Vertex_index v, Vertex_index w)
  {
    if(m_marks.size() < m_mesh.points.size())
      m_marks.resize(m_mesh.points.size(), 0);
    m_time += 2; // marks of vertices around v are this, of those around the edge one more
    m_shares.clear();
    for(Element_index e : m_mesh.incident[v])
      if(has(e, w)) {
        if(m_mesh.elements[e].kind != TETRAHEDRON)
          return false;
        for(Vertex_index u : m_mesh.elements[e])
          m_marks[u] = m_time + 1;
      }
    for(Element_index e : m_mesh.incident[v])
      if(!has(e, w)) {
        for(Vertex_index u : m_mesh.elements[e])
          m_marks[u] = (std::max)(m_marks[u], m_time);
        note_share(e, v);
      }
    const std::size_t number_of_v = m_shares.size();
    for(Element_index e : m_mesh.incident[w])
      if(!has(e, v)) {
        for(Vertex_index u : m_mesh.elements[e])
          if(m_marks[u] == m_time)
            return false;
        note_share(e, w);
      }
    // Common vertices of elements are in the link of the edge: only two or more of them matter.
    for(std::size_t i = 0; i < number_of_v; ++i)
      for(std::size_t j = number_of_v; j < m_shares.size(); ++j) {
        const Share &a = m_shares[i], &b = m_shares[j];
        Share common;
        std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
        if(common.size() > 2 || (common.size() == 2 && !is_tetrahedron(v, w, common[0], common[1])))
          return false;
      }
    return true;
  }

  /// The largest cost of the new elements; infinity if the cost is above `most` or an element is not
  /// positive.
  double worst_after(Vertex_index v, Vertex_index w, double most) const
  {
    double worst = 0;
    for(Element_index e : m_mesh.incident[v])
      if(!has(e, w)) {
        const Working_mesh::Element element = m_mesh.elements[e].with_other_vertex(v, w);
        worst = (std::max)(worst, m_quality(element.kind, m_mesh.relative_points(element)));
        if(!(worst <= most) || !m_mesh.is_positive(element))
          return infinity;
      }
    return worst;
  }

  /// The largest cost of the elements of a vertex.
  double worst_at(Vertex_index v) const
  {
    double worst = 0;
    for(Element_index e : m_mesh.incident[v])
      worst = (std::max)(worst,
                         m_quality(m_mesh.elements[e].kind, m_mesh.relative_points(m_mesh.elements[e])));
    return worst;
  }

  /// Collapses the edge vw, so that w takes the place of v, if all new elements are positive and cost at most
  /// `most`. \pre `keeps_topology(v, w)`
  bool operator()(Vertex_index v, Vertex_index w, double most)
  {
    Transaction transaction(m_mesh);
    if(m_mesh.is_sharp(v, w)) // two edges of a polyline become one
      for(Vertex_index u : m_mesh.sharp_neighbors(v))
        if(u != w)
          transaction.set_sharp_edge(u, w, m_mesh.sharp_stratum(u, v));
    const std::vector<Element_index> around(m_mesh.incident[v].begin(), m_mesh.incident[v].end());
    for(Element_index e : around) {
      transaction.remove(e);
      if(!has(e, w))
        transaction.add(m_mesh.elements[e].with_other_vertex(v, w));
    }
    transaction.merge(v);
    return transaction.accept(m_quality, most);
  }

private:
  bool has(Element_index e, Vertex_index v) const { return m_mesh.elements[e].has(v); }

  Subdomain_index subdomain(Element_index e) const { return m_mesh.elements[e].attributes.subdomain_index; }

  // The other vertices of boundary faces of v.
  static std::vector<Vertex_index> neighbors(Vertex_index v, const std::vector<Face_key>& faces)
  {
    std::vector<Vertex_index> all;
    for(const Face_key& face : faces)
      for(Vertex_index u : face)
        if(u != v && u != no_vertex)
          all.push_back(u);
    sort_uniquely(all);
    return all;
  }

  static void sort_uniquely(std::vector<Vertex_index>& vertices)
  {
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  }

  // Notes the vertices that an element has in the link of the edge, if there are two or more.
  void note_share(Element_index e, Vertex_index end)
  {
    Share share;
    for(Vertex_index u : m_mesh.elements[e])
      if(u != end && m_marks[u] == m_time + 1)
        share.push_back(u);
    if(share.size() < 2)
      return;
    std::sort(share.begin(), share.end());
    m_shares.push_back(share);
  }

  // \pre all elements that have the first two vertices are tetrahedra
  bool is_tetrahedron(Vertex_index v, Vertex_index w, Vertex_index a, Vertex_index b) const
  {
    const auto around = m_mesh.incident[v];
    return std::any_of(around.begin(), around.end(),
                       [&](Element_index e) { return has(e, w) && has(e, a) && has(e, b); });
  }

  static bool is_link_of_boundary_edge(Vertex_index v, Vertex_index w,
                                       const std::vector<Face_key>& faces_at_v,
                                       const std::vector<Face_key>& faces_at_w)
  {
    if(common(neighbors(v, faces_at_v), neighbors(w, faces_at_w)).size() != 2)
      return false;
    return std::none_of(faces_at_v.begin(), faces_at_v.end(), [&](Face_key face) {
      if(std::find(face.begin(), face.end(), w) != face.end())
        return false;
      std::replace(face.begin(), face.end(), v, w);
      std::sort(face.begin(), face.end());
      return std::binary_search(faces_at_w.begin(), faces_at_w.end(), face);
    });
  }

  static std::vector<Vertex_index> common(const std::vector<Vertex_index>& a,
                                          const std::vector<Vertex_index>& b)
  {
    std::vector<Vertex_index> c;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(c));
    return c;
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MOVES_EDGE_COLLAPSER_H
