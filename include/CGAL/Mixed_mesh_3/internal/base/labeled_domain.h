// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_BASE_LABELED_DOMAIN_H
#define CGAL_MIXED_MESH_3_INTERNAL_BASE_LABELED_DOMAIN_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Element_attributes.h>

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

template <class T, class = void>
struct Is_labeled_domain : std::false_type
{
};
/// Models of `MixedMeshLabeledDomain_3`.
template <class T>
struct Is_labeled_domain<T, std::void_t<decltype(std::declval<const T&>().subdomain_indices())>>
  : std::true_type
{
};

template <class T, class = void>
struct Is_domain_with_sheets : std::false_type
{
};
/// Models of `MixedMeshDomainWithSheets_3`.
template <class T>
struct Is_domain_with_sheets<T, std::void_t<decltype(std::declval<const T&>().sheets())>>
  : std::bool_constant<Is_labeled_domain<T>::value>
{
};

/// The position of a subdomain in the order of a domain: where there is a choice, the earlier one counts.
using Subdomain_rank = std::uint16_t;

/// The rank of the outside, which comes last.
inline constexpr Subdomain_rank outside_rank = Subdomain_rank(-1);

/// The subdomains in their order; the only subdomain of a domain without labels is 1.
template <class Domain>
std::vector<Subdomain_index> subdomain_indices(const Domain& domain)
{
  if constexpr(Is_labeled_domain<Domain>::value)
    return {domain.subdomain_indices().begin(), domain.subdomain_indices().end()};
  else
    return {1};
}

/// The rank of a subdomain; the rank of the outside for an index that is no subdomain's.
inline Subdomain_rank rank_of(const std::vector<Subdomain_index>& indices, Subdomain_index index)
{
  const auto found = std::find(indices.begin(), indices.end(), index);
  return found == indices.end() ? outside_rank : Subdomain_rank(found - indices.begin());
}

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_BASE_LABELED_DOMAIN_H
