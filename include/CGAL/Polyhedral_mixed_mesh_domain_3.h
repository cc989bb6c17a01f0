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
#include <CGAL/tags.h>

namespace CGAL {

/*!
\ingroup PkgMixedMesh3Domains

\brief The domain inside a closed triangulated surface.

A point is inside if a ray from it crosses the surface an odd number of times: a component within
another one is a cavity. All answers are exact on the coordinates, rounded to double. The surface is
copied.

\cgalModels{MixedMeshDomainWithFeatures_3}
\cgalModels{MixedMeshDomainWithShells_3}
*/
class Polyhedral_mixed_mesh_domain_3 : private Mixed_meshes_3::internal::Surface_oracle_3
{
  using Base = Mixed_meshes_3::internal::Surface_oracle_3;

public:
  using Base::Kernel;
  using Base::Point_3;
  using Base::Surface_part;
  using Has_features = Tag_true;
  using Has_shells = Tag_true;

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
    : Base(surface, np)
  {
  }

  // The queries of the concepts.
  using Base::area;
  using Base::axis_parallel_planes;
  using Base::bbox;
  using Base::bounded_side;
  using Base::closest_point;
  using Base::facet;
  using Base::locate;
  using Base::number_of_facets;
  using Base::sharp_edges;
  using Base::shells;
  using Base::surface_part;
  using Base::surface_samples;
  using Base::tree_of_closest_points;
  using Base::volume;

  /// \cond SKIP_IN_MANUAL
  using Base::crossings;
  using Base::surface_edges;
  /// \endcond
};

} // namespace CGAL

#endif // CGAL_POLYHEDRAL_MIXED_MESH_DOMAIN_3_H
