// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgMixedMesh3Concepts
\cgalConcept

The concept `MixedMeshQuality_3` says how bad an element is, and in which direction it gets worse. The
optimization minimizes sums of powers of it.

The cost has to be continuous where the element is positive; it may have kinks, as the largest of several
measures has. It should not depend on the position of the element. If it depends on its size, so does the
result on the unit.

A cost need not tell all that makes an element invalid: moves and flips are made only if the Jacobian is
proved positive on the whole element, whatever the cost.

\cgalRefines{CopyConstructible}

\cgalHasModelsBegin
\cgalHasModels{CGAL::Mixed_meshes_3::Aspect_ratio_quality_3}
\cgalHasModels{CGAL::Mixed_meshes_3::Scaled_jacobian_quality_3}
\cgalHasModelsEnd

\sa `CGAL::optimize_mixed_mesh_3()`
*/
class MixedMeshQuality_3
{
public:
  /*!
  The cost of an element.

  \param kind its kind
  \param points its vertices, ordered as in `CGAL::Mixed_meshes_3::Reference_element`, relative to the
         first one; those that the kind does not have are zero
  \return at least 1, near 1 for a good element; infinity if the element is degenerate or inverted
  */
  double operator()(CGAL::Mixed_meshes_3::Element_kind kind,
                    const std::array<CGAL::Mixed_meshes_3::Vec3, 8>& points) const;

  /*!
  The same cost, and its gradient.

  \param kind as above
  \param points as above
  \param vertex the number of a vertex in the element
  \param gradient becomes the gradient by the position of that vertex, where the cost is finite. At a
         kink, that of any of the measures that meet there
  */
  double operator()(CGAL::Mixed_meshes_3::Element_kind kind,
                    const std::array<CGAL::Mixed_meshes_3::Vec3, 8>& points, int vertex,
                    CGAL::Mixed_meshes_3::Vec3& gradient) const;

  /// Whether an element of that cost is good enough for Algorithm 1 of the paper, which stiffens those that
  /// are not. The optimization does not ask.
  bool is_acceptable(double cost) const;
};
