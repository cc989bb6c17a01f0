// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_TRANSITIONS_TRANSITION_TEMPLATES_H
#define CGAL_MIXED_MESH_3_INTERNAL_TRANSITIONS_TRANSITION_TEMPLATES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/transitions/transition_tables.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

// Templates that fill one cell of a 2:1-balanced octree.
//
// Points: the lattice {0,1,2}^3 of a cell, point (x,y,z) has index x + 3 y + 9 z.
//
//        z = 0              z = 1              z = 2
//     6    7    8        15   16   17       24   25   26
//     3    4    5        12  (13)  14       21   22   23       y
//     0    1    2         9   10   11       18   19   20       |__ x     13 is the cell center
//
// Pattern: a mask of 12 bits, one for each edge; set if the edge's midpoint is a vertex.
//
//     bit        0  1  2  3 | 4  5  6  7 | 8  9 10 11
//     parallel   to x       | to y       | to z
//     midpoint   1  7 19 25 | 3  5 21 23 | 9 11 15 17
//
// Faces: x-, x+, y-, y+, z-, z+ are 0 to 5. The pattern of a face has 4 bits: the bits of its edges in
// increasing order. If all four are set, the center of the face is a vertex, too.

// One element: kind 0 tetrahedron, 1 pyramid, 2 prism, 3 hexahedron; `size` vertices as lattice
// indices, in the order of Gmsh and of finite elements, with positive volume.
struct Template_element
{
  std::uint8_t kind;
  std::uint8_t size;
  std::uint8_t vertices[8];
};

// A piece of a face: a triangle or quadrilateral, counter-clockwise seen from outside the cell.
struct Face_piece
{
  std::uint8_t size;
  std::uint8_t vertices[4];
};

struct Face_split
{
  std::uint8_t size;
  Face_piece pieces[4];

  const Face_piece* begin() const { return pieces; }
  const Face_piece* end() const { return pieces + size; }
};

inline constexpr int cell_center_index = 13; // the point (1, 1, 1): 1 + 3 + 9

// The midpoint of an edge as a lattice index.
inline int edge_midpoint(int edge)
{
  constexpr std::uint8_t midpoints[12] = {1, 7, 19, 25, 3, 5, 21, 23, 9, 11, 15, 17};
  return midpoints[edge];
}

// The 4 bits of a face in the pattern of its cell.
inline std::uint32_t face_pattern(std::uint32_t mask, int face)
{
  constexpr std::uint8_t edges[6][4] = {{4, 6, 8, 10},  {5, 7, 9, 11}, {0, 2, 8, 9},
                                        {1, 3, 10, 11}, {0, 1, 4, 5},  {2, 3, 6, 7}};
  const std::uint8_t* e = edges[face];
  return (mask >> e[0] & 1) | (mask >> e[1] & 1) << 1 | (mask >> e[2] & 1) << 2 | (mask >> e[3] & 1) << 3;
}

// The pieces of a face, from its 4 bits only: both cells at a face agree on the pieces. Up to rotation:
//
//    6---5---4   o-------o   o-------o   o---o---o   o-------o   o-------o   o---o---o
//    |       |   |       |   |\     /|   |   |   |   |   __./|   |       |   |   |   |
//    7   8   3   |       |   | \   / |   |   |   |   o--'  / |   o-------o   o---o---o
//    |       |   |       |   |  \ /  |   |   |   |   | \  /  |   | \   / |   |   |   |
//    0---1---2   o-------o   o---o---o   o---o---o   o---o---o   o---o---o   o---o---o
//    numbering     none         one      opposite    adjacent      three       four
inline Face_split face_split(int face, std::uint32_t bits)
{
  // The points 0..8 of the drawing for each face, seen from outside.
  constexpr std::uint8_t points[6][9] = {{0, 9, 18, 21, 24, 15, 6, 3, 12},
                                         {2, 5, 8, 17, 26, 23, 20, 11, 14},
                                         {0, 1, 2, 11, 20, 19, 18, 9, 10},
                                         {6, 15, 24, 25, 26, 17, 8, 7, 16},
                                         {0, 3, 6, 7, 8, 5, 2, 1, 4},
                                         {18, 19, 20, 23, 26, 25, 24, 21, 22}};
  // The bit of each side 0 2, 2 4, 4 6, 6 0: the drawing's first direction is the face's first
  // axis on x+, y-, z+ and the second one on the others.
  constexpr std::uint8_t bits_of_sides[2][4] = {{0, 3, 1, 2}, {2, 1, 3, 0}};
  // The six splits, with their sides as bits 0 to 3.
  struct Case
  {
    std::uint8_t sides;
    Face_split split;
  };
  constexpr Case cases[6] = {
    {0x0, {1, {{4, {0, 2, 4, 6}}}}},
    {0x1, {3, {{3, {0, 1, 6}}, {3, {1, 2, 4}}, {3, {1, 4, 6}}}}},
    {0x5, {2, {{4, {0, 1, 5, 6}}, {4, {1, 2, 4, 5}}}}},
    {0x9, {4, {{3, {0, 1, 7}}, {3, {1, 4, 7}}, {3, {1, 2, 4}}, {3, {4, 6, 7}}}}},
    {0xB, {4, {{4, {7, 3, 4, 6}}, {3, {0, 1, 7}}, {3, {1, 2, 3}}, {3, {1, 3, 7}}}}},
    {0xF, {4, {{4, {0, 1, 8, 7}}, {4, {1, 2, 3, 8}}, {4, {8, 3, 4, 5}}, {4, {7, 8, 5, 6}}}}}};

  const bool first = (face == 1 || face == 2 || face == 5);
  std::uint32_t sides = 0;
  for(int i = 0; i < 4; ++i)
    sides |= (bits >> bits_of_sides[first ? 0 : 1][i] & 1) << i;
  for(int rotation = 0;; ++rotation) // terminates: one of the six is a rotation of any pattern
  {
    const std::uint32_t rotated = (sides >> rotation | sides << (4 - rotation)) & 0xF;
    for(const Case& c : cases)
      if(c.sides == rotated) {
        Face_split result = c.split;
        for(int i = 0; i < result.size; ++i)
          for(int k = 0; k < result.pieces[i].size; ++k) {
            std::uint8_t& v = result.pieces[i].vertices[k];
            v = points[face][v == 8 ? 8 : (v + 2 * rotation) % 8];
          }
        return result;
      }
  }
}

// The elements of one template.
class Transition_template
{
public:
  Transition_template(const Template_element* begin, const Template_element* end) : m_begin(begin), m_end(end)
  {
  }

  const Template_element* begin() const { return m_begin; }
  const Template_element* end() const { return m_end; }
  std::size_t size() const { return m_end - m_begin; }

private:
  const Template_element* m_begin;
  const Template_element* m_end;
};

// All templates, expanded once from the table of classes; about 1.3 MB.
class Transition_templates
{
public:
  static constexpr int number_of_patterns = 4096; // 2^12: each edge has a hanging vertex or not

  static const Transition_templates& get()
  {
    static const Transition_templates templates;
    return templates;
  }

  // The template of a pattern, without the cell center wherever possible.
  Transition_template operator[](std::uint32_t mask) const { return m_default[mask]; }

  // Whether the template of a pattern has the cell center as a vertex.
  bool has_center(std::uint32_t mask) const { return m_has_center[mask]; }

  // The other template: each boundary piece coned from the cell center, for all patterns but 0,
  // which is one hexahedron.
  Transition_template centered(std::uint32_t mask) const { return m_centered[mask]; }

private:
  // Templates one after the other; the template of a pattern is [offsets[mask], offsets[mask + 1]).
  struct Family
  {
    std::vector<Template_element> elements;
    std::array<std::uint32_t, number_of_patterns + 1> offsets;

    Transition_template operator[](std::uint32_t mask) const
    {
      return {elements.data() + offsets[mask], elements.data() + offsets[mask + 1]};
    }
  };

  // A symmetry of the cube, given as a permutation of the lattice points and of the edges.
  struct Symmetry
  {
    std::uint8_t points[27];
    std::uint8_t edges[12];
    bool is_reflection;

    Symmetry(int number) // 0..47: 6 orders of the axes, each with 8 sets of reversed axes
    {
      constexpr std::uint8_t axes[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
      const int order = number / 8, reversed = number % 8;
      is_reflection = (order >= 3) != (((reversed ^ reversed >> 1 ^ reversed >> 2) & 1) != 0);
      for(int i = 0; i < 27; ++i) {
        const int p[3] = {i % 3, i / 3 % 3, i / 9};
        int q[3];
        for(int k = 0; k < 3; ++k)
          q[k] = (reversed >> k & 1) ? 2 - p[axes[order][k]] : p[axes[order][k]];
        points[i] = static_cast<std::uint8_t>(q[0] + 3 * q[1] + 9 * q[2]);
      }
      for(int e = 0; e < 12; ++e)
        for(int f = 0; f < 12; ++f)
          if(points[edge_midpoint(e)] == edge_midpoint(f))
            edges[e] = static_cast<std::uint8_t>(f);
    }

    std::uint32_t operator()(std::uint32_t mask) const
    {
      std::uint32_t result = 0;
      for(int e = 0; e < 12; ++e)
        result |= (mask >> e & 1) << edges[e];
      return result;
    }

    // The image of an element. A reflection inverts the element; listing the base, or both triangles, in the
    // opposite direction makes its volume positive again.
    Template_element operator()(const Template_element& element) const
    {
      constexpr std::uint8_t order[2][4][8] = {
        {{0, 1, 2, 3}, {0, 1, 2, 3, 4}, {0, 1, 2, 3, 4, 5}, {0, 1, 2, 3, 4, 5, 6, 7}},
        {{0, 2, 1, 3}, {0, 3, 2, 1, 4}, {0, 2, 1, 3, 5, 4}, {0, 3, 2, 1, 4, 7, 6, 5}}};
      Template_element result = element;
      for(int i = 0; i < element.size; ++i)
        result.vertices[i] = points[element.vertices[order[is_reflection][element.kind][i]]];
      return result;
    }
  };

  Transition_templates()
  {
    fill_default();
    fill_centered();
  }

  void fill_default()
  {
    constexpr std::uint8_t sizes[4] = {4, 5, 6, 8};
    std::vector<Symmetry> symmetries;
    for(int i = 0; i < 48; ++i)
      symmetries.emplace_back(i);

    // The class of each pattern, and the first symmetry that leads to the pattern.
    struct Class
    {
      std::vector<Template_element> elements;
      bool has_center;
    };
    std::vector<Class> classes;
    std::array<std::uint8_t, number_of_patterns> class_of, symmetry_of;
    std::array<bool, number_of_patterns> is_known = {};
    const unsigned short* entry = transition_table;
    for(int c = 0; c < number_of_transition_classes; ++c) {
      const std::uint32_t mask = *entry++;
      classes.push_back({std::vector<Template_element>(*entry++), false});
      for(Template_element& element : classes.back().elements) {
        element = {};
        element.kind = static_cast<std::uint8_t>(*entry++);
        element.size = sizes[element.kind];
        for(int i = 0; i < element.size; ++i) {
          element.vertices[i] = static_cast<std::uint8_t>(*entry++);
          if(element.vertices[i] == cell_center_index)
            classes.back().has_center = true;
        }
      }
      for(std::uint8_t s = 0; s < 48; ++s) {
        const std::uint32_t image = symmetries[s](mask);
        if(is_known[image])
          continue;
        is_known[image] = true;
        class_of[image] = static_cast<std::uint8_t>(c);
        symmetry_of[image] = s;
      }
    }

    for(std::uint32_t mask = 0; mask < number_of_patterns; ++mask) {
      m_default.offsets[mask] = static_cast<std::uint32_t>(m_default.elements.size());
      m_has_center[mask] = classes[class_of[mask]].has_center;
      for(const Template_element& element : classes[class_of[mask]].elements)
        m_default.elements.push_back(symmetries[symmetry_of[mask]](element));
    }
    m_default.offsets[number_of_patterns] = static_cast<std::uint32_t>(m_default.elements.size());
  }

  void fill_centered()
  {
    for(std::uint32_t mask = 0; mask < number_of_patterns; ++mask) {
      m_centered.offsets[mask] = static_cast<std::uint32_t>(m_centered.elements.size());
      if(mask == 0) {
        m_centered.elements.push_back(*m_default[0].begin());
        continue;
      }
      for(int face = 0; face < 6; ++face)
        for(const Face_piece& piece : face_split(face, face_pattern(mask, face))) {
          // The base must be counter-clockwise seen from the center, which is inside.
          Template_element element = {};
          element.kind = (piece.size == 4 ? 1 : 0);
          element.size = static_cast<std::uint8_t>(piece.size + 1);
          for(int i = 0; i < piece.size; ++i)
            element.vertices[i] = piece.vertices[piece.size - 1 - i];
          element.vertices[piece.size] = cell_center_index;
          m_centered.elements.push_back(element);
        }
    }
    m_centered.offsets[number_of_patterns] = static_cast<std::uint32_t>(m_centered.elements.size());
  }

  Family m_default;
  Family m_centered;
  std::array<bool, number_of_patterns> m_has_center;
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_TRANSITIONS_TRANSITION_TEMPLATES_H
