// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Configurational forces: the gradient of the energy of a finite element solution by the positions of the
// nodes. J. D. Eshelby, 1951; M. Braun, "Configurational forces induced by finite-element discretization",
// 1997; P. Thoutireddy, M. Ortiz, "A variational r-adaption and shape-optimization method for
// finite-deformation elasticity", Int. J. Numer. Meth. Engng 61, 2004.

#ifndef CGAL_LINEAR_ELASTICITY_3_INTERNAL_CONFIGURATIONAL_FORCES_H
#define CGAL_LINEAR_ELASTICITY_3_INTERNAL_CONFIGURATIONAL_FORCES_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <CGAL/Mixed_mesh_3/Elastic_material.h>
#include <CGAL/Mixed_mesh_3/Element_list.h>
#include <CGAL/Mixed_mesh_3/Mixed_element_traits_3.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/element_points.h>
#include <CGAL/Mixed_mesh_3/internal/fem/element_stiffness.h>
#include <CGAL/Mixed_mesh_3/internal/fem/quadrature.h>

#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// The energy of an element, and its gradients.
struct Element_energy
{
  double energy = 0;
  std::array<Vec3, 8> by_displacements{}; // forces on the nodes
  std::array<Vec3, 8> by_positions{};     // at fixed displacements of the nodes
};

/*!
The energy of a standard element, its dilatation pointwise, integrated as its stiffness is. With the
gradient of displacement \f$ H_{ij} = \partial u_i / \partial x_j \f$, the stress \f$ \sigma \f$ and the
density of energy W, its gradients are the integrals of \f$ \sigma \nabla N_a \f$ by the displacement and of
\f$ (W I - H^T \sigma) \nabla N_a \f$ by the position of node a. The second one is exact for the sum over the
points of the quadrature, too: when a node moves by \f$ \delta X \f$, H at a point changes by
\f$ - H \delta X \otimes \nabla N_a \f$, and the volume that the point stands for by its multiple
\f$ \delta X \cdot \nabla N_a \f$.

\param operators at the points of quadrature
\param displacements of the nodes
*/
inline Element_energy element_energy(Element_kind kind, const std::array<Strain_operator, 8>& operators,
                                     const std::array<Vec3, 8>& displacements,
                                     const Elastic_material& material)
{
  const int n = reference_elements[kind].number_of_vertices;
  const double lambda = material.lambda(), mu = material.mu();
  Element_energy result;
  for(int q = 0; q < quadrature_rule(kind).number_of_points; ++q) {
    const Strain_operator& s = operators[std::size_t(q)];
    Matrix_3x3 h{}, stress{};
    for(int a = 0; a < n; ++a)
      for(int i = 0; i < 3; ++i)
        h[i] = h[i] + displacements[a][i] * s.gradients[a];
    const double trace = h[0][0] + h[1][1] + h[2][2];
    double density = 0;
    for(int i = 0; i < 3; ++i)
      for(int j = 0; j < 3; ++j) {
        const double strain = (h[i][j] + h[j][i]) / 2;
        stress[i][j] = 2 * mu * strain + (i == j ? lambda * trace : 0);
        density += stress[i][j] * strain / 2;
      }
    result.energy += s.volume * density;
    for(int a = 0; a < n; ++a) {
      const Vec3& g = s.gradients[a];
      const Vec3 force{dot(stress[0], g), dot(stress[1], g), dot(stress[2], g)};
      result.by_displacements[a] = result.by_displacements[a] + s.volume * force;
      const Vec3 turned = force[0] * h[0] + force[1] * h[1] + force[2] * h[2]; // H^T sigma grad N_a
      result.by_positions[a] = result.by_positions[a] + s.volume * (density * g - turned);
    }
  }
  return result;
}

/// \param materials one for all elements, or one for each
inline const Elastic_material& material_of(const std::vector<Elastic_material>& materials, Element_index e)
{
  return materials.size() == 1 ? materials.front() : materials[e];
}

/// The energy of a mesh, and its gradients, of all vertices.
struct Mesh_energy
{
  double energy = 0;
  std::vector<Vec3> by_displacements, by_positions;
  std::vector<double> of_stars; // of the elements at each vertex
};

/// The energies of several displacements of a mesh: what depends on the points only is computed once.
/// \param materials one for all elements, or one for each
/// \param displacements pointers to those of all vertices
/// \pre no element is inverted
inline std::vector<Mesh_energy> mesh_energies(const Element_list& elements, const std::vector<Vec3>& points,
                                              const std::vector<Elastic_material>& materials,
                                              const std::vector<const std::vector<Vec3>*>& displacements)
{
  Mesh_energy none;
  none.by_displacements.assign(points.size(), Vec3{});
  none.by_positions.assign(points.size(), Vec3{});
  none.of_stars.assign(points.size(), 0);
  std::vector<Mesh_energy> results(displacements.size(), none);
  for(Element_index e = 0; e < elements.size(); ++e) {
    const Element_view element = elements[e];
    // Displacements relative to those of a node: a translation has no energy, not even by rounding.
    const auto relative = [&element](const std::vector<Vec3>& values) {
      return relative_points(element, [&values](Vertex_index v) { return values[v]; });
    };
    const Element_points positions = relative(points);
    std::array<Strain_operator, 8> operators;
    for(int q = 0; q < quadrature_rule(element.kind()).number_of_points; ++q)
      operators[std::size_t(q)] = strain_operator(element.kind(), positions, q);
    for(std::size_t i = 0; i < displacements.size(); ++i) {
      const Element_energy one = element_energy(element.kind(), operators, relative(*displacements[i]),
                                                material_of(materials, e));
      Mesh_energy& result = results[i];
      result.energy += one.energy;
      for(int a = 0; a < element.size(); ++a) {
        const Vertex_index v = element[a];
        result.by_displacements[v] = result.by_displacements[v] + one.by_displacements[a];
        result.by_positions[v] = result.by_positions[v] + one.by_positions[a];
        result.of_stars[v] += one.energy;
      }
    }
  }
  return results;
}

/// The energy of a mesh with displacements, with the preconditions of `mesh_energies()`.
inline Mesh_energy mesh_energy(const Element_list& elements, const std::vector<Vec3>& points,
                               const std::vector<Elastic_material>& materials,
                               const std::vector<Vec3>& displacements)
{
  return mesh_energies(elements, points, materials, {&displacements}).front();
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_INTERNAL_CONFIGURATIONAL_FORCES_H
