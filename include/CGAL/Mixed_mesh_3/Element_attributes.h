// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_ELEMENT_ATTRIBUTES_H
#define CGAL_MIXED_MESH_3_ELEMENT_ATTRIBUTES_H

#include <CGAL/license/Mixed_mesh_3.h>

namespace CGAL {
namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMesh3Mesh
/// The label of the part that an element belongs to: a material, for example a tumor. 0 is the outside, as in
/// CGAL's labeled domains.
using Subdomain_index = int;

/// \ingroup PkgMixedMesh3Mesh
/// The compartment around an element beside a sheet, such as the falx: faces between elements of two
/// compartments are on a sheet. 0: any compartment, as for most elements.
using Compartment_index = int;

/// \ingroup PkgMixedMesh3Mesh
/// The attributes of an element besides its kind and vertices; every stage passes them on.
struct Element_attributes
{
  Subdomain_index subdomain_index = 1; ///< positive
  bool is_in_region = false;           ///< whether the element meets the region of interest
  Compartment_index compartment = 0;   ///< not negative
};

/// \ingroup PkgMixedMesh3Mesh
/// Whether a face between elements is on a sheet.
inline bool are_beside_sheet(const Element_attributes& a, const Element_attributes& b)
{
  return a.compartment != b.compartment && a.compartment != 0 && b.compartment != 0;
}

/// \ingroup PkgMixedMesh3Mesh
/// Whether all attributes are equal.
inline bool operator==(const Element_attributes& a, const Element_attributes& b)
{
  return a.subdomain_index == b.subdomain_index && a.is_in_region == b.is_in_region
         && a.compartment == b.compartment;
}
/// \ingroup PkgMixedMesh3Mesh
/// Whether an attribute differs.
inline bool operator!=(const Element_attributes& a, const Element_attributes& b) { return !(a == b); }

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_ELEMENT_ATTRIBUTES_H
