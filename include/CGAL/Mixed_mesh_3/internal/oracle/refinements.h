// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Refinements of the concepts: a model says by a tag that it has the members of a refinement. With the tag,
// the members are called, so that a wrong one does not compile. A member without the tag does not compile
// either.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_ORACLE_REFINEMENTS_H
#define CGAL_MIXED_MESH_3_INTERNAL_ORACLE_REFINEMENTS_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <tuple>
#include <type_traits>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// Whether an expression compiles for a type.
template <template <class> class Expression, class T, class = void>
inline constexpr bool compiles = false;
template <template <class> class Expression, class T>
inline constexpr bool compiles<Expression, T, std::void_t<Expression<T>>> = true;

/// A model and the members of a refinement: a name that both have is ambiguous, whatever its signature is.
template <class Model, class Members>
struct Searched : Model, Members
{
};

enum class Tag_of_model { NO, YES, MISSING };

/// Whether a model has a refinement, by its tag; or whether it has one of the members, and no tag. A class
/// that is final cannot be searched for members.
template <class Model, class Members>
constexpr Tag_of_model tag_of()
{
  if constexpr(compiles<Members::template Tag, Model>)
    return Members::template Tag<Model>::value ? Tag_of_model::YES : Tag_of_model::NO;
  else if constexpr(std::is_final_v<Model> || compiles<Members::template Names, Searched<Model, Members>>)
    return Tag_of_model::NO;
  else
    return Tag_of_model::MISSING;
}

struct Feature_members
{
  int sharp_edges, axis_parallel_planes;
  template <class T>
  using Tag = typename T::Has_features;
  template <class T>
  using Names = std::tuple<decltype(&T::sharp_edges), decltype(&T::axis_parallel_planes)>;
};

/// Models of `MixedMeshDomainWithFeatures_3`.
template <class Surface>
constexpr bool has_features()
{
  constexpr Tag_of_model tag = tag_of<Surface, Feature_members>();
  static_assert(tag != Tag_of_model::MISSING,
                "a domain with sharp_edges() or axis_parallel_planes() is a model of "
                "MixedMeshDomainWithFeatures_3, and has to say so by Has_features");
  return tag == Tag_of_model::YES;
}

struct Shell_members
{
  int shells, volume;
  template <class T>
  using Tag = typename T::Has_shells;
  template <class T>
  using Names = std::tuple<decltype(&T::shells), decltype(&T::volume)>;
};

/// Models of `MixedMeshDomainWithShells_3`.
template <class Domain>
constexpr bool has_shells()
{
  constexpr Tag_of_model tag = tag_of<Domain, Shell_members>();
  static_assert(tag != Tag_of_model::MISSING, "a domain with shells() or volume() is a model of "
                                              "MixedMeshDomainWithShells_3, and has to say so by Has_shells");
  return tag == Tag_of_model::YES;
}

struct Subdomain_members
{
  int subdomain_indices, subdomain_index;
  template <class T>
  using Tag = typename T::Has_subdomains;
  template <class T>
  using Names = std::tuple<decltype(&T::subdomain_indices), decltype(&T::subdomain_index)>;
};

/// Models of `MixedMeshLabeledDomain_3`.
template <class Surface>
constexpr bool has_subdomains()
{
  constexpr Tag_of_model tag = tag_of<Surface, Subdomain_members>();
  static_assert(tag != Tag_of_model::MISSING,
                "a domain with subdomain_indices() or subdomain_index() is a model of "
                "MixedMeshLabeledDomain_3, and has to say so by Has_subdomains");
  return tag == Tag_of_model::YES;
}

struct Sheet_members
{
  int sheets;
  template <class T>
  using Tag = typename T::Has_sheets;
  template <class T>
  using Names = decltype(&T::sheets);
};

/// Models of `MixedMeshDomainWithSheets_3`.
template <class Surface>
constexpr bool has_sheets()
{
  constexpr Tag_of_model tag = tag_of<Surface, Sheet_members>();
  static_assert(
    tag != Tag_of_model::MISSING,
    "a domain with sheets() is a model of MixedMeshDomainWithSheets_3, and has to say so by Has_sheets");
  static_assert(
    tag != Tag_of_model::YES || has_subdomains<Surface>(),
    "a domain with Has_sheets is a model of MixedMeshLabeledDomain_3, and has to say so by Has_subdomains");
  return tag == Tag_of_model::YES;
}

struct Weight_members
{
  int weight;
  template <class T>
  using Tag = typename T::Has_weights;
  template <class T>
  using Names = decltype(&T::weight);
};

/// Models of `MixedMeshRegionWithWeights_3`.
template <class Region>
constexpr bool has_weights()
{
  constexpr Tag_of_model tag = tag_of<Region, Weight_members>();
  static_assert(
    tag != Tag_of_model::MISSING,
    "a region with weight() is a model of MixedMeshRegionWithWeights_3, and has to say so by Has_weights");
  return tag == Tag_of_model::YES;
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_ORACLE_REFINEMENTS_H
