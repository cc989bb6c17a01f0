// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The boundary stage as a whole: order the vertices, split, look for pinched places, relabel, again.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_BOUNDARY_BOUNDARY_STAGE_H
#define CGAL_MIXED_MESH_3_INTERNAL_BOUNDARY_BOUNDARY_STAGE_H

#include <CGAL/Mixed_mesh_3/internal/transitions/Lattice_mesh.h>
#include <CGAL/Mixed_mesh_3/internal/elements/manifold_defects.h>
#include <CGAL/Mixed_mesh_3/internal/base/parallel_for.h>
#include <CGAL/Mixed_mesh_3/internal/boundary/split_by_order.h>
#include <CGAL/Mixed_mesh_3/internal/boundary/split_by_parity.h>
#include <CGAL/Mixed_mesh_3/options.h>

#include <CGAL/assertions.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

namespace internal {

/// What the boundary stage made of a lattice mesh: elements replaced by pieces.
struct Boundary_pieces
{
  Element_list pieces;
  std::vector<Element_index> origins;    ///< for each piece, the element it comes from; sorted
  std::vector<std::uint8_t> is_replaced; ///< for each element, whether its pieces stand for it
  std::vector<std::uint8_t> is_used;     ///< for each vertex, whether the result has it
  std::size_t number_of_vertices = 0;    ///< of the result
  std::size_t number_of_relabeled_vertices = 0;
  std::size_t number_of_inserted_vertices = 0;
  Manifold_defects defects; ///< that relabeling could not repair
};

template <class Octree_>
class Boundary_stage : private Boundary_pieces
{
  const Octree_& m_located;
  Lattice_mesh& m_mesh;
  const Boundary_mode m_mode;
  const unsigned m_threads;
  std::vector<Element_index> m_outer; // elements that have a vertex not inside
  std::vector<double> m_distances;    // of vertices not inside, where asked for
  std::vector<std::uint32_t> m_ranks;

  static constexpr std::uint32_t last_rank = std::uint32_t(-1);

public:
  Boundary_stage(const Octree_& located, Lattice_mesh& mesh, Boundary_mode mode, unsigned threads)
    : m_located(located), m_mesh(mesh), m_mode(mode), m_threads(threads)
  {
    for(Element_index e = 0; e < mesh.elements.size(); ++e)
      if(!has_only_inside_vertices(mesh.elements[e]))
        m_outer.push_back(e);
    m_distances.assign(mesh.vertices.size(), -1);
    m_ranks.assign(mesh.vertices.size(), last_rank);
    const std::size_t first_inserted = mesh.vertices.size();
    do {
      while(mesh.vertices.size() > first_inserted)
        mesh.remove_last_vertex();
      rank_vertices();
      split_elements();
      defects = manifold_defects(boundary_polygons());
    } while(relabel());
    number_of_inserted_vertices = mesh.vertices.size() - first_inserted;
    count_vertices();
  }

  Boundary_pieces result() && { return std::move(*this); }

private:
  // Works for vertices inserted later too.
  auto inside() const
  {
    return [this](Vertex_index v) { return m_mesh.is_inside(v); };
  }

  bool has_inside_vertex(const Element_view& element) const
  {
    return std::any_of(element.begin(), element.end(), inside());
  }

  bool has_only_inside_vertices(const Element_view& element) const
  {
    return std::all_of(element.begin(), element.end(), inside());
  }

  // The order: vertices outside first, nearest to the surface first, ties by lattice position.
  void rank_vertices()
  {
    std::vector<Vertex_index> outside;
    std::fill(m_ranks.begin(), m_ranks.end(), last_rank);
    for(Element_index e : m_outer) {
      const Element_view element = m_mesh.elements[e];
      if(has_inside_vertex(element))
        for(Vertex_index v : element)
          if(!m_mesh.is_inside(v) && m_ranks[v] == last_rank) {
            m_ranks[v] = 0;
            outside.push_back(v);
          }
    }
    parallel_for(outside.size(), m_threads, [&](std::size_t i) {
      const Vertex_index v = outside[i];
      if(m_distances[v] < 0)
        m_distances[v] = m_mesh.sides[v] == ON_BOUNDARY ? 0 : distance(v);
    });
    std::vector<std::tuple<double, std::uint64_t, Vertex_index>> order;
    for(Vertex_index v : outside)
      order.emplace_back(m_located.quantized(m_distances[v]), lattice_key(m_mesh.vertices[v]), v);
    std::sort(order.begin(), order.end());
    for(std::size_t i = 0; i < order.size(); ++i)
      m_ranks[std::get<2>(order[i])] = std::uint32_t(i);
  }

  double distance(Vertex_index v) const
  {
    const auto p = m_located.point(m_mesh.vertices[v]);
    const auto q = m_located.domain().closest_point(p, m_located.surface_part(m_mesh.leaves[v]));
    return std::sqrt(CGAL::squared_distance(p, q));
  }

  void split_elements()
  {
    pieces = Element_list();
    origins.clear();
    is_replaced.assign(m_mesh.elements.size(), 0);
    for(Element_index e : m_outer) // all its vertices may have been labeled inside since
      is_replaced[e] = !has_only_inside_vertices(m_mesh.elements[e]);
    if(m_mode == Boundary_mode::PAPER) {
      const auto meets_surface = [&](Element_index e) {
        return m_located.side(m_mesh.cells[e]) == ON_BOUNDARY;
      };
      Parity_splitter(m_mesh, meets_surface)([&](Element_index e, Element_kind kind,
                                                 const Vertex_index* v) { add_piece(e, kind, v); },
                                             is_replaced);
    } else {
      for(Element_index e : m_outer) {
        const Element_view element = m_mesh.elements[e];
        if(is_replaced[e] && has_inside_vertex(element))
          split_element(
            element, [&](Vertex_index v) { return m_ranks[v]; }, inside(),
            [&](Element_kind kind, std::initializer_list<Vertex_index> v) { add_piece(e, kind, v.begin()); });
      }
    }
  }

  void add_piece(Element_index origin, Element_kind kind, const Vertex_index* v)
  {
    if(has_inside_vertex(Element_view(kind, v))) {
      pieces.add(kind, v);
      origins.push_back(origin);
    }
  }

  // Every vertex inside has all its elements, so the boundary is among the faces with none.
  std::vector<Face_vertices> boundary_polygons() const
  {
    std::vector<std::pair<std::array<Vertex_index, 3>, Face_vertices>> faces;
    for(std::size_t i = 0; i < pieces.size(); ++i) {
      const Element_view piece = pieces[i];
      for(int f = 0; f < piece.reference().number_of_faces; ++f) {
        const Face_vertices vertices = Face(pieces, Element_index(i), f).vertices();
        if(std::none_of(vertices.begin(), vertices.end(), inside())) {
          CGAL_assertion(vertices.size() == 3);
          std::array<Vertex_index, 3> key{vertices[0], vertices[1], vertices[2]};
          std::sort(key.begin(), key.end());
          faces.emplace_back(key, vertices);
        }
      }
    }
    std::sort(faces.begin(), faces.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Face_vertices> polygons;
    for(std::size_t i = 0; i < faces.size(); ++i)
      if((i == 0 || faces[i - 1].first != faces[i].first)
         && (i + 1 == faces.size() || faces[i + 1].first != faces[i].first))
        polygons.push_back(faces[i].second);
    return polygons;
  }

  // Labels pinched vertices inside; of a bad edge, the end nearer to the surface.
  bool relabel()
  {
    std::vector<Vertex_index> candidates = defects.vertices;
    for(const auto& [a, b] : defects.edges) {
      const bool first = m_mesh.is_on_rim[b] || (!m_mesh.is_on_rim[a] && m_ranks[a] < m_ranks[b]);
      candidates.push_back(first ? a : b);
    }
    bool changed = false;
    for(Vertex_index v : candidates)
      if(!m_mesh.is_on_rim[v] && !m_mesh.is_inside(v)) {
        m_mesh.sides[v] = ON_BOUNDED_SIDE;
        ++number_of_relabeled_vertices;
        changed = true;
      }
    return changed;
  }

  void count_vertices()
  {
    is_used.assign(m_mesh.vertices.size(), 0);
    for(Vertex_index v = 0; v < is_used.size(); ++v)
      is_used[v] = m_mesh.is_inside(v);
    for(Vertex_index v : pieces.connectivity())
      is_used[v] = 1;
    number_of_vertices = std::size_t(std::count(is_used.begin(), is_used.end(), 1));
  }
};

/*!
Runs the boundary stage. The result keeps exactly the elements that have a vertex inside, in pieces
where they have others too, so that all boundary vertices are outside (or on) the surface. Pinched
boundary vertices are labeled inside until the boundary is a closed oriented 2-manifold; \c defects
tells what remains: it can only be where a leaf around the vertex has no elements, at the border of the
root cell or beside dead leaves.

\param mesh the labels of pinched vertices change; in the paper's mode vertices are added
\cost O(n + m log m) for n elements, m of them at the surface, plus m closest-point queries
*/
template <class Octree_>
Boundary_pieces split_boundary(const Octree_& octree, Lattice_mesh& mesh, Boundary_mode mode,
                               unsigned threads = 1)
{
  return Boundary_stage<Octree_>(octree, mesh, mode, threads).result();
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_BOUNDARY_BOUNDARY_STAGE_H
