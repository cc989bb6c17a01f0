// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The checker of meshes, independent of the way in which a mesh was made.

#ifndef CGAL_MIXED_MESH_3_MESH_DEFECTS_H
#define CGAL_MIXED_MESH_3_MESH_DEFECTS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/Face.h>
#include <CGAL/Mixed_mesh_3/certificate.h>
#include <CGAL/Mixed_mesh_3/internal/base/Predicates_kernel.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/for_each_face.h>
#include <CGAL/Mixed_mesh_3/internal/elements/manifold_defects.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMesh3Validity
/// The defects of a mesh: all zero if there is none.
struct Mesh_defects
{
  std::size_t nonconforming_faces = 0;        ///< of more than two elements, or twice with one orientation,
                                              ///< or a quadrilateral against triangles
  std::size_t nonmanifold_boundary_edges = 0; ///< edges that are not once in each direction
  std::size_t nonmanifold_boundary_vertices = 0; ///< vertices with more than one fan of boundary faces
  std::size_t nonpositive_corners = 0;  ///< corner tetrahedra whose orientation is not positive, exactly
  std::size_t nonpositive_elements = 0; ///< elements whose Jacobian is not positive everywhere, exactly
  std::size_t undecided_elements = 0;   ///< elements that could be neither proved nor disproved
  /// Vertices of no element.
  std::size_t unused_vertices = 0;
  std::size_t duplicate_vertices = 0; ///< vertices with the coordinates of an earlier one
  /// Vertices with a coordinate that is infinite or no number.
  std::size_t nonfinite_vertices = 0;
  std::size_t invalid_elements = 0; ///< elements with a vertex that does not exist, or the same vertex twice

  /// Whether two elements have a vertex, an edge, a face or nothing in common.
  bool conforming() const { return nonconforming_faces == 0 && invalid_elements == 0; }
  /// Whether the boundary is a closed oriented 2-manifold.
  bool closed_manifold_boundary() const
  {
    return nonmanifold_boundary_edges == 0 && nonmanifold_boundary_vertices == 0 && invalid_elements == 0;
  }
  /// Whether the Jacobian of each element is proved positive on the whole element.
  bool positive() const
  {
    return nonpositive_corners == 0 && nonpositive_elements == 0 && undecided_elements == 0
           && nonfinite_vertices == 0 && invalid_elements == 0;
  }
  /// Whether there is no defect at all.
  bool none() const
  {
    return conforming() && closed_manifold_boundary() && positive() && unused_vertices == 0
           && duplicate_vertices == 0;
  }
};

namespace internal {

template <class Mesh>
void find_invalid_elements(const Mesh& mesh, Mesh_defects& defects)
{
  std::vector<std::uint8_t> is_used(mesh.number_of_vertices(), 0);
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e) {
    const Element_view element = mesh.element(e);
    bool is_valid = true;
    for(int i = 0; i < element.size(); ++i) {
      is_valid = is_valid && element[i] < mesh.number_of_vertices()
                 && std::find(element.begin(), element.begin() + i, element[i]) == element.begin() + i;
      if(is_valid)
        is_used[element[i]] = 1;
    }
    defects.invalid_elements += !is_valid;
  }
  defects.unused_vertices = std::size_t(std::count(is_used.begin(), is_used.end(), 0));
}

template <class Mesh>
void find_bad_vertices(const Mesh& mesh, Mesh_defects& defects)
{
  // Equal coordinates have equal hashes: numbers are sorted, and points are compared only where hashes are
  // equal.
  std::vector<std::pair<std::uint64_t, Vertex_index>> hashes;
  hashes.reserve(mesh.number_of_vertices());
  for(Vertex_index v = 0; v < mesh.number_of_vertices(); ++v) {
    const Vec3 p = to_vec3(mesh.point(v));
    defects.nonfinite_vertices += !(std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]));
    std::uint64_t hash = 0;
    for(double x : p) {
      x += 0.; // -0 becomes 0
      std::uint64_t bits;
      std::memcpy(&bits, &x, sizeof bits);
      hash = (hash ^ bits) * 0x9E3779B97F4A7C15u;
      hash ^= hash >> 29;
    }
    hashes.emplace_back(hash, v);
  }
  std::sort(hashes.begin(), hashes.end());
  for(std::size_t i = 0, j; i < hashes.size(); i = j) {
    for(j = i + 1; j < hashes.size() && hashes[j].first == hashes[i].first; ++j) {
      bool is_duplicate = false;
      for(std::size_t k = i; k < j; ++k)
        is_duplicate = is_duplicate
                       || to_vec3(mesh.point(hashes[k].second)) == to_vec3(mesh.point(hashes[j].second));
      defects.duplicate_vertices += is_duplicate;
    }
  }
}

// Finds elements that are not positive. The Jacobian at a corner is the determinant of its tetrahedron: where
// the Jacobian is positive everywhere, corners need not be tested.
template <class Mesh>
void find_nonpositive_elements(const Mesh& mesh, Mesh_defects& defects)
{
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e) {
    const Jacobian_sign sign = jacobian_sign(mesh, e);
    if(sign == Jacobian_sign::POSITIVE)
      continue;
    ++(sign == Jacobian_sign::UNDECIDED ? defects.undecided_elements : defects.nonpositive_elements);
    const Element_view element = mesh.element(e);
    const auto point = [&](int i) {
      const Vec3 p = to_vec3(mesh.point(element[i]));
      return Predicates_kernel::Point_3(p[0], p[1], p[2]);
    };
    const Reference_element& reference = element.reference();
    for(int c = 0; c < reference.number_of_corners; ++c) {
      const auto& i = reference.corners[c];
      defects.nonpositive_corners += orientation(point(i[0]), point(i[1]), point(i[2]), point(i[3]))
                                     != POSITIVE;
    }
  }
}

// Whether two faces with the same vertices have opposite orientations.
inline bool are_opposite(const Face_vertices& a, const Face_vertices& b)
{
  const int in_b = int(std::find(b.begin(), b.end(), a[0]) - b.begin());
  for(int i = 0; i < a.size(); ++i)
    if(a[i] != b[(in_b + a.size() - i) % a.size()])
      return false;
  return true;
}

/// \return the boundary faces, as `boundary_faces()` gives them
template <class Mesh>
std::vector<Face> find_nonconforming_faces(const Mesh& mesh, Mesh_defects& defects)
{
  std::vector<Face> faces;
  for_each_face(mesh.elements(), mesh.number_of_vertices(), [&](const auto& group) {
    if(group.size() == 1)
      faces.push_back(group[0]);
    else if(group.size() > 2 || !are_opposite(group[0].vertices(), group[1].vertices()))
      ++defects.nonconforming_faces;
  });
  std::sort(faces.begin(), faces.end());
  std::vector<Face_vertices> boundary;
  boundary.reserve(faces.size());
  for(const Face& face : faces)
    boundary.push_back(face.vertices());
  // A quadrilateral against two triangles leaves all three faces on the "boundary".
  std::vector<std::array<Vertex_index, 4>> triangles;
  for(const Face_vertices& p : boundary)
    if(p.size() == 3) {
      triangles.push_back(p.padded());
      sort_vertices(triangles.back());
    }
  std::sort(triangles.begin(), triangles.end());
  for(const Face_vertices& p : boundary)
    if(p.size() == 4)
      for(std::size_t i = 0; i < 4; ++i) {
        std::array<Vertex_index, 4> t = p.padded();
        t[i] = no_vertex;
        sort_vertices(t);
        if(std::binary_search(triangles.begin(), triangles.end(), t)) {
          ++defects.nonconforming_faces;
          break;
        }
      }
  const Manifold_defects manifold = manifold_defects(boundary);
  defects.nonmanifold_boundary_edges = manifold.edges.size();
  defects.nonmanifold_boundary_vertices = manifold.vertices.size();
  return faces;
}

/// The defects of a mesh, and its boundary, which is found on the way.
struct Examined_mesh
{
  Mesh_defects defects;
  std::vector<Face> boundary; ///< as `boundary_faces()` gives it; empty if there are invalid elements
};

template <class Mesh>
Examined_mesh examine_mesh(const Mesh& mesh)
{
  Examined_mesh result;
  Mesh_defects& defects = result.defects;
  find_invalid_elements(mesh, defects);
  find_bad_vertices(mesh, defects);
  if(defects.invalid_elements == 0) {
    if(defects.nonfinite_vertices == 0) // exact predicates need numbers
      find_nonpositive_elements(mesh, defects);
    result.boundary = find_nonconforming_faces(mesh, defects);
  }
  return result;
}

} // namespace internal

/*!
\ingroup PkgMixedMesh3Validity

Finds all defects that a finite-element solver would fail on.

Signs are exact on the coordinates as doubles, and signs of Jacobians hold on whole elements: a mesh without
defects has no inverted element.

\par Complexity
O(n log n) for n elements; about 120 bytes per hexahedron
*/
template <class Mesh>
Mesh_defects find_defects(const Mesh& mesh)
{
  return internal::examine_mesh(mesh).defects;
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_MESH_DEFECTS_H
