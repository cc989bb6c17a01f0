// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_POLYHEDRAL_MIXED_MESH_DOMAIN_3_H
#define CGAL_POLYHEDRAL_MIXED_MESH_DOMAIN_3_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/surface/Surface_oracle_3.h>

#include <CGAL/Named_function_parameters.h>

namespace CGAL {

/*!
\ingroup PkgMixedMesh3Domains

\brief The domain inside a closed triangulated surface.

A point is inside if a ray from it crosses the surface an odd number of times: a component within
another one is a cavity. All answers are exact on the coordinates, rounded to double. The surface is
copied.

\cgalModels{MixedMeshDomain_3}
*/
class Polyhedral_mixed_mesh_domain_3 : public Mixed_meshes_3::internal::Surface_oracle_3
{
public:
  /*!
  Builds the AABB tree.

  \tparam FaceListGraph a model of `FaceListGraph`, with points of any CGAL kernel
  \param surface the surface. \pre `CGAL::is_triangle_mesh(surface) && CGAL::is_closed(surface)`
  \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those below

  \cgalNamedParamsBegin
    \cgalParamNBegin{vertex_point_map}
      \cgalParamDescription{the points of `surface`}
      \cgalParamType{a model of `ReadablePropertyMap` with the vertices as keys and points as values}
      \cgalParamDefault{`get_const_property_map(CGAL::vertex_point, surface)`}
    \cgalParamNEnd
  \cgalNamedParamsEnd

  \par Complexity
  O(n log n) for n triangles
  */
  template <class FaceListGraph, class NamedParameters = parameters::Default_named_parameters>
  explicit Polyhedral_mixed_mesh_domain_3(const FaceListGraph& surface,
                                          const NamedParameters& np = parameters::default_values())
    : Surface_oracle_3(surface, np)
  {
  }
};

} // namespace CGAL

#endif // CGAL_POLYHEDRAL_MIXED_MESH_DOMAIN_3_H
