// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_LINEAR_ELASTICITY_3_BUOYANT_FORCES_H
#define CGAL_LINEAR_ELASTICITY_3_BUOYANT_FORCES_H

#include <CGAL/license/Linear_elasticity_3.h>

#include <CGAL/Mixed_mesh_3/Index.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/split_to_tetrahedra.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

namespace internal {

/// The share of a tetrahedron's volume that is below height 0, by the heights of its vertices.
inline double share_below(std::array<double, 4> heights)
{
  std::sort(heights.begin(), heights.end());
  const auto [a, b, c, d] = heights;
  const auto cut = [](double below, double above) { return below / (below - above); }; // place of 0
  if(d <= 0)
    return 1;
  if(a >= 0)
    return 0;
  if(b >= 0)
    return cut(a, b) * cut(a, c) * cut(a, d);
  if(c <= 0)
    return 1 - cut(d, a) * cut(d, b) * cut(d, c);
  // The part is a prism, from the edge between the lower two vertices: three tetrahedra.
  const double ac = cut(a, c), ad = cut(a, d), bc = cut(b, c), bd = cut(b, d);
  return ac * ad * (1 - bd) + ac * (1 - bc) * bd + bc * bd;
}

/// The share of each element's volume that is below a height, by the tetrahedra that the element is split
/// into.
/// \param height `double(const Vec3&)`
template <class Mesh, class Height>
std::vector<double> shares_below(const Mesh& mesh, const Height& height)
{
  std::vector<Element_index> origins;
  const Mesh tetrahedra = split_to_tetrahedra(mesh, &origins);
  std::vector<double> below(mesh.number_of_elements()), all(mesh.number_of_elements());
  for(std::size_t t = 0; t < tetrahedra.number_of_elements(); ++t) {
    std::array<Vec3, 4> p;
    std::array<double, 4> heights;
    for(int i = 0; i < 4; ++i) {
      p[i] = to_vec3(tetrahedra.point(tetrahedra.element(t)[i]));
      heights[i] = height(p[i]);
    }
    // Tetrahedra of a warped element can be inside out; their signed volumes count.
    const double volume = dot(cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]);
    all[origins[t]] += volume;
    below[origins[t]] += share_below(heights) * volume;
  }
  for(std::size_t e = 0; e < below.size(); ++e)
    below[e] = all[e] > 0 ? (std::min)(1., (std::max)(0., below[e] / all[e])) : 0;
  return below;
}

} // namespace internal

/*!
\ingroup PkgLinearElasticity3Ref

The part of the weight that a fluid around a body supports: forces by volume for
`Linear_elasticity_3::set_body_forces()`, to be set beside `Linear_elasticity_3::set_gravity()`.

Below the surface of the fluid each element loses the weight of the fluid that it displaces, so that the
difference of the densities counts; above, all of the weight stays. An element that the surface cuts loses the
share that is below. The fluid's pressure is also in the pores of tissue: the compression of a solid by the
pressure is left out.

\tparam Mesh a `Mixed_mesh_3`
\param mesh mesh
\param acceleration acceleration of gravity, in mm/s^2
\param fluid_density density in kg/mm^3; 1e-6 is the density of water
\param level height of the fluid's surface, in mm: the height of a point is its coordinate in the direction
opposite to the acceleration, so z if that is (0, 0, -9810)
\return the force by volume in mN/mm^3, of each element: minus the density of the fluid times the
        acceleration, times the share of the element that is below the level. Zeros if there is no
        acceleration
\pre the density is not negative
\par Complexity
Linear
*/
template <class Mesh>
std::vector<Vec3> buoyant_forces(const Mesh& mesh, const Vec3& acceleration, double fluid_density,
                                 double level = std::numeric_limits<double>::infinity())
{
  CGAL_precondition(fluid_density >= 0 && !std::isnan(level));
  const double g = norm(acceleration);
  std::vector<Vec3> forces(mesh.number_of_elements(), Vec3{});
  if(!(g > 0))
    return forces;
  std::vector<double> shares(forces.size(), level > 0 ? 1 : 0);
  if(std::isfinite(level))
    shares = internal::shares_below(mesh, [&](const Vec3& p) { return -dot(p, acceleration) / g - level; });
  for(std::size_t e = 0; e < forces.size(); ++e)
    forces[e] = -fluid_density * shares[e] * acceleration;
  return forces;
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_LINEAR_ELASTICITY_3_BUOYANT_FORCES_H
