// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fields that are quadratic between the vertices of an element.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_QUADRATIC_FIELD_H
#define CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_QUADRATIC_FIELD_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Mixed_element_traits_3.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/Isoparametric_map_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// A vector for each pair of vertices of an element, the pair (i, j) with i < j at `pair_index(i, j)`: the
/// number of vectors in use is the number of pairs of the kind.
using Bubbles = std::array<Vec3, 28>;

constexpr int pair_index(int i, int j) { return j * (j - 1) / 2 + i; }

constexpr int number_of_pairs(Element_kind kind)
{
  return pair_index(0, reference_elements[kind].number_of_vertices);
}

/// The largest sum of the products of two different shape functions: the sum is (1 - the sum of their
/// squares) / 2, and is largest where all shape functions are equal.
constexpr double largest_sum_of_products(Element_kind kind)
{
  return 0.5 * (1 - 1. / reference_elements[kind].number_of_vertices);
}

/// The largest displacement of points of an element by bubbles, in each direction.
inline Vec3 bubble_extent(Element_kind kind, const Bubbles& bubbles)
{
  Vec3 largest{};
  for(int i = 0; i < number_of_pairs(kind); ++i)
    for(int k = 0; k < 3; ++k)
      largest[k] = (std::max)(largest[k], std::abs(bubbles[std::size_t(i)][k]));
  return largest_sum_of_products(kind) * largest;
}

/*!
A field given at the vertices, and by bubbles at pairs of them:

\f[ x = \sum_i N_i p_i + \sum_{i < j} N_i N_j b_{ij} \f]

The field on a face depends only on the vertices of the face and on their pairs: so the field is continuous.
*/
template <Element_kind Kind>
class Quadratic_field : public Element_field<Kind>
{
  static constexpr int n = reference_elements[Kind].number_of_vertices;
  std::array<Vec3, std::size_t(number_of_pairs(Kind))> m_bubbles;

public:
  Quadratic_field(const Vec3* p, const Bubbles& bubbles) : Element_field<Kind>(p)
  {
    std::copy_n(bubbles.begin(), m_bubbles.size(), m_bubbles.begin());
  }

  /// A bound for the contribution of the nonlinear part to `dot(v, x)` in the element.
  double deviation(const Vec3& v) const
  {
    double largest = 0;
    for(const Vec3& b : m_bubbles)
      largest = (std::max)(largest, std::abs(dot(v, b)));
    return Element_field<Kind>::deviation(v) + largest_sum_of_products(Kind) * largest;
  }

  Vec3 operator()(const Vec3& r) const
  {
    const auto w = Mixed_element_traits_3<Kind>::shape_functions(r[0], r[1], r[2]);
    Vec3 x = Element_field<Kind>::operator()(r);
    for(int j = 1; j < n; ++j) {
      Vec3 sum = w[0] * m_bubbles[pair_index(0, j)];
      for(int i = 1; i < j; ++i)
        sum = sum + w[i] * m_bubbles[pair_index(i, j)];
      x = x + w[j] * sum;
    }
    return x;
  }

  /// Derivatives by r, s and t. \pre not the pyramid's apex
  std::array<Vec3, 3> derivatives(const Vec3& r) const { return value_and_derivatives(r).second; }

  std::pair<Vec3, std::array<Vec3, 3>> value_and_derivatives(const Vec3& r) const
  {
    const auto w = Mixed_element_traits_3<Kind>::shape_functions(r[0], r[1], r[2]);
    const auto g = Mixed_element_traits_3<Kind>::shape_gradients(r[0], r[1], r[2]);
    std::pair<Vec3, std::array<Vec3, 3>> result{Element_field<Kind>::operator()(r),
                                                Element_field<Kind>::derivatives(r)};
    for(int i = 0; i < n; ++i) {
      Vec3 sum{}; // factor of N_i in the sum over the bubbles
      for(int j = 0; j < i; ++j)
        sum = sum + w[j] * m_bubbles[pair_index(j, i)];
      result.first = result.first + w[i] * sum;
      for(int j = i + 1; j < n; ++j)
        sum = sum + w[j] * m_bubbles[pair_index(i, j)];
      for(int k = 0; k < 3; ++k)
        result.second[k] = result.second[k] + g[i][k] * sum;
    }
    return result;
  }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_QUADRATIC_FIELD_H
