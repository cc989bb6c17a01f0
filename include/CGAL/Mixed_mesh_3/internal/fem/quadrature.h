// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Quadrature of the four kinds of elements, and the strain at its points. In the terms of finite elements a
// vertex is a node.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FEM_QUADRATURE_H
#define CGAL_MIXED_MESH_3_INTERNAL_FEM_QUADRATURE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Mixed_element_traits_3.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <type_traits>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The quadrature points of a stiffness: weights, and the shape functions and their gradients.
struct Quadrature_rule
{
  int number_of_points = 0;
  std::array<double, 8> weights{};
  std::array<std::array<double, 8>, 8> values{};  // shape functions, by point and by node
  std::array<std::array<Vec3, 8>, 8> gradients{}; // in reference coordinates, by point and by node
};

/// \tparam ElementTraits a model of `MixedElementTraits_3`
template <class ElementTraits>
Quadrature_rule make_quadrature_rule()
{
  constexpr Element_kind kind = ElementTraits::kind;
  Quadrature_rule rule;
  const auto add = [&rule](double r, double s, double t, double weight) {
    const auto gradients = ElementTraits::shape_gradients(r, s, t);
    const std::size_t q = std::size_t(rule.number_of_points++);
    rule.weights[q] = weight;
    std::copy(gradients.begin(), gradients.end(), rule.gradients[q].begin());
    const auto values = ElementTraits::shape_functions(r, s, t);
    std::copy(values.begin(), values.end(), rule.values[q].begin());
  };
  const double gauss = 1 / std::sqrt(3.); // two points on [-1,1], of weight 1
  if constexpr(kind == TETRAHEDRON) {
    add(0.25, 0.25, 0.25, 1. / 6); // gradients are constant
  } else if constexpr(kind == PYRAMID) {
    // Conical product: (r, s) shrink toward the apex, and heights are Gauss-Jacobi points for the weight (1 -
    // t)^2 on [0,1].
    const double offset = std::sqrt(10.) / 15, weight_offset = std::sqrt(10.) / 48;
    for(int k : {-1, 1}) {
      const double t = 1. / 3 + k * offset, weight = 1. / 6 - k * weight_offset;
      for(int i : {-1, 1})
        for(int j : {-1, 1})
          add(i * gauss * (1 - t), j * gauss * (1 - t), t, weight);
    }
  } else if constexpr(kind == PRISM) {
    for(int k : {-1, 1})
      for(int i = 0; i < 3; ++i)
        add(i == 1 ? 2. / 3 : 1. / 6, i == 2 ? 2. / 3 : 1. / 6, k * gauss, 1. / 6);
  } else {
    static_assert(kind == HEXAHEDRON, "a quadrature rule for each kind of element");
    for(int i : {-1, 1})
      for(int j : {-1, 1})
        for(int k : {-1, 1})
          add(i * gauss, j * gauss, k * gauss, 1);
  }
  return rule;
}

inline const Quadrature_rule& quadrature_rule(Element_kind kind)
{
  static const std::array rules{make_quadrature_rule<Mixed_element_traits_3<TETRAHEDRON>>(),
                                make_quadrature_rule<Mixed_element_traits_3<PYRAMID>>(),
                                make_quadrature_rule<Mixed_element_traits_3<PRISM>>(),
                                make_quadrature_rule<Mixed_element_traits_3<HEXAHEDRON>>()};
  static_assert(std::tuple_size_v<std::remove_const_t<decltype(rules)>> == number_of_element_kinds,
                "a quadrature rule for each kind of element");
  return rules[kind];
}

/*!
The strain operator at a point of an element. The B-matrix of node `a` consists of the components of
`gradients[a]`: with the displacements \f$ u_a \f$, the gradient of displacement is
\f$ \sum_a u_a \otimes gradients[a] \f$, and the strain its symmetric part.
*/
struct Strain_operator
{
  std::array<Vec3, 8> gradients; // gradients of the shape functions, in space
  double volume;                 // volume that the point stands for
};

/// \param points positions of the nodes, possibly relative to one of them
/// \param q point of the quadrature rule. \pre the Jacobian is not zero at the point
inline Strain_operator strain_operator(Element_kind kind, const std::array<Vec3, 8>& points, int q)
{
  const Quadrature_rule& rule = quadrature_rule(kind);
  const int n = reference_elements[kind].number_of_vertices;
  const std::array<Vec3, 8>& reference = rule.gradients[std::size_t(q)];
  Vec3 dr{}, ds{}, dt{}; // columns of the Jacobian matrix
  for(int a = 0; a < n; ++a) {
    dr = dr + reference[a][0] * points[a];
    ds = ds + reference[a][1] * points[a];
    dt = dt + reference[a][2] * points[a];
  }
  const Vec3 st = cross(ds, dt), tr = cross(dt, dr), rs = cross(dr, ds);
  const double jacobian = dot(dr, st);
  Strain_operator b;
  for(int a = 0; a < n; ++a)
    b.gradients[a] = (1 / jacobian) * (reference[a][0] * st + (reference[a][1] * tr + reference[a][2] * rs));
  b.volume = rule.weights[std::size_t(q)] * jacobian;
  return b;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FEM_QUADRATURE_H
