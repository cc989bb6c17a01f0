// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Identification of faces that elements have in common: the only place where faces are found.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_FOR_EACH_FACE_H
#define CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_FOR_EACH_FACE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/Face.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

// Sorts three or four numbers, faster than std::sort does.
inline void sort_vertices(std::array<Vertex_index, 4>& v)
{
  const auto order = [&v](std::size_t i, std::size_t j) {
    if(v[j] < v[i])
      std::swap(v[i], v[j]);
  };
  order(0, 1), order(2, 3), order(0, 2), order(1, 3), order(1, 2);
}

/// The faces of all elements, sorted so that those with the same vertices are side by side.
class Face_table
{
  // A face in the bucket of its smallest vertex.
  struct Entry
  {
    std::uint64_t second_and_third;
    Vertex_index fourth;
    Element_index element;
    std::uint8_t local_index;
    bool operator<(const Entry& e) const
    {
      return second_and_third != e.second_and_third ? second_and_third < e.second_and_third
                                                    : fourth < e.fourth;
    }
  };

public:
  /// Faces with the same vertices: in a conforming mesh, one face on the boundary and two faces inside.
  class Group
  {
    const Element_list& m_elements;
    const Entry* m_first;
    std::size_t m_size;

  public:
    Group(const Element_list& elements, const Entry* first, std::size_t size)
      : m_elements(elements), m_first(first), m_size(size)
    {
    }

    std::size_t size() const { return m_size; }
    Element_index element(std::size_t i) const { return m_first[i].element; }
    int local_index(std::size_t i) const { return m_first[i].local_index; }
    Face operator[](std::size_t i) const { return Face(m_elements, element(i), local_index(i)); }
  };

  /// Calls the visitor as described at `for_each_face()`.
  template <class Is_candidate, class Visitor>
  static void visit(const Element_list& elements, std::size_t number_of_vertices,
                    const Is_candidate& is_candidate, const Visitor& visit)
  {
    const auto for_each = [&](const auto& f) { // with the smallest vertex of each face
      for(Element_index e = 0; e < elements.size(); ++e) {
        const Element_view element = elements[e];
        for(int i = 0; i < element.reference().number_of_faces; ++i) {
          const std::array<Vertex_index, 4> v = vertices(element, i);
          if(std::all_of(v.begin(), v.begin() + element.reference().faces[i].size, is_candidate))
            f((std::min)((std::min)(v[0], v[1]), (std::min)(v[2], v[3])), e, i);
        }
      }
    };
    std::vector<std::size_t> ends(number_of_vertices + 1, 0);
    for_each([&](Vertex_index smallest, Element_index, int) { ++ends[smallest + 1]; });
    for(std::size_t v = 0; v < number_of_vertices; ++v)
      ends[v + 1] += ends[v];
    // The faces of all buckets take 5 bytes each; entries, of 24, are made for one bucket at a time.
    std::vector<Element_index> of_element(ends.back());
    std::vector<std::uint8_t> local_indices(ends.back());
    for_each([&](Vertex_index smallest, Element_index e, int i) {
      const std::size_t place = ends[smallest]++;
      of_element[place] = e;
      local_indices[place] = std::uint8_t(i);
    });
    std::vector<Entry> entries;
    std::size_t begin = 0;
    for(std::size_t v = 0; v < number_of_vertices; ++v) {
      entries.clear();
      for(; begin < ends[v]; ++begin)
        entries.push_back(entry(elements, of_element[begin], local_indices[begin]));
      std::sort(entries.begin(), entries.end());
      auto first = entries.begin();
      const auto last = entries.end();
      while(first != last) {
        auto next = first;
        while(next != last && !(*first < *next))
          ++next;
        visit(Group(elements, &*first, std::size_t(next - first)));
        first = next;
      }
    }
  }

private:
  static std::array<Vertex_index, 4> vertices(const Element_view& element, int local_index)
  {
    const Element_face& face = element.reference().faces[local_index];
    std::array<Vertex_index, 4> v{no_vertex, no_vertex, no_vertex, no_vertex};
    for(int k = 0; k < face.size; ++k)
      v[std::size_t(k)] = element[face.vertices[k]];
    return v;
  }

  static Entry entry(const Element_list& elements, Element_index e, std::uint8_t local_index)
  {
    std::array<Vertex_index, 4> v = vertices(elements[e], local_index);
    sort_vertices(v);
    return {std::uint64_t(v[1]) << 32 | v[2], v[3], e, local_index};
  }
};

/// Calls `visit(group)` with a `Face_table::Group` for each set of vertices that is a face, among the faces
/// all of whose vertices satisfy `is_candidate`.
/// \par Complexity
/// Linear in the number of elements, if the number of elements at a vertex is bounded; 24 bytes per face
template <class Is_candidate, class Visitor>
void for_each_face(const Element_list& elements, std::size_t number_of_vertices,
                   const Is_candidate& is_candidate, const Visitor& visit)
{
  Face_table::visit(elements, number_of_vertices, is_candidate, visit);
}

/// Overload for all faces.
template <class Visitor>
void for_each_face(const Element_list& elements, std::size_t number_of_vertices, const Visitor& visit)
{
  for_each_face(
    elements, number_of_vertices, [](Vertex_index) { return true; }, visit);
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_FOR_EACH_FACE_H
