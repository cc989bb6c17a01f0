// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgMixedMesh3Concepts
\cgalConcept

The concept `MixedMeshTraits_3` describes the requirements of the class `CGAL::Mixed_mesh_3` on its template
parameter: a point type. No predicate and no construction of the traits is used; the method uses predicates
and constructions on doubles, with `CGAL::Mixed_meshes_3::Predicates_kernel`.

A model need not be constructible.

\cgalHasModelsBegin
\cgalHasModels{any CGAL kernel whose number type holds doubles unchanged\, for example
`CGAL::Exact_predicates_inexact_constructions_kernel`\,
`CGAL::Exact_predicates_exact_constructions_kernel` or `CGAL::Simple_cartesian<double>`}
\cgalHasModelsEnd

\sa `CGAL::Mixed_mesh_3`
*/
class MixedMeshTraits_3
{
public:
  /*!
  A point in space: a model of `CopyConstructible` and `Assignable`, which has, for a
  point `p`,

  - a constructor from three `double`;
  - `p.x()`, `p.y()` and `p.z()`, of a type from which `CGAL::to_double()` makes a `double`.

  The point has to hold doubles unchanged: `CGAL::to_double(p.x())` is the `double` from which `p` was
  constructed. A point that rounds, such as the point of `CGAL::Simple_cartesian<float>`, voids the
  guarantees: the positions of vertices differ from those in the proofs.

  The point need not be default constructible.
  */
  typedef unspecified_type Point_3;
};
