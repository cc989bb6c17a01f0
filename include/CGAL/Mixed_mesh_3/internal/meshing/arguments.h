// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Arguments of the entry functions: models of the concepts, or surfaces, from which models are made.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_ARGUMENTS_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_ARGUMENTS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Default_visitor.h>
#include <CGAL/Mixed_mesh_regions_3.h>
#include <CGAL/Polyhedral_mixed_mesh_region_3.h>
#include <CGAL/Polyhedral_mixed_mesh_domain_3.h>

#include <CGAL/Named_function_parameters.h>

#include <type_traits>
#include <utility>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

template <class T, class = void>
struct Is_face_graph : std::false_type
{
};
// A function is tested, because `boost::graph_traits` of a type that is no graph does not compile.
template <class T>
struct Is_face_graph<T, std::void_t<decltype(faces(std::declval<const T&>()))>> : std::true_type
{
};

template <class T, class = void>
struct Is_surface_model : std::false_type
{
};
template <class T>
struct Is_surface_model<T, std::void_t<typename T::Point_3, decltype(std::declval<const T&>().closest_point(
                                                              std::declval<const typename T::Point_3&>()))>>
  : std::true_type
{
};

template <class T, class = void>
struct Is_region_model : std::false_type
{
};
template <class T>
struct Is_region_model<
  T, std::void_t<typename T::Surface_part, decltype(std::declval<const T&>().surface_part())>>
  : std::true_type
{
};

/// Whether the coordinates of a model's points convert to double; the coordinates of an exact kernel do not.
template <class T>
constexpr bool has_points_of_doubles()
{
  if constexpr(Is_surface_model<T>::value)
    return std::is_convertible_v<decltype(std::declval<const typename T::Point_3&>().x()), double>;
  else
    return true;
}

/// Returns the argument, or a `Model` made of the argument if it is a surface.
template <class Model, class T, class NamedParameters>
decltype(auto) as_model(const T& given, [[maybe_unused]] const NamedParameters& np)
{
  if constexpr(Is_face_graph<T>::value)
    return Model(given, np);
  else
    return (given);
}

template <class T, class NamedParameters>
decltype(auto) as_domain(const T& domain, const NamedParameters& np)
{
  static_assert(
    Is_face_graph<T>::value || (Is_surface_model<T>::value && Is_region_model<T>::value),
    "the domain must be a closed triangulated surface (a model of FaceListGraph, its header included) "
    "or a model of MixedMeshDomain_3");
  static_assert(
    has_points_of_doubles<T>(),
    "the points of a domain must be those of CGAL::Mixed_meshes_3::Predicates_kernel, or have doubles "
    "as coordinates, whatever the kernel of the mesh: numbers of an exact kernel do not convert");
  return as_model<Polyhedral_mixed_mesh_domain_3>(domain, np);
}

template <class T, class NamedParameters>
decltype(auto) as_surface(const T& surface, const NamedParameters& np)
{
  static_assert(
    Is_face_graph<T>::value || Is_surface_model<T>::value,
    "the surface must be closed and triangulated (a model of FaceListGraph, its header included) or a "
    "model of MixedMeshSurface_3");
  static_assert(
    has_points_of_doubles<T>(),
    "the points of a domain must be those of CGAL::Mixed_meshes_3::Predicates_kernel, or have doubles "
    "as coordinates, whatever the kernel of the mesh: numbers of an exact kernel do not convert");
  return as_model<Polyhedral_mixed_mesh_domain_3>(surface, np);
}

template <class T, class NamedParameters>
decltype(auto) as_region(const T& region, const NamedParameters& np)
{
  static_assert(
    Is_face_graph<T>::value || Is_region_model<T>::value,
    "the region must be a closed triangulated surface (a model of FaceListGraph, its header included) "
    "or a model of MixedMeshRegion_3");
  return as_model<Polyhedral_mixed_mesh_region_3>(region, np);
}

/// Calls `f(visitor)` with the visitor among the named parameters, or the default visitor.
template <class NamedParameters, class Function>
decltype(auto) with_visitor(const NamedParameters& np, const Function& f)
{
  using Visitor = typename internal_np::Lookup_named_param_def<internal_np::visitor_t, NamedParameters,
                                                               Default_visitor>::reference;
  Default_visitor default_visitor;
  Visitor visitor = parameters::choose_parameter(parameters::get_parameter_reference(np,
                                                                                     internal_np::visitor),
                                                 default_visitor);
  return f(visitor);
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_ARGUMENTS_H
