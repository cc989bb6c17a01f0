// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The isoparametric stiffness of an element of linear elasticity.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_FEM_ELEMENT_STIFFNESS_H
#define CGAL_MIXED_MESH_3_INTERNAL_FEM_ELEMENT_STIFFNESS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Elastic_material.h>
#include <CGAL/Mixed_mesh_3/Mixed_element_traits_3.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/fem/quadrature.h>

#include <algorithm>
#include <array>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

using Matrix_3x3 = std::array<Vec3, 3>; // rows

/// The blocks of pairs of shape functions `[a][b]`, `b <= a`; the others are their transposes.
using Element_stiffness =
  std::array<std::array<Matrix_3x3, largest_number_of_functions>, largest_number_of_functions>;

/// The resistance to a change of volume: by the dilatation at each point of the quadrature, or by its mean
/// over the element (Nagtegaal, Parks, Rice, 1974; Hughes' B-bar), or for an element of a patch partly
/// pointwise and partly by the mean over the patch, which is added separately. With the pointwise dilatation
/// only, all kinds of order 1 lock if the material is nearly incompressible.
enum class Dilatation { POINTWISE, MEAN, PATCH };

/// The share of the bulk modulus that is pointwise in a patch: the largest share that does not lock. Without
/// a pointwise share, the elements of a patch could change their volumes against each other too easily.
inline double pointwise_share(const Elastic_material& material)
{
  // A bulk modulus of 2 mu is that of a Poisson's ratio of 2/7 = 0.29: the pointwise part is as compressible.
  constexpr double largest_multiple_of_mu = 2;
  return (std::min)(1., largest_multiple_of_mu * material.mu() / material.bulk_modulus());
}

/// \param rule quadrature rule of the kind, of order 1 or 2
/// \par Complexity
/// Constant: with order 1, 8 points and 36 blocks for a hexahedron, 1 point and 10 blocks for a tetrahedron;
/// with order 2, 14 points and 210 blocks, 4 points and 55 blocks
inline void compute_element_stiffness(const Quadrature_rule& rule, const std::array<Vec3, 8>& points,
                                      const Elastic_material& material, Dilatation dilatation,
                                      Element_stiffness& stiffness)
{
  const int n = rule.number_of_functions;
  double volume = 0;
  std::array<Vec3, largest_number_of_functions>
    divergence{}; // integral of the divergence, by the displacement of each node
  for(int a = 0; a < n; ++a)
    for(int b = 0; b <= a; ++b)
      stiffness[a][b] = Matrix_3x3{};
  // The integrals of the dyadic products of gradients come first, as they do not depend on the material.
  for(int q = 0; q < rule.number_of_points; ++q) {
    const Strain_operator s = strain_operator(rule, points, q);
    volume += s.volume;
    for(int a = 0; a < n; ++a) {
      const Vec3 ga = s.volume * s.gradients[a];
      divergence[a] = divergence[a] + ga;
      for(int b = 0; b <= a; ++b)
        for(int i = 0; i < 3; ++i)
          for(int j = 0; j < 3; ++j)
            stiffness[a][b][i][j] += ga[i] * s.gradients[b][j];
    }
  }
  const double mu = material.mu();
  const double pointwise = dilatation == Dilatation::POINTWISE ? 1
                           : dilatation == Dilatation::PATCH   ? pointwise_share(material)
                                                               : 0;
  const double lambda = pointwise * material.bulk_modulus() - 2 * mu / 3;
  const double mean = dilatation == Dilatation::MEAN ? material.bulk_modulus() / volume : 0;
  for(int a = 0; a < n; ++a)
    for(int b = 0; b <= a; ++b) {
      const Matrix_3x3 d = stiffness[a][b];
      const double shear = mu * (d[0][0] + d[1][1] + d[2][2]);
      for(int i = 0; i < 3; ++i)
        for(int j = 0; j < 3; ++j)
          stiffness[a][b][i][j] = lambda * d[i][j] + mu * d[j][i] + (i == j ? shear : 0)
                                  + mean * divergence[a][i] * divergence[b][j];
    }
}

/// The stiffness of order 1.
inline void compute_element_stiffness(Element_kind kind, const std::array<Vec3, 8>& points,
                                      const Elastic_material& material, Dilatation dilatation,
                                      Element_stiffness& stiffness)
{
  compute_element_stiffness(quadrature_rule(kind), points, material, dilatation, stiffness);
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_FEM_ELEMENT_STIFFNESS_H
