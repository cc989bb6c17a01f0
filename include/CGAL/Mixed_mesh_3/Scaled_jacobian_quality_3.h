// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_SCALED_JACOBIAN_QUALITY_3_H
#define CGAL_MIXED_MESH_3_SCALED_JACOBIAN_QUALITY_3_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <array>
#include <cmath>
#include <iterator>
#include <limits>

namespace CGAL {
namespace Mixed_meshes_3 {

/*!
\ingroup PkgMixedMesh3Costs

\brief The reciprocal of the scaled Jacobian as the cost of an element.

Only angles count: a hexahedron with right angles has the cost 1 for any edge lengths, and the warp of faces
counts only by the angles at its corners. See `scaled_jacobian`.

\cgalModels{MixedMeshQuality_3}
*/
class Scaled_jacobian_quality_3
{
  using Points = std::array<Vec3, 8>;

  double m_acceptable;

  // The determinant of three edges divided by their lengths, in the ideal elements: all edges are equal.
  static constexpr double ideal[] = {0.70710678118654752, 0.5, 0.86602540378443865, 1};
  static_assert(std::size(ideal) == number_of_element_kinds, "a value for each kind");

public:
  /// \param acceptable cost above which Algorithm 1 stiffens an element; 5 is a scaled Jacobian of 0.2
  explicit Scaled_jacobian_quality_3(double acceptable = 5) : m_acceptable(acceptable) {}

  bool is_acceptable(double cost) const { return cost <= m_acceptable; }

  /// The cost: at least 1, infinity if a corner is not positive.
  double operator()(Element_kind kind, const Points& p) const
  {
    return cost(kind, find_smallest(kind, p).value);
  }

  /// The cost, and its gradient by the position of vertex `v`.
  double operator()(Element_kind kind, const Points& p, int v, Vec3& gradient) const
  {
    using namespace internal;
    const Corner corner = find_smallest(kind, p);
    const double q = cost(kind, corner.value), scaled = corner.value / ideal[kind];
    const double slope = kind == PYRAMID && scaled > 1 ? scaled * q * q : -q;
    gradient = corner.value > 0 ? slope * logarithmic_gradient(corner, p, v) : Vec3{};
    return q;
  }

private:
  // The three edges from a vertex, which is the first one; positive if they are right-handed in that order.
  struct Corner
  {
    double value; // determinant of the edges divided by their lengths
    std::array<int, 4> vertices;
  };

  static double cost(Element_kind kind, double value)
  {
    if(!(value > 0))
      return std::numeric_limits<double>::infinity();
    const double scaled = value / ideal[kind];
    return 1 / (kind == PYRAMID && scaled > 1 ? 2 - scaled : scaled); // some pyramids reach 1.14
  }

  static Corner find_smallest(Element_kind kind, const Points& p)
  {
    using namespace internal;
    const Reference_element& reference = reference_elements[kind];
    const int corners_of_each = kind == TETRAHEDRON || kind == PYRAMID ? 4 : 1;
    Corner smallest{std::numeric_limits<double>::infinity(), {}};
    for(int c = 0; c < (kind == TETRAHEDRON ? 1 : reference.number_of_corners); ++c)
      for(int i = 0; i < corners_of_each; ++i) {
        const auto& k = reference.corners[c];
        const int(&o)[4] = even_permutations[i]; // a tetrahedron has four corners
        const std::array<int, 4> v{k[o[0]], k[o[1]], k[o[2]], k[o[3]]};
        const Vec3 a = p[v[1]] - p[v[0]], b = p[v[2]] - p[v[0]], d = p[v[3]] - p[v[0]];
        const double six_volumes = determinant(a, b, d);
        if(!(six_volumes > 0))
          return {0, v};
        const double value = six_volumes / std::sqrt(dot(a, a) * dot(b, b) * dot(d, d));
        if(value < smallest.value)
          smallest = {value, v};
      }
    return smallest;
  }

  // The logarithmic gradient of the value of a corner.
  static Vec3 logarithmic_gradient(const Corner& corner, const Points& p, int v)
  {
    using namespace internal;
    const auto& k = corner.vertices;
    const Vec3 edges[3] = {p[k[1]] - p[k[0]], p[k[2]] - p[k[0]], p[k[3]] - p[k[0]]};
    const double six_volumes = determinant(edges[0], edges[1], edges[2]);
    Vec3 sum{}; // sum of the gradients by the ends of the edges
    for(int i = 0; i < 3; ++i) {
      const Vec3 gradient = (1 / six_volumes) * cross(edges[(i + 1) % 3], edges[(i + 2) % 3])
                            - (1 / dot(edges[i], edges[i])) * edges[i];
      if(k[i + 1] == v)
        return gradient;
      sum = sum + gradient;
    }
    return k[0] == v ? -1. * sum : Vec3{};
  }
};

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_SCALED_JACOBIAN_QUALITY_3_H
