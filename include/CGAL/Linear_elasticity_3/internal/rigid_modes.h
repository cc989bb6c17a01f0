// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rigid motions that the supports of a body leave free.

#ifndef CGAL_LINEAR_ELASTICITY_3_INTERNAL_RIGID_MODES_H
#define CGAL_LINEAR_ELASTICITY_3_INTERNAL_RIGID_MODES_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/internal/base/Disjoint_sets.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The support of a node: orthonormal directions in which its displacement is given, and that displacement.
struct Support
{
  int size = 0;
  std::array<Vec3, 3> directions{};
  Vec3 displacement{}; // zero in the other directions

  /// Holds the vertex in one more direction, unless it is held in that direction already.
  void add(Vec3 d)
  {
    const double length = norm(d);
    for(int i = 0; i < size; ++i)
      d = d - dot(directions[i], d) * directions[i];
    if(size < 3 && norm(d) > 1e-8 * length)
      directions[size++] = (1 / norm(d)) * d;
  }

  /// The part of a vector in the directions that are free.
  Vec3 free_part(Vec3 u) const
  {
    for(int i = 0; i < size; ++i)
      u = u - dot(directions[i], u) * directions[i];
    return u;
  }
};

/// The support, without displacement, in the directions in which both of two supports hold: directions of the
/// two that are up to 60 degrees apart, as normals of a curved boundary are, count as their mean direction.
inline Support common_support(const Support& a, const Support& b)
{
  Eigen::Matrix3d held = Eigen::Matrix3d::Zero(); // the sum of two projections: eigenvalues are 1 + cosines
  for(const Support* support : {&a, &b})
    for(int i = 0; i < support->size; ++i) {
      const Eigen::Vector3d d(support->directions[std::size_t(i)].data());
      held += d * d.transpose();
    }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(held);
  Support common;
  for(int i = 0; i < 3; ++i)
    if(solver.eigenvalues()[i] > 1.5) {
      const Eigen::Vector3d d = solver.eigenvectors().col(i);
      common.add({d[0], d[1], d[2]});
    }
  return common;
}

/// A rigid motion: displacement `translation + rotation x (p - center)` at `p`.
struct Rigid_mode
{
  Vec3 translation, rotation, center;
  Vec3 operator()(const Vec3& p) const { return translation + cross(rotation, p - center); }
};

/// A rigid motion that supports leave free, and the vertices that it moves.
struct Free_motion
{
  Rigid_mode mode;
  std::vector<Vertex_index> vertices;
};

/// The vertices of each connected part of some elements: connected by common vertices.
template <class Is_kept>
std::vector<std::vector<Vertex_index>>
connected_vertices(const Element_list& elements, std::size_t number_of_vertices, const Is_kept& is_kept)
{
  Disjoint_sets sets(number_of_vertices);
  std::vector<bool> is_used(number_of_vertices, false);
  for(Element_index e = 0; e < elements.size(); ++e)
    if(is_kept(e))
      for(Vertex_index v : elements[e]) {
        is_used[v] = true;
        sets.unite(v, elements[e][0]);
      }
  std::vector<std::vector<Vertex_index>> parts;
  std::vector<std::size_t> part_of(number_of_vertices, 0);
  for(Vertex_index v = 0; v < number_of_vertices; ++v)
    if(is_used[v]) {
      const std::size_t least = sets.least(v);
      if(least == v) {
        part_of[v] = parts.size();
        parts.emplace_back();
      }
      parts[part_of[least]].push_back(v);
    }
  return parts;
}

/*!
A basis of the rigid motions of a body that its supports allow.

The motions that a support forbids have a component in its directions; the squares of these components make a
6x6 matrix, whose kernel is the set of free motions. Rotations are scaled by the size of the body, so that all
entries are lengths.
*/
inline std::vector<Rigid_mode> free_rigid_modes(const std::vector<Vertex_index>& vertices,
                                                const std::vector<Vec3>& points,
                                                const std::vector<Support>& supports)
{
  constexpr double tolerance = 1e-11; // of the kernel, relative to the trace: 3e-6 of the size, squared
  Vec3 center{};
  for(Vertex_index v : vertices)
    center = center + (1 / double(vertices.size())) * points[v];
  double size = 0;
  for(Vertex_index v : vertices)
    size = (std::max)(size, norm(points[v] - center));

  using Vector_6 = Eigen::Matrix<double, 6, 1>;
  Eigen::Matrix<double, 6, 6> held = Eigen::Matrix<double, 6, 6>::Zero();
  for(Vertex_index v : vertices)
    for(int i = 0; i < supports[v].size; ++i) {
      const Vec3& d = supports[v].directions[i];
      const Vec3 moment = (1 / size) * cross(points[v] - center, d);
      Vector_6 row;
      row << d[0], d[1], d[2], moment[0], moment[1], moment[2];
      held += row * row.transpose();
    }
  std::vector<Rigid_mode> modes;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(held);
  const double bound = tolerance * held.trace();
  for(int i = 0; i < 6; ++i)
    if(solver.eigenvalues()[i] <= bound) {
      const Vector_6 m = solver.eigenvectors().col(i);
      modes.push_back({{m[0], m[1], m[2]}, {m[3] / size, m[4] / size, m[5] / size}, center});
    }
  return modes;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_INTERNAL_RIGID_MODES_H
