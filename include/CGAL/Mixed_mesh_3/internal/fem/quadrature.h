// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Quadrature of the four kinds of elements, of order 1 and 2, and the strain at its points. In the terms of
// finite elements a vertex is a node, and so is an edge of an element of order 2.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FEM_QUADRATURE_H
#define CGAL_MIXED_MESH_3_INTERNAL_FEM_QUADRATURE_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Mixed_element_traits_3.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/edge_functions.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The largest number of shape functions: of the 8 vertices and 12 edges of a hexahedron; of points: of a
/// pyramid of order 2.
inline constexpr int largest_number_of_functions = 20;
inline constexpr int largest_number_of_points = 16;

/// The quadrature points of a stiffness: weights, and the shape functions and their gradients. The functions
/// are those of the vertices; with order 2, those of the edges follow.
struct Quadrature_rule
{
  int number_of_points = 0;
  int number_of_vertices = 0;
  int number_of_functions = 0;
  std::array<double, largest_number_of_points> weights{};
  // Shape functions, and their gradients in reference coordinates, by point and by function.
  std::array<std::array<double, largest_number_of_functions>, largest_number_of_points> values{};
  std::array<std::array<Vec3, largest_number_of_functions>, largest_number_of_points> gradients{};
};

/*!
Calls `add(r, s, t, weight)` for the points of a rule.

With order 2, the rule is exact, on an element with an affine map, for the product of the strain of a
quadratic displacement with that of any shape function: so that quadratic displacements are found exactly. For
a tetrahedron, the rule is exact for the stiffness, too. Further points would only make elements stiffer; with
fewer, a single element would have more than the six rigid motions without energy.

    points         tetrahedron    pyramid    prism    hexahedron
    order 1             1            8         6           8
    order 2             4           16        12          14
*/
template <Element_kind Kind, class Add>
void for_each_quadrature_point(int order, const Add& add)
{
  const double gauss = 1 / std::sqrt(3.); // two points on [-1,1], of weight 1
  if constexpr(Kind == TETRAHEDRON) {
    if(order == 1) {
      add(0.25, 0.25, 0.25, 1. / 6); // gradients are constant
    } else {
      const double far = (5 - std::sqrt(5.)) / 20, near = 1 - 3 * far; // exact for degree 2
      for(int i = 0; i < 4; ++i)
        add(i == 1 ? near : far, i == 2 ? near : far, i == 3 ? near : far, 1. / 24);
    }
  } else if constexpr(Kind == PYRAMID) {
    // Conical product: (r, s) shrink toward the apex, and heights are Gauss-Jacobi points for the weight (1 -
    // t)^2 on [0,1].
    const double offset = std::sqrt(10.) / 15, weight_offset = std::sqrt(10.) / 48;
    for(int k : {-1, 1}) {
      const double t = 1. / 3 + k * offset, weight = 1. / 6 - k * weight_offset;
      if(order == 1) {
        for(int i : {-1, 1})
          for(int j : {-1, 1})
            add(i * gauss * (1 - t), j * gauss * (1 - t), t, weight);
      } else {
        // On the square exact for degree 5: W. Burnside, "An approximate quadrature formula", Messenger of
        // Math. 37, 1908.
        const double a = std::sqrt(7. / 15) * (1 - t), b = std::sqrt(7. / 9) * (1 - t);
        for(int i : {-1, 1}) {
          add(i * a, 0, t, 40. / 49 * weight);
          add(0, i * a, t, 40. / 49 * weight);
          for(int j : {-1, 1})
            add(i * b, j * b, t, 9. / 49 * weight);
        }
      }
    }
  } else if constexpr(Kind == PRISM) {
    if(order == 1) {
      for(int k : {-1, 1})
        for(int i = 0; i < 3; ++i)
          add(i == 1 ? 2. / 3 : 1. / 6, i == 2 ? 2. / 3 : 1. / 6, k * gauss, 1. / 6);
    } else {
      // In the triangle exact for degree 4: D. A. Dunavant, "High degree efficient symmetrical Gaussian
      // quadrature rules for the triangle", Int. J. Numer. Meth. Engng 21, 1985.
      const double root = std::sqrt(10.), inner = std::sqrt(38 - 44 * std::sqrt(0.4)),
                   other = std::sqrt(213125 - 53320 * root);
      for(int sign : {1, -1}) {
        const double a = (8 - root + sign * inner) / 18, b = 1 - 2 * a, weight = (620 + sign * other) / 7440;
        for(int k : {-1, 1})
          for(int i = 0; i < 3; ++i)
            add(i == 1 ? b : a, i == 2 ? b : a, k * gauss, weight);
      }
    }
  } else {
    static_assert(Kind == HEXAHEDRON, "a quadrature rule for each kind of element");
    if(order == 1) {
      for(int i : {-1, 1})
        for(int j : {-1, 1})
          for(int k : {-1, 1})
            add(i * gauss, j * gauss, k * gauss, 1);
    } else {
      // Exact for degree 5: B. M. Irons, "Quadrature rules for brick based finite elements", Int. J. Numer.
      // Meth. Engng 3, 1971.
      const double a = std::sqrt(19. / 30), b = std::sqrt(19. / 33);
      for(int i : {-1, 1}) {
        add(i * a, 0, 0, 320. / 361);
        add(0, i * a, 0, 320. / 361);
        add(0, 0, i * a, 320. / 361);
        for(int j : {-1, 1})
          for(int k : {-1, 1})
            add(i * b, j * b, k * b, 121. / 361);
      }
    }
  }
}

/// \tparam ElementTraits a model of `MixedElementTraits_3`
template <class ElementTraits>
Quadrature_rule make_quadrature_rule(int order)
{
  constexpr Element_kind kind = ElementTraits::kind;
  Quadrature_rule rule;
  rule.number_of_vertices = ElementTraits::number_of_vertices;
  rule.number_of_functions = rule.number_of_vertices
                             + (order == 2 ? ElementTraits::reference.number_of_edges : 0);
  for_each_quadrature_point<kind>(order, [&](double r, double s, double t, double weight) {
    const auto gradients = ElementTraits::shape_gradients(r, s, t);
    const std::size_t q = std::size_t(rule.number_of_points++);
    rule.weights[q] = weight;
    std::copy(gradients.begin(), gradients.end(), rule.gradients[q].begin());
    const auto values = ElementTraits::shape_functions(r, s, t);
    std::copy(values.begin(), values.end(), rule.values[q].begin());
    const auto edges = edge_functions<kind>({r, s, t});
    for(int a = rule.number_of_vertices; a < rule.number_of_functions; ++a) {
      rule.values[q][std::size_t(a)] = edges[std::size_t(a - rule.number_of_vertices)].value;
      rule.gradients[q][std::size_t(a)] = edges[std::size_t(a - rule.number_of_vertices)].gradient;
    }
  });
  return rule;
}

/// \pre the order is 1 or 2
inline const Quadrature_rule& quadrature_rule(Element_kind kind, int order = 1)
{
  const auto make = [](int of_order) {
    return std::array{make_quadrature_rule<Mixed_element_traits_3<TETRAHEDRON>>(of_order),
                      make_quadrature_rule<Mixed_element_traits_3<PYRAMID>>(of_order),
                      make_quadrature_rule<Mixed_element_traits_3<PRISM>>(of_order),
                      make_quadrature_rule<Mixed_element_traits_3<HEXAHEDRON>>(of_order)};
  };
  static const std::array rules{make(1), make(2)};
  static_assert(std::tuple_size_v<decltype(make(1))> == number_of_element_kinds,
                "a quadrature rule for each kind of element");
  CGAL_precondition(order == 1 || order == 2);
  return rules[std::size_t(order - 1)][kind];
}

/*!
The strain operator at a point of an element. The B-matrix of node `a` consists of the components of
`gradients[a]`: with the displacements \f$ u_a \f$, the gradient of displacement is
\f$ \sum_a u_a \otimes gradients[a] \f$, and the strain its symmetric part.
*/
struct Strain_operator
{
  std::array<Vec3, largest_number_of_functions> gradients; // gradients of the shape functions, in space
  double volume;                                           // volume that the point stands for
};

/// \param points positions of the vertices, possibly relative to one of them
/// \param q point of the quadrature rule. \pre the Jacobian is not zero at the point
inline Strain_operator strain_operator(const Quadrature_rule& rule, const std::array<Vec3, 8>& points, int q)
{
  const auto& reference = rule.gradients[std::size_t(q)];
  Vec3 dr{}, ds{}, dt{}; // columns of the Jacobian matrix
  for(int a = 0; a < rule.number_of_vertices; ++a) {
    dr = dr + reference[a][0] * points[a];
    ds = ds + reference[a][1] * points[a];
    dt = dt + reference[a][2] * points[a];
  }
  const Vec3 st = cross(ds, dt), tr = cross(dt, dr), rs = cross(dr, ds);
  const double jacobian = dot(dr, st);
  Strain_operator b;
  for(int a = 0; a < rule.number_of_functions; ++a)
    b.gradients[a] = (1 / jacobian) * (reference[a][0] * st + (reference[a][1] * tr + reference[a][2] * rs));
  b.volume = rule.weights[std::size_t(q)] * jacobian;
  return b;
}

/// The operator of order 1.
inline Strain_operator strain_operator(Element_kind kind, const std::array<Vec3, 8>& points, int q)
{
  return strain_operator(quadrature_rule(kind), points, q);
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FEM_QUADRATURE_H
