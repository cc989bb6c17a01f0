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
#include <CGAL/Mixed_mesh_3/internal/elements/aspect_ratio.h>
#include <CGAL/Mixed_mesh_3/internal/elements/element_measures.h>
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
  double operator()(Element_kind kind, const Points& p) const { return evaluate<false>(kind, p, 0, nullptr); }

  /// The cost, and its gradient by the position of vertex `v`.
  double operator()(Element_kind kind, const Points& p, int v, Vec3& gradient) const
  {
    return evaluate<true>(kind, p, v, &gradient);
  }

private:
  template <bool with_gradient>
  double evaluate(Element_kind kind, const Points& p, int v, Vec3* gradient) const
  {
    using namespace internal;
    if(kind == TETRAHEDRON) {
      const double arc = std::sqrt(squared_tetrahedron_arc(p[0], p[1], p[2], p[3]));
      if constexpr(with_gradient)
        *gradient = arc * corner_gradient(reference_elements[kind].corners[0], p, v);
      return arc;
    }
    const Reference_element& reference = reference_elements[kind];
    double worst = 0;
    int worst_corner = 0;
    for(int c = 0; c < reference.number_of_corners; ++c) {
      const auto& k = reference.corners[c];
      const double q = squared_tetrahedron_arc(p[k[0]], p[k[1]], p[k[2]], p[k[3]]);
      if(q > worst) {
        worst = q;
        worst_corner = c;
      }
    }
    worst = std::sqrt(worst) / ideal_corner[kind];
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
      logarithmic = corner_gradient(reference.corners[worst_corner], p, v);
    }
    Vec3 warp_gradient{};
    const double factor = 1 + m_warp_weight * warp<with_gradient>(reference, p, v, warp_gradient);
    if constexpr(with_gradient)
      *gradient = (worst * factor) * logarithmic + (worst * m_warp_weight) * warp_gradient;
    return worst * factor;
  }

  static Vec3 corner_gradient(const std::uint8_t (&c)[4], const Points& p, int v)
  {
    for(const auto& o : internal::even_permutations)
      if(c[o[0]] == v)
        return internal::tetrahedron_arc_gradient(p[c[o[0]]], p[c[o[1]]], p[c[o[2]]], p[c[o[3]]]);
    return Vec3{};
  }

  // Computes 1 - cos of the largest warp.
  template <bool with_gradient>
  static double warp(const Reference_element& reference, const Points& p, int v, Vec3& gradient)
  {
    using namespace internal;
    // The smallest cosine has the smallest square, if signs are kept: one root suffices.
    double least = 1, product = 1, squares = 1; // product of the normals; of squared lengths
    int worst_face = -1, worst_diagonal = 0;
    for(int f = 0; f < reference.number_of_faces; ++f)
      if(reference.faces[f].size == 4)
        for(int diagonal = 0; diagonal < 2; ++diagonal) {
          const auto [n, m] = triangle_normals(reference.faces[f], diagonal, p);
          const double nm = dot(n, m), nn_mm = dot(n, n) * dot(m, m);
          if(const double square = nm * std::abs(nm) / nn_mm; square < least) {
            least = square;
            product = nm;
            squares = nn_mm;
            worst_face = f;
            worst_diagonal = diagonal;
          }
        }
    const double worst = 1 - product / std::sqrt(squares);
    if constexpr(with_gradient)
      if(worst_face >= 0) {
        const Element_face& face = reference.faces[worst_face];
        const auto [n, m] = triangle_normals(face, worst_diagonal, p);
        const double ln = norm(n), lm = norm(m), cosine = 1 - worst;
        const Vec3 un = (1 / ln) * n, um = (1 / lm) * m;
        // The derivatives of the cosine by the two normals.
        const Vec3 gn = (1 / ln) * (um - cosine * un), gm = (1 / lm) * (un - cosine * um);
        const auto at = [&](int i) { return int(face.vertices[(i + worst_diagonal) % 4]); };
        const Vec3 &a = p[at(0)], &b = p[at(1)], &c = p[at(2)], &d = p[at(3)];
        // The normals are n = (b - a) x (c - a), m = (c - a) x (d - a).
        if(v == at(0))
          gradient = cross(gn, b - c) + cross(gm, c - d);
        else if(v == at(1))
          gradient = cross(gn, c - a);
        else if(v == at(2))
          gradient = cross(gn, a - b) + cross(gm, d - a);
        else if(v == at(3))
          gradient = cross(gm, a - c);
      }
    return worst;
  }
};

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_ASPECT_RATIO_QUALITY_3_H
