// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_ELASTIC_MATERIAL_H
#define CGAL_MIXED_MESH_3_ELASTIC_MATERIAL_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_attributes.h>
#include <CGAL/Mixed_mesh_3/Index.h>

#include <map>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

/// \ingroup PkgLinearElasticity3Ref
/// An isotropic linear elastic material. The defaults are those of the paper's brain tissue.
struct Elastic_material
{
  double young_modulus = 1;    ///< kPa; positive
  double poisson_ratio = 0.45; ///< from 0 to below 1/2
  double density = 1e-6;       ///< kg/mm^3

  /// Lame's first constant, kPa.
  double lambda() const
  {
    return young_modulus * poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio));
  }
  /// The shear modulus, kPa.
  double mu() const { return young_modulus / (2 * (1 + poisson_ratio)); }
  /// The bulk modulus, kPa.
  double bulk_modulus() const { return young_modulus / (3 * (1 - 2 * poisson_ratio)); }
};

/// \ingroup PkgLinearElasticity3Ref
/// The materials of the elements of a mesh, by their subdomains, for `Linear_elasticity_3`.
/// \param mesh mesh
/// \param materials material of each subdomain
/// \param other material of subdomains that `materials` does not have
template <class Mesh>
std::vector<Elastic_material>
materials_of_elements(const Mesh& mesh, const std::map<Subdomain_index, Elastic_material>& materials,
                      const Elastic_material& other = Elastic_material())
{
  std::vector<Elastic_material> result;
  for(Element_index e = 0; e < mesh.number_of_elements(); ++e) {
    const auto place = materials.find(mesh.subdomain_index(e));
    result.push_back(place == materials.end() ? other : place->second);
  }
  return result;
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_ELASTIC_MATERIAL_H
