// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The boundary stage as in section 5.2 of the paper, for comparison: every element that meets the
// surface becomes tetrahedra, and the diagonals propagate.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_BOUNDARY_SPLIT_BY_PARITY_H
#define CGAL_MIXED_MESH_3_INTERNAL_BOUNDARY_SPLIT_BY_PARITY_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/transitions/Lattice_mesh.h>

#include <CGAL/enum.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
Splits by parity: the diagonal of a square joins its two even corners, so that cubes of one size become five
tetrahedra each and agree. Elsewhere an existing diagonal decides:

- a pyramid becomes two tetrahedra;
- a prism becomes a pyramid and a tetrahedron, or three tetrahedra, and adds as few diagonals as possible
(none if two of its diagonals meet), which its neighbors then see;
- a hexahedron, and a prism whose three diagonals do not meet, get a vertex at their center.
*/
template <class Meets_surface>
class Parity_splitter
{
  using Quadrilateral = std::array<Vertex_index, 4>;

  Lattice_mesh& m_mesh;
  const Meets_surface& m_meets_surface;
  std::map<Quadrilateral, Vertex_index> m_diagonals; // sorted vertices, one end of the diagonal
  std::vector<std::uint8_t> m_is_touched;            // vertices of quadrilaterals with a diagonal

public:
  Parity_splitter(Lattice_mesh& mesh, const Meets_surface& meets_surface)
    : m_mesh(mesh), m_meets_surface(meets_surface), m_is_touched(mesh.vertices.size(), 0)
  {
  }

  /// Calls `add(element, kind, vertices)` for each piece, in the order of the elements; sets
  /// `is_replaced` for each element that is split.
  template <class Add>
  void operator()(const Add& add, std::vector<std::uint8_t>& is_replaced)
  {
    const Element_list& elements = m_mesh.elements;
    const auto is_inside = [&](Vertex_index v) { return m_mesh.is_inside(v); };
    std::vector<std::uint8_t> is_kept(elements.size());
    for(Element_index e = 0; e < elements.size(); ++e) {
      const Element_view element = elements[e];
      is_kept[e] = std::any_of(element.begin(), element.end(), is_inside);
      if(is_kept[e] && (is_replaced[e] || m_meets_surface(e))) {
        is_replaced[e] = 1;
        for_each_quadrilateral(element, [&](const Quadrilateral& q) { set_diagonal(q, even_corner(q)); });
      }
    }
    for(bool changed = true; changed;) {
      changed = false;
      for(Element_index e = 0; e < elements.size(); ++e)
        if(is_kept[e] && elements[e].kind() == PRISM && complete_prism(elements[e]))
          changed = true;
    }
    for(Element_index e = 0; e < elements.size(); ++e) {
      const Element_view element = elements[e];
      if(!is_kept[e])
        continue;
      for_each_quadrilateral(element, [&](const Quadrilateral& q) {
        is_replaced[e] = is_replaced[e] || has_diagonal(q);
      });
      if(is_replaced[e])
        split(e, add);
    }
  }

private:
  template <class F>
  static void for_each_quadrilateral(const Element_view& element, const F& f)
  {
    for(int i = 0; i < element.reference().number_of_faces; ++i) {
      const Element_face& face = element.reference().faces[i];
      if(face.size == 4)
        f(Quadrilateral{element[face.vertices[0]], element[face.vertices[1]], element[face.vertices[2]],
                        element[face.vertices[3]]});
    }
  }

  static Quadrilateral sorted(Quadrilateral q)
  {
    std::sort(q.begin(), q.end());
    return q;
  }

  static int position(const Quadrilateral& q, Vertex_index v)
  {
    return int(std::find(q.begin(), q.end(), v) - q.begin());
  }

  void set_diagonal(const Quadrilateral& q, Vertex_index end)
  {
    m_diagonals.emplace(sorted(q), end);
    for(Vertex_index v : q)
      m_is_touched[v] = 1;
  }

  // Whether a quadrilateral has a diagonal. Most elements are away from the surface: the flags avoid the
  // search.
  bool has_diagonal(const Quadrilateral& q) const
  {
    return std::all_of(q.begin(), q.end(), [&](Vertex_index v) { return m_is_touched[v]; })
           && m_diagonals.count(sorted(q)) != 0;
  }

  // Whether the diagonal of a quadrilateral ends at a vertex. \pre has_diagonal(q)
  bool diagonal_ends_at(const Quadrilateral& q, Vertex_index v) const
  {
    const int i = position(q, v), j = position(q, m_diagonals.at(sorted(q)));
    return (i - j) % 2 == 0;
  }

  // The corner that is even with respect to the shortest edge of the quadrilateral; ties by lattice position.
  Vertex_index even_corner(const Quadrilateral& q) const
  {
    std::uint32_t step = Octree::root_side;
    for(int i = 0; i < 4; ++i)
      for(int k = 0; k < 3; ++k) {
        const std::uint32_t a = m_mesh.vertices[q[i]][k], b = m_mesh.vertices[q[(i + 1) % 4]][k];
        if(a != b)
          step = (std::min)(step, a < b ? b - a : a - b);
      }
    const auto key = [&](Vertex_index v) {
      const Lattice_point& p = m_mesh.vertices[v];
      return std::make_pair((p[0] / step + p[1] / step + p[2] / step) % 2, lattice_key(p));
    };
    return *std::min_element(q.begin(), q.end(),
                             [&](Vertex_index a, Vertex_index b) { return key(a) < key(b); });
  }

  // The number of diagonals that are missing for the element to be the cone of `apex`, or -1.
  int missing_diagonals(const Element_view& element, Vertex_index apex) const
  {
    int missing = 0;
    for_each_quadrilateral(element, [&](const Quadrilateral& q) {
      if(missing < 0 || position(q, apex) == 4)
        return;
      if(!has_diagonal(q))
        ++missing;
      else if(!diagonal_ends_at(q, apex))
        missing = -1;
    });
    return missing;
  }

  // The vertex that can be the apex with the fewest further diagonals; ends of diagonals only.
  std::pair<int, Vertex_index> best_apex(const Element_view& element) const
  {
    std::pair<int, Vertex_index> best(99, Vertex_index(-1));
    for(Vertex_index v : element) {
      bool is_end = false;
      for_each_quadrilateral(element, [&](const Quadrilateral& q) {
        is_end = is_end || (position(q, v) < 4 && has_diagonal(q) && diagonal_ends_at(q, v));
      });
      const int missing = is_end ? missing_diagonals(element, v) : -1;
      if(missing >= 0)
        best = (std::min)(best, {missing, v});
    }
    return best;
  }

  bool complete_prism(const Element_view& prism)
  {
    const auto [missing, apex] = best_apex(prism);
    if(missing == 0 || missing == 99)
      return false;
    for_each_quadrilateral(prism, [&, v = apex](const Quadrilateral& q) {
      if(position(q, v) < 4 && !has_diagonal(q))
        set_diagonal(q, v);
    });
    return true;
  }

  template <class Add>
  void split(Element_index e, const Add& add)
  {
    const Element_view element = m_mesh.elements[e];
    switch(element.kind()) {
    case TETRAHEDRON: return add(e, TETRAHEDRON, element.begin());
    case HEXAHEDRON:
      if(!split_into_five(e, add))
        add_cone(e, center(e), add);
      return;
    case PYRAMID:
    case PRISM: {
      const auto [missing, apex] = best_apex(element);
      return add_cone(e, missing == 0 ? apex : center(e), add);
    }
    }
  }

  // Splits a hexahedron into five where the six diagonals form a tetrahedron.
  template <class Add>
  bool split_into_five(Element_index e, const Add& add) const
  {
    const Element_view element = m_mesh.elements[e];
    for(const auto& ends : {std::array<int, 4>{0, 2, 5, 7}, std::array<int, 4>{1, 3, 4, 6}}) {
      bool all = true;
      for_each_quadrilateral(element, [&](const Quadrilateral& q) {
        all = all && has_diagonal(q) && std::any_of(ends.begin(), ends.end(), [&](int i) {
                return position(q, element[i]) < 4 && diagonal_ends_at(q, element[i]);
              });
      });
      if(!all)
        continue;
      for(const auto& c : element.reference().corners)
        if(std::find(ends.begin(), ends.end(), c[0]) == ends.end()) {
          const Vertex_index corner[4] = {element[c[0]], element[c[1]], element[c[2]], element[c[3]]};
          add(e, TETRAHEDRON, corner);
        }
      const bool even = ends[0] == 0;
      const Vertex_index inner[4] = {element[ends[0]], element[even ? 2 : 3], element[even ? 7 : 4],
                                     element[even ? 5 : 6]};
      add(e, TETRAHEDRON, inner);
      return true;
    }
    return false;
  }

  // A new vertex at the center of the element (of its lattice box: all kinds split here are convex).
  Vertex_index center(Element_index e)
  {
    const Element_view element = m_mesh.elements[e];
    std::array<std::uint64_t, 3> sum{};
    for(Vertex_index v : element)
      for(int k = 0; k < 3; ++k)
        sum[k] += m_mesh.vertices[v][k];
    Lattice_point p;
    for(int k = 0; k < 3; ++k)
      p[k] = std::uint32_t(sum[k] / std::uint64_t(element.size()));
    m_is_touched.push_back(0);
    return m_mesh.add_vertex(p, ON_BOUNDED_SIDE, m_mesh.cells[e]);
  }

  template <class Add>
  void add_cone(Element_index e, Vertex_index apex, const Add& add) const
  {
    const Element_view element = m_mesh.elements[e];
    for(int f = 0; f < element.reference().number_of_faces; ++f) {
      const Element_face& face = element.reference().faces[f];
      Quadrilateral v{};
      for(int i = 0; i < face.size; ++i)
        v[i] = element[face.vertices[i]];
      if(std::find(v.begin(), v.begin() + face.size, apex) != v.begin() + face.size)
        continue;
      if(face.size == 4 && !has_diagonal(v)) {
        const Vertex_index pyramid[5] = {v[0], v[3], v[2], v[1], apex};
        add(e, PYRAMID, pyramid);
        continue;
      }
      if(face.size == 4 && !diagonal_ends_at(v, v[0]))
        std::rotate(v.begin(), v.begin() + 1, v.end());
      for(int i = 1; i + 1 < face.size; ++i) {
        const Vertex_index tetrahedron[4] = {v[0], v[i + 1], v[i], apex};
        add(e, TETRAHEDRON, tetrahedron);
      }
    }
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_BOUNDARY_SPLIT_BY_PARITY_H
