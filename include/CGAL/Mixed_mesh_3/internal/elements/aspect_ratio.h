// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The paper's aspect-ratio coefficient (ARC; Lobos, Bucki, Hitschfeld, Payan: section 4), with its gradient:
// the only place with its formula.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_ASPECT_RATIO_H
#define CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_ASPECT_RATIO_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Mixed_element_traits_3.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/element_points.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

// The factor of the paper, with which the ARC of the regular tetrahedron is nearly 1: the exact factor is 6
// sqrt(2).
inline constexpr double tetrahedron_arc_factor = 8.47867;

// A length and its derivative by the position of one vertex.
struct Length
{
  double value;
  Vec3 gradient;
};

// The square of the ARC of a tetrahedron with that sum of the squared edges, and six times the volume.
inline double squared_tetrahedron_arc(double squared_edges, double six_volumes)
{
  // 36: six volumes, squared.
  constexpr double factor = 36 / (tetrahedron_arc_factor * tetrahedron_arc_factor);
  const double l2 = squared_edges / 6;
  return factor * l2 * l2 * l2 / (six_volumes * six_volumes);
}

// The square of the ARC of the tetrahedron of four points, computed without roots.
inline double squared_tetrahedron_arc(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  const Vec3 ab = b - a, ac = c - a, ad = d - a, bc = c - b, bd = d - b, cd = d - c;
  const double six_volumes = determinant(ab, ac, ad);
  if(!(six_volumes > 0))
    return std::numeric_limits<double>::infinity();
  return squared_tetrahedron_arc(dot(ab, ab) + dot(ac, ac) + dot(ad, ad) + dot(bc, bc) + dot(bd, bd)
                                   + dot(cd, cd),
                                 six_volumes);
}

// The logarithmic gradient of the ARC, by the position of x, where x, u, v, w is an even permutation.
inline Vec3 tetrahedron_arc_gradient(const Vec3& x, const Vec3& u, const Vec3& v, const Vec3& w)
{
  const Vec3 xu = u - x, xv = v - x, xw = w - x, uv = v - u, uw = w - u, vw = w - v;
  const double sum = dot(xu, xu) + dot(xv, xv) + dot(xw, xw) + dot(uv, uv) + dot(uw, uw) + dot(vw, vw);
  const Vec3 area = cross(uw, uv); // vector area of the face opposite to x, inwards, times 2
  return (-3 / sum) * (xu + xv + xw) - (1 / determinant(xu, xv, xw)) * area;
}

/// The longest and the shortest of some lengths.
struct Extreme_lengths
{
  Length longest, shortest;
  /// The ratio, at least 1; infinity where an element is flat.
  double ratio() const
  {
    return shortest.value > 0 ? longest.value / shortest.value : std::numeric_limits<double>::infinity();
  }

  template <bool with_gradient>
  void add(const Length& l)
  {
    if constexpr(with_gradient) {
      if(l.value > longest.value)
        longest = l;
      if(l.value < shortest.value)
        shortest = l;
    } else { // without branches, which processors would not predict
      longest.value = (std::max)(longest.value, l.value);
      shortest.value = (std::min)(shortest.value, l.value);
    }
  }
};

// The mean of some vertices, and the weight of vertex v in the mean.
template <int n>
struct Mean
{
  Vec3 point{};
  double weight = 0;

  template <class Index>
  Mean(const Element_points& p, const Index (&vertices)[n], int v)
  {
    for(int i : vertices) {
      point = point + p[i];
      weight += i == v;
    }
    point = (1. / n) * point;
    weight /= n;
  }
};

template <bool with_gradient, int n>
Length segment(const Mean<n>& a, const Mean<n>& b)
{
  const Vec3 d = a.point - b.point;
  const double length = norm(d);
  if constexpr(with_gradient)
    return {length, ((a.weight - b.weight) / length) * d};
  else
    return {length, {}};
}

// Height of the apex over the mean plane of the base.
inline Length pyramid_height(const Element_points& p, int v)
{
  const Vec3 a = p[2] - p[0], b = p[3] - p[1], n = cross(a, b);
  const double area = norm(n);
  if(!(area > 0))
    return {0, {}};
  const Vec3 unit = (1 / area) * n, w = p[4] - 0.25 * (p[0] + p[1] + p[2] + p[3]);
  const double height = dot(unit, w);
  if(v == 4)
    return {height, unit};
  const Vec3 tilt = (1 / area) * (w - height * unit);
  const Vec3 turn = v % 2 == 0 ? cross(b, tilt) : cross(tilt, a);
  return {height, (v >= 2 ? 1. : -1.) * turn - 0.25 * unit};
}

// Height of c over ab.
inline Length triangle_height(const Mean<2>& a, const Mean<2>& b, const Mean<2>& c)
{
  const Vec3 u = b.point - a.point, w = c.point - a.point, n = cross(u, w);
  const double width = norm(u), area = norm(n);
  if(!(width > 0 && area > 0))
    return {0, {}};
  const Vec3 unit = (1 / area) * n;
  const double wu = b.weight - a.weight, ww = c.weight - a.weight;
  const Vec3 area_gradient = wu * cross(w, unit) + ww * cross(unit, u);
  return {area / width, (1 / width) * area_gradient - (wu * area / (width * width * width)) * u};
}

/// The two lengths whose ratio is the ARC of a pyramid, prism or hexahedron, with their gradients by the
/// position of vertex `v` if wanted.
template <bool with_gradient>
Extreme_lengths extreme_lengths(Element_kind kind, const Element_points& p, int v)
{
  Extreme_lengths e{{0, {}}, {std::numeric_limits<double>::infinity(), {}}};
  const auto add_segment = [&](Extreme_lengths& extremes, const auto& a, const auto& b) {
    extremes.template add<with_gradient>(segment<with_gradient>(Mean(p, a, v), Mean(p, b, v)));
  };
  switch(kind) {
  case HEXAHEDRON: {
    const auto& faces = reference_elements[kind].faces; // opposite faces are side by side
    for(int i = 0; i < 6; i += 2)
      add_segment(e, faces[i + 1].vertices, faces[i].vertices);
    break;
  }
  case PYRAMID: {
    constexpr int edges[4][2] = {{2, 3}, {0, 1}, {1, 2}, {3, 0}};
    for(int i = 0; i < 4; i += 2)
      add_segment(e, edges[i], edges[i + 1]);
    e.template add<with_gradient>(pyramid_height(p, v));
    break;
  }
  case PRISM: {
    const Extreme_lengths none = e;
    double worst = 0;
    for(int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const int at_i[2] = {i, i + 3}, at_j[2] = {j, j + 3}, at_k[2] = {k, k + 3};
      const int bottom[2] = {i, j}, top[2] = {i + 3, j + 3};
      Extreme_lengths face = none;
      add_segment(face, at_j, at_i);
      add_segment(face, top, bottom);
      face.template add<with_gradient>(triangle_height(Mean(p, at_i, v), Mean(p, at_j, v), Mean(p, at_k, v)));
      if(face.ratio() > worst) {
        worst = face.ratio();
        e = face;
      }
    }
    break;
  }
  case TETRAHEDRON: CGAL_error_msg("the ARC of a tetrahedron is no ratio of lengths");
  }
  return e;
}

/// The paper's aspect-ratio coefficient (ARC): infinity where a length is 0, and for an inverted tetrahedron
/// or pyramid; lengths in prisms and hexahedra have no sign.
inline double aspect_ratio_coefficient(Element_kind kind, const Element_points& p)
{
  return kind == TETRAHEDRON ? std::sqrt(squared_tetrahedron_arc(p[0], p[1], p[2], p[3]))
                             : extreme_lengths<false>(kind, p, -1).ratio();
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_ASPECT_RATIO_H
