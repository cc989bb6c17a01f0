// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One vertex of the boundary less, where it can not get to the surface but one beside it has.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FITTING_MERGE_BOUNDARY_VERTICES_H
#define CGAL_MIXED_MESH_3_INTERNAL_FITTING_MERGE_BOUNDARY_VERTICES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/fitting/Working_mesh.h>

#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
Merges a vertex of the boundary with the end of one of its edges there (edge collapse): the tetrahedra at that
edge vanish, and all other elements of the vertex get its end instead.

The topology stays if the links of both vertices have in common what is the link of the edge, and nothing else
(Dey, Edelsbrunner, Guha, Nekhayev: Topology preserving edge contraction, 1999), in the mesh as on its
boundary: here, that of the subdomain of all elements of the vertex. Those of both vertices must be
tetrahedra. There must be no sheets.

\tparam Quality a model of `MixedMeshQuality_3`
*/
template <class Quality>
class Boundary_vertex_merger
{
  using Face_key = std::array<Vertex_index, 4>; // sorted, no_vertex for what a triangle lacks

  Working_mesh& m_mesh;
  const Quality& m_quality;
  const double m_worst;

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr double far_share = 0.6; // of an edge

public:
  /// \param worst no element gets a larger cost
  Boundary_vertex_merger(Working_mesh& mesh, const Quality& quality, double worst)
    : m_mesh(mesh), m_quality(quality), m_worst(worst)
  {
  }

  /// \param place of the surface near the vertex, from which the new faces shall not be far: not farther than
  ///        the vertex is, or than a share of an edge
  /// \param is_candidate whether the vertex may be merged with that one
  /// \return the vertex with which it was merged, where the worst new element is best; `no_vertex`: none
  template <class Is_candidate>
  Vertex_index operator()(Vertex_index v, const Vec3& place, const Is_candidate& is_candidate)
  {
    const std::vector<Element_index>& around = m_mesh.incident[v];
    const Subdomain_index index = subdomain(around.front());
    if(std::any_of(around.begin(), around.end(), [&](Element_index e) { return subdomain(e) != index; }))
      return no_vertex;
    const std::vector<Face_key> faces = boundary_faces_at(v, index);
    Vertex_index best = no_vertex;
    double least = std::nextafter(m_worst, infinity); // of which it is less
    for(Vertex_index w : ends_of_edges(v, faces))
      if(is_candidate(w) && keeps_topology(v, w, faces) && is_near(place, v, w, faces)) {
        const double worst = worst_after(v, w, least);
        if(worst < least) {
          best = w;
          least = worst;
        }
      }
    if(best != no_vertex)
      merge(v, best);
    return best;
  }

private:
  bool has(Element_index e, Vertex_index v) const
  {
    const Working_mesh::Element& element = m_mesh.elements[e];
    return element.position(v) < element.size();
  }

  Subdomain_index subdomain(Element_index e) const { return m_mesh.elements[e].attributes.subdomain_index; }

  // The faces at a vertex that one element of a subdomain has alone.
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

  // The other vertices of boundary faces.
  static std::vector<Vertex_index> neighbors(Vertex_index v, const std::vector<Face_key>& faces)
  {
    std::vector<Vertex_index> all;
    for(const Face_key& face : faces)
      for(Vertex_index u : face)
        if(u != v && u != no_vertex)
          all.push_back(u);
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  // Of edges between two triangles.
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

  bool keeps_topology(Vertex_index v, Vertex_index w, const std::vector<Face_key>& faces_at_v) const
  {
    std::vector<std::array<Vertex_index, 4>> at_edge; // sorted
    std::vector<Vertex_index> around_v, around_w, around_edge;
    const auto add = [](std::vector<Vertex_index>& vertices, const Working_mesh::Element& element) {
      vertices.insert(vertices.end(), element.begin(), element.end());
    };
    for(Element_index e : m_mesh.incident[v]) {
      const Working_mesh::Element& element = m_mesh.elements[e];
      add(around_v, element);
      if(!has(e, w))
        continue;
      if(element.kind != TETRAHEDRON)
        return false;
      add(around_edge, element);
      at_edge.push_back({element.vertices[0], element.vertices[1], element.vertices[2], element.vertices[3]});
      std::sort(at_edge.back().begin(), at_edge.back().end());
    }
    for(Element_index e : m_mesh.incident[w])
      add(around_w, m_mesh.elements[e]);
    for(std::vector<Vertex_index>* vertices : {&around_v, &around_w, &around_edge}) {
      std::sort(vertices->begin(), vertices->end());
      vertices->erase(std::unique(vertices->begin(), vertices->end()), vertices->end());
    }
    if(common(around_v, around_w) != around_edge)
      return false;
    for(Element_index e : m_mesh.incident[v])
      for(Element_index f : m_mesh.incident[w])
        if(!has(e, w) && !has(f, v)) {
          const std::vector<Vertex_index> both = common(sorted_vertices(e), sorted_vertices(f));
          if(both.size() > 2)
            return false;
          if(both.size() == 2) {
            std::array<Vertex_index, 4> tetrahedron{v, w, both[0], both[1]};
            std::sort(tetrahedron.begin(), tetrahedron.end());
            if(std::find(at_edge.begin(), at_edge.end(), tetrahedron) == at_edge.end())
              return false;
          }
        }
    const std::vector<Face_key> faces_at_w = boundary_faces_at(w, subdomain(m_mesh.incident[v].front()));
    if(common(neighbors(v, faces_at_v), neighbors(w, faces_at_w)).size() != 2)
      return false;
    for(Face_key face : faces_at_v)
      if(std::find(face.begin(), face.end(), w) == face.end()) {
        std::replace(face.begin(), face.end(), v, w);
        std::sort(face.begin(), face.end());
        if(std::binary_search(faces_at_w.begin(), faces_at_w.end(), face))
          return false;
      }
    return true;
  }

  std::vector<Vertex_index> sorted_vertices(Element_index e) const
  {
    std::vector<Vertex_index> v(m_mesh.elements[e].begin(), m_mesh.elements[e].end());
    std::sort(v.begin(), v.end());
    return v;
  }

  static std::vector<Vertex_index> common(const std::vector<Vertex_index>& a,
                                          const std::vector<Vertex_index>& b)
  {
    std::vector<Vertex_index> c;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(c));
    return c;
  }

  Working_mesh::Element with_other_vertex(Element_index e, Vertex_index v, Vertex_index w) const
  {
    Working_mesh::Element element = m_mesh.elements[e];
    element.vertices[std::size_t(element.position(v))] = w;
    return element;
  }

  // The largest cost of the new elements, infinity if it is above `most` or one is not positive.
  double worst_after(Vertex_index v, Vertex_index w, double most) const
  {
    double worst = 0;
    for(Element_index e : m_mesh.incident[v])
      if(!has(e, w)) {
        const Working_mesh::Element element = with_other_vertex(e, v, w);
        worst = (std::max)(worst, m_quality(element.kind, m_mesh.relative_points(element)));
        if(!(worst <= most) || !m_mesh.is_positive(element))
          return infinity;
      }
    return worst;
  }

  bool is_near(const Vec3& place, Vertex_index v, Vertex_index w, const std::vector<Face_key>& faces) const
  {
    using Kernel = CGAL::Simple_cartesian<double>;
    const auto point = [&](Vertex_index u) {
      const Vec3& p = m_mesh.points[u];
      return Kernel::Point_3(p[0], p[1], p[2]);
    };
    const double far_enough = (std::max)(norm(m_mesh.points[v] - place),
                                         far_share * norm(m_mesh.points[v] - m_mesh.points[w]));
    const Kernel::Point_3 p(place[0], place[1], place[2]);
    return std::any_of(faces.begin(), faces.end(), [&](const Face_key& face) {
      if(std::find(face.begin(), face.end(), w) != face.end())
        return false; // it vanishes
      std::vector<Kernel::Point_3> q;
      for(Vertex_index u : face)
        if(u != v && u != no_vertex)
          q.push_back(point(u));
      const auto is_near_triangle = [&](std::size_t i, std::size_t j) {
        return CGAL::squared_distance(p, Kernel::Triangle_3(point(w), q[i], q[j])) <= far_enough * far_enough;
      };
      return is_near_triangle(0, 1) || (q.size() > 2 && (is_near_triangle(1, 2) || is_near_triangle(0, 2)));
    });
  }

  void merge(Vertex_index v, Vertex_index w)
  {
    const std::vector<Element_index> around = m_mesh.incident[v];
    for(Element_index e : around) {
      const Working_mesh::Element element = has(e, w) ? m_mesh.elements[e] : with_other_vertex(e, v, w);
      const bool stays = !has(e, w);
      m_mesh.remove(e);
      if(stays)
        m_mesh.add(element);
    }
    m_mesh.strata[v] = free_stratum;
    m_mesh.merged.push_back(v);
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FITTING_MERGE_BOUNDARY_VERTICES_H
