// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cost of an element that the fitting and the optimization work with: the aspect-ratio coefficient
// of the paper, that of the corners, and the warp of the faces.

#ifndef CGAL_MIXED_MESH_3_ASPECT_RATIO_QUALITY_3_H
#define CGAL_MIXED_MESH_3_ASPECT_RATIO_QUALITY_3_H

#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/internal/elements/element_measures.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace CGAL {
namespace Mixed_meshes_3 {

namespace internal {

// A length and its derivative by the position of one vertex.
struct Length
{
  double value;
  Vec3 gradient;
};

// The square of the ARC of the tetrahedron of four points: without roots.
inline double squared_tetrahedron_arc(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  const Vec3 ab = b - a, ac = c - a, ad = d - a, bc = c - b, bd = d - b, cd = d - c;
  const double six_volumes = determinant(ab, ac, ad);
  if(!(six_volumes > 0))
    return std::numeric_limits<double>::infinity();
  const double l2 =
    (dot(ab, ab) + dot(ac, ac) + dot(ad, ad) + dot(bc, bc) + dot(bd, bd) + dot(cd, cd)) / 6;
  constexpr double factor = 36 / (tetrahedron_arc_factor * tetrahedron_arc_factor);
  return factor * l2 * l2 * l2 / (six_volumes * six_volumes);
}

// The logarithmic gradient of the ARC, by the position of x, where x, u, v, w is an even permutation.
inline Vec3 tetrahedron_arc_gradient(const Vec3& x, const Vec3& u, const Vec3& v, const Vec3& w)
{
  const Vec3 xu = u - x, xv = v - x, xw = w - x, uv = v - u, uw = w - u, vw = w - v;
  const double sum =
    dot(xu, xu) + dot(xv, xv) + dot(xw, xw) + dot(uv, uv) + dot(uw, uw) + dot(vw, vw);
  const Vec3 area = cross(uw, uv); // of the face opposite to x, inwards, times 2
  return (-3 / sum) * (xu + xv + xw) - (1 / determinant(xu, xv, xw)) * area;
}

} // namespace internal

/*!
\brief The aspect-ratio coefficient as the cost of an element, with a penalty for warped faces.

For a tetrahedron the cost is its aspect-ratio coefficient (ARC, see `aspect_ratio_coefficient()`). For
other kinds it is the largest of the ARC and of those of the corner tetrahedra, divided by the value they
have in the ideal element, times `1 + warp_weight (1 - cos(warp))`, where warp is the largest angle between
the normals of the two triangles of a quadrilateral face, along either diagonal.

\cgalModels{MixedMeshQuality_3}
*/
class Aspect_ratio_quality_3
{
  using Points = std::array<Vec3, 8>;

  double m_acceptable = 7;
  double m_warp_weight = 30;

  // Of the corner tetrahedra of the ideal elements: edges of length 1, height of the pyramid 1.
  static constexpr double ideal_corner[number_of_element_kinds] = {1, 1.1932324, 1.2580589, 1.3000510};

public:
  /// \param acceptable costs above it make Algorithm 1 stiffen an element; the paper's bound is 7
  /// \param warp_weight how much a warped face counts; 0 for the plain measure
  explicit Aspect_ratio_quality_3(double acceptable = 7, double warp_weight = 30)
    : m_acceptable(acceptable), m_warp_weight(warp_weight)
  {}

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

  struct Extremes
  {
    internal::Length longest, shortest;
    void add(const internal::Length& l)
    {
      if(l.value > longest.value)
        longest = l;
      if(l.value < shortest.value)
        shortest = l;
    }
  };

  // The means of some vertices, and the weight that vertex v has in it.
  template <int n>
  struct Mean
  {
    Vec3 point{};
    double weight = 0;

    template <class Index>
    Mean(const Points& p, const Index (&vertices)[n], int v)
    {
      using namespace internal;
      for(int i : vertices) {
        point = point + p[i];
        weight += i == v;
      }
      point = (1. / n) * point;
      weight /= n;
    }
  };

  template <bool with_gradient, int n>
  static internal::Length segment(const Mean<n>& a, const Mean<n>& b)
  {
    using namespace internal;
    const Vec3 d = a.point - b.point;
    const double length = norm(d);
    if constexpr(with_gradient)
      return {length, ((a.weight - b.weight) / length) * d};
    else
      return {length, {}};
  }

  // The two lengths whose ratio is the ARC.
  template <bool with_gradient>
  static Extremes extreme_lengths(Element_kind kind, const Points& p, int v)
  {
    Extremes e{{0, {}}, {std::numeric_limits<double>::infinity(), {}}};
    const auto add_segment = [&](Extremes& extremes, const auto& a, const auto& b) {
      extremes.add(segment<with_gradient>(Mean(p, a, v), Mean(p, b, v)));
    };
    constexpr int pyramid[4][2] = {{2, 3}, {0, 1}, {1, 2}, {3, 0}};
    if(kind == HEXAHEDRON) {
      const auto& faces = reference_elements[kind].faces; // opposite ones side by side
      for(int i = 0; i < 6; i += 2)
        add_segment(e, faces[i + 1].vertices, faces[i].vertices);
    } else if(kind == PYRAMID) {
      for(int i = 0; i < 4; i += 2)
        add_segment(e, pyramid[i], pyramid[i + 1]);
      e.add(pyramid_height(p, v));
    } else {
      Extremes worst = e;
      double worst_ratio = 0;
      for(int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const int at_i[2] = {i, i + 3}, at_j[2] = {j, j + 3}, at_k[2] = {k, k + 3};
        const int bottom[2] = {i, j}, top[2] = {i + 3, j + 3};
        Extremes face = e;
        add_segment(face, at_j, at_i);
        add_segment(face, top, bottom);
        face.add(triangle_height(Mean(p, at_i, v), Mean(p, at_j, v), Mean(p, at_k, v)));
        const double ratio = face.longest.value / face.shortest.value;
        if(ratio > worst_ratio) {
          worst_ratio = ratio;
          worst = face;
        }
      }
      return worst;
    }
    return e;
  }

  // Of the apex over the base's mean plane.
  static internal::Length pyramid_height(const Points& p, int v)
  {
    using namespace internal;
    const Vec3 a = p[2] - p[0], b = p[3] - p[1], n = cross(a, b);
    const double area = norm(n);
    const Vec3 unit = (1 / area) * n, w = p[4] - 0.25 * (p[0] + p[1] + p[2] + p[3]);
    const double height = dot(unit, w);
    if(v == 4)
      return {height, unit};
    const Vec3 tilt = (1 / area) * (w - height * unit);
    const Vec3 turn = v % 2 == 0 ? cross(b, tilt) : cross(tilt, a);
    return {height, (v >= 2 ? 1. : -1.) * turn - 0.25 * unit};
  }

  // Of c over ab.
  static internal::Length triangle_height(const Mean<2>& a, const Mean<2>& b, const Mean<2>& c)
  {
    using namespace internal;
    const Vec3 u = b.point - a.point, w = c.point - a.point, n = cross(u, w);
    const double width = norm(u), area = norm(n);
    if(!(width > 0 && area > 0))
      return {0, {}};
    const Vec3 unit = (1 / area) * n;
    const double wu = b.weight - a.weight, ww = c.weight - a.weight;
    const Vec3 area_gradient = wu * cross(w, unit) + ww * cross(unit, u);
    return {area / width, (1 / width) * area_gradient - (wu * area / (width * width * width)) * u};
  }

  // 1 - cos of the largest warp.
  template <bool with_gradient>
  static double warp(const Reference_element& reference, const Points& p, int v, Vec3& gradient)
  {
    using namespace internal;
    double worst = 0;
    int worst_face = -1, worst_diagonal = 0;
    for(int f = 0; f < reference.number_of_faces; ++f)
      if(reference.faces[f].size == 4)
        for(int diagonal = 0; diagonal < 2; ++diagonal) {
          const auto [n, m] = triangle_normals(reference.faces[f], diagonal, p);
          const double w = 1 - dot(n, m) / std::sqrt(dot(n, n) * dot(m, m));
          if(w > worst) {
            worst = w;
            worst_face = f;
            worst_diagonal = diagonal;
          }
        }
    if constexpr(with_gradient)
      if(worst_face >= 0) {
        const Element_face& face = reference.faces[worst_face];
        const auto [n, m] = triangle_normals(face, worst_diagonal, p);
        const double ln = norm(n), lm = norm(m), cosine = 1 - worst;
        const Vec3 un = (1 / ln) * n, um = (1 / lm) * m;
        // derivatives of the cosine by the two normals
        const Vec3 gn = (1 / ln) * (um - cosine * un), gm = (1 / lm) * (un - cosine * um);
        const auto at = [&](int i) { return int(face.vertices[(i + worst_diagonal) % 4]); };
        const Vec3 &a = p[at(0)], &b = p[at(1)], &c = p[at(2)], &d = p[at(3)];
        // n = (b - a) x (c - a), m = (c - a) x (d - a)
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
