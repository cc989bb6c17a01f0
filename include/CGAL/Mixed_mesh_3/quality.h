// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Measures of elements and of meshes.

#ifndef CGAL_MIXED_MESH_3_QUALITY_H
#define CGAL_MIXED_MESH_3_QUALITY_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/internal/elements/aspect_ratio.h>
#include <CGAL/Mixed_mesh_3/internal/elements/element_measures.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

namespace internal {

/// A measure from kind and points, as a function object on the elements of any mesh.
template <double (*measure)(Element_kind, const Element_points&)>
struct Element_measure
{
  template <class Mesh>
  double operator()(const Mesh& mesh, std::size_t e) const
  {
    const Element_view element = mesh.element(e);
    return measure(element.kind(), element_points(mesh, element));
  }
};

} // namespace internal

/// \ingroup PkgMixedMesh3Validity
/// Volume of element `e` in the cube of the mesh's unit. Quadrilateral faces are bilinear patches.
template <class Mesh>
double volume(const Mesh& mesh, std::size_t e)
{
  return internal::Element_measure<internal::volume>()(mesh, e);
}

/// \ingroup PkgMixedMesh3Validity
/// Sum of the volumes of all elements.
template <class Mesh>
double volume(const Mesh& mesh)
{
  double sum = 0;
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
    sum += volume(mesh, e);
  return sum;
}

/// \name Measures of an Element
/// Function objects: called with a mesh and the number of an element, and passed to `quality_statistics()`
/// and `histogram()`. None depends on the position or the unit of the mesh.
/// @{

/*!
\ingroup PkgMixedMesh3Validity

Aspect-ratio coefficient (ARC): 1 is ideal, infinity degenerate. Section 5.3 of Lobos, Bucki, Hitschfeld,
Payan: "Mixed-element mesh for an intra-operative modeling of the brain tumor extraction".

- tetrahedron: `(sum l_i^2 / 6)^(3/2) / (8.47867 V)` over the six edge lengths;
- hexahedron: longest / shortest segment between centers of opposite faces;
- pyramid: longest / shortest of the two segments between midpoints of opposite base edges, and the
  height over the base's mean plane;
- prism: for a quadrilateral face its two midpoint segments and the height of the mean triangle;
  the worst of the three faces.
*/
inline constexpr internal::Element_measure<internal::aspect_ratio_coefficient> aspect_ratio_coefficient{};

/*!
\ingroup PkgMixedMesh3Validity

Scaled Jacobian, as in Stimpson, Ernst, Knupp, Pebay, Thompson: "The Verdict geometric quality library"
(SAND2007-1751), and in Verdict's code for pyramids: 1 is ideal, 0 degenerate, negative inverted.

The smallest, over the corners, of the determinant of the three edges divided by their lengths, and by its
value for the ideal element: the regular tetrahedron, the pyramid and the prism of equal edges, the cube.

- tetrahedron: over its four corners;
- pyramid: over the four corners of the tetrahedra at the four corners of its base; a value `1 + x` becomes `1
- x`. Unlike Verdict's, the value is not cut off at 0;
- prism, hexahedron: over all corners; Verdict has the center of the hexahedron too.
*/
inline constexpr internal::Element_measure<internal::scaled_jacobian> scaled_jacobian{};

/*!
\ingroup PkgMixedMesh3Validity

Smallest angle, in degrees, between two faces at an edge, inside the element. The normal of a quadrilateral
is its vector area (half the cross product of its diagonals), its mean normal.

Angles are in `[0, 360]`; angles of an element with a re-entrant edge, or turned inside out, exceed 180. A
face without area counts as 180 degrees. On the importance of angles, see Shewchuk, "What is a good linear
finite element?"
*/
inline constexpr internal::Element_measure<internal::smallest_dihedral_angle> smallest_dihedral_angle{};

/// \ingroup PkgMixedMesh3Validity
/// Largest angle, in degrees, between two faces at an edge; see `smallest_dihedral_angle`.
inline constexpr internal::Element_measure<internal::largest_dihedral_angle> largest_dihedral_angle{};

/// \ingroup PkgMixedMesh3Validity
/// Largest angle, in degrees, between the normals of the two triangles of a quadrilateral face, for the
/// worse of its two diagonals; 0 for a tetrahedron.
inline constexpr internal::Element_measure<internal::quad_warp> quad_warp{};

/// @}

/// \ingroup PkgMixedMesh3Validity
/// The values of a measure over some elements; all zero if there are none.
struct Quality_statistics
{
  /// The number of elements.
  std::size_t count = 0;
  /// The mean of their values.
  double mean = 0;
  /// The smallest value.
  double minimum = 0;
  /// The largest value.
  double maximum = 0;
  double share = 0; ///< share of elements with a value in the given interval
};

/// \ingroup PkgMixedMesh3Validity
/// A row for each kind of element, by `Element_kind`, and a last row for all elements.
using Quality_table = std::array<Quality_statistics, number_of_element_kinds + 1>;

/// \ingroup PkgMixedMesh3Validity
/// The values of a measure for each kind, and for all elements.
/// \param mesh the mesh
/// \param measure `double(const Mesh&, std::size_t)`, such as `scaled_jacobian`
/// \param lowest, highest closed interval of acceptable values, for the share of elements in the interval
template <class Mesh, class Measure>
Quality_table quality_statistics(const Mesh& mesh, const Measure& measure,
                                 double lowest = -std::numeric_limits<double>::infinity(),
                                 double highest = std::numeric_limits<double>::infinity())
{
  Quality_table rows;
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e) {
    const double value = measure(mesh, e);
    for(int row : {int(mesh.element(e).kind()), number_of_element_kinds}) {
      Quality_statistics& r = rows[row];
      r.minimum = r.count == 0 ? value : (std::min)(r.minimum, value);
      r.maximum = r.count == 0 ? value : (std::max)(r.maximum, value);
      ++r.count;
      r.mean += value;
      r.share += lowest <= value && value <= highest;
    }
  }
  for(Quality_statistics& r : rows)
    if(r.count != 0) {
      r.mean /= double(r.count);
      r.share /= double(r.count);
    }
  return rows;
}

/// \ingroup PkgMixedMesh3Validity
/// The paper's Table 1: the aspect-ratio coefficient, and the share of elements where it is at most 7.
template <class Mesh>
Quality_table quality_statistics(const Mesh& mesh)
{
  return quality_statistics(mesh, aspect_ratio_coefficient, 0, 7);
}

/// \ingroup PkgMixedMesh3Validity
/// Counts the elements by the value of a measure. No element is left out: there is a bin below the first
/// edge, a bin for each interval between two edges, which contains its lower edge, and a bin from the last
/// edge on.
/// \param mesh the mesh
/// \param measure `double(const Mesh&, std::size_t)`, such as `aspect_ratio_coefficient`
/// \param edges values that separate bins. \pre sorted
/// \return the counts: one more than there are edges
template <class Mesh, class Measure>
std::vector<std::size_t> histogram(const Mesh& mesh, const Measure& measure, const std::vector<double>& edges)
{
  CGAL_precondition(std::is_sorted(edges.begin(), edges.end()));
  std::vector<std::size_t> counts(edges.size() + 1);
  for(std::size_t e = 0; e < mesh.number_of_elements(); ++e)
    ++counts[std::size_t(std::upper_bound(edges.begin(), edges.end(), measure(mesh, e)) - edges.begin())];
  return counts;
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_QUALITY_H
