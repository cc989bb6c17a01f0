// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Patches of tetrahedra, pyramids and prisms with a common dilatation, against volumetric locking: E. A. de
// Souza Neto, F. M. Andrade Pires, D. R. J. Owen: "F-bar-based linear triangles and tetrahedra for finite
// strain analysis of nearly incompressible solids. Part I", Int. J. Numer. Meth. Engng 62, 2005.

#ifndef CGAL_LINEAR_ELASTICITY_3_INTERNAL_DILATATION_PATCHES_H
#define CGAL_LINEAR_ELASTICITY_3_INTERNAL_DILATATION_PATCHES_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/Mixed_element_traits_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/for_each_face.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

using Patches = std::vector<std::vector<Element_index>>;

/// The form of a patch of elements of a kind.
enum class Patch_form { STAR_OF_VERTEX, PAIR, NONE };

inline Patch_form patch_form(Element_kind kind)
{
  switch(kind) {
  case TETRAHEDRON:
  case PYRAMID: return Patch_form::STAR_OF_VERTEX;
  case PRISM: return Patch_form::PAIR;
  case HEXAHEDRON: return Patch_form::NONE;
  }
  CGAL_unreachable();
}

/// Patches, each element in at most one.
class Patch_builder
{
  static constexpr std::size_t no_patch = std::size_t(-1);

  const Element_list& m_elements;
  const std::size_t m_number_of_vertices;
  std::vector<std::size_t> m_patch_of; // of each element

public:
  Patches patches;

  Patch_builder(const Element_list& elements, std::size_t number_of_vertices)
    : m_elements(elements), m_number_of_vertices(number_of_vertices), m_patch_of(elements.size(), no_patch)
  {
  }

  /// Patches of elements around a vertex, the largest first.
  template <class Is_together>
  void add_stars(const Is_together& is_together)
  {
    constexpr std::size_t wanted_size = 8; // the star of an inner vertex with six neighbors
    std::vector<std::vector<Element_index>> stars(m_number_of_vertices);
    std::size_t largest = 0;
    for(Element_index e = 0; e < m_elements.size(); ++e)
      if(patch_form(m_elements[e].kind()) == Patch_form::STAR_OF_VERTEX && is_together(e, e))
        for(Vertex_index v : m_elements[e]) {
          stars[v].push_back(e);
          largest = (std::max)(largest, stars[v].size());
        }
    std::vector<std::vector<Vertex_index>> vertices_by_size(largest + 1);
    for(Vertex_index v = 0; v < stars.size(); ++v)
      vertices_by_size[stars[v].size()].push_back(v);

    std::vector<Element_index> left;
    for(std::size_t size = largest; size > 0; --size)
      for(std::size_t i = 0; i < vertices_by_size[size].size(); ++i) {
        const Vertex_index v = vertices_by_size[size][i];
        const std::vector<Element_index>& star = stars[v];
        left.clear();
        for(Element_index e : star)
          if(!is_in_patch(e) && (left.empty() || is_together(left.front(), e)))
            left.push_back(e);
        if(left.empty())
          continue;
        if(left.size() < size) { // some have been taken: later, among stars of equal size
          vertices_by_size[left.size()].push_back(v);
          continue;
        }
        const std::size_t patch = size < wanted_size ? smallest_patch(star, left.front(), is_together)
                                                     : no_patch;
        join(left, patch == no_patch ? patches.size() : patch);
        vertices_by_size[size].push_back(v); // again for remaining elements of other materials
      }
  }

  /// Pairs of elements with a quadrilateral in common.
  template <class Is_together>
  void add_pairs(const Is_together& is_together)
  {
    for_each_face(m_elements, m_number_of_vertices, [&](const auto& faces) {
      if(faces.size() != 2)
        return;
      const Element_index a = faces.element(0), b = faces.element(1);
      if(patch_form(m_elements[a].kind()) == Patch_form::PAIR
         && patch_form(m_elements[b].kind()) == Patch_form::PAIR && faces[0].vertices().size() == 4
         && !is_in_patch(a) && !is_in_patch(b) && is_together(a, b))
        join({a, b}, patches.size());
    });
  }

private:
  bool is_in_patch(Element_index e) const { return m_patch_of[e] != no_patch; }

  void join(const std::vector<Element_index>& elements, std::size_t patch)
  {
    if(patch == patches.size())
      patches.emplace_back();
    for(Element_index e : elements) {
      m_patch_of[e] = patch;
      patches[patch].push_back(e);
    }
  }

  // The smallest patch of elements of a star that may be with an element; none if there is none.
  template <class Is_together>
  std::size_t smallest_patch(const std::vector<Element_index>& star, Element_index with,
                             const Is_together& is_together) const
  {
    std::size_t patch = no_patch;
    for(Element_index e : star)
      if(is_in_patch(e) && is_together(with, e)
         && (patch == no_patch || patches[m_patch_of[e]].size() < patches[patch].size()))
        patch = m_patch_of[e];
    return patch;
  }
};

/*!
A partition of the tetrahedra and pyramids: stars of vertices, the largest first, as far as their elements are
not taken yet. The rest of smaller stars joins the smallest patch around it. A single linear tetrahedron has a
third of the displacements that its constraint of volume needs; a patch of `wanted_size` or more has enough.
Pyramids are those of cells divided from their centers: one more vertex for six pyramids, so that a single
pyramid has little more displacements than a tetrahedron.

Then prisms are taken in pairs with a common quadrilateral: a single prism has half of the displacements that
a hexahedron has for its constraint, and locks like tetrahedra if bent in the plane of its triangles. A prism
without a partner is in no patch.

\param is_together `bool(e, f)`: whether two elements may have a common dilatation: they are of one material.
For `e == f`, whether the element may be in a patch at all
\par Complexity
Linear
*/
template <class Is_together>
Patches dilatation_patches(const Element_list& elements, std::size_t number_of_vertices,
                           const Is_together& is_together)
{
  Patch_builder builder(elements, number_of_vertices);
  builder.add_stars(is_together);
  builder.add_pairs(is_together);
  return std::move(builder.patches);
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_INTERNAL_DILATATION_PATCHES_H
