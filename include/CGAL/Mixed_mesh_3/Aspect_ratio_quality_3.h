// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cost of an element in the fitting and the optimization: the aspect-ratio coefficient of the paper, that
// of the corners, and the warp of the faces.

#ifndef CGAL_MIXED_MESH_3_ASPECT_RATIO_QUALITY_3_H
#define CGAL_MIXED_MESH_3_ASPECT_RATIO_QUALITY_3_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/internal/elements/Aspect_ratio_parts.h>
#include <CGAL/Mixed_mesh_3/internal/elements/aspect_ratio.h>
#include <CGAL/Mixed_mesh_3/internal/elements/with_kind.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>

namespace CGAL {
namespace Mixed_meshes_3 {

/*!
\ingroup PkgMixedMesh3Costs

\brief The aspect-ratio coefficient as the cost of an element, with a penalty for warped faces.

The cost of a tetrahedron is its aspect-ratio coefficient (ARC, see `aspect_ratio_coefficient()`). The cost of
other kinds is the largest of the ARC and of those of the corner tetrahedra, divided by their value in the
ideal element, times `1 + warp_weight (1 - cos(warp))`, where warp is the largest angle between the normals of
the two triangles of a quadrilateral face, along either diagonal.

\cgalModels{MixedMeshQuality_3}
*/
class Aspect_ratio_quality_3
{
  using Points = std::array<Vec3, 8>;
  using Parts = internal::Aspect_ratio_parts;

  double m_acceptable = 7;
  double m_warp_weight = 30;

  // ARC of the corner tetrahedra of the ideal elements: edges of length 1, height of the pyramid 1.
  static constexpr double ideal_corner[] = {1, 1.1932324, 1.2580589, 1.3000510};
  static_assert(std::size(ideal_corner) == number_of_element_kinds, "a value for each kind");

public:
  /// \param acceptable cost above which Algorithm 1 stiffens an element; the paper's bound is 7
  /// \param warp_weight weight of a warped face; 0 for the plain measure
  explicit Aspect_ratio_quality_3(double acceptable = 7, double warp_weight = 30)
    : m_acceptable(acceptable), m_warp_weight(warp_weight)
  {
  }

  bool is_acceptable(double cost) const { return cost <= m_acceptable; }

  /// The cost: at least 1, infinity if a corner is not positive.
  double operator()(Element_kind kind, const Points& p) const
  {
    Parts parts;
    return evaluate<false>(kind, p, 0, parts, 0, nullptr);
  }

  /// The cost, and its gradient by the position of vertex `v`.
  double operator()(Element_kind kind, const Points& p, int v, Vec3& gradient) const
  {
    Parts parts;
    return evaluate<true>(kind, p, v, parts, 0, &gradient);
  }

  /// \cond not public
  /// The cost and its gradient, with the parts from which they are.
  double operator()(Element_kind kind, const Points& p, int v, Vec3& gradient,
                    internal::Aspect_ratio_parts& parts) const
  {
    return evaluate<true>(kind, p, v, parts, 0, &gradient);
  }

  /// The cost after a move of vertex `v` only, since the parts were computed.
  double cost_after_move(Element_kind kind, const Points& p, int v, internal::Aspect_ratio_parts& parts) const
  {
    return evaluate<false>(kind, p, v, parts, v, nullptr);
  }
  /// \endcond

private:
  // \param moved the vertex that moved since the parts were computed; 0: all parts are computed
  template <bool with_gradient>
  double evaluate(Element_kind kind, const Points& p, int v, Parts& parts, int moved, Vec3* gradient) const
  {
    return internal::with_kind(kind, [&](auto k) {
      return this->evaluate<decltype(k)::value, with_gradient>(p, v, parts, moved, gradient);
    });
  }

  template <Element_kind kind, bool with_gradient>
  double evaluate(const Points& p, int v, Parts& parts, int moved, Vec3* gradient) const
  {
    using namespace internal;
    if(kind == TETRAHEDRON) {
      const double arc = std::sqrt(squared_tetrahedron_arc(p[0], p[1], p[2], p[3]));
      if constexpr(with_gradient)
        *gradient = arc * corner_gradient(reference_elements[kind].corners[0], p, v);
      return arc;
    }
    parts.update<kind>(p, moved);
    const double worst_corner = parts.largest_squared_arc<kind>();
    double worst = std::sqrt(worst_corner) / ideal_corner[kind];
    if(worst == std::numeric_limits<double>::infinity()) {
      if constexpr(with_gradient)
        *gradient = Vec3{};
      return worst;
    }
    Vec3 logarithmic{};
    const auto [longest, shortest] = extreme_lengths<with_gradient>(kind, p, v);
    if(longest.value > worst * shortest.value) {
      worst = longest.value / shortest.value;
      if constexpr(with_gradient)
        logarithmic = (1 / longest.value) * longest.gradient - (1 / shortest.value) * shortest.gradient;
    } else if constexpr(with_gradient) {
      logarithmic = corner_gradient(parts.corner_with<kind>(worst_corner), p, v);
    }
    const int diagonal = parts.most_warped<kind>();
    const double factor = 1 + m_warp_weight * parts.warp(diagonal);
    if constexpr(with_gradient)
      *gradient = (worst * factor) * logarithmic
                  + (worst * m_warp_weight) * parts.warp_gradient<kind>(diagonal, p, v);
    return worst * factor;
  }

  static Vec3 corner_gradient(const std::uint8_t (&c)[4], const Points& p, int v)
  {
    for(const auto& o : internal::even_permutations)
      if(c[o[0]] == v)
        return internal::tetrahedron_arc_gradient(p[c[o[0]]], p[c[o[1]]], p[c[o[2]]], p[c[o[3]]]);
    return Vec3{};
  }
};

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_ASPECT_RATIO_QUALITY_3_H
