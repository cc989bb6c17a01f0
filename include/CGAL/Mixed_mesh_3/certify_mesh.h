// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// All checks of validity in one call; the command-line mesher demands them of each mesh that it writes.

#ifndef CGAL_MIXED_MESH_3_CERTIFY_MESH_H
#define CGAL_MIXED_MESH_3_CERTIFY_MESH_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/surface_distance.h>
#include <CGAL/Mixed_mesh_3/validation.h>

#include <array>
#include <cstddef>

namespace CGAL {
namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMesh3Validity
/// The outcome of `certify_mesh()`.
struct Mesh_certificate
{
  /// A property of a valid mesh, in words, and the answer whether the mesh has the property.
  struct Check
  {
    const char* name; ///< for example "conforming"
    bool holds;       ///< whether the property is proved
  };

  Mesh_defects defects; ///< defects that `find_defects()` finds
  /// The number of pairs of boundary triangles that intersect, see `number_of_boundary_self_intersections()`;
  /// 0 if there are defects, as intersections are not searched for then.
  std::size_t number_of_self_intersections = 0;

  /// Whether all checks hold.
  bool is_valid() const { return defects.none() && number_of_self_intersections == 0; }

  /// The checks one by one.
  std::array<Check, 7> checks() const
  {
    return {{{"conforming", defects.conforming()},
             {"closed manifold boundary", defects.closed_manifold_boundary()},
             {"boundary does not cut itself (exact)", number_of_self_intersections == 0},
             {"corner tetrahedra positive (exact)", defects.nonpositive_corners == 0},
             {"Jacobian positive on whole elements (exact)", defects.positive()},
             {"no unused vertex", defects.unused_vertices == 0},
             {"no duplicate vertex", defects.duplicate_vertices == 0}}};
  }
};

/*!
\ingroup PkgMixedMesh3Validity

\brief Certifies that a mesh is valid: conforming, its boundary a closed 2-manifold that does not intersect
itself, the Jacobian of each element positive on the whole element, no vertex unused or twice.

All signs are exact on the coordinates as doubles. The command-line mesher writes no mesh that is not valid.

\param mesh `Mixed_mesh_3` of any origin
\par Complexity
O(n log n) for n elements, see `find_defects()`
*/
template <class Mesh>
Mesh_certificate certify_mesh(const Mesh& mesh)
{
  const internal::Examined_mesh examined = internal::examine_mesh(mesh);
  Mesh_certificate certificate{examined.defects};
  if(certificate.defects.none() && mesh.number_of_elements() > 0)
    certificate.number_of_self_intersections = internal::number_of_self_intersections(
      internal::boundary_triangles(mesh, examined.boundary));
  return certificate;
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_CERTIFY_MESH_H
