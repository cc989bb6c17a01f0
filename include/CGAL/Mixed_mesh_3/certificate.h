// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The proof that an element is not inverted anywhere: its Jacobian is positive on the whole element, not at
// corners only. Bernstein coefficients bound a polynomial; where their signs do not decide, the domain is
// subdivided. Interval arithmetic comes first, exact rationals follow if it is undecided.

#ifndef CGAL_MIXED_MESH_3_CERTIFICATE_H
#define CGAL_MIXED_MESH_3_CERTIFICATE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/Mixed_element_traits_3.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <CGAL/Exact_rational.h>
#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace CGAL {
namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMesh3Validity
/// The result of a test of the sign of the Jacobian of an element.
enum class Jacobian_sign : std::uint8_t {
  POSITIVE,     ///< proved positive on the whole element
  NOT_POSITIVE, ///< zero or negative somewhere, proved
  UNDECIDED     ///< the minimum is so near to zero that subdivision did not decide
};

namespace internal {

/*!
A polynomial on the unit cube by its Bernstein coefficients: of degree 2 in each direction that the polynomial
depends on, of degree 0 in the others.
*/
template <class NT>
class Bernstein_polynomial
{
  std::array<NT, 27> m_coefficients; // index 0 in directions of degree 0
  std::array<int, 3> m_degrees;

  static constexpr int index(int i, int j, int k) { return i + 3 * j + 9 * k; }

public:
  explicit Bernstein_polynomial(const std::array<int, 3>& degrees) : m_degrees(degrees)
  {
    for(int i = 0; i <= degrees[0]; ++i) // other coefficients are never read
      for(int j = 0; j <= degrees[1]; ++j)
        for(int k = 0; k <= degrees[2]; ++k)
          (*this)(i, j, k) = NT(0);
  }

  NT& operator()(int i, int j, int k) { return m_coefficients[index(i, j, k)]; }
  const NT& operator()(int i, int j, int k) const { return m_coefficients[index(i, j, k)]; }

  /// The sign on the closed cube. The polynomial lies between its coefficients; coefficients at the corners
  /// are values.
  Jacobian_sign sign(int subdivisions) const
  {
    bool all_positive = true;
    for(int i = 0; i <= m_degrees[0]; ++i)
      for(int j = 0; j <= m_degrees[1]; ++j)
        for(int k = 0; k <= m_degrees[2]; ++k) {
          const NT& c = (*this)(i, j, k);
          if(CGAL::certainly(c > 0))
            continue;
          all_positive = false;
          if(i % 2 + j % 2 + k % 2 == 0 && CGAL::certainly(c <= 0))
            return Jacobian_sign::NOT_POSITIVE;
        }
    if(all_positive)
      return Jacobian_sign::POSITIVE;
    const bool is_constant = m_degrees == std::array<int, 3>{};
    if(subdivisions == 0 || is_constant)
      return Jacobian_sign::UNDECIDED;
    int axis = subdivisions % 3; // the directions in turn
    while(m_degrees[std::size_t(axis)] == 0)
      axis = (axis + 1) % 3;
    Bernstein_polynomial lower = *this, upper = *this;
    halve(axis, lower, upper);
    const Jacobian_sign first = lower.sign(subdivisions - 1);
    if(first == Jacobian_sign::NOT_POSITIVE)
      return first;
    const Jacobian_sign second = upper.sign(subdivisions - 1);
    return second == Jacobian_sign::POSITIVE ? first : second;
  }

  /// A lower bound of the polynomial. \pre all coefficients of the degrees are given
  NT smallest_coefficient() const
  {
    NT smallest = m_coefficients[0];
    for(int i = 0; i <= m_degrees[0]; ++i)
      for(int j = 0; j <= m_degrees[1]; ++j)
        for(int k = 0; k <= m_degrees[2]; ++k)
          smallest = (std::min)(smallest, (*this)(i, j, k));
    return smallest;
  }

private:
  // De Casteljau's algorithm at 1/2.
  void halve(int axis, Bernstein_polynomial& lower, Bernstein_polynomial& upper) const
  {
    static constexpr int steps[3] = {1, 3, 9};
    const int step = steps[axis], b = (axis + 1) % 3, c = (axis + 2) % 3;
    for(int i = 0; i <= m_degrees[b]; ++i)
      for(int j = 0; j <= m_degrees[c]; ++j) {
        const int at = i * steps[b] + j * steps[c];
        const NT &c0 = m_coefficients[at], &c1 = m_coefficients[at + step],
                 &c2 = m_coefficients[at + 2 * step];
        const NT c01 = (c0 + c1) / 2, c12 = (c1 + c2) / 2, middle = (c01 + c12) / 2;
        lower.m_coefficients[at + step] = c01;
        lower.m_coefficients[at + 2 * step] = middle;
        upper.m_coefficients[at] = middle;
        upper.m_coefficients[at + step] = c12;
      }
  }
};

template <class NT>
using Vector = std::array<NT, 3>;

template <class NT>
Vector<NT> difference(const Vector<NT>& a, const Vector<NT>& b)
{
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

template <class NT>
Vector<NT> cross_product(const Vector<NT>& a, const Vector<NT>& b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <class NT>
NT scalar_product(const Vector<NT>& a, const Vector<NT>& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// The weight by which the product of two linear Bernstein polynomials i and j is the quadratic one i + j.
inline double product_weight(int i_plus_j) { return i_plus_j == 1 ? 0.5 : 1; }

template <class NT>
Bernstein_polynomial<NT> jacobian_of_hexahedron(const std::array<Vector<NT>, 8>& p)
{
  static constexpr int corner[2][2][2] = {{{0, 4}, {3, 7}}, {{1, 5}, {2, 6}}}; // by r, s, t
  Vector<NT> dr[2][2], ds[2][2], dt[2][2];
  for(int i = 0; i < 2; ++i)
    for(int j = 0; j < 2; ++j) {
      dr[i][j] = difference(p[corner[1][i][j]], p[corner[0][i][j]]);
      ds[i][j] = difference(p[corner[i][1][j]], p[corner[i][0][j]]);
      dt[i][j] = difference(p[corner[i][j][1]], p[corner[i][j][0]]);
    }
  Bernstein_polynomial<NT> jacobian({2, 2, 2});
  for(int s1 = 0; s1 < 2; ++s1)
    for(int t1 = 0; t1 < 2; ++t1)
      for(int r2 = 0; r2 < 2; ++r2)
        for(int t2 = 0; t2 < 2; ++t2) {
          const Vector<NT> normal = cross_product(dr[s1][t1], ds[r2][t2]);
          for(int r3 = 0; r3 < 2; ++r3)
            for(int s3 = 0; s3 < 2; ++s3) {
              const int i = r2 + r3, j = s1 + s3, k = t1 + t2;
              jacobian(i, j, k) += scalar_product(normal, dt[r3][s3])
                                   * NT(product_weight(i) * product_weight(j) * product_weight(k));
            }
        }
  return jacobian;
}

template <class NT, class F>
void for_each_jacobian_of_prism(const std::array<Vector<NT>, 8>& p, const F& f)
{
  Vector<NT> dr[2], ds[2];
  for(int t = 0; t < 2; ++t) {
    dr[t] = difference(p[3 * t + 1], p[3 * t]);
    ds[t] = difference(p[3 * t + 2], p[3 * t]);
  }
  for(int edge = 0; edge < 3; ++edge) {
    const Vector<NT> dt = difference(p[edge + 3], p[edge]);
    Bernstein_polynomial<NT> jacobian({2, 0, 0});
    for(int t1 = 0; t1 < 2; ++t1)
      for(int t2 = 0; t2 < 2; ++t2)
        jacobian(t1 + t2, 0, 0) += scalar_product(cross_product(dr[t1], ds[t2]), dt)
                                   * NT(product_weight(t1 + t2));
    f(jacobian);
  }
}

template <class NT>
Bernstein_polynomial<NT> jacobian_of_pyramid(const std::array<Vector<NT>, 8>& p)
{
  static constexpr int corner[2][2] = {{0, 3}, {1, 2}}; // by u, v
  Bernstein_polynomial<NT> jacobian({2, 2, 0});
  for(int v1 = 0; v1 < 2; ++v1)
    for(int u2 = 0; u2 < 2; ++u2) {
      const Vector<NT> normal = cross_product(difference(p[corner[1][v1]], p[corner[0][v1]]),
                                              difference(p[corner[u2][1]], p[corner[u2][0]]));
      for(int u3 = 0; u3 < 2; ++u3)
        for(int v3 = 0; v3 < 2; ++v3) {
          const int i = u2 + u3, j = v1 + v3;
          jacobian(i, j, 0) += scalar_product(normal, difference(p[4], p[corner[u3][v3]]))
                               * NT(product_weight(i) * product_weight(j));
        }
    }
  return jacobian;
}

template <class NT>
Bernstein_polynomial<NT> jacobian_of_tetrahedron(const std::array<Vector<NT>, 8>& p)
{
  Bernstein_polynomial<NT> jacobian({0, 0, 0});
  jacobian(0, 0, 0) = scalar_product(cross_product(difference(p[1], p[0]), difference(p[2], p[0])),
                                     difference(p[3], p[0]));
  return jacobian;
}

/*!
Calls `f(polynomial)` for polynomials on the unit cube that are positive iff the Jacobian of the element is.

- hexahedron: the Jacobian itself, of degree (2, 2, 2);
- prism: the Jacobian is linear in the triangle's coordinates, hence positive iff it is positive along the
three edges between the triangles, where it is quadratic;
- pyramid: with the base \f$ B(u, v) \f$ and the apex \f$ a \f$, the Jacobian of the rational shape functions
  on the line from \f$ B(u, v) \f$ to the apex is \f$ det(B_u, B_v, a - B) \f$, of degree (2, 2).
*/
template <class NT, class F>
void for_each_jacobian_polynomial(Element_kind kind, const std::array<Vector<NT>, 8>& p, const F& f)
{
  switch(kind) {
  case HEXAHEDRON: return f(jacobian_of_hexahedron(p));
  case PRISM: return for_each_jacobian_of_prism(p, f);
  case PYRAMID: return f(jacobian_of_pyramid(p));
  case TETRAHEDRON: return f(jacobian_of_tetrahedron(p));
  }
}

template <class NT>
Jacobian_sign jacobian_sign_with(Element_kind kind, const std::array<std::array<double, 3>, 8>& points,
                                 int subdivisions)
{
  std::array<Vector<NT>, 8> p;
  for(int i = 0; i < reference_elements[kind].number_of_vertices; ++i)
    for(int k = 0; k < 3; ++k)
      p[i][k] = NT(points[i][k]);
  Jacobian_sign sign = Jacobian_sign::POSITIVE;
  for_each_jacobian_polynomial<NT>(kind, p, [&](const Bernstein_polynomial<NT>& jacobian) {
    if(sign != Jacobian_sign::NOT_POSITIVE) {
      const Jacobian_sign s = jacobian.sign(subdivisions);
      sign = s == Jacobian_sign::POSITIVE ? sign : s;
    }
  });
  return sign;
}

// Whether doubles with a bound on their error prove the sign, as for all but the worst elements. A
// coefficient is a mean of determinants of differences of coordinates, each at most `largest`: it is a sum of
// 6 products, with an error of less than 16 roundings each.
inline bool is_clearly_positive(Element_kind kind, const std::array<std::array<double, 3>, 8>& points)
{
  double largest = 0;
  for(int i = 1; i < reference_elements[kind].number_of_vertices; ++i)
    for(int k = 0; k < 3; ++k)
      largest = (std::max)(largest, std::abs(points[i][k] - points[0][k]));
  largest *= 2; // difference of any two
  const double bound = largest * largest * largest * std::ldexp(96., -53);
  bool is_positive = bound > std::numeric_limits<double>::min() && std::isfinite(bound);
  for_each_jacobian_polynomial<double>(kind, points, [&](const Bernstein_polynomial<double>& jacobian) {
    is_positive = is_positive && jacobian.smallest_coefficient() > bound;
  });
  return is_positive;
}

} // namespace internal

/*!
\ingroup PkgMixedMesh3Validity

The sign of the Jacobian on the whole element, exact on the coordinates as doubles.

\param kind the kind
\param points positions of the vertices; the first ones are used. \pre finite
\par Complexity
Constant: 64 determinants for a hexahedron; intervals and then rationals where doubles are not enough
*/
inline Jacobian_sign jacobian_sign(Element_kind kind, const std::array<std::array<double, 3>, 8>& points)
{
  constexpr int interval_subdivisions = 12, exact_subdivisions = 18;
  if(internal::is_clearly_positive(kind, points))
    return Jacobian_sign::POSITIVE;
  {
    const CGAL::Protect_FPU_rounding<true> protection;
    const Jacobian_sign sign = internal::jacobian_sign_with<CGAL::Interval_nt<false>>(kind, points,
                                                                                      interval_subdivisions);
    if(sign != Jacobian_sign::UNDECIDED)
      return sign;
  }
  return internal::jacobian_sign_with<CGAL::Exact_rational>(kind, points, exact_subdivisions);
}

/// \ingroup PkgMixedMesh3Validity
/// The sign of the Jacobian of an element.
/// \param element kind and vertices of the element
/// \param position `std::array<double, 3>(Vertex_index)`: position of a vertex
template <class Position>
Jacobian_sign jacobian_sign(const Element_view& element, const Position& position)
{
  std::array<std::array<double, 3>, 8> points{};
  for(int i = 0; i < element.size(); ++i)
    points[std::size_t(i)] = position(element[i]);
  return jacobian_sign(element.kind(), points);
}

/// \ingroup PkgMixedMesh3Validity
/// The sign of the Jacobian of element `e`.
template <class Mesh>
Jacobian_sign jacobian_sign(const Mesh& mesh, Element_index e)
{
  return jacobian_sign(mesh.element(e), [&](Vertex_index v) { return to_vec3(mesh.point(v)); });
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_CERTIFICATE_H
