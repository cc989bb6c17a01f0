// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Compartments: the parts of a mesh on the two sides of sheets.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_BOUNDARY_SHEET_COMPARTMENTS_H
#define CGAL_MIXED_MESH_3_INTERNAL_BOUNDARY_SHEET_COMPARTMENTS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_attributes.h>
#include <CGAL/Mixed_mesh_3/Face.h>
#include <CGAL/Mixed_mesh_3/internal/elements/for_each_face.h>
#include <CGAL/Mixed_mesh_3/internal/transitions/Lattice_mesh.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

using Sheet_edge = std::pair<Vertex_index, Vertex_index>; // the smaller one first
using Sheet_triangle = std::array<Vertex_index, 3>;       // ascending

inline Sheet_edge sheet_edge(Vertex_index a, Vertex_index b) { return std::minmax(a, b); }

inline Sheet_triangle sheet_triangle(const Face_vertices& v)
{
  Sheet_triangle t{v[0], v[1], v[2]};
  std::sort(t.begin(), t.end());
  return t;
}

// Whether a piece has one of the faces.
inline bool has_face(const Element_list& pieces, Element_index i, const std::set<Sheet_triangle>& faces)
{
  for(int f = 0; f < pieces[i].reference().number_of_faces; ++f)
    if(const Face_vertices v = Face(pieces, i, f).vertices();
       v.size() == 3 && faces.count(sheet_triangle(v)) > 0)
      return true;
  return false;
}

// Compartments: pieces connected by faces that are not on a sheet, among the pieces with a face on a sheet,
// and, if asked for, the pieces around a vertex that the sheet surrounds.
inline std::vector<Compartment_index> find_sheet_compartments(const Lattice_mesh& mesh,
                                                              const Element_list& pieces,
                                                              const std::set<Sheet_triangle>& faces,
                                                              bool all_around)
{
  std::map<Sheet_edge, int> edges;
  std::set<Vertex_index> inner;
  for(const Sheet_triangle& t : faces)
    for(std::size_t i = 0; i < 3; ++i) {
      ++edges[sheet_edge(t[i], t[(i + 1) % 3])];
      inner.insert(t[i]);
    }
  for(const auto& [e, number] : edges)
    if(number == 1 && (mesh.is_inside(e.first) || mesh.is_inside(e.second))) {
      inner.erase(e.first);
      inner.erase(e.second);
    }

  Element_list chosen;
  std::vector<Element_index> numbers;
  for(Element_index i = 0; i < pieces.size(); ++i)
    if((all_around
        && std::any_of(pieces[i].begin(), pieces[i].end(),
                       [&](Vertex_index v) { return inner.count(v) > 0; }))
       || has_face(pieces, i, faces)) {
      chosen.add(pieces[i].kind(), pieces[i].begin());
      numbers.push_back(i);
    }
  std::vector<std::vector<std::size_t>> neighbors(chosen.size());
  for_each_face(chosen, mesh.vertices.size(), [&](const auto& group) {
    if(group.size() == 2
       && (group[0].vertices().size() == 4 || faces.count(sheet_triangle(group[0].vertices())) == 0)) {
      neighbors[group.element(0)].push_back(group.element(1));
      neighbors[group.element(1)].push_back(group.element(0));
    }
  });
  std::vector<Compartment_index> result(pieces.size(), 0);
  Compartment_index last = 0;
  for(std::size_t i = 0; i < chosen.size(); ++i) {
    if(result[numbers[i]] != 0)
      continue;
    result[numbers[i]] = ++last;
    std::vector<std::size_t> reached{i};
    while(!reached.empty()) {
      const std::size_t j = reached.back();
      reached.pop_back();
      for(std::size_t n : neighbors[j])
        if(result[numbers[n]] == 0) {
          result[numbers[n]] = last;
          reached.push_back(n);
        }
    }
  }
  return result;
}

// Sheet faces with the same compartment on both sides, where the sides are connected around the rim.
inline std::set<Sheet_triangle> faces_within_compartments(const Element_list& pieces,
                                                          const std::set<Sheet_triangle>& faces,
                                                          const std::vector<Compartment_index>& compartments)
{
  std::map<Sheet_triangle, Compartment_index> first;
  std::set<Sheet_triangle> lost;
  for(Element_index i = 0; i < pieces.size(); ++i)
    if(compartments[i] != 0)
      for(int f = 0; f < pieces[i].reference().number_of_faces; ++f) {
        const Face_vertices v = Face(pieces, i, f).vertices();
        if(v.size() != 3 || faces.count(sheet_triangle(v)) == 0)
          continue;
        const auto [known, is_new] = first.try_emplace(sheet_triangle(v), compartments[i]);
        if(!is_new && known->second == compartments[i])
          lost.insert(sheet_triangle(v));
      }
  return lost;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_BOUNDARY_SHEET_COMPARTMENTS_H
