// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_WITH_KIND_H
#define CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_WITH_KIND_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Mixed_element_traits_3.h>

#include <cstdlib>
#include <type_traits>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Calls `f(std::integral_constant<Element_kind, kind>())`: a kind known at run time, as a type.
template <class F>
decltype(auto) with_kind(Element_kind kind, const F& f)
{
  switch(kind) {
  case TETRAHEDRON: return f(std::integral_constant<Element_kind, TETRAHEDRON>());
  case PYRAMID: return f(std::integral_constant<Element_kind, PYRAMID>());
  case PRISM: return f(std::integral_constant<Element_kind, PRISM>());
  case HEXAHEDRON: return f(std::integral_constant<Element_kind, HEXAHEDRON>());
  }
  std::abort(); // a kind is one of these; a new one is an error with -Werror=switch
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_ELEMENTS_WITH_KIND_H
