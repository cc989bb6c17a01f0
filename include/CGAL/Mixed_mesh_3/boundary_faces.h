// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which faces of the elements are the same: boundary and interior faces.

#ifndef CGAL_MIXED_MESH_3_BOUNDARY_FACES_H
#define CGAL_MIXED_MESH_3_BOUNDARY_FACES_H

#include <CGAL/Mixed_mesh_3/Element_list.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

/// A face of an element, by its position in `Reference_element::faces`.
struct Face_handle
{
  Element_index element;
  std::uint8_t local_face;
};

namespace internal {

constexpr Vertex_index no_vertex = Vertex_index(-1);

/// The vertices of a face in the order of its orientation; the fourth is `no_vertex` for a triangle.
inline std::array<Vertex_index, 4> face_vertices(const Element_view& element, int f)
{
  const Element_face& face = element.reference().faces[f];
  std::array<Vertex_index, 4> v{no_vertex, no_vertex, no_vertex, no_vertex};
  for(int i = 0; i < face.size; ++i)
    v[i] = element[face.vertices[i]];
  return v;
}

// Three or four numbers: cheaper than std::sort.
inline void sort_vertices(std::array<Vertex_index, 4>& v)
{
  const auto order = [&v](int i, int j) {
    if(v[j] < v[i])
      std::swap(v[i], v[j]);
  };
  order(0, 1), order(2, 3), order(0, 2), order(1, 3), order(1, 2);
}

/// Calls `visit(faces, n)` for each set of vertices that is a face of `n` elements, among the faces all
/// of whose vertices satisfy `is_candidate`.
/// \cost linear in the number of elements, if vertices have boundedly many; 24 bytes per face
template <class Is_candidate, class Visitor>
void for_each_face(const Element_list& elements, std::size_t number_of_vertices,
                   const Is_candidate& is_candidate, const Visitor& visit)
{
  // In buckets by the smallest vertex; within a bucket by the others, sorted.
  struct Entry
  {
    std::uint64_t second_and_third;
    Vertex_index fourth;
    Face_handle face;
    bool operator<(const Entry& e) const
    {
      return second_and_third != e.second_and_third ? second_and_third < e.second_and_third
                                                    : fourth < e.fourth;
    }
  };
  const auto for_each = [&](const auto& f) {
    for(Element_index e = 0; e < elements.size(); ++e) {
      const Element_view element = elements[e];
      for(int i = 0; i < element.reference().number_of_faces; ++i) {
        std::array<Vertex_index, 4> v = face_vertices(element, i);
        if(!std::all_of(v.begin(), v.begin() + element.reference().faces[i].size, is_candidate))
          continue;
        sort_vertices(v);
        f(v, Face_handle{e, std::uint8_t(i)});
      }
    }
  };
  std::vector<std::size_t> ends(number_of_vertices + 1, 0);
  for_each([&](const std::array<Vertex_index, 4>& v, Face_handle) { ++ends[v[0] + 1]; });
  for(std::size_t v = 0; v < number_of_vertices; ++v)
    ends[v + 1] += ends[v];
  std::vector<Entry> entries(ends.back());
  for_each([&](const std::array<Vertex_index, 4>& v, Face_handle face) {
    entries[ends[v[0]]++] = {std::uint64_t(v[1]) << 32 | v[2], v[3], face};
  });
  std::vector<Face_handle> faces;
  auto first = entries.begin();
  for(std::size_t v = 0; v < number_of_vertices; ++v) {
    const auto last = entries.begin() + std::ptrdiff_t(ends[v]);
    std::sort(first, last);
    while(first != last) {
      faces.clear();
      const Entry& same = *first;
      for(; first != last && !(same < *first); ++first)
        faces.push_back(first->face);
      visit(faces.data(), faces.size());
    }
  }
}

} // namespace internal

/// The faces that belong to one element only, in the order of the elements.
/// \param mesh the mesh
/// \param is_candidate `bool(Vertex_index)`: looks at faces all of whose vertices satisfy it only;
///        faster if few do
template <class Mesh, class Is_candidate>
std::vector<typename Mesh::Boundary_face> boundary_faces(const Mesh& mesh,
                                                         const Is_candidate& is_candidate)
{
  std::vector<typename Mesh::Boundary_face> faces;
  internal::for_each_face(mesh.elements(), mesh.number_of_vertices(), is_candidate,
                          [&](const Face_handle* f, std::size_t n) {
                            if(n == 1)
                              faces.push_back({f->element, f->local_face});
                          });
  std::sort(faces.begin(), faces.end(), [](const auto& a, const auto& b) {
    return std::make_pair(a.element, a.local_face) < std::make_pair(b.element, b.local_face);
  });
  return faces;
}

/// As above, looking at all faces.
template <class Mesh>
std::vector<typename Mesh::Boundary_face> boundary_faces(const Mesh& mesh)
{
  return boundary_faces(mesh, [](Vertex_index) { return true; });
}

/// The vertices of the boundary faces of a mesh, each once, in increasing order.
/// \param mesh the mesh. \pre its boundary faces are set
template <class Mesh>
std::vector<Vertex_index> boundary_vertices(const Mesh& mesh)
{
  std::vector<Vertex_index> vertices;
  for(const auto& face : mesh.boundary_faces()) {
    const Element_view element = mesh.element(face.element);
    const Element_face& local = element.reference().faces[face.local_face];
    for(int i = 0; i < local.size; ++i)
      vertices.push_back(element[local.vertices[i]]);
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_BOUNDARY_FACES_H
