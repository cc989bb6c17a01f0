// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgMixedMesh3Concepts
\cgalConcept

The concept `MixedMeshQuality_3` defines the cost of an element, and the direction in which the cost
increases. The optimization minimizes sums of powers of the cost.

The cost has to be continuous where the element is positive; the cost may have kinks, as the maximum of
several measures has. The cost should not depend on the position of the element. If the cost depends on the
size of the element, the result depends on the unit of length.

A cost need not detect every invalid element: moves and flips are made only if the Jacobian is proved positive
on the whole element, whatever the cost.

\cgalRefines{CopyConstructible}

\cgalHasModelsBegin
\cgalHasModels{CGAL::Mixed_meshes_3::Aspect_ratio_quality_3}
\cgalHasModels{CGAL::Mixed_meshes_3::Scaled_jacobian_quality_3}
\cgalHasModelsEnd

\sa `CGAL::optimize_mixed_mesh_3()`
\sa `CGAL::simplify_mixed_mesh_3()`
*/
class MixedMeshQuality_3
{
public:
  /*!
  The cost of an element.

  \param kind the kind of the element
  \param points the vertices of the element, ordered as in `CGAL::Mixed_meshes_3::Reference_element`, relative
         to the first vertex; entries beyond the number of vertices of the kind are zero
  \return at least 1, near 1 for a good element; infinity if the element is degenerate or inverted
  */
  double operator()(CGAL::Mixed_meshes_3::Element_kind kind,
                    const std::array<CGAL::Mixed_meshes_3::Vec3, 8>& points) const;

  /*!
  The same cost, and its gradient.

  \param kind as above
  \param points as above
  \param vertex the number of a vertex in the element
  \param gradient becomes the gradient with respect to the position of that vertex, where the cost is finite;
         at a kink, the gradient of any of the measures that meet there
  */
  double operator()(CGAL::Mixed_meshes_3::Element_kind kind,
                    const std::array<CGAL::Mixed_meshes_3::Vec3, 8>& points, int vertex,
                    CGAL::Mixed_meshes_3::Vec3& gradient) const;

  /// Whether an element of that cost is good enough for Algorithm 1 of the paper, which stiffens all other
  /// elements. The optimization does not call this function.
  bool is_acceptable(double cost) const;
};
