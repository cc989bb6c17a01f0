// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Names that differ between versions of CGAL.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_BASE_COMPATIBILITY_H
#define CGAL_MIXED_MESH_3_INTERNAL_BASE_COMPATIBILITY_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/version.h>

#if CGAL_VERSION_NR >= 1060000000
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>

#include <boost/variant/get.hpp>
#endif

#include <variant>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

#if CGAL_VERSION_NR >= 1060000000
/// Traits of an AABB tree of the triangles in a container.
template <class Kernel, class Iterator>
using AABB_triangle_traits = CGAL::AABB_traits_3<Kernel, CGAL::AABB_triangle_primitive_3<Kernel, Iterator>>;

/// Returns the value that a variant holds, if the value is of that type.
template <class T, class Variant>
const T* alternative(const Variant& variant)
{
  return std::get_if<T>(&variant);
}
#else
/// Traits of an AABB tree of the triangles in a container.
template <class Kernel, class Iterator>
using AABB_triangle_traits = CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Iterator>>;

/// Returns the value that a variant holds, if the value is of that type.
template <class T, class Variant>
const T* alternative(const Variant& variant)
{
  return boost::get<T>(&variant);
}
#endif

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_BASE_COMPATIBILITY_H
