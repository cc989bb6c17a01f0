// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_SHEET_3_H
#define CGAL_MIXED_MESH_SHEET_3_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/internal/surface/Sheet_oracle_3.h>

#include <CGAL/Named_function_parameters.h>

namespace CGAL {

/*!
\ingroup PkgMixedMesh3Domains

\brief A triangulated surface inside a domain that need not enclose anything, such as the falx or the
tentorium of a brain.

The sheet may stick out of the domain, and end inside. The sheet is an oriented 2-manifold, mostly with a
border. The surface is copied, its coordinates rounded to double.

\sa `Labeled_polyhedral_mixed_mesh_domain_3::add_sheet()`
*/
class Mixed_mesh_sheet_3 : private Mixed_meshes_3::internal::Sheet_oracle_3
{
  using Base = Mixed_meshes_3::internal::Sheet_oracle_3;

public:
  using Base::Kernel;
  using Base::Point_3;

  /*!
  Builds the AABB trees.

  \tparam FaceListGraph a model of `FaceListGraph`, with points of any CGAL kernel
  \param surface the sheet. \pre `CGAL::is_triangle_mesh(surface)`, and the sheet has faces
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
  explicit Mixed_mesh_sheet_3(const FaceListGraph& surface,
                              const NamedParameters& np = parameters::default_values())
    : Base(surface, np)
  {
  }

  using Base::area;
  using Base::area_samples;
  using Base::bbox;
  using Base::closest_point;
  using Base::do_intersect;
  using Base::locate;
  using Base::may_intersect;
  using Base::number_of_facets;

  /// \cond SKIP_IN_MANUAL
  using Base::crossings;
  /// \endcond
};

} // namespace CGAL

#endif // CGAL_MIXED_MESH_SHEET_3_H
