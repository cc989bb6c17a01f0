// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The proof that the aspect-ratio coefficient of an element is within a bound. The squares of both sides are
// rational functions of the coordinates: interval arithmetic comes first, exact rationals follow if it is
// undecided.

#ifndef CGAL_MIXED_MESH_3_QUALITY_BOUND_H
#define CGAL_MIXED_MESH_3_QUALITY_BOUND_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/Mixed_element_traits_3.h>
#include <CGAL/Mixed_mesh_3/certificate.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/aspect_ratio.h>

#include <CGAL/Exact_rational.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/Uncertain.h>
#include <CGAL/assertions.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/*!
Whether the aspect-ratio coefficient (ARC) of an element is at most `bound`: the formulas of `aspect_ratio.h`,
squared, as products instead of roots and, for sums of vertices, without the division by their number.

\tparam NT `Exact_rational`, which decides, or intervals, which may be undecided
*/
template <class NT>
class Aspect_ratio_test
{
  using Vector_ = Vector<NT>;

  std::array<Vector_, 8> m_points; // relative to the first point
  NT m_squared_bound;

  const Vector_& at(int i) const { return m_points[std::size_t(i)]; }

  Vector_ sum(std::initializer_list<int> vertices) const
  {
    Vector_ s{NT(0), NT(0), NT(0)};
    for(int v : vertices)
      for(std::size_t k = 0; k < 3; ++k)
        s[k] += at(v)[k];
    return s;
  }

  static NT squared(const Vector_& v) { return scalar_product(v, v); }

  // Whether the longest and the shortest of three lengths, whose squares are given, have a ratio of at most
  // the bound, and no length is 0.
  Uncertain<bool> are_alike(const NT& a, const NT& b, const NT& c) const
  {
    Uncertain<bool> result(true);
    const NT* const squares[3] = {&a, &b, &c};
    for(const NT* shortest : squares) {
      result = result & Uncertain<bool>(*shortest > 0);
      for(const NT* longest : squares)
        if(longest != shortest)
          result = result & Uncertain<bool>(*longest <= m_squared_bound * *shortest);
    }
    return result;
  }

  // Tests (s / 6)^(3/2) <= bound f d / 6, with the sum s of squared edges, the factor f and six volumes d.
  Uncertain<bool> tetrahedron() const
  {
    NT s(0);
    for(int i = 0; i < 4; ++i)
      for(int j = i + 1; j < 4; ++j)
        s += squared(difference(at(i), at(j)));
    const NT d = scalar_product(cross_product(at(1), at(2)), at(3));
    const NT factor = NT(847867) / NT(100000);
    return Uncertain<bool>(d > 0)
           & Uncertain<bool>(s * s * s <= 6 * factor * factor * m_squared_bound * d * d);
  }

  // Tests twice the segments between midpoints of opposite edges, and the height over the mean plane.
  Uncertain<bool> pyramid() const
  {
    const Vector_ normal = cross_product(difference(at(2), at(0)), difference(at(3), at(1)));
    const Vector_ base = sum({0, 1, 2, 3}), apex = sum({4, 4, 4, 4});
    const NT area = squared(normal), height = scalar_product(normal, difference(apex, base)); // times 4
    const Uncertain<bool> is_upright = Uncertain<bool>(area > 0) & Uncertain<bool>(height > 0);
    if(!certainly(is_upright))
      return is_upright;
    return are_alike(squared(difference(sum({2, 3}), sum({0, 1}))),
                     squared(difference(sum({1, 2}), sum({3, 0}))), height * height / (4 * area));
  }

  // Tests twice the midpoint segments of each quadrilateral, and the height of the mean triangle over it.
  Uncertain<bool> prism() const
  {
    Uncertain<bool> result(true);
    for(int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const Vector_ a = sum({i, i + 3}), u = difference(sum({j, j + 3}), a),
                    w = difference(sum({k, k + 3}), a);
      const NT width = squared(u), rise = squared(difference(sum({i + 3, j + 3}), sum({i, j})));
      const Uncertain<bool> is_wide(width > 0);
      if(!certainly(is_wide))
        return is_wide;
      result = result & are_alike(width, rise, squared(cross_product(u, w)) / width);
    }
    return result;
  }

  // Tests four times the segments between centers of opposite faces.
  Uncertain<bool> hexahedron() const
  {
    return are_alike(squared(difference(sum({0, 3, 4, 7}), sum({1, 2, 5, 6}))),
                     squared(difference(sum({0, 1, 4, 5}), sum({2, 3, 6, 7}))),
                     squared(difference(sum({0, 1, 2, 3}), sum({4, 5, 6, 7}))));
  }

public:
  Aspect_ratio_test(Element_kind kind, const std::array<std::array<double, 3>, 8>& points, double bound)
    : m_squared_bound(NT(bound) * NT(bound))
  {
    for(std::size_t i = 0; i < std::size_t(reference_elements[kind].number_of_vertices); ++i)
      for(std::size_t k = 0; k < 3; ++k)
        m_points[i][k] = NT(points[i][k]) - NT(points[0][k]);
  }

  Uncertain<bool> operator()(Element_kind kind) const
  {
    switch(kind) {
    case TETRAHEDRON: return tetrahedron();
    case PYRAMID: return pyramid();
    case PRISM: return prism();
    case HEXAHEDRON: return hexahedron();
    }
    return false;
  }
};

} // namespace internal

/*!
\ingroup PkgMixedMesh3Validity

Whether the aspect-ratio coefficient (ARC) of an element is at most a bound: proved, exact on the coordinates
and on the bound as doubles. The number 8.47867 in the ARC of a tetrahedron is the exact decimal number.

Like `aspect_ratio_coefficient`, this function says nothing of the Jacobian of a prism or a hexahedron, as
`jacobian_sign()` does.

\param kind the kind
\param points positions of the vertices; the first ones are used. \pre finite
\param bound largest ARC. \pre finite, at least 1
\par Complexity
Constant: a few products of intervals; rationals where the ARC is within some 1e-13 of the bound
*/
inline bool is_aspect_ratio_at_most(Element_kind kind, const std::array<std::array<double, 3>, 8>& points,
                                    double bound)
{
  CGAL_precondition(bound >= 1);
  {
    const CGAL::Protect_FPU_rounding<true> protection;
    const CGAL::Uncertain<bool> answer = internal::Aspect_ratio_test<CGAL::Interval_nt<false>>(kind, points,
                                                                                               bound)(kind);
    if(answer.is_certain())
      return answer.make_certain();
  }
  return internal::Aspect_ratio_test<CGAL::Exact_rational>(kind, points, bound)(kind).make_certain();
}

/// \ingroup PkgMixedMesh3Validity
/// Whether the aspect-ratio coefficient (ARC) of element `e` is at most `bound`.
template <class Mesh>
bool is_aspect_ratio_at_most(const Mesh& mesh, Element_index e, double bound)
{
  const Element_view element = mesh.element(e);
  std::array<std::array<double, 3>, 8> points{};
  for(int i = 0; i < element.size(); ++i)
    points[std::size_t(i)] = to_vec3(mesh.point(element[i]));
  return is_aspect_ratio_at_most(element.kind(), points, bound);
}

/// \ingroup PkgMixedMesh3Validity
/// The number of elements with an aspect-ratio coefficient (ARC) above `bound`: proved for these elements,
/// and the opposite is proved for the others.
/// \par Complexity
/// Linear in the number of elements
template <class Mesh>
std::size_t number_of_elements_above(const Mesh& mesh, double bound)
{
  std::size_t count = 0;
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
    count += !is_aspect_ratio_at_most(mesh, Element_index(e), bound);
  return count;
}

/*!
\ingroup PkgMixedMesh3Validity

The bounds, in degrees, of all dihedral angles of a tetrahedron whose aspect-ratio coefficient (ARC) is at
most a bound. Both bounds are attained; the manual has the proof.

\param bound largest ARC. \pre at least 1
\return the smallest and the largest angle: 12.94 and 154.44 for 3.2
*/
inline std::array<double, 2> dihedral_angle_bounds(double bound)
{
  CGAL_precondition(bound >= 1);
  // The inequality ARC >= 3 (3 - cos x) / (f sin x) for the angle x gives f ARC sin x + 3 cos x >= 9.
  const double sine = internal::tetrahedron_arc_factor * bound, cosine = 3;
  const double from = std::asin((std::min)(9 / std::hypot(sine, cosine), 1.)),
               shift = std::atan2(cosine, sine);
  return {180 / CGAL_PI * (from - shift), 180 / CGAL_PI * (CGAL_PI - from - shift)};
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_QUALITY_BOUND_H
