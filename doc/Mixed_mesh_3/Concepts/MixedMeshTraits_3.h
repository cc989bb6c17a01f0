// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgMixedMesh3Concepts
\cgalConcept

The concept `MixedMeshTraits_3` says what the class `CGAL::Mixed_mesh_3` asks of its template
parameter: a point type. No predicate and no construction is used; those of the method are on
doubles, with `CGAL::Mixed_meshes_3::Predicates_kernel`.

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

  It has to hold doubles unchanged: `CGAL::to_double(p.x())` is what `p` was constructed from. A
  point that rounds, such as that of `CGAL::Simple_cartesian<float>`, voids the guarantees: its
  vertices are not where the proofs have them.

  It need not be default constructible.
  */
  typedef unspecified_type Point_3;
};
